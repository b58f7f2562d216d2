# src/drawing/local.mk - what backends write: strokes and fills in mm.
librecto_core_la_SOURCES += \
  %D%/append.c %D%/append.h \
  %D%/curve.c \
  %D%/drawing.c %D%/drawing.h
