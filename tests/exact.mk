# tests/exact.mk - layers 1 and 4, where every answer is exact.  exact_fixture/ has what
# these tests build and calculate by hand.
exact_sheet = %D%/exact_fixture/sheet.c %D%/exact_fixture/sheet.h
exact_rational = %D%/exact_fixture/rational.c %D%/exact_fixture/rational.h $(exact_sheet)
exact_cppflags = $(AM_CPPFLAGS) -I$(srcdir)/%D%

unit_tests += %D%/test_wide
%C%_test_wide_SOURCES = %D%/test_wide.c $(exact_rational)
%C%_test_wide_CPPFLAGS = $(exact_cppflags)

unit_tests += %D%/test_line
%C%_test_line_SOURCES = %D%/test_line.c $(exact_rational)
%C%_test_line_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_predicate
%C%_test_predicate_SOURCES = %D%/test_predicate.c $(exact_rational)
%C%_test_predicate_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_ratio
%C%_test_ratio_SOURCES = %D%/test_ratio.c $(exact_rational)
%C%_test_ratio_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_region
%C%_test_region_SOURCES = %D%/test_region.c $(exact_rational)
%C%_test_region_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_convex
%C%_test_convex_SOURCES = %D%/test_convex.c $(exact_rational)
%C%_test_convex_CPPFLAGS = $(exact_cppflags)

# Layer 4.
exact_scene = %D%/exact_fixture/scene.c %D%/exact_fixture/scene.h $(exact_sheet)
exact_oracle = %D%/exact_fixture/oracle.c %D%/exact_fixture/oracle.h $(exact_rational) \
  %D%/exact_fixture/scene.c %D%/exact_fixture/scene.h
unit_tests += %D%/test_fragments
%C%_test_fragments_SOURCES = %D%/test_fragments.c $(exact_oracle)
%C%_test_fragments_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_planar_subdivision
%C%_test_planar_subdivision_SOURCES = %D%/test_planar_subdivision.c $(exact_sheet)
%C%_test_planar_subdivision_CPPFLAGS = $(exact_cppflags)
%C%_test_planar_subdivision_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_dense_edges
%C%_test_dense_edges_SOURCES = %D%/test_dense_edges.c %D%/sheet_fixture.c \
  %D%/sheet_fixture.h
%C%_test_dense_edges_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_hidden_faces
%C%_test_hidden_faces_SOURCES = %D%/test_hidden_faces.c %D%/sheet_fixture.c \
  %D%/sheet_fixture.h
%C%_test_hidden_faces_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_divided_curves
%C%_test_divided_curves_SOURCES = %D%/test_divided_curves.c
unit_tests += %D%/test_intersection_estimate
%C%_test_intersection_estimate_SOURCES = %D%/test_intersection_estimate.c \
  %D%/sheet_fixture.c \
  %D%/sheet_fixture.h
%C%_test_intersection_estimate_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_occlusion_culling
%C%_test_occlusion_culling_SOURCES = %D%/test_occlusion_culling.c %D%/sheet_fixture.c \
  %D%/sheet_fixture.h
%C%_test_occlusion_culling_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_deferred_triangles
%C%_test_deferred_triangles_SOURCES = %D%/test_deferred_triangles.c
%C%_test_deferred_triangles_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_occluder_subtraction
%C%_test_occluder_subtraction_SOURCES = %D%/test_occluder_subtraction.c $(exact_scene)
%C%_test_occluder_subtraction_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_line_index
%C%_test_line_index_SOURCES = %D%/test_line_index.c $(exact_scene)
%C%_test_line_index_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_side_provenance
%C%_test_side_provenance_SOURCES = %D%/test_side_provenance.c $(exact_scene)
%C%_test_side_provenance_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_occlusion
%C%_test_occlusion_SOURCES = %D%/test_occlusion.c $(exact_oracle)
%C%_test_occlusion_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_triangle_grid
%C%_test_triangle_grid_SOURCES = %D%/test_triangle_grid.c $(exact_scene)
%C%_test_triangle_grid_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_page_cover
%C%_test_page_cover_SOURCES = %D%/test_page_cover.c $(exact_scene)
%C%_test_page_cover_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_outline_chains
%C%_test_outline_chains_SOURCES = %D%/test_outline_chains.c $(exact_scene)
%C%_test_outline_chains_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_curve_ends
%C%_test_curve_ends_SOURCES = %D%/test_curve_ends.c $(exact_scene)
%C%_test_curve_ends_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_nearest_contours
%C%_test_nearest_contours_SOURCES = %D%/test_nearest_contours.c $(exact_scene)
%C%_test_nearest_contours_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_bvh
%C%_test_bvh_SOURCES = %D%/test_bvh.c $(exact_sheet)
%C%_test_bvh_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_plane_filter
%C%_test_plane_filter_SOURCES = %D%/test_plane_filter.c $(exact_sheet)
%C%_test_plane_filter_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_edge_intervals
%C%_test_edge_intervals_SOURCES = %D%/test_edge_intervals.c $(exact_sheet)
%C%_test_edge_intervals_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_intersection
%C%_test_intersection_SOURCES = %D%/test_intersection.c $(exact_rational) \
  %D%/exact_fixture/scene.c %D%/exact_fixture/scene.h
%C%_test_intersection_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_edge_crossing
%C%_test_edge_crossing_SOURCES = %D%/test_edge_crossing.c $(exact_sheet)
%C%_test_edge_crossing_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_newell
%C%_test_newell_SOURCES = %D%/test_newell.c $(exact_rational) \
  %D%/exact_fixture/scene.c %D%/exact_fixture/scene.h
%C%_test_newell_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_solvers_agree
%C%_test_solvers_agree_SOURCES = %D%/test_solvers_agree.c $(exact_scene) \
  %D%/degenerate.c %D%/degenerate.h
%C%_test_solvers_agree_CPPFLAGS = $(exact_cppflags)
%C%_test_solvers_agree_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_painter
%C%_test_painter_SOURCES = %D%/test_painter.c $(exact_oracle)
%C%_test_painter_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_solver
%C%_test_solver_SOURCES = %D%/test_solver.c $(exact_scene)
%C%_test_solver_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_quantitative_invisibility
%C%_test_quantitative_invisibility_SOURCES = %D%/test_quantitative_invisibility.c $(exact_scene)
%C%_test_quantitative_invisibility_CPPFLAGS = $(exact_cppflags)
%C%_test_quantitative_invisibility_LDADD = %D%/scenes/libscenes.la $(LDADD)
