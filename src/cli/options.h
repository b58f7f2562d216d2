/* options.h - the table of options. */
#ifndef CLI_OPTIONS_H
#define CLI_OPTIONS_H

#include "cli/option_entry.h"

/* Of less than MAX_OPTIONS, ended by an entry without help and name. */
extern const struct option_entry option_table[];

bool option_is_end(const struct option_entry *entry);

/* The names of all views, methods and classes of edges. */
word_fn name_view, name_method, name_edge_class;

#endif
