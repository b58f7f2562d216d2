/* arguments.h - the parsed command line. */
#ifndef CLI_ARGUMENTS_H
#define CLI_ARGUMENTS_H

#include <stdbool.h>
#include <stddef.h>

#include "recto.h"

enum { MESSAGE_SIZE = 256, MAX_OPTIONS = 120, VIEWS_MAX = 32 };
enum { SHEET_VIEWS_MAX = 10 };

struct arguments {
  recto_options options;
  char **model; /* part of argv */
  int model_count;
  const char *from;       /* model format; NULL: by extension */
  const char *output;     /* NULL: no drawing is to be made */
  const char *format;     /* output format; NULL: by extension */
  const char *stats_file; /* NULL: standard output, or where the drawing goes
                             there, standard error */
  const char *check_file; /* a drawing to judge; NULL: none */
  /* The length of false or missing lines that --check tolerates: the greater of
   * tolerance_mm and tolerance_share times what is drawn or visible. */
  double tolerance_mm, tolerance_share;
  bool stats, progress, quiet, help, version, completes;
  unsigned completion; /* whose to print: an enum completion_shell */

  /* Several drawings in one run, frames: see frames.h. */
  int turntable; /* how many directions about the up axis; 0: one */
  struct named_view {
    const char *name;
    double azimuth_deg, elevation_deg;
  } view[VIEWS_MAX]; /* as given, view_count of them */
  int view_count;
  int first_frame, past_frame; /* of a turntable's; both 0: all */

  /* Drawings in parts. */
  int part, parts;     /* the part to draw, from 1, and how many; 0: none */
  bool resumes, joins; /* the models are parts */
  int planned_parts;   /* of the plan to write; 0: none */
  const char *plan;    /* by which the part is drawn; NULL: by the model */

  struct view_hidden {
    const char *view;
    recto_hidden hidden;
  } view_hidden[VIEWS_MAX]; /* of --hidden-in, view_hidden_count of them */
  int view_hidden_count;

  /* Which options were given, for rules that depend on several. */
  bool view_given, azimuth_given, elevation_given, eye_given, fov_given;
  bool ortho, landscape, portrait;
  /* By the option's index in the table. */
  bool seen[MAX_OPTIONS];
  bool is_replaced[MAX_OPTIONS];     /* by a value that was given later */
  const char *text[MAX_OPTIONS];     /* the last value; NULL: none */
  const char *replaced[MAX_OPTIONS]; /* the one before, if another */

  /* The items of all lists. */
  struct list_item {
    const char *option, *name, *value; /* one name for both spellings */
  } * item;
  size_t item_count;

  /* What the options' arrays refer to. */
  recto_sheet_view sheet_view[SHEET_VIEWS_MAX];
  recto_detail detail[RECTO_DETAIL_MAX];
  recto_plane plane[RECTO_CUT_MAX];
  recto_cut_hatch *cut_hatch;
  recto_pen_use *pen_use;
  recto_pen pen[RECTO_PEN_MAX];
  recto_weight weight[RECTO_EDGE_CLASS_COUNT];
  recto_dash dash[RECTO_EDGE_CLASS_COUNT + 1];
};

#endif
