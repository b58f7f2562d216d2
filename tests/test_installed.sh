#!/bin/bash
# test_installed.sh - wherever the program is installed or moved to, it finds
# its importer, and says so where that is not there.
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
if test -x /usr/local/libexec/recto/recto-import; then
  skip "a missing importer is reported" "one is installed"
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
finish
