"""The extension module that cffi makes of recto.h."""

from typing import Any

ffi: Any
lib: Any
