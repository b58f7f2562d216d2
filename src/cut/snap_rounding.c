/* snap_rounding.c - splits the segments of a section where they cross, at nodes
 * with whole coordinates.
 *
 * Every node, and every place where two pieces cross, makes the square of a
 * unit around the nearest whole coordinates hot; a piece that passes through a
 * hot square is led through its middle.  Pieces so split cross nowhere else
 * [Hobby1999], and no crossing is looked for again.
 *
 * Pieces are found by a grid of cells as large as their mean extent.
 * Robustness  coordinates are below 2^39: products of three fit in 128 bits.
 * Cost        n log n for pieces of similar lengths; more than PAIRS_MAX pairs
 *             of pieces in one cell are refused. */
#include <math.h>

#include "base/number_lists.h"
#include "base/poll.h"
#include "base/sort.h"
#include "cut/section_phases.h"

enum { CROSSINGS_MAX = 1 << 22 };
#define PAIRS_MAX (UINT64_C(1) << 31)

struct piece {
  uint32_t a, b, segment;
};

struct snapper {
  struct section *section;
  ARRAY(struct piece) piece; /* in the order of their segments */
  int64_t low[2];
  double cell[2]; /* width and height */
  uint32_t cells[2];
  struct number_lists pieces, nodes; /* of each cell */
  ARRAY(struct section_node) crossing;
  ARRAY(struct sort_key) hot; /* nodes, by their order along a piece */
  bool failed;                /* memory ran out */
};

static const struct section_node *end_of(const struct snapper *s,
                                         const struct piece *piece, int k) {
  return &s->section->node.item[k == 0 ? piece->a : piece->b];
}

/* ---- Cells --------------------------------------------------------------- */

static bool add_section_piece(struct snapper *s, uint32_t a, uint32_t b,
                              size_t segment) {
  const struct piece piece = {a, b, (uint32_t)segment};
  return a == b || ARRAY_PUSH(&s->piece, piece);
}

static bool collect_pieces(struct snapper *s) {
  const struct section *section = s->section;
  for (size_t i = 0; i < section->segment.count; i++) {
    const struct section_segment *segment = &section->segment.item[i];
    if (section->path_start.count == 0 &&
        !add_section_piece(s, segment->from, segment->to, i))
      return false;
    for (uint32_t k = section->path_start.count == 0
                          ? UINT32_MAX
                          : section->path_start.item[i] + 1;
         k != UINT32_MAX && k < section->path_start.item[i + 1]; k++)
      if (!add_section_piece(s, section->path.item[k - 1],
                             section->path.item[k], i))
        return false;
  }
  return true;
}

static void choose_cells(struct snapper *s) {
  const struct section *section = s->section;
  int64_t high[2] = {0, 0};
  double sum[2] = {0, 0}, pieces = (double)s->piece.count;
  for (size_t n = 0; n < section->node.count; n++) {
    const int64_t at[2] = {section->node.item[n].u, section->node.item[n].v};
    for (int k = 0; k < 2; k++) {
      s->low[k] = n == 0 || at[k] < s->low[k] ? at[k] : s->low[k];
      high[k] = n == 0 || at[k] > high[k] ? at[k] : high[k];
    }
  }
  for (size_t i = 0; i < s->piece.count; i++) {
    const struct section_node *a = end_of(s, &s->piece.item[i], 0);
    const struct section_node *b = end_of(s, &s->piece.item[i], 1);
    sum[0] += fabs((double)(b->u - a->u));
    sum[1] += fabs((double)(b->v - a->v));
  }
  double extent[2], count[2];
  for (int k = 0; k < 2; k++) {
    extent[k] = (double)(high[k] - s->low[k]) + 1;
    count[k] = fmin(extent[k] / fmax(sum[k] / pieces, 1), pieces);
  }
  while (count[0] * count[1] > 4 * pieces)
    count[count[0] < count[1]] /= 2;
  for (int k = 0; k < 2; k++) {
    s->cells[k] = (uint32_t)fmax(count[k], 1);
    s->cell[k] = extent[k] / s->cells[k];
  }
}

static uint32_t piece_cell_at(const struct snapper *s, int k, double at) {
  double cell = (at - (double)s->low[k]) / s->cell[k];
  return (uint32_t)fmin(fmax(cell, 0), s->cells[k] - 1);
}

/* Calls visit for the cells that a piece comes within two units of. */
static void visit_piece_cells(struct snapper *s, const struct piece *piece,
                              void (*visit)(struct snapper *s, size_t cell,
                                            uint32_t number),
                              uint32_t number) {
  enum { NEAR = 2 };
  const struct section_node *a = end_of(s, piece, 0), *b = end_of(s, piece, 1);
  if (a->u > b->u) {
    const struct section_node *swap = a;
    a = b;
    b = swap;
  }
  double slope =
      a->u < b->u ? (double)(b->v - a->v) / (double)(b->u - a->u) : 0;
  uint32_t last = piece_cell_at(s, 0, (double)b->u + NEAR);
  for (uint32_t i = piece_cell_at(s, 0, (double)a->u - NEAR); i <= last; i++) {
    double left = (double)s->low[0] + i * s->cell[0] - NEAR;
    double right = left + s->cell[0] + 2 * NEAR;
    double from = (double)a->v, to = (double)b->v;
    if (left > (double)a->u)
      from += slope * (left - (double)a->u);
    if (right < (double)b->u)
      to -= slope * ((double)b->u - right);
    uint32_t top = piece_cell_at(s, 1, fmax(from, to) + NEAR);
    for (uint32_t j = piece_cell_at(s, 1, fmin(from, to) - NEAR); j <= top; j++)
      visit(s, (size_t)i * s->cells[1] + j, number);
  }
}

static void put_piece_in_cell(struct snapper *s, size_t cell, uint32_t number) {
  number_lists_put(&s->pieces, cell, number);
}

static void put_section_pieces(struct snapper *s) {
  for (size_t i = s->piece.count; i-- > 0;)
    visit_piece_cells(s, &s->piece.item[i], put_piece_in_cell, (uint32_t)i);
}

static void put_section_nodes(struct snapper *s) {
  for (size_t n = s->section->node.count; n-- > 0;) {
    const struct section_node *node = &s->section->node.item[n];
    size_t cell = (size_t)piece_cell_at(s, 0, (double)node->u) * s->cells[1] +
                  piece_cell_at(s, 1, (double)node->v);
    number_lists_put(&s->nodes, cell, (uint32_t)n);
  }
}

/* Makes the lists of all cells in two passes of `put`. */
static bool fill_lists(struct snapper *s, struct number_lists *lists,
                       void (*put)(struct snapper *s)) {
  size_t cells = (size_t)s->cells[0] * s->cells[1];
  if (!number_lists_init(lists, cells))
    return false;
  put(s);
  if (!number_lists_allocate(lists, cells))
    return false;
  put(s);
  return true;
}

/* ---- Crossings ----------------------------------------------------------- */

/* The whole number nearest to a + d num / den, halves up; den > 0. */
static int64_t round_along(int64_t a, int64_t d, int128 num, int128 den) {
  int128 above = 2 * num * d + den, below = 2 * den;
  int128 whole = above / below;
  return a + (int64_t)(above % below < 0 ? whole - 1 : whole);
}

/* Adds the place where two pieces cross, but not at an end of either. */
static bool add_piece_crossing(struct snapper *s, const struct piece *p,
                               const struct piece *q) {
  const struct section_node *a = end_of(s, p, 0), *b = end_of(s, p, 1);
  const struct section_node *c = end_of(s, q, 0), *d = end_of(s, q, 1);
  if (section_side(a, b, c) * section_side(a, b, d) >= 0 ||
      section_side(c, d, a) * section_side(c, d, b) >= 0)
    return true;
  int128 num = (int128)(c->u - a->u) * (d->v - c->v) -
               (int128)(c->v - a->v) * (d->u - c->u);
  int128 den = (int128)(b->u - a->u) * (d->v - c->v) -
               (int128)(b->v - a->v) * (d->u - c->u);
  if (den < 0) {
    num = -num;
    den = -den;
  }
  const struct section_node at = {round_along(a->u, b->u - a->u, num, den),
                                  round_along(a->v, b->v - a->v, num, den),
                                  SECTION_NONE};
  return ARRAY_PUSH(&s->crossing, at);
}

static bool piece_boxes_meet(const struct snapper *s, const struct piece *p,
                             const struct piece *q) {
  const struct section_node *a = end_of(s, p, 0), *b = end_of(s, p, 1);
  const struct section_node *c = end_of(s, q, 0), *d = end_of(s, q, 1);
#define LEAST(x, y) ((x) < (y) ? (x) : (y))
#define MOST(x, y) ((x) < (y) ? (y) : (x))
  return LEAST(a->u, b->u) <= MOST(c->u, d->u) &&
         LEAST(c->u, d->u) <= MOST(a->u, b->u) &&
         LEAST(a->v, b->v) <= MOST(c->v, d->v) &&
         LEAST(c->v, d->v) <= MOST(a->v, b->v);
}

static recto_status refuse_crossings(recto_error *error) {
  return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                   "the surfaces cross each other too often where they are "
                   "cut");
}

static recto_status find_piece_crossings(struct snapper *s,
                                         recto_error *error) {
  size_t cells = (size_t)s->cells[0] * s->cells[1];
  const uint32_t *start = s->pieces.start;
  uint64_t pairs = 0;
  for (size_t c = 0; c < cells; c++)
    pairs +=
        (uint64_t)(start[c + 1] - start[c]) * (start[c + 1] - start[c]) / 2;
  if (pairs > PAIRS_MAX)
    return refuse_crossings(error);
  for (size_t c = 0; c < cells; c++)
    for (size_t i = start[c]; i < start[c + 1]; i++) {
      const struct piece *p = &s->piece.item[s->pieces.item[i]];
      for (size_t k = start[c]; k < i; k++) {
        const struct piece *q = &s->piece.item[s->pieces.item[k]];
        if (piece_boxes_meet(s, p, q) && !add_piece_crossing(s, p, q))
          return error_memory(error);
      }
      if (s->crossing.count > CROSSINGS_MAX)
        return refuse_crossings(error);
      if (!poll_at(i))
        return error_cancelled(error);
    }
  return RECTO_OK;
}

/* Adds the crossings to the nodes; the ends of pieces and segments are found
 * anew, by their places. */
static bool add_crossing_nodes(struct snapper *s) {
  struct section *section = s->section;
  size_t count = section->node.count;
  struct section_node *old = mem_alloc(count, sizeof *old);
  uint32_t *now = mem_alloc(count, sizeof *now);
  bool ok = old != NULL && now != NULL;
  for (size_t n = 0; ok && n < count; n++)
    old[n] = section->node.item[n];
  for (size_t i = 0; ok && i < s->crossing.count; i++)
    ok = ARRAY_PUSH(&section->node, s->crossing.item[i]);
  ok = ok && section_sort_nodes(section);
  for (size_t n = 0; ok && n < count; n++)
    now[n] = section_node_at(section, old[n].u, old[n].v);
  for (size_t i = 0; ok && i < s->piece.count; i++) {
    s->piece.item[i].a = now[s->piece.item[i].a];
    s->piece.item[i].b = now[s->piece.item[i].b];
  }
  for (size_t i = 0; ok && i < section->segment.count; i++) {
    section->segment.item[i].from = now[section->segment.item[i].from];
    section->segment.item[i].to = now[section->segment.item[i].to];
  }
  mem_free(old);
  mem_free(now);
  return ok;
}

/* ---- Hot squares --------------------------------------------------------- */

/* Whether a piece passes through the square around a node, which has its left
 * and its lower side, but not the other two. */
static bool passes_through_square(const struct snapper *s,
                                  const struct piece *piece, uint32_t number) {
  const struct section_node *a = end_of(s, piece, 0), *b = end_of(s, piece, 1);
  const struct section_node *c = &s->section->node.item[number];
  if (c->u < LEAST(a->u, b->u) || c->u > MOST(a->u, b->u) ||
      c->v < LEAST(a->v, b->v) || c->v > MOST(a->v, b->v))
    return false;
  int64_t du = b->u - a->u, dv = b->v - a->v;
  int128 cross = 2 * ((int128)du * (c->v - a->v) - (int128)dv * (c->u - a->u));
  int64_t reach = (du < 0 ? -du : du) + (dv < 0 ? -dv : dv);
  if (du < 0)
    cross = -cross;
  return (cross > -reach && cross < reach) ||
         (cross == reach && (du < 0) != (dv < 0));
}

/* Orders nodes along a piece by how far they are along its longer side.  Of two
 * that are equally far it passes first the one that it passes ahead of, seen
 * along its shorter side. */
static uint64_t order_along(const struct section_node *a,
                            const struct section_node *b,
                            const struct section_node *c) {
  int64_t d[2] = {b->u - a->u, b->v - a->v};
  int64_t at[2] = {c->u - a->u, c->v - a->v};
  for (int k = 0; k < 2; k++)
    if (d[k] < 0) {
      d[k] = -d[k];
      at[k] = -at[k];
    }
  int longer = d[0] < d[1];
  bool beyond =
      (int128)at[!longer] * d[longer] > (int128)at[longer] * d[!longer];
  return 2 * (uint64_t)at[longer] + beyond;
}

static void find_hot_nodes(struct snapper *s, size_t cell, uint32_t number) {
  const struct piece *piece = &s->piece.item[number];
  for (size_t i = s->nodes.start[cell]; i < s->nodes.start[cell + 1]; i++) {
    uint32_t n = s->nodes.item[i];
    if (n == piece->a || n == piece->b || !passes_through_square(s, piece, n))
      continue;
    const struct sort_key hot = {order_along(end_of(s, piece, 0),
                                             end_of(s, piece, 1),
                                             &s->section->node.item[n]),
                                 n};
    s->failed = s->failed || !ARRAY_PUSH(&s->hot, hot);
  }
}

static bool add_to_path(struct section *section, uint32_t node, size_t start) {
  size_t count = section->path.count;
  return (count > start && section->path.item[count - 1] == node) ||
         ARRAY_PUSH(&section->path, node);
}

/* Leads every piece through the hot squares, and makes the paths of them. */
static recto_status make_section_paths(struct snapper *s, recto_error *error) {
  struct section *section = s->section;
  size_t next = 0;
  section->path.count = section->path_start.count = 0;
  for (size_t i = 0; i <= section->segment.count; i++) {
    size_t start = section->path.count;
    if (!ARRAY_PUSH(&section->path_start, (uint32_t)start))
      return error_memory(error);
    for (; next < s->piece.count && s->piece.item[next].segment == i; next++) {
      const struct piece *piece = &s->piece.item[next];
      s->hot.count = 0;
      visit_piece_cells(s, piece, find_hot_nodes, (uint32_t)next);
      bool ok = !s->failed && sort_keys_alone(s->hot.item, s->hot.count) &&
                add_to_path(section, piece->a, start);
      for (size_t k = 0; ok && k < s->hot.count; k++)
        ok = add_to_path(section, s->hot.item[k].value, start);
      if (!ok || !add_to_path(section, piece->b, start))
        return error_memory(error);
      if (section->path.count > UINT32_MAX / 2)
        return refuse_crossings(error);
      if (!poll_at(next))
        return error_cancelled(error);
    }
  }
  return RECTO_OK;
}

recto_status section_snap(struct section *section, recto_error *error) {
  struct snapper s = {.section = section};
  recto_status status = RECTO_OK;
  bool ok = collect_pieces(&s);
  if (ok && s.piece.count > 0) {
    choose_cells(&s);
    ok = fill_lists(&s, &s.pieces, put_section_pieces);
    if (ok)
      status = find_piece_crossings(&s, error);
    ok = ok &&
         (status != RECTO_OK || (add_crossing_nodes(&s) &&
                                 fill_lists(&s, &s.nodes, put_section_nodes)));
  }
  if (!ok)
    status = error_memory(error);
  if (status == RECTO_OK)
    status = make_section_paths(&s, error);
  number_lists_fini(&s.pieces);
  number_lists_fini(&s.nodes);
  ARRAY_FREE(&s.piece);
  ARRAY_FREE(&s.crossing);
  ARRAY_FREE(&s.hot);
  return status;
}
