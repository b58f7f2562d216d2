/* watkins_edge_table.c - Watkins' lists S and A, and the processing of a line
 * from left to right. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "visibility/watkins/pitch/watkins.h"

/* A pitch is an integer multiple of 1/256 grid unit, and a line's centre is
 * half a pitch above its lower border: all integers in 1/512 units. */
enum { DEN = 512, PITCH_DEN = DEN / 2 };

recto_status watkins_grid(struct scan_grid *grid, const struct sheet *sheet,
                          double pitch_mm, recto_error *error) {
  double height = round(sheet->camera.page_mm[1] * SHEET_UNITS_PER_MM);
  double pitch = fmin(round(pitch_mm * SHEET_UNITS_PER_MM * PITCH_DEN),
                      height * PITCH_DEN);
  double lines = ceil(height * PITCH_DEN / pitch);
  if (!(pitch >= PITCH_DEN) || lines > WATKINS_LINES_MAX)
    return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                     "a pitch of %g mm makes more than %d lines", pitch_mm,
                     WATKINS_LINES_MAX);
  *grid = (struct scan_grid){.den = DEN,
                             .x_step = DEN,
                             .y_first = -(int64_t)height * PITCH_DEN,
                             .y_step = 2 * (int64_t)pitch,
                             .columns = 0,
                             .lines = (int32_t)lines,
                             .down = true};
  return RECTO_OK;
}

/* ---- S ------------------------------------------------------------------- */

/* Sets z_error, eight times the error bound of a depth (see
 * watkins_interval.c): the depth is computed incrementally over the lines, and
 * x is off by some units in the last place of the page's coordinates. */
static void set_z_error(struct watkins_facet *facet,
                        const struct scan_grid *grid) {
  double fall =
      fabs(facet->per_x) * SHEET_XY_MAX + fabs(facet->per_line) * grid->lines;
  facet->steep = !(fall <= FACET_DEPTH_CHANGE_MAX);
  if (!facet->steep)
    fall = FACET_DEPTH_CHANGE_MAX;
  facet->z_error =
      8 * DBL_EPSILON * (grid->lines + 64) * (fall + (double)SHEET_Z_MAX);
}

static void set_facet(const struct watkins *watkins, uint32_t triangle,
                      const uint32_t *corner, uint32_t count,
                      struct watkins_facet *facet) {
  const struct sheet *sheet = watkins->sheet;
  double up;
  memset(facet, 0, sizeof *facet);
  facet->triangle = triangle;
  facet->face = sheet->triangle.item[triangle].face;
  facet_depth_range(sheet, corner, count, &facet->z_low, &facet->z_high);
  facet_slopes(sheet, &watkins->table.grid, triangle, &facet->per_x, &up);
  facet->per_line = -up;
  set_z_error(facet, &watkins->table.grid);
}

/* Scratch for the collection of edges: for each point a linked list of the
 * edges to points of higher index. */
struct edge_gathering {
  struct scan_point *point;      /* the sheet's */
  uint32_t *first;               /* one a point: an edge; WATKINS_NONE */
  ARRAY(struct facet_edge) edge; /* one for each edge of the table */
};

/* An entry of the list of a point. */
struct facet_edge {
  uint32_t to, next; /* the other point; the next edge; WATKINS_NONE */
};

/* The edge between points p < q that has that side and only one facet so far;
 * WATKINS_NONE. */
static uint32_t find_edge(const struct watkins *watkins,
                          const struct edge_gathering *g, uint32_t p,
                          uint32_t q, uint32_t side) {
  uint32_t e = g->first[p];
  while (e != WATKINS_NONE &&
         (g->edge.item[e].to != q || watkins->edge.item[e].side != side ||
          watkins->edge.item[e].facet[1] != WATKINS_NONE))
    e = g->edge.item[e].next;
  return e;
}

/* Adds an edge from sheet point p to q, with its depth along it. */
static bool new_edge(struct watkins *watkins, struct edge_gathering *g,
                     uint32_t p, uint32_t q, uint32_t side) {
  const struct geom_point *at = watkins->sheet->point.item;
  uint32_t e = (uint32_t)watkins->table.edge.count;
  const struct facet_edge link = {q, g->first[p]};
  const struct scan_edge *added;
  struct watkins_edge edge;
  double rise, above;
  if (!scan_table_add(&watkins->table, &g->point[p], &g->point[q], side))
    return false;
  added = &watkins->table.edge.item[e];
  rise = (double)(at[q].z - at[p].z) / ((double)at[q].y - at[p].y);
  above = watkins->low + (added->line + 0.5) * watkins->pitch - at[p].y;
  edge = (struct watkins_edge){
      .z = (double)at[p].z + above * rise,
      .dz = -rise * watkins->pitch,
      .lines = added->dy,
      .facet = {(uint32_t)watkins->facet.count, WATKINS_NONE},
      .side = side,
      .drawn = watkins_is_drawn_at_ends(watkins->sheet, side),
      .record = WATKINS_NONE};
  g->first[p] = e;
  return ARRAY_PUSH(&watkins->edge, edge) && ARRAY_PUSH(&g->edge, link);
}

/* Adds the side between sheet points p and q of the current facet, if it
 * crosses a line. */
static bool add_facet_side(struct watkins *watkins, struct edge_gathering *g,
                           uint32_t p, uint32_t q, uint32_t side,
                           bool *covers) {
  uint32_t low = p < q ? p : q, high = p < q ? q : p, e;
  if (g->point[p].line == g->point[q].line)
    return true;
  *covers = true;
  e = find_edge(watkins, g, low, high, side);
  if (e == WATKINS_NONE)
    return new_edge(watkins, g, low, high, side);
  watkins->edge.item[e].facet[1] = (uint32_t)watkins->facet.count;
  return true;
}

static bool add_facets(struct watkins *watkins, struct edge_gathering *g,
                       const struct facets *facets) {
  const struct sheet *sheet = watkins->sheet;
  /* Of a closed mesh three edges to two triangles. */
  size_t most = sheet->triangle.count, edges = most + most / 2;
  if (!ARRAY_RESERVE(&watkins->facet, most) ||
      !ARRAY_RESERVE(&watkins->edge, edges) ||
      !ARRAY_RESERVE(&watkins->table.edge, edges) ||
      !ARRAY_RESERVE(&g->edge, edges))
    return false;
  for (uint32_t t = 0; t < sheet->triangle.count; t++) {
    const uint32_t *corner, *side;
    struct watkins_facet facet;
    bool covers = false;
    uint32_t count;
    for (int k = 0; k < 3 && t + MEM_PREFETCH_AHEAD < most; k++) {
      uint32_t p = sheet->triangle.item[t + MEM_PREFETCH_AHEAD].point[k];
      MEM_PREFETCH(&sheet->point.item[p]);
      MEM_PREFETCH(&g->point[p]);
      MEM_PREFETCH(&g->first[p]);
    }
    if (sheet_is_edge_on(sheet, t) || facet_of(facets, t) != t)
      continue;
    count = facet_outline(facets, sheet, t, &corner, &side);
    for (uint32_t k = 0; k < count; k++)
      if (!add_facet_side(watkins, g, corner[k],
                          corner[k + 1 == count ? 0 : k + 1], side[k], &covers))
        return false;
    if (!covers)
      continue;
    set_facet(watkins, t, corner, count, &facet);
    if (!ARRAY_PUSH(&watkins->facet, facet))
      return false;
  }
  return true;
}

/* Collects the edges of all facets. */
static bool add_facet_edges(struct watkins *watkins,
                            const struct facets *facets) {
  const struct sheet *sheet = watkins->sheet;
  size_t points = sheet->point.count;
  struct edge_gathering g = {
      .point = mem_alloc(points, sizeof *g.point),
      .first = mem_alloc(points, sizeof *g.first),
  };
  bool ok = g.point != NULL && g.first != NULL;
  for (size_t i = 0; ok && i < points; i++) {
    g.point[i] = scan_point_of(&watkins->table.grid, sheet->point.item[i].x,
                               sheet->point.item[i].y);
    g.first[i] = WATKINS_NONE;
  }
  ok = ok && add_facets(watkins, &g, facets);
  mem_free(g.point);
  mem_free(g.first);
  ARRAY_FREE(&g.edge);
  return ok;
}

bool watkins_init(struct watkins *watkins, const struct sheet *sheet,
                  const struct facets *facets, const struct scan_grid *grid) {
  memset(watkins, 0, sizeof *watkins);
  watkins->sheet = sheet;
  watkins->sides = true;
  watkins->low = scan_plane_y(grid, 0);
  watkins->pitch = scan_plane_y(grid, 1) - watkins->low;
  scan_table_init(&watkins->table, grid);
  return add_facet_edges(watkins, facets) && scan_table_start(&watkins->table);
}

void watkins_fini(struct watkins *watkins) {
  scan_table_fini(&watkins->table);
  ARRAY_FREE(&watkins->edge);
  ARRAY_FREE(&watkins->facet);
  ARRAY_FREE(&watkins->covering);
  ARRAY_FREE(&watkins->depth);
  ARRAY_FREE(&watkins->stack);
  ARRAY_FREE(&watkins->span);
  ARRAY_FREE(&watkins->shown);
  for (int i = 0; i < 2; i++) {
    ARRAY_FREE(&watkins->record[i]);
    ARRAY_FREE(&watkins->order[i]);
  }
}

/* ---- A line -------------------------------------------------------------- */

double watkins_edge_depth(const struct watkins *watkins, uint32_t edge) {
  const struct watkins_edge *e = &watkins->edge.item[edge];
  return e->z + (e->lines - watkins->table.edge.item[edge].dy) * e->dz;
}

/* Toggles a facet's flag `in` at the edge, and updates H. */
static bool toggle_facet(struct watkins *watkins, uint32_t f, uint32_t edge) {
  struct watkins_facet *facet = &watkins->facet.item[f];
  size_t i = 0;
  facet->covers = !facet->covers;
  if (facet->covers) {
    facet->x = watkins->table.edge.item[edge].x;
    facet->z = watkins_edge_depth(watkins, edge);
    return ARRAY_PUSH(&watkins->covering, f);
  }
  while (watkins->covering.item[i] != f)
    i++;
  for (; i + 1 < watkins->covering.count; i++)
    watkins->covering.item[i] = watkins->covering.item[i + 1];
  watkins->covering.count--;
  return true;
}

static bool toggle_facets(struct watkins *watkins, uint32_t edge) {
  const uint32_t *facet = watkins->edge.item[edge].facet;
  return toggle_facet(watkins, facet[0], edge) &&
         (facet[1] == WATKINS_NONE || toggle_facet(watkins, facet[1], edge));
}

/* Of the edges active[first..past), which are at one x, the facet's own; else
 * the first that is an edge of the sheet, else the first. */
static uint32_t choose_edge(const struct watkins *watkins, size_t first,
                            size_t past, uint32_t facet) {
  uint32_t chosen = watkins->table.active[first];
  for (size_t i = first; i < past; i++) {
    uint32_t e = watkins->table.active[i];
    if (watkins_borders(&watkins->edge.item[e], facet))
      return e;
    if (watkins->edge.item[chosen].side == SHEET_NONE)
      chosen = e;
  }
  return chosen;
}

/* Where the edges at the same x as active[first] end. */
static size_t find_group_end(const struct scan_table *table, size_t first) {
  const struct scan_edge *edge = table->edge.item;
  size_t past = first + 1;
  while (past < table->active_count &&
         scan_edge_compare_x(&edge[table->active[first]],
                             &edge[table->active[past]], &table->grid) == 0)
    past++;
  return past;
}

/* Processes the edges active[first..past), which are at one x, and decides the
 * interval after them.
 * left   the facet visible to the left of them; WATKINS_NONE
 * right  gets the one visible to the left of the next edges
 * Returns false when memory ran out or the caller cancelled. */
static bool process_end(struct watkins *watkins, size_t first, size_t past,
                        uint32_t left, uint32_t *right) {
  const uint32_t *active = watkins->table.active;
  size_t span = watkins->span.count;
  uint32_t seen = WATKINS_NONE;
  bool drawn = false;
  for (size_t i = first; i < past; i++) {
    drawn |= watkins->edge.item[active[i]].drawn;
    if (!toggle_facets(watkins, active[i]))
      return false;
  }
  if (left != WATKINS_NONE && watkins->sides)
    watkins->span.item[span - 1].right =
        choose_edge(watkins, first, past, left);
  *right = WATKINS_NONE;
  if (watkins->covering.count > 0) {
    /* As a facet is in, there is another edge to the right. */
    if (!watkins_decide(watkins, active[first], active[past]))
      return false;
    seen = watkins->span.item[span].facet;
    if (watkins->sides)
      watkins->span.item[span].left = choose_edge(watkins, first, past, seen);
    *right = watkins->span.item[watkins->span.count - 1].facet;
  }
  return !drawn || watkins_show_ends(watkins, first, past, left, seen);
}

bool watkins_next(struct watkins *watkins, bool *more) {
  struct scan_table *table = &watkins->table;
  uint32_t seen = WATKINS_NONE;
  int parity;
  watkins->span.count = 0;
  watkins->shown.count = 0;
  *more = scan_table_next(table);
  if (!*more)
    return true;
  parity = table->line & 1;
  watkins->record[parity].count = 0;
  watkins->order[parity].count = 0;
  for (size_t i = 0, past; i < table->active_count; i = past) {
    past = find_group_end(table, i);
    if (!process_end(watkins, i, past, seen, &seen))
      return false;
  }
  return true;
}
