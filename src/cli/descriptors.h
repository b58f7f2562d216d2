/* descriptors.h - the standard descriptors are open, whatever the caller did. */
#ifndef CLI_DESCRIPTORS_H
#define CLI_DESCRIPTORS_H

#include <stdbool.h>

/* Occupies those of the descriptors 0, 1 and 2 that are closed, so that no file
 * which is opened later takes their place and with it what is meant for
 * standard output or standard error.  To use one of these is an error, as if
 * it were closed still.
 * Returns false where that cannot be done. */
bool descriptors_reserve(void);

#endif
