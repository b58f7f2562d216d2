/* multiview_layout.h - where the views, the details and the text of a sheet are
 * on its page. */
#ifndef API_MULTIVIEW_LAYOUT_H
#define API_MULTIVIEW_LAYOUT_H

#include "recto.h"
#include "view/extent.h"

/* Each name once, and a view without one. */
enum { MULTIVIEW_MAX = 10 };

enum { MULTIVIEW_LABEL_SIZE = 96 };

/* What text takes of the page above or below it, in its own height. */
#define MULTIVIEW_TITLE_BAND 2.5
#define MULTIVIEW_NAME_BAND 2.5

/* A view, where its scene is on the page. */
struct multiview_view {
  const recto_sheet_view *request;
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
  const recto_detail *request;
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
  bool with_scales; /* these are true ones, so that names have them */
};

/* Whether the sheet draws a title. */
static inline bool multiview_has_title(const recto_options *options) {
  return options->output.title != NULL && *options->output.title != '\0';
}

/* Whether any view has hidden lines. */
static inline bool multiview_has_hidden(const struct multiview *views,
                                        const recto_options *options) {
  for (size_t i = 0; i < views->count; i++) {
    const recto_sheet_view *view = views->view[i].request;
    if ((view->has_hidden ? view->hidden : options->ink.hidden) !=
        RECTO_HIDDEN_NONE)
      return true;
  }
  return false;
}

#endif
