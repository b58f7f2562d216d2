/* doubled_contours.c - finds the parts of contours that lie beside nearer ones.
 *
 * Phases
 *   1 mark    cells along the visible edges that a nearer contour covers
 *   2 choose  the runs of such cells that are long enough
 *   3 hide    them, dividing edges where a run begins or ends
 * A contour that is itself covered covers nothing, so what is left out is no
 * farther than the bound from what stays. */
#include "visibility/contour/doubled_contours.h"

#include "base/parallel.h"
#include "base/tolerance.h"
#include "geom/nearest.h"
#include "geom/vector.h"
#include "visibility/contour/doubled_cells.h"

/* The length of a run, at least, as a multiple of the triangles' heights. */
#define RUN_HEIGHTS 8

/* ---- The edges ----------------------------------------------------------- */

/* Whether an edge goes on along the curve of the one before it. */
static bool continues(const struct doubled_contours *d, uint32_t edge) {
  return edge > d->first && doubled_share_point(d, edge - 1, edge);
}

/* Whether an edge runs against the order of the edges along its curve. */
static bool is_reversed(const struct doubled_contours *d, uint32_t edge) {
  const struct sheet_edge *e = &d->sheet->edge.item[edge];
  if (edge + 1 < d->end && doubled_share_point(d, edge, edge + 1))
    return e->point[0] == e[1].point[0] || e->point[0] == e[1].point[1];
  return continues(d, edge) &&
         (e->point[1] == e[-1].point[0] || e->point[1] == e[-1].point[1]);
}

/* Lists the cells of a visible edge, along its curve. */
static bool list_cells(struct doubled_contours *d, uint32_t edge) {
  uint32_t cells = doubled_cells_of(d, edge);
  bool reversed = is_reversed(d, edge), ok = true;
  for (uint32_t k = 0; ok && k < cells; k++) {
    struct doubled_cell made = {edge, reversed ? cells - 1 - k : k, SHEET_NONE,
                                false};
    ok = ARRAY_PUSH(&d->cell, made);
  }
  return ok;
}

/* Lists the visible edges and their cells, and measures all. */
static bool list_visible_contours(struct doubled_contours *d) {
  size_t count = d->end - d->first;
  d->along = mem_alloc(count + 1, sizeof *d->along);
  d->is_covered = mem_calloc(count, 3);
  if (d->along == NULL || d->is_covered == NULL)
    return false;
  d->is_hidden = d->is_covered + count;
  d->is_covering = d->is_hidden + count;
  d->along[0] = 0;
  for (uint32_t e = d->first; e < d->end; e++) {
    struct geom_segment s = sheet_ends(d->sheet, d->sheet->edge.item[e].point);
    d->along[e - d->first + 1] =
        d->along[e - d->first] +
        vector2_length((double)s.q.x - s.p.x, (double)s.q.y - s.p.y);
    if (d->map->edge_state[e] != MAP_HIDDEN && doubled_length(d, e) > 0 &&
        !(segment_grid_add(&d->grid, s, e) && list_cells(d, e)))
      return false;
  }
  d->grid.contours = d->grid.segment.count;
  d->grid.cell.shift = ilogb(d->beyond);
  return d->grid.contours == 0 ||
         (segment_grid_sort(&d->grid) && segment_grid_make(&d->grid));
}

/* ---- 2 Choose ------------------------------------------------------------ */

/* Whether a cell is covered by what stays.
 * strictly  by what is not covered itself */
static bool is_cell_covered(const struct doubled_contours *d,
                            const struct doubled_cell *cell, bool strictly) {
  uint32_t by = cell->covering - d->first;
  return cell->covering != SHEET_NONE && !d->is_hidden[by] &&
         !d->is_covering[cell->edge - d->first] &&
         !(strictly && d->is_covered[by]);
}

/* Whether a cell begins another curve, or a part of one, than the cell before
 * it. */
static bool starts_chain(const struct doubled_contours *d, size_t i) {
  const struct doubled_cell *cell = &d->cell.item[i];
  return i == 0 ||
         (cell[-1].edge != cell->edge &&
          (cell[-1].edge + 1 != cell->edge || !continues(d, cell->edge)));
}

/* Marks the cells of a run if it is long enough. */
static bool choose_run(struct doubled_contours *d, size_t from, size_t to,
                       bool is_whole) {
  double length = 0, heights = 0;
  for (size_t i = from; i < to; i++) {
    uint32_t edge = d->cell.item[i].edge;
    double part = doubled_length(d, edge) / doubled_cells_of(d, edge);
    length += part;
    heights += part * (double)d->height[edge - d->first];
  }
  bool chosen = is_whole || length * length >= RUN_HEIGHTS * heights;
  for (size_t i = from; chosen && i < to; i++) {
    d->cell.item[i].is_hidden = true;
    d->is_hidden[d->cell.item[i].edge - d->first] = 1;
    d->is_covering[d->cell.item[i].covering - d->first] = 1;
  }
  return chosen;
}

/* Returns whether there are such runs. */
static bool choose_runs(struct doubled_contours *d, bool strictly) {
  bool any = false;
  for (size_t start = 0, end; start < d->cell.count; start = end) {
    for (end = start + 1; end < d->cell.count && !starts_chain(d, end); end++)
      ;
    for (size_t from = start, to; from < end; from = to) {
      bool covered = is_cell_covered(d, &d->cell.item[from], strictly);
      for (to = from + 1; to < end && is_cell_covered(d, &d->cell.item[to],
                                                      strictly) == covered;
           to++)
        ;
      bool chosen =
          covered && choose_run(d, from, to, from == start && to == end);
      any = any || chosen;
    }
  }
  return any;
}

/* ---- 3 Hide -------------------------------------------------------------- */

static bool count_degrees(struct doubled_contours *d) {
  d->points = d->sheet->point.count;
  d->degree = mem_calloc(d->points, 1);
  if (d->degree == NULL)
    return false;
  for (uint32_t e = d->first; e < d->end; e++)
    for (int k = 0; d->map->edge_state[e] != MAP_HIDDEN && k < 2; k++) {
      uint8_t *degree = &d->degree[d->sheet->edge.item[e].point[k]];
      *degree = (uint8_t)(*degree + (*degree < 2));
    }
  return true;
}

static double distance_to(const struct doubled_contours *d, uint32_t point,
                          struct geom_point at) {
  struct geom_point p = d->sheet->point.item[point];
  return vector2_length((double)p.x - at.x, (double)p.y - at.y);
}

/* The point near a place at which the contour of an edge ends; SHEET_NONE. */
static uint32_t loose_end_near(const struct doubled_contours *d, uint32_t edge,
                               struct geom_point at) {
  double most = DOUBLED_CELL_LENGTH + d->beyond;
  for (int step = -1; step <= 1; step += 2)
    for (uint32_t e = edge, near = 1; near; e += (uint32_t)step) {
      near = 0;
      for (int k = 0; k < 2; k++) {
        uint32_t end = d->sheet->edge.item[e].point[k];
        bool is_near = distance_to(d, end, at) < most;
        if (is_near && end < d->points && d->degree[end] == 1)
          return end;
        near = near || is_near;
      }
      near = near && (step > 0 ? e + 1 < d->end && continues(d, e + 1)
                               : continues(d, e));
    }
  return SHEET_NONE;
}

/* The sheet's point where an edge is divided at t: the end of the contour that
 * covers it up to there, if that ends. */
static bool point_of_division(struct doubled_contours *d, struct geom_segment s,
                              double t, uint32_t covering, uint32_t *point) {
  struct geom_point at = {(int32_t)lrint(s.p.x + t * ((double)s.q.x - s.p.x)),
                          (int32_t)lrint(s.p.y + t * ((double)s.q.y - s.p.y)),
                          s.p.z + (int64_t)(t * (double)(s.q.z - s.p.z))};
  *point = loose_end_near(d, covering, at);
  if (*point != SHEET_NONE)
    return true;
  *point = (uint32_t)d->sheet->point.count;
  return ARRAY_PUSH(&d->sheet->point, at);
}

/* Divides an edge where its cells, from cell[0] on in the order of its points,
 * begin or cease to be hidden.
 * step  1 or -1, from cell to cell */
static bool divide_edge(struct doubled_contours *d,
                        const struct doubled_cell *cell, uint32_t cells,
                        int step) {
  uint32_t edge = cell->edge, from = d->sheet->edge.item[edge].point[0];
  const struct sheet_edge whole = d->sheet->edge.item[edge];
  struct geom_segment s = sheet_ends(d->sheet, whole.point);
  bool is_first = true;
  for (uint32_t k = 0; k < cells; k++) {
    const struct doubled_cell *now = cell + step * (ptrdiff_t)k;
    const struct doubled_cell *next = now + step;
    if (k + 1 < cells && next->is_hidden == now->is_hidden)
      continue;
    struct sheet_edge part = whole;
    part.point[0] = from;
    if (k + 1 < cells &&
        !point_of_division(d, s, (k + 1.0) / cells,
                           now->is_hidden ? now->covering : next->covering,
                           &part.point[1]))
      return false;
    from = part.point[1];
    uint32_t to = is_first ? edge : (uint32_t)d->sheet->edge.count;
    if (is_first)
      d->sheet->edge.item[edge] = part;
    else if (!ARRAY_PUSH(&d->sheet->edge, part))
      return false;
    is_first = false;
    d->map->edge_state[to] = now->is_hidden ? MAP_HIDDEN : MAP_VISIBLE;
    d->map->edge_count = d->sheet->edge.count;
  }
  return true;
}

/* Where a run begins or ends between two edges, the one that stays goes on from
 * the end of the contour that covers the other one, if that ends. */
static void join_beside_runs(struct doubled_contours *d) {
  for (size_t i = 1; i < d->cell.count; i++) {
    const struct doubled_cell *a = &d->cell.item[i - 1], *b = a + 1;
    if (a->edge == b->edge || a->is_hidden == b->is_hidden ||
        starts_chain(d, i))
      continue;
    const struct doubled_cell *hidden = a->is_hidden ? a : b;
    uint32_t *stays =
        d->sheet->edge.item[a->is_hidden ? b->edge : a->edge].point;
    const uint32_t *other = d->sheet->edge.item[hidden->edge].point;
    int k = stays[1] == other[0] || stays[1] == other[1];
    uint32_t end =
        loose_end_near(d, hidden->covering, d->sheet->point.item[stays[k]]);
    if (end != SHEET_NONE && end != stays[1 - k])
      stays[k] = end;
  }
}

static bool hide_runs(struct doubled_contours *d) {
  /* An edge is divided at most once between two of its cells. */
  uint8_t *state =
      mem_resize(d->map->edge_state, d->sheet->edge.count + d->cell.count, 1);
  if (state == NULL)
    return false;
  d->map->edge_state = state;
  join_beside_runs(d);
  for (size_t i = 0; i < d->cell.count;) {
    const struct doubled_cell *cell = &d->cell.item[i];
    uint32_t cells = doubled_cells_of(d, cell->edge);
    bool reversed = cell->number > 0;
    if (!divide_edge(d, reversed ? cell + cells - 1 : cell, cells,
                     reversed ? -1 : 1))
      return false;
    i += cells;
  }
  return true;
}

bool doubled_contours_hide(struct sheet *sheet, struct map *map, uint32_t first,
                           const float *height, double beyond,
                           uint64_t *compared) {
  struct doubled_contours d = {.sheet = sheet,
                               .map = map,
                               .first = first,
                               .end = (uint32_t)sheet->edge.count,
                               .height = height,
                               .beyond = beyond};
  bool ok = list_visible_contours(&d) &&
            (d.grid.contours == 0 || doubled_cells_mark(&d));
  bool any = ok && choose_runs(&d, true);
  any = (ok && choose_runs(&d, false)) || any;
  if (any)
    ok = count_degrees(&d) && hide_runs(&d);
  *compared += d.compared;
  segment_grid_fini(&d.grid);
  mem_free(d.along);
  mem_free(d.is_covered);
  mem_free(d.degree);
  ARRAY_FREE(&d.cell);
  return ok;
}
