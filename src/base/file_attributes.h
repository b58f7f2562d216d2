/* file_attributes.h - gives a file the owner, the mode, the access list and the
 * other attributes of another one. */
#ifndef BASE_FILE_ATTRIBUTES_H
#define BASE_FILE_ATTRIBUTES_H

#include <stdbool.h>
#include <sys/stat.h>

/* Gives the file that is open as `to` what belongs to the one at a path; false
 * where it cannot.
 * old  of the one at the path */
bool file_attributes_copy(const char *from, const struct stat *old, int to);

#endif
