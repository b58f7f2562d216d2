# src/parts/local.mk - the sources of this layer.
librecto_core_la_SOURCES += \
  %D%/byte_codec.c %D%/byte_codec.h \
  %D%/edge_runs.c %D%/edge_runs.h \
  %D%/face_pick.c %D%/face_pick.h \
  %D%/face_source.c %D%/face_source.h \
  %D%/interval_lists.c %D%/interval_lists.h \
  %D%/may_weld.c \
  %D%/merge_order.c %D%/merge_order.h \
  %D%/page_windows.c %D%/page_windows.h \
  %D%/part.c %D%/part.h \
  %D%/part_common.c %D%/part_common.h \
  %D%/part_collect.c %D%/part_collect.h \
  %D%/part_file.c %D%/part_file.h \
  %D%/part_join.c %D%/part_join.h \
  %D%/part_join_edges.c \
  %D%/part_join_phases.h \
  %D%/part_join_scene.c \
  %D%/part_merge.c %D%/part_merge.h \
  %D%/part_points.c %D%/part_points.h \
  %D%/part_scene.c %D%/part_scene.h \
  %D%/part_sources.h \
  %D%/place_set.c %D%/place_set.h \
  %D%/plan_bytes.c %D%/plan_bytes.h \
  %D%/plan_faces.c %D%/plan_faces.h \
  %D%/plan_file.c %D%/plan_file.h \
  %D%/plan_section.c %D%/plan_section.h \
  %D%/plan_section_check.c \
  %D%/plan_section_make.c \
  %D%/ring_corners.c %D%/ring_corners.h \
  %D%/side_marks.c %D%/side_marks.h \
  %D%/unread_edges.c %D%/unread_edges.h \
  %D%/window_grid.c %D%/window_grid.h
