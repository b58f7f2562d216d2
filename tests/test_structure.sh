#!/bin/bash
# test_structure.sh - the structure of the code: which files may include which,
# where tolerances are defined, which symbols the library exports.  Each check is
# shown to fail on a violation planted in a copy.
. "$(dirname "$0")/tap.sh"

# ---- The checks: each prints what is wrong in the tree at $1 --------------

sources() {
  (cd "$1" && find src backends -name '*.[ch]' | LC_ALL=C sort)
}

# A file includes its own layer or a lower one.  Writers see base and the
# drawing alone, the judge base and the scene, the program base and recto.h;
# readers and writers never include each other.
#
# Within visibility and ink the folders have floors too: a folder includes
# itself, lower floors, and the headers that lie in the layer itself, which
# include no folder.  So no method of visibility includes another one.  The
# sources that lie in the layer itself (the choice of a method, the phases of
# ink) stand above all.
check_includes() {
  (cd "$1" && sources . | xargs grep -n '^ *# *include *"' /dev/null) |
    awk -F: '
      BEGIN {
        split("base geom scene view visibility drawing ink backends judge api " \
              "cli import", name, " ")
        for (i in name)
          layer[name[i]] = i - 1
        place("visibility", 1, "predicate")
        place("visibility", 2, "index")
        place("visibility", 3, "intersection fragments")
        place("visibility", 4, "pairwise scan")
        place("visibility", 5, "raster")
        place("visibility", 6, "brute newell scanline_zbuffer tiles warnock " \
              "watkins zbuffer")
        place("ink", 1, "lines")
        place("ink", 2, "fill order")
        place("ink", 3, "hatch")
      }
      function place(of, level, rooms, i, room, count) {
        count = split(rooms, room, " ")
        for (i = 1; i <= count; i++)
          floor[of "/" room[i]] = level
      }
      # "src/view/sheet.c" -> "view", "backends/writer.c" -> "backends"
      function folder(path) {
        sub(/^src\//, "", path)
        sub(/\/.*/, "", path)
        return path
      }
      # "src/visibility/watkins/pitch/watkins.c" -> "visibility/watkins"; "" for
      # what lies in the layer itself.
      function room(path, part, count) {
        sub(/^src\//, "", path)
        count = split(path, part, "/")
        return count > 2 ? part[1] "/" part[2] : ""
      }
      function noun(path) {
        sub(/.*\//, "", path)
        sub(/\.[ch]$/, "", path)
        return path
      }
      # The reader or writer that a file is.
      function member(path, word) {
        word = noun(path)
        if (folder(path) == "backends" && word ~ /^writer_/ ||
            folder(path) == "scene" && word ~ /^reader_/)
          return word
        return ""
      }
      function goes_up(from, to) {
        if (to == from)
          return 0
        if (from == "")
          return file ~ /\.h$/
        return to != "" && floor[to] >= floor[from]
      }
      function wrong(why) {
        print file ": " why ": " included
      }
      {
        file = $1
        included = $0
        sub(/^[^"]*"/, "", included)
        sub(/".*/, "", included)
        from = folder(file)
        to = folder(included)
        if (file == "src/recto.h")
          wrong("the public header includes only standard ones")
        else if (included == "recto.h")
          next
        else if (!(to in layer) || included !~ /\//)
          wrong("not from a folder of the project")
        else if (layer[to] > layer[from])
          wrong("a higher layer")
        else if (from == "backends" && to != "backends" && to != "base" &&
                 included != "drawing/drawing.h")
          wrong("a writer sees base and the drawing alone")
        else if (from == "judge" && to != "judge" && to != "base" &&
                 to != "scene")
          wrong("the judge sees base and the scene alone")
        else if (from == "cli" && to != "cli" && to != "base")
          wrong("the program sees base and recto.h alone")
        else if (member(included) != "" && member(included) != member(file))
          wrong("readers and writers do not know each other")
        else if (from == to && (from == "visibility" || from == "ink") &&
                 goes_up(room(file), room(included)))
          wrong("a folder that is not below")
        else if (from != to && (to == "visibility" || to == "ink") &&
                 room(included) != "")
          wrong("a folder that is the own affair of its layer")
      }'
}

# Every folder within visibility and ink that holds sources has a floor above.
check_floors() {
  local file room floors
  floors=$(declare -f check_includes | sed -n '/BEGIN {/,/}/p')
  for file in $(sources "$1" | grep -E '^src/(visibility|ink)/.*/'); do
    room=$(cut -d / -f 3 <<<"$file")
    grep -qwF -e "$room" <<<"$floors" ||
      echo "$file: its folder has no floor"
  done
}

# Tolerances stand in one header, each with its reason.  Comments may speak of
# small numbers: the preprocessor takes them out, all files at once, and its
# line markers say which file it is in.
check_tolerances() {
  # CC may be several words, and the list of files is words.
  # shellcheck disable=SC2046,SC2086
  (cd "$1" &&
    ${CC:-cc} -fpreprocessed -dD -E -x c \
      $(sources . | grep -v '^src/base/tolerance\.h$') 2>/dev/null) |
    awk '
      /^# [0-9]+ "/ { file = $3; gsub(/"/, "", file); next }
      /(^|[^A-Za-z0-9_])[0-9]*\.?[0-9]*[eE]-[0-9]/ {
        print file ": a tolerance: " $0
      }'
}

# Every file opens with its name and its job.
check_openings() {
  local file
  for file in $(sources "$1"); do
    head -n 1 "$1/$file" | grep -qF "/* ${file##*/} - " ||
      echo "$file: does not open with its job"
  done
}

# Whatever is compiled is listed, and goes into a release.
check_listed() {
  local file layer
  for file in $(sources "$1"); do
    layer=$(cut -d / -f 1-2 <<<"$file")
    test "${file%%/*}" = src || layer=${file%%/*}
    grep -qF -e "%D%/${file#"$layer"/}" -e "src/${file##*/}" \
      "$1/$layer/local.mk" "$1/src/api/local.mk" 2>/dev/null ||
      echo "$file: not in local.mk"
  done
}

# ---- The tree as it is ----------------------------------------------------

holds() {
  local found
  found=$("$1" "$2")
  test -z "$found" || { say "$found" && false; }
}
claim "there are sources to check" test "$(sources "$srcdir" | wc -l)" -gt 50
for check in includes floors tolerances openings listed; do
  claim "check_$check finds nothing" holds check_$check "$srcdir"
done

# ---- Planted violations ---------------------------------------------------

copy=$scratch/copy
mkdir "$copy"
(cd "$srcdir" && tar cf - src backends) | (cd "$copy" && tar xf -)
chmod -R u+w "$copy"

# finds CHECK FILE LINE - whether the check names the file once the line is
# added to it, and is content again without.
finds() {
  local check=$1 file=$2 line=$3 found
  cp "$copy/$file" "$scratch/saved" 2>/dev/null || : >"$scratch/saved"
  echo "$line" >>"$copy/$file"
  found=$($check "$copy")
  cp "$scratch/saved" "$copy/$file"
  test -s "$copy/$file" || rm "$copy/$file"
  grep -q "^$file: " <<<"$found" && holds "$check" "$copy"
}

while IFS='|' read -r file line; do
  claim "$file may not have $line" finds check_includes "$file" "$line"
done <<'END'
src/base/memory.c|#include "geom/ratio.h"
src/scene/scene.c|#include "view/sheet.h"
src/visibility/map.c|  #  include "ink/ink.h"
src/visibility/newell/newell.c|#include "visibility/watkins/pitch/watkins.h"
src/visibility/brute/brute.c|#include "visibility/newell/newell_order.h"
src/visibility/zbuffer/zbuffer.c|#include "visibility/scanline_zbuffer/scanline_zbuffer.h"
src/visibility/intersection/intersection.c|#include "visibility/newell/newell_order.h"
src/visibility/intersection/intersection.c|#include "visibility/fragments/fragments.h"
src/visibility/predicate/occlusion.h|#include "visibility/index/triangle_grid.h"
src/visibility/solver.h|#include "visibility/predicate/occlusion.h"
src/ink/lines/chain.c|#include "ink/hatch/tone.h"
src/ink/ink.c|#include "visibility/predicate/occlusion.h"
src/api/render.c|#include "ink/lines/stroke.h"
src/scene/reader_obj.c|#include "scene/reader_stl.h"
backends/writer_svg.c|#include "scene/scene.h"
backends/writer_svg.c|#include "ink/ink.h"
backends/writer_svg.c|#include "backends/writer_hpgl.h"
src/judge/judge.c|#include "view/sheet.h"
backends/writers.c|#include "api/handle.h"
src/cli/main.c|#include "scene/scene.h"
src/cli/main.c|#include "backends/writer.h"
src/api/render.c|#include "cli/run.h"
src/recto.h|#include "base/status.h"
src/view/camera.c|#include "camera.h"
src/view/camera.c|#include "../scene/scene.h"
END
for literal in 1e-9 1.5e-12 1E-6f 0.e-3; do
  claim "a tolerance of $literal may not stand in a source" finds \
    check_tolerances src/geom/ratio.c "double a = $literal;"
done
claim "a source may not open without its job" finds check_openings \
  src/geom/new.c "int x;"
mkdir "$copy/src/visibility/included"
claim "a folder may not be without a floor" finds check_floors \
  src/visibility/included/new.c "/* new.c - nothing. */"
claim "a source may not be left out of the build" finds check_listed \
  src/geom/new.c "/* new.c - nothing. */"

# ---- The library ----------------------------------------------------------

library=$builddir/.libs/librecto.so
shows_recto_alone() {
  local names
  names=$(nm -D --defined-only "$library" | awk '{ print $3 }')
  grep -q '^recto_scene_render$' <<<"$names" &&
    ! grep -v '^recto_' <<<"$names"
}
declares_what_it_shows() {
  nm -D --defined-only "$library" | awk '{ print $3 }' | LC_ALL=C sort \
    >"$scratch/shown"
  # shellcheck disable=SC2086
  ${CC:-cc} -fpreprocessed -dD -E -P "$srcdir/src/recto.h" 2>/dev/null |
    grep -oE '\brecto_[a-z_]+\(' | tr -d '(' | LC_ALL=C sort -u \
    >"$scratch/declared"
  # A declared function that is missing, or a shown one that is not declared.
  ! comm -3 "$scratch/shown" "$scratch/declared" | grep .
}
if test -e "$library" && command -v nm >/dev/null; then
  claim "the shared library shows recto_* alone" shows_recto_alone
  claim "it has just what recto.h declares" declares_what_it_shows
else
  skip "the shared library shows recto_* alone" "not built shared"
fi
claim "the program is no wrapper script" \
  test "$(head -c 4 "$recto" | tail -c 3)" = ELF
finish
