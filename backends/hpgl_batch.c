/* hpgl_batch.c - the strokes of a layer as HPGL, written by all threads. */
#include "backends/hpgl_batch.h"

#include "backends/writer.h"
#include "base/parallel.h"

static size_t points_of_stroke(const void *user, uint32_t index) {
  const struct hpgl_batch *batch = user;
  const struct drawing_stroke *stroke = &batch->drawing->stroke.item[index];
  return stroke->layer == batch->layer && stroke->count >= 2 ? stroke->count
                                                             : 0;
}

/* Writes the strokes of a chunk; what is clipped of them is noted for it, so
 * that sums do not depend on threads. */
static bool write_strokes_of_chunk(struct hpgl_batch *batch,
                                   struct hpgl_strokes *strokes, size_t c) {
  const struct text_chunk *chunk = &batch->chunks.chunk[c];
  bool ok = true;
  strokes->clipped = 0;
  strokes->lost = 0;
  for (uint32_t i = chunk->begin; ok && i < chunk->end; i++)
    ok = points_of_stroke(batch, i) == 0 ||
         hpgl_write_stroke(strokes, batch->drawing, i);
  batch->clipping[c] = (struct hpgl_clipping){strokes->clipped, strokes->lost};
  return ok && stream_status(strokes->stream) == RECTO_OK;
}

static bool write_chunk_range(void *user, struct parallel_range range) {
  struct hpgl_batch *batch = user;
  struct hpgl_strokes *strokes = &batch->worker.item[range.worker];
  bool ok = true;
  for (size_t c = range.begin; ok && c < range.end; c++) {
    strokes->stream = batch->chunks.chunk[c].text;
    ok = write_strokes_of_chunk(batch, strokes, c);
  }
  return ok;
}

/* Makes room for what workers write to, and with. */
static bool prepare_workers(struct hpgl_batch *batch, size_t workers) {
  if (!text_chunks_open(&batch->chunks))
    return false;
  if (workers > batch->worker.count &&
      !ARRAY_RESERVE(&batch->worker, workers - batch->worker.count))
    return false;
  while (batch->worker.count < workers)
    batch->worker.item[batch->worker.count++] =
        (struct hpgl_strokes){.place = batch->strokes.place};
  return true;
}

/* Writes the chunks to the output: by one thread at once, else what all of them
 * wrote to memory. */
static bool write_chunks_in_order(struct hpgl_batch *batch, bool is_written) {
  struct hpgl_strokes *all = &batch->strokes;
  for (size_t c = 0; c < batch->chunks.count; c++) {
    const struct text_chunk *chunk = &batch->chunks.chunk[c];
    struct hpgl_strokes before = *all;
    size_t count;
    if (!writer_goes_on(batch->drawing, all->stream,
                        batch->drawing->fill.count + chunk->begin))
      return true; /* the stream keeps the fault */
    if (is_written) {
      const char *text = stream_memory(chunk->text, &count);
      stream_write(all->stream, text, count);
    } else if (!write_strokes_of_chunk(batch, all, c) &&
               stream_status(all->stream) == RECTO_OK) {
      return false;
    }
    all->clipped = before.clipped + batch->clipping[c].clipped;
    all->lost = before.lost + batch->clipping[c].lost;
  }
  return true;
}

bool hpgl_batch_write(struct hpgl_batch *batch, const struct drawing *drawing,
                      uint32_t layer) {
  bool ok = true;
  batch->drawing = drawing;
  batch->layer = layer;
  for (uint32_t i = 0; ok && i < drawing->stroke.count;) {
    i = text_chunks_divide(&batch->chunks, i, (uint32_t)drawing->stroke.count,
                           points_of_stroke, batch);
    int workers = parallel_workers(batch->chunks.count, 1);
    ok = workers == 1 || (prepare_workers(batch, (size_t)workers) &&
                          parallel_ranges(workers, batch->chunks.count, 1,
                                          write_chunk_range, batch));
    ok = ok && write_chunks_in_order(batch, workers > 1);
  }
  return ok;
}

void hpgl_batch_fini(struct hpgl_batch *batch) {
  text_chunks_fini(&batch->chunks);
  for (size_t w = 0; w < batch->worker.count; w++)
    ARRAY_FREE(&batch->worker.item[w].chords.point);
  ARRAY_FREE(&batch->worker);
  ARRAY_FREE(&batch->strokes.chords.point);
}
