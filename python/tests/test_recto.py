"""The Python package: each function's first line is a claim.

Prints a line for each, "pass CLAIM" or "fail CLAIM", and the failures'
tracebacks to standard error; tests/test_python.sh makes TAP of them."""

import copy
import gc
import os
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import traceback
import warnings
import xml.etree.ElementTree as ElementTree

import numpy as np
import recto

VERTICES = np.array(
    [[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)]
)
FACES = np.array(
    [
        [0, 1, 3, 2],
        [4, 6, 7, 5],
        [0, 4, 5, 1],
        [2, 3, 7, 6],
        [0, 2, 6, 4],
        [1, 5, 7, 3],
    ]
)
OBJ = "".join("v %g %g %g\n" % tuple(v) for v in VERTICES) + "".join(
    "f %d %d %d %d\n" % tuple(f + 1) for f in FACES
)


def cube():
    return recto.Scene(VERTICES, FACES)


def raised(kind, function, *arguments, **keywords):
    try:
        function(*arguments, **keywords)
    except kind as error:
        return error
    raise AssertionError(f"no {kind.__name__}")


def sheet(n):
    """A wavy surface of 2 (n - 1)^2 triangles."""
    x, y = np.meshgrid(np.linspace(0, 6, n), np.linspace(0, 6, n))
    at = np.arange(n * n, dtype=np.uint32).reshape(n, n)
    a, b, c, d = at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]
    faces = np.stack([a, b, c, a, c, d], -1).reshape(-1, 3)
    return np.stack([x, y, np.sin(x) * np.sin(y)], -1).reshape(-1, 3), faces


def test_draw():
    """draw() makes the file that the program makes"""
    with open("cube.obj", "w", encoding="utf-8") as file:
        file.write(OBJ)
    recto.draw("cube.obj", "a.svg", azimuth=30, hidden="dashed", pens=2)
    options = ["--azimuth", "30", "--hidden", "dashed", "--pens", "2"]
    program = [os.environ["RECTO"], "cube.obj", "-o", "b.svg", *options]
    subprocess.run(program, check=True)
    with open("a.svg", "rb") as a, open("b.svg", "rb") as b:
        assert a.read() == b.read()


def test_options():
    """Options mean what they mean to the program"""
    with open("cube.obj", "w", encoding="utf-8") as file:
        file.write(OBJ)
    cases = [
        (["--view", "dimetric"], {"view": "dimetric"}),
        (["--view", "top", "--azimuth=9"], {"azimuth": 9, "view": "top"}),
        (["--camera=3,4,5"], {"camera": (3, 4, 5)}),
        (["--camera=3,4,5", "--ortho"], {"camera": (3, 4, 5), "ortho": True}),
        (["--camera=3,4,5", "--lookat=0,0,1"],
         {"camera": np.array([3, 4, 5]), "lookat": [0, 0, 1]}),
        (["--fov", "60"], {"fov": 60}),
        (["--page=A3", "--landscape"], {"landscape": True, "page": "A3"}),
        (["--portrait"], {"portrait": True}),
        (["--up=-z", "--scale=1:2", "--unit=in"],
         {"unit": "in", "up": "-z", "scale": 0.5}),
        (["--up=-Z", "--scale=1:2", "--unit=Inch"],
         {"unit": "Inches", "up": "-Z", "scale": 0.5}),
        (["--up=+x", "--scale=1:20", "--unit=Metre"],
         {"unit": "meters", "up": "+X", "scale": 0.05}),
        (["--edges=all,-smooth"], {"edges": "all,-smooth"}),
        (["--edges=-crease"], {"edges": ["-crease"]}),
        (["--pen-color=1=firebrick"], {"pen_color": {1: "firebrick"}}),
        (["--page=A5"], {"page": "A5"}),
        (["--page=80x60"], {"page": (80, 60), "margin": -1}),
        (["--scale=20:1", "--up=0,0,1"], {"scale": 20, "up": (0, 0, 1)}),
        (["--section=0.3", "--edges=all"], {"section": 0.3, "edges": "all"}),
        (["--edges=crease,border"], {"edges": ["crease", "border"]}),
        (["--crease=20,40"], {"crease": (20, 40)}),
        (["--crease=20"], {"crease": 20}),
        (["--crease-marks=none"], {"crease_marks": "none"}),
        (["--hidden=dashed,1"], {"hidden": ("dashed", 1)}),
        (["--sheet=third", "--scale=auto"], {"sheet": "third", "scale": "auto"}),
        (["--views=front,iso:2", "--hidden-in=iso=dashed", "--view-names"],
         {"views": ["front", ("iso", 2)], "hidden_in": {"iso": "dashed"},
          "view_names": True}),
        (["--sheet=first", "--hidden-in=left=layer", "--title=A"],
         {"sheet": "first", "hidden_in": {"left": "layer"}, "title": "A"}),
        (["--views=top,left"], {"views": "top,left"}),
        (["--detail=105,148,8,2", "--scale=20"],
         {"detail": (105, 148, 8, 2), "scale": 20}),
        (["--sheet=first", "--scale=20", "--detail=80,180,8,2"],
         {"sheet": "first", "scale": 20, "detail": [(80, 180, 8, 2)]}),
        (["--hidden=layer", "--pen-for=hidden=2,crease=3"],
         {"hidden": "layer", "pen_for": {"hidden": 2, "crease": 3}}),
        (["--pen-for=cube=2", "--pen-width=2=0.5", "--pen-colour=2=#c00"],
         {"pen_for": {"cube": 2}, "pen_width": {2: 0.5},
          "pen_colour": {2: "#c00"}}),
        (["--weights=crease=3"], {"weights": {"crease": 3}}),
        (["--title=a & b", "--desc=c", "--background=#ffe", "--id-prefix=x"],
         {"title": "a & b", "desc": "c", "background": "#ffe",
          "id_prefix": "x"}),
        (["--dash=crease=chain,hidden=2:1", "--hidden=dashed"],
         {"dash": {"crease": "chain", "hidden": "2:1"}, "hidden": "dashed"}),
        (["--fill=hatch", "--light=1,2,3", "--hatch-angle=30"],
         {"fill": "hatch", "light": (1, 2, 3), "hatch_angle": 30}),
        (["--fill=shade", "--seam=0.1"], {"fill": "shade", "seam": 0.1}),
        (["--fill=shade", "--ambient=0.1", "--fill-light=0"],
         {"fill": "shade", "ambient": 0.1, "fill_light": 0}),
        (["--method=warnock", "--divide=box"],
         {"method": "warnock", "divide": "box"}),
        (["--order=near", "--ids", "--path=polyline", "--precision=5"],
         {"order": "near", "ids": True, "path": "polyline", "precision": 5}),
    ]
    for words, options in cases:
        program = [os.environ["RECTO"], "cube.obj", "-o", "-", *words]
        said = subprocess.run(program, check=True, capture_output=True).stdout
        ours = recto.Scene.read("cube.obj").render(**options).to_bytes("svg")
        assert said == ours, words


def test_arrays():
    """A mesh in arrays, of any type and order, draws as its file does"""

    class Mesh:
        vertices, faces = VERTICES, FACES

    expected = recto.Scene.from_bytes(OBJ.encode(), "obj").render().svg()
    for scene in (
        cube(),
        recto.Scene(VERTICES.tolist(), FACES.tolist()),
        recto.Scene(VERTICES.astype(np.float32), FACES.astype(np.int32)),
        recto.Scene(VERTICES.astype(">f4"), FACES.astype(">i4")),
        recto.Scene(np.asfortranarray(VERTICES), FACES.astype(np.uint8)),
        recto.Scene(VERTICES[::-1], 7 - FACES[:, ::-1][:, ::-1]),
        recto.Scene(Mesh()),
    ):
        assert scene.render().svg() == expected
    recto.draw(Mesh(), "mesh.svg")
    with open("mesh.svg", encoding="utf-8") as file:
        assert file.read() == expected


def test_mixed():
    """Faces of different numbers of corners come as a list of lists"""
    house = np.vstack([VERTICES, [0.5, 2, 0.5]])
    walls = [list(f) for f in FACES if not (VERTICES[f][:, 1] == 1).all()]
    roof = [[2, 3, 8], [3, 7, 8], [7, 6, 8], [6, 2, 8]]
    scene = recto.Scene(house, walls + roof, ["wall"] * 5 + ["roof"] * 4)
    drawing = scene.render(results="faces")
    assert drawing.groups[-2:] == ["wall", "roof"]
    names = {drawing.groups[f.group] for f in drawing.fragments}
    assert names == {"wall", "roof"}


def test_strokes():
    """The strokes are those of the SVG, with their classes and layers"""
    drawing = cube().render(hidden="layer", precision=9, path="polyline")
    svg = ElementTree.fromstring(drawing.svg())
    lines = [e for e in svg.iter() if e.get("points")]
    height = drawing.page[1]
    assert len(lines) == len(drawing.strokes)
    for line, stroke in zip(lines, drawing.strokes):
        numbers = line.get("points").replace(",", " ").split()
        points = np.array(numbers, float).reshape(-1, 2)
        assert line.tag.endswith("polygon") == stroke.closed
        points[:, 1] = height - points[:, 1]
        assert np.allclose(points, stroke, rtol=0, atol=1e-8)
        assert drawing.layers[stroke.layer].label.endswith("hidden") == (
            stroke.hidden
        )
    assert {s.edge_class for s in drawing.strokes} == {"crease", "silhouette"}


def test_views():
    """Arrays are no copies: read-only views, which keep the drawing alive"""
    drawing = cube().render(results="all")
    stroke, edge = drawing.strokes[0], drawing.edges[0].intervals
    fragment = drawing.fragments[0]
    again = recto._drawing.Drawing(drawing._owner, drawing._given)
    assert np.shares_memory(stroke, again.strokes[0])
    assert np.shares_memory(edge, again.edges[0].intervals)
    assert np.shares_memory(fragment.exterior, drawing.half_edges)
    assert not stroke.flags.owndata and not stroke.flags.writeable
    views = [np.asarray(stroke)[1:], edge["t0"], fragment.exterior[:, 0]]
    copies = [v.copy() for v in views]
    del stroke, edge, fragment, drawing, again
    gc.collect()
    [cube().render(results="all") for _ in range(20)]
    assert all((v == c).all() for v, c in zip(views, copies))


def test_release():
    """The drawing is freed when nothing refers to it"""
    freed = []
    drawing = cube().render()
    owner = recto._library.ffi.gc(drawing._owner, lambda _: freed.append(1))
    drawing._owner = owner
    del owner
    view = np.asarray(drawing.strokes[0])[1:]
    del drawing
    gc.collect()
    assert not freed
    del view
    gc.collect()
    assert freed


def test_cube():
    """A cube has nine visible edges, and three behind one face"""
    drawing = cube().render(results="edges invisibility")
    seen = [e for e in drawing.edges if e.visible]
    hidden = [e for e in drawing.edges if not e.visible]
    assert len(seen) == 9 and len(hidden) == 3
    for edge in drawing.edges:
        assert edge.intervals["t0"][0] == 0 and edge.intervals["t1"][-1] == 1
    assert [e.intervals["hidden_by"].tolist() for e in hidden] == [[1]] * 3
    only = cube().render(results="edges")
    assert recto.NONE in [e.intervals["hidden_by"][0] for e in only.edges]


def test_fragments():
    """Fragments are polygons with holes that know their neighbours"""
    drawing = cube().render(view="front", results="faces")
    (front,) = drawing.fragments
    assert front.exterior.shape == (4, 2) and front.holes == []
    assert front.neighbours == () and len(front.sides) == 4
    drawing = cube().render(results="faces")
    assert [f.neighbours for f in drawing.fragments] == [(1, 2), (0, 2), (0, 1)]
    # A wall with a small square in front of its middle.
    wall = np.array([[0, 0, 0], [9, 0, 0], [9, 9, 0], [0, 9, 0]], float)
    small = (wall - [4.5, 4.5, 0]) / 3 + [4.5, 4.5, 1]
    scene = recto.Scene(np.vstack([wall, small]), [[0, 1, 2, 3], [4, 5, 6, 7]])
    fragments = scene.render(view="front", results="faces").fragments
    wall, small = sorted(fragments, key=lambda f: f.face)
    assert len(wall.holes) == 1 and len(small.holes) == 0
    assert {tuple(p) for p in wall.holes[0]} == {tuple(p) for p in small.exterior}
    assert (wall.sides["side"] == recto.SIDES["occluder"]).sum() == 4


def test_project():
    """Points are projected as the drawing was"""
    drawing = cube().render(results="edges")
    page, depth = drawing.project(VERTICES)
    for edge in drawing.edges:
        ends = edge.intervals["from_mm"][0], edge.intervals["to_mm"][-1]
        assert np.allclose(page[list(edge.points)], ends, atol=1e-5)
    assert depth[7] == depth.min() and page.shape == (8, 2)
    near = cube().render(camera=(0.5, 0.5, 5))
    page, depth = near.project([[0.5, 0.5, 9], [0.5, 0.5, 0]])
    assert np.isnan(page[0]).all() and np.isnan(depth[0]) and depth[1] == 5
    assert near.project(VERTICES[0])[0].shape == (2,)
    assert near.project(np.empty((0, 3)))[0].shape == (0, 2)
    raised(ValueError, near.project, [[1, 2], [3, 4]])


def test_not_asked():
    """What was not asked for is an error that says how to ask"""
    drawing = cube().render()
    for name, result in (("edges", "edges"), ("fragments", "faces")):
        error = raised(AttributeError, getattr, drawing, name)
        assert f"results={result!r}" in str(error)


def test_names():
    """A wrong option is a TypeError that lists near names"""
    error = raised(TypeError, cube().render, azimut=30)
    assert "azimuth" in str(error)
    error = raised(ValueError, cube().render, fill="hatched")
    assert "hatch" in str(error) and "shade" in str(error)
    error = raised(TypeError, cube().render, pen="thick")
    assert "pen" in str(error)
    raised(TypeError, cube().render, light=3)
    raised(TypeError, cube().render().svg, precison=3)


def test_every_option():
    """Each option of the program has a keyword, and each keyword a setter"""
    program = [os.environ["RECTO"], "--help"]
    text = subprocess.run(program, capture_output=True, text=True).stdout
    words = re.findall(r"^ +(?:-\w, |    )--([a-z-]+)", text, re.M)
    names = {word.replace("-", "_") for word in words}
    others = "output from turntable no_fit stats check tolerance quiet version help "
    others += "completion frames part join resume plan parts_plan"
    known = set(recto.Options.__annotations__)
    assert names - known == set(others.split()), names ^ known
    options = recto._options
    for name in known:
        assert name in options._FIELDS or hasattr(options._Setter, name), name
    for block, field in options._FIELDS.values():
        assert hasattr(getattr(options.Filled({}).at, block), field), field


def test_errors():
    """Errors carry the file and the line"""
    with open("bad.obj", "w", encoding="utf-8") as file:
        file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 1 oops 2\n")
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            recto.Scene.read("bad.obj").render()
        except recto.FormatError as error:
            said.append(error)
    assert any("bad.obj:5" in str(getattr(w, "message", w)) for w in said)
    with open("cut.ply", "wb") as file:
        file.write(b"ply\nformat ascii 1.0\nelement vertex 3\nproperty oops x\n")
    error = raised(recto.FormatError, recto.draw, "cut.ply", "no.svg")
    assert error.file == "cut.ply" and error.line == 4, (error.file, error.line)
    assert str(error).startswith("cut.ply:4: ") and error.status == "format"
    assert isinstance(raised(OSError, recto.Scene.read, "no.obj"), recto.Error)
    raised(recto.ArgumentError, cube().render, pen=1000)
    raised(recto.ArgumentError, recto.Scene, VERTICES, [[0, 1, 99]])
    raised(ValueError, recto.Scene, VERTICES, [[0, 1, -1]])
    raised(ValueError, recto.Scene, VERTICES[:, :2], FACES)
    raised(TypeError, recto.Scene, VERTICES, FACES + 0.5)
    raised(recto.EmptyError, recto.Scene().render)
    error = raised(recto.FormatError, recto.Scene.from_bytes, b"", "obj")
    assert str(error).startswith("line 1: "), str(error)
    raised(TypeError, recto.Scene.from_bytes, "v 0 0 0", "obj")
    for options, word in (({"page": (1, 2, 3)}, "width"),
                          ({"hidden": ("dashed", 1, 2)}, "dashed")):
        error = raised(ValueError, cube().render, **options)
        assert word in str(error) and "unpack" not in str(error), error
    for options in ({"sheet": "third", "view": "top"},
                    {"views": "front,top", "azimuth": 20},
                    {"view_names": True}, {"hidden_in": {"front": "dashed"}}):
        error = raised(TypeError, cube().render, **options)
        assert "sheet" in str(error), error


def test_warnings():
    """What the library warns of is a warning at the caller's line"""
    data = OBJ + "f 1 2 99\n"
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        recto.Scene.from_bytes(data.encode(), "obj", name="w.obj")
    assert [w.category for w in said] == [recto.Warning], said
    assert "w.obj:15" in str(said[0].message) and said[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        raised(recto.Warning, recto.Scene.from_bytes, data.encode(), "obj")


def test_progress():
    """A progress function is told the stages, may cancel, and may raise"""
    told = []
    cube().render(progress=lambda share, stage: told.append((share, stage)))
    assert told and all(0 <= share <= 1 and stage for share, stage in told)
    raised(recto.CancelledError, cube().render, progress=lambda *_: False)

    def fail(share, stage):
        raise LookupError("mine")

    raised(LookupError, cube().render, progress=fail)
    assert cube().render().svg() == cube().render(progress=lambda *_: None).svg()


def test_interrupt():
    """KeyboardInterrupt cancels a drawing"""
    # Shells start what is in the background with the signal ignored.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    vertices, faces = sheet(150)
    scene = recto.Scene(vertices, faces)
    drawing, calls = threading.Event(), []

    def interrupt():
        drawing.wait()
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    thread.start()

    def progress(share, stage):
        calls.append(stage)
        drawing.set()
        thread.join()  # now the signal was sent

    raised(KeyboardInterrupt, scene.render, progress=progress)
    assert 1 <= len(calls) <= 3, calls
    assert scene.render(view="front").strokes


def test_threads():
    """Python's other threads run while the library draws"""
    vertices, faces = sheet(200)
    scene = recto.Scene(vertices, faces)
    drawing, done, seen = threading.Event(), threading.Event(), []

    def look():
        drawing.wait()
        while not done.is_set():
            seen.append(drawing.is_set())
            done.wait(0.0005)

    thread = threading.Thread(target=look)
    thread.start()
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1000)  # only a lock that is released lets it run
    drawing.set()
    before = len(seen)
    scene.render(elevation=20)
    ran = len(seen) - before
    done.set()
    sys.setswitchinterval(interval)
    thread.join()
    assert ran > 3, ran


def test_writers():
    """Several threads write and ask one drawing at once"""
    written = []
    for _ in range(10):
        drawing = cube().render()
        texts = []

        def write(drawing=drawing, texts=texts):
            texts.append((drawing.svg(), len(drawing.strokes), drawing.stats))

        threads = [threading.Thread(target=write) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        written += texts
    assert len(written) == 80
    assert len({text[:2] for text in written}) == 1


def test_prepared():
    """A prepared scene is drawn by several threads at once, each the same"""
    scene = cube()
    scene.prepare()
    angles = range(0, 360, 30)
    expected = [cube().render(azimuth=a).svg() for a in angles]
    results = {}

    def render(angle):
        results[angle] = scene.render(azimuth=angle).svg()

    threads = [threading.Thread(target=render, args=(a,)) for a in angles]
    [t.start() for t in threads]
    [t.join() for t in threads]
    assert [results[a] for a in angles] == expected


def test_busy():
    """A scene that is being drawn cannot be changed, by whatever thread"""
    scene, held, kept = cube(), threading.Event(), threading.Event()

    def hold(share, stage):
        held.set()
        kept.wait()

    thread = threading.Thread(target=scene.render, kwargs={"progress": hold})
    thread.start()
    held.wait()
    for change in (lambda: scene.add_mesh(VERTICES, FACES), scene.prepare,
                   lambda: scene.add_group("late"),
                   lambda: scene.add_polyline(VERTICES)):
        error = raised(RuntimeError, change)
        assert "in use" in str(error), error
    assert scene.render().strokes  # reads it, as the other does
    kept.set()
    thread.join()
    scene.add_group("late")
    raised(RuntimeError, scene.render, progress=lambda *_: scene.prepare())
    raised(RuntimeError, scene.prepare, progress=lambda *_: scene.render())
    scene.prepare()


def test_late_options():
    """Options that a drawing no longer depends on are an error"""
    drawing = cube().render()
    assert drawing.svg(precision=1) != drawing.svg()
    error = raised(TypeError, drawing.svg, azimuth=30)
    assert "azimuth" in str(error) and "render" in str(error), error
    raised(TypeError, drawing.write, "late.svg", hidden="dashed")


def test_parts():
    """Parts of a drawing, joined, are the drawing"""
    options = {"hidden": "dashed", "ids": True}
    scene = cube()
    names = ["part-%d.recto" % number for number in (1, 2, 3)]
    for number, name in enumerate(names, 1):
        assert not scene.has_part(name, number, 3, **options)
        scene.write_part(name, number, 3, **options)
        assert scene.has_part(name, number, 3, **options)
    assert not scene.has_part(names[0], 2, 3, **options)
    whole = scene.render(**options).svg()
    assert recto.join(reversed(names), **options).svg() == whole
    error = raised(recto.ArgumentError, recto.join, names[:2], **options)
    assert "part 3 of the 3 parts is missing" in str(error), error
    error = raised(recto.UnsupportedError, recto.join, names, fill="shade")
    assert "--fill" in str(error), error
    with open("cube.obj", "w") as file:
        file.write(OBJ)
    read = recto.Scene.read_for_parts("cube.obj", **options)
    read.write_part("read.recto", 1, 1, **options)
    read = recto.Scene.read("cube.obj").render(**options).svg()
    assert recto.join(["read.recto"], **options).svg() == read


def test_planned_parts():
    """A part by a plan is the one without a plan"""
    options = {"hidden": "dashed", "ids": True}
    scene = cube()
    scene.write_plan("cube.plan", 2, **options)
    for number in (1, 2):
        scene.write_part("own.recto", number, 2, **options)
        assert not recto.has_planned_part("cube.plan", "planned.recto", number, 2)
        recto.write_planned_part("cube.plan", "planned.recto", number, 2)
        assert recto.has_planned_part("cube.plan", "planned.recto", number, 2)
        with open("own.recto", "rb") as own, open("planned.recto", "rb") as planned:
            assert own.read() == planned.read()
    wrong = "cube.plan", "planned.recto", 1, 3
    error = raised(recto.ArgumentError, recto.write_planned_part, *wrong)
    assert "the plan is one of 2 parts, not of 3" in str(error), error
    wrong = "cube.plan", "planned.recto", 1, 2
    error = raised(
        recto.UnsupportedError, recto.write_planned_part, *wrong, fill="shade"
    )
    assert "--fill" in str(error), error


def test_polyline():
    """A polyline is drawn, as class wire"""
    scene = cube()
    scene.add_group("path")
    scene.add_polyline([[0, 0, 2], [1, 0, 2], [1, 1, 2]])
    drawing = scene.render()
    wires = [s for s in drawing.strokes if s.edge_class == "wire"]
    assert wires and drawing.groups[wires[0].group] == "path"
    for wrong in ([[0, 0, 0]], np.empty((0, 3)), [[0, 0, 0], [0, np.nan, 0]], [1, 2]):
        raised(ValueError, scene.add_polyline, wrong)


def test_notebook():
    """A notebook shows the drawing; files of other formats are written"""
    drawing = cube().render()
    assert drawing._repr_svg_() == drawing.svg()
    assert drawing.to_bytes("svgz")[:2] == b"\x1f\x8b"
    drawing.write("cube.hpgl")
    assert os.path.getsize("cube.hpgl") > 0
    raised(recto.Error, drawing.write, "cube.unknown")
    assert drawing.stats and drawing.verdict is None
    assert "error" not in cube().render(verify=True).verdict


def test_check():
    """A drawing that lacks a line, or has one too many, is found"""
    cube().render().write("right.svg")
    verdict = cube().check("right.svg")
    assert verdict.false == verdict.missing == 0 and verdict.missing_at is None
    edge = 190 / 3**0.5  # the isometric cube is as wide as the page allows
    assert abs(verdict.drawn - 9 * edge) < 0.01
    verdict = cube().check("right.svg", view="trimetric")
    assert verdict.false > 6 * edge and verdict.missing > 6 * edge
    cube().render(edges="silhouette").write("few.svg")
    verdict = cube().check("few.svg")
    assert abs(verdict.missing - 3 * edge) < 1 and verdict.false == 0
    x, y = verdict.missing_at
    assert 10 < x < 200 and 38 < y < 259
    raised(recto.FileError, cube().check, "no.svg")
    raised(recto.CancelledError, cube().check, "few.svg", progress=lambda *_: False)


def test_pickle():
    """Errors and strokes are what they were when pickled and copied"""
    error = raised(recto.FileError, recto.Scene.read, "no.obj")
    assert error.filename == "no.obj" and "No such file" in error.strerror
    for again in (pickle.loads(pickle.dumps(error)), copy.copy(error)):
        assert type(again) is recto.FileError and str(again) == str(error)
        assert (again.file, again.status, again.filename) == ("no.obj", "io", "no.obj")
    stroke = cube().render().strokes[0]
    for again in (pickle.loads(pickle.dumps(stroke)), copy.deepcopy(stroke)):
        assert type(again) is recto.Stroke and (again == stroke).all()
        assert again.__dict__ == stroke.__dict__ and again.edge_class == "crease"


def test_values():
    """Wrong values are errors that name the option"""
    for name in ("light", "up", "camera", "lookat"):
        for value in ((1,), (1, 2, 3, 4), 5, ("x", 0, 0)):
            error = raised((TypeError, ValueError), cube().render, **{name: value})
            assert str(error).startswith(name), error
    for name, value in {"edges": 5, "pen_for": 3, "weights": [1], "page": (1,),
                        "pen": "thick", "device": 7, "pens": 1e9}.items():
        error = raised((TypeError, ValueError), cube().render, **{name: value})
        assert str(error).startswith(name) or "pens" in str(error), error
    raised(ValueError, cube().render, device="generic\0x")
    raised(ValueError, cube().add_group, "a\0b")
    raised(ValueError, recto.Scene, VERTICES, FACES, ["a\0b"] * 6)
    raised(TypeError, recto.Scene, VERTICES, FACES, [1] * 6)
    few = raised(recto.ArgumentError, recto.Scene, VERTICES, [[0, 1, 2], []])
    assert "face 1" in str(few)
    raised(ValueError, recto.Scene.read, "cut.ply\0")
    raised(ValueError, cube().render().write, "a.svg\0.txt")
    raised(ValueError, cube().render().to_bytes, "svg\0x")
    latin = recto.Scene.from_bytes(b"g gr\xfcn\n" + OBJ.encode(), "obj")
    name = latin.render().groups[-1]  # not UTF-8, and may be given again
    assert latin.render(pen_for={name: 2}).layers[-1].pen == 2
    latin.add_group(name)
    assert "Scene.read" in str(raised(TypeError, recto.Scene, "cut.ply"))
    drawing = cube().render(results=(w for w in ("edges", "faces")))
    assert drawing.edges and drawing.fragments and drawing.svg()
    for options in ({"order": "auto"}, {"fit": "scale", "scale": 10}):
        assert cube().render(**options).strokes
    assert set(recto.METHODS) >= {"auto", "newell", "brute"}


def test_many_fragments():
    """Fragments have a side for each of their points"""
    fragments = recto.Scene(*sheet(150)).render(view="front", results="faces").fragments
    assert len(fragments) > 30000
    for fragment in fragments[::997]:
        assert len(fragment.sides) == len(fragment.exterior) > 2
        assert fragment.exterior[0].tolist() == [
            fragment.sides["x_mm"][0], fragment.sides["y_mm"][0]]


def test_vocabulary():
    """Views and pages are those of the library"""
    assert recto.VIEWS["front"] == (0, 0) and len(recto.VIEWS) == 9
    assert recto.PAGES["a4"] == (210, 297) and len(recto.PAGES) == 9
    for name in recto.VIEWS:
        assert cube().render(view=name).strokes, name
    for name, size in recto.PAGES.items():
        assert cube().render(page=name).page == size


def test_seldom():
    """Python's lock is waited for every 10 ms at most, in each stage"""
    vertices, faces = sheet(150)
    scene = recto.Scene(vertices, faces)
    told = []
    before = time.monotonic()
    scene.render(edges="all", progress=lambda _, stage: told.append(stage))
    passed = time.monotonic() - before
    changes = sum(a != b for a, b in zip(told, told[1:]))
    assert changes <= len(told) <= changes + 2 + 100 * passed


def run():
    os.chdir(tempfile.mkdtemp(dir=os.environ.get("SCRATCH")))
    for name, test in list(globals().items()):
        if not name.startswith("test_"):
            continue
        try:
            test()
            result = "pass"
        except BaseException:
            traceback.print_exc()
            result = "fail"
        print(result, test.__doc__.splitlines()[0], flush=True)


if __name__ == "__main__":
    run()
