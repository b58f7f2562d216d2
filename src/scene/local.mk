# src/scene/local.mk - the sources of this layer.
librecto_core_la_SOURCES += \
  %D%/angle.c %D%/angle.h \
  %D%/cluster.c %D%/cluster.h \
  %D%/coarse_parts.c %D%/coarse_parts.h \
  %D%/conversion.c %D%/conversion.h \
  %D%/corner_edges.c \
  %D%/corner_normals.c %D%/corner_normals.h \
  %D%/crease_marks.c %D%/crease_marks.h \
  %D%/crease_rounding.c %D%/crease_rounding.h \
  %D%/diagnostics.c %D%/diagnostics.h \
  %D%/ear_clipping.c %D%/ear_clipping.h \
  %D%/edge_classes.c %D%/edge_classes.h \
  %D%/edge_copies.c %D%/edge_copies.h \
  %D%/edge_join.c %D%/edge_join.h \
  %D%/edge_lists.h \
  %D%/edge_range.c %D%/edge_range.h \
  %D%/exact.c %D%/exact.h \
  %D%/face.c \
  %D%/face_normal.c %D%/face_normal.h \
  %D%/face_rewrite.c %D%/face_rewrite.h \
  %D%/import_format.c %D%/import_format.h \
  %D%/isolated_members.c %D%/isolated_members.h \
  %D%/limit.h \
  %D%/material.c %D%/material.h \
  %D%/name.c %D%/name.h \
  %D%/large_faces.c %D%/large_faces.h \
  %D%/newell_normal.c %D%/newell_normal.h \
  %D%/obj_blocks.c %D%/obj_blocks.h \
  %D%/obj_marks.c \
  %D%/obj_parser.c %D%/obj_parser.h \
  %D%/obj_plain.c %D%/obj_plain.h \
  %D%/obj_run.c \
  %D%/obj_short_runs.c %D%/obj_short_runs.h \
  %D%/obj_triangles.c \
  %D%/ply_colour.c %D%/ply_colour.h \
  %D%/ply_header.c %D%/ply_header.h \
  %D%/ply_parser.c %D%/ply_parser.h \
  %D%/ply_value.h \
  %D%/polygon.c %D%/polygon.h \
  %D%/positions.c %D%/positions.h \
  %D%/precision.c %D%/precision.h \
  %D%/read.c %D%/read.h \
  %D%/read_passes.c %D%/read_passes.h \
  %D%/reader_import.c \
  %D%/reader_mtl.c \
  %D%/reader_obj.c \
  %D%/reader_ply.c \
  %D%/reader_stl.c \
  %D%/reflex_tree.c %D%/reflex_tree.h \
  %D%/repeated_part.c %D%/repeated_part.h \
  %D%/scene.c %D%/scene.h \
  %D%/self_intersection.c %D%/self_intersection.h \
  %D%/side_iterator.h \
  %D%/slot_table.c %D%/slot_table.h \
  %D%/slits.c %D%/slits.h \
  %D%/smoothing.c %D%/smoothing.h \
  %D%/thin_faces.c %D%/thin_faces.h \
  %D%/topology.c %D%/topology.h \
  %D%/topology_edge.h \
  %D%/triangulate.c %D%/triangulate.h \
  %D%/triangulation.h \
  %D%/unusable.c %D%/unusable.h \
  %D%/weld_equal.c %D%/weld_equal.h \
  %D%/weld_candidates.c %D%/weld_candidates.h \
  %D%/weld_near.c %D%/weld_near.h \
  %D%/weld_suspicion.c
