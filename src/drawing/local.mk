# src/drawing/local.mk - what backends write: strokes and fills in mm.
librecto_core_la_SOURCES += \
  %D%/append.c %D%/append.h \
  %D%/circle_clip.c %D%/circle_clip.h \
  %D%/circle_clip_fill.c %D%/circle_clip_fill.h \
  %D%/curve.c \
  %D%/drawing.c %D%/drawing.h \
  %D%/simplex.c %D%/simplex.h \
  %D%/text.c %D%/text.h
EXTRA_DIST += %D%/simplex.awk

# The font's glyphs, from the file that Debian's hershey-fonts-data has.
HERSHEY_FONT = /usr/share/hershey-fonts/rowmans.jhf
.PHONY: font
font:
	$(AM_V_GEN)$(AWK) -f $(srcdir)/%D%/simplex.awk $(HERSHEY_FONT) \
	  > $(srcdir)/%D%/simplex.c
