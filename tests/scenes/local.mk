# tests/scenes/local.mk - the scenes that tests, bench and fuzzer share.
check_LTLIBRARIES += %D%/libscenes.la
%C%_libscenes_la_SOURCES = \
  %D%/build.c %D%/build.h \
  %D%/camera.c \
  %D%/catmull_clark.c %D%/catmull_clark.h \
  %D%/duplicates.c \
  %D%/cycles.c \
  %D%/faulty.c \
  %D%/flaws.c \
  %D%/judge_camera.c %D%/judge_camera.h \
  %D%/layers.c \
  %D%/list.c \
  %D%/mass.c \
  %D%/meshes.c \
  %D%/needles.c \
  %D%/paper.c \
  %D%/piercing.c \
  %D%/exact.h %D%/pipeline.c %D%/pipeline.h \
  %D%/random.h \
  %D%/scenes.h %D%/box.h \
  %D%/small.c \
  %D%/solids.c \
  %D%/solver_named.h \
  %D%/stacks.c \
  %D%/subdivide.c %D%/subdivide.h \
  %D%/surfaces.c \
  %D%/write_obj.c %D%/write_obj.h
