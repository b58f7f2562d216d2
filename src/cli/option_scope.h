/* option_scope.h - warns of options that have no effect. */
#ifndef CLI_OPTION_SCOPE_H
#define CLI_OPTION_SCOPE_H

#include "cli/arguments.h"

/* Called once per option given on the command line that has no effect, with the
 * arguments of message_print. */
typedef void (*option_scope_warn_fn)(const char *file, unsigned long line,
                                     const char *text);

void option_scope_warn(const struct arguments *arguments,
                       option_scope_warn_fn warn);

#endif
