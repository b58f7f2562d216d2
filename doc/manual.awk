# manual.awk - recto(3): the comments of src/recto.h, the first file, in the
# frame of the second.
#
# A block of the header is a comment and the declarations below it, up to an
# empty line; it is an entry where it declares a function or the type of one.
# Structs, enumerations and constants are shown as they stand there.

# Text as troff takes it; names in backquotes become italic.
function escape(text) {
  gsub(/\\/, "\\e", text)
  gsub(/-/, "\\-", text)
  while (match(text, /`[^`]*`/))
    text = substr(text, 1, RSTART - 1) "\\fI" \
      substr(text, RSTART + 1, RLENGTH - 2) "\\fR" \
      substr(text, RSTART + RLENGTH)
  return text ~ /^[.']/ ? "\\&" text : text
}
# A line of a comment without its stars.
function bare(line) {
  sub(/^\/\* ?/, "", line)
  sub(/ *\*\/ *$/, "", line)
  sub(/^ \* ?/, "", line)
  return line
}
# A line of a comment; one that starts with a word apart starts a line.
function render(line, name) {
  if (match(line, /^[A-Za-z]+   */)) {
    name = substr(line, 1, RLENGTH)
    line = substr(line, RLENGTH + 1)
    sub(/ +$/, "", name)
    return ".br\n.I " name "\n" escape(line) "\n"
  }
  sub(/^ +/, "", line)
  return line == "" ? "" : escape(line) "\n"
}
function add_entry(declarations, count, part, i, heads) {
  count = split(declarations, part, ";")
  for (i = 1; i <= count; i++) {
    gsub(/^ +|RECTO_USE_RESULT | +$/, "", part[i])
    if (part[i] ~ /recto_[a-z_]+\)?\(/ && part[i] !~ /[{}]/) {
      gsub(/ +/, " ", part[i])
      gsub(/\( /, "(", part[i])
      gsub(/\*/, "* ", part[i])
      gsub(/\* +/, "*", part[i])
      functions = functions (heads++ ? ".TQ\n" : ".TP\n") ".B " \
        escape(part[i]) "\n"
    }
  }
  if (heads)
    functions = functions text
  if (constants != "")
    show(constants)
  constants = ""
}
# Lines of the header as they are, after the comment above them.
function show(lines) {
  functions = functions ".PP\n" text ".nf\n" lines ".fi\n"
}

FNR == NR && !opened { # the comment that opens the header
  if (match($0, /^ \* [A-Z][a-z]+  +/)) {
    conventions = conventions ".TP\n.B " $2 "\n" \
      escape(substr($0, RLENGTH + 1)) "\n"
  } else if (conventions != "" && !/\*\//) {
    line = bare($0)
    sub(/^ +/, "", line)
    conventions = conventions escape(line) "\n"
  }
  opened = /\*\//
  next
}
FNR == NR && /^  RECTO_(OK|ERROR_)/ {
  name = $1
  sub(/,$/, "", name)
  line = $0
  sub(/^[^*]*\* /, "", line)
  statuses = statuses sprintf("%-26s%s\n", name, \
    /\/\*/ ? bare(escape(line)) : "done")
}
FNR == NR && /^typedef (struct|enum).*{$/ {
  add_entry(declarations)
  declarations = type = ""
  showing = 1
}
FNR == NR && showing {
  type = type escape($0) "\n"
  if (/^}/) {
    show(type)
    text = ""
    showing = 0
  }
  next
}
FNR == NR && /^#define RECTO_[A-Z_]+ +[0-9U]/ {
  constants = constants escape($0) "\n"
  next
}
FNR == NR && /^\/\* ----/ { # a section, perhaps with a text
  title = $0
  gsub(/^\/\* -+ | -+( \*\/)?$/, "", title)
  functions = functions ".SS " title "\n"
  section = !/\*\//
  next
}
FNR == NR && section {
  line = bare($0)
  functions = functions render(line)
  section = !/\*\//
  next
}
FNR == NR && /^\/\*/ {
  add_entry(declarations)
  text = ""
  declarations = ""
  commenting = 1
}
FNR == NR && commenting {
  text = text render(bare($0))
  commenting = !/\*\//
  next
}
FNR == NR && /^$/ {
  add_entry(declarations)
  text = declarations = ""
}
FNR == NR {
  line = $0
  if (line ~ /^#define recto_/) {
    sub(/^#define /, "", line)
    sub(/ *\\$/, ";", line)
  } else if (line ~ /^#|\\$/ || line ~ /sizeof \*/) {
    next
  }
  declarations = declarations " " line
  next
}

/^@CONVENTIONS@$/ { printf "%s", conventions; next }
/^@STATUSES@$/ { printf "%s", statuses; next }
/^@FUNCTIONS@$/ { printf "%s", functions; next }
{ print }
