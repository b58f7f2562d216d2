/* sheet_sides.c - finds the sides of a sheet's triangles among its edges.
 *
 * Few drawings need them: so they are left out where triangles are made, and
 * found here by those that do. */
#include <string.h>

#include "base/parallel.h"
#include "view/sheet.h"

/* The edges of faces, listed by their lower points. */
struct side_lists {
  struct sheet *sheet;
  uint32_t *head; /* one a point: the last of its edges, or SHEET_NONE */
  uint32_t *next; /* one an edge */
};

static uint32_t lower_of(const uint32_t point[2]) {
  return point[0] < point[1] ? point[0] : point[1];
}

/* Wires and intersections are no sides. */
static void list_face_edges(struct side_lists *lists) {
  const struct sheet *sheet = lists->sheet;
  memset(lists->head, 0xff, sheet->point.count * sizeof *lists->head);
  for (uint32_t e = 0; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    if (edge->triangle[0] == SHEET_NONE || edge->source == SHEET_NONE)
      continue;
    uint32_t *head = &lists->head[lower_of(edge->point)];
    lists->next[e] = *head;
    *head = e;
  }
}

static uint32_t find_side(const struct side_lists *lists, uint32_t p,
                          uint32_t q) {
  const uint32_t point[2] = {p, q};
  uint32_t e = lists->head[lower_of(point)];
  while (e != SHEET_NONE) {
    const uint32_t *of = lists->sheet->edge.item[e].point;
    if ((of[0] == p && of[1] == q) || (of[0] == q && of[1] == p))
      break;
    e = lists->next[e];
  }
  return e;
}

static bool find_sides_of_range(void *user, struct parallel_range range) {
  const struct side_lists *lists = user;
  const struct sheet *sheet = lists->sheet;
  for (size_t t = range.begin; t < range.end; t++) {
    const uint32_t *p = sheet->triangle.item[t].point;
    sheet->sides.item[t] = (struct sheet_sides){{find_side(lists, p[0], p[1]),
                                                 find_side(lists, p[1], p[2]),
                                                 find_side(lists, p[2], p[0])}};
  }
  return true;
}

bool sheet_find_sides(struct sheet *sheet) {
  size_t n = sheet->triangle.count;
  if (sheet->sides.count == n)
    return true;
  struct side_lists lists = {sheet,
                             mem_alloc(sheet->point.count, sizeof(uint32_t)),
                             mem_alloc(sheet->edge.count, sizeof(uint32_t))};
  bool ok = lists.head != NULL && lists.next != NULL &&
            ARRAY_RESERVE(&sheet->sides, n);
  if (ok) {
    list_face_edges(&lists);
    ok = parallel_ranges(parallel_workers(n, PARALLEL_ITEMS), n, PARALLEL_ITEMS,
                         find_sides_of_range, &lists);
  }
  if (ok)
    sheet->sides.count = n;
  mem_free(lists.head);
  mem_free(lists.next);
  return ok;
}
