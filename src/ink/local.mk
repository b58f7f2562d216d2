# src/ink/local.mk - the sources of this layer.
librecto_core_la_SOURCES += \
  %D%/drawing.c %D%/drawing.h
