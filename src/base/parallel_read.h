/* parallel_read.h - bytes of a regular file, read by several threads. */
#ifndef BASE_PARALLEL_READ_H
#define BASE_PARALLEL_READ_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

enum { PARALLEL_READ_PART = 1 << 18 }; /* bytes that a thread reads at once */

/* Whether the call may use several threads, and each has a part to read. */
bool parallel_read_is_worth(size_t count);

/* Reads bytes from a place of a file; its position stays as it is.
 * Returns how many were read from there without a gap: fewer where the file
 * ends, anything is wrong, or memory ran out, which a plain read then
 * reports. */
size_t parallel_read(int descriptor, off_t from, char *to, size_t count);

#endif
