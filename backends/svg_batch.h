/* svg_batch.h - elements of SVG written by all threads, many at once.
 *
 * The elements of a layer are written one after the other, in their order.  The
 * first of each batch has them all formatted, in chunks that threads take, each
 * in memory of its own; then their text is copied to the output.  Chunks depend
 * on the drawing alone, and the bytes on nothing else. */
#ifndef BACKENDS_SVG_BATCH_H
#define BACKENDS_SVG_BATCH_H

#include "backends/svg_elements.h"
#include "backends/text_chunks.h"
#include "base/parallel.h"

enum svg_element { SVG_SEAM, SVG_FILL, SVG_STROKE };

/* Zero-initialised is empty. */
struct svg_batch {
  struct svg *svg; /* to whose stream the elements go */
  enum svg_element kind;
  uint32_t layer;
  uint32_t end; /* of the batch: element `end` begins the next one */
  struct text_chunks chunks; /* elements of other layers have no text */
  size_t at;                 /* the chunk of the last element */
  uint32_t first;            /* the element whose end is text_end.item[0] */
  ARRAY(uint32_t) text_end;  /* of each element, in the text of its chunk */
  int workers;               /* of the batch; 1: its elements are not formatted
                               before */
  ARRAY(struct svg) worker;  /* each with arrays of its own */
};

/* Begins the elements of a kind and layer. */
void svg_batch_begin(struct svg_batch *batch, struct svg *svg,
                     enum svg_element kind, uint32_t layer);

/* Writes an element of them, which follows those written before.  Returns false
 * when memory ran out, or the caller cancelled. */
USE_RESULT bool svg_batch_write(struct svg_batch *batch, uint32_t index);

void svg_batch_fini(struct svg_batch *batch);

#endif
