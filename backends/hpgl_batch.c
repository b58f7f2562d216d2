/* hpgl_batch.c - the strokes of a layer as HPGL, written by all threads. */
#include "backends/hpgl_batch.h"

#include "backends/writer.h"
#include "base/parallel.h"

/* A chunk has so many points, which fit in a stream's buffer as it is
 * allocated; a stroke counts as some points more than it has. */
enum { CHUNK_POINTS = PARALLEL_RANGE(1 << 11), STROKE_POINTS = 4 };

static bool is_plotted(const struct hpgl_batch *batch, uint32_t index) {
  const struct drawing_stroke *stroke = &batch->drawing->stroke.item[index];
  return stroke->layer == batch->layer && stroke->count >= 2;
}

/* Divides the strokes from `begin` on into chunks; where the last one ends. */
static uint32_t divide_strokes(struct hpgl_batch *batch, uint32_t begin) {
  const struct drawing *drawing = batch->drawing;
  uint32_t i = begin;
  batch->chunks = 0;
  while (i < drawing->stroke.count && batch->chunks < HPGL_CHUNKS_MAX) {
    struct hpgl_chunk *chunk = &batch->chunk[batch->chunks++];
    chunk->begin = i;
    for (size_t points = 0; i < drawing->stroke.count && points < CHUNK_POINTS;
         i++)
      points += is_plotted(batch, i)
                    ? drawing->stroke.item[i].count + STROKE_POINTS
                    : 1;
    chunk->end = i;
  }
  return i;
}

/* Writes the strokes of a chunk; what is clipped of them is noted there, so
 * that sums do not depend on threads. */
static bool write_strokes_of_chunk(const struct hpgl_batch *batch,
                                   struct hpgl_strokes *strokes,
                                   struct hpgl_chunk *chunk) {
  bool ok = true;
  strokes->clipped = 0;
  strokes->lost = 0;
  for (uint32_t i = chunk->begin; ok && i < chunk->end; i++)
    ok = !is_plotted(batch, i) || hpgl_write_stroke(strokes, batch->drawing, i);
  chunk->clipped = strokes->clipped;
  chunk->lost = strokes->lost;
  return ok && stream_status(strokes->stream) == RECTO_OK;
}

static bool write_chunk_range(void *user, struct parallel_range range) {
  struct hpgl_batch *batch = user;
  struct hpgl_strokes *strokes = &batch->worker.item[range.worker];
  bool ok = true;
  for (size_t c = range.begin; ok && c < range.end; c++) {
    strokes->stream = batch->chunk[c].text;
    ok = write_strokes_of_chunk(batch, strokes, &batch->chunk[c]);
  }
  return ok;
}

/* Gives each chunk a stream, and makes room for what workers write with. */
static bool prepare_workers(struct hpgl_batch *batch, size_t workers) {
  recto_error error;
  for (size_t c = 0; c < batch->chunks; c++) {
    struct hpgl_chunk *chunk = &batch->chunk[c];
    if (chunk->text != NULL)
      stream_clear_memory(chunk->text);
    else if (stream_open_memory(&chunk->text, &error) != RECTO_OK)
      return false;
  }
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
  for (size_t c = 0; c < batch->chunks; c++) {
    struct hpgl_chunk *chunk = &batch->chunk[c];
    struct hpgl_strokes before = *all;
    size_t count;
    if (!writer_goes_on(batch->drawing, all->stream,
                        batch->drawing->fill.count + chunk->begin))
      return true; /* the stream keeps the fault */
    if (is_written) {
      const char *text = stream_memory(chunk->text, &count);
      stream_write(all->stream, text, count);
    } else if (!write_strokes_of_chunk(batch, all, chunk) &&
               stream_status(all->stream) == RECTO_OK) {
      return false;
    }
    all->clipped = before.clipped + chunk->clipped;
    all->lost = before.lost + chunk->lost;
  }
  return true;
}

bool hpgl_batch_write(struct hpgl_batch *batch, const struct drawing *drawing,
                      uint32_t layer) {
  bool ok = true;
  batch->drawing = drawing;
  batch->layer = layer;
  for (uint32_t i = 0; ok && i < drawing->stroke.count;) {
    i = divide_strokes(batch, i);
    int workers = parallel_workers(batch->chunks, 1);
    ok = workers == 1 ||
         (prepare_workers(batch, (size_t)workers) &&
          parallel_ranges(workers, batch->chunks, 1, write_chunk_range, batch));
    ok = ok && write_chunks_in_order(batch, workers > 1);
  }
  return ok;
}

void hpgl_batch_fini(struct hpgl_batch *batch) {
  for (size_t c = 0; c < HPGL_CHUNKS_MAX; c++)
    stream_discard(batch->chunk[c].text);
  for (size_t w = 0; w < batch->worker.count; w++)
    ARRAY_FREE(&batch->worker.item[w].chords.point);
  ARRAY_FREE(&batch->worker);
  ARRAY_FREE(&batch->strokes.chords.point);
}
