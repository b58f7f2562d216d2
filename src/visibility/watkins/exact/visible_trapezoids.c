/* visible_trapezoids.c - the triangles visible in each trapezoid, as fragments.
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
#include "visibility/watkins/exact/visible_trapezoids.h"

#include <math.h>
#include <string.h>

#include "visibility/fragments/occluder_subtraction.h"

enum { CORNERS = 4 };

/* A corner of a trapezoid, and bounds of the errors of x and y. */
struct cell_corner {
  double x, y, dx, dy;
};

bool visible_trapezoids_init(struct visible_trapezoids *visible,
                             const struct sheet *sheet) {
  size_t count = sheet->triangle.count;
  memset(visible, 0, sizeof *visible);
  visible->sheet = sheet;
  visible->pieces_max = TRAPEZOIDS_PIECES_MAX;
  visible->plane = mem_alloc(count, sizeof *visible->plane);
  visible->hidden = mem_alloc(count, 1);
  visible->covered = mem_calloc(count, 1);
  visible->ties = mem_calloc(count, 1);
  if (visible->plane == NULL || visible->hidden == NULL ||
      visible->covered == NULL || visible->ties == NULL)
    return false;
  memset(visible->hidden, 1, count);
  for (size_t t = 0; t < count; t++) {
    struct geom_plane plane = sheet_plane(sheet, t);
    if (!sheet_is_edge_on(sheet, t))
      visible->plane[t] = depth_plane_of(&plane);
  }
  return true;
}

void visible_trapezoids_fini(struct visible_trapezoids *visible) {
  mem_free(visible->plane);
  mem_free(visible->hidden);
  mem_free(visible->covered);
  mem_free(visible->ties);
  ARRAY_FREE(&visible->part);
  ARRAY_FREE(&visible->tied);
  ARRAY_FREE(&visible->candidate);
  memset(visible, 0, sizeof *visible);
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

/* Lists the triangles of the trapezoid that may be visible, the nearest at its
 * middle first. */
static bool find_trapezoid_candidates(struct visible_trapezoids *visible,
                                      const struct sweep *sweep,
                                      const struct sweep_trapezoid *trapezoid) {
  const struct sweep_edge *left = &sweep->edge.item[trapezoid->left];
  const struct sweep_edge *right = &sweep->edge.item[trapezoid->right];
  double top = ratio_to_double(sweep->height.item[trapezoid->top]);
  double bottom = ratio_to_double(sweep->height.item[trapezoid->bottom]);
  const struct cell_corner corner[CORNERS] = {
      corner_at(left, top), corner_at(right, top), corner_at(left, bottom),
      corner_at(right, bottom)};
  double x = 0, y = (top + bottom) / 2, nearest = -INFINITY;
  uint32_t front = trapezoid->covering[0];
  visible->candidate.count = 0;
  if (!ARRAY_RESERVE(&visible->candidate, trapezoid->count))
    return false;
  for (int k = 0; k < CORNERS; k++)
    x += corner[k].x / CORNERS;
  for (size_t i = 0; i < trapezoid->count && trapezoid->count > 1; i++) {
    double depth =
        depth_plane_at(&visible->plane[trapezoid->covering[i]], x, y);
    if (depth > nearest ||
        (depth == nearest && trapezoid->covering[i] < front)) {
      nearest = depth;
      front = trapezoid->covering[i];
    }
  }
  visible->candidate.item[visible->candidate.count++] = front;
  for (size_t i = 0; i < trapezoid->count; i++)
    if (trapezoid->covering[i] != front &&
        !is_plane_behind(&visible->plane[trapezoid->covering[i]],
                         &visible->plane[front], corner))
      visible->candidate.item[visible->candidate.count++] =
          trapezoid->covering[i];
  return true;
}

/* Counts a tie for each candidate; returns whether all of them are deferred. */
static bool count_ties(struct visible_trapezoids *visible) {
  bool all = true;
  for (size_t i = 0; i < visible->candidate.count; i++) {
    uint32_t t = visible->candidate.item[i];
    if (!visible_trapezoids_is_deferred(visible, t))
      visible->ties[t]++;
    all &= visible_trapezoids_is_deferred(visible, t);
  }
  return all;
}

static bool store_parts(struct visible_trapezoids *visible,
                        const struct sweep_trapezoid *trapezoid) {
  const sweep_list *candidate = &visible->candidate;
  struct visible_trapezoid part = {.left = trapezoid->left,
                                   .right = trapezoid->right,
                                   .top = trapezoid->top,
                                   .bottom = trapezoid->bottom,
                                   .tied = (uint32_t)visible->tied.count};
  if (candidate->count > 1 && !count_ties(visible)) {
    part.count = (uint32_t)candidate->count;
    if (!ARRAY_RESERVE(&visible->tied, part.count))
      return false;
    memcpy(visible->tied.item + part.tied, candidate->item,
           part.count * sizeof *candidate->item);
    visible->tied.count += part.count;
  }
  for (size_t i = 0; i < candidate->count; i++) {
    part.triangle = candidate->item[i];
    if (!visible_trapezoids_is_deferred(visible, part.triangle) &&
        !ARRAY_PUSH(&visible->part, part))
      return false;
  }
  for (size_t i = 0; i < trapezoid->count; i++)
    if (candidate->count > 1 || trapezoid->covering[i] != candidate->item[0])
      visible->covered[trapezoid->covering[i]] = 1;
  return true;
}

bool visible_trapezoids_add(void *user, const struct sweep *sweep,
                            const struct sweep_trapezoid *trapezoid) {
  struct visible_trapezoids *visible = user;
  visible->count++;
  if (visible->too_many)
    return true;
  if (!find_trapezoid_candidates(visible, sweep, trapezoid))
    return false;
  visible->filter_failures += visible->candidate.count > 1;
  if (visible->keep) {
    visible->too_many = visible->part.count >= TRAPEZOIDS_MAX ||
                        visible->tied.count >= TRAPEZOIDS_TIED_MAX;
    return store_parts(visible, trapezoid);
  }
  for (size_t i = 0; i < visible->candidate.count; i++)
    visible->hidden[visible->candidate.item[i]] = 0;
  return true;
}

/* Work per trapezoid, in the units of progress.h. */
enum { PART_WORK = 32 };

/* ---- Fragments ----------------------------------------------------------- */

/* The pieces of the current triangle. */
struct piece_work {
  struct visible_trapezoids *visible;
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
static void set_lines(const struct sweep *sweep,
                      const struct visible_trapezoid *part,
                      struct geom_line line[CORNERS]) {
  const struct sweep_edge *left = &sweep->edge.item[part->left];
  const struct sweep_edge *right = &sweep->edge.item[part->right];
  geom_line_level(&line[0], sweep->height.item[part->bottom]);
  geom_line_through(&line[1], point_on_page(right->x1, right->y1),
                    point_on_page(right->x0, right->y0));
  geom_line_level(&line[2], sweep->height.item[part->top]);
  line[2] = geom_line_reversed(&line[2]);
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
static bool make_piece(const struct sweep *sweep,
                       const struct visible_trapezoid *part,
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
                            const struct visible_trapezoid *part,
                            const struct geom_convex *piece) {
  const uint32_t *other = work->visible->tied.item + part->tied;
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
  const struct visible_trapezoid *all = work->visible->part.item;
  uint32_t triangle = all[key->value].triangle;
  bool ok = true;
  if (visible_trapezoids_is_deferred(work->visible, triangle))
    return true;
  if (!work->visible->covered[triangle])
    return fragments_add_whole(work->fragments, triangle);
  work->piece.count = 0;
  for (size_t i = 0; ok && i < count; i++) {
    const struct visible_trapezoid *part = &all[key[i].value];
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
static struct sort_key *sort_parts(const struct visible_trapezoids *visible) {
  size_t count = visible->part.count;
  struct sort_key *key = mem_alloc(2 * count, sizeof *key);
  for (size_t i = 0; key != NULL && i < count; i++)
    key[i] = (struct sort_key){visible->part.item[i].triangle, (uint32_t)i};
  if (key != NULL)
    sort_keys(key, key + count, count);
  return key;
}

static bool has_too_many(const struct visible_trapezoids *visible) {
  size_t pieces = 0;
  for (size_t i = 0; i < visible->part.count; i++)
    pieces += visible->covered[visible->part.item[i].triangle];
  return visible->too_many || pieces > visible->pieces_max;
}

recto_status visible_trapezoids_finish(struct visible_trapezoids *visible,
                                       const struct sweep *sweep,
                                       struct fragments *fragments,
                                       recto_error *error) {
  struct piece_work work = {
      .visible = visible, .sweep = sweep, .fragments = fragments};
  size_t count = visible->part.count;
  struct sort_key *key;
  bool ok;
  if (has_too_many(visible))
    return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                     "too much for watkins without a pitch: faces are cut "
                     "into more than %zu trapezoids; -m auto has no such "
                     "limit",
                     visible->pieces_max);
  key = sort_parts(visible);
  ok = key != NULL;
  occluder_subtraction_init(&work.subtraction, visible->sheet);
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
