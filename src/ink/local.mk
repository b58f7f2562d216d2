# src/ink/local.mk - the sources of this layer.
librecto_core_la_SOURCES += \
  %D%/blur.c %D%/blur.h \
  %D%/chain.c \
  %D%/cuts.c %D%/cuts.h \
  %D%/coincident.c \
  %D%/dash.c \
  %D%/drawing.c %D%/drawing.h \
  %D%/engrave.c \
  %D%/fill.c %D%/fill.h %D%/hatch.c \
  %D%/ink.c %D%/ink.h \
  %D%/inset.c %D%/inset.h \
  %D%/layers.c %D%/layers.h \
  %D%/nearest.c %D%/nearest.h \
  %D%/light.c %D%/light.h \
  %D%/merge.c %D%/merge.h \
  %D%/net.h %D%/nodes.c \
  %D%/order.c %D%/order.h \
  %D%/outline.c %D%/outline.h \
  %D%/overlap.c %D%/overlap.h \
  %D%/pairing.c %D%/pairing.h \
  %D%/patches.c %D%/patches.h \
  %D%/paths.h \
  %D%/pens.c %D%/pens.h %D%/pens_idle.c \
  %D%/repeats.c \
  %D%/ruling.c %D%/ruling.h \
  %D%/runs.c %D%/runs.h \
  %D%/segments.c \
  %D%/simplify.c \
  %D%/straighten.c \
  %D%/stroke.c %D%/stroke.h \
  %D%/tone.c %D%/tone.h \
  %D%/tour.c %D%/tour.h \
  %D%/walk.c %D%/walk.h
