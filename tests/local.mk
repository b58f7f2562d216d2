# tests/local.mk - one program or script per noun.
#
# A unit test, linked with the core library and cmocka:
#   unit_tests += %D%/test_noun
#   %C%_test_noun_SOURCES = %D%/test_noun.c
# A shell test, run by bash, which prints TAP itself:
#   dist_check_SCRIPTS += %D%/test_noun.sh
unit_tests =

# Without cmocka the scripts alone are run.
if HAVE_CMOCKA
check_PROGRAMS += $(unit_tests)
TESTS += $(unit_tests)
endif
TESTS += $(dist_check_SCRIPTS)

unit_tests += %D%/test_cut
%C%_test_cut_SOURCES = %D%/test_cut.c
unit_tests += %D%/test_cut_drawings
%C%_test_cut_drawings_SOURCES = %D%/test_cut_drawings.c

unit_tests += %D%/test_rounded_warning
%C%_test_rounded_warning_SOURCES = %D%/test_rounded_warning.c

unit_tests += %D%/test_svg_batch
%C%_test_svg_batch_SOURCES = %D%/test_svg_batch.c
unit_tests += %D%/test_svg
%C%_test_svg_SOURCES = %D%/test_svg.c

dist_check_SCRIPTS += %D%/test_models.sh

unit_tests += %D%/test_exact_map
%C%_test_exact_map_SOURCES = %D%/test_exact_map.c \
  %D%/exact_fixture/sheet.c %D%/exact_fixture/sheet.h
%C%_test_exact_map_CPPFLAGS = $(AM_CPPFLAGS) -I$(srcdir)/%D%

check_LTLIBRARIES =
include tests/scenes/local.mk
include tests/judge/local.mk
include tests/measure/local.mk
include tests/fuzz/local.mk

unit_tests += %D%/test_scenes
%C%_test_scenes_SOURCES = %D%/test_scenes.c
%C%_test_scenes_LDADD = %D%/scenes/libscenes.la $(LDADD)

unit_tests += %D%/test_subdivide
%C%_test_subdivide_SOURCES = %D%/test_subdivide.c
%C%_test_subdivide_LDADD = %D%/scenes/libscenes.la $(LDADD)

unit_tests += %D%/test_judge
%C%_test_judge_SOURCES = %D%/test_judge.c
%C%_test_judge_LDADD = %D%/judge/libjudge.la %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_judge_svg
%C%_test_judge_svg_SOURCES = %D%/test_judge_svg.c
unit_tests += %D%/test_outlines_whole
%C%_test_outlines_whole_SOURCES = %D%/test_outlines_whole.c
%C%_test_outlines_whole_LDADD = %D%/judge/libjudge.la \
  %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_large_faces
%C%_test_large_faces_SOURCES = %D%/test_large_faces.c
unit_tests += %D%/test_warped
%C%_test_warped_SOURCES = %D%/test_warped.c
%C%_test_warped_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_polls
%C%_test_polls_SOURCES = %D%/test_polls.c %D%/temporary.c %D%/temporary.h
unit_tests += %D%/test_result_models
%C%_test_result_models_SOURCES = %D%/test_result_models.c
unit_tests += %D%/test_speckles
%C%_test_speckles_SOURCES = %D%/test_speckles.c %D%/ink_fixture.c %D%/ink_fixture.h
unit_tests += %D%/test_short_spurs
%C%_test_short_spurs_SOURCES = %D%/test_short_spurs.c %D%/ink_fixture.c \
  %D%/ink_fixture.h
unit_tests += %D%/test_facing_passes
unit_tests += %D%/test_coarse_parts
%C%_test_coarse_parts_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_smooth_contours %D%/test_smooth_fillets
unit_tests += %D%/test_smooth_tubes
%C%_test_smooth_contours_SOURCES = %D%/test_smooth_contours.c \
  %D%/smooth_surfaces.c %D%/smooth_surfaces.h
%C%_test_smooth_fillets_SOURCES = %D%/test_smooth_fillets.c \
  %D%/smooth_surfaces.c %D%/smooth_surfaces.h
%C%_test_smooth_tubes_SOURCES = %D%/test_smooth_tubes.c \
  %D%/smooth_surfaces.c %D%/smooth_surfaces.h
unit_tests += %D%/test_smooth_cusps
%C%_test_smooth_cusps_SOURCES = %D%/test_smooth_cusps.c \
  %D%/smooth_surfaces.c %D%/smooth_surfaces.h
unit_tests += %D%/test_smooth_folds
%C%_test_smooth_folds_SOURCES = %D%/test_smooth_folds.c \
  %D%/smooth_surfaces.c %D%/smooth_surfaces.h
unit_tests += %D%/test_smooth_walls
%C%_test_smooth_walls_SOURCES = %D%/test_smooth_walls.c \
  %D%/smooth_surfaces.c %D%/smooth_surfaces.h
unit_tests += %D%/test_smooth_borders
%C%_test_smooth_borders_SOURCES = %D%/test_smooth_borders.c \
  %D%/smooth_surfaces.c %D%/smooth_surfaces.h
unit_tests += %D%/test_smooth_intersections
%C%_test_smooth_intersections_SOURCES = %D%/test_smooth_intersections.c \
  %D%/smooth_surfaces.c %D%/smooth_surfaces.h
unit_tests += %D%/test_smooth_creases
%C%_test_smooth_creases_SOURCES = %D%/test_smooth_creases.c \
  %D%/smooth_surfaces.c %D%/smooth_surfaces.h
unit_tests += %D%/test_smooth_plate
%C%_test_smooth_plate_SOURCES = %D%/test_smooth_plate.c \
  %D%/smooth_surfaces.c %D%/smooth_surfaces.h
unit_tests += %D%/test_smooth_dents
%C%_test_smooth_dents_SOURCES = %D%/test_smooth_dents.c \
  %D%/smooth_surfaces.c %D%/smooth_surfaces.h
unit_tests += %D%/test_thin_loops
%C%_test_thin_loops_SOURCES = %D%/test_thin_loops.c \
  %D%/smooth_surfaces.c %D%/smooth_surfaces.h
unit_tests += %D%/test_smooth_solids
%C%_test_smooth_solids_SOURCES = %D%/test_smooth_solids.c \
  %D%/smooth_surfaces.c %D%/smooth_surfaces.h
unit_tests += %D%/test_smooth_margins
%C%_test_smooth_margins_SOURCES = %D%/test_smooth_margins.c \
  %D%/smooth_surfaces.c %D%/smooth_surfaces.h %D%/temporary.c %D%/temporary.h
unit_tests += %D%/test_cubic_fit
%C%_test_cubic_fit_SOURCES = %D%/test_cubic_fit.c

unit_tests += %D%/test_curves
%C%_test_curves_SOURCES = %D%/test_curves.c %D%/drawing_fixture.c \
  %D%/drawing_fixture.h
unit_tests += %D%/test_own_crossings
%C%_test_own_crossings_SOURCES = %D%/test_own_crossings.c
unit_tests += %D%/test_verify
%C%_test_verify_SOURCES = %D%/test_verify.c %D%/temporary.c %D%/temporary.h
%C%_test_verify_LDADD = %D%/scenes/libscenes.la $(LDADD)

EXTRA_DIST += %D%/README.md %D%/tap.sh %D%/unit.sh %D%/cli.sh %D%/manifest.sh \
  %D%/memory_faults.h %D%/memory_peak.h %D%/ink_faults.h %D%/near.h \
  %D%/valgrind.h %D%/polled.h %D%/box_mesh.h %D%/svg_text.h \
  %D%/obj_drawing.h
dist_check_SCRIPTS += \
  %D%/test_abi.sh \
  %D%/test_bootstrap.sh \
  %D%/test_cli.sh \
  %D%/test_cli_check.sh \
  %D%/test_captions.sh \
  %D%/test_cli_crease_marks.sh \
  %D%/test_cli_curves.sh \
  %D%/test_cli_dash.sh \
  %D%/test_cli_multiview.sh \
  %D%/test_cli_units.sh \
  %D%/test_cli_descriptors.sh \
  %D%/test_cli_frames.sh \
  %D%/test_cli_margins.sh \
  %D%/test_cli_memory.sh \
  %D%/test_cli_messages.sh \
  %D%/test_cli_outputs.sh \
  %D%/test_cli_progress.sh \
  %D%/test_cli_repeated.sh \
  %D%/test_cli_signals.sh \
  %D%/test_completion.sh \
  %D%/test_header.sh \
  %D%/test_installed.sh \
  %D%/test_documents.sh \
  %D%/test_examples.sh \
  %D%/test_structure.sh \
  %D%/test_options_without_effect.sh \
  %D%/test_pages.sh \
  %D%/test_python.sh

# Drawings made by hand, for the writers.
plotting = %D%/plotting.c %D%/plotting.h \
  %D%/hpgl_reader.c %D%/hpgl_reader.h %D%/drawing_fixture.c %D%/drawing_fixture.h
unit_tests += %D%/test_hpgl %D%/test_device
%C%_test_hpgl_SOURCES = %D%/test_hpgl.c $(plotting)
%C%_test_device_SOURCES = %D%/test_device.c $(plotting)
if HAVE_CAIRO
unit_tests += %D%/test_cairo %D%/test_failures_fills
endif
%C%_test_failures_fills_SOURCES = %D%/test_failures_fills.c
%C%_test_failures_fills_LDADD = %D%/scenes/libscenes.la $(LDADD)
%C%_test_cairo_SOURCES = %D%/test_cairo.c %D%/drawing_fixture.c %D%/drawing_fixture.h
check_PROGRAMS += %D%/paper_tool
%C%_paper_tool_SOURCES = %D%/paper_tool.c %D%/drawing_fixture.c %D%/drawing_fixture.h
dist_check_SCRIPTS += %D%/test_cli_page.sh %D%/test_paper.sh %D%/test_same_picture.sh %D%/test_seams.sh \
  %D%/test_cli_parts.sh %D%/test_part_engines.sh %D%/test_slurm.sh \
  %D%/test_cli_contour_work.sh %D%/test_cli_speckles.sh %D%/test_tone.sh %D%/test_verify_rounding.sh %D%/test_viewers.sh

# Layer 0.
unit_tests += %D%/test_input
%C%_test_input_SOURCES = %D%/test_input.c %D%/reading.c %D%/reading.h \
  %D%/temporary.c %D%/temporary.h
%C%_test_input_LDADD = $(LDADD) $(ZLIB_LIBS)
unit_tests += %D%/test_parallel
%C%_test_parallel_SOURCES = %D%/test_parallel.c %D%/sheet_fixture.c %D%/sheet_fixture.h
%C%_test_parallel_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_parallel_aside
unit_tests += %D%/test_parallel_stages
%C%_test_parallel_stages_SOURCES = %D%/test_parallel_stages.c %D%/sheet_fixture.c %D%/sheet_fixture.h
%C%_test_parallel_stages_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_thread_pool
unit_tests += %D%/test_parallel_plots

unit_tests += %D%/test_memory
%C%_test_memory_SOURCES = %D%/test_memory.c
unit_tests += %D%/test_number
%C%_test_number_SOURCES = %D%/test_number.c %D%/comma_locale.c %D%/comma_locale.h
unit_tests += %D%/test_report
%C%_test_report_SOURCES = %D%/test_report.c %D%/comma_locale.c %D%/comma_locale.h
unit_tests += %D%/test_sort
%C%_test_sort_SOURCES = %D%/test_sort.c
unit_tests += %D%/test_status
%C%_test_status_SOURCES = %D%/test_status.c
unit_tests += %D%/test_stream
%C%_test_stream_SOURCES = %D%/test_stream.c \
  %D%/temporary.c %D%/temporary.h

unit_tests += %D%/test_doubled_faces
%C%_test_doubled_faces_SOURCES = %D%/test_doubled_faces.c
%C%_test_doubled_faces_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_slits
%C%_test_slits_SOURCES = %D%/test_slits.c
%C%_test_slits_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_weld
%C%_test_weld_SOURCES = %D%/test_weld.c
%C%_test_weld_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_topology
%C%_test_topology_SOURCES = %D%/test_topology.c
%C%_test_topology_LDADD = %D%/scenes/libscenes.la $(LDADD)

include tests/exact.mk
unit_tests += %D%/test_triangulate
%C%_test_triangulate_SOURCES = %D%/test_triangulate.c
include tests/scan.mk
include tests/warnock.mk
unit_tests += %D%/test_camera
%C%_test_camera_SOURCES = %D%/test_camera.c
%C%_test_camera_LDADD = %D%/scenes/libscenes.la $(LDADD)

# Layer 2.
unit_tests += %D%/test_exact
%C%_test_exact_SOURCES = %D%/test_exact.c
%C%_test_exact_LDADD = $(LDADD)
unit_tests += %D%/test_scene
%C%_test_scene_SOURCES = %D%/test_scene.c %D%/reading.c %D%/reading.h
%C%_test_scene_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_obj
%C%_test_obj_SOURCES = %D%/test_obj.c %D%/reading.c %D%/reading.h \
  %D%/comma_locale.c %D%/comma_locale.h
%C%_test_obj_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_obj_plain
%C%_test_obj_plain_SOURCES = %D%/test_obj_plain.c \
  %D%/temporary.c %D%/temporary.h
unit_tests += %D%/test_crease_marks
%C%_test_crease_marks_SOURCES = %D%/test_crease_marks.c \
  %D%/reading.c %D%/reading.h
unit_tests += %D%/test_obj_parallel
%C%_test_obj_parallel_SOURCES = %D%/test_obj_parallel.c \
  %D%/reading.c %D%/reading.h %D%/temporary.c %D%/temporary.h
unit_tests += %D%/test_precision
%C%_test_precision_SOURCES = %D%/test_precision.c \
  %D%/reading.c %D%/reading.h %D%/temporary.c %D%/temporary.h
unit_tests += %D%/test_stl
%C%_test_stl_SOURCES = %D%/test_stl.c %D%/reading.c %D%/reading.h \
  %D%/comma_locale.c %D%/comma_locale.h
unit_tests += %D%/test_ply
%C%_test_ply_SOURCES = %D%/test_ply.c %D%/reading.c %D%/reading.h \
  %D%/temporary.c %D%/temporary.h
unit_tests += %D%/test_ply_runs
%C%_test_ply_runs_SOURCES = %D%/test_ply_runs.c %D%/reading.c %D%/reading.h
unit_tests += %D%/test_material
%C%_test_material_SOURCES = %D%/test_material.c \
  %D%/reading.c %D%/reading.h %D%/temporary.c %D%/temporary.h
unit_tests += %D%/test_read
%C%_test_read_SOURCES = %D%/test_read.c %D%/reading.c %D%/reading.h \
  %D%/temporary.c %D%/temporary.h
unit_tests += %D%/test_fuzz_readers
%C%_test_fuzz_readers_SOURCES = %D%/test_fuzz_readers.c \
  %D%/reading.c %D%/reading.h
if HAVE_ASSIMP
unit_tests += %D%/test_assimp %D%/test_importer %D%/test_model_3mf
%C%_test_model_3mf_SOURCES = %D%/test_model_3mf.c \
  src/import/archive_3mf.c src/import/archive_3mf.h \
  src/import/model_3mf.c src/import/model_3mf.h \
  src/import/xml_tags.c src/import/xml_tags.h
endif
%C%_test_assimp_SOURCES = %D%/test_assimp.c %D%/reading.c %D%/reading.h \
  %D%/temporary.c %D%/temporary.h

%C%_test_importer_SOURCES = %D%/test_importer.c \
  %D%/reading.c %D%/reading.h %D%/temporary.c %D%/temporary.h

include tests/failures.mk
unit_tests += %D%/test_sheet
%C%_test_sheet_SOURCES = %D%/test_sheet.c %D%/sheet_fixture.c %D%/sheet_fixture.h
%C%_test_sheet_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_cancelling
%C%_test_cancelling_SOURCES = %D%/test_cancelling.c %D%/sheet_fixture.c %D%/sheet_fixture.h \
  %D%/temporary.c %D%/temporary.h
%C%_test_cancelling_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_silhouette
%C%_test_silhouette_SOURCES = %D%/test_silhouette.c %D%/sheet_fixture.c %D%/sheet_fixture.h
%C%_test_silhouette_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_memory_faults
%C%_test_memory_faults_SOURCES = %D%/test_memory_faults.c \
  %D%/temporary.c %D%/temporary.h
unit_tests += %D%/test_null
%C%_test_null_SOURCES = %D%/test_null.c
unit_tests += %D%/test_api
%C%_test_api_SOURCES = %D%/test_api.c

# Ink, on sheets and maps made by hand.
unit_tests += %D%/test_ink_segment_graph %D%/test_ink_chain %D%/test_ink_clean \
  %D%/test_ink_fill %D%/test_ink_tone_hatch %D%/test_ink_stroke_order \
  %D%/test_ink_draw %D%/test_ink_merge %D%/test_pens %D%/test_dashes
unit_tests += %D%/test_lists
%C%_test_lists_SOURCES = %D%/test_lists.c src/cli/parse.c src/cli/frames.c \
  src/cli/lists.c src/cli/options.c src/cli/option_scope.c src/cli/multiview.c \
  src/cli/value.c
%C%_test_dashes_SOURCES = %D%/test_dashes.c %D%/ink_fixture.c %D%/ink_fixture.h
%C%_test_pens_SOURCES = %D%/test_pens.c %D%/ink_fixture.c %D%/ink_fixture.h
%C%_test_ink_merge_SOURCES = %D%/test_ink_merge.c
%C%_test_ink_merge_LDADD = %D%/scenes/libscenes.la $(LDADD)
%C%_test_ink_segment_graph_SOURCES = %D%/test_ink_segment_graph.c %D%/ink_fixture.c %D%/ink_fixture.h
%C%_test_ink_chain_SOURCES = %D%/test_ink_chain.c %D%/ink_fixture.c %D%/ink_fixture.h
%C%_test_ink_clean_SOURCES = %D%/test_ink_clean.c %D%/ink_fixture.c %D%/ink_fixture.h
%C%_test_ink_fill_SOURCES = %D%/test_ink_fill.c %D%/ink_fixture.c %D%/ink_fixture.h
%C%_test_ink_tone_hatch_SOURCES = %D%/test_ink_tone_hatch.c \
  %D%/ink_fixture.c %D%/ink_fixture.h
%C%_test_ink_tone_hatch_LDADD = %D%/scenes/libscenes.la $(LDADD)
%C%_test_ink_stroke_order_SOURCES = %D%/test_ink_stroke_order.c %D%/ink_fixture.c %D%/ink_fixture.h
%C%_test_ink_draw_SOURCES = %D%/test_ink_draw.c %D%/ink_fixture.c %D%/ink_fixture.h
%C%_test_ink_draw_LDADD = %D%/scenes/libscenes.la $(LDADD)

unit_tests += %D%/test_far
%C%_test_far_SOURCES = %D%/test_far.c

unit_tests += %D%/test_api_memory
%C%_test_api_memory_SOURCES = %D%/test_api_memory.c
unit_tests += %D%/test_api_results
%C%_test_api_results_SOURCES = %D%/test_api_results.c
unit_tests += %D%/test_circle_clip
%C%_test_circle_clip_SOURCES = %D%/test_circle_clip.c
unit_tests += %D%/test_text
%C%_test_text_SOURCES = %D%/test_text.c
unit_tests += %D%/test_multiview
%C%_test_multiview_SOURCES = %D%/test_multiview.c
unit_tests += %D%/test_read_passes
%C%_test_read_passes_SOURCES = %D%/test_read_passes.c %D%/reading.c \
  %D%/reading.h %D%/temporary.c %D%/temporary.h
unit_tests += %D%/test_parts_read
%C%_test_parts_read_SOURCES = %D%/test_parts_read.c %D%/temporary.c \
  %D%/temporary.h
unit_tests += %D%/test_plan
%C%_test_plan_SOURCES = %D%/test_plan.c %D%/temporary.c %D%/temporary.h
%C%_test_plan_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_unread_edges
%C%_test_unread_edges_SOURCES = %D%/test_unread_edges.c %D%/temporary.c \
  %D%/temporary.h
%C%_test_unread_edges_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_parts
%C%_test_parts_SOURCES = %D%/test_parts.c %D%/temporary.c %D%/temporary.h
%C%_test_parts_LDADD = %D%/scenes/libscenes.la $(LDADD)

unit_tests += %D%/test_api_prepare
%C%_test_api_prepare_SOURCES = %D%/test_api_prepare.c
unit_tests += %D%/test_api_memory_faults
%C%_test_api_memory_faults_SOURCES = %D%/test_api_memory_faults.c
