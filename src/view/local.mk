# src/view/local.mk - the sources of this layer.
librecto_core_la_SOURCES += \
  %D%/page_overflow.c %D%/page_overflow.h \
  %D%/camera.c %D%/camera.h \
  %D%/clip.c %D%/clip.h \
  %D%/coordinate_error.c %D%/coordinate_error.h \
  %D%/extent.c %D%/extent.h \
  %D%/camera_aim.c %D%/camera_aim.h \
  %D%/camera_fit.c %D%/camera_phases.h \
  %D%/camera_extent.c %D%/camera_extent.h \
  %D%/camera_axes.c %D%/camera_axes.h \
  %D%/layout.c %D%/layout.h \
  %D%/layout_classes.c \
  %D%/layout_edge_choice.c %D%/layout_edge_choice.h \
  %D%/layout_edges.c \
  %D%/layout_face_ranges.c %D%/layout_face_ranges.h \
  %D%/layout_clipping.c %D%/layout_clipping.h \
  %D%/layout_phases.h \
  %D%/layout_face_sign.c %D%/layout_face_sign.h \
  %D%/layout_points.c \
  %D%/layout_polygon_ranges.c %D%/layout_polygon_ranges.h \
  %D%/layout_range.c \
  %D%/layout_triangles.c \
  %D%/layout_unclipped.c %D%/layout_unclipped.h \
  %D%/preferred_scale.c %D%/preferred_scale.h \
  %D%/project.c %D%/project.h \
  %D%/rescale.c %D%/rescale.h \
  %D%/scene_part.c %D%/scene_part.h \
  %D%/sheet.c %D%/sheet.h \
  %D%/sheet_sides.c \
  %D%/used.c %D%/used.h \
  %D%/used_box.c %D%/used_box.h
