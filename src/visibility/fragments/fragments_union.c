/* fragments_union.c - unites the pieces of all faces into the map's fragments:
 * phases 3 to 5 of fragments.h. */
#include <string.h>

#include "base/parallel.h"
#include "base/poll.h"
#include "base/sort.h"
#include "visibility/fragments/face_union.h"

/* Work per piece of a face, in the units of progress.h. */
enum { PIECE_WORK = 32 };

/* Pieces of a range; its faces are those that begin in it. */
enum { PIECES_IN_RANGE = PARALLEL_RANGE(1 << 14) };

/* Where the output of a range is put in the map. */
struct output_place {
  size_t fragment, loop, corner;
};

/* The pieces, sorted by face, and the state of all threads. */
struct union_work {
  struct fragments *fragments;
  struct map *map;
  uint8_t *has_outline;    /* of the first piece of each face: whether the
                           fragment is the face's outline */
  struct line_index sides; /* of the other faces and all triangles near them */
  struct face_union *face; /* one a worker */
  size_t items, ranges;    /* pieces of a range, and the number of ranges */
  struct union_output *output; /* one a range */
  struct output_place *place;  /* one a range */
  side_lines lines;            /* of all sides */
};

/* Returns how many of the pieces, from the first on, are of one face. */
static size_t count_pieces(const struct fragment_piece *piece, size_t count) {
  size_t n = 1;
  while (n < count && piece[n].face == piece->face)
    n++;
  return n;
}

/* ---- The order of pieces ------------------------------------------------- */

struct piece_order {
  const struct fragment_piece *from;
  struct fragment_piece *to;
  struct sort_key *key; /* a face, and the number of a piece of it */
};

static bool key_pieces(void *user, struct parallel_range range) {
  const struct piece_order *order = user;
  for (size_t i = range.begin; i < range.end; i++)
    order->key[i] = (struct sort_key){order->from[i].face, (uint32_t)i};
  return true;
}

static bool move_pieces(void *user, struct parallel_range range) {
  const struct piece_order *order = user;
  for (size_t i = range.begin; i < range.end; i++)
    order->to[i] = order->from[order->key[i].value];
  return true;
}

/* Sorts the pieces by face; those of one keep their order.  Returns false when
 * memory ran out or the caller cancelled. */
static bool sort_pieces_by_face(struct fragments *f) {
  size_t n = f->piece.count;
  int workers = parallel_workers(n, PARALLEL_ITEMS);
  struct piece_order order = {f->piece.item, NULL,
                              mem_alloc(n, sizeof *order.key)};
  bool ok = order.key != NULL &&
            parallel_ranges(workers, n, PARALLEL_ITEMS, key_pieces, &order) &&
            sort_keys_alone(order.key, n);
  order.to = ok ? mem_alloc(n, sizeof *order.to) : NULL;
  ok = order.to != NULL &&
       parallel_ranges(workers, n, PARALLEL_ITEMS, move_pieces, &order);
  mem_free(order.key);
  if (!ok) {
    mem_free(order.to);
    return false;
  }
  mem_free(f->piece.item);
  f->piece.item = order.to;
  f->piece.capacity = n;
  return true;
}

/* ---- The index of sides -------------------------------------------------- */

/* Adds a triangle and all triangles of the grid cells that its box overlaps.
 * done  a byte per cell: its triangles have been added */
static bool add_nearby(struct fragments *f, uint32_t triangle, uint8_t *done) {
  const struct triangle_grid *grid = f->grid;
  struct cell_range r =
      triangle_grid_cells(grid, box2_of_triangle(f->sheet, triangle));
  if (triangle_grid_query_first(&f->query, triangle) &&
      !ARRAY_PUSH(&f->query.found, triangle))
    return false;
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++) {
      size_t cell = triangle_grid_index(grid, x, y);
      if (done[cell])
        continue;
      done[cell] = 1;
      for (uint32_t i = grid->lists.start[cell];
           i < grid->lists.start[cell + 1]; i++)
        if (triangle_grid_query_first(&f->query, grid->lists.item[i]) &&
            !ARRAY_PUSH(&f->query.found, grid->lists.item[i]))
          return false;
    }
  return true;
}

/* Indexes the sides of all faces without an outline, and of the triangles near
 * them. */
static bool index_sides(struct union_work *work) {
  struct fragments *f = work->fragments;
  const struct fragment_piece *piece = f->piece.item;
  uint8_t *cell_done = mem_calloc(triangle_grid_cell_count(f->grid), 1);
  bool ok = cell_done != NULL;
  triangle_grid_query_start(f->grid, &f->query);
  for (size_t i = 0, n, polls = 0; ok && i < f->piece.count; i += n) {
    n = count_pieces(&piece[i], f->piece.count - i);
    ok = poll_at(polls++);
    for (size_t k = 0; ok && k < n && !work->has_outline[i]; k++)
      ok = add_nearby(f, piece[i + k].triangle, cell_done);
  }
  mem_free(cell_done);
  return ok && line_index_init(&work->sides, f->sheet, f->query.found.item,
                               f->query.found.count);
}

/* ---- Ranges of faces ----------------------------------------------------- */

/* The first face that begins at a piece or later; the count of pieces where
 * none does. */
static size_t next_face(const struct fragments *fragments, size_t piece) {
  const struct fragment_piece *item = fragments->piece.item;
  while (0 < piece && piece < fragments->piece.count &&
         item[piece].face == item[piece - 1].face)
    piece++;
  return piece;
}

/* Finds which faces that begin in a range have an outline. */
static bool find_outlines(void *user, struct parallel_range range) {
  struct union_work *work = user;
  const struct fragments *f = work->fragments;
  const struct fragment_piece *piece = f->piece.item;
  for (size_t i = next_face(f, range.begin), n; i < range.end; i += n) {
    n = count_pieces(&piece[i], f->piece.count - i);
    if (i + MEM_PREFETCH_AHEAD < f->piece.count)
      sheet_prefetch_corners(f->sheet, piece[i + MEM_PREFETCH_AHEAD].triangle);
    if (!face_union_has_outline(&work->face[range.worker], &piece[i], n,
                                &work->has_outline[i]))
      return false;
  }
  return true;
}

/* Stores the fragments of the faces that begin in a range. */
static bool unite_faces(void *user, struct parallel_range range) {
  struct union_work *work = user;
  struct face_union *face = &work->face[range.worker];
  const struct fragments *f = work->fragments;
  const struct fragment_piece *piece = f->piece.item;
  for (size_t i = next_face(f, range.begin), n; i < range.end; i += n) {
    n = count_pieces(&piece[i], f->piece.count - i);
    if (!progress_step(f->progress != NULL ? &face->progress : NULL,
                       PIECE_WORK * n) ||
        !face_union_store(face, &piece[i], n, work->has_outline[i],
                          &work->output[range.begin / work->items]))
      return false;
  }
  return true;
}

/* Frees the outputs of a range. */
static void free_output(struct union_output *output) {
  ARRAY_FREE(&output->fragment);
  ARRAY_FREE(&output->loop);
  ARRAY_FREE(&output->corner);
  ARRAY_FREE(&output->lines);
}

/* Copies the output of each range to its place. */
static bool place_outputs(void *user, struct parallel_range range) {
  struct union_work *work = user;
  struct map *map = work->map;
  for (size_t r = range.begin; r < range.end; r++) {
    struct union_output *output = &work->output[r];
    struct output_place place = work->place[r];
    if (output->fragment.count == 0)
      continue;
    for (size_t i = 0; i < output->fragment.count; i++) {
      struct map_fragment *to = &map->fragment.item[place.fragment + i];
      *to = output->fragment.item[i];
      to->loop += (uint32_t)place.loop;
    }
    for (size_t i = 0; i < output->loop.count; i++) {
      struct map_loop *to = &map->loop.item[place.loop + i];
      *to = output->loop.item[i];
      to->corner += (uint32_t)place.corner;
    }
    memcpy(map->corner.item + place.corner, output->corner.item,
           output->corner.count * sizeof *output->corner.item);
    memcpy(work->lines.item + place.corner, output->lines.item,
           output->lines.count * sizeof *output->lines.item);
    free_output(output);
  }
  return true;
}

/* Joins the outputs of all ranges in the map, which has no fragment yet. */
static bool join_outputs(struct union_work *work, int workers) {
  struct map *map = work->map;
  struct output_place end = {0};
  for (size_t r = 0; r < work->ranges; r++) {
    work->place[r] = end;
    end.fragment += work->output[r].fragment.count;
    end.loop += work->output[r].loop.count;
    end.corner += work->output[r].corner.count;
  }
  if (!ARRAY_RESERVE(&map->fragment, end.fragment) ||
      !ARRAY_RESERVE(&map->loop, end.loop) ||
      !ARRAY_RESERVE(&map->corner, end.corner) ||
      !ARRAY_RESERVE(&work->lines, end.corner))
    return false;
  map->fragment.count = end.fragment;
  map->loop.count = end.loop;
  work->lines.count = map->corner.count = end.corner;
  return parallel_ranges(workers, work->ranges, 1, place_outputs, work);
}

static void report_counts(const struct fragments *fragments) {
  const struct fragments_counts *c = &fragments->counts;
  struct report *report = fragments->report;
  static const char *const side[] = {"sides_of_edges", "sides_of_occluders",
                                     "sides_of_intersections",
                                     "sides_of_clipping"};
  report_count(report, "fragments", "triangles_whole", c->whole);
  report_count(report, "fragments", "triangles_cut", c->cut);
  report_count(report, "fragments", "contact_pairs", c->contact_pairs);
  report_count(report, "fragments", "contact_filter_failures",
               c->contact_exact);
  report_count(report, "fragments", "contacts", c->contacts);
  report_count(report, "fragments", "faces_by_outline", c->outlines);
  report_count(report, "fragments", "faces_united", c->united);
  report_count(report, "fragments", "pieces_united", c->pieces);
  for (int k = 0; k <= MAP_SIDE_CLIP; k++)
    report_count(report, "fragments", side[k], c->side[k]);
}

static void add_counts(struct fragments_counts *sum,
                       const struct fragments_counts *more) {
  sum->outlines += more->outlines;
  sum->united += more->united;
  sum->pieces += more->pieces;
  for (int k = 0; k <= MAP_SIDE_CLIP; k++)
    sum->side[k] += more->side[k];
}

/* Phases 3 and 4, by so many threads. */
static bool unite(struct union_work *work, int workers) {
  struct fragments *f = work->fragments;
  size_t n = f->piece.count;
  work->items = PIECES_IN_RANGE;
  work->ranges = parallel_range_count(n, work->items);
  work->has_outline = mem_calloc(n, 1);
  work->face = mem_calloc((size_t)workers, sizeof *work->face);
  work->output = mem_calloc(work->ranges, sizeof *work->output);
  work->place = mem_calloc(work->ranges, sizeof *work->place);
  bool ok = work->has_outline != NULL && work->face != NULL &&
            work->output != NULL && work->place != NULL &&
            sort_pieces_by_face(f);
  for (int k = 0; ok && k < workers; k++)
    face_union_init(&work->face[k], f, &work->sides);
  ok = ok && parallel_ranges(workers, n, work->items, find_outlines, work) &&
       index_sides(work) &&
       parallel_ranges(workers, n, work->items, unite_faces, work) &&
       join_outputs(work, workers);
  for (int k = 0; work->face != NULL && k < workers; k++) {
    add_counts(&f->counts, &work->face[k].counts);
    face_union_fini(&work->face[k]);
  }
  for (size_t r = 0; work->output != NULL && r < work->ranges; r++)
    free_output(&work->output[r]);
  mem_free(work->has_outline);
  mem_free(work->face);
  mem_free(work->output);
  mem_free(work->place);
  line_index_fini(&work->sides);
  return ok;
}

bool fragments_finish(struct fragments *fragments, struct map *map) {
  struct union_work work = {.fragments = fragments, .map = map};
  int workers = parallel_workers(fragments->piece.count, PIECES_IN_RANGE);
  bool ok = unite(&work, workers) &&
            (map->keeps_side_lines ||
             planar_subdivision_store(&work.lines, fragments->sheet, map));
  if (ok && map->keeps_side_lines) {
    map->side_line.item = work.lines.item;
    map->side_line.count = work.lines.count;
    map->side_line.capacity = work.lines.capacity;
  } else {
    ARRAY_FREE(&work.lines);
  }
  report_counts(fragments);
  return ok;
}
