/* part_common.h - what all parts of a drawing have in common, as bytes of their
 * files and of a plan. */
#ifndef PARTS_PART_COMMON_H
#define PARTS_PART_COMMON_H

#include "parts/byte_codec.h"
#include "parts/part.h"

/* Writes or reads it; what is read has its numbers in range. */
void part_common_code(struct byte_codec *codec, struct part_common *common);

/* The classes of edges that parts solve and list: the requested ones.  With two
 * angles of creases, creases at the lower one too, as the join makes some of
 * them smooth, and silhouettes, which are not smooth then. */
unsigned part_common_classes(const struct part_common *common);

/* A checksum of it, but for the id.
 * Errors  RECTO_ERROR_MEMORY */
USE_RESULT recto_status part_common_checksum(struct part_common *common,
                                             uint64_t *sum, recto_error *error);

#endif
