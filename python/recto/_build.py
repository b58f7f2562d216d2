"""The cffi builder: declares to Python what recto.h declares to C.

The declarations are those of the header itself, so they cannot differ from it.
The header and the library are found by pkg-config, or, where they are not
installed, in the source tree, or where RECTO_CFLAGS and RECTO_LIBS say.
"""

import os
import pathlib
import re
import shlex
import subprocess

from cffi import FFI


def _pkg_config(option):
    command = ["pkg-config", option, "recto"]
    try:
        return subprocess.run(
            command, check=True, capture_output=True, text=True
        ).stdout
    except (OSError, subprocess.CalledProcessError):
        return ""


def _in_tree():
    """Flags for the source tree that this file is in, if it is built."""
    top = pathlib.Path(__file__).resolve().parents[2]
    built = top / ".libs" / "librecto.so"
    if not built.exists():
        return "", ""
    libs = shlex.quote(str(built.parent))
    return (
        f"-I{shlex.quote(str(top / 'src'))}",
        f"-L{libs} -lrecto -Wl,-rpath,{libs}",
    )


def find_flags():
    """The compiler's and the linker's flags, and the path of the header."""
    cflags = os.environ.get("RECTO_CFLAGS") or _pkg_config("--cflags")
    libs = os.environ.get("RECTO_LIBS") or _pkg_config("--libs")
    if not libs:
        cflags, libs = _in_tree()
    cflags, libs = shlex.split(cflags), shlex.split(libs)
    folders = [flag[2:] for flag in cflags if flag.startswith("-I")]
    folders += ["/usr/local/include", "/usr/include"]
    for folder in folders:
        header = pathlib.Path(folder) / "recto.h"
        if header.exists():
            return cflags, libs or ["-lrecto"], header
    raise FileNotFoundError(
        "recto.h: neither pkg-config nor the source tree has it; "
        "install librecto, or set RECTO_CFLAGS and RECTO_LIBS"
    )


def declare(header):
    """What cffi reads: the header without comments and preprocessor lines,
    and with its numeric macros as constants."""
    text = re.sub(r"/\*.*?\*/", " ", header, flags=re.DOTALL)
    text = text.replace("\\\n", " ")
    text = re.sub(r"#ifdef __cplusplus.*?#endif", "", text, flags=re.DOTALL)
    constants = re.findall(
        r"^#define (RECTO_\w+) +(0x\w+|UINT32_MAX|[0-9.]+)u?\s*$", text, re.M
    )
    text = re.sub(r"^\s*#.*$", "", text, flags=re.M)
    text = text.replace("RECTO_USE_RESULT", "")
    for name, value in constants:
        if "." in value:
            text += f"static const double {name};\n"
        elif value.isdecimal():  # it may be the length of an array
            text += f"#define {name} {value}\n"
        else:
            text += f"#define {name} ...\n"
    return text


CALLBACKS = """
bool recto_python_poll(void *, double, const char *);
void recto_python_project(const recto_drawing *, size_t, const double *, double *,
                          double *);
extern "Python" bool recto_python_progress(void *, double, const char *);
extern "Python" void recto_python_warning(void *, const char *, unsigned long,
                                          const char *);
extern "Python" bool recto_python_write(void *, const void *, size_t);
"""


# The library asks thousands of times in a long drawing, and each time Python's
# lock is to be waited for: so Python is asked anew for each call and stage, and
# else every 10 ms.
SOURCE = """
#include <math.h>
#include <time.h>
#include "recto.h"

static void recto_python_project(const recto_drawing *drawing, size_t count,
                                 const double *point, double *page_mm,
                                 double *depth) {
  for (size_t i = 0; i < count; i++)
    if (!recto_drawing_project(drawing, point + 3 * i, page_mm + 2 * i, depth + i))
      page_mm[2 * i] = page_mm[2 * i + 1] = depth[i] = NAN;
}

static bool recto_python_progress(void *, double, const char *);

static bool recto_python_poll(void *user, double share, const char *stage) {
  static _Thread_local void *last_user;
  static _Thread_local const char *last_stage;
  static _Thread_local struct timespec last;
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (user == last_user && stage == last_stage &&
      1e9 * (now.tv_sec - last.tv_sec) + (now.tv_nsec - last.tv_nsec) < 1e7)
    return true;
  last_user = user;
  last_stage = stage;
  last = now;
  return recto_python_progress(user, share, stage);
}
"""


def make_builder():
    cflags, libs, header = find_flags()
    builder = FFI()
    builder.cdef(declare(header.read_text(encoding="utf-8")) + CALLBACKS)
    builder.set_source(
        "recto._recto",
        SOURCE,
        extra_compile_args=cflags,
        extra_link_args=libs,
    )
    return builder


if __name__ == "__main__":
    # Builds the extension beside this file.
    make_builder().compile(
        tmpdir=str(pathlib.Path(__file__).resolve().parents[1]), verbose=True
    )
