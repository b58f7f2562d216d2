"""Scenes: meshes from arrays and files, and the calls that draw them."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple, Sequence

import numpy as np

from ._drawing import Drawing
from ._library import Call, Use, ffi, lib, path_of, text_to
from ._options import Filled, Options

try:
    from typing import Unpack
except ImportError:  # before Python 3.11
    Unpack = Any  # type: ignore[assignment]


def _corners(faces: Any) -> tuple[np.ndarray, np.ndarray | None, int]:
    """The corners of all faces, their offsets where the faces have different
    numbers of corners, and else that number."""
    offsets, size = None, 0
    if not isinstance(faces, np.ndarray):
        faces = list(faces)
        sizes = np.fromiter((len(face) for face in faces), np.int64, len(faces))
        if len(faces) > 0 and (sizes != sizes[0]).any():
            offsets = np.zeros(len(faces) + 1, np.uint32)
            np.cumsum(sizes, out=offsets[1:])
            faces = np.concatenate([np.asarray(face) for face in faces if len(face)])
    corners = np.asarray(faces)
    if corners.size == 0:
        return np.empty(0, np.uint32), None, 3
    if corners.dtype.kind not in "iu":
        raise TypeError(f"faces are indices, not {corners.dtype}")
    if offsets is None:
        if corners.ndim != 2:
            raise ValueError("faces: a row for each face, or a list of lists")
        size = corners.shape[1]
    if corners.min() < 0 or corners.max() >= lib.RECTO_NONE:
        raise ValueError("faces: an index is out of range")
    if corners.dtype.itemsize == 4 and corners.dtype.isnative:
        return np.ascontiguousarray(corners).view(np.uint32), offsets, size
    return np.ascontiguousarray(corners, np.uint32), offsets, size


def _make_drawing(make: Callable[[Filled, Any], int], options: Any) -> Drawing:
    """The drawing that a function of the library makes with these options."""
    given: dict[str, Any] = {"format": "svg", **options}
    for name, value in given.items():
        if isinstance(value, Iterator):  # the drawing uses it again
            given[name] = tuple(value)
    filled = Filled(given)
    drawing = ffi.new("recto_drawing **")
    status = make(filled, drawing)
    owner = drawing[0]
    if owner != ffi.NULL:
        owner = ffi.gc(owner, lib.recto_drawing_destroy)
    filled.call.finish(status)
    return Drawing(owner, given)


class Verdict(NamedTuple):
    """What Scene.check finds: lengths of lines in mm of the page."""

    drawn: float
    false: float  # of the drawn ones, hidden or of no edge
    visible: float  # of the requested edges
    missing: float  # of these, not drawn
    undecided: float  # counted as right
    false_at: tuple[float, float] | None  # the first of each
    missing_at: tuple[float, float] | None


class Scene:
    """Meshes and polylines, to be drawn.

    Scene(vertices, faces)  arrays as of add_mesh
    Scene(mesh)             an object with .vertices and .faces, such as those
                            of trimesh
    Scene()                 an empty one, to add to

    Several threads may render and check a scene at once.  To change or prepare
    it while a call uses it raises RuntimeError."""

    def __init__(
        self, vertices: Any = None, faces: Any = None, groups: Any = None
    ) -> None:
        call = Call()
        scene = ffi.new("recto_scene **")
        call.finish(lib.recto_scene_create(scene, call.error))
        self._owner = ffi.gc(scene[0], lib.recto_scene_destroy)
        self._use = Use("the scene")
        if vertices is not None:
            self.add_mesh(vertices, faces, groups)

    def _read(
        self,
        read: Callable[..., int],
        path: str | os.PathLike[str],
        model_format: str | None,
        options: Any,
    ) -> Scene:
        """Reads a model file by a function of the library."""
        filled = Filled(options)
        filled.call.finish(
            read(
                self._owner,
                path_of(path),
                text_to(model_format),
                filled.at,
                filled.call.error,
            )
        )
        return self

    @classmethod
    def read(
        cls,
        path: str | os.PathLike[str],
        /,
        model_format: str | None = None,
        **options: Unpack[Options],
    ) -> Scene:
        """Reads a model file; its format is that of its extension.  Colours,
        which OBJ has in its material libraries, are read for fill="paint"."""
        return cls()._read(lib.recto_scene_read, path, model_format, options)

    @classmethod
    def read_for_parts(
        cls,
        path: str | os.PathLike[str],
        /,
        model_format: str | None = None,
        **options: Unpack[Options],
    ) -> Scene:
        """Reads a model file for write_part and has_part alone, which read an
        OBJ file themselves, block by block: to other methods it is empty."""
        return cls()._read(
            lib.recto_scene_read_for_parts, path, model_format, options
        )

    @classmethod
    def from_bytes(
        cls,
        data: Any,
        model_format: str | None = None,
        name: str | os.PathLike[str] | None = None,
        **options: Unpack[Options],
    ) -> Scene:
        """Reads the bytes of a model file.  `name` is for messages; beside a
        file of that name the material libraries of OBJ are looked for."""
        scene = cls()
        filled = Filled(options)
        held = ffi.from_buffer(memoryview(data))
        filled.call.finish(
            lib.recto_scene_read_memory(
                scene._owner,
                held,
                len(held),
                text_to(model_format),
                ffi.NULL if name is None else path_of(name),
                filled.at,
                filled.call.error,
            )
        )
        return scene

    def add_mesh(
        self, vertices: Any, faces: Any = None, groups: Sequence[str] | None = None
    ) -> None:
        """Adds a mesh, all of it or, on an error, nothing.

        vertices  (n, 3); float32 counts as rounded to single precision.  Or an
                  object with .vertices and .faces
        faces     (m, k) indices of vertices, or a list of lists
        groups    a name for each face
        Arrays that are contiguous, of float32 or float64, and of 32-bit
        indices, are handed over without a copy; the library copies them."""
        if faces is None:
            try:
                vertices, faces = vertices.vertices, vertices.faces
            except AttributeError:
                kind = type(vertices).__name__
                raise TypeError(
                    f"{kind}: neither vertices and faces, nor an object that has "
                    "them; a file is read by Scene.read"
                ) from None
        points = np.asarray(vertices)
        single = points.dtype == np.float32
        points = np.ascontiguousarray(points, np.float32 if single else np.float64)
        if points.ndim != 2 or points.shape[1] != 3:
            raise ValueError(f"vertices: shape {points.shape} is not (n, 3)")
        corners, offsets, size = _corners(faces)
        mesh = ffi.new("recto_mesh *")
        kept: list[Any] = [points, corners, offsets]
        if single:
            mesh.points_single = ffi.from_buffer("float[]", points)
        else:
            mesh.points = ffi.from_buffer("double[]", points)
        mesh.point_count = len(points)
        mesh.corners = ffi.from_buffer("uint32_t[]", corners)
        mesh.corner_count = corners.size
        mesh.face_size = size
        if offsets is None:
            mesh.face_count = corners.size // size
        else:
            mesh.face_count = len(offsets) - 1
            mesh.face_offsets = ffi.from_buffer("uint32_t[]", offsets)
        if groups is not None:
            if len(groups) != mesh.face_count:
                raise ValueError(f"groups: {len(groups)} for {mesh.face_count} faces")
            names = list(dict.fromkeys(groups))
            index = {name: i for i, name in enumerate(names)}
            kept += [np.array([index[name] for name in groups], np.uint32)]
            mesh.face_groups = ffi.from_buffer("uint32_t[]", kept[-1])
            kept += [[ffi.new("char[]", text_to(name)) for name in names]]
            kept += [ffi.new("char *[]", kept[-1])]
            mesh.group_names = kept[-1]
            mesh.group_count = len(names)
        call = Call()
        with self._use.changing():
            call.finish(
                lib.recto_scene_add_mesh_sized(
                    self._owner, mesh, ffi.sizeof("recto_mesh"), call.error
                )
            )

    def add_polyline(self, points: Any) -> None:
        """Adds a polyline, (n, 3) points, which is drawn with class wire."""
        rows = np.ascontiguousarray(points, np.float64)
        if rows.ndim != 2 or rows.shape[1] != 3:
            raise ValueError(f"points: shape {rows.shape} is not (n, 3)")
        if len(rows) < 2 or not np.isfinite(rows).all():
            raise ValueError("points: a polyline has at least two, all finite")
        call = Call()
        index = ffi.new("uint32_t[]", len(rows))
        at = ffi.from_buffer("double[]", rows)
        with self._use.changing():
            for i in range(len(rows)):
                call.finish(
                    lib.recto_scene_add_point(
                        self._owner, at + 3 * i, index + i, call.error
                    )
                )
            call.finish(
                lib.recto_scene_add_polyline(
                    self._owner, index, len(rows), call.error
                )
            )

    def add_group(self, name: str) -> None:
        """Starts a group, which what is added later belongs to."""
        call = Call()
        with self._use.changing():
            call.finish(
                lib.recto_scene_add_group(self._owner, text_to(name), call.error)
            )

    def prepare(self, **options: Unpack[Options]) -> None:
        """Does once what views of the scene share; weld, coordinate_bits and
        crease count."""
        filled = Filled(options)
        with self._use.changing():
            filled.call.finish(
                lib.recto_scene_prepare(self._owner, filled.at, filled.call.error)
            )

    def render(self, **options: Unpack[Options]) -> Drawing:
        """Draws the scene for SVG files, or for those of `format`."""
        with self._use.reading():
            return _make_drawing(
                lambda filled, drawing: lib.recto_scene_render(
                    self._owner, filled.at, drawing, filled.call.error
                ),
                options,
            )

    def write_part(
        self,
        path: str | os.PathLike[str],
        number: int,
        count: int,
        /,
        **options: Unpack[Options],
    ) -> None:
        """Draws part `number`, from 1, of `count` of a drawing, a window of the
        page, and writes it to a file that join takes.  All parts take the
        options of the drawing."""
        filled = Filled({"format": "svg", **options})
        with self._use.reading():
            filled.call.finish(
                lib.recto_scene_write_part(
                    self._owner,
                    filled.at,
                    number,
                    count,
                    path_of(path),
                    filled.call.error,
                )
            )

    def has_part(
        self,
        path: str | os.PathLike[str],
        number: int,
        count: int,
        /,
        **options: Unpack[Options],
    ) -> bool:
        """Whether a file is the very part that write_part would write there,
        and whole."""
        filled = Filled({"format": "svg", **options})
        is_there = ffi.new("bool *")
        with self._use.reading():
            filled.call.finish(
                lib.recto_scene_has_part(
                    self._owner,
                    filled.at,
                    number,
                    count,
                    path_of(path),
                    is_there,
                    filled.call.error,
                )
            )
        return bool(is_there[0])

    def write_plan(
        self, path: str | os.PathLike[str], count: int, /, **options: Unpack[Options]
    ) -> None:
        """Makes the plan of `count` parts of a drawing, a file by which
        write_planned_part draws each of them without the model."""
        filled = Filled({"format": "svg", **options})
        with self._use.reading():
            filled.call.finish(
                lib.recto_scene_write_plan(
                    self._owner, filled.at, count, path_of(path), filled.call.error
                )
            )

    def check(
        self, path: str | os.PathLike[str], /, **options: Unpack[Options]
    ) -> Verdict:
        """Checks any program's drawing of the scene, an SVG file, by an
        independent ray caster: for the camera and the edge classes of the
        options, on the file's own page."""
        filled = Filled(options)
        found = ffi.new("recto_verdict *")
        with self._use.reading():
            filled.call.finish(
                lib.recto_scene_check_sized(
                    self._owner,
                    path_of(path),
                    filled.at,
                    found,
                    ffi.sizeof("recto_verdict"),
                    filled.call.error,
                )
            )
        at = found.false_at_mm, found.missing_at_mm
        return Verdict(
            found.drawn_mm,
            found.false_mm,
            found.visible_mm,
            found.missing_mm,
            found.undecided_mm,
            (at[0][0], at[0][1]) if found.false_mm > 0 else None,
            (at[1][0], at[1][1]) if found.missing_mm > 0 else None,
        )


def write_planned_part(
    plan: str | os.PathLike[str],
    path: str | os.PathLike[str],
    number: int,
    count: int,
    /,
    **options: Unpack[Options],
) -> None:
    """Draws part `number`, from 1, of `count` by a plan that Scene.write_plan
    wrote, and writes the file that Scene.write_part would write.  The plan says
    what is drawn; options are those of the solver."""
    filled = Filled(options)
    filled.call.finish(
        lib.recto_plan_write_part(
            path_of(plan), filled.at, number, count, path_of(path), filled.call.error
        )
    )


def has_planned_part(
    plan: str | os.PathLike[str],
    path: str | os.PathLike[str],
    number: int,
    count: int,
    /,
    **options: Unpack[Options],
) -> bool:
    """Whether a file is the very part that write_planned_part would write there,
    and whole."""
    filled = Filled(options)
    is_there = ffi.new("bool *")
    filled.call.finish(
        lib.recto_plan_has_part(
            path_of(plan),
            filled.at,
            number,
            count,
            path_of(path),
            is_there,
            filled.call.error,
        )
    )
    return bool(is_there[0])


def join(
    parts: Iterable[str | os.PathLike[str]], /, **options: Unpack[Options]
) -> Drawing:
    """Joins the parts of a drawing, all files that Scene.write_part wrote, in any
    order: the drawing that Scene.render makes of the whole, to the byte.  The
    options are those for ink and output; camera, page and mesh are the parts'."""
    paths = [ffi.new("char[]", path_of(path)) for path in parts]
    return _make_drawing(
        lambda filled, drawing: lib.recto_join_parts(
            ffi.new("char *[]", paths),
            len(paths),
            filled.at,
            drawing,
            filled.call.error,
        ),
        options,
    )


def draw(
    model: Any,
    output: str | os.PathLike[str],
    *,
    model_format: str | None = None,
    **options: Unpack[Options],
) -> None:
    """Draws a model to a file.

    model         path of a model file, a Scene, or an object with .vertices
                  and .faces
    output        path; its format is `format`, or that of its extension
    model_format  name of a format such as "obj"; None: by extension"""
    to = options.pop("format", None)
    if isinstance(model, (str, os.PathLike)):
        filled = Filled(options)
        filled.call.finish(
            lib.recto_draw_file(
                path_of(model),
                text_to(model_format),
                path_of(output),
                text_to(to),
                filled.at,
                filled.call.error,
            )
        )
        return
    name = lib.recto_output_format(path_of(output), text_to(to))
    if name != ffi.NULL:
        options["format"] = ffi.string(name).decode()
    scene = model if isinstance(model, Scene) else Scene(model)
    scene.render(**options).write(output, to)
