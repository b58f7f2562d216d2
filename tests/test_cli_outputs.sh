#!/bin/bash
# test_cli_outputs.sh - outputs: nothing that is read or written by the run is
# lost, a file keeps its metadata, and all of the outputs appear or none.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"
run 0 cube.obj -o cube.svg

# ---- Two outputs ----------------------------------------------------------

# one_place DRAWING STATS - both would be one file: refused, nothing made.
one_place() {
  run 2 cube.obj -o "$1" --format svg "--stats=$2" &&
    says 'the stats would replace the drawing' &&
    test ! -e new.svg && test ! -s out && none_left
}
mkdir folder
ln -s new.svg dangling.svg
ln -s . here
for pair in 'new.svg ./new.svg' 'new.svg folder/../new.svg' \
  'dangling.svg new.svg' 'new.svg dangling.svg' 'here/new.svg new.svg'; do
  claim "two names of one file that is not there: $pair" \
    one_place "${pair% *}" "${pair#* }"
done
cp cube.svg kept.svg
ln kept.svg hard.svg
one_file() {
  run 2 cube.obj -o "$1" "--stats=$2" &&
    says 'the stats would replace the drawing' && cmp -s cube.svg kept.svg
}
claim "two names of one file that is there" one_file kept.svg ./kept.svg
claim "two links to one file" one_file kept.svg hard.svg
both_on_one_stream() {
  run 2 cube.obj -o "$1" "--stats=$2" &&
    says 'the stats would replace the drawing' && test ! -s out
}
claim "both on standard output" both_on_one_stream - /dev/stdout
claim "both on standard output, by other names" \
  both_on_one_stream /dev/fd/1 /proc/self/fd/1
stats_into_the_drawing() {
  "$recto" cube.obj -o redirected.svg --stats >redirected.svg 2>err
  test $? -eq 2 && says 'the stats would replace the drawing'
}
claim "the stats go to the very file that the drawing would replace" \
  stats_into_the_drawing
terminal_takes_both() { run 0 cube.obj --format svg -o /dev/null --stats=/dev/null; }
claim "a device takes both" terminal_takes_both

# all_or_nothing ARGUMENT... - the run fails, and leaves no drawing.
all_or_nothing() {
  rm -f new.svg
  run 1 cube.obj -o new.svg "$@" && test ! -e new.svg && none_left
}
claim "stats that cannot be written: no drawing" all_or_nothing \
  --stats=/dev/full
claim "stats in a folder's place: no drawing" all_or_nothing --stats=folder
stats_on_a_full_output() {
  rm -f new.svg
  "$recto" cube.obj -o new.svg --stats >/dev/full 2>err
  test $? -eq 1 && test ! -e new.svg && none_left
}
claim "stats on a full standard output: no drawing" stats_on_a_full_output
drawing_on_a_full_output() {
  rm -f new.json
  "$recto" cube.obj -o - --stats=new.json >/dev/full 2>err
  test $? -eq 1 && test ! -e new.json && none_left
}
claim "a drawing on a full standard output: no stats" drawing_on_a_full_output
both_are_too_large() {
  rm -f new.svg new.json
  (
    ulimit -f 1
    exec "$recto" cube.obj -o new.svg --stats=new.json 2>err
  )
  test $? -eq 1 && test ! -e new.svg && test ! -e new.json && none_left
}
claim "stats larger than is allowed: no drawing" both_are_too_large
# Where stats cannot be written over a file of two names, whose bytes would be
# replaced last, the drawing that was there stays.
old_drawing_stays() { # FILE, the drawing's
  rm -f old.json other.json
  echo stats >old.json && ln old.json other.json
  (
    ulimit -f 1
    exec "$recto" cube.obj -o "$1" --stats=old.json 2>err
  )
  test $? -eq 1 && says 'old.json: cannot write: File too large' &&
    test "$(cat "$1")" = drawing && test "$(cat other.json)" = stats && none_left
}
echo drawing >old.svg
claim "stats over a file of two names fail: the old drawing stays" \
  old_drawing_stays old.svg
echo drawing >old2.svg && ln old2.svg other2.svg
claim "the same where the drawing has two names as well" \
  old_drawing_stays old2.svg
stats_are_not_early() {
  rm -f old.svg other.svg
  echo drawing >old.svg && ln old.svg other.svg
  (
    ulimit -f 1
    exec "$recto" "$srcdir/examples/models/gears.obj" -o old.svg --stats >out 2>err
  )
  test $? -eq 1 && test ! -s out && test "$(cat other.svg)" = drawing
}
claim "where the drawing has no room no stats are printed" stats_are_not_early
both_are_replaced() {
  rm -f old.svg old.json
  echo drawing >old.svg && echo stats >old.json &&
    run 0 cube.obj -o old.svg --stats=old.json && cmp -s old.svg cube.svg &&
    grep -q '"faces": 6' old.json && none_left
}
claim "two files are replaced at once" both_are_replaced
refused_before_the_work() {
  run 1 none.obj -o no/such/folder.svg && says '^recto: no/such/folder.svg: '
}
claim "what cannot be written is refused before anything is read" \
  refused_before_the_work

# ---- What is read ----------------------------------------------------------

model_stays() { # ARGUMENT...
  cp cube.obj model.obj
  "$recto" "$@" >out 2>err <model.obj
  test $? -eq 2 && says 'would replace the model' &&
    cmp -s cube.obj model.obj && none_left
}
claim "a model on standard input is not replaced" \
  model_stays --from obj - -o model.obj --format svg
claim "nor by the stats" model_stays --from obj - -o s.svg --stats=model.obj
claim "nor through a link" \
  eval 'ln -sf model.obj link.obj && model_stays --from obj - --format svg -o link.obj'
appending() {
  cp cube.obj model.obj
  "$recto" model.obj -o - >>model.obj 2>err
  test $? -eq 2 && says 'would replace the model' && cmp -s cube.obj model.obj
}
claim "nor is standard output added to it" appending
{
  echo 'mtllib m.mtl'
  echo 'usemtl red'
  cat cube.obj
} >coloured.obj
printf 'newmtl red\nKd 1 0 0\n' >m.mtl
library_stays() {
  cp m.mtl before.mtl
  run 2 coloured.obj --format svg "$@" &&
    says 'would replace the model' && cmp -s m.mtl before.mtl && none_left
}
claim "a material library that is read is not replaced" \
  library_stays --fill paint -o m.mtl
claim "nor by the stats" library_stays --fill paint -o s.svg --stats=m.mtl
claim "nor one that is not read, as only lines are drawn" library_stays -o m.mtl

# A model whose points are in a file beside it, which only Assimp opens.
write_gltf() {
  python3 - <<'END'
import json, struct
points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
data = b"".join(struct.pack("<3f", *p) for p in points)
data += struct.pack("<3H", 0, 1, 2) + b"\0\0"
open("points.bin", "wb").write(data)
json.dump({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "buffers": [{"uri": "points.bin", "byteLength": len(data)}],
    "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                    {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
    "accessors": [
        {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
         "min": [0, 0, 0], "max": [1, 1, 0]},
        {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
}, open("model.gltf", "w"))
END
}
buffer_stays() { # ARGUMENT...
  cp points.bin before.bin
  run 2 model.gltf --format svg "$@" && says 'would replace the model' &&
    cmp -s points.bin before.bin && none_left
}
if write_gltf 2>err && "$recto" model.gltf -o gltf.svg 2>err; then
  claim "a file that the model refers to is not replaced" \
    buffer_stays -o points.bin
  claim "nor by the stats" buffer_stays -o s.svg --stats=points.bin
  claim "nor through a link" \
    eval 'ln -sf points.bin link.bin && buffer_stays -o link.bin'
else
  skip "a file that the model refers to" "no glTF here: $(head -1 err)"
fi

# ---- What belongs to a file -------------------------------------------------

draw_over() { run 0 cube.obj -o "$1" --format svg && cmp -s cube.svg "$1"; }
links_stay() {
  echo old >one && rm -f two && ln one two && draw_over one &&
    cmp -s cube.svg two && test "$(stat -c %h one)" -eq 2 && none_left
}
claim "all names of a file stay its names" links_stay
shrinks() {
  head -c 100000 /dev/zero >one && rm -f two && ln one two && draw_over one &&
    cmp -s cube.svg two
}
claim "a longer file written in place is cut to its length" shrinks
mode_stays() {
  echo old >moded && chmod 4750 moded && draw_over moded &&
    test "$(stat -c %a moded)" = 4750
}
claim "a file keeps its mode" mode_stays
attributes_stay() {
  echo old >marked && setfattr -n user.recto -v yes marked &&
    draw_over marked &&
    test "$(getfattr --only-values -n user.recto marked)" = yes
}
if : >marked && command -v setfattr >/dev/null &&
  setfattr -n user.recto -v no marked 2>/dev/null; then
  claim "a file keeps its attributes" attributes_stay
else
  skip "a file keeps its attributes" "no setfattr, or no attributes here"
fi
python_attributes() {
  python3 - "$recto" <<'END'
import os, subprocess, sys
open("marked", "w").write("old")
os.setxattr("marked", "user.recto", b"yes")
subprocess.run([sys.argv[1], "cube.obj", "-o", "marked", "--format", "svg"],
               check=True)
assert os.getxattr("marked", "user.recto") == b"yes"
END
}
if ! command -v setfattr >/dev/null && python3 -c '
import os
open("marked", "w").write("old")
os.setxattr("marked", "user.recto", b"no")' 2>/dev/null; then
  claim "a file keeps its attributes, by python" python_attributes
fi
owner_stays() {
  echo old >owned && chown 1234:2345 owned && draw_over owned &&
    test "$(stat -c %u:%g owned)" = 1234:2345 && none_left
}
# A file of two names is written in place, which may not fail half-way.
limited_in_place() {
  local model=$srcdir/examples/models/gears.obj
  echo old >one.svg && ln one.svg two.svg &&
    ! (ulimit -f 1 && exec "$recto" "$model" -o one.svg) 2>err &&
    grep -q 'File too large' err && test "$(cat two.svg)" = old && none_left
}
claim "beyond the size limit a file of two names stays as it is" limited_in_place
# Somebody else's file in a folder of one's own cannot be given away, and is
# written in place; and so is one in a folder that may not be written to.
as_nobody() { setpriv --reuid 65534 --regid 65534 --clear-groups "$@"; }
in_place() { # FILE
  local number
  number=$(stat -c %i "$1")
  as_nobody "$recto" cube.obj -o "$1" --format svg 2>err &&
    cmp -s cube.svg "$1" && test "$(stat -c %i "$1")" -eq "$number"
}
anothers_file() {
  mkdir -p own && chown 65534:65534 own && echo old >own/anothers &&
    chown 1234:2345 own/anothers && chmod 666 own/anothers &&
    in_place own/anothers && test "$(stat -c %u:%g own/anothers)" = 1234:2345
}
# A file that its owner may write but not read has attributes that he cannot
# give to another: it is written in place.
unreadable_file() {
  mkdir -p own && chown 65534:65534 own &&
    python3 - <<'END' && in_place_unread own/unread
import os
open("own/unread", "w").write("old")
os.setxattr("own/unread", "user.recto", b"yes")
os.chown("own/unread", 65534, 65534)
os.chmod("own/unread", 0o200)
END
}
in_place_unread() { # FILE
  local number
  number=$(stat -c %i "$1")
  as_nobody "$recto" cube.obj -o "$1" --format svg 2>err &&
    cmp -s cube.svg "$1" && test "$(stat -c %i "$1")" -eq "$number" &&
    test "$(stat -c %a "$1")" = 200
}
closed_folder() {
  mkdir -p closed && chmod 755 closed && echo old >closed/file &&
    chmod 666 closed/file && in_place closed/file
}
closed_to_new_files() {
  as_nobody "$recto" cube.obj -o closed/new.svg 2>err
  test $? -eq 1 && says '^recto: closed/new.svg: cannot create: Permission'
}
if test "$(id -u)" -eq 0 && command -v setpriv >/dev/null &&
  chmod 755 . && as_nobody test -r "$PWD/cube.obj" -a -x "$recto"; then
  claim "a file keeps its owner" owner_stays
  claim "somebody else's file stays his" anothers_file
  if python3 -c 'import os
open("marked", "w").write("old")
os.setxattr("marked", "user.recto", b"no")' 2>/dev/null; then
    claim "a file that may not be read keeps its attributes" unreadable_file
  fi
  claim "a file in a folder that is closed is written in place" closed_folder
  claim "and a new one there is refused" closed_to_new_files
else
  skip "a file keeps its owner" "not root, or the user nobody has no access here"
fi

# ---- Names ------------------------------------------------------------------

while read -r name; do
  claim "$name is HPGL" eval "run 0 cube.obj -o '$name' && head -n 1 '$name' |
    grep -q '^IN;'"
done <<'END'
a.hpgl
a.plt
a.hpg
A.HPG
END
compressed() { # NAME
  run 0 cube.obj -o "$1" && gzip -dc <"$1" | cmp -s - cube.svg &&
    cp "$1" before.gz && sleep 1 && run 0 cube.obj -o "$1" &&
    cmp -s before.gz "$1"
}
if command -v gzip >/dev/null && run 0 cube.obj -o probe.svgz; then
  claim "svgz is compressed, the same bytes every time" compressed a.svgz
  claim "svg.gz is too" compressed a.svg.gz
  claim "by format" eval 'run 0 cube.obj -o odd --format svgz &&
    cmp -s odd a.svgz'
  claim "on standard output" eval '"$recto" cube.obj --format svgz -o - |
    cmp -s - a.svgz'
  claim "a full disk for a compressed one fails" \
    run 1 cube.obj --format svgz -o /dev/full
  claim "options of svg hold" eval 'run 0 cube.obj -o p.svgz --precision 1 &&
    silent'
else
  claim "without zlib svgz is refused" refuses 'zlib' cube.obj -o no.svgz
fi

# A descriptor's name stands for what is open, with its place in a file.
to_descriptor() { # NAME
  {
    echo before
    "$recto" cube.obj -o "$1" || return 1
    echo after
  } >plain.txt 2>err
  { echo before && cat cube.svg && echo after; } | cmp -s - plain.txt &&
    { "$recto" cube.obj -o "$1" | cmp -s - cube.svg; }
}
for name in /dev/stdout /dev/fd/1 /proc/self/fd/1; do
  claim "$name is standard output" to_descriptor "$name"
done
to_another() {
  "$recto" cube.obj -o /dev/fd/7 7>seven.svg && cmp -s seven.svg cube.svg
}
claim "another descriptor is written to" to_another
if test -e /proc/thread-self/fd/1; then
  through_thread() {
    "$recto" cube.obj -o /proc/thread-self/fd/1 --format svg 2>err |
      cmp -s - cube.svg
  }
  claim "a link of /proc to a pipe is written to" through_thread
  to_a_removed_file() {
    mkdir -p gone && (
      exec 5<>gone/gone.svg && rm gone/gone.svg &&
        "$recto" cube.obj -o "/proc/$BASHPID/fd/5" --format svg 2>err &&
        cmp -s "/proc/$BASHPID/fd/5" cube.svg
    ) && test -z "$(ls gone)"
  }
  claim "and one to a file that was removed" to_a_removed_file
fi
# The name of a temporary file would be longer than the system allows.
longest_path() {
  local path=./ name=deepest.svg
  while test $((${#path} + ${#name})) -lt 4090; do path+=./; done
  test $((${#path} + ${#name})) -lt 4095 && path+=/
  run 0 cube.obj -o "$path$name" && run 0 cube.obj -o "$path$name" &&
    cmp -s deepest.svg cube.svg && none_left
}
claim "a file at the longest path is replaced" longest_path
claim "one that is not open is refused" eval \
  'run 1 cube.obj -o /dev/fd/77 && says "Bad file descriptor"'
aside_of_dev_stdout() {
  run 0 cube.obj -o /dev/stdout --stats && cmp -s out cube.svg &&
    grep -q '"faces": 6' err
}
claim "--stats stands aside of /dev/stdout too" aside_of_dev_stdout
to_a_pipe() {
  mkfifo pipe && { cat pipe >piped.svg & } &&
    run 0 cube.obj -o pipe --format svg && wait && cmp -s piped.svg cube.svg
}
claim "a pipe gets the drawing once" to_a_pipe
finish
