#!/bin/bash
# test_options_without_effect.sh - an option that has no effect on what is
# requested is reported, in one line; one that has an effect is not.
. "$(dirname "$0")/tap.sh"
cd "$scratch" || exit 1

cat >wedge.obj <<'OBJ'
v 0 0 0
v 2 0 0
v 0 2 0
v 0 0 2
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
OBJ
"$recto" wedge.obj -o own.svg || exit 1
"$recto" --help >help.txt
: >reported

# draw FILE ARGUMENT... - draws to the file, its messages in err.
draw() {
  local file=$1
  shift
  "$recto" wedge.obj -o "$file" "$@" >out 2>err </dev/null ||
    { say "exit $?: $(head -n 3 err)" && false; }
}

# Any message is allowed except that an option is not used.
is_used() {
  draw "$@" && ! grep ' does not use it$' err >unused && return 0
  say "$(cat unused)" && false
}

is_reported() { # LINE FILE ARGUMENT...
  local line=$1
  shift
  draw "$@" && test "$(grep -c ' does not use it$' err)" -eq 1 &&
    grep -qxF -- "recto: $line does not use it" err && return 0
  say "not so: $(cat err)" && false
}

has_cairo() { grep -q -- '--dpi' help.txt; }

# What is used with FILE and OPTIONS, and not with FILE and OPTIONS, and who
# says so.
while IFS='|' read -r option used unused line; do
  case $option in --dpi*) has_cairo || continue ;; esac
  # shellcheck disable=SC2086 # words of options
  claim "$option is used by $used" is_used $used $option
  # What is said later wins.
  # shellcheck disable=SC2086
  claim "$option is not by $unused" is_reported "${option%%[= ]*} is for $line" \
    ${unused%% *} $option ${unused#"${unused%% *}"}
  grep -qxF -e "${option%%[= ]*}" reported || echo "${option%%[= ]*}" >>reported
done <<'END_OF_ROWS'
--pitch 3|a.svg -m watkins|a.svg -m tiles|watkins; tiles
--pitch exact|a.svg -m watkins|a.svg|watkins; auto
--resolution 99|a.svg -m zbuffer|a.svg -m newell|zbuffer, scanline-zbuffer and warnock; newell
--resolution 99|a.svg -m warnock|a.svg -m watkins|zbuffer, scanline-zbuffer and warnock; watkins
--divide box|a.svg -m warnock|a.svg -m zbuffer|warnock; zbuffer
--depth-bits 16|a.svg -m scanline-zbuffer|a.svg -m warnock|zbuffer and scanline-zbuffer; warnock
--subpixels 2|a.svg -m zbuffer|a.svg -m brute|zbuffer, scanline-zbuffer and warnock with --resolution; brute
--remove-backs|a.svg -m warnock --resolution 99|a.svg -m warnock|zbuffer, scanline-zbuffer and warnock with --resolution; warnock
--contact 0|a.svg|a.svg -m painter|methods that compare depths; painter
--lookat 0,0,1|a.svg --fov 20|a.svg|--camera, --fov, --no-fit and --scale; --fit
--fov 20|a.svg --view top|a.svg -c 5,4,3|named views and for --no-fit; --fit
--fov 20|a.svg -c 5,4,3 --no-fit|a.svg -c 5,4,3 --scale 1:2|named views and for --no-fit; --scale
--cut-fill solid|a.svg --cut z=1|a.svg|--cut and --section; a run without --cut
--cut-hatch wedge=30|a.svg --section 1|a.svg|--cut and --section; a run without --cut
--unit m|a.svg --scale 1:2|a.svg|true scale and several models; --fit
--scale 1:2|a.svg|a.svg --no-fit|true scale; --no-fit
--crease 20|a.svg|a.svg -e silhouette|edges of the classes crease and smooth, fills and smooth contours; this --edges
--crease 20|a.svg -e none --fill shade|a.svg -e border|edges of the classes crease and smooth, fills and smooth contours; this --edges
--crease 20|a.svg -e silhouette --contours smooth|a.svg -e silhouette|edges of the classes crease and smooth, fills and smooth contours; this --edges
--crease-marks all|a.svg|a.svg -e silhouette|edges of the classes crease and smooth, fills and smooth contours; this --edges
--contours smooth|a.svg|a.svg -e crease|edges of the class silhouette; this --edges
--hidden layer|a.svg|a.svg -e none --fill paint|lines; --edges none
--hidden-in top=layer|a.svg --sheet first|a.svg --sheet first -e none --fill paint|lines; --edges none
--dash crease=chain|a.svg|a.svg -e none --fill paint|lines; --edges none
--weights none|a.svg|a.svg -e none --fill paint|lines; --edges none
--weights none|a.svg|a.hpgl|svg, pdf, eps, ps and png; hpgl
--simplify 1|a.svg|a.svg -e none --fill hatch|lines; --edges none
--curves 1|a.svg|a.svg -e none --fill hatch|lines; --edges none
--pen 1|a.svg -e none --fill hatch|a.svg -e none --fill paint|lines and hatching; --edges none
--pens 1|a.svg|a.svg -e none --fill paint|lines and hatching; --edges none
--pen-for hatch=2|a.svg --fill hatch|a.svg -e none --fill paint|lines and hatching; --edges none
--pen-width 1=1|a.hpgl|a.svg -e none --fill paint|lines and hatching; --edges none
--pen-color 1=00f|a.svg|a.hpgl|svg, pdf, eps, ps and png; hpgl
--pen-colour 1=00f|a.svg|a.hpgl|svg, pdf, eps, ps and png; hpgl
--order near|a.svg|a.svg -e none --fill paint|lines and hatching; --edges none
--min-stroke 1|a.svg|a.svg -e none --fill paint|lines and hatching; --edges none
--exact|a.svg|a.svg -e none --fill hatch|lines; --edges none
--seam 0.1|a.svg --fill shade|a.svg --fill hatch|--fill paint and --fill shade; --fill hatch
--hatch-pitch 2|a.svg --fill hatch|a.svg --fill paint|--fill hatch; --fill paint
--hatch-pitch 2|a.svg --fill hatch|a.svg --fill hatch --light 1,1,1|hatching of one pitch; hatching by --light
--hatch-pitch 2|a.svg --cut z=1|a.svg --cut z=1 --cut-fill none|--fill hatch; --fill none
--hatch-angle 2|a.svg --fill hatch --light 1,1,1|a.svg|--fill hatch; --fill none
--hatch-inset|a.svg --fill hatch|a.svg --fill hatch --light 1,1,1|hatching of one pitch; hatching by --light
--ambient 0.1|a.svg --fill shade|a.svg --fill hatch|--fill shade and for --fill hatch with --light; --fill hatch
--fill-light 0.1|a.svg --fill hatch --light 1,1,1|a.svg --fill paint|--fill shade and --fill hatch; --fill paint
--light 1,1,1|a.svg --fill shade|a.svg --fill paint|--fill shade and --fill hatch; --fill paint
--ids|a.svg|a.hpgl|svg; hpgl
--id-prefix a|a.svg|a.hpgl|svg; hpgl
--title a|a.svg|a.hpgl|svg, pdf, eps, ps and sheets; hpgl
--title a|a.hpgl --sheet first|a.png|svg, pdf, eps, ps and sheets; png
--desc a|a.svg|a.eps|svg and pdf; eps
--background navy|a.svg|a.hpgl|svg, pdf, eps, ps and png; hpgl
--precision 2|a.svg|a.hpgl|svg; hpgl
--path polyline|a.plt --format svg|a.svg --format hpgl|svg; hpgl
--device drum|a.hpgl|a.svg|hpgl and --stats; svg
--device drum|a.svg --stats|a.svg|hpgl and --stats; svg
--velocity 3|a.hpgl|a.svg|hpgl and --stats; svg
--frames 0-1|a%d.svg --turntable 3|a.svg|--turntable; a run without --turntable
--resume|a.recto --part 1/2|a.svg|--part; a run without --part
--velocity-up 3|a.svg --stats|a.hpgl|the time in --stats; a run without --stats
--portrait|a.svg|a.svg --page 90x90|pages that are not square; a square one
--landscape|a.svg|a.svg --page 90x90|pages that are not square; a square one
--tight|a.svg|a.hpgl|svg, pdf, eps, ps and png; hpgl
--dpi 30|a.png|a.pdf|png; pdf
END_OF_ROWS

# A class of which the model has no line, whatever is visible.
says_alone() { # LINE ARGUMENT... - that warning and no other
  local line=$1
  shift
  draw a.svg "$@" && test "$(cat err)" = "${line:+recto: $line}" && return 0
  say "not so: $(cat err)" && false
}
none='lines, of which there are none'
claim "dashes for a class that the model does not have are reported" \
  says_alone "dashes are for border $none" --dash border=chain
claim "so are pens" says_alone "pen 2 is for border $none" --pen-for border=2
claim "also of lines in which faces pierce each other" \
  says_alone "pen 3 is for intersection $none" --pen-for intersection=3,crease=2
claim "dashes and pens of lines that are there are not" \
  says_alone '' --dash silhouette=chain --pen-for crease=2
claim "nor those of lines that are all hidden" \
  says_alone '' -e crease --dash crease=chain --view bottom
claim "nor are weights" says_alone '' --weights border=3
head -n 6 wedge.obj >open.obj
joins_open() {
  "$recto" wedge.obj --part 1/1 -o whole.recto &&
    "$recto" --join whole.recto -o a.svg --dash border=chain 2>err &&
    test "$(cat err)" = "recto: dashes are for border $none" &&
    "$recto" open.obj -o a.svg --dash border=chain 2>err && test ! -s err
}
claim "a join says so too, and an open model has borders" joins_open

# judges ARGUMENT... - has own.svg judged, the messages in err.
# Right or wrong: both are an answer.
judges() {
  "$recto" wedge.obj --check own.svg "$@" >out 2>err
  test $? -le 1
}

# What --check draws with is not used; what it looks with is.
check_tells() {
  judges "$@" && grep -qxF -- "recto: $1 is for $line; --check does not use it" err
}
while IFS='|' read -r option line; do
  # shellcheck disable=SC2086
  claim "$option is not used by --check" check_tells $option
done <<'END_OF_ROWS'
--method newell|drawings
--page A5|drawings and --tight
--landscape|drawings and --tight
--threads 1|drawings
--fill paint|drawings
--hidden layer|lines
--order near|lines and hatching
--pitch 3|watkins
END_OF_ROWS
check_uses() { judges "$@" && test ! -s err; }
check_reports_progress() {
  judges --progress && ! grep -q 'does not use it' err
}
claim "--progress is used by --check" check_reports_progress
claim "--check looks with the same camera, edges and tolerances" \
  check_uses --view iso --lookat 0,0,1 --fov 20 --no-fit --margin 5 \
  -e all --contours smooth --crease 20 --contact 0 --pen 0.3 --min-stroke 0.1 --exact --pen-width 2=0.5 \
  --simplify 0.1 --curves 0.1 --precision 2

claim "and at the page of a tight drawing" \
  check_uses --tight -p A4 --portrait

claim "a tolerance is used by --check" check_uses --tolerance 1%

all_are_quiet() {
  draw a.svg -q --pitch 3 --seam 1 --depth-bits 16 && test ! -s err
}
claim "--quiet says nothing of it" all_are_quiet
draws_the_same() {
  draw plain.svg && draw a.svg --pitch 3 --seam 1 && cmp -s plain.svg a.svg &&
    test "$(wc -l <err)" -eq 2
}
claim "the drawing is the same, a line an option" draws_the_same

# Those that always do something, or that refuse what they do not go with.
always='--output --format --from --method --view --sheet --views --view-names --detail --turntable --azimuth --elevation --camera
--up --ortho --fit --no-fit --near --cut --section --page --landscape --portrait --margin --edges
--weld --fill --stats --verify --check --tolerance --threads --progress --quiet --completion --version --help
--part --plan --parts-plan --join'
every_option_has_its_row() {
  grep -oE -- '^ +(-.,)? *--[a-z-]+' help.txt | grep -oE -- '--[a-z-]+' |
    LC_ALL=C sort -u >offered
  tr ' ' '\n' <<<"$always" | LC_ALL=C sort -u - reported >known
  LC_ALL=C comm -23 offered known >rowless
  test ! -s rowless || { say "no row: $(cat rowless)" && false; }
}
claim "every option of --help has its row or always does something" \
  every_option_has_its_row
finish
