# simplex.awk - simplex.c: the glyphs of Hershey's simplex Roman font, from the
# file rowmans.jhf of Debian's hershey-fonts-data, in the order of ASCII from the
# space on.
#
# A line of that file: a glyph's number in 5 columns, the number of pairs of
# coordinates in 3, and the pairs, each of two letters.
BEGIN {
  print "/* simplex.c - the glyphs of Hershey's simplex Roman font; made by"
  print " * simplex.awk, which says of what."
  print " *"
  print " * The Hershey Fonts were originally created by Dr. A. V. Hershey while working"
  print " * at the U. S. National Bureau of Standards.  The format of the font data was"
  print " * originally created by James Hurt, Cognition, Inc., 900 Technology Park Drive,"
  print " * Billerica, MA 01821 (mit-eddie!ci-dandelion!hurt).  The font data may be used"
  print " * by anyone for any purpose, with these acknowledgements, and be converted into"
  print " * any format except that of the U.S. NTIS."
  print " * Source  [Hershey1967] */"
  print "#include \"drawing/simplex.h\""
  print ""
  print "const char *const simplex_glyph[SIMPLEX_GLYPHS] = {"
}
{
  pairs = substr($0, 6, 3) + 0
  text = substr($0, 9)
  if (length(text) != 2 * pairs) {
    print "simplex.awk: glyph " NR " is broken" >"/dev/stderr"
    exit 1
  }
  gsub(/\\/, "\\\\", text)
  gsub(/"/, "\\\"", text)
  while (length(text) > 72) {
    cut = substr(text, 1, 72) ~ /[^\\]\\$/ ? 71 : 72
    print "    \"" substr(text, 1, cut) "\""
    text = substr(text, cut + 1)
  }
  print "    \"" text "\","
}
END { print "};" }
