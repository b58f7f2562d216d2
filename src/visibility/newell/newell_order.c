/* newell_order.c - finds the painter's order of Newell, Newell and Sancha.
 *
 * Phases
 *   1 all faces are sorted by their farthest z: list S
 *   2 the rearmost face P that is not painted yet becomes the candidate; it is
 *     tested against every face Q that it may occlude (newell_tests.c)
 *   3 if P is in front of no Q, P is painted; otherwise every Q that P is in
 *     front of is moved ahead of P and marked, and becomes the candidate in
 *     turn
 *   4 a marked face that would have to be moved again closes a cycle: it is
 *     split by the plane of the candidate or, if that plane misses it, by a
 *     side of the candidate; faces that intersect are split where their planes
 *     intersect
 *
 * Invariants
 *   A painted piece is in front of no piece that is not painted yet.
 *   The pieces of a triangle tile it, including those that are not seen.
 *
 * Limits.  n triangles that intersect each other have about n^3 pieces.  A
 * triangle that was split more than SPLITS_MAX times is therefore excluded from
 * the order, and so are all waiting triangles once there were too many tests.
 * The order of such a triangle relative to the others is unknown; users of the
 * order compare the planes instead.
 *
 * Termination.  Each split follows one of finitely many lines (sides, and
 * intersections of planes) and leaves two proper parts.  Between splits the
 * marked faces form a path, which is no longer than the number of pieces.
 *
 * On request only some of the tests are applied and nothing is split
 * (newell_order.h); what the tests leave open, and what closes a cycle, is
 * painted in the order of list S.
 *
 * Source  [Newell1972]; marking and splitting as there.
 */
#include "visibility/newell/newell_order.h"

#include <string.h>

#include "base/poll.h"
#include "base/sort.h"
#include "visibility/newell/newell_tests.h"

/* Work per pair of pieces, in the units of progress.h. */
enum { PAIR_WORK = 128 };

/* The splits of one triangle, and the total number of tests of n triangles:
 *   TESTS_MIN + TESTS_PER_TRIANGLE n
 * at most. */
enum { SPLITS_MAX = 16, TESTS_PER_TRIANGLE = 1 << 12, TESTS_MIN = 1 << 22 };

/* ---- Pieces -------------------------------------------------------------- */

/* Adds every triangle of the sheet as a piece. */
static bool add_triangles(struct newell_order *order) {
  const struct sheet *sheet = order->sheet;
  size_t n = sheet->triangle.count;
  order->open = mem_alloc(n, sizeof *order->open);
  order->splits = mem_calloc(n, sizeof *order->splits);
  if (order->open == NULL || order->splits == NULL ||
      !ARRAY_RESERVE(&order->piece, n))
    return false;
  for (size_t t = 0; t < n; t++) {
    if (!poll_at(t))
      return false;
    struct newell_piece piece = {
        .triangle = (uint32_t)t,
        .next = NEWELL_NONE,
        .next_open = NEWELL_NONE,
        .last_open = NEWELL_NONE,
        .box = box2_of_triangle(sheet, (uint32_t)t),
        .rank = NEWELL_NONE,
        .state = sheet_is_edge_on(sheet, t) ||
                         triangle_grid_leaves_out(order->grid, (uint32_t)t)
                     ? NEWELL_UNSEEN
                     : NEWELL_WAITING};
    geom_depth_range(sheet_corners(sheet, t).p, &piece.z_low, &piece.z_high);
    order->open[t] = piece.state == NEWELL_WAITING ? (uint32_t)t : NEWELL_NONE;
    order->piece.item[order->piece.count++] = piece;
  }
  return true;
}

static int32_t clamp_coordinate(double v) {
  return v < -0x1p30 ? -(1 << 30) : v > 0x1p30 ? 1 << 30 : (int32_t)v;
}

/* Adds a part of piece `from`; the shape is in the order's arena. */
static bool add_piece_part(struct newell_order *order, uint32_t from,
                           const struct geom_convex *shape) {
  struct newell_piece piece = order->piece.item[from];
  struct newell_piece *first = &order->piece.item[piece.triangle];
  piece.shape = arena_alloc(&order->arena, 1, sizeof *piece.shape);
  if (piece.shape == NULL ||
      !geom_convex_copy(piece.shape, shape, &order->arena))
    return false;
  piece.state = NEWELL_WAITING;
  piece.box = (struct box2){
      clamp_coordinate(shape->x0 - 1), clamp_coordinate(shape->y0 - 1),
      clamp_coordinate(shape->x1 + 1), clamp_coordinate(shape->y1 + 1)};
  piece.next = first->next;
  first->next = (uint32_t)order->piece.count;
  piece.last_open = NEWELL_NONE;
  piece.next_open = order->open[piece.triangle];
  if (piece.next_open != NEWELL_NONE)
    order->piece.item[piece.next_open].last_open = first->next;
  order->open[piece.triangle] = first->next;
  return ARRAY_PUSH(&order->piece, piece);
}

/* Removes a piece from its triangle's list of open ones, since it is painted,
 * split or unseen: it is not tested any more. */
static void close_piece(struct newell_order *order, uint32_t piece,
                        enum newell_state state) {
  struct newell_piece *p = &order->piece.item[piece];
  p->state = (uint8_t)state;
  if (p->last_open != NEWELL_NONE)
    order->piece.item[p->last_open].next_open = p->next_open;
  else
    order->open[p->triangle] = p->next_open;
  if (p->next_open != NEWELL_NONE)
    order->piece.item[p->next_open].last_open = p->last_open;
}

/* Excludes a triangle from the order. */
static void exclude_triangle(struct newell_order *order, uint32_t triangle) {
  while (order->open[triangle] != NEWELL_NONE)
    close_piece(order, order->open[triangle], NEWELL_UNSEEN);
  order->splits[triangle] = NEWELL_UNORDERED;
  order->counts.deferred++;
}

/* Counts a split of a triangle; too many exclude it. */
static void count_split(struct newell_order *order, uint32_t triangle) {
  if (++order->splits[triangle] > SPLITS_MAX)
    exclude_triangle(order, triangle);
}

/* ---- Splitting ----------------------------------------------------------- */

/* Splits a piece by a line.
 * split  receives whether the line leaves two proper parts; if not, nothing is
 *        done */
static bool split_by(struct newell_order *order, uint32_t piece,
                     const struct geom_convex *shape,
                     const struct geom_line *line,
                     const struct geom_line *reversed, bool *split) {
  struct geom_convex left, right;
  if (!geom_convex_split(shape, line, reversed, &left, &right, &order->scratch))
    return false;
  *split = left.count > 0 && right.count > 0;
  if (!*split)
    return true;
  close_piece(order, piece, NEWELL_SPLIT);
  return add_piece_part(order, piece, &left) &&
         add_piece_part(order, piece, &right);
}

/* Splits P where its plane intersects that of Q: the two pierce each other. */
static bool split_at_intersection(struct newell_order *order, uint32_t p,
                                  uint32_t q) {
  struct geom_line line, reversed;
  struct geom_convex shape;
  bool split;
  if (newell_crossing(order, p, q, &line, &reversed) != 0)
    return true;
  if (!newell_piece_shape(order, p, &shape) ||
      !split_by(order, p, &shape, &line, &reversed, &split))
    return false;
  order->counts.split_intersection++;
  count_split(order, order->piece.item[p].triangle);
  return true;
}

/* Splits Q to break a cycle: Q is marked already and would have to be moved
 * again, because the candidate P is in front of it. */
static bool split_cycle(struct newell_order *order, uint32_t p, uint32_t q) {
  struct geom_line line, reversed, *side;
  struct geom_convex shape;
  bool split = false;
  int count;
  order->counts.cycles++;
  if (!newell_piece_shape(order, q, &shape))
    return false;
  if (newell_crossing(order, p, q, &line, &reversed) == 0 &&
      !split_by(order, q, &shape, &line, &reversed, &split))
    return false;
  side = newell_piece_lines(order, p, &count, &order->scratch);
  if (side == NULL)
    return false;
  for (int k = 0; k < count && !split; k++)
    if (!split_by(order, q, &shape, &side[k], &side[count + k], &split))
      return false;
  if (split) {
    order->counts.split_cycle++;
    count_split(order, order->piece.item[q].triangle);
  } else { /* Q lies within the outline of P, which is in front of it */
    close_piece(order, q, NEWELL_UNSEEN);
    order->counts.unseen++;
  }
  return true;
}

/* ---- The candidates ------------------------------------------------------ */

/* Pops the stack down to and including piece q, and unmarks what is popped. */
static void pop_down_to(struct newell_order *order, uint32_t q) {
  uint32_t top;
  do {
    top = order->stack.item[--order->stack.count];
    if (order->piece.item[top].state == NEWELL_MARKED)
      order->piece.item[top].state = NEWELL_WAITING;
  } while (top != q);
}

/* What follows from a test of the candidate: it may be painted, another piece
 * was moved ahead of it, or a piece was split. */
enum order_step { STEP_FAILED, STEP_PAINT, STEP_MOVED, STEP_SPLIT };

/* Tests candidate P against piece Q. */
static enum order_step test_pieces(struct newell_order *order, uint32_t p,
                                   uint32_t q) {
  order->counts.tests++;
  switch (order->tests > 0 ? newell_test_some(order, p, q)
                           : newell_test(order, p, q)) {
  case NEWELL_FAILED:
    return STEP_FAILED;
  case NEWELL_P_FIRST:
    return STEP_PAINT;
  case NEWELL_PIERCE:
    pop_down_to(order, p);
    return split_at_intersection(order, p, q) ? STEP_SPLIT : STEP_FAILED;
  case NEWELL_Q_FIRST:
    break;
  }
  if (order->piece.item[q].state == NEWELL_MARKED) {
    if (order->tests > 0)
      return STEP_PAINT;
    pop_down_to(order, q);
    return split_cycle(order, p, q) ? STEP_SPLIT : STEP_FAILED;
  }
  order->counts.moved++;
  return ARRAY_PUSH(&order->stack, q) ? STEP_MOVED : STEP_FAILED;
}

/* Tests candidate P against all pieces that it may occlude. */
static enum order_step test_candidate(struct newell_order *order, uint32_t p) {
  enum order_step result = STEP_PAINT;
  uint32_t triangle = order->piece.item[p].triangle;
  if (!triangle_grid_find_overlapping(order->grid, triangle, &order->query))
    return STEP_FAILED;
  for (size_t i = 0; i < order->query.found.count; i++) {
    uint32_t t = order->query.found.item[i];
    if (!progress_step(&order->progress, 1))
      return STEP_FAILED;
    if (t == triangle)
      continue;
    for (uint32_t q = order->open[t]; q != NEWELL_NONE;
         q = order->piece.item[q].next_open) {
      if (!progress_step(&order->progress, PAIR_WORK))
        return STEP_FAILED;
      enum order_step step = test_pieces(order, p, q);
      arena_reset(&order->scratch);
      if (step == STEP_FAILED || step == STEP_SPLIT)
        return step;
      if (step == STEP_MOVED)
        result = STEP_MOVED;
    }
  }
  return result;
}

/* Paints piece `root` and all that must be painted before it. */
static bool paint_with_predecessors(struct newell_order *order, uint32_t root) {
  if (!ARRAY_PUSH(&order->stack, root))
    return false;
  while (order->stack.count > 0) {
    uint32_t p = order->stack.item[order->stack.count - 1];
    struct newell_piece *piece = &order->piece.item[p];
    if (piece->state > NEWELL_MARKED) {
      order->stack.count--;
      continue;
    }
    piece->state = NEWELL_MARKED;
    switch (test_candidate(order, p)) {
    case STEP_FAILED:
      return false;
    case STEP_PAINT:
      order->stack.count--;
      close_piece(order, p, NEWELL_PAINTED);
      piece->rank = (uint32_t)order->painted.count;
      if (!ARRAY_PUSH(&order->painted, p))
        return false;
      break;
    case STEP_MOVED:
    case STEP_SPLIT:
      break;
    }
  }
  return true;
}

/* List S: the triangles from back to front by their farthest corner.  Returns
 * NULL when memory ran out. */
static struct sort_key *sort_by_depth(const struct newell_order *order,
                                      size_t n) {
  struct sort_key *key = mem_alloc(2 * n, sizeof *key);
  if (key == NULL)
    return NULL;
  for (size_t t = 0; t < n; t++)
    key[t] = (struct sort_key){sort_key_of_int64(order->piece.item[t].z_low),
                               (uint32_t)t};
  sort_keys(key, key + n, n);
  return key;
}

recto_status newell_order_init(struct newell_order *order,
                               const struct sheet *sheet,
                               const struct triangle_grid *grid,
                               const struct solver_request *request,
                               recto_error *error) {
  size_t n = sheet->triangle.count;
  uint64_t tests_max = TESTS_MIN + (uint64_t)TESTS_PER_TRIANGLE * n;
  struct sort_key *s;
  recto_status status = RECTO_OK;
  memset(order, 0, sizeof *order);
  order->sheet = sheet;
  order->grid = grid;
  order->progress = progress_of(request, "ordering");
  order->tests = request->newell_tests;
  order->lines_only = !request->fragments && order->tests == 0;
  order->prepared = NEWELL_NONE;
  if (!triangle_grid_query_init(&order->query, grid) || !add_triangles(order))
    return error_memory(error);
  s = sort_by_depth(order, n);
  if (s == NULL)
    return error_memory(error);
  for (size_t i = 0; i < n && status == RECTO_OK; i++) {
    uint32_t p = s[i].value;
    order->progress.share = (double)i / (double)n;
    if (order->piece.item[p].state == NEWELL_UNSEEN)
      order->piece.item[p].rank = (uint32_t)order->painted.count;
    while (status == RECTO_OK && order->open[p] != NEWELL_NONE)
      if (order->tests == 0 && order->counts.tests > tests_max)
        exclude_triangle(order, p);
      else if (!paint_with_predecessors(order, order->open[p]))
        status = error_memory(error);
  }
  mem_free(s);
  return status;
}

void newell_order_fini(struct newell_order *order) {
  triangle_grid_query_fini(&order->query);
  ARRAY_FREE(&order->piece);
  mem_free(order->open);
  mem_free(order->splits);
  ARRAY_FREE(&order->painted);
  ARRAY_FREE(&order->stack);
  arena_fini(&order->arena);
  arena_fini(&order->scratch);
}
