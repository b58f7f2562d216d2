/* parse.h - parses the command line. */
#ifndef CLI_PARSE_H
#define CLI_PARSE_H

#include "cli/arguments.h"

/* Reads the command line.  Call arguments_fini whatever is returned.
 * argv     is permuted, models last, and its lists are cut; it stays referred
 *          to
 * message  set to the error where false is returned, without a newline */
bool arguments_parse(struct arguments *arguments, int argc, char **argv,
                     char message[MESSAGE_SIZE]);
void arguments_fini(struct arguments *arguments);

/* The format of the drawing; NULL: there is none of that name, or extension.
 * Parts and their plan have none of their own: they are of an HPGL drawing
 * where --device names a plotter, else of SVG. */
const char *arguments_format(const struct arguments *arguments);

#endif
