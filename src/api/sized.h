/* sized.h - structs of recto.h that cross to callers compiled with an older or
 * a newer header: new fields come at the end, and the caller passes the size
 * that it was compiled with. */
#ifndef API_SIZED_H
#define API_SIZED_H

#include <stddef.h>

#include "base/status.h"

/* Copies the caller's struct of `from_size` bytes to the library's own.  Fields
 * that an older caller does not have keep the values that they have in `to`.
 * Errors  RECTO_ERROR_UNSUPPORTED: a newer caller has set a field that this
 *         library does not have (it is not zero) */
USE_RESULT recto_status sized_copy_in(void *to, size_t to_size,
                                      const void *from, size_t from_size,
                                      recto_error *error);

/* Sets the error of a newer caller. */
recto_status sized_reject(recto_error *error);

/* Copies the library's struct to the caller's, of which the rest becomes zero.
 * Returns false where there is none: `to` is NULL, or its size is 0. */
bool sized_copy_out(void *to, size_t to_size, const void *from,
                    size_t from_size);

#endif
