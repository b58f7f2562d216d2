/* hpgl_batch.h - the strokes of a layer as HPGL, written by all threads.
 *
 * Strokes are divided into chunks by the drawing alone.  Where there are
 * several threads each chunk is written to memory of its own, and copied to the
 * output in order. */
#ifndef BACKENDS_HPGL_BATCH_H
#define BACKENDS_HPGL_BATCH_H

#include "backends/hpgl_strokes.h"
#include "backends/text_chunks.h"

/* What the margins cut off of a chunk's strokes: how many, and mm. */
struct hpgl_clipping {
  uint64_t clipped;
  double lost;
};

/* Zero-initialised but for the place and the stream of `strokes`. */
struct hpgl_batch {
  struct hpgl_strokes strokes; /* of all: what is clipped, and the output */
  /* private */
  const struct drawing *drawing;
  uint32_t layer;
  struct text_chunks chunks;
  struct hpgl_clipping clipping[TEXT_CHUNKS_MAX]; /* one a chunk */
  ARRAY(struct hpgl_strokes) worker; /* each with arrays of its own */
};

/* Writes the strokes of a layer.  Returns false when memory ran out, or the
 * caller cancelled. */
USE_RESULT bool hpgl_batch_write(struct hpgl_batch *batch,
                                 const struct drawing *drawing, uint32_t layer);

void hpgl_batch_fini(struct hpgl_batch *batch);

#endif
