#!/bin/bash
# test_installed.sh - what make install puts where, for users of the library
# and of the program; wherever the program is installed or moved to, it finds its
# importer, and says so where that is not there.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"

importer=${RECTO_IMPORT:-none}
unset RECTO_IMPORT
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >model.off
mkdir -p "moved tree/bin" "moved tree/libexec/recto" elsewhere
cp "$recto" "moved tree/bin/recto"
recto="$PWD/moved tree/bin/recto"

no_importer() {
  cd elsewhere && run 2 ../model.off -o no.svg && ! test -e no.svg &&
    says "format 'off': cannot start the importer /.*: No such file.*obj, ply and stl alone"
}
prefix=$(sed -n 's/^prefix = //p' "$builddir/Makefile")
if test -x "$prefix/libexec/recto/recto-import"; then
  skip "a missing importer is reported" "one is installed"
elif ! test -x "$importer"; then
  skip "a missing importer is reported" "no Assimp"
else
  claim "a missing importer is reported" no_importer
fi
cd "$scratch" || exit 1

finds_it() {
  cd elsewhere && run 0 ../model.off -o a.svg && test -s a.svg
}
if test -x "$importer"; then
  cp "$importer" "moved tree/libexec/recto/"
  claim "an installed tree that was moved finds its importer" finds_it
  cd "$scratch" && mkdir -p links && ln -s "$recto" links/recto
  recto=$PWD/links/recto
  claim "so it does where a link leads to the program" finds_it
else
  skip "an installed tree that was moved finds its importer" "no Assimp"
fi
cd "$scratch" || exit 1

# ---- make install -----------------------------------------------------------

staged=$scratch/staged
unset MAKEFLAGS MFLAGS MAKELEVEL
if ! make -q -C "$builddir" all >/dev/null 2>&1; then
  skip "make install fills an empty folder" "not everything is built"
  finish
fi
installs() {
  make -s -C "$builddir" install DESTDIR="$staged" >install.log 2>&1 &&
    (cd "$staged" && find . -type f -o -type l) >files && return 0
  say "$(tail -n 3 install.log)" && false
}
claim "make install fills an empty folder" installs
for file in bin/recto include/recto.h pkgconfig/recto.pc man1/recto.1 man3/recto.3 \
  bash-completion/completions/recto zsh/site-functions/_recto; do
  claim "it has $file" grep -q "/$file\$" files
done
claim "no path of the build is in the files that are text" \
  eval '! grep -rIlF "$builddir" "$staged" | grep .'

pc=$staged$(grep '/recto\.pc$' files | sed 's/^\.//')
# with_flags COMMAND... - with pkg-config and the loader as the installed tree
# has them.
with_flags() {
  PKG_CONFIG_SYSROOT_DIR=$staged PKG_CONFIG_PATH=${pc%/*} \
    LD_LIBRARY_PATH=${pc%/pkgconfig/*} "$@"
}
link= # how a program is linked
# uses_it OPTION... - builds the README's first program as pkg-config says, and draws.
uses_it() {
  awk '/^```c$/ { on = 1; next } on && /^```/ { exit } on' "$srcdir/README.md" \
    >user.c
  cp "$srcdir/examples/models/gears.obj" model.obj && rm -f model.svg
  # shellcheck disable=SC2046,SC2086 # several words each
  ${CC:-cc} -Wall -Werror $link user.c -o user $(with_flags \
    pkg-config --cflags --libs "$@" recto) 2>log &&
    with_flags ./user && test -s model.svg && return 0
  say "$(head -n 3 log)" && false
}
# example NAME ARGUMENT... - builds one of the examples so, and runs it; what it
# prints or writes is not empty.
example() {
  # shellcheck disable=SC2046 # several words
  ${CC:-cc} -std=c11 -pedantic -Wall -Werror "$srcdir/examples/$1.c" -o "$1" \
    $(with_flags pkg-config --cflags --libs $static recto) -lm 2>log &&
    with_flags "./$1" "${@:2}" >"$1.out" 2>log &&
    cat "$1.out" example*.svg turn*.svg 2>/dev/null | grep -q . && rm -f ./*.svg &&
    return 0
  say "$(head -n 3 log)" && false
}
python_finds_it() {
  cp -R "$srcdir/python" package && chmod -R u+w package &&
    (cd package && with_flags /usr/bin/python3 setup.py -q build --build-lib ../lib) \
      >log 2>&1 &&
    PYTHONPATH=lib with_flags /usr/bin/python3 -c 'import recto
recto.draw("model.obj", "python.svg")' 2>log && grep -q "<path" python.svg &&
    return 0
  say "$(tail -n 3 log)" && false
}
if nm "$builddir"/.libs/librecto.* 2>/dev/null | grep -q __asan; then
  skip "a program is built by pkg-config" "built with sanitizers"
else
  if grep -q '/librecto\.so$' files; then
    claim "a program is built by pkg-config" uses_it
  fi
  static=--static
  if grep -q '/librecto\.so$' files; then
    static=
  fi
  cp "$srcdir/examples/models/gears.obj" model.obj
  claim "example draw runs with the installed library" \
    example draw model.obj example.svg
  claim "so does surface" example surface example.svg
  claim "so does turntable" example turntable model.obj 3
  for name in dxf gcode faces hides; do
    claim "so does $name" example "$name" model.obj
  done
  if test -z "$static" && /usr/bin/python3 -c 'import cffi, numpy, setuptools
import os, sysconfig
assert os.path.exists(sysconfig.get_path("include") + "/Python.h")' 2>/dev/null; then
    claim "the Python package finds it by pkg-config" python_finds_it
  else
    skip "the Python package finds it by pkg-config" "no cffi or no librecto.so"
  fi
  if grep -q '/librecto\.a$' files; then
    claim "a program is built by pkg-config --static" uses_it --static
    what="and so it is where all libraries are static"
    echo 'int main(void) { return 0; }' >empty.c
    # shellcheck disable=SC2046 # several words each
    if ${CC:-cc} -static empty.c -o empty $(pkg-config --static --libs \
      $(sed -n 's/^Requires.private://p' "$builddir/recto.pc")) 2>log; then
      link=-static
      claim "$what" uses_it --static
    else
      skip "$what" "$(head -n 1 log)"
    fi
  fi
fi
finish
