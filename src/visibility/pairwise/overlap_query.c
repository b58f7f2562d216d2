/* overlap_query.c - finds the triangles of the candidate lists that may overlap
 * one on the page. */
#include "visibility/pairwise/overlap_query.h"

#include <string.h>

#include "visibility/index/bsp.h"

/* How many entries of a list are compared before the first is tested. */
enum { ENTRIES_AT_ONCE = 64 };

bool overlap_query_init(struct overlap_query *query, const struct sheet *sheet,
                        const struct tile_candidates *lists) {
  memset(query, 0, sizeof *query);
  query->sheet = sheet;
  query->lists = lists;
  return triangle_grid_query_init(&query->found, &lists->grid);
}

void overlap_query_fini(struct overlap_query *query) {
  triangle_grid_query_fini(&query->found);
}

/* ---- Triangles ----------------------------------------------------------- */

/* The sides of a triangle: a x + b y + c is 0 on a side, and negative on its
 * left.  Terms are below 2^62, and so is the sum. */
struct own_sides {
  int64_t a[3], b[3], c[3];
};

static struct own_sides own_sides_of(const struct geom_triangle *own) {
  struct own_sides sides;
  for (int k = 0; k < 3; k++) {
    const struct geom_point from = own->p[k], to = own->p[geom_next_corner(k)];
    sides.a[k] = (int64_t)to.y - from.y;
    sides.b[k] = (int64_t)from.x - to.x;
    sides.c[k] = -(sides.a[k] * from.x + sides.b[k] * from.y);
  }
  return sides;
}

static inline int64_t own_side_value(const struct own_sides *own, int k,
                                     const struct geom_point *p) {
  return own->a[k] * p->x + own->b[k] * p->y + own->c[k];
}

/* Are all three corners of a triangle on the right of a side of the current
 * one, or on it?  Then they do not overlap in an area.  Without jumps, as no
 * processor predicts which side it is. */
static inline bool is_beyond_own_side(const struct own_sides *own,
                                      const struct geom_point *a,
                                      const struct geom_point *b,
                                      const struct geom_point *c) {
  bool is_beyond = false;
#pragma GCC unroll 3
  for (int k = 0; k < 3; k++)
    is_beyond |= (own_side_value(own, k, a) | own_side_value(own, k, b) |
                  own_side_value(own, k, c)) >= 0;
  return is_beyond;
}

/* Adds those of some triangles that may overlap the current one and have not
 * been met yet.
 * triangle  `count` of them; scratch afterwards
 * Returns false when memory ran out. */
static bool add_overlapping_triangles(struct overlap_query *query,
                                      uint32_t *triangle, size_t count) {
  const struct sheet *sheet = query->sheet;
  const struct geom_point *point = sheet->point.item;
  const struct own_sides own = own_sides_of(&query->corners);
  size_t first = 0, n = 0;
  for (size_t i = 0; i < count; i++) {
    uint32_t t = triangle[i];
    triangle[first] = t;
    first += triangle_grid_query_first(&query->found, t);
  }
  for (size_t i = 0; i < first; i++) {
    uint32_t t = triangle[i];
    const uint32_t *p = sheet->triangle.item[t].point;
    triangle[n] = t;
    n += !is_beyond_own_side(&own, &point[p[0]], &point[p[1]], &point[p[2]]);
  }
  if (!ARRAY_RESERVE(&query->found.found, n))
    return false;
  for (size_t i = 0; i < n; i++)
    if (triangle[i] != query->triangle && !sheet_is_edge_on(sheet, triangle[i]))
      query->found.found.item[query->found.found.count++] = triangle[i];
  return true;
}

/* ---- Cells --------------------------------------------------------------- */

/* A cell's list, and what of it is searched for. */
struct list_query {
  const uint64_t *key;
  const uint32_t *item;
  uint64_t kdop_query;
  bool is_sorted; /* from near to far */
  bool behind;    /* what is behind the triangle, else what is not */
};

/* Gathers those of the entries from `from` to before `end` for which the
 * comparison has that result, without a jump for each.  Returns how many there
 * are.
 * stops  ends before the first entry that is behind the triangle
 * past   gets where it ended */
static inline size_t gather_lanes(const struct list_query *list, size_t from,
                                  size_t end, uint64_t wanted, const bool stops,
                                  size_t *past,
                                  uint32_t found[ENTRIES_AT_ONCE]) {
  const uint64_t *key = list->key, query = list->kdop_query;
  const uint32_t *item = list->item;
  size_t count = 0, i = from;
  for (; i < end; i++) {
    uint64_t lanes = kdop8_compare(key[i], query);
    if (stops && kdop8_is_behind(lanes))
      break;
    found[count] = item[i];
    count += lanes == wanted;
  }
  *past = i;
  return count;
}

/* The same for those that are searched for.
 * past  gets where entries begin that are behind the triangle, if the list is
 *       sorted and others are searched for, else `end` */
static inline size_t gather_entries(const struct list_query *list, size_t from,
                                    size_t end, size_t *past,
                                    uint32_t found[ENTRIES_AT_ONCE]) {
  if (list->behind)
    return gather_lanes(list, from, end, KDOP8_BEHIND, false, past, found);
  if (list->is_sorted)
    return gather_lanes(list, from, end, KDOP8_GUARDS, true, past, found);
  return gather_lanes(list, from, end, KDOP8_GUARDS, false, past, found);
}

/* Where the entries of a sorted list begin that are behind the triangle. */
static size_t first_behind(const struct list_query *list, size_t from,
                           size_t end) {
  while (end > from &&
         kdop8_is_behind(kdop8_compare(list->key[end - 1], list->kdop_query)))
    end--;
  return end;
}

static bool add_list(struct overlap_query *query, const struct list_query *list,
                     size_t from, size_t end) {
  uint32_t found[ENTRIES_AT_ONCE];
  if (list->behind && list->is_sorted)
    from = first_behind(list, from, end);
  for (size_t past = from; from < end; from = past) {
    size_t last = end - from > ENTRIES_AT_ONCE ? from + ENTRIES_AT_ONCE : end;
    size_t n = gather_entries(list, from, last, &past, found);
    if (!add_overlapping_triangles(query, found, n))
      return false;
    if (past < last)
      return true;
  }
  return true;
}

/* Adds the triangles of the leaves that may overlap the current one, whether
 * they are behind it or not. */
static bool add_from_bsp(struct overlap_query *query, uint32_t root) {
  const struct bsp *bsp = query->lists->grid.bsp;
  const struct bsp_query shape = {.kind = BSP_TRIANGLE,
                                  .triangle = query->triangle,
                                  .sheet = query->sheet,
                                  .box = query->box};
  struct bsp_traversal traversal = bsp_traversal_from(root);
  const struct bsp_node *node;
  while ((node = bsp_next(bsp, &traversal, &shape)) != NULL)
    for (uint32_t i = node->from; i < node->from + node->count; i++) {
      uint32_t triangle[1] = {bsp->member.item[i].triangle};
      if (!add_overlapping_triangles(query, triangle, 1))
        return false;
    }
  return true;
}

static bool add_cell(struct overlap_query *query, int x, int y, bool behind) {
  const struct tile_candidates *lists = query->lists;
  size_t cell = triangle_grid_index(&lists->grid, x, y),
         from = lists->grid.lists.start[cell],
         end = lists->grid.lists.start[cell + 1];
  uint32_t root = triangle_grid_bsp(&lists->grid, cell);
  if (from == end)
    return true;
  if (root != SHEET_NONE)
    return behind || add_from_bsp(query, root);
  struct kdop8_range range = tile_candidates_range(lists, x, y);
  const struct list_query list = {
      .key = lists->key,
      .item = lists->grid.lists.item,
      .kdop_query = kdop8_query(&range, &query->kdop),
      .is_sorted = tile_candidates_is_sorted(lists, cell),
      .behind = behind};
  return add_list(query, &list, from, end);
}

static bool add_cells_of_box(struct overlap_query *query, bool behind) {
  struct cell_range r = triangle_grid_cells(&query->lists->grid, query->box);
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++)
      if (!add_cell(query, x, y, behind))
        return false;
  return true;
}

bool overlap_query_find_nearer(struct overlap_query *query, uint32_t triangle) {
  const struct geom_point *p = query->corners.p;
  query->triangle = triangle;
  query->corners = sheet_corners(query->sheet, triangle);
  query->box = box2_of_corners(&p[0], &p[1], &p[2]);
  query->kdop = kdop8_of_point(p[0]);
  kdop8_add(&query->kdop, p[1]);
  kdop8_add(&query->kdop, p[2]);
  triangle_grid_query_start(&query->lists->grid, &query->found);
  return add_cells_of_box(query, false);
}

bool overlap_query_add_behind(struct overlap_query *query) {
  return add_cells_of_box(query, true);
}
