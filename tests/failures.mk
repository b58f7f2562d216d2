# tests/failures.mk - the tests of known failures.
failures = %D%/judged.c %D%/judged.h
failures_libs = %D%/judge/libjudge.la %D%/scenes/libscenes.la $(LDADD)

unit_tests += %D%/test_failures_long_lists
%C%_test_failures_long_lists_SOURCES = %D%/test_failures_long_lists.c
%C%_test_failures_long_lists_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_failures_hiding
%C%_test_failures_hiding_SOURCES = %D%/test_failures_hiding.c $(failures)
%C%_test_failures_hiding_LDADD = $(failures_libs)
unit_tests += %D%/test_failures_meshes
%C%_test_failures_meshes_SOURCES = %D%/test_failures_meshes.c $(failures) \
  %D%/temporary.c %D%/temporary.h
%C%_test_failures_meshes_LDADD = $(failures_libs)
unit_tests += %D%/test_failures_numbers
%C%_test_failures_numbers_SOURCES = %D%/test_failures_numbers.c $(failures) \
  %D%/comma_locale.c %D%/comma_locale.h
%C%_test_failures_numbers_LDADD = $(failures_libs)
unit_tests += %D%/test_failures_duplicates
%C%_test_failures_duplicates_SOURCES = %D%/test_failures_duplicates.c
%C%_test_failures_duplicates_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_judged
%C%_test_judged_SOURCES = %D%/test_judged.c $(failures) \
  %D%/temporary.c %D%/temporary.h
%C%_test_judged_LDADD = $(failures_libs)
dist_check_SCRIPTS += %D%/test_failures_compilers.sh \
  %D%/test_failures_matrix.sh
unit_tests += %D%/test_ink_overlap_output
%C%_test_ink_overlap_output_SOURCES = %D%/test_ink_overlap_output.c %D%/ink_fixture.c %D%/ink_fixture.h
%C%_test_ink_overlap_output_LDADD = $(failures_libs)
unit_tests += %D%/test_contact
%C%_test_contact_SOURCES = %D%/test_contact.c
%C%_test_contact_LDADD = $(failures_libs)
unit_tests += %D%/test_pairwise_fallback
%C%_test_pairwise_fallback_SOURCES = %D%/test_pairwise_fallback.c %D%/sheet_fixture.c %D%/sheet_fixture.h
%C%_test_pairwise_fallback_LDADD = $(failures_libs)
unit_tests += %D%/test_intersections
%C%_test_intersections_SOURCES = %D%/test_intersections.c %D%/sheet_fixture.c \
  %D%/sheet_fixture.h
%C%_test_intersections_LDADD = $(failures_libs)

# The tables of doc/failures.md, which test_failures_matrix.sh compares.
check_PROGRAMS += %D%/failures_matrix
%C%_failures_matrix_SOURCES = %D%/failures_matrix.c
%C%_failures_matrix_LDADD = %D%/measure/libmeasure.la \
  %D%/scenes/libscenes.la librecto_core.la -lm

# The tables and the pictures of doc/failures.md, as they are now.
failures: %D%/failures_matrix$(EXEEXT)
	{ sed '/^### Lines/,$$d' '$(srcdir)/doc/failures.md' && \
	  %D%/failures_matrix && echo && \
	  sed -n '/^## Pictures/,$$p' '$(srcdir)/doc/failures.md'; } \
	  >failures.new && mv failures.new '$(srcdir)/doc/failures.md'
	%D%/failures_matrix '$(srcdir)/doc/images/failures'
.PHONY: failures
EXTRA_DIST += doc/failures.md doc/images/failures
unit_tests += %D%/test_least_model
%C%_test_least_model_SOURCES = %D%/test_least_model.c
%C%_test_least_model_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_camera_turns
%C%_test_camera_turns_SOURCES = %D%/test_camera_turns.c
%C%_test_camera_turns_LDADD = %D%/measure/libmeasure.la \
  %D%/scenes/libscenes.la $(LDADD)
