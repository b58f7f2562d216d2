# src/cut/local.mk - the sources of this layer.
librecto_core_la_SOURCES += \
  %D%/common_vertex_flow.c \
  %D%/cut.h \
  %D%/cut_assemble.c \
  %D%/cut_faces.c \
  %D%/cut_lines.c %D%/cut_lines.h \
  %D%/cut_phases.h \
  %D%/cut_points.c %D%/cut_points.h \
  %D%/cut_scene.c \
  %D%/cut_sections.c \
  %D%/section.c %D%/section.h \
  %D%/section_loops.c \
  %D%/section_phases.h \
  %D%/section_solve.c \
  %D%/section_sweep.c \
  %D%/snap_rounding.c
