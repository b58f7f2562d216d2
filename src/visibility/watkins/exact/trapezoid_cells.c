/* trapezoid_cells.c - the triangles visible in each trapezoid, as fragments.
 *
 * Rule     the triangle nearest at the trapezoid's middle is compared with the
 *          others at its four corners, in doubles.  A triangle that is behind
 *          it at all four is behind it throughout.  One that is not intersects
 *          it, touches it, or is closer than doubles decide: it is stored along
 *          with it, a tie, and each of the tied triangles is visible where
 *          subtraction of the others, by exact planes, leaves it
 *          (occluder_subtraction.h).
 * Passes   a first sweep only finds the triangles that may be visible at all;
 *          the second sweeps only the edges of these, so that hidden triangles
 *          subdivide nothing.  A triangle that is the only one visible in all
 *          its trapezoids is wholly visible.
 *
 * Error bound.  With u = 2^-53:
 *   - a height is off by less than e = SWEEP_NEAR,
 *   - an edge's x there by its slope times e, and by less than 2^-19 by
 *     rounding,
 *   - each slope of a plane by 4 u relatively, which over 2^31 units is 2^-20,
 *   - the terms of the sum, below 2^41 where they matter, round to 2^-11.
 */
#include "visibility/watkins/exact/trapezoid_cells.h"

#include <math.h>
#include <string.h>

#include "visibility/fragments/occluder_subtraction.h"

enum { CORNERS = 4 };

/* A corner of a trapezoid, and bounds of the errors of x and y. */
struct cell_corner {
  double x, y, dx, dy;
};

bool trapezoid_cells_init(struct trapezoid_cells *cells,
                          const struct sheet *sheet) {
  size_t count = sheet->triangle.count;
  memset(cells, 0, sizeof *cells);
  cells->sheet = sheet;
  cells->pieces_max = CELLS_PIECES_MAX;
  cells->plane = mem_alloc(count, sizeof *cells->plane);
  cells->seen = mem_calloc(count, 1);
  cells->covered = mem_calloc(count, 1);
  cells->ties = mem_calloc(count, 1);
  if (cells->plane == NULL || cells->seen == NULL || cells->covered == NULL ||
      cells->ties == NULL)
    return false;
  for (size_t t = 0; t < count; t++) {
    struct geom_plane plane = sheet_plane(sheet, t);
    if (!sheet_is_edge_on(sheet, t))
      cells->plane[t] = depth_plane_of(&plane);
  }
  return true;
}

void trapezoid_cells_fini(struct trapezoid_cells *cells) {
  mem_free(cells->plane);
  mem_free(cells->seen);
  mem_free(cells->covered);
  mem_free(cells->ties);
  ARRAY_FREE(&cells->part);
  ARRAY_FREE(&cells->tied);
  ARRAY_FREE(&cells->candidate);
  memset(cells, 0, sizeof *cells);
}

/* ---- Visible triangles --------------------------------------------------- */

static struct cell_corner corner_at(const struct sweep_edge *edge, double y) {
  double slope = ((double)edge->x1 - edge->x0) / ((double)edge->y1 - edge->y0);
  return (struct cell_corner){edge->x0 + (y - edge->y0) * slope, y,
                              fabs(slope) * SWEEP_NEAR + 0x1p-19, SWEEP_NEAR};
}

/* The bound of depth_plane.h where x and y are not integers, in the terms
 * above. */
static double error_at(const struct depth_plane *plane,
                       const struct cell_corner *corner) {
  return fabs(plane->per_x) * (corner->dx + 0x1p-19) +
         fabs(plane->per_y) * (corner->dy + 0x1p-19) + 0x1p-10;
}

/* Is the plane certainly behind the other at all corners? */
static bool is_plane_behind(const struct depth_plane *plane,
                            const struct depth_plane *other,
                            const struct cell_corner *corner) {
  for (int k = 0; k < CORNERS; k++) {
    double apart = depth_plane_at(other, corner[k].x, corner[k].y) -
                   depth_plane_at(plane, corner[k].x, corner[k].y);
    if (!(apart > error_at(plane, &corner[k]) + error_at(other, &corner[k])))
      return false;
  }
  return true;
}

/* Lists the triangles of the cell that may be visible, the nearest at its
 * middle first. */
static bool find_cell_candidates(struct trapezoid_cells *cells,
                                 const struct sweep *sweep,
                                 const struct sweep_cell *cell) {
  const struct sweep_edge *left = &sweep->edge.item[cell->left];
  const struct sweep_edge *right = &sweep->edge.item[cell->right];
  double top = ratio_to_double(sweep->height.item[cell->top]);
  double bottom = ratio_to_double(sweep->height.item[cell->bottom]);
  const struct cell_corner corner[CORNERS] = {
      corner_at(left, top), corner_at(right, top), corner_at(left, bottom),
      corner_at(right, bottom)};
  double x = 0, y = (top + bottom) / 2, nearest = -INFINITY;
  uint32_t front = cell->in[0];
  cells->candidate.count = 0;
  if (!ARRAY_RESERVE(&cells->candidate, cell->count))
    return false;
  for (int k = 0; k < CORNERS; k++)
    x += corner[k].x / CORNERS;
  for (size_t i = 0; i < cell->count && cell->count > 1; i++) {
    double depth = depth_plane_at(&cells->plane[cell->in[i]], x, y);
    if (depth > nearest || (depth == nearest && cell->in[i] < front)) {
      nearest = depth;
      front = cell->in[i];
    }
  }
  cells->candidate.item[cells->candidate.count++] = front;
  for (size_t i = 0; i < cell->count; i++)
    if (cell->in[i] != front && !is_plane_behind(&cells->plane[cell->in[i]],
                                                 &cells->plane[front], corner))
      cells->candidate.item[cells->candidate.count++] = cell->in[i];
  return true;
}

/* Counts a tie for each candidate; returns whether all of them are deferred. */
static bool count_ties(struct trapezoid_cells *cells) {
  bool all = true;
  for (size_t i = 0; i < cells->candidate.count; i++) {
    uint32_t t = cells->candidate.item[i];
    if (!trapezoid_cells_is_deferred(cells, t))
      cells->ties[t]++;
    all &= trapezoid_cells_is_deferred(cells, t);
  }
  return all;
}

static bool store_parts(struct trapezoid_cells *cells,
                        const struct sweep_cell *cell) {
  const sweep_list *candidate = &cells->candidate;
  struct cell_part part = {.left = cell->left,
                           .right = cell->right,
                           .top = cell->top,
                           .bottom = cell->bottom,
                           .tied = (uint32_t)cells->tied.count};
  if (candidate->count > 1 && !count_ties(cells)) {
    part.count = (uint32_t)candidate->count;
    if (!ARRAY_RESERVE(&cells->tied, part.count))
      return false;
    memcpy(cells->tied.item + part.tied, candidate->item,
           part.count * sizeof *candidate->item);
    cells->tied.count += part.count;
  }
  for (size_t i = 0; i < candidate->count; i++) {
    part.triangle = candidate->item[i];
    if (!trapezoid_cells_is_deferred(cells, part.triangle) &&
        !ARRAY_PUSH(&cells->part, part))
      return false;
  }
  for (size_t i = 0; i < cell->count; i++)
    if (candidate->count > 1 || cell->in[i] != candidate->item[0])
      cells->covered[cell->in[i]] = 1;
  return true;
}

bool trapezoid_cells_add(void *user, const struct sweep *sweep,
                         const struct sweep_cell *cell) {
  struct trapezoid_cells *cells = user;
  cells->count++;
  if (cells->too_many)
    return true;
  if (!find_cell_candidates(cells, sweep, cell))
    return false;
  cells->filter_failures += cells->candidate.count > 1;
  if (cells->keep) {
    cells->too_many =
        cells->part.count >= CELLS_MAX || cells->tied.count >= CELLS_TIED_MAX;
    return store_parts(cells, cell);
  }
  for (size_t i = 0; i < cells->candidate.count; i++)
    cells->seen[cells->candidate.item[i]] = 1;
  return true;
}

/* Work per trapezoid, in the units of progress.h. */
enum { PART_WORK = 32 };

/* ---- Fragments ----------------------------------------------------------- */

/* The pieces of the current triangle. */
struct piece_work {
  struct trapezoid_cells *cells;
  const struct sweep *sweep;
  struct fragments *fragments;
  struct occluder_subtraction subtraction;
  struct arena arena;
  geom_pieces piece;
};

static struct geom_point point_on_page(int32_t x, int32_t y) {
  return (struct geom_point){x, y, 0};
}

/* The four lines of a trapezoid, each with the trapezoid on its left: below,
 * right, above, left. */
static void set_lines(const struct sweep *sweep, const struct cell_part *part,
                      struct geom_line line[CORNERS]) {
  const struct sweep_edge *left = &sweep->edge.item[part->left];
  const struct sweep_edge *right = &sweep->edge.item[part->right];
  geom_line_level(&line[0], sweep->height.item[part->bottom]);
  geom_line_through(&line[1], point_on_page(right->x1, right->y1),
                    point_on_page(right->x0, right->y0));
  geom_line_level(&line[2], sweep->height.item[part->top]);
  geom_line_reverse(&line[2]);
  geom_line_through(&line[3], point_on_page(left->x0, left->y0),
                    point_on_page(left->x1, left->y1));
}

static void widen_box(struct geom_convex *piece, double x, double y) {
  piece->x0 = fmin(piece->x0, x - 1);
  piece->y0 = fmin(piece->y0, y - 1);
  piece->x1 = fmax(piece->x1, x + 1);
  piece->y1 = fmax(piece->y1, y + 1);
}

/* The trapezoid as a convex piece; a triangle where its left and right sides
 * meet at the top or at the bottom. */
static bool make_piece(const struct sweep *sweep, const struct cell_part *part,
                       struct arena *arena, struct geom_convex *piece) {
  struct geom_line *line = arena_alloc(arena, CORNERS, sizeof *line);
  const struct geom_line **side = arena_alloc(arena, CORNERS, sizeof *side);
  struct geom_corner *corner =
      arena_alloc(arena, CORNERS, sizeof *piece->corner);
  struct geom_corner all[CORNERS];
  *piece = (struct geom_convex){0,        corner,    side,     INFINITY,
                                INFINITY, -INFINITY, -INFINITY};
  if (line == NULL || side == NULL || corner == NULL)
    return false;
  set_lines(sweep, part, line);
  for (int k = 0; k < CORNERS; k++)
    all[k] = geom_corner_of(&line[(k + 3) % CORNERS], &line[k]);
  for (int k = 0; k < CORNERS; k++) {
    int next = (k + 1) % CORNERS;
    if (k % 2 == 0 && geom_corner_compare(&all[k], &all[next]) == 0)
      continue;
    corner[piece->count] = all[k];
    side[piece->count++] = &line[k];
    widen_box(piece, all[k].x, all[k].y);
  }
  return true;
}

/* Appends what remains of a trapezoid when the nearer ones of the tied
 * triangles are subtracted. */
static bool subtract_others(struct piece_work *work,
                            const struct cell_part *part,
                            const struct geom_convex *piece) {
  const uint32_t *other = work->cells->tied.item + part->tied;
  struct occluder_subtraction *subtraction = &work->subtraction;
  if (!occluder_subtraction_start(subtraction, part->triangle, piece))
    return false;
  for (uint32_t i = 0;
       i < part->count && !occluder_subtraction_is_empty(subtraction); i++)
    if (other[i] != part->triangle &&
        !occluder_subtraction_subtract_nearer(subtraction, other[i]))
      return false;
  for (size_t i = 0; i < subtraction->left.count; i++) {
    struct geom_convex copy;
    if (!geom_convex_copy(&copy, &subtraction->left.item[i], &work->arena) ||
        !ARRAY_PUSH(&work->piece, copy))
      return false;
  }
  return true;
}

/* Adds the parts of one triangle to the fragments. */
static bool store_triangle(struct piece_work *work, const struct sort_key *key,
                           size_t count) {
  const struct cell_part *all = work->cells->part.item;
  uint32_t triangle = all[key->value].triangle;
  bool ok = true;
  if (trapezoid_cells_is_deferred(work->cells, triangle))
    return true;
  if (!work->cells->covered[triangle])
    return fragments_add_whole(work->fragments, triangle);
  work->piece.count = 0;
  for (size_t i = 0; ok && i < count; i++) {
    const struct cell_part *part = &all[key[i].value];
    struct geom_convex piece;
    ok = make_piece(work->sweep, part, &work->arena, &piece) &&
         (part->count > 0 ? subtract_others(work, part, &piece)
                          : ARRAY_PUSH(&work->piece, piece));
  }
  ok = ok && fragments_add(work->fragments, triangle, work->piece.item,
                           work->piece.count);
  arena_reset(&work->arena);
  return ok;
}

/* The parts sorted by triangle; NULL when memory ran out. */
static struct sort_key *sort_parts(const struct trapezoid_cells *cells) {
  size_t count = cells->part.count;
  struct sort_key *key = mem_alloc(2 * count, sizeof *key);
  for (size_t i = 0; key != NULL && i < count; i++)
    key[i] = (struct sort_key){cells->part.item[i].triangle, (uint32_t)i};
  if (key != NULL)
    sort_keys(key, key + count, count);
  return key;
}

static bool has_too_many(const struct trapezoid_cells *cells) {
  size_t pieces = 0;
  for (size_t i = 0; i < cells->part.count; i++)
    pieces += cells->covered[cells->part.item[i].triangle];
  return cells->too_many || pieces > cells->pieces_max;
}

recto_status trapezoid_cells_finish(struct trapezoid_cells *cells,
                                    const struct sweep *sweep,
                                    struct fragments *fragments,
                                    recto_error *error) {
  struct piece_work work = {
      .cells = cells, .sweep = sweep, .fragments = fragments};
  size_t count = cells->part.count;
  struct sort_key *key;
  bool ok;
  if (has_too_many(cells))
    return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                     "too much for watkins without a pitch: faces are cut "
                     "into more than %zu trapezoids; -m auto has no such "
                     "limit",
                     cells->pieces_max);
  key = sort_parts(cells);
  ok = key != NULL;
  occluder_subtraction_init(&work.subtraction, cells->sheet);
  for (size_t i = 0, past; ok && i < count; i = past) {
    for (past = i + 1; past < count && key[past].key == key[i].key;)
      past++;
    ok = progress_step(fragments->progress, PART_WORK * (past - i)) &&
         store_triangle(&work, &key[i], past - i);
  }
  mem_free(key);
  occluder_subtraction_fini(&work.subtraction);
  arena_fini(&work.arena);
  ARRAY_FREE(&work.piece);
  return ok ? RECTO_OK : error_memory(error);
}
