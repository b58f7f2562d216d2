/* multiview.h - arranges the views of a sheet on its page: multiview
 * orthographic projection, as ISO 128 and ISO 5456-2 have it. */
#ifndef API_MULTIVIEW_H
#define API_MULTIVIEW_H

#include "api/preparation.h"
#include "view/extent.h"

/* Each name once, and a view without one. */
enum { MULTIVIEW_MAX = 10 };

/* A view, where its scene is on the page. */
struct multiview_view {
  const recto_sheet_view *asked;
  const char *name; /* a literal */
  double azimuth_deg, elevation_deg;
  bool is_aligned;
  int column, row;     /* rows count upwards */
  struct extent box;   /* about the target, in units of the prepared scene */
  double scale;        /* page mm for a unit of the user's scene */
  double centre_mm[2]; /* where the target is placed */
  double low_mm[2], high_mm[2]; /* the box on the page */
};

/* A circle of a view, drawn again beside the views. */
struct multiview_detail {
  const recto_detail *asked;
  const char *name;    /* a literal: "detail-A" */
  size_t view;         /* that it is of */
  double scale;        /* page mm for a unit of the user's scene */
  double centre_mm[2]; /* of the larger circle */
  double radius_mm;
};

struct multiview {
  struct multiview_view view[MULTIVIEW_MAX];
  size_t count;
  struct multiview_detail detail[RECTO_DETAIL_MAX];
  size_t details;
  double page_mm[2], margin_mm;
  double scale;  /* page mm for a unit of the user's scene */
  double gap_mm; /* between views */
  /* Text, its capitals so high; 0: there is none. */
  double title_mm, name_mm;
  double letter_mm; /* of details */
  const char *title;
};

/* Whether the options request a sheet. */
static inline bool multiview_is_requested(const recto_options *options) {
  return options->sheet.arrangement != RECTO_ARRANGEMENT_NONE;
}

/* Checks the options of sheets, and those that contradict them.
 * Errors  RECTO_ERROR_ARGUMENT, RECTO_ERROR_UNSUPPORTED: a later version's */
USE_RESULT recto_status multiview_check(const recto_options *options,
                                        recto_error *error);

/* Arranges the views of the options, which are valid and whose scale is
 * settled.
 * Method  aligned views stand in the columns and rows of a grid about the front
 *         view, others in a corner of it and beside that, each in the middle of
 *         its cell.  As many mm are between columns as between rows: a
 *         SHARE_OF_GAP of the page's room at least, and where more is left an
 *         even part of it.
 *         Details stand where they are nearest to what they show.
 * Errors  RECTO_ERROR_ARGUMENT: the page has no room for the views or for a
 *         detail; as of camera_aim */
USE_RESULT recto_status multiview_arrange(struct multiview *views,
                                          const struct preparation *prepared,
                                          const recto_options *options,
                                          recto_error *error);

/* The options that draw one of the views, or past these of the details, by
 * itself, once it is moved by shift_mm from the middle of the page. */
void multiview_options(const struct multiview *views, size_t index,
                       const recto_options *options, recto_options *of_view,
                       double shift_mm[2]);

/* The name of a view, or past these of a detail. */
const char *multiview_name(const struct multiview *views, size_t index);

#endif
