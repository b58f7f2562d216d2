/* option_entry.h - an option: its names, where its value is stored, and what
 * uses it. */
#ifndef CLI_OPTION_ENTRY_H
#define CLI_OPTION_ENTRY_H

#include "cli/arguments.h"

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
  USED_BY_UNIT,
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

enum { OPTION_USES = 2 };

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
  bool of_parts;  /* a join takes it from the parts, and these from a plan */
  bool of_solver; /* but for those that only say how parts are solved */
  bool adds;      /* given again, it adds a value; else it replaces the first */
  bool is_file;   /* given again, another value is an error */
};

#endif
