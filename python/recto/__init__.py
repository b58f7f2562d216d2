"""Exact visible lines and faces of 3D meshes, on paper.

    recto.draw("bunny.obj", "bunny.svg", azimuth=30, hidden="dashed")

    scene = recto.Scene(vertices, faces)
    drawing = scene.render(view="iso", page="A4", results="edges faces")
    drawing.strokes, drawing.edges, drawing.fragments, drawing.svg()

Lengths are millimetres of the page, angles degrees.  The options are those of
the program: see recto.Options."""

from ._drawing import SIDES, Drawing, Edge, Fragment, Layer, Stroke
from ._library import (
    ArgumentError,
    CancelledError,
    EmptyError,
    Error,
    FileError,
    FormatError,
    LimitError,
    OutOfMemoryError,
    UnsupportedError,
    VerifyError,
    Warning,
    lib,
    text_of,
)
from ._options import EDGE_CLASSES, METHODS, PAGES, VIEWS, Options
from ._scene import (
    Scene,
    Verdict,
    draw,
    has_planned_part,
    join,
    write_planned_part,
)

__version__ = text_of(lib.recto_version())
NONE: int = lib.RECTO_NONE

__all__ = [
    "ArgumentError",
    "CancelledError",
    "Drawing",
    "EDGE_CLASSES",
    "Edge",
    "EmptyError",
    "Error",
    "FileError",
    "FormatError",
    "Fragment",
    "Layer",
    "LimitError",
    "METHODS",
    "NONE",
    "Options",
    "OutOfMemoryError",
    "PAGES",
    "SIDES",
    "Scene",
    "Stroke",
    "UnsupportedError",
    "VIEWS",
    "Verdict",
    "VerifyError",
    "Warning",
    "draw",
    "has_planned_part",
    "join",
    "write_planned_part",
]
