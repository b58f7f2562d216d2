/* path.h - names of files. */
#ifndef BASE_PATH_H
#define BASE_PATH_H

#include <stdbool.h>

/* Whether two paths name one file that is there, by whatever names and links;
 * "-", devices and pipes, which may well be both read and written, do not
 * count. */
bool path_is_same(const char *a, const char *b);

#endif
