# tests/exact.mk - layers 1 and 4, where every answer is exact.  hand/ holds what
# these tests build and reckon by hand.
hand_sheet = %D%/hand/sheet.c %D%/hand/sheet.h
hand_rational = %D%/hand/rational.c %D%/hand/rational.h $(hand_sheet)
hand_cppflags = $(AM_CPPFLAGS) -I$(srcdir)/%D%

unit_tests += %D%/test_wide
%C%_test_wide_SOURCES = %D%/test_wide.c $(hand_rational)
%C%_test_wide_CPPFLAGS = $(hand_cppflags)

unit_tests += %D%/test_line
%C%_test_line_SOURCES = %D%/test_line.c $(hand_rational)
%C%_test_line_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_predicate
%C%_test_predicate_SOURCES = %D%/test_predicate.c $(hand_rational)
%C%_test_predicate_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_ratio
%C%_test_ratio_SOURCES = %D%/test_ratio.c $(hand_rational)
%C%_test_ratio_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_region
%C%_test_region_SOURCES = %D%/test_region.c $(hand_rational)
%C%_test_region_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_convex
%C%_test_convex_SOURCES = %D%/test_convex.c $(hand_rational)
%C%_test_convex_CPPFLAGS = $(hand_cppflags)

# Layer 4.
hand_scene = %D%/hand/scene.c %D%/hand/scene.h $(hand_sheet)
hand_oracle = %D%/hand/oracle.c %D%/hand/oracle.h $(hand_rational) \
  %D%/hand/scene.c %D%/hand/scene.h
unit_tests += %D%/test_fragments
%C%_test_fragments_SOURCES = %D%/test_fragments.c $(hand_oracle)
%C%_test_fragments_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_leftover
%C%_test_leftover_SOURCES = %D%/test_leftover.c
%C%_test_leftover_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_rivals
%C%_test_rivals_SOURCES = %D%/test_rivals.c $(hand_scene)
%C%_test_rivals_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_sidegrid
%C%_test_sidegrid_SOURCES = %D%/test_sidegrid.c $(hand_scene)
%C%_test_sidegrid_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_sidelabel
%C%_test_sidelabel_SOURCES = %D%/test_sidelabel.c $(hand_scene)
%C%_test_sidelabel_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_hide
%C%_test_hide_SOURCES = %D%/test_hide.c $(hand_oracle)
%C%_test_hide_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_pagegrid
%C%_test_pagegrid_SOURCES = %D%/test_pagegrid.c $(hand_scene)
%C%_test_pagegrid_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_stance
%C%_test_stance_SOURCES = %D%/test_stance.c $(hand_sheet)
%C%_test_stance_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_strokes
%C%_test_strokes_SOURCES = %D%/test_strokes.c $(hand_sheet)
%C%_test_strokes_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_pierce
%C%_test_pierce_SOURCES = %D%/test_pierce.c $(hand_rational) \
  %D%/hand/scene.c %D%/hand/scene.h
%C%_test_pierce_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_seams
%C%_test_seams_SOURCES = %D%/test_seams.c $(hand_sheet)
%C%_test_seams_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_newell
%C%_test_newell_SOURCES = %D%/test_newell.c $(hand_rational) \
  %D%/hand/scene.c %D%/hand/scene.h
%C%_test_newell_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_agreement
%C%_test_agreement_SOURCES = %D%/test_agreement.c $(hand_scene)
%C%_test_agreement_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_painter
%C%_test_painter_SOURCES = %D%/test_painter.c $(hand_oracle)
%C%_test_painter_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_outline
%C%_test_outline_SOURCES = %D%/test_outline.c $(hand_sheet)
%C%_test_outline_CPPFLAGS = $(hand_cppflags)
%C%_test_outline_LDADD = %D%/scenes/libscenes.la $(LDADD)
unit_tests += %D%/test_solver
%C%_test_solver_SOURCES = %D%/test_solver.c $(hand_scene)
%C%_test_solver_CPPFLAGS = $(hand_cppflags)
unit_tests += %D%/test_depths
%C%_test_depths_SOURCES = %D%/test_depths.c $(hand_scene)
%C%_test_depths_CPPFLAGS = $(hand_cppflags)
%C%_test_depths_LDADD = %D%/scenes/libscenes.la $(LDADD)
