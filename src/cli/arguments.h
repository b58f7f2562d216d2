/* arguments.h - the parsed command line, and the table of options. */
#ifndef CLI_ARGUMENTS_H
#define CLI_ARGUMENTS_H

#include <stdbool.h>
#include <stddef.h>

#include "recto.h"

enum { MESSAGE_SIZE = 256, MAX_OPTIONS = 120, OPTION_USES = 2, VIEWS_MAX = 32 };
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

  struct view_hidden {
    const char *view;
    recto_hidden hidden;
  } view_hidden[VIEWS_MAX]; /* of --hidden-in, view_hidden_count of them */
  int view_hidden_count;

  /* Which options were given, for rules that depend on several. */
  bool view_given, direction_given, eye_given, fov_given;
  bool ortho, landscape, portrait;
  bool seen[MAX_OPTIONS]; /* by the option's index in the table */

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

/* ---- The table of options ------------------------------------------------ */

enum option_kind {
  OPTION_HEADING, /* no option: a line of --help */
  OPTION_FLAG,    /* a bool that becomes true */
  OPTION_TEXT,    /* a const char * */
  OPTION_CAPTION, /* the same, which may be empty */
  OPTION_NUMBER,  /* a double in [least, most] */
  OPTION_LENGTH,  /* a double in [least, most], in mm */
  OPTION_INT,     /* an int in [least, most] */
  OPTION_VECTOR,  /* a double[3]; not 0,0,0 where `least` is above 0 */
  OPTION_WORD,    /* an enumerator, by its index in `words`, or by `word` */
  OPTION_LIST,    /* NAME=VALUE,..., each parsed by `parse_item`, or `words`, if
                     any, for an empty list; repeated, it adds to the list */
  OPTION_PARSED,  /* parsed by `parse` */
  OPTION_ABSENT   /* known, but not available in this build */
};

/* What uses an option: see the table in option_scope.c. */
enum option_use {
  USED_ALWAYS,
  USED_BY_DRAWING,
  USED_BY_WATKINS,
  USED_BY_WARNOCK,
  USED_BY_LINES_OF_PIXELS,
  USED_BY_PIXELS,
  USED_BY_ZBUFFERS,
  USED_BY_CONTACT,
  USED_BY_TARGET,
  USED_BY_CUT,
  USED_BY_FOV,
  USED_BY_SCALE,
  USED_BY_LINES,
  USED_BY_SILHOUETTES,
  USED_BY_LINES_AND_CHECK,
  USED_BY_STROKES,
  USED_BY_STROKES_AND_CHECK,
  USED_BY_CREASE,
  USED_BY_SEAM,
  USED_BY_HATCH,
  USED_BY_ONE_PITCH,
  USED_BY_LIGHT,
  USED_BY_TONES,
  USED_BY_SVG,
  USED_BY_SVG_AND_CHECK,
  USED_BY_SCREENS,
  USED_BY_SVG_AND_PDF,
  USED_BY_PAGES_AND_SHEETS,
  USED_BY_TIGHT,
  USED_BY_PAGE,
  USED_BY_OBLONG_PAGE,
  USED_BY_PNG,
  USED_BY_PLOTTER,
  USED_BY_STATS,
  USED_BY_CHECK,
  USED_BY_TURNTABLE,
  USED_BY_PART
};

/* The word at `index` of a list; NULL past the last. */
typedef const char *word_fn(size_t index);
word_fn name_method, name_edge_class;

struct option_entry {
  enum option_kind kind;
  const char *name;     /* long, without dashes */
  char letter;          /* short; 0: none */
  const char *argument; /* its word in --help; NULL: takes none; "[=...]":
                           may be left out */
  const char *expected; /* what its value must be, for messages */
  const char *help;
  size_t offset; /* of its value in struct arguments */
  size_t given;  /* offset of a bool to set if it is given; 0: none */
  double least, most;
  const char *words; /* that its value may be, also for completion */
  word_fn *word;     /* more such words */
  bool (*parse)(struct arguments *arguments, const char *text);
  recto_status (*parse_item)(struct arguments *arguments, const char *name,
                             const char *value);
  /* The conditions under which the option has an effect: all of them. */
  enum option_use use[OPTION_USES];
  bool of_parts; /* a join takes it from the parts */
};

/* The table, of less than MAX_OPTIONS, ended by an entry without help and
 * name. */
extern const struct option_entry option_table[];

bool option_is_end(const struct option_entry *entry);

/* Print --help and --completion to standard output. */
void help_print(void);
enum completion_shell { COMPLETION_BASH, COMPLETION_ZSH };
void completion_print(enum completion_shell shell);

#endif
