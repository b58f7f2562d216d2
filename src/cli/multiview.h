/* multiview.h - the options of sheets, on which several views are. */
#ifndef CLI_MULTIVIEW_H
#define CLI_MULTIVIEW_H

#include "cli/arguments.h"

/* Whether several views are requested on one page. */
static inline bool arguments_have_sheet(const struct arguments *arguments) {
  return arguments->options.sheet.arrangement != RECTO_ARRANGEMENT_NONE ||
         arguments->options.sheet.view_count > 0;
}

/* Take first or third, and a list of views such as front,top,iso:2. */
bool multiview_parse(struct arguments *arguments, const char *text);
bool multiview_parse_views(struct arguments *arguments, const char *text);

/* Takes X,Y,R,SCALE, lengths of the page and how many times as large. */
bool multiview_parse_detail(struct arguments *arguments, const char *text);

/* Takes an item of --hidden-in, a view and how its hidden lines are drawn. */
recto_status multiview_set_hidden(struct arguments *arguments, const char *name,
                                  const char *value);

/* Settles what several options say of the sheet.
 * message  set to the error where false is returned */
bool multiview_settle(struct arguments *arguments, char message[MESSAGE_SIZE]);

#endif
