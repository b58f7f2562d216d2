# src/ink/local.mk - from the visible map to a drawing.
librecto_core_la_SOURCES += \
  %D%/dash_pattern.c %D%/dash_pattern.h \
  %D%/ink.c %D%/ink.h \
  %D%/ink_lines.c %D%/ink_lines.h \
  %D%/layers.c %D%/layers.h \
  %D%/shading.c %D%/shading.h \
  %D%/tone.c %D%/tone.h \
  %D%/pens.c %D%/pens.h \
  %D%/pens_warn_unused.c \
  %D%/planar_regions.c %D%/planar_regions.h \
  %D%/curve/clearance.c %D%/curve/clearance.h \
  %D%/curve/cubic_fit.c %D%/curve/cubic_fit.h \
  %D%/curve/curve_samples.c %D%/curve/curve_samples.h \
  %D%/curve/curves.c %D%/curve/curves.h \
  %D%/curve/fit_targets.c %D%/curve/fit_targets.h \
  %D%/curve/own_crossings.c %D%/curve/own_crossings.h \
  %D%/curve/part_fit.c %D%/curve/part_fit.h \
  %D%/curve/stroke_loops.c %D%/curve/stroke_loops.h \
  %D%/curve/stroke_shape.c %D%/curve/stroke_shape.h \
  %D%/fill/fill.c %D%/fill/fill.h \
  %D%/fill/light.c %D%/fill/light.h \
  %D%/fill/merge.c %D%/fill/merge.h \
  %D%/fill/outline.c %D%/fill/outline.h \
  %D%/cut_hatch.c %D%/cut_hatch.h \
  %D%/hatch/hatch.c %D%/hatch/hatch.h \
  %D%/hatch/hatch_lines.c %D%/hatch/hatch_lines.h \
  %D%/hatch/hatch_region.c %D%/hatch/hatch_region.h \
  %D%/hatch/hatch_regions.c %D%/hatch/hatch_regions.h \
  %D%/hatch/hatch_runs.c %D%/hatch/hatch_runs.h \
  %D%/hatch/inset.c %D%/hatch/inset.h \
  %D%/hatch/tone_hatch.c %D%/hatch/tone_hatch.h \
  %D%/lines/chain.c \
  %D%/lines/changed_cells.c %D%/lines/changed_cells.h \
  %D%/lines/continued_ends.c \
  %D%/lines/cover_side.c %D%/lines/cover_side.h \
  %D%/lines/cover_verdict.c \
  %D%/lines/covered.c \
  %D%/lines/covering.h \
  %D%/lines/crease_lines.c %D%/lines/crease_lines.h \
  %D%/lines/dash.c \
  %D%/lines/free_ends.c \
  %D%/lines/gaps.c \
  %D%/lines/isolated.c \
  %D%/lines/loose_ends.c %D%/lines/loose_ends.h \
  %D%/lines/nearest.c %D%/lines/nearest.h \
  %D%/lines/nodes.c \
  %D%/lines/nodes_near_segment.c %D%/lines/nodes_near_segment.h \
  %D%/lines/open_paths.c %D%/lines/open_paths.h \
  %D%/lines/overlap.c %D%/lines/overlap.h \
  %D%/lines/overlap_collinear.c \
  %D%/lines/overlap_cover.c %D%/lines/overlap_cover.h \
  %D%/lines/overlap_output.c \
  %D%/lines/pairing.c %D%/lines/pairing.h \
  %D%/lines/paths.h \
  %D%/lines/segment_graph.h \
  %D%/lines/segment_order.c \
  %D%/lines/segments.c \
  %D%/lines/short_cycles.c \
  %D%/lines/short_spurs.c %D%/lines/short_spurs.h \
  %D%/lines/speckled_creases.c \
  %D%/lines/simplify.c \
  %D%/lines/straighten.c \
  %D%/lines/stroke.c %D%/lines/stroke.h \
  %D%/lines/vertex_snapping.c %D%/lines/vertex_snapping.h \
  %D%/lines/weak_creases.c %D%/lines/zigzag_creases.c \
  %D%/order/stroke_order.c %D%/order/stroke_order.h \
  %D%/order/tour.c %D%/order/tour.h
