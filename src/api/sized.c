/* sized.c - copies structs whose size the caller and the library may define
 * differently. */
#include "api/sized.h"

#include <string.h>

recto_status sized_reject(recto_error *error) {
  return error_set(error, RECTO_ERROR_UNSUPPORTED, NULL, 0,
                   "the program was compiled for a later version of recto and "
                   "uses a field that this one does not have");
}

recto_status sized_copy_in(void *to, size_t to_size, const void *from,
                           size_t from_size, recto_error *error) {
  const unsigned char *byte = from;
  for (size_t i = to_size; i < from_size; i++)
    if (byte[i] != 0)
      return sized_reject(error);
  memcpy(to, from, from_size < to_size ? from_size : to_size);
  return RECTO_OK;
}

bool sized_copy_out(void *to, size_t to_size, const void *from,
                    size_t from_size) {
  if (to == NULL || to_size == 0)
    return false;
  size_t both = from_size < to_size ? from_size : to_size;
  memcpy(to, from, both);
  memset((unsigned char *)to + both, 0, to_size - both);
  return true;
}
