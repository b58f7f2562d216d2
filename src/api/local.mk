# src/api/local.mk - the facade behind recto.h.
librecto_core_la_SOURCES += \
  src/recto.h \
  %D%/check.c \
  %D%/captions.c %D%/captions.h \
  %D%/clip_warning.c %D%/clip_warning.h \
  %D%/contour_fit.c %D%/contour_fit.h \
  %D%/colour.c \
  %D%/dash.c \
  %D%/detail_places.c %D%/detail_places.h \
  %D%/draw_file.c \
  %D%/group_numbers.c %D%/group_numbers.h \
  %D%/handle.h \
  %D%/join.c \
  %D%/letter_places.c %D%/letter_places.h \
  %D%/mesh.c \
  %D%/method.c %D%/method.h \
  %D%/judge_input.c %D%/judge_input.h \
  %D%/options.c %D%/options.h \
  %D%/output.c \
  %D%/output_format.c %D%/output_format.h \
  %D%/multiview.c %D%/multiview.h %D%/multiview_check.c \
  %D%/multiview_layout.h \
  %D%/part.c \
  %D%/part_check.c %D%/part_check.h \
  %D%/part_solve.c %D%/part_solve.h \
  %D%/part_marks.c %D%/part_marks.h \
  %D%/part_survey.c %D%/part_survey.h \
  %D%/part_tones.c %D%/part_tones.h \
  %D%/plan.c \
  %D%/render.c %D%/render.h \
  %D%/render_scene.c \
  %D%/render_warnings.c %D%/render_warnings.h \
  %D%/render_contours.c %D%/render_contours.h \
  %D%/render_multiview.c %D%/render_multiview.h \
  %D%/preparation.c %D%/preparation.h \
  %D%/result.c %D%/result.h %D%/result_edges.c %D%/result_faces.c \
  %D%/rounded_warning.c %D%/rounded_warning.h \
  %D%/scene.c \
  %D%/sized.c %D%/sized.h \
  %D%/shares.c %D%/shares.h \
  %D%/stats.c %D%/stats.h \
  %D%/multiview_grid.c %D%/multiview_grid.h \
  %D%/multiview_labels.c %D%/multiview_labels.h \
  %D%/multiview_text.c %D%/multiview_text.h \
  %D%/verify.c %D%/verify.h \
  %D%/version.c \
  %D%/visible_part.c %D%/visible_part.h \
  %D%/vocabulary.c
