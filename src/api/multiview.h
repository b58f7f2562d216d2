/* multiview.h - arranges the views of a sheet on its page: multiview
 * orthographic projection, as [ISO5456] and [ISO128] have it. */
#ifndef API_MULTIVIEW_H
#define API_MULTIVIEW_H

#include "api/preparation.h"
#include "view/extent.h"

/* Each name once, and a view without one. */
enum { MULTIVIEW_MAX = 10 };

enum { MULTIVIEW_LABEL_SIZE = 96 };

/* What text takes of the page above or below it, in its own height. */
#define MULTIVIEW_TITLE_BAND 2.5
#define MULTIVIEW_NAME_BAND 2.5

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
  double low_mm[2], high_mm[2];     /* the box on the page */
  char label[MULTIVIEW_LABEL_SIZE]; /* "ISO (2:1)"; "": no name is drawn */
  double label_mm; /* the room for it; no less than its width */
};

/* A circle of a view, drawn again beside the views. */
struct multiview_detail {
  const recto_detail *asked;
  const char *name;    /* a literal: "detail-A" */
  size_t view;         /* that it is of */
  double scale;        /* page mm for a unit of the user's scene */
  double centre_mm[2]; /* of the larger circle */
  double radius_mm;
  char label[MULTIVIEW_LABEL_SIZE]; /* below the larger circle: "A (2:1)" */
  double label_mm;
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
  double unit_mm;   /* of a unit of the user's scene */
  bool with_scales; /* these are true ones, so that names tell them */
};

/* Whether the options request a sheet. */
static inline bool multiview_is_requested(const recto_options *options) {
  return options->sheet.arrangement != RECTO_ARRANGEMENT_NONE;
}

/* Whether the sheet draws a title. */
static inline bool multiview_has_title(const recto_options *options) {
  return options->output.title != NULL && *options->output.title != '\0';
}

/* The direction of that name, and the literal; NULL: there is none. */
const char *multiview_find_direction(const char *name, double *azimuth_deg,
                                     double *elevation_deg);

/* The nearest scale that is a positive number. */
double multiview_limit_scale(double scale);

/* Checks the options of sheets, and those that contradict them.
 * Errors  RECTO_ERROR_ARGUMENT, RECTO_ERROR_UNSUPPORTED: a later version's */
USE_RESULT recto_status multiview_check(const recto_options *options,
                                        recto_error *error);

/* Arranges the views of the options, which are valid and whose scale is
 * settled.
 * unit_mm  of a unit of the user's scene
 * Method  aligned views stand in the columns and rows of a grid about the front
 *         view, others in a corner of it and beside that, each in the middle of
 *         its cell.  No column is narrower than the names in it.  As many mm are between columns as between rows: a
 *         SHARE_OF_GAP of the page's room at least, and where more is left an
 *         even part of it.
 *         Details stand where they are nearest to what they show.
 * Errors  RECTO_ERROR_ARGUMENT: the page has no room for the views or for a
 *         detail; as of camera_aim */
USE_RESULT recto_status multiview_arrange(struct multiview *views,
                                          const struct preparation *prepared,
                                          const recto_options *options,
                                          double unit_mm, recto_error *error);

/* The options that draw one of the views, or past these of the details, by
 * itself, once it is moved by shift_mm from the middle of the page. */
void multiview_options(const struct multiview *views, size_t index,
                       const recto_options *options, recto_options *of_view,
                       double shift_mm[2]);

/* The name of a view, or past these of a detail. */
const char *multiview_name(const struct multiview *views, size_t index);

#endif
