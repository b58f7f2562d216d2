# src/scene/local.mk - the sources of this layer.
librecto_core_la_SOURCES += \
  %D%/angle.c %D%/angle.h \
  %D%/bowtie.c %D%/bowtie.h \
  %D%/diagnostics.c \
  %D%/exact.c %D%/exact.h \
  %D%/face.c \
  %D%/limit.h \
  %D%/mark.h \
  %D%/material.c %D%/material.h \
  %D%/name.c %D%/name.h \
  %D%/nature.c \
  %D%/obj_parser.c %D%/obj_parser.h \
  %D%/obj_run.c \
  %D%/positions.c %D%/positions.h \
  %D%/precision.c %D%/precision.h \
  %D%/read.c \
  %D%/reader_mtl.c \
  %D%/reader_obj.c \
  %D%/reader_stl.c \
  %D%/scene.c \
  %D%/scene.h \
  %D%/topology.c %D%/topology.h \
  %D%/weld.c %D%/weld.h \
  %D%/write_obj.c

if HAVE_ASSIMP
librecto_core_la_SOURCES += %D%/reader_assimp.c
endif
