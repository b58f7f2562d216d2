# src/scene/local.mk - the sources of this layer, a folder a step.
librecto_core_la_SOURCES += \
  %D%/angle.c %D%/angle.h \
  %D%/corner_normals.c %D%/corner_normals.h \
  %D%/diagnostics.c %D%/diagnostics.h \
  %D%/exact.c %D%/exact.h \
  %D%/face.c \
  %D%/face_normal.c %D%/face_normal.h \
  %D%/limit.h \
  %D%/name.c %D%/name.h \
  %D%/newell_normal.c %D%/newell_normal.h \
  %D%/precision.c %D%/precision.h \
  %D%/precision_warning.c %D%/precision_warning.h \
  %D%/read.c %D%/read.h \
  %D%/read_passes.c %D%/read_passes.h \
  %D%/scene.c %D%/scene.h \
  %D%/smoothing.c %D%/smoothing.h \
  %D%/edges/coarse_parts.c %D%/edges/coarse_parts.h \
  %D%/edges/crease_marks.c %D%/edges/crease_marks.h \
  %D%/edges/crease_rounding.c %D%/edges/crease_rounding.h \
  %D%/edges/edge_classes.c %D%/edges/edge_classes.h \
  %D%/obj/material.c %D%/obj/material.h \
  %D%/obj/obj_blocks.c %D%/obj/obj_blocks.h \
  %D%/obj/obj_counted_part.c %D%/obj/obj_counted_part.h \
  %D%/obj/obj_marks.c \
  %D%/obj/obj_parser.c %D%/obj/obj_parser.h \
  %D%/obj/obj_plain.c %D%/obj/obj_plain.h \
  %D%/obj/obj_run.c \
  %D%/obj/obj_short_runs.c %D%/obj/obj_short_runs.h \
  %D%/obj/obj_triangles.c \
  %D%/obj/reader_mtl.c \
  %D%/obj/reader_obj.c \
  %D%/ply/ply_colour.c %D%/ply/ply_colour.h \
  %D%/ply/ply_header.c %D%/ply/ply_header.h \
  %D%/ply/ply_parser.c %D%/ply/ply_parser.h \
  %D%/ply/ply_runs.c %D%/ply/ply_runs.h \
  %D%/ply/ply_value.h \
  %D%/ply/reader_ply.c \
  %D%/readers/conversion.c %D%/readers/conversion.h \
  %D%/readers/import_format.c %D%/readers/import_format.h \
  %D%/readers/positions.c %D%/readers/positions.h \
  %D%/readers/reader_import.c \
  %D%/readers/reader_stl.c \
  %D%/readers/stl_binary.c %D%/readers/stl_binary.h \
  %D%/readers/unusable.c %D%/readers/unusable.h \
  %D%/topology/corner_edges.c \
  %D%/topology/edge_copies.c %D%/topology/edge_copies.h \
  %D%/topology/edge_join.c %D%/topology/edge_join.h \
  %D%/topology/edge_lists.h \
  %D%/topology/edge_range.c %D%/topology/edge_range.h \
  %D%/topology/large_faces.c %D%/topology/large_faces.h \
  %D%/topology/repeated_part.c %D%/topology/repeated_part.h \
  %D%/topology/side_iterator.h \
  %D%/topology/slot_table.c %D%/topology/slot_table.h \
  %D%/topology/topology.c %D%/topology/topology.h \
  %D%/topology/topology_edge.h \
  %D%/topology/weld_equal.c %D%/topology/weld_equal.h \
  %D%/triangulation/ear_clipping.c %D%/triangulation/ear_clipping.h \
  %D%/triangulation/polygon.c %D%/triangulation/polygon.h \
  %D%/triangulation/reflex_tree.c %D%/triangulation/reflex_tree.h \
  %D%/triangulation/self_intersection.c %D%/triangulation/self_intersection.h \
  %D%/triangulation/triangulate.c %D%/triangulation/triangulate.h \
  %D%/triangulation/triangulation.h \
  %D%/weld/cluster.c %D%/weld/cluster.h \
  %D%/weld/doubled_faces.c %D%/weld/doubled_faces.h \
  %D%/weld/face_rewrite.c %D%/weld/face_rewrite.h \
  %D%/weld/isolated_members.c %D%/weld/isolated_members.h \
  %D%/weld/slits.c %D%/weld/slits.h \
  %D%/weld/thin_faces.c %D%/weld/thin_faces.h \
  %D%/weld/weld_candidates.c %D%/weld/weld_candidates.h \
  %D%/weld/weld_near.c %D%/weld/weld_near.h \
  %D%/weld/weld_suspicion.c
