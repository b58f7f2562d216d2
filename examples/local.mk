# examples/local.mk - example models and what makes them.
noinst_PROGRAMS += %D%/generate
%C%_generate_SOURCES = %D%/generate.c %D%/models.h \
  %D%/castle.c %D%/gears.c %D%/knot.c %D%/star.c %D%/vase.c %D%/wave.c \
  %D%/shape.c %D%/shape.h
%C%_generate_LDADD = -lm

noinst_PROGRAMS += %D%/draw
%C%_draw_SOURCES = %D%/draw.c
%C%_draw_LDADD = librecto.la

example_models = %D%/models/castle.obj %D%/models/gears.obj \
  %D%/models/knot.obj %D%/models/star.obj %D%/models/vase.obj \
  %D%/models/wave.obj
EXTRA_DIST += $(example_models)

# Makes the committed models anew.
models: examples/generate$(EXEEXT)
	for model in $(example_models); do \
	  name=$$(basename $$model .obj); \
	  examples/generate$(EXEEXT) $$name >$(srcdir)/$$model || exit 1; \
	done
.PHONY: models

# Compiled by tests/test_examples.sh as a user would.
EXTRA_DIST += %D%/surface.c %D%/turntable.c %D%/dxf.c %D%/gcode.c \
  %D%/faces.c %D%/hides.c

# Drawings in parts, by engines that others wrote.
EXTRA_DIST += %D%/parallel.sh %D%/slurm.sbatch %D%/make/Makefile
