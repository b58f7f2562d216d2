# src/visibility/local.mk - from the sheet to the visible map, a folder a step
# or a method.
librecto_core_la_SOURCES += \
  %D%/auto.c \
  %D%/dense_edges.c %D%/dense_edges.h \
  %D%/hidden_faces.c %D%/hidden_faces.h \
  %D%/map.c %D%/map.h \
  %D%/map_assembly.c %D%/map_assembly.h \
  %D%/progress.c %D%/progress.h \
  %D%/quantitative_invisibility.c %D%/quantitative_invisibility.h \
  %D%/smooth_contours.c %D%/smooth_contours.h \
  %D%/smooth_curves.c %D%/smooth_curves.h \
  %D%/smooth_surface.c %D%/smooth_surface.h \
  %D%/solver.c %D%/solver.h \
  %D%/brute/brute.c %D%/brute/brute.h \
  %D%/contour/contour_creases.c %D%/contour/contour_creases.h \
  %D%/contour/contour_curves.c %D%/contour/contour_curves.h \
  %D%/contour/contour_cusps.c %D%/contour/contour_cusps.h \
  %D%/contour/curve_ends.c %D%/contour/curve_ends.h \
  %D%/contour/curve_pieces.c %D%/contour/curve_pieces.h \
  %D%/contour/divided_curves.c %D%/contour/divided_curves.h \
  %D%/contour/doubled_cells.c %D%/contour/doubled_cells.h \
  %D%/contour/doubled_contours.c %D%/contour/doubled_contours.h \
  %D%/contour/end_zigzags.c %D%/contour/end_zigzags.h \
  %D%/contour/intersection_cuts.c %D%/contour/intersection_cuts.h \
  %D%/contour/intersection_ends.c %D%/contour/intersection_ends.h \
  %D%/contour/near_faces.c %D%/contour/near_faces.h \
  %D%/contour/occluders.c %D%/contour/occluders.h \
  %D%/contour/page_cover.c %D%/contour/page_cover.h \
  %D%/contour/page_crossings.c %D%/contour/page_crossings.h \
  %D%/contour/page_loop.c %D%/contour/page_loop.h \
  %D%/contour/part_size.c %D%/contour/part_size.h \
  %D%/contour/segment_grid.c %D%/contour/segment_grid.h \
  %D%/contour/loop_stack.c %D%/contour/loop_stack.h \
  %D%/contour/thin_loops.c %D%/contour/thin_loops.h \
  %D%/culling/contact_bounds.c %D%/culling/contact_bounds.h \
  %D%/culling/culling_bands.c %D%/culling/culling_bands.h \
  %D%/culling/face_runs.c %D%/culling/face_runs.h \
  %D%/culling/face_samples.c %D%/culling/face_samples.h \
  %D%/culling/occlusion_buffer.c %D%/culling/occlusion_buffer.h \
  %D%/culling/occlusion_culling.c %D%/culling/occlusion_culling.h \
  %D%/culling/occlusion_raising.c \
  %D%/culling/potentially_visible.c %D%/culling/potentially_visible.h \
  %D%/culling/potentially_visible_restore.c \
  %D%/culling/space_box.c %D%/culling/space_box.h \
  %D%/culling/vertex_fans.c %D%/culling/vertex_fans.h \
  %D%/fit/border_ends.c %D%/fit/border_ends.h \
  %D%/fit/border_sides.c %D%/fit/border_sides.h \
  %D%/fit/corner_moves.c %D%/fit/corner_moves.h \
  %D%/fit/drawn_outlines.c %D%/fit/drawn_outlines.h \
  %D%/fit/fit_fragments.c %D%/fit/fit_fragments.h \
  %D%/fit/fit_outline.c %D%/fit/fit_outline.h \
  %D%/fit/line_ends.c %D%/fit/line_ends.h \
  %D%/fit/loop_changes.c %D%/fit/loop_changes.h \
  %D%/fold/added_edges.c %D%/fold/added_edges.h \
  %D%/fold/added_folds.c %D%/fold/added_folds.h \
  %D%/fold/fold_bridges.c %D%/fold/fold_bridges.h \
  %D%/fold/fold_chains.c %D%/fold/fold_chains.h \
  %D%/fold/fold_joints.c %D%/fold/fold_joints.h \
  %D%/fold/fold_lines.c %D%/fold/fold_lines.h \
  %D%/fold/fold_samples.c %D%/fold/fold_samples.h \
  %D%/fold/intersection_gaps.c %D%/fold/intersection_gaps.h \
  %D%/fold/nearest_contours.c %D%/fold/nearest_contours.h \
  %D%/fold/outline_chains.c %D%/fold/outline_chains.h \
  %D%/fold/outline_ends.c %D%/fold/outline_ends.h \
  %D%/fold/outline_gaps.c %D%/fold/outline_gaps.h \
  %D%/fold/outlined_curves.h \
  %D%/fragments/face_union.c %D%/fragments/face_union.h \
  %D%/fragments/fragments.c %D%/fragments/fragments.h \
  %D%/fragments/fragments_union.c \
  %D%/fragments/line_index.c %D%/fragments/line_index.h \
  %D%/fragments/occluder_subtraction.c %D%/fragments/occluder_subtraction.h \
  %D%/fragments/planar_subdivision.c %D%/fragments/planar_subdivision.h \
  %D%/fragments/region_split.c \
  %D%/fragments/side_provenance.c %D%/fragments/side_provenance.h \
  %D%/index/bsp.c %D%/index/bsp.h \
  %D%/index/bsp_plane.c %D%/index/bsp_plane.h \
  %D%/index/bvh.c %D%/index/bvh.h \
  %D%/index/common_corners.c %D%/index/common_corners.h \
  %D%/index/duplicate_triangles.c %D%/index/duplicate_triangles.h \
  %D%/index/kdop8.h \
  %D%/index/partial_grid.c %D%/index/partial_grid.h \
  %D%/index/triangle_grid.c %D%/index/triangle_grid.h \
  %D%/index/triangle_grid_row.c \
  %D%/index/upper_plane.c %D%/index/upper_plane.h \
  %D%/intersection/candidate_pairs.c %D%/intersection/candidate_pairs.h \
  %D%/intersection/edge_crossing.c %D%/intersection/edge_crossing.h \
  %D%/intersection/edge_fan.c %D%/intersection/edge_fan.h \
  %D%/intersection/intersection.c %D%/intersection/intersection.h \
  %D%/intersection/intersection_estimate.c \
  %D%/intersection/intersection_estimate.h \
  %D%/intersection/intersection_segment.c \
  %D%/intersection/intersection_segment.h \
  %D%/intersection/pair_sweep.h \
  %D%/intersection/sweep_direction.c %D%/intersection/sweep_direction.h \
  %D%/intersection/swept_triangle.h \
  %D%/newell/newell.c \
  %D%/newell/newell_order.c %D%/newell/newell_order.h \
  %D%/newell/newell_piece.c %D%/newell/newell_piece.h \
  %D%/newell/newell_tests.c %D%/newell/newell_tests.h \
  %D%/newell/painter.c %D%/newell/painter.h \
  %D%/pairwise/deferred_triangles.c %D%/pairwise/deferred_triangles.h \
  %D%/pairwise/edge_query.c %D%/pairwise/edge_query.h \
  %D%/pairwise/overlap_query.c %D%/pairwise/overlap_query.h \
  %D%/pairwise/pairwise_fallback.c %D%/pairwise/pairwise_fallback.h \
  %D%/pairwise/tile_candidates.c %D%/pairwise/tile_candidates.h \
  %D%/pairwise/tile_classification.c %D%/pairwise/tile_classification.h \
  %D%/predicate/box2.c %D%/predicate/box2.h \
  %D%/predicate/coarse_plane.c %D%/predicate/coarse_plane.h \
  %D%/predicate/contact.c %D%/predicate/contact.h \
  %D%/predicate/depth_plane.h \
  %D%/predicate/edge_intervals.c %D%/predicate/edge_intervals.h \
  %D%/predicate/occlusion.c %D%/predicate/occlusion.h \
  %D%/predicate/plane_cache.c %D%/predicate/plane_cache.h \
  %D%/predicate/plane_filter.c %D%/predicate/plane_filter.h \
  %D%/predicate/point_lanes.h \
  %D%/predicate/surrounder.c %D%/predicate/surrounder.h \
  %D%/predicate/triangle_pair.c %D%/predicate/triangle_pair.h \
  %D%/predicate/window.c %D%/predicate/window.h \
  %D%/raster/active_edge_pair.c %D%/raster/active_edge_pair.h \
  %D%/raster/pixels.c %D%/raster/pixels.h \
  %D%/raster/raster.c %D%/raster/raster.h \
  %D%/raster/span_fill.c %D%/raster/span_fill.h \
  %D%/raster/subpixels.c %D%/raster/subpixels.h \
  %D%/scan/edge_sampling.c %D%/scan/edge_sampling.h \
  %D%/scan/facets.c %D%/scan/facets.h \
  %D%/scan/trapezoids.c %D%/scan/trapezoids.h \
  %D%/scanline_zbuffer/scanline_zbuffer.c \
  %D%/scanline_zbuffer/scanline_zbuffer.h \
  %D%/tiles/tile_states.c %D%/tiles/tile_states.h \
  %D%/tiles/tiles.c \
  %D%/warnock/warnock.c \
  %D%/warnock/warnock_edges.c \
  %D%/warnock/warnock_faces.c \
  %D%/warnock/warnock_frame.c \
  %D%/warnock/warnock_raster.c %D%/warnock/warnock_raster.h \
  %D%/warnock/warnock_sample.c %D%/warnock/warnock_sample.h \
  %D%/warnock/warnock_subdivision.h \
  %D%/warnock/warnock_windows.c %D%/warnock/warnock_windows.h \
  %D%/watkins/exact/sweep.c %D%/watkins/exact/sweep.h \
  %D%/watkins/exact/sweep_edges.c \
  %D%/watkins/exact/sweep_events.c \
  %D%/watkins/exact/visible_trapezoids.c \
  %D%/watkins/exact/visible_trapezoids.h \
  %D%/watkins/exact/watkins_exact.c \
  %D%/watkins/pitch/watkins.c %D%/watkins/pitch/watkins.h \
  %D%/watkins/pitch/watkins_edge_table.c \
  %D%/watkins/pitch/watkins_interval.c \
  %D%/watkins/pitch/watkins_interval_ends.c \
  %D%/watkins/watkins_solver.c %D%/watkins/watkins_solver.h \
  %D%/zbuffer/draw_order.c %D%/zbuffer/draw_order.h \
  %D%/zbuffer/raster_small.c %D%/zbuffer/raster_small.h \
  %D%/zbuffer/zbuffer.c %D%/zbuffer/zbuffer.h \
  %D%/zero_set/arc_normals.c \
  %D%/zero_set/crease_networks.c \
  %D%/zero_set/curvature_noise.c %D%/zero_set/curvature_noise.h \
  %D%/zero_set/curved_triangle.c %D%/zero_set/curved_triangle.h \
  %D%/zero_set/facing.c %D%/zero_set/facing.h \
  %D%/zero_set/facing_apices.c %D%/zero_set/facing_slots.c \
  %D%/zero_set/folded_faces.c %D%/zero_set/folded_faces.h \
  %D%/zero_set/slot_normals.c \
  %D%/zero_set/zero_creases.c \
  %D%/zero_set/zero_outlines.c \
  %D%/zero_set/zero_finder.h \
  %D%/zero_set/zero_segments.h \
  %D%/zero_set/zero_set.c %D%/zero_set/zero_set.h \
  %D%/zero_set/zero_triangles.c
