# src/judge/local.mk - the independent judge: sees the scene alone.
librecto_core_la_SOURCES += \
  %D%/camera.c %D%/camera.h \
  %D%/clipped_triangle.c %D%/clipped_triangle.h \
  %D%/collinear_cuts.c %D%/collinear_cuts.h \
  %D%/cut_edges.c %D%/cut_edges.h \
  %D%/contact.c %D%/contact.h \
  %D%/drawing.c %D%/drawing.h \
  %D%/ear_clipping.c %D%/ear_clipping.h \
  %D%/edge_list.c %D%/edge_list.h \
  %D%/edge_classes.c %D%/edge_classes.h \
  %D%/edges.c %D%/edges.h \
  %D%/face_sides.c %D%/face_sides.h \
  %D%/folds.c %D%/folds.h \
  %D%/grid.c %D%/grid.h \
  %D%/intersections.c %D%/intersections.h \
  %D%/judge.c %D%/judge.h \
  %D%/judge_context.c %D%/judge_context.h \
  %D%/missing_run.c %D%/missing_run.h \
  %D%/near_polygon.c %D%/near_polygon.h \
  %D%/open_surfaces.c %D%/open_surfaces.h \
  %D%/options.c %D%/options.h \
  %D%/point.h \
  %D%/ray.c %D%/ray.h \
  %D%/removed.h \
  %D%/sampler.c %D%/sampler.h \
  %D%/segment_sampler.c %D%/segment_sampler.h \
  %D%/traversal.c %D%/traversal.h \
  %D%/triangles.c %D%/triangles.h \
  %D%/triangulation.c %D%/triangulation.h \
  %D%/winding.c %D%/winding.h \
  %D%/svg/svg.c %D%/svg/svg.h \
  %D%/svg/svg_path.c %D%/svg/svg_path.h \
  %D%/svg/svg_pen.c %D%/svg/svg_pen.h \
  %D%/svg/svg_scan.c %D%/svg/svg_scan.h
