/* descriptors.h - makes sure that the standard descriptors are open. */
#ifndef CLI_DESCRIPTORS_H
#define CLI_DESCRIPTORS_H

#include <stdbool.h>

/* Opens those of the descriptors 0, 1 and 2 that are closed, so that no file
 * that is opened later gets one of these numbers, and with it what is written
 * to standard output or standard error.  Reading or writing them is an error,
 * as if they were still closed.
 * Returns false where that is not possible. */
bool descriptors_reserve(void);

#endif
