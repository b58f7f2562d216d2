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
# drawing alone, the judge base and the scene without the triangulation, which
# it does by itself, the program recto.h alone;
# readers and writers never include each other.
#
# Within the scene, visibility and ink the folders have levels too: a folder
# includes itself, lower levels, and the headers that lie in the layer itself,
# which include no folder.  So no method of visibility includes another one.
# The sources that lie in the layer itself (the choice of a reader or a method,
# the phases of ink) stand above all.
#
# Every file opens with its name and its job, which is not to be looked up in
# another file.  The guard of a header is its path.
check_sources() {
  # shellcheck disable=SC2016 # of awk
  (cd "$1" && sources . | xargs awk '
      BEGIN {
        split("base geom scene view cut visibility parts drawing ink backends judge api " \
              "cli import", name, " ")
        for (i in name)
          layer[name[i]] = i - 1
        set_level("scene", 1, "readers topology triangulation")
        set_level("scene", 2, "edges obj ply weld")
        set_level("visibility", 1, "predicate")
        set_level("visibility", 2, "index")
        set_level("visibility", 3, "zero_set culling intersection fragments")
        set_level("visibility", 4, "contour pairwise scan")
        set_level("visibility", 5, "fold raster")
        set_level("visibility", 6, "fit brute newell scanline_zbuffer tiles warnock " \
              "watkins zbuffer")
        set_level("ink", 1, "lines")
        set_level("ink", 2, "curve fill order")
        set_level("ink", 3, "hatch")
      }
      function set_level(of, number, folders, i, name, count) {
        count = split(folders, name, " ")
        for (i = 1; i <= count; i++)
          level[of "/" name[i]] = number
        has_levels[of]
      }
      # "src/view/sheet.c" -> "view", "backends/writer.c" -> "backends"
      function folder(path) {
        sub(/^src\//, "", path)
        sub(/\/.*/, "", path)
        return path
      }
      # "src/visibility/watkins/pitch/watkins.c" -> "visibility/watkins"; "" for
      # what lies in the layer itself.
      function subfolder(path, part, count) {
        sub(/^src\//, "", path)
        count = split(path, part, "/")
        return count > 2 ? part[1] "/" part[2] : ""
      }
      # Whether two files lie in different folders of one subfolder, as those of
      # watkins/pitch and watkins/exact do.
      function is_beside(path, other, part, others) {
        sub(/^src\//, "", path)
        return split(path, part, "/") > 3 && split(other, others, "/") > 3 &&
               part[2] == others[2] && part[3] != others[3]
      }
      function noun(path) {
        sub(/.*\//, "", path)
        sub(/\.[ch]$/, "", path)
        return path
      }
      # "src/scene/weld/slits.h" -> "SCENE_WELD_SLITS_H"
      function guard(path) {
        sub(/^src\//, "", path)
        gsub(/[\/.]/, "_", path)
        return toupper(path)
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
        return to != "" && level[to] >= level[from]
      }
      function wrong(why) {
        print file ": " why ": " included
      }
      FNR == 1 {
        file = FILENAME
        from = folder(file)
        included = ""
        if (index($0, "/* " noun(file) substr(file, length(file) - 1) " - ") != 1)
          wrong("does not open with its job")
        if (index($0, " - see "))
          wrong("opens with a reference in place of its job")
        if (from in has_levels && subfolder(file) != "" &&
            !(subfolder(file) in level))
          wrong("its folder has no level")
      }
      /^#ifndef .*_H$/ && file ~ /\.h$/ && $2 != guard(file) {
        included = $2
        wrong("its guard is not its path")
      }
      /^ *# *include *"/ {
        included = $0
        sub(/^[^"]*"/, "", included)
        sub(/".*/, "", included)
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
        else if (from == "judge" && included ~ /^scene\/triangulation\//)
          wrong("the judge triangulates by itself")
        else if (from == "cli" && to != "cli")
          wrong("the program sees recto.h alone")
        else if (member(included) != "" && member(included) != member(file))
          wrong("readers and writers do not know each other")
        else if (from == to && from in has_levels &&
                 goes_up(subfolder(file), subfolder(included)))
          wrong("a folder that is not below")
        else if (from == to && is_beside(file, included))
          wrong("a folder beside it")
        else if (from != to && (to == "visibility" || to == "ink") &&
                 subfolder(included) != "")
          wrong("a folder that is private to its layer")
      }')
}

# No circles: a module, which is a header with its source, reaches itself by no
# chain of includes.
check_circles() {
  # shellcheck disable=SC2016 # of awk
  (cd "$1" && sources . | xargs awk '
      function module(path) {
        sub(/^src\//, "", path)
        sub(/\.[ch]$/, "", path)
        return path
      }
      # Marks in seen[] what is reached from a module.
      function visit(from, list, count, i, to) {
        count = split(next_of[from], list, " ")
        for (i = 1; i <= count; i++) {
          to = list[i]
          if (!(to in seen)) {
            seen[to]
            visit(to)
          }
        }
      }
      /^ *# *include *"/ {
        included = $0
        sub(/^[^"]*"/, "", included)
        sub(/".*/, "", included)
        if (module(included) != module(FILENAME))
          next_of[module(FILENAME)] = next_of[module(FILENAME)] " " \
                                      module(included)
      }
      END {
        for (from in next_of) {
          split("", seen)
          visit(from)
          if (from in seen)
            print from ": in a circle of includes"
        }
      }')
}

# A function has a name of its own, static ones included, and so has a struct:
# no name has two meanings.  Each program has its main.
check_names() {
  # shellcheck disable=SC2016 # of awk
  (cd "$1" && sources . | xargs awk '
      function define(name) {
        if (name in definer && definer[name] != FILENAME)
          print FILENAME ": also defined in " definer[name] ": " name
        definer[name] = FILENAME
      }
      /^(struct|union|enum) [a-z_0-9]+ \{/ {
        define($1 " " $2)
      }
      /^[a-z_][^=]*\(/ && !/^(typedef|extern) / &&
      (/^static / || FILENAME ~ /\.c$/) {
        name = $0
        sub(/\(.*/, "", name)
        sub(/.*[ *]/, "", name)
        if (name != "" && name != "main")
          define(name)
      }')
}

# Tolerances stand in one header, each with its reason.  Comments may speak of
# small numbers.
check_tolerances() {
  (cd "$1" && sources . | grep -v '^src/base/tolerance\.h$' |
    xargs awk '
      FNR == 1 { comment = 0 }
      comment && !sub(/^([^*]|\*+[^*\/])*\*+\//, "") { next }
      {
        gsub(/\/\*([^*]|\*+[^*\/])*\*+\//, "")
        comment = sub(/\/\*.*/, "")
      }
      /(^|[^A-Za-z0-9_])[0-9]*\.?[0-9]*[eE]-[0-9]/ {
        print FILENAME ": a tolerance: " $0
      }')
}

# tolerance.h names for each tolerance the files that use it, and no others.
check_users() {
  (cd "$1" && sources . | grep -v '^src/base/tolerance\.h$' |
    xargs awk '
      FILENAME == "src/base/tolerance.h" {
        if (/^ \* Users/)
          listing = 1
        if (/^ \* Ten times/)
          listing = 0
        if (listing)
          list = list " " $0
        if (/^#define TOLERANCE_/) {
          listed[$2] = list " "
          list = ""
        }
        next
      }
      {
        if (comment && !sub(/^.*\*\//, ""))
          next
        gsub(/\/\*.*\*\//, "")
        comment = sub(/\/\*.*/, "")
        while (match($0, /TOLERANCE_[A-Z_]+/)) {
          name = substr($0, RSTART, RLENGTH)
          $0 = substr($0, RSTART + RLENGTH)
          if (name in listed)
            uses[name, FILENAME]
        }
      }
      END {
        for (pair in uses) {
          split(pair, part, SUBSEP)
          path = part[2]
          sub(/^src\//, "", path)
          if (listed[part[1]] !~ "[ ,]" path "[ ,:]")
            print part[2] ": uses " part[1] " and is not listed"
        }
        for (name in listed) {
          count = split(listed[name], word, /[ ,:]+/)
          for (i = 1; i <= count; i++)
            if (word[i] ~ /\.[ch]$/ && !((name, word[i]) in uses) &&
                !((name, "src/" word[i]) in uses))
              print "src/base/tolerance.h: " word[i] " does not use " name
        }
      }' src/base/tolerance.h)
}

# --stats is for the reader: nothing is decided by what was reported.
check_reports() {
  (cd "$1" && sources . | grep -v '^src/base/report\.[ch]$' |
    xargs grep -H 'report_get(' | sed 's/:.*/: reads a report/')
}

# The formatter leaves comments as they are, so that it does not wrap them.
check_width() {
  (cd "$1" && find src backends bench examples tests -name '*.[ch]' 2>/dev/null |
    LC_ALL=C sort | xargs awk '
    length($0) > 80 { print FILENAME ": line " FNR " is too long" }')
}

# Whatever is compiled is listed, and goes into a release.
check_listed() {
  (cd "$1" && {
    grep -oH '%D%/[^ ]*\.[ch]' backends/local.mk src/*/local.mk |
      sed 's|local\.mk:%D%/||'
    grep -oh 'src/[^ ]*\.h' src/api/local.mk
  }) | LC_ALL=C sort | LC_ALL=C comm -13 - <(sources "$1") |
    sed 's/$/: not in local.mk/'
}

# A function of more than 45 lines does more than one thing, and so does a file
# of more than 450, but for those here: recto.h is the whole interface, and the
# others are tables, formats and searches of which no part stands alone.
check_length() {
  (cd "$1" && sources . | xargs awk '
    BEGIN {
      split("src/recto.h backends/writer_cairo.c " \
            "src/parts/part_merge.c " \
            "src/cli/options.c", name, " ")
      for (i in name)
        long[name[i]] = 1
    }
    FNR == 1 { start = 0 }
    FNR == 451 && !(FILENAME in long) { print FILENAME ": too long" }
    # A table is no function, nor is the function that is one but for its end.
    / = \{$/ { table = 1 }
    /^[a-z].*\(/ && !/;$/ { start = FNR; table = 0 }
    /^}/ && start {
      if (FNR - start >= 45 && !table)
        print FILENAME ": line " start ": a function too long"
      start = 0
    }')
}

# Of two tests that have one log make runs only one.
check_logs() {
  (cd "$1/tests" && printf '%s\n' test_*.c test_*.sh) | sed 's/\.[a-z]*$//' |
    LC_ALL=C sort | uniq -d | sed 's|.*|tests/&.log: of two tests|'
}

# ---- The tree as it is ----------------------------------------------------

holds() {
  local found
  found=$("$1" "$2")
  test -z "$found" || { say "$found" && false; }
}
claim "there are sources to check" test "$(sources "$srcdir" | wc -l)" -gt 50
for check in sources circles names tolerances users reports width length listed \
  logs; do
  claim "check_$check finds nothing" holds check_$check "$srcdir"
done

# ---- Planted violations ---------------------------------------------------

# They are planted all at once, and each is to be reported by its file and its
# own text.
copy=$scratch/copy
mkdir "$copy"
(cd "$srcdir" && { sources . && find src backends -name local.mk; } |
  tar cf - -T -) | (cd "$copy" && tar xf -)
chmod -R u+w "$copy"

cat >"$scratch/includes" <<'END'
src/base/memory.c|#include "geom/ratio.h"
src/scene/scene.c|#include "view/sheet.h"
src/scene/topology/topology.c|#include "scene/weld/weld_near.h"
src/scene/scene.h|#include "scene/topology/topology.h"
src/visibility/map.c|  #  include "ink/ink.h"
src/visibility/newell/newell.c|#include "visibility/watkins/pitch/watkins.h"
src/visibility/watkins/pitch/watkins.c|#include "visibility/watkins/exact/sweep.h"
src/visibility/brute/brute.c|#include "visibility/newell/newell_order.h"
src/visibility/zbuffer/zbuffer.c|#include "visibility/scanline_zbuffer/scanline_zbuffer.h"
src/visibility/intersection/intersection.c|#include "visibility/newell/newell_order.h"
src/visibility/intersection/intersection.c|#include "visibility/fragments/fragments.h"
src/visibility/predicate/occlusion.h|#include "visibility/index/triangle_grid.h"
src/visibility/solver.h|#include "visibility/predicate/occlusion.h"
src/ink/lines/chain.c|#include "ink/hatch/hatch.h"
src/ink/ink.c|#include "visibility/predicate/occlusion.h"
src/api/render.c|#include "ink/lines/stroke.h"
src/scene/obj/reader_obj.c|#include "scene/readers/reader_stl.h"
backends/writer_svg.c|#include "scene/scene.h"
backends/writer_svg.c|#include "ink/ink.h"
backends/writer_svg.c|#include "backends/writer_hpgl.h"
src/judge/judge.c|#include "view/sheet.h"
src/judge/triangulation.c|#include "scene/triangulation/triangulate.h"
backends/writers.c|#include "api/handle.h"
src/cli/main.c|#include "base/memory.h"
src/cli/main.c|#include "scene/scene.h"
src/cli/main.c|#include "backends/writer.h"
src/api/render.c|#include "cli/run.h"
src/recto.h|#include "base/status.h"
src/view/camera.c|#include "camera.h"
src/view/camera.c|#include "../scene/scene.h"
END
mkdir "$copy/src/visibility/included"
while IFS='|' read -r file line; do
  echo "$line" >>"$copy/$file"
done <"$scratch/includes"
sed -i '1s|.*|/* wide.c - see wide.h. */|' "$copy/src/geom/wide.c"
for literal in 1e-9 1.5e-12 1E-6f 0.e-3; do
  echo "double a = $literal;" >>"$copy/src/geom/ratio.c"
done
printf '/* 2e-5\n2e-5 */ double c = 2e-4; /* 2e-5 */\n' >>"$copy/src/geom/ratio.c"
printf 'double b = 2\n  * TOLERANCE_TONE;\n' >>"$copy/src/geom/ratio.c"
sed -i 's|Users       view/camera_axes.c|&, view/page.c|' "$copy/src/base/tolerance.h"
sed -i 's|#ifndef GEOM_LINE_H|#ifndef LINE_H|' "$copy/src/geom/line.h"
echo "int n = report_get(0, 0, 0, 0);" >>"$copy/src/api/render.c"
printf '/* %80s */\n' wide >>"$copy/src/geom/ratio.c"
echo "int x;" >"$copy/src/geom/new.c"
cat >>"$copy/src/geom/line.h" <<'END'
#include "geom/convex.h"
END
cat >>"$copy/src/ink/pens.c" <<'END'
static int count_vertices(void) { return 0; }
struct planted_tag { int x; };
END
cat >>"$copy/src/ink/layers.c" <<'END'
static inline int *count_vertices(int a,
                             int b) { return 0; }
struct planted_tag { int x; };
END
mkdir "$copy/tests"
printf '/* %80s */\n' wide >"$copy/tests/test_line.c"
touch "$copy"/tests/test_twin.c "$copy"/tests/test_{twin,lines}.sh
echo "/* new.c - nothing. */" >"$copy/src/visibility/included/new.c"
yes "" | head -451 >>"$copy/src/geom/wide.c"
{
  echo "int planted_length(void) {"
  yes "  ;" | head -44
  echo "}"
} >>"$copy/src/geom/int128.h"
for check in sources circles names tolerances users reports width length listed \
  logs; do
  check_$check "$copy" >"$scratch/$check"
done

# finds CHECK LINE-START LINE-END - whether the check reports such a line.
finds() {
  awk -v start="$2" -v end="$3" '
    index($0, start) == 1 &&
    substr($0, length($0) - length(end) + 1) == end { found = 1 }
    END { exit !found }' "$scratch/$1"
}
while IFS='|' read -r file line; do
  included=${line#*\"}
  claim "$file may not have $line" finds sources "$file: " ": ${included%\"}"
done <"$scratch/includes"
claim "nothing else is reported for the files with planted lines" \
  test "$(wc -l <"$scratch/sources")" -eq "$(($(wc -l <"$scratch/includes") + 4))"
for literal in 1e-9 1.5e-12 1E-6f 0.e-3; do
  claim "a tolerance of $literal may not stand in a source" finds \
    tolerances "src/geom/ratio.c: " " = $literal;"
done
claim "nor between comments" finds \
  tolerances "src/geom/ratio.c: " " double c = 2e-4; "
claim "but within them" test "$(wc -l <"$scratch/tolerances")" -eq 5
claim "a user of a tolerance may not be unlisted" finds users \
  "src/geom/ratio.c: uses TOLERANCE_TONE" ""
claim "a listed user of a tolerance must use it" finds users \
  "src/base/tolerance.h: view/page.c does not use TOLERANCE_UP_SINE" ""
claim "a report may not be read" finds reports "src/api/render.c: reads" ""
claim "a comment may not be wider than the page" finds width \
  "src/geom/ratio.c: line" "too long"
claim "nor one of a test" finds width "tests/test_line.c: line" "too long"
claim "a source may not open without its job" finds sources \
  "src/geom/new.c: does not open" ""
claim "nor with a reference in its place" finds sources \
  "src/geom/wide.c: opens with a reference" ""
claim "a folder may not be without a level" finds sources \
  "src/visibility/included/new.c: its folder has no level" ""
claim "the guard of a header may not be any other than its path" finds sources \
  "src/geom/line.h: its guard is not its path: " LINE_H
claim "modules may not include each other in a circle" finds circles \
  "geom/convex: in a circle of includes" ""
claim "a function may not have the name of another one" finds names \
  "src/ink/pens.c: also defined in src/ink/layers.c: " "count_vertices"
claim "nor a struct" finds names \
  "src/ink/pens.c: also defined in src/ink/layers.c: " "struct planted_tag"
claim "and no other names are reported" test "$(wc -l <"$scratch/names")" -eq 2
claim "a file may not grow too long" finds length "src/geom/wide.c: too long" ""
claim "nor a function" finds length "src/geom/int128.h: line " "too long"
claim "and no other lengths are reported" test "$(wc -l <"$scratch/length")" -eq 2
claim "a source may not be left out of the build" finds listed \
  "src/geom/new.c: not in" ""
claim "two tests may not have one log" finds logs "tests/test_twin.log: " ""

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
  ${CC:-cc} -E -P "$srcdir/src/recto.h" 2>/dev/null |
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

# ---- The program: its library is the public one -----------------------------

# It is linked with the static library, which has more than recto_* to offer.
archive=$builddir/.libs/librecto.a
objects=()
for source in "$srcdir"/src/cli/*.c; do
  source=${source##*/}
  objects+=("$builddir/src/cli/${source%.c}.o")
done
# used_of_the_library OBJECT... - the library's functions that these call.
used_of_the_library() {
  nm -u "$@" | awk '{ print $2 }' | LC_ALL=C sort -u |
    LC_ALL=C comm -12 - <(nm --defined-only "$archive" 2>/dev/null |
      awk '$2 ~ /[A-Z]/ { print $3 }' | LC_ALL=C sort -u)
}
uses_recto_alone() {
  used_of_the_library "${objects[@]}" >"$scratch/used"
  grep -q '^recto_scene_render$' "$scratch/used" &&
    ! grep -v '^recto_' "$scratch/used"
}
finds_another_function() {
  # shellcheck disable=SC2086
  echo 'void mem_free(void *); int main(void) { mem_free(0); }' |
    ${CC:-cc} -x c -c - -o "$scratch/inner.o" &&
    test "$(used_of_the_library "$scratch/inner.o")" = mem_free
}
draws_the_same() {
  local model=$srcdir/examples/models/gears.obj
  # shellcheck disable=SC2086
  ${CC:-cc} "${objects[@]}" "$library" -Wl,-rpath,"${library%/*}" -lm -lpthread \
    -o "$scratch/shared" &&
    "$scratch/shared" "$model" -o "$scratch/shared.svg" &&
    "$recto" "$model" -o "$scratch/static.svg" &&
    cmp "$scratch/shared.svg" "$scratch/static.svg"
}
if test -e "$archive" && command -v nm >/dev/null; then
  claim "the program is no wrapper script" \
    test "$(head -c 4 "$recto" | tail -c 3)" = ELF
  claim "of the library the program uses recto_* alone" uses_recto_alone
  claim "the use of another function would be found" finds_another_function
else
  skip "of the library the program uses recto_* alone" "not built static"
fi
if test -e "$library" && ! nm -D "$library" | grep -q __asan_init; then
  claim "the program draws the same with the shared library" draws_the_same
else
  skip "the program draws the same with the shared library" \
    "none without sanitizers was built"
fi
finish
