/* option_scope.h - the conditions under which an option has an effect. */
#ifndef CLI_OPTION_SCOPE_H
#define CLI_OPTION_SCOPE_H

#include "cli/arguments.h"

/* A condition: what uses an option. */
struct option_use {
  const char *by; /* its name, for messages: "watkins" */
  bool (*is_met)(const struct arguments *arguments); /* NULL: always */
  /* What the command line requests instead, for messages. */
  const char *(*instead)(const struct arguments *arguments);
  bool by_check; /* --check uses the option too */
};

/* Methods. */
extern const struct option_use used_by_drawing, used_by_watkins,
    used_by_warnock, used_by_lines_of_pixels, used_by_pixels, used_by_depths,
    used_by_contact;
/* Camera and page. */
extern const struct option_use used_by_target, used_by_fov, used_by_scale;
/* Ink. */
extern const struct option_use used_by_lines, used_by_lines_and_check,
    used_by_strokes, used_by_pen, used_by_crease, used_by_seam, used_by_hatch,
    used_by_one_pitch, used_by_light;
/* Files and reports. */
extern const struct option_use used_by_svg, used_by_screens, used_by_cairo,
    used_by_png, used_by_plotter, used_by_stats, used_by_check;

/* Called once per option given on the command line that has no effect, with the
 * arguments of message_print. */
typedef void (*option_scope_warn_fn)(const char *file, unsigned long line,
                                     const char *text);

void option_scope_warn(const struct arguments *arguments,
                       option_scope_warn_fn warn);

#endif
