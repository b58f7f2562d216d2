/* text_chunks.h - consecutive items of a drawing as text, in chunks, each of
 * which a thread writes to memory of its own.
 *
 * Chunks depend on the drawing alone, so that the bytes do not depend on the
 * number of threads once their text is copied to the output in order. */
#ifndef BACKENDS_TEXT_CHUNKS_H
#define BACKENDS_TEXT_CHUNKS_H

#include "base/stream.h"

enum { TEXT_CHUNKS_MAX = 64 };

/* The items from `begin` to before `end`. */
struct text_chunk {
  uint32_t begin, end;
  struct stream *text; /* NULL until it is opened */
};

/* Zero-initialised is empty. */
struct text_chunks {
  struct text_chunk chunk[TEXT_CHUNKS_MAX];
  size_t count;
};

/* The number of points that an item has where it is written; 0: it is not. */
typedef size_t text_chunk_points(const void *user, uint32_t item);

/* Divides the items from `begin` on, of `items`, into chunks of about as many
 * points.  Returns where the last one ends. */
uint32_t text_chunks_divide(struct text_chunks *chunks, uint32_t begin,
                            uint32_t items, text_chunk_points *points,
                            const void *user);

/* Gives each chunk an empty stream.  Returns false when memory ran out. */
USE_RESULT bool text_chunks_open(struct text_chunks *chunks);

void text_chunks_fini(struct text_chunks *chunks);

#endif
