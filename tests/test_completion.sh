#!/bin/bash
# test_completion.sh - bash and zsh complete the program's options and their
# values.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"

"$recto" --completion bash >recto.bash
"$recto" --completion zsh >_recto
"$recto" --help >help.txt
grep -oE '^ +(-., )?--[a-z-]+' help.txt | grep -oE -- '--[a-z-]+' >options

# has_all FILE - whether the script has every option of --help.
has_all() {
  local option all=0
  while read -r option; do
    grep -qE -- "$option([^a-z-]|\$)" "$1" || { say "$1: no $option" && all=1; }
  done <options
  return "$all"
}
claim "--help has options" test "$(wc -l <options)" -gt 50
claim "bash is told of every option" has_all recto.bash
claim "zsh is told of every option" has_all _recto
claim "another shell is refused" refuses 'bash or zsh' --completion fish

# ---- Bash -----------------------------------------------------------------

claim "bash takes the script" . ./recto.bash
claim "bash completes recto by it" eval "complete -p recto | grep -qw _recto"

# offers WORDS WORD... - what is offered for the last of the words, which are
# apart at = as bash has them; "files" where files are.
offers() {
  local line=$1 asked=
  shift
  compopt() { test "$*" != '-o default' || asked=files; }
  IFS=' ' read -ra COMP_WORDS <<<"$line"
  [[ $line == *' ' ]] && COMP_WORDS+=("")
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _recto recto "" ""
  test "$asked${COMPREPLY[*]}" = "$*" ||
    { say "offered: $asked${COMPREPLY[*]}" && false; }
}
claim "an option" offers 'recto --hatch-i' --hatch-inset
claim "options, but not those that are complete" \
  offers 'recto --fill shade --vel' --velocity --velocity-up
claim "a value behind =" offers 'recto --fill = s' shade
claim "all values behind =" offers 'recto --fill =' none paint shade hatch
claim "a value in a word of its own" offers 'recto -m wa' watkins warnock
claim "a value that the library knows" offers 'recto --view ri' right
claim "the next item of a list" offers 'recto --edges crease,sil' \
  crease,silhouette
claim "nothing for a number" offers 'recto --azimuth '
claim "a flag has no value" offers 'recto --ids --ids' --ids
claim "a value that may be left out is no word of its own" \
  offers 'recto --stats --qu' --quiet
claim "files for a file" offers 'recto -o ' files
claim "files elsewhere" offers 'recto cu' files

# ---- Zsh ------------------------------------------------------------------

# zsh_makes LINE RESULT [COMMAND] - what an interactive zsh has on its command
# line after a tab, with the script in its fpath, or what a command prints as one
# that it has evaluated.
cat >type.zsh <<'END'
zmodload zsh/zpty
zpty shell zsh -f -i
if [[ -n $2 ]]; then
  zpty -w shell "autoload -U compinit; compinit -u -D; eval \"\$($2)\""
else
  zpty -w shell "fpath=($PWD \$fpath); autoload -U compinit; compinit -u -D"
fi
zpty -w shell "PS1=; show() { print -r -- \"<\$BUFFER>\"; BUFFER=; }"
zpty -w shell "zle -N show; bindkey '^X' show; print ready:"
zpty -r shell line '*ready:*ready:*'
zpty -w -n shell "$1"$'\t\x18'
zpty -r shell line '*<*>*'
print -r -- "${${line##*<}%%>*}"
zpty -d shell
END
zsh_makes() {
  local line
  line=$(timeout 60 zsh -f type.zsh "$1" "${3-}" 2>&1)
  test "$line" = "$2" || { say "made: $line" && false; }
}
if command -v zsh >/dev/null; then
  claim "zsh takes the script" zsh -n _recto
  claim "zsh completes an option" zsh_makes 'recto --hatch-i' \
    'recto --hatch-inset '
  claim "zsh completes a value" zsh_makes 'recto --fill=sh' 'recto --fill=shade '
  claim "zsh completes the next item of a list" \
    zsh_makes 'recto --edges=crease,sil' 'recto --edges=crease,silhouette,'
  claim "zsh completes after eval" zsh_makes 'recto --hatch-i' \
    'recto --hatch-inset ' "'$recto' --completion zsh"
  claim "zsh completes a model" zsh_makes 'recto cu' 'recto cube.obj '
else
  skip "zsh completes" "no zsh"
fi
finish
