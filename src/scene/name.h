/* name.h - names of groups as clean UTF-8, whatever the file held. */
#ifndef SCENE_NAME_H
#define SCENE_NAME_H

#include <stddef.h>

/* Copies a name of `length` bytes.  A byte that is no part of a UTF-8
 * character is taken as Latin-1, control characters become question marks.
 * to  room for 2 * length bytes
 * Returns the length of the copy. */
size_t name_clean(const char *name, size_t length, char *to);

#endif
