# src/judge/local.mk - the independent judge: sees the scene alone.
librecto_core_la_SOURCES += \
  %D%/camera.c %D%/contact.c %D%/contact.h \
  %D%/cuts.c %D%/cuts.h \
  %D%/ears.c %D%/ears.h \
  %D%/edges.c %D%/edges.h \
  %D%/gaze.c %D%/gaze.h \
  %D%/grid.c %D%/grid.h \
  %D%/judge.c %D%/judge.h \
  %D%/missing_run.c %D%/missing_run.h \
  %D%/pierced.c \
  %D%/sight.c %D%/sight.h \
  %D%/svg.c \
  %D%/svg_path.c %D%/svg_path.h \
  %D%/svg_pen.c %D%/svg_pen.h \
  %D%/svg_scan.c %D%/svg_scan.h \
  %D%/triangles.c %D%/triangles.h
