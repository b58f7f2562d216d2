/* svg_batch.c - elements of SVG written by all threads, many at once. */
#include "backends/svg_batch.h"

static bool is_of_layer(const struct svg_batch *batch, uint32_t index) {
  const struct drawing *drawing = batch->svg->drawing;
  return batch->layer == (batch->kind == SVG_STROKE
                              ? drawing->stroke.item[index].layer
                              : drawing->fill.item[index].layer);
}

static size_t points_of_element(const void *user, uint32_t index) {
  const struct svg_batch *batch = user;
  if (!is_of_layer(batch, index))
    return 0;
  const struct drawing *drawing = batch->svg->drawing;
  if (batch->kind == SVG_STROKE)
    return drawing->stroke.item[index].count;
  const struct drawing_fill *fill = &drawing->fill.item[index];
  size_t points = 0;
  for (uint32_t i = 0; i < fill->loops; i++)
    points += drawing->loop.item[fill->loop + i].count;
  return points;
}

static bool write_drawn_element(struct svg *svg, enum svg_element kind,
                                uint32_t index) {
  return kind == SVG_STROKE ? svg_write_stroke(svg, index)
                            : svg_write_fill(svg, index, kind == SVG_SEAM);
}

/* ---- A batch ------------------------------------------------------------- */

/* Divides the elements from `begin` on into chunks. */
static void choose_chunks(struct svg_batch *batch, uint32_t begin) {
  const struct drawing *drawing = batch->svg->drawing;
  size_t count =
      batch->kind == SVG_STROKE ? drawing->stroke.count : drawing->fill.count;
  batch->first = begin;
  batch->at = 0;
  batch->end = text_chunks_divide(&batch->chunks, begin, (uint32_t)count,
                                  points_of_element, batch);
  batch->workers = parallel_workers(batch->chunks.count, 1);
}

/* Gives each chunk a stream, and each worker what it writes elements with. */
static bool prepare_chunks(struct svg_batch *batch) {
  size_t workers = (size_t)batch->workers;
  if (!text_chunks_open(&batch->chunks))
    return false;
  batch->text_end.count = 0;
  if (!ARRAY_RESERVE(&batch->text_end, batch->end - batch->first) ||
      (workers > batch->worker.count &&
       !ARRAY_RESERVE(&batch->worker, workers - batch->worker.count)))
    return false;
  while (batch->worker.count < workers) {
    struct svg *worker = &batch->worker.item[batch->worker.count++];
    *worker = (struct svg){.drawing = batch->svg->drawing,
                           .options = batch->svg->options,
                           .scale = batch->svg->scale};
  }
  return true;
}

static bool write_chunks(void *user, struct parallel_range range) {
  const struct svg_batch *batch = user;
  struct svg *svg = &batch->worker.item[range.worker];
  bool ok = true;
  for (size_t c = range.begin; ok && c < range.end; c++) {
    const struct text_chunk *chunk = &batch->chunks.chunk[c];
    svg->out = chunk->text;
    for (uint32_t i = chunk->begin; ok && i < chunk->end; i++) {
      size_t count;
      ok = !is_of_layer(batch, i) || write_drawn_element(svg, batch->kind, i);
      (void)stream_memory(chunk->text, &count);
      batch->text_end.item[i - batch->first] = (uint32_t)count;
    }
    ok = ok && stream_status(chunk->text) == RECTO_OK;
  }
  return ok;
}

static bool make_batch(struct svg_batch *batch, uint32_t begin) {
  choose_chunks(batch, begin);
  return batch->workers == 1 ||
         (prepare_chunks(batch) &&
          parallel_ranges(batch->workers, batch->chunks.count, 1, write_chunks,
                          batch));
}

/* ---- Elements ------------------------------------------------------------ */

void svg_batch_begin(struct svg_batch *batch, struct svg *svg,
                     enum svg_element kind, uint32_t layer) {
  batch->svg = svg;
  batch->kind = kind;
  batch->layer = layer;
  batch->end = 0;
}

bool svg_batch_write(struct svg_batch *batch, uint32_t index) {
  if (index >= batch->end && !make_batch(batch, index))
    return false;
  if (batch->workers == 1)
    return write_drawn_element(batch->svg, batch->kind, index);
  while (index >= batch->chunks.chunk[batch->at].end)
    batch->at++;
  const struct text_chunk *chunk = &batch->chunks.chunk[batch->at];
  const uint32_t *end = &batch->text_end.item[index - batch->first];
  uint32_t from = index > chunk->begin ? end[-1] : 0;
  size_t count;
  const char *text = stream_memory(chunk->text, &count);
  stream_write(batch->svg->out, text + from, *end - from);
  return true;
}

void svg_batch_fini(struct svg_batch *batch) {
  text_chunks_fini(&batch->chunks);
  for (size_t i = 0; i < batch->worker.count; i++) {
    ARRAY_FREE(&batch->worker.item[i].point);
    ARRAY_FREE(&batch->worker.item[i].chords.point);
  }
  ARRAY_FREE(&batch->worker);
  ARRAY_FREE(&batch->text_end);
}
