"""Options by the names of the command line, as recto_options takes them."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from typing import Any, Mapping, Sequence, TypedDict, Union

from ._library import Call, Progress, ffi, lib, text_of, text_to

Vector = Sequence[float]


class Options(TypedDict, total=False):
    """The options of drawings, by keyword; the names and the meanings are
    those of the program (`recto --help`).  Lengths are millimetres; contact,
    weld, near and section are in units of the scene, angles in degrees."""

    method: str
    contact: float
    weld: float
    coordinate_bits: int
    pitch: float
    resolution: int
    divide: str
    depth_bits: int
    subpixels: int
    remove_backs: bool
    threads: int

    view: str
    azimuth: float
    elevation: float
    camera: Vector
    lookat: Vector
    up: Union[str, Vector]  # "z", "-y", or such as (0, 0, 1)
    fov: float
    ortho: bool
    fit: str  # page (default), none, scale, sphere
    scale: Union[float, str]  # mm of page for a unit of the scene, or "auto"
    sheet: str  # first, third: angle projection, several views on one page
    views: Union[str, Sequence[Union[str, tuple[str, float]]]]
    # "front,top,iso:2", or ["front", "top", ("iso", 2)]
    view_names: bool  # drawn on the sheet
    detail: Union[Vector, Sequence[Vector]]
    # (x, y, radius, scale), or several: circles of the page drawn larger
    hidden_in: Mapping[str, str]  # {"iso": "none"}: of single views
    near: float
    section: float
    cut: Union[str, Vector, Sequence[Union[str, Vector]]]
    # "x=2", "y<3" or (nx, ny, nz, d), or up to three of them
    cut_fill: str  # hatch (default), solid, none
    cut_hatch: Mapping[str, Union[float, tuple[float, float]]]
    # {"wheel": 30}, or {"wheel": (30, 1.5)}: angle, and pitch

    page: Union[str, Sequence[float]]  # "A4", or (width, height)
    landscape: bool
    portrait: bool
    margin: float

    edges: Union[str, Iterable[str]]
    crease: Union[float, tuple[float, float]]  # 30, or (30, 45)
    crease_marks: str  # auto (default), none, all
    contours: str  # mesh (default), or smooth
    hidden: Union[str, tuple[str, int]]  # "dashed", or ("dashed", 2)
    dash: Mapping[str, str]  # {"crease": "chain", "hidden": "3:1"}
    fill: str
    seam: float
    hatch_pitch: float
    hatch_angle: float
    hatch_inset: bool
    light: Vector
    ambient: float
    fill_light: float
    pen: float
    pens: int
    pen_for: Mapping[str, int]  # {"crease": 2, "hidden": 3}
    pen_width: Mapping[int, float]
    pen_colour: Mapping[int, str]  # {2: "#cc0000"}, or {2: "firebrick"}
    pen_color: Mapping[int, str]  # the same
    weights: Mapping[str, float]
    order: str
    simplify: float
    curves: float  # mm
    min_stroke: float
    exact: bool
    ids: bool

    format: Union[str, None]
    unit: Union[float, str]  # the output's resolution, mm; or of scale: "m"
    precision: int
    path: str
    device: str
    velocity: float
    velocity_up: float
    tight: bool
    dpi: float
    title: str
    desc: str
    id_prefix: str
    background: str  # "none", "#ffe", "navy"

    verify: Union[bool, int]
    results: Union[str, Iterable[str]]  # edges, invisibility, faces
    progress: Progress  # called with the share done, 0 to 1, and the stage


# Options that a drawing that was made still heeds.
OF_OUTPUT = frozenset(
    "precision path device velocity tight dpi title desc id_prefix "
    "background progress".split()
)
METHODS = {
    text_of(lib.recto_method_name(i)): i
    for i in range(lib.RECTO_METHOD_COUNT)
    if lib.recto_method_is_available(i)
}
EDGE_CLASSES = {
    text_of(lib.recto_edge_class_name(1 << i)): 1 << i
    for i in range(lib.RECTO_EDGE_CLASS_COUNT)
}
CLASS_NAMES = {mask: name for name, mask in EDGE_CLASSES.items()}



def _named_pairs(name_at: Any) -> dict[str, tuple[float, float]]:
    """The words of the library for two numbers, in lower case."""
    pair = ffi.new("double[2]")
    pairs: dict[str, tuple[float, float]] = {}
    while word := text_of(name_at(len(pairs), pair, pair + 1)):
        pairs[word.lower()] = (pair[0], pair[1])
    return pairs


VIEWS = _named_pairs(lib.recto_view_name)
PAGES = _named_pairs(lib.recto_page_name)
RESULTS = {
    "edges": lib.RECTO_RESULT_EDGES,
    "invisibility": lib.RECTO_RESULT_INVISIBILITY,
    "faces": lib.RECTO_RESULT_FACES,
    "all": lib.RECTO_RESULTS_ALL,
}
_ARRANGEMENTS = {
    "first": lib.RECTO_ARRANGEMENT_FIRST,
    "third": lib.RECTO_ARRANGEMENT_THIRD,
}
_FITS = {
    "page": lib.RECTO_FIT_PAGE,
    "none": lib.RECTO_FIT_NONE,
    "scale": lib.RECTO_FIT_SCALE,
    "sphere": lib.RECTO_FIT_SPHERE,
}
_HIDDEN = {
    "none": lib.RECTO_HIDDEN_NONE,
    "dashed": lib.RECTO_HIDDEN_DASHED,
    "layer": lib.RECTO_HIDDEN_LAYER,
}
_UNITS = {"um": 0.001, "mm": 1, "cm": 10, "m": 1000, "in": 25.4, "ft": 304.8}
# Names of units, besides their plurals and the American spelling.
_UNIT_NAMES = {
    "\u00b5m": "um",
    "\u03bcm": "um",
    "micron": "um",
    "micrometre": "um",
    "millimetre": "mm",
    "centimetre": "cm",
    "metre": "m",
    "inch": "in",
    "inches": "in",
    "foot": "ft",
    "feet": "ft",
}
_AXES = {
    "x": (1, 0, 0),
    "y": (0, 1, 0),
    "z": (0, 0, 1),
    "-x": (-1, 0, 0),
    "-y": (0, -1, 0),
    "-z": (0, 0, -1),
}
_FILLS = {
    "none": lib.RECTO_FILL_NONE,
    "paint": lib.RECTO_FILL_PAINT,
    "shade": lib.RECTO_FILL_SHADE,
    "hatch": lib.RECTO_FILL_HATCH,
}

# Options whose value is stored as it is: the block and the field.
_FIELDS = {
    "contact": ("solver", "contact"),
    "pitch": ("solver", "pitch_mm"),
    "resolution": ("solver", "resolution"),
    "subpixels": ("solver", "subpixels"),
    "depth_bits": ("solver", "depth_bits"),
    "remove_backs": ("solver", "remove_backs"),
    "threads": ("solver", "threads"),
    "weld": ("mesh", "weld"),
    "coordinate_bits": ("mesh", "coordinate_bits"),
    "azimuth": ("camera", "azimuth_deg"),
    "elevation": ("camera", "elevation_deg"),
    "fov": ("camera", "fov_deg"),
    "near": ("camera", "near_distance"),
    "view_names": ("sheet", "names"),
    "margin": ("page", "margin_mm"),
    "seam": ("ink", "seam_mm"),
    "hatch_pitch": ("ink", "hatch_pitch_mm"),
    "hatch_angle": ("ink", "hatch_angle_deg"),
    "hatch_inset": ("ink", "hatch_inset"),
    "light": ("ink", "light"),
    "pen": ("ink", "pen_mm"),
    "pens": ("ink", "pens"),
    "simplify": ("ink", "simplify_mm"),
    "curves": ("ink", "curves_mm"),
    "min_stroke": ("ink", "min_stroke_mm"),
    "exact": ("ink", "exact"),
    "ids": ("ink", "ids"),
    "precision": ("output", "precision"),
    "tight": ("output", "tight"),
    "dpi": ("output", "dpi"),
    "velocity": ("output", "velocity_cm_s"),
    "velocity_up": ("output", "velocity_up_cm_s"),
}


def _word(name: str, value: Any, known: Mapping[str, Any]) -> Any:
    try:
        return known[value]
    except (KeyError, TypeError):
        words = ", ".join(known)
        raise ValueError(f"{name}: not {value!r}, but one of {words}") from None


def _unit(value: str) -> str:
    """The symbol of a unit that may be given by its name, in any case."""
    name = value.lower()
    single = name.removesuffix("s").replace("meter", "metre")
    return _UNIT_NAMES.get(name, _UNIT_NAMES.get(single, name))


def _vector(value: Any) -> list[float]:
    numbers = [float(x) for x in value]
    if len(numbers) != 3:
        raise ValueError(f"not {len(numbers)} numbers but three: x, y, z")
    return numbers


def _mask(name: str, value: Any, known: Mapping[str, int]) -> int:
    words = value.replace(",", " ").split() if isinstance(value, str) else value
    mask = 0
    for word in words:
        mask |= _word(name, word, known)
    return mask


def _plane(value: Any) -> dict[str, Any]:
    """A plane, "x=2" or (nx, ny, nz, d), as recto_plane has it."""
    if isinstance(value, str):
        axis, relation, number = value[:1], value[1:2], value[2:]
        if axis not in _AXES or relation not in ("=", ">", "<"):
            raise ValueError(f'not {value!r}, but such as "x=2" or "y<3"')
        sign = -1 if relation == "<" else 1
        normal = [sign * part for part in _AXES[axis]]
        return {"normal": normal, "offset": sign * float(number)}
    if len(value) != 4:
        raise ValueError(f"not {value!r}, but (nx, ny, nz, d)")
    return {"normal": list(value[:3]), "offset": value[3]}


class _Setter:
    """Sets the options that are more than a field.  What arrays and strings
    point to is kept."""

    def __init__(self, options: Any) -> None:
        self.options = options
        self.kept: list[Any] = []
        self.pens: dict[int, dict[str, Any]] = {}

    def text(self, value: str) -> Any:
        self.kept.append(ffi.new("char[]", text_to(value)))
        return self.kept[-1]

    def array(self, kind: str, items: Sequence[Any]) -> Any:
        self.kept.append(ffi.new(f"{kind}[]", list(items)))
        return self.kept[-1]

    def method(self, value: str) -> None:
        self.options.solver.method = _word("method", value, METHODS)

    def divide(self, value: str) -> None:
        self.options.solver.divide = _word(
            "divide",
            value,
            {"four": lib.RECTO_DIVIDE_FOUR, "box": lib.RECTO_DIVIDE_BOX},
        )

    def view(self, value: str) -> None:
        camera = self.options.camera
        camera.azimuth_deg, camera.elevation_deg = _word("view", value, VIEWS)

    def camera(self, value: Vector) -> None:
        self.options.camera.kind = lib.RECTO_CAMERA_EYE
        self.options.camera.eye = _vector(value)

    def lookat(self, value: Vector) -> None:
        self.options.camera.target = _vector(value)
        self.options.camera.has_target = True

    def ortho(self, value: bool) -> None:
        """Only takes away the default of 30 degrees: see `fill_in`."""

    def fit(self, value: str) -> None:
        self.options.camera.fit = _word("fit", value, _FITS)

    def scale(self, value: Union[float, str]) -> None:
        camera = self.options.camera
        if isinstance(value, str):
            camera.fit = _word("scale", value, {"auto": lib.RECTO_FIT_PREFERRED})
        else:
            camera.fit = lib.RECTO_FIT_SCALE
            camera.scale = value

    def sheet(self, value: str) -> None:
        self.options.sheet.arrangement = _word("sheet", value, _ARRANGEMENTS)

    def views(self, value: Any) -> None:
        items = []
        for view in value.split(",") if isinstance(value, str) else value:
            if isinstance(view, str):
                name, _, scale = view.partition(":")
                view = (name, float(scale) if scale else 0)
            if len(view) != 2:
                raise ValueError(f'not {view!r}, but a name or such as ("iso", 2)')
            _word("views", view[0], VIEWS)
            items.append({"name": self.text(view[0]), "scale": view[1]})
        sheet = self.options.sheet
        if sheet.arrangement == lib.RECTO_ARRANGEMENT_NONE:
            sheet.arrangement = lib.RECTO_ARRANGEMENT_FIRST
        sheet.view = self.array("recto_sheet_view", items)
        sheet.view_count = len(items)

    def detail(self, value: Any) -> None:
        one = isinstance(value[0], (int, float))
        items = []
        for numbers in [value] if one else value:
            if len(numbers) != 4:
                raise ValueError(f"not {numbers!r}, but (x, y, radius, scale)")
            items.append([*map(float, numbers), [0, 0]])
        sheet = self.options.sheet
        if sheet.arrangement == lib.RECTO_ARRANGEMENT_NONE:
            sheet.arrangement = lib.RECTO_ARRANGEMENT_FIRST
            sheet.view = self.array("recto_sheet_view", [{}])
            sheet.view_count = 1
        sheet.detail = self.array("recto_detail", items)
        sheet.detail_count = len(items)

    def hidden_in(self, value: Mapping[str, str]) -> None:
        sheet = self.options.sheet
        if sheet.view_count == 0:
            third = sheet.arrangement == lib.RECTO_ARRANGEMENT_THIRD
            self.views(["front", "top", "right" if third else "left"])
        for name, how in value.items():
            found = [
                sheet.view[i]
                for i in range(sheet.view_count)
                if text_of(sheet.view[i].name) == name
            ]
            if not found:
                raise ValueError(f"the view {name!r} is not on the sheet")
            found[0].has_hidden = True
            found[0].hidden = _word("hidden_in", how, _HIDDEN)

    def unit(self, value: Union[float, str]) -> None:
        """A number is the output's; a word the model's, for the scale."""
        if isinstance(value, str):
            self.options.camera.unit_mm = _word("unit", _unit(value), _UNITS)
        else:
            self.options.output.unit_mm = value

    def up(self, value: Union[str, Vector]) -> None:
        if isinstance(value, str):
            value = _word("up", value.lower().removeprefix("+"), _AXES)
        self.options.camera.up = _vector(value)

    def section(self, value: float) -> None:
        self.options.camera.section = value
        self.options.camera.has_section = True

    def cut(self, value: Any) -> None:
        one = isinstance(value, str) or (
            len(value) == 4 and not isinstance(value[0], (str, tuple, list))
        )
        planes = [_plane(plane) for plane in ([value] if one else value)]
        mesh = self.options.mesh
        mesh.cut_count = len(planes)
        if planes:
            mesh.cut = self.array("recto_plane", planes)

    def cut_fill(self, value: str) -> None:
        known = {
            "hatch": lib.RECTO_CUT_FILL_HATCH,
            "solid": lib.RECTO_CUT_FILL_SOLID,
            "none": lib.RECTO_CUT_FILL_NONE,
        }
        self.options.mesh.cut_fill = _word("cut_fill", value, known)

    def cut_hatch(self, value: Mapping[str, Any]) -> None:
        items = []
        for group, hatch in value.items():
            pair = isinstance(hatch, (tuple, list))
            angle, pitch = hatch if pair else (hatch, 0)
            items.append(
                {"group": self.text(group), "angle_deg": angle, "pitch_mm": pitch}
            )
        mesh = self.options.mesh
        mesh.cut_hatch_count = len(items)
        if items:
            mesh.cut_hatch = self.array("recto_cut_hatch", items)

    def page(self, value: Any) -> None:
        self.options.page.may_turn = isinstance(value, str)
        if isinstance(value, str):
            value = _word("page", value.lower(), PAGES)
        if len(value) != 2:
            raise ValueError(f"not {value!r}, but a name or (width, height)")
        self.options.page.width_mm, self.options.page.height_mm = value

    def landscape(self, value: bool) -> None:
        page = self.options.page
        sides = sorted([page.width_mm, page.height_mm])
        if value:
            page.height_mm, page.width_mm = sides
            page.may_turn = False

    def portrait(self, value: bool) -> None:
        page = self.options.page
        sides = sorted([page.width_mm, page.height_mm])
        if value:
            page.width_mm, page.height_mm = sides
            page.may_turn = False

    def edges(self, value: Any) -> None:
        known = {"none": 0, "all": lib.RECTO_EDGES_ALL, **EDGE_CLASSES}
        words = value.replace(",", " ").split() if isinstance(value, str) else value
        words = list(words)
        without = bool(words) and words[0].startswith("-")
        mask = lib.RECTO_EDGES_DEFAULT if without else 0
        for word in words:
            bits = _word("edges", word.removeprefix("-"), known)
            mask = mask & ~bits if word.startswith("-") else mask | bits
        self.options.ink.edges = mask

    def hidden(self, value: Any) -> None:
        if not isinstance(value, str) and len(value) != 2:
            raise ValueError(f'not {value!r}, but a word or such as ("dashed", 2)')
        how, layers = (value, 0) if isinstance(value, str) else value
        self.options.ink.hidden = _word("hidden", how, _HIDDEN)
        self.options.ink.hidden_by_max = layers

    def crease(self, value: Any) -> None:
        pair = isinstance(value, (tuple, list))
        angle, start = value if pair else (value, 0)
        self.options.mesh.crease_deg = angle
        self.options.mesh.crease_start_deg = start

    def crease_marks(self, value: str) -> None:
        known = {
            "auto": lib.RECTO_CREASE_MARKS_AUTO,
            "none": lib.RECTO_CREASE_MARKS_NONE,
            "all": lib.RECTO_CREASE_MARKS_ALL,
        }
        self.options.mesh.crease_marks = _word("crease_marks", value, known)

    def contours(self, value: str) -> None:
        known = {
            "mesh": lib.RECTO_CONTOURS_MESH,
            "smooth": lib.RECTO_CONTOURS_SMOOTH,
        }
        self.options.ink.contours = _word("contours", value, known)

    def fill(self, value: str) -> None:
        self.options.ink.fill = _word("fill", value, _FILLS)

    def ambient(self, value: float) -> None:
        self.options.ink.ambient = value
        self.options.ink.has_ambient = True

    def fill_light(self, value: float) -> None:
        self.options.ink.fill_light = value
        self.options.ink.has_fill_light = True

    def order(self, value: str) -> None:
        known = {
            "none": lib.RECTO_ORDER_NONE,
            "near": lib.RECTO_ORDER_NEAR,
            "auto": lib.RECTO_ORDER_AUTO,
        }
        self.options.ink.order = _word("order", value, known)

    def pen_for(self, value: Mapping[str, int]) -> None:
        uses = []
        for name, pen in value.items():
            use: dict[str, Any] = {"pen": pen}
            if name in EDGE_CLASSES:
                use["lines"] = lib.RECTO_LINES_OF_CLASS
                use["edge_class"] = EDGE_CLASSES[name]
            elif name == "hidden":
                use["lines"] = lib.RECTO_LINES_HIDDEN
            elif name == "hatch":
                use["lines"] = lib.RECTO_LINES_HATCH
            else:
                use["lines"] = lib.RECTO_LINES_OF_GROUP
                use["group"] = self.text(name)
            uses.append(use)
        self.options.ink.pen_use = self.array("recto_pen_use", uses)
        self.options.ink.pen_use_count = len(uses)

    def _change_pens(self, changes: Mapping[int, dict[str, Any]]) -> None:
        for number, change in changes.items():
            if not 1 <= number <= lib.RECTO_PEN_MAX:
                raise ValueError(f"pen {number}: pens count from 1")
            self.pens.setdefault(number, {}).update(change)
        most = max(self.pens, default=0)
        pens = [self.pens.get(i + 1, {}) for i in range(most)]
        self.options.ink.pen = self.array("recto_pen", pens)
        self.options.ink.pen_count = most

    def pen_width(self, value: Mapping[int, float]) -> None:
        self._change_pens({n: {"width_mm": mm} for n, mm in value.items()})

    def pen_colour(self, value: Mapping[int, str]) -> None:
        changes = {}
        for number, colour in value.items():
            read = ffi.new("uint32_t *")
            if not lib.recto_colour_parse(text_to(colour), read):
                raise ValueError(f"pen_colour: not {colour!r}, but as #cc0000")
            changes[number] = {"has_colour": True, "colour": read[0]}
        self._change_pens(changes)

    pen_color = pen_colour

    def weights(self, value: Mapping[str, float]) -> None:
        items = [
            {"edge_class": _word("weights", name, EDGE_CLASSES), "weight": w}
            for name, w in value.items()
        ]
        self.options.ink.has_weights = True
        self.options.ink.weight = self.array("recto_weight", items)
        self.options.ink.weight_count = len(items)

    def dash(self, value: Mapping[str, str]) -> None:
        items = []
        known = {"hidden": 0, **EDGE_CLASSES}
        for name, pattern in value.items():
            edge_class = _word("dash", name, known)
            dash = ffi.new("recto_dash *")
            if not lib.recto_dash_parse(text_to(pattern), dash):
                raise ValueError(f"dash: not {pattern!r}, but such as 3:1 or chain")
            dash.edge_class = edge_class
            dash.lines = (
                lib.RECTO_LINES_OF_CLASS if edge_class else lib.RECTO_LINES_HIDDEN
            )
            items.append(dash[0])
        self.options.ink.dash = self.array("recto_dash", items)
        self.options.ink.dash_count = len(items)

    def format(self, value: str | None) -> None:
        if value is not None:
            self.options.output.format = self.text(value)

    def path(self, value: str) -> None:
        known = {"path": False, "polyline": True}
        self.options.output.polyline = _word("path", value, known)

    def title(self, value: str) -> None:
        self.options.output.title = self.text(value)

    def desc(self, value: str) -> None:
        self.options.output.description = self.text(value)

    def id_prefix(self, value: str) -> None:
        self.options.output.id_prefix = self.text(value)

    def background(self, value: str) -> None:
        output = self.options.output
        output.background = lib.RECTO_BACKGROUND_NONE
        if value not in ("none", "transparent"):
            read = ffi.new("uint32_t *")
            if not lib.recto_colour_parse(text_to(value), read):
                raise ValueError(f"background: not {value!r}, but as #cc0000")
            output.background = lib.RECTO_BACKGROUND_COLOUR
            output.background_colour = read[0]

    def device(self, value: str) -> None:
        self.options.output.device = self.text(value)

    def verify(self, value: Any) -> None:
        self.options.verify = 4000 if value is True else int(value)

    def results(self, value: Any) -> None:
        self.options.results = _mask("results", value, RESULTS)

    def progress(self, value: Progress) -> None:
        """Is called by `Call`."""


def check_names(names: Iterable[str]) -> None:
    """Raises TypeError for a name that is no option, and lists near ones."""
    known = Options.__annotations__
    for name in names:
        if name not in known:
            near = difflib.get_close_matches(name, known, 3, 0.5)
            hint = f"; near: {', '.join(near)}" if near else ""
            raise TypeError(f"there is no option {name!r}{hint}")


def check_sheet(given: Mapping[str, Any]) -> None:
    """Raises TypeError for options that a sheet of views does not have, and for
    those that only a sheet has."""
    if "sheet" in given or "views" in given:
        for name in ("view", "azimuth", "elevation", "camera", "fov"):
            if name in given:
                raise TypeError(f"{name} is not for a sheet: its views say all of it")
        return
    for name in ("view_names", "hidden_in"):
        if given.get(name):
            raise TypeError(f"{name} is for a sheet: give sheet or views")


class Filled:
    """recto_options, as `at`, with what it points to, and its call."""

    def __init__(self, given: Mapping[str, Any]) -> None:
        check_names(given)
        check_sheet(given)
        self.call = Call(given.get("progress"))
        self.at = ffi.new("recto_options *")
        lib.recto_options_init_sized(self.at, ffi.sizeof("recto_options"))
        self.at.page.may_turn = True
        self.at.progress = ffi.addressof(lib, "recto_python_poll")
        self.at.warning = lib.recto_python_warning
        self.at.user = self.call.user
        self._setter = _Setter(self.at)
        # A view sets both angles, which may be given too; a page is turned
        # once its size is known, and views have hidden lines once they are.
        first = ("view", "page", "scale", "sheet", "views")
        last = ("landscape", "portrait", "hidden_in", "detail")
        names = [n for n in first if n in given]
        names += [n for n in given if n not in first + last]
        names += [n for n in last if n in given]
        for name in names:
            try:
                self._set(name, given[name])
            except (TypeError, ValueError, OverflowError, AttributeError) as error:
                if str(error).startswith(name):
                    raise
                kind = type(error)
                if kind is AttributeError:  # of a value of a wrong type
                    kind = TypeError
                raise kind(f"{name}: {error}") from None
        if "camera" in given and not given.get("ortho") and "fov" not in given:
            self.at.camera.fov_deg = 30

    def _set(self, name: str, value: Any) -> None:
        if name in _FIELDS:
            block, field = _FIELDS[name]
            if isinstance(value, Iterable) and not isinstance(value, str):
                value = _vector(value)
            setattr(getattr(self.at, block), field, value)
        else:
            getattr(self._setter, name)(value)
