"""Calls of the library: errors become exceptions, warnings Python's warnings,
and what a callback raises is raised where the library was called."""

from __future__ import annotations

import os
import sys
import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Callable, ContextManager

import numpy as np

from ._recto import ffi, lib


def _with_place(file: str, line: int, text: str) -> str:
    place = file
    if line:
        place = f"{file}:{line}" if file else f"line {line}"
    return f"{place}: {text}" if place else text


class Error(Exception):
    """A call of the library failed.

    status  the library's word for what went wrong, such as "format"
    file    the file at fault; "" where there is none
    line    its line, from 1; 0 where none is at fault
    text    one sentence
    """

    def __init__(self, status: str, file: str, line: int, text: str) -> None:
        # Not OSError's, whose arguments are others.
        Exception.__init__(self, status, file, line, text)
        self.status = status
        self.file = file
        self.line = line
        self.text = text

    def __reduce__(self) -> Any:
        return type(self), (self.status, self.file, self.line, self.text)

    def __str__(self) -> str:
        return _with_place(self.file, self.line, self.text)


class ArgumentError(Error, ValueError):
    """An option or argument makes no sense."""


class OutOfMemoryError(Error, MemoryError):
    """An allocation failed."""


class FileError(Error, OSError):
    """A file could not be read or written."""

    def __init__(self, status: str, file: str, line: int, text: str) -> None:
        super().__init__(status, file, line, text)
        self.filename = file or None
        self.strerror = text


class FormatError(Error, ValueError):
    """A model file is broken or truncated."""


class UnsupportedError(Error):
    """The library was built without this, or it is not meant for this."""


class EmptyError(Error):
    """There is nothing to draw."""


class LimitError(Error):
    """A stated limit was passed."""


class CancelledError(Error):
    """The progress function returned False."""


class VerifyError(Error):
    """Verification found the drawing wrong."""


class Warning(UserWarning):
    """A bad element that was skipped, a clipped stroke."""


_ERRORS: dict[int, type[Error]] = {
    lib.RECTO_ERROR_ARGUMENT: ArgumentError,
    lib.RECTO_ERROR_MEMORY: OutOfMemoryError,
    lib.RECTO_ERROR_IO: FileError,
    lib.RECTO_ERROR_FORMAT: FormatError,
    lib.RECTO_ERROR_UNSUPPORTED: UnsupportedError,
    lib.RECTO_ERROR_EMPTY: EmptyError,
    lib.RECTO_ERROR_LIMIT: LimitError,
    lib.RECTO_ERROR_CANCELLED: CancelledError,
    lib.RECTO_ERROR_VERIFY: VerifyError,
}

Progress = Callable[[float, str], Any]


def text_of(characters: Any) -> str:
    """A string of the library; "" for NULL."""
    if characters == ffi.NULL:
        return ""
    return ffi.string(characters).decode("utf-8", "surrogateescape")


def _whole(text: bytes) -> bytes:
    if b"\0" in text:
        raise ValueError(f"a NUL character in {text!r}")
    return text


def path_of(path: Any) -> bytes:
    return _whole(os.fsencode(path))


def text_to(text: str | None) -> Any:
    """What a `const char *` argument takes; NULL for None."""
    if text is None:
        return ffi.NULL
    if not isinstance(text, str):
        raise TypeError(f"a str is expected, not {type(text).__name__}")
    return _whole(text.encode("utf-8", "surrogateescape"))


def index_of(number: int) -> int | None:
    return None if number == lib.RECTO_NONE else number


class Use:
    """Who uses an object: several that read it, or one that changes it.  What
    does not fit raises RuntimeError, also in a callback of the other use."""

    def __init__(self, what: str) -> None:
        self._what = what
        self._lock = threading.Lock()
        self._users = 0  # -1: one that changes it

    @contextmanager
    def _as(self, step: int, is_free: Callable[[], bool]) -> Iterator[None]:
        with self._lock:
            if not is_free():
                raise RuntimeError(f"{self._what} is in use by another call")
            self._users += step
        try:
            yield
        finally:
            with self._lock:
                self._users -= step

    def reading(self) -> ContextManager[None]:
        return self._as(1, lambda: self._users >= 0)

    def changing(self) -> ContextManager[None]:
        return self._as(-1, lambda: self._users == 0)


class Call:
    """What the callbacks of one call of the library share: `user` points here.

    parts  receives what recto_drawing_write_to writes
    """

    def __init__(self, progress: Progress | None = None) -> None:
        self.progress = progress
        self.raised: BaseException | None = None
        self.warned: list[str] = []
        self.parts: list[bytes] = []
        self.user = ffi.new_handle(self)
        self.error = ffi.new("recto_error *")

    def finish(self, status: int) -> None:
        """Ends the call: raises what is to be raised, and warns."""
        if self.raised is not None:
            raise self.raised
        if status != lib.RECTO_OK:
            raise _ERRORS.get(status, Error)(
                text_of(lib.recto_status_name(status)),
                text_of(self.error.file),
                self.error.line,
                text_of(self.error.text),
            )
        for text in self.warned:
            warnings.warn(text, Warning, stacklevel=_caller_level())


def _caller_level() -> int:
    """The level of the first frame outside of this package, for warn()."""
    folder = os.path.dirname(__file__)
    level, frame = 1, sys._getframe(1)
    while frame.f_back and frame.f_code.co_filename.startswith(folder):
        level, frame = level + 1, frame.f_back
    return level


# ---- Callbacks ------------------------------------------------------------
# Python runs the handlers of signals when a callback begins: there
# KeyboardInterrupt is raised, and the call of the library is cancelled.


def _keep(kind: Any, value: BaseException, traceback: Any) -> None:
    """Keeps what a callback raised, to raise it again after the call."""
    user = traceback.tb_frame.f_locals.get("user") if traceback else None
    if user is not None:
        ffi.from_handle(user).raised = value


@ffi.def_extern(name="recto_python_progress", error=False, onerror=_keep)
def _progress(user: Any, share: float, stage: Any) -> bool:
    call = ffi.from_handle(user)
    if call.progress is None:
        return True
    return call.progress(share, text_of(stage)) is not False


@ffi.def_extern(name="recto_python_warning", onerror=_keep)
def _warning(user: Any, file: Any, line: int, text: Any) -> None:
    ffi.from_handle(user).warned.append(
        _with_place(text_of(file), line, text_of(text))
    )


@ffi.def_extern(name="recto_python_write", error=False, onerror=_keep)
def _write(user: Any, data: Any, count: int) -> bool:
    ffi.from_handle(user).parts.append(ffi.buffer(data, count)[:])
    return True


# ---- Arrays of the library -------------------------------------------------


class _Memory:
    """Memory that `owner` keeps alive, as numpy sees it: read-only."""

    def __init__(self, owner: Any, pointer: Any, interface: dict) -> None:
        self.owner = owner
        address = int(ffi.cast("uintptr_t", pointer))
        self.__array_interface__ = {
            "version": 3,
            "data": (address, True),
            **interface,
        }


def view(
    owner: Any,
    pointer: Any,
    shape: tuple[int, ...],
    dtype: Any,
    strides: tuple[int, ...] | None = None,
) -> np.ndarray:
    """An array at `pointer`, without a copy; it keeps `owner` alive."""
    dtype = np.dtype(dtype)
    if 0 in shape:
        return np.empty(shape, dtype)
    # A record goes as bytes: its type may have padding, which has no name.
    typestr = f"|V{dtype.itemsize}" if dtype.names else dtype.str
    interface = {"shape": shape, "typestr": typestr, "strides": strides}
    return np.asarray(_Memory(owner, pointer, interface)).view(dtype)


def record_type(name: str) -> np.dtype:
    """The numpy type of a struct of the library, from its declaration."""

    def convert(kind: Any) -> Any:
        if kind.kind == "array":
            return np.dtype((convert(kind.item), kind.length))
        if kind.kind == "enum":
            return np.dtype(f"u{ffi.sizeof(kind)}")
        return np.dtype({"_Bool": "?", "double": "f8", "uint32_t": "u4"}[kind.cname])

    kind = ffi.typeof(name)
    fields = [(f, d.offset, convert(d.type)) for f, d in kind.fields]
    return np.dtype(
        {
            "names": [f for f, _, _ in fields],
            "offsets": [o for _, o, _ in fields],
            "formats": [t for _, _, t in fields],
            "itemsize": ffi.sizeof(name),
        }
    )
