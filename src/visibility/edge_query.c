/* edge_query.c - what hides an edge, by lists of triangles by page tiles. */
#include "visibility/edge_query.h"

#include <string.h>

#include "visibility/crowd.h"

bool edge_query_init(struct edge_query *query, const struct sheet *sheet,
                     const struct tilelist *lists) {
  memset(query, 0, sizeof *query);
  query->sheet = sheet;
  query->lists = lists;
  return pagegrid_query_init(&query->found, &lists->grid);
}

void edge_query_fini(struct edge_query *query) {
  strokes_fini(&query->strokes);
  pagegrid_query_fini(&query->found);
}

static struct geom_point point_of_edge(const struct edge_query *query,
                                       struct ratio t) {
  return (struct geom_point){(int32_t)ratio_lerp(t, query->p.x, query->q.x),
                             (int32_t)ratio_lerp(t, query->p.y, query->q.y),
                             ratio_lerp(t, query->p.z, query->q.z)};
}

/* Asks no more about what is hidden at the ends of the edge, where that makes
 * it much shorter.  The new ends were rounded, by less than a unit. */
static void shorten(struct edge_query *query) {
  struct hidden_part rest = strokes_rest(&query->strokes);
  double share;
  if (rest.from.num == query->rest.from.num &&
      rest.to.num == query->rest.to.num)
    return; /* the same place, or one that shortens by nothing much */
  query->rest = rest;
  share = ratio_to_double(rest.to) - ratio_to_double(rest.from);
  if (!(share < 0.75 * query->share))
    return;
  query->share = share;
  query->end[0] = point_of_edge(query, rest.from);
  query->end[1] = point_of_edge(query, rest.to);
  query->octagon = octagon_of_point(query->end[0]);
  octagon_add(&query->octagon, query->end[1]);
  for (int k = 0; k < 4; k++) {
    query->octagon.least[k] -= 2;
    query->octagon.most[k] += 2;
  }
  query->octagon.low--;
}

/* What triangle t hides of the edge. */
static bool ask_hider(struct edge_query *query, uint32_t t,
                      struct hidden_part *part) {
  const struct hider *hider = query->lists->hider;
  if (hider == NULL)
    return hide_edge_by(query->sheet, t, query->p, query->q, part,
                        &query->counts);
  return !(query->sheet->triangle_flags[t] & SHEET_FLAT) &&
         hide_edge(&hider[t], query->p, query->q, part, &query->counts);
}

/* Asks triangle t, which may meet the edge. */
static bool ask_triangle(struct edge_query *query, uint32_t t) {
  struct hidden_part part;
  if (t == query->triangle[0] || t == query->triangle[1] ||
      (query->several && !pagegrid_query_first(&query->found, t)) ||
      !ask_hider(query, t, &part))
    return true;
  if (!strokes_hide(&query->strokes, part))
    return false;
  if (part.sides == HIDE_BOTH && !query->strokes.whole)
    shorten(query);
  return true;
}

/* The cell at hand, and the question that the edge is there. */
struct cell_query {
  size_t cell;
  struct octagon_frame frame;
  uint64_t question;
  double share; /* of the edge when the question was put */
};

static void put_question(struct cell_query *at,
                         const struct edge_query *query) {
  if (at->share == query->share)
    return;
  at->share = query->share;
  at->question = octagon_question(&at->frame, &query->octagon);
}

/* Asks the triangles of a tile's list that was parted. */
static bool ask_crowd(struct edge_query *query, struct cell_query *at) {
  const struct pagegrid *grid = &query->lists->grid;
  struct crowd_shape shape = {.kind = CROWD_SEGMENT,
                              .p = {query->end[0], query->end[1]}};
  struct crowd_walk walk = crowd_walk_from(pagegrid_crowd(grid, at->cell));
  const uint64_t *word = query->lists->word + grid->start[at->cell];
  const struct crowd_node *node;
  while ((node = crowd_next(grid->crowd, &walk, &shape)) != NULL) {
    const struct crowd_member *member = grid->crowd->member.item + node->from;
    for (uint32_t i = 0; i < node->count; i++) {
      if (!octagon_meets(word[member[i].place], at->question))
        continue;
      if (!ask_triangle(query, member[i].triangle))
        return false;
      if (query->strokes.whole)
        return true;
      put_question(at, query);
    }
    shape.p[0] = query->end[0];
    shape.p[1] = query->end[1];
  }
  return true;
}

/* Asks the triangles listed in a tile that may meet the edge. */
static bool ask_list(struct edge_query *query, int x, int y) {
  const struct tilelist *list = query->lists;
  size_t cell = (size_t)y * (size_t)list->grid.columns + (size_t)x;
  uint32_t i = list->grid.start[cell], end = list->grid.start[cell + 1];
  struct cell_query at = {.cell = cell, .share = -1};
  if (i == end)
    return true;
  at.frame = tilelist_frame(list, x, y);
  put_question(&at, query);
  if (pagegrid_crowd(&list->grid, cell) != SHEET_NONE)
    return ask_crowd(query, &at);
  for (;; i++) {
    while (i < end && !octagon_meets(list->word[i], at.question))
      i++;
    if (i == end || query->strokes.whole)
      return true;
    if (!ask_triangle(query, list->grid.item[i]))
      return false;
    put_question(&at, query);
  }
}

bool edge_query_solve(struct edge_query *query, uint32_t e) {
  const struct pagegrid *grid = &query->lists->grid;
  const struct sheet_edge *edge = &query->sheet->edge.item[e];
  struct cell_range r;
  query->triangle[0] = edge->triangle[0];
  query->triangle[1] = edge->triangle[1];
  query->p = query->sheet->point.item[edge->point[0]];
  query->q = query->sheet->point.item[edge->point[1]];
  query->octagon = octagon_of_point(query->p);
  octagon_add(&query->octagon, query->q);
  r = pagegrid_cells(grid, page_box_of_segment(query->p, query->q));
  query->several = r.x0 < r.x1 || r.y0 < r.y1;
  if (query->several)
    pagegrid_query_start(grid, &query->found);
  strokes_start(&query->strokes);
  query->rest = strokes_rest(&query->strokes);
  query->share = 1;
  query->end[0] = query->p;
  query->end[1] = query->q;
  for (int y = r.y0; y <= r.y1; y++) {
    int x0, x1;
    pagegrid_row(grid, query->p, query->q, r, y, &x0, &x1);
    for (int x = x0; x <= x1; x++)
      if (!ask_list(query, x, y))
        return false;
  }
  return true;
}
