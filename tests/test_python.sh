#!/bin/bash
# test_python.sh - the Python package does what it says, the session in its
# documentation and the examples included.
. "$(dirname "$0")/tap.sh"

library=$builddir/.libs/librecto.so
can_build() {
  "$1" -c 'import cffi, numpy, setuptools, sysconfig, os
assert os.path.exists(sysconfig.get_path("include") + "/Python.h")' 2>/dev/null
}
python=
for each in ${PYTHON:-python3 /usr/bin/python3}; do
  if test -z "$python" && can_build "$each"; then
    python=$each
  fi
done
why=
if test -z "$python"; then
  why="no python3 with cffi, numpy, setuptools and Python.h"
elif ! test -e "$library"; then
  why="no shared library was built: configure with --enable-shared"
elif nm -D "$library" 2>/dev/null | grep -q __asan_init; then
  why="the library was built with sanitizers"
fi
if test -n "$why"; then
  skip "the Python package builds" "$why"
  finish
  exit
fi

# ---- The package is built and used as an installed one would be -----------

cp -R "$srcdir/python" "$scratch/source" && chmod -R u+w "$scratch/source"
builds() {
  (cd "$scratch/source" &&
    RECTO_CFLAGS="-I$srcdir/src" \
      RECTO_LIBS="-L$builddir/.libs -lrecto -Wl,-rpath,$builddir/.libs" \
      "$python" setup.py -q build --build-lib "$scratch/lib" \
      >"$scratch/log" 2>&1) || { say "$(tail -n 5 "$scratch/log")" && false; }
}
claim "the Python package builds" builds
export PYTHONPATH=$scratch/lib PYTHONDONTWRITEBYTECODE=1
export SCRATCH=$scratch RECTO=$recto
"$python" "$scratch/source/tests/test_recto.py" >"$scratch/results" \
  2>"$scratch/log"
said=$?
while read -r result text; do
  claim "$text" test "$result" = pass
done <"$scratch/results"
claim "the package's tests ran to their end" test "$said" -eq 0
if grep -q . "$scratch/log"; then
  say "$(tail -n 20 "$scratch/log")"
fi

# ---- As a wheel ------------------------------------------------------------

# The wheel is installed to a folder of its own, and draws from there.
wheel_draws() {
  (cd "$scratch" && unset PYTHONPATH &&
    RECTO_CFLAGS="-I$srcdir/src" \
      RECTO_LIBS="-L$builddir/.libs -lrecto -Wl,-rpath,$builddir/.libs" \
      "$python" -m pip wheel -q --no-deps --no-build-isolation \
      --disable-pip-version-check -w wheel ./source &&
    "$python" -m pip install -q --no-deps --no-index \
      --disable-pip-version-check --root-user-action=ignore \
      --target installed wheel/recto-*.whl &&
    test -e installed/recto/py.typed &&
    PYTHONPATH=installed "$python" -c 'import recto
assert "installed" in recto.__file__
recto.draw(recto.Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]), "w.svg")
' && grep -q '<path' w.svg) >"$scratch/log" 2>&1 ||
    { say "$(tail -n 5 "$scratch/log")" && false; }
}
if "$python" -c 'import pip, wheel' 2>/dev/null; then
  claim "a wheel is built from pyproject.toml, installed and draws" wheel_draws
else
  skip "a wheel is built from pyproject.toml, installed and draws" \
    "no pip and wheel"
fi

# ---- Types ----------------------------------------------------------------

cat >"$scratch/user.py" <<'PYTHON'
import recto

drawing = recto.Scene([[0, 0, 0]], [[0, 0, 0]]).render(view="iso", results="edges")
width: float = drawing.strokes[0].width
text: str = drawing.svg()
recto.draw("a.obj", "a.svg", azimuth=30, hidden="dashed")
recto.draw("a.obj", "a.svg", azimut=30)
recto.draw("a.obj", 3)
drawing.strokes[0].nothing
PYTHON
check_types() {
  "$python" -m mypy --enable-incomplete-feature=Unpack --cache-dir="$scratch/mypy" \
    "$@" >"$scratch/log" 2>&1
}
package_is_typed() {
  check_types "$scratch/source/recto" || { say "$(tail -n 5 "$scratch/log")" && false; }
}
faults_of_users() {
  ! MYPYPATH=$scratch/source check_types --strict --follow-imports=silent \
    "$scratch/user.py" && grep -o '^[^ ]*user.py:[0-9]*' "$scratch/log" |
    sed 's/.*://' | tr '\n' ' ' >"$scratch/lines"
  test "$(cat "$scratch/lines")" = "7 8 9 " ||
    { say "$(tail -n 5 "$scratch/log")" && false; }
}
if "$python" -c 'import mypy' 2>/dev/null; then
  claim "mypy finds no fault in the package" package_is_typed
  claim "and finds a wrong option, a wrong type and a wrong name in programs" \
    faults_of_users
else
  skip "mypy finds no fault in the package" "no mypy"
fi

# ---- Documentation and examples -------------------------------------------

cp "$srcdir"/examples/models/*.obj "$scratch"
cd "$scratch" || exit 1
session_is_true() {
  "$python" -m doctest "$srcdir/doc/python.md" >log 2>&1 ||
    { say "$(tail -n 20 log)" && false; }
}
claim "every output of the session in doc/python.md is what Python prints" \
  session_is_true
claim "it has at least twenty outputs" \
  test "$(grep -c '^>>> ' "$srcdir/doc/python.md")" -ge 20

# example NAME ARGUMENT... - runs; what it prints is in the file printed.
example() {
  "$python" "$srcdir/examples/python/$1.py" "${@:2}" >printed 2>log ||
    { say "$(tail -n 3 log)" && false; }
}
turntable() {
  example turntable turn 6 && test "$(find . -name 'turn*.svg' | wc -l)" -eq 6 &&
    grep -q '<path' turn005.svg && ! cmp -s turn000.svg turn001.svg
}
claim "examples/python/turntable.py draws a mesh from arrays all around" turntable
faces() {
  example faces castle.obj castle.geojson castle.wkt &&
    "$python" - <<'PYTHON'
import json
data = json.load(open("castle.geojson"))
polygons = [f["geometry"] for f in data["features"]]
area = lambda ring: sum(p[0] * q[1] - q[0] * p[1] for p, q in zip(ring, ring[1:]))
assert len(polygons) == sum(1 for _ in open("castle.wkt")) > 100
for polygon in polygons:
    assert polygon["type"] == "Polygon"
    for ring in polygon["coordinates"]:
        assert ring[0] == ring[-1] and len(ring) >= 4
        assert (area(ring) > 0) == (ring is polygon["coordinates"][0])
PYTHON
}
claim "examples/python/faces.py writes visible faces as GeoJSON and WKT" faces
hides() {
  example hides &&
    grep -q '^tower edge (8, 10) from 0.000 to 0.9.*first by tower face 11' printed &&
    grep -q '^tower edge (8, 10) from 0.9.* to 1.000:.*by tower face 9' printed
}
claim "examples/python/hides.py says which face hides which edge" hides
says_how() {
  ! "$python" "$srcdir/examples/python/$1.py" >printed 2>log &&
    grep -q "^python3 $1.py" log && ! grep -q Traceback log
}
for each in faces turntable; do
  claim "$each.py says how it is called" says_how "$each"
done
is_short() { test "$(wc -l <"$1")" -lt 60; }
for each in "$srcdir"/examples/python/*.py; do
  claim "$(basename "$each") has fewer than 60 lines" is_short "$each"
done
finish
