/* svg_batch.c - elements of SVG written by all threads, many at once. */
#include "backends/svg_batch.h"

/* A chunk has so many points, which fit in a stream's buffer as it is
 * allocated; an element counts as some points more than it has. */
enum { CHUNK_POINTS = PARALLEL_RANGE(1 << 11), ELEMENT_POINTS = 4 };

static bool is_of_layer(const struct svg_batch *batch, uint32_t index) {
  const struct drawing *drawing = batch->svg->drawing;
  return batch->layer == (batch->kind == SVG_STROKE
                              ? drawing->stroke.item[index].layer
                              : drawing->fill.item[index].layer);
}

static size_t count_points(const struct svg_batch *batch, uint32_t index) {
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
  uint32_t i = begin;
  batch->first = begin;
  batch->at = batch->chunks = 0;
  while (i < count && batch->chunks < SVG_CHUNKS_MAX) {
    struct svg_chunk *chunk = &batch->chunk[batch->chunks++];
    chunk->begin = i;
    for (size_t points = 0; i < count && points < CHUNK_POINTS; i++)
      points +=
          is_of_layer(batch, i) ? count_points(batch, i) + ELEMENT_POINTS : 1;
    chunk->end = i;
  }
  batch->end = i;
  batch->workers = parallel_workers(batch->chunks, 1);
}

/* Gives each chunk a stream, and each worker what it writes elements with. */
static bool prepare_chunks(struct svg_batch *batch) {
  size_t workers = (size_t)batch->workers;
  recto_error error;
  for (size_t i = 0; i < batch->chunks; i++) {
    struct svg_chunk *chunk = &batch->chunk[i];
    if (chunk->text != NULL)
      stream_clear_memory(chunk->text);
    else if (stream_open_memory(&chunk->text, &error) != RECTO_OK)
      return false;
  }
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
    const struct svg_chunk *chunk = &batch->chunk[c];
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
  return batch->workers == 1 || (prepare_chunks(batch) &&
                                 parallel_ranges(batch->workers, batch->chunks,
                                                 1, write_chunks, batch));
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
  while (index >= batch->chunk[batch->at].end)
    batch->at++;
  const struct svg_chunk *chunk = &batch->chunk[batch->at];
  const uint32_t *end = &batch->text_end.item[index - batch->first];
  uint32_t from = index > chunk->begin ? end[-1] : 0;
  size_t count;
  const char *text = stream_memory(chunk->text, &count);
  stream_write(batch->svg->out, text + from, *end - from);
  return true;
}

void svg_batch_fini(struct svg_batch *batch) {
  for (size_t i = 0; i < SVG_CHUNKS_MAX; i++)
    stream_discard(batch->chunk[i].text);
  for (size_t i = 0; i < batch->worker.count; i++) {
    ARRAY_FREE(&batch->worker.item[i].point);
    ARRAY_FREE(&batch->worker.item[i].chords.point);
  }
  ARRAY_FREE(&batch->worker);
  ARRAY_FREE(&batch->text_end);
}
