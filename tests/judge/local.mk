# tests/judge/local.mk - the independent judge of drawings.
check_LTLIBRARIES += %D%/libjudge.la
%C%_libjudge_la_SOURCES = \
  %D%/camera.c \
  %D%/ears.c %D%/ears.h \
  %D%/edges.c %D%/edges.h \
  %D%/grid.c %D%/grid.h \
  %D%/judge.c %D%/judge.h \
  %D%/pierced.c \
  %D%/raster.c %D%/raster.h \
  %D%/svg.c \
  %D%/triangles.c %D%/triangles.h
