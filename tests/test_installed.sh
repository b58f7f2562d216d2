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
    says "format 'off': cannot start the importer /.*: No such file"
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

link= # how a program is linked
# uses_it OPTION... - builds the README's first program as pkg-config says, and draws.
uses_it() {
  local pc
  pc=$staged$(grep '/recto\.pc$' files | sed 's/^\.//')
  awk '/^```c$/ { on = 1; next } on && /^```/ { exit } on' "$srcdir/README.md" \
    >user.c
  cp "$srcdir/examples/models/gears.obj" model.obj && rm -f model.svg
  # shellcheck disable=SC2046,SC2086 # several words each
  ${CC:-cc} -Wall -Werror $link user.c -o user $(PKG_CONFIG_SYSROOT_DIR=$staged \
    PKG_CONFIG_PATH=${pc%/*} pkg-config --cflags --libs "$@" recto) 2>log &&
    LD_LIBRARY_PATH=${pc%/pkgconfig/*} ./user && test -s model.svg && return 0
  say "$(head -n 3 log)" && false
}
if nm "$builddir"/.libs/librecto.* 2>/dev/null | grep -q __asan; then
  skip "a program is built by pkg-config" "built with sanitizers"
else
  if grep -q '/librecto\.so$' files; then
    claim "a program is built by pkg-config" uses_it
  fi
  if grep -q '/librecto\.a$' files; then
    claim "so it is by pkg-config --static" uses_it --static
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
