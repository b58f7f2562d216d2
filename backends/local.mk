# backends/local.mk - one writer per format.
librecto_core_la_SOURCES += \
  %D%/device.c %D%/device.h \
  %D%/hpgl_batch.c %D%/hpgl_batch.h \
  %D%/hpgl_strokes.c %D%/hpgl_strokes.h \
  %D%/svg_batch.c %D%/svg_batch.h \
  %D%/svg_elements.c %D%/svg_elements.h \
  %D%/svg_text.c %D%/svg_text.h \
  %D%/text_chunks.c %D%/text_chunks.h \
  %D%/writer.h \
  %D%/writer_hpgl.c \
  %D%/writer_svg.c \
  %D%/writers.c
if HAVE_CAIRO
librecto_core_la_SOURCES += %D%/writer_cairo.c
endif
EXTRA_DIST += %D%/README.md
