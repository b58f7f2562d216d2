# tests/scan.mk - methods that walk the page line by line.
exact_pixels = %D%/exact_fixture/pixels.c %D%/exact_fixture/pixels.h $(exact_sheet)

unit_tests += %D%/test_scanfill
%C%_test_scanfill_SOURCES = %D%/test_scanfill.c
unit_tests += %D%/test_facets
%C%_test_facets_SOURCES = %D%/test_facets.c $(exact_sheet)
%C%_test_facets_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_zbuffer
%C%_test_zbuffer_SOURCES = %D%/test_zbuffer.c $(exact_pixels)
%C%_test_zbuffer_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_subpixels
%C%_test_subpixels_SOURCES = %D%/test_subpixels.c $(exact_pixels)
%C%_test_subpixels_CPPFLAGS = $(exact_cppflags)

# How far they are from the exact answer.
unit_tests += %D%/test_measure
%C%_test_measure_SOURCES = %D%/test_measure.c
%C%_test_measure_LDADD = %D%/measure/libmeasure.la %D%/scenes/libscenes.la \
  $(LDADD)
measure_libs = %D%/measure/libmeasure.la %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_accuracy
%C%_test_accuracy_SOURCES = %D%/test_accuracy.c $(exact_sheet)
%C%_test_accuracy_CPPFLAGS = $(exact_cppflags)
%C%_test_accuracy_LDADD = $(measure_libs)
unit_tests += %D%/test_failures_lines
%C%_test_failures_lines_SOURCES = %D%/test_failures_lines.c
%C%_test_failures_lines_LDADD = $(measure_libs)

# Intervals.
unit_tests += %D%/test_watkins
%C%_test_watkins_SOURCES = %D%/test_watkins.c $(exact_pixels)
%C%_test_watkins_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_sweep
%C%_test_sweep_SOURCES = %D%/test_sweep.c $(exact_rational) \
  %D%/exact_fixture/scene.c %D%/exact_fixture/scene.h
%C%_test_sweep_CPPFLAGS = $(exact_cppflags)
unit_tests += %D%/test_watkins_exact
%C%_test_watkins_exact_SOURCES = %D%/test_watkins_exact.c
%C%_test_watkins_exact_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_hatching
%C%_test_hatching_SOURCES = %D%/test_hatching.c \
  %D%/hpgl_reader.c %D%/hpgl_reader.h
%C%_test_hatching_LDADD = $(measure_libs)
