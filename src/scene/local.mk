# src/scene/local.mk - the sources of this layer.
librecto_core_la_SOURCES += \
  %D%/angle.c %D%/angle.h \
  %D%/nature.c \
  %D%/topology.c %D%/topology.h \
  %D%/weld.c %D%/weld.h
