/* sheet_sides.c - finds the sides of a sheet's triangles among its edges.
 *
 * Few drawings need them: so they are left out where triangles are made, and
 * found here by those that do.
 *
 * Where no edge has more than two triangles, it knows all of them.  Else each
 * edge is listed at that of its ends which has fewer edges.  So the hub of
 * a fan has a short list, and so have the ends of an edge that very many
 * triangles share: the lesser degrees of the ends of a planar graph's edges add
 * up to at most six times the number of edges.
 *
 * Source  [Chiba1985]. */
#include <stdatomic.h>
#include <string.h>

#include "base/parallel.h"
#include "view/sheet.h"

/* Wires and intersections are no sides. */
static bool is_face_edge(const struct sheet_edge *edge) {
  return edge->triangle[0] != SHEET_NONE && edge->source != SHEET_NONE;
}

/* ---- Edges that know their triangles ------------------------------------- */

static bool clear_sides(void *user, struct parallel_range range) {
  struct sheet *sheet = user;
  memset(&sheet->sides.item[range.begin], 0xff,
         (range.end - range.begin) * sizeof *sheet->sides.item);
  return true;
}

/* Lets the side of a triangle that has the ends of an edge be that edge. */
static void set_side_of(struct sheet *sheet, uint32_t e, uint32_t triangle) {
  const uint32_t *end = sheet->edge.item[e].point,
                 *point = sheet->triangle.item[triangle].point;
  for (int k = 0; k < 3; k++) {
    uint32_t p = point[k], q = point[geom_next_corner(k)];
    if ((p == end[0] && q == end[1]) || (p == end[1] && q == end[0]))
      sheet->sides.item[triangle].edge[k] = e;
  }
}

static bool set_sides_of_edges(void *user, struct parallel_range range) {
  struct sheet *sheet = user;
  for (size_t e = range.begin; e < range.end; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    if (!is_face_edge(edge))
      continue;
    set_side_of(sheet, (uint32_t)e, edge->triangle[0]);
    if (edge->triangle[1] != SHEET_NONE)
      set_side_of(sheet, (uint32_t)e, edge->triangle[1]);
  }
  return true;
}

static bool sides_from_edges(struct sheet *sheet) {
  size_t n = sheet->triangle.count, edges = sheet->edge.count;
  return parallel_ranges(parallel_workers(n, PARALLEL_ITEMS), n, PARALLEL_ITEMS,
                         clear_sides, sheet) &&
         parallel_ranges(parallel_workers(edges, PARALLEL_ITEMS), edges,
                         PARALLEL_ITEMS, set_sides_of_edges, sheet);
}

/* ---- Edges that are looked for ------------------------------------------- */

/* The edges of faces, listed by points. */
struct side_lists {
  struct sheet *sheet;
  uint32_t *degree; /* one a point: how many of these edges end there */
  uint32_t *head;   /* one a point: the last edge of its list, or SHEET_NONE */
  uint32_t *next;   /* one an edge */
  _Atomic uint64_t compared;
};

/* The point that lists an edge: the one with fewer edges, the lower of two with
 * as many. */
static uint32_t listing_point(const struct side_lists *lists, uint32_t p,
                              uint32_t q) {
  uint32_t of_p = lists->degree[p], of_q = lists->degree[q];
  return of_p != of_q ? (of_p < of_q ? p : q) : (p < q ? p : q);
}

static void list_face_edges(struct side_lists *lists) {
  const struct sheet *sheet = lists->sheet;
  for (size_t e = 0; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    lists->degree[edge->point[0]] += is_face_edge(edge);
    lists->degree[edge->point[1]] += is_face_edge(edge);
  }
  memset(lists->head, 0xff, sheet->point.count * sizeof *lists->head);
  for (uint32_t e = 0; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    if (!is_face_edge(edge))
      continue;
    uint32_t *head =
        &lists->head[listing_point(lists, edge->point[0], edge->point[1])];
    lists->next[e] = *head;
    *head = e;
  }
}

/* The edge between two points, or SHEET_NONE; counts the others compared. */
static uint32_t find_side(const struct side_lists *lists, uint32_t p,
                          uint32_t q, uint64_t *compared) {
  uint32_t e = lists->head[listing_point(lists, p, q)];
  for (; e != SHEET_NONE; e = lists->next[e], ++*compared) {
    const uint32_t *of = lists->sheet->edge.item[e].point;
    if ((of[0] == p && of[1] == q) || (of[0] == q && of[1] == p))
      break;
  }
  return e;
}

static bool find_sides_of_range(void *user, struct parallel_range range) {
  struct side_lists *lists = user;
  const struct sheet *sheet = lists->sheet;
  uint64_t compared = 0;
  for (size_t t = range.begin; t < range.end; t++) {
    const uint32_t *p = sheet->triangle.item[t].point;
    struct sheet_sides *sides = &sheet->sides.item[t];
    for (int k = 0; k < 3; k++)
      sides->edge[k] =
          find_side(lists, p[k], p[geom_next_corner(k)], &compared);
  }
  lists->compared += compared;
  return true;
}

static bool sides_from_lists(struct sheet *sheet) {
  size_t n = sheet->triangle.count;
  struct side_lists lists = {
      .sheet = sheet,
      .degree = mem_calloc(sheet->point.count, sizeof(uint32_t)),
      .head = mem_alloc(sheet->point.count, sizeof(uint32_t)),
      .next = mem_alloc(sheet->edge.count, sizeof(uint32_t))};
  bool ok = lists.degree != NULL && lists.head != NULL && lists.next != NULL;
  if (ok) {
    list_face_edges(&lists);
    ok = parallel_ranges(parallel_workers(n, PARALLEL_ITEMS), n, PARALLEL_ITEMS,
                         find_sides_of_range, &lists);
  }
  sheet->sides_compared = lists.compared;
  mem_free(lists.degree);
  mem_free(lists.head);
  mem_free(lists.next);
  return ok;
}

bool sheet_find_sides(struct sheet *sheet) {
  size_t n = sheet->triangle.count;
  if (sheet->sides.count == n)
    return true;
  if (!ARRAY_RESERVE(&sheet->sides, n) ||
      !(sheet->edges_are_manifold ? sides_from_edges(sheet)
                                  : sides_from_lists(sheet)))
    return false;
  sheet->sides.count = n;
  return true;
}
