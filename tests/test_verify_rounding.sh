#!/bin/bash
# test_verify_rounding.sh - --verify does not refuse what doubles cannot decide:
# scenes that structured fuzzing found, each as small as it goes.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"

# passes OPTION ...: the model on standard input is drawn and found right.
passes() {
  cat >model.obj
  "$recto" "$@" --verify=300 -q -o out.svg model.obj 2>err && return 0
  say "$(cat err)"
  return 1
}

# refused MESSAGE OPTION ...: the model is refused with that message.
refused() {
  cat >model.obj
  rm -f out.svg
  "$recto" "${@:2}" --verify=300 -q -o out.svg model.obj 2>err && return 1
  grep -qF "$1" err && test ! -e out.svg
}

claim "faces that pierce each other in a diagonal of both, cut by a section" \
  passes --view=iso --section=1 <<'END_OF_MODEL'
v 0 1 0
v 0 0 0
v 1 2 0
v 0 2 0
v 0 0 1
v 0 2 -1
f 1 2 3 4
f 5 3 6 1
END_OF_MODEL

grazing='--azimuth=89.9999999 --elevation=1e-7'
claim "a warped face within a billionth of the near plane" \
  passes --near=2 $grazing <<'END_OF_MODEL'
v 0 0 0
v 0 0 1
v -1 1 0
v 1 1 1
f 4 3 2 1
END_OF_MODEL

claim "what a cut leaves of it is too little to be drawn" \
  refused "the cut leaves so little" --section=2 $grazing <<'END_OF_MODEL'
v 0 0 0
v 0 0 1
v -1 1 0
v 1 1 1
f 4 3 2 1
END_OF_MODEL

claim "a box within a billionth of the near plane" \
  passes --near=1 $grazing <<'END_OF_MODEL'
v 1 0 0
v 0 1 1
v 1 1 1
v 0 0 1
v 1 0 1
v 0 1 0
v 1 1 0
v 0 0 0
v 2 0 0
f 1 9 8
f 2 4 5 3
f 6 7 1 8
f 2 3 7 6
f 4 8 1 5
f 2 6 8 4
f 3 5 1 7
END_OF_MODEL

claim "the diagonal of a warped face in the section plane" \
  passes --section=1 $grazing <<'END_OF_MODEL'
v 0 -1 1
v 0 -1 0
v 1 0 0
v 0 0 1
f 4 3 2 1
END_OF_MODEL

claim "a pair of faces and a third one whose points are others at their places" \
  passes --view=iso --edges=smooth,crease <<'END_OF_MODEL'
v 0 1 0
v 0 -2 0.5
v 0 0 0
v 2 1.5 0.5
v 2 1.5 0.5
f 1 2 4
f 4 3 1 1
f 5 1 2
END_OF_MODEL

# From below its middle, rays that are undecided by no border leave it and enter it
# nowhere.
claim "a surface that is not closed, cut through its middle" passes \
  --edges=all --contact=0 --exact --azimuth=33 --elevation=22 --up=0,0,1 \
  --cut=-0.13833064484169366,-0.59885199796327848,0.24512150346581429,0.14360593327391963 \
  <<'END_OF_MODEL'
v -0.5 -0.25 0.061467682588178515
v -0.25 -0.25 -0.21017152293525476
v 0 -0.25 0.0470400026866224
v -0.5 0 -0.04656924969982098
v -0.25 0 0.0470400026866224
v 0 0 1
v 0.75 0 0.04579094280463962
v 1 0 -0.04471440983336958
v 0 0.25 0.0470400026866224
v 0.75 0.25 -0.006536976075760194
v 1 0.25 -0.015827950827987085
f 1 2 5
f 1 5 4
f 2 3 6
f 2 6 5
f 5 6 9
f 7 8 11
f 7 11 10
END_OF_MODEL

# All of that lets nothing pass that is wrong: a line more, where faces meet in
# diagonals and a plane cuts them, is still found.
a_line_more_is_found() {
  cat >model.obj
  "$recto" --view=iso --section=1 --margin=10 -q -o out.svg model.obj 2>err &&
    sed 's|</svg>|<path d="M40 40L60 45" fill="none" stroke="#000"/></svg>|' \
      out.svg >more.svg && run 0 -q model.obj --check out.svg --view=iso \
    --section=1 && run 1 -q model.obj --check more.svg --view=iso --section=1
}
claim "a line too many is found all the same" a_line_more_is_found <<'END_OF_MODEL'
v 0 1 0
v 0 0 0
v 1 2 0
v 0 2 0
v 0 0 1
v 0 2 -1
f 1 2 3 4
f 5 3 6 1
END_OF_MODEL
finish
