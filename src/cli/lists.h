/* lists.h - lists of pens, widths, colours and weights, such as
 * silhouette=2,hidden=3. */
#ifndef CLI_LISTS_H
#define CLI_LISTS_H

#include "cli/option_entry.h"

/* Takes the items NAME=VALUE of an option's list; a name has one value in it.
 * list     is cut into names and values, to which the arguments refer
 * message  set to the error where false is returned */
bool lists_parse(struct arguments *arguments, const struct option_entry *entry,
                 char *list, char message[MESSAGE_SIZE]);

/* Each takes an item.  Returns RECTO_ERROR_ARGUMENT where it is not valid. */
recto_status lists_add_pen_use(struct arguments *arguments, const char *name,
                               const char *value);
recto_status lists_set_width(struct arguments *arguments, const char *name,
                             const char *value);
recto_status lists_set_colour(struct arguments *arguments, const char *name,
                              const char *value);
recto_status lists_set_dash(struct arguments *arguments, const char *name,
                            const char *value);
recto_status lists_add_cut_hatch(struct arguments *arguments, const char *name,
                                 const char *value);
recto_status lists_set_weight(struct arguments *arguments, const char *name,
                              const char *value);

#endif
