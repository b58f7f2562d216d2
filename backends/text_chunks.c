/* text_chunks.c - divides items into chunks by their points. */
#include "backends/text_chunks.h"

#include "base/parallel.h"

/* A chunk has so many points, which fit in a stream's buffer as it is
 * allocated; an item counts as some points more than it has. */
enum { CHUNK_POINTS = PARALLEL_RANGE(1 << 11), ITEM_POINTS = 4 };

uint32_t text_chunks_divide(struct text_chunks *chunks, uint32_t begin,
                            uint32_t items, text_chunk_points *points,
                            const void *user) {
  uint32_t i = begin;
  chunks->count = 0;
  while (i < items && chunks->count < TEXT_CHUNKS_MAX) {
    struct text_chunk *chunk = &chunks->chunk[chunks->count++];
    chunk->begin = i;
    for (size_t sum = 0; i < items && sum < CHUNK_POINTS; i++) {
      size_t of = points(user, i);
      sum += of > 0 ? of + ITEM_POINTS : 1;
    }
    chunk->end = i;
  }
  return i;
}

bool text_chunks_open(struct text_chunks *chunks) {
  recto_error error;
  for (size_t c = 0; c < chunks->count; c++) {
    struct text_chunk *chunk = &chunks->chunk[c];
    if (chunk->text != NULL)
      stream_clear_memory(chunk->text);
    else if (stream_open_memory(&chunk->text, &error) != RECTO_OK)
      return false;
  }
  return true;
}

void text_chunks_fini(struct text_chunks *chunks) {
  for (size_t c = 0; c < TEXT_CHUNKS_MAX; c++)
    stream_discard(chunks->chunk[c].text);
}
