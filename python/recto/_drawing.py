"""The drawing as data: arrays are views of the library's memory, which they
keep alive, and are read-only."""

from __future__ import annotations

import json
import os
import threading
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Mapping, NamedTuple

import numpy as np

from ._library import (
    ffi,
    index_of,
    lib,
    path_of,
    record_type,
    text_of,
    text_to,
    view,
)
from ._options import CLASS_NAMES, OF_OUTPUT, RESULTS, Filled, check_names

SIDES = {
    "edge": lib.RECTO_SIDE_EDGE,
    "occluder": lib.RECTO_SIDE_OCCLUDER,
    "intersection": lib.RECTO_SIDE_INTERSECTION,
    "clip": lib.RECTO_SIDE_CLIP,
}
_STATS_LOCK = threading.Lock()
_INTERVAL = record_type("recto_interval")
_LOOP = record_type("recto_loop")
_HALF_EDGE = record_type("recto_half_edge")


class Layer(NamedTuple):
    pen: int  # from 1; 0: a layer of fills
    label: str
    colour: str  # "#rrggbb"
    width: float  # of its pen, mm


class Stroke(np.ndarray):
    """A polyline: an (n, 2) array of points, x and y in mm of the page.

    edge_class        "silhouette" and so on; None: hatching, or text
    is_text           whether it is a line of a sheet's text
    hidden            whether it is a hidden part of a line
    closed            whether the last point joins the first
    width             mm
    layer             index of the drawing's layers
    face, edge, group their numbers, of its first segment; or None
    """

    edge_class: str | None = None
    is_text: bool = False
    hidden: bool = False
    closed: bool = False
    width: float = 0
    layer: int = 0
    face: int | None = None
    edge: int | None = None
    group: int | None = None

    def __array_finalize__(self, other: Any) -> None:
        if isinstance(other, Stroke):
            self.__dict__.update(other.__dict__)

    def __reduce__(self) -> Any:
        made: Any = super().__reduce__()
        return made[0], made[1], (made[2], self.__dict__)

    def __setstate__(self, state: Any) -> None:
        super().__setstate__(state[0])
        self.__dict__.update(state[1])


@dataclass(frozen=True, eq=False)
class Edge:
    """An edge of the requested classes, and its parts.

    points     numbers of points of the scene; None: of an intersection
    faces      numbers of the faces that meet in it; None: there is none
    number     what strokes have as `edge`; None: of an intersection
    intervals  a record for each part: t0 and t1 along the edge, from_mm and
               to_mm on the page, and hidden_by: 0 where it is visible, else
               the number of faces in front, or recto.NONE where that was not
               requested
    """

    edge_class: str
    points: tuple[int | None, int | None]
    faces: tuple[int | None, int | None]
    group: int | None
    number: int | None
    intervals: np.ndarray

    @property
    def visible(self) -> bool:
        """Whether a part of it is visible."""
        return bool((self.intervals["hidden_by"] == 0).any())


@dataclass(frozen=True, eq=False)
class Fragment:
    """A connected visible part of a face: a polygon with holes.

    brightness  by the light, to 1
    is_back     whether the face is seen from its back
    exterior    (n, 2) points in mm of the page, counter-clockwise, the first
                not repeated
    holes       such arrays, clockwise
    sides       its half-edges, a record for each, in the order of the points:
                side (see recto.SIDES), edge_class (a mask), edge and twin
    """

    face: int
    group: int | None
    colour: str
    brightness: float
    is_back: bool
    exterior: np.ndarray
    holes: list[np.ndarray]
    sides: np.ndarray
    _half_edges: np.ndarray = field(repr=False)  # of all fragments

    @property
    def neighbours(self) -> tuple[int, ...]:
        """The indices of the fragments beside it."""
        twins = self.sides["twin"][self.sides["twin"] != lib.RECTO_NONE]
        return tuple(np.unique(self._half_edges["fragment"][twins]).tolist())


def _colour(value: int) -> str:
    return f"#{value:06x}"


class Drawing:
    """What Scene.render makes.

    Its arrays are views of the library's memory and stay valid when the
    drawing itself is deleted."""

    def __init__(self, owner: Any, given: Mapping[str, Any]) -> None:
        self._owner = owner  # a recto_drawing * that frees itself
        self._given = dict(given)

    def _all(self, kind: str, count: int, fill: Any) -> Any:
        """Yields each of `count` structs, filled in by one and the same."""
        struct = ffi.new(f"{kind} *")
        for index in range(count):
            fill(self._owner, index, struct, ffi.sizeof(kind))
            yield struct

    @property
    def page(self) -> tuple[float, float]:
        """The page's width and height, mm."""
        size = ffi.new("double[2]")
        lib.recto_drawing_page(self._owner, size)
        return size[0], size[1]

    @cached_property
    def layers(self) -> list[Layer]:
        """The layers in the order in which they are drawn."""
        count = lib.recto_drawing_layer_count(self._owner)
        return [
            Layer(s.pen, text_of(s.label), _colour(s.colour), s.width_mm)
            for s in self._all("recto_layer", count, lib.recto_drawing_layer_sized)
        ]

    @cached_property
    def groups(self) -> list[str]:
        """The names of the scene's groups."""
        return [
            text_of(lib.recto_drawing_group_name(self._owner, i))
            for i in range(lib.recto_drawing_group_count(self._owner))
        ]

    @cached_property
    def strokes(self) -> list[Stroke]:
        """The lines in the order in which they are drawn."""
        count = lib.recto_drawing_stroke_count(self._owner)
        strokes = []
        for s in self._all("recto_stroke", count, lib.recto_drawing_stroke_sized):
            points = view(self._owner, s.points, (s.count, 2), np.float64)
            stroke = points.view(Stroke)
            stroke.edge_class = CLASS_NAMES.get(s.edge_class)
            stroke.is_text = s.is_text
            stroke.hidden = s.hidden
            stroke.closed = s.closed
            stroke.width = s.width_mm
            stroke.layer = s.layer
            stroke.face = index_of(s.face)
            stroke.edge = index_of(s.edge)
            stroke.group = index_of(s.group)
            strokes.append(stroke)
        return strokes

    def _require(self, result: str) -> None:
        kept = Filled({"results": self._given.get("results", ())}).at.results
        if not kept & RESULTS[result]:
            raise AttributeError(
                f"the drawing was made without its {result}: "
                f"render(results={result!r})"
            )

    @cached_property
    def edges(self) -> list[Edge]:
        """The edges of the requested classes that are on the page; of
        render(results="edges")."""
        self._require("edges")
        count = lib.recto_drawing_edge_count(self._owner)
        return [
            Edge(
                CLASS_NAMES[e.edge_class],
                (index_of(e.points[0]), index_of(e.points[1])),
                (index_of(e.faces[0]), index_of(e.faces[1])),
                index_of(e.group),
                index_of(e.number),
                view(self._owner, e.intervals, (e.interval_count,), _INTERVAL),
            )
            for e in self._all("recto_edge", count, lib.recto_drawing_edge_sized)
        ]

    def _array(self, get: Any, dtype: np.dtype) -> tuple[Any, np.ndarray]:
        count = ffi.new("size_t *")
        pointer = get(self._owner, count)
        return pointer, view(self._owner, pointer, (count[0],), dtype)

    @cached_property
    def loops(self) -> np.ndarray:
        """The boundaries of all fragments: records of half_edge, count and
        is_hole."""
        self._require("faces")
        return self._array(lib.recto_drawing_loops, _LOOP)[1]

    @cached_property
    def half_edges(self) -> np.ndarray:
        """The sides of all fragments: records of x_mm, y_mm, fragment, twin,
        side, edge_class and edge."""
        self._require("faces")
        return self._array(lib.recto_drawing_half_edges, _HALF_EDGE)[1]

    @cached_property
    def fragments(self) -> list[Fragment]:
        """The visible parts of faces; of render(results="faces")."""
        sides = self.half_edges
        starts = [*self.loops["half_edge"].tolist(), len(sides)]
        pointer = self._array(lib.recto_drawing_half_edges, _HALF_EDGE)[0]
        strides = (_HALF_EDGE.itemsize, 8)
        points = view(self._owner, pointer, (len(sides), 2), np.float64, strides)
        fragments = []
        count = lib.recto_drawing_fragment_count(self._owner)
        for f in self._all(
            "recto_fragment", count, lib.recto_drawing_fragment_sized
        ):
            # Loops, and their half-edges, come one behind the other.
            own = starts[f.loop : f.loop + f.loop_count + 1]
            rings = [points[a:b] for a, b in zip(own, own[1:])]
            fragments.append(
                Fragment(
                    f.face,
                    index_of(f.group),
                    _colour(f.colour),
                    f.brightness,
                    f.is_back,
                    rings[0],
                    rings[1:],
                    sides[own[0] : own[-1]],
                    sides,
                )
            )
        return fragments

    def project(self, points: Any) -> tuple[np.ndarray, np.ndarray]:
        """Where points of the scene lie on the page, and their depths.

        points  (n, 3) or (3,)
        Returns (n, 2) points in mm and n depths, in units of the scene, which
        grow away from the viewer; not a number for points that are not in
        front of the eye."""
        given = np.asarray(points, np.float64)
        if given.shape[-1:] != (3,):
            raise ValueError(f"points: shape {given.shape} is not (n, 3)")
        rows = np.ascontiguousarray(given.reshape(-1, 3))
        page = np.empty((len(rows), 2))
        depth = np.empty(len(rows))
        at = [ffi.from_buffer("double[]", a) for a in (rows, page, depth)]
        lib.recto_python_project(self._owner, len(rows), *at)
        return page.reshape(given.shape[:-1] + (2,)), depth.reshape(given.shape[:-1])

    @property
    def stats(self) -> dict[str, Any]:
        """Counts, times and choices, as --stats reports them."""
        with _STATS_LOCK:  # the text is the library's until the next call
            text = text_of(lib.recto_drawing_stats(self._owner))
        return json.loads(text)

    @property
    def verdict(self) -> str | None:
        """What verification found; None where it was not requested."""
        return text_of(lib.recto_drawing_verdict(self._owner)) or None

    # ---- Files ------------------------------------------------------------

    def _filled(self, options: Mapping[str, Any]) -> Filled:
        check_names(options)
        late = [name for name in options if name not in OF_OUTPUT]
        if late:
            raise TypeError(f"{late[0]} is an option of render, not of writing")
        return Filled({**self._given, **options})

    def to_bytes(self, format: str, **options: Any) -> bytes:
        """The drawing as a file of that format, such as "pdf"; `options` of
        the output change those of render."""
        filled = self._filled(options)
        filled.call.finish(
            lib.recto_drawing_write_to(
                self._owner,
                text_to(format),
                filled.at,
                lib.recto_python_write,
                filled.call.user,
                filled.call.error,
            )
        )
        return b"".join(filled.call.parts)

    def svg(self, **options: Any) -> str:
        """The drawing as the text of an SVG file."""
        return self.to_bytes("svg", **options).decode("utf-8")

    def _repr_svg_(self) -> str:
        return self.svg()

    def write(
        self,
        path: str | os.PathLike[str],
        format: str | None = None,
        **options: Any,
    ) -> None:
        """Writes the drawing, whole or not at all; its format is that of the
        path's extension."""
        filled = self._filled(options)
        filled.call.finish(
            lib.recto_drawing_write(
                self._owner,
                path_of(path),
                text_to(format),
                filled.at,
                filled.call.error,
            )
        )

    def __repr__(self) -> str:
        width, height = self.page
        count = lib.recto_drawing_stroke_count(self._owner)
        return f"<recto.Drawing {width:g} x {height:g} mm, {count} strokes>"
