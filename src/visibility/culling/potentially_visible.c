/* potentially_visible.c - what culling leaves of a sheet, as a sheet of its
 * own.
 *
 * Phases
 *   1 list the triangles that are left; mark their points and edges
 *   2 list these edges, and wires that are not hidden; mark their points
 *   3 list the points
 *   4 list the contours
 *   5 number points and edges anew
 * In parallel  Ranges of triangles, edges and points first count what they
 *   leave, so that each is stored where it belongs: in the same order for any
 *   number of threads.
 */
#include "visibility/culling/potentially_visible.h"

#include <string.h>

#include "base/parallel.h"
#include "base/poll.h"
#include "base/sort.h"
#include "view/coordinate_error.h"

/* What a range of triangles, edges or points leaves. */
struct part_range {
  size_t left, before; /* before: what the ranges before it leave */
  uint8_t flags;       /* of triangles: of the culled ones after its last that
                          is left, then after the last one before it */
};

/* The numbers in the part, plus 1, of what is in it, else 0; before it is
 * numbered, 1 or EDGE_DRAWN. */
struct numbering {
  struct potentially_visible *part;
  const struct sheet *whole;
  const struct occlusion_culling *culling;
  uint32_t *point, *triangle, *edge;
  struct part_range *range;
};

enum { EDGE_DRAWN = 2 };

/* Several threads mark what others do, too. */
static void mark(uint32_t *number) {
  __atomic_store_n(number, 1, __ATOMIC_RELAXED);
}

static bool is_triangle_culled(const struct numbering *numbering,
                               uint32_t triangle) {
  return triangle != SHEET_NONE &&
         occlusion_culling_is_culled(numbering->culling, triangle);
}

typedef ARRAY(struct sort_key) inner_sides;

static struct part_range *part_range_of(const struct numbering *numbering,
                                        struct parallel_range range) {
  return &numbering->range[range.begin / PARALLEL_ITEMS];
}

static bool for_ranges(struct numbering *numbering, size_t count,
                       parallel_task *task) {
  return parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                         PARALLEL_ITEMS, task, numbering);
}

/* Counts what the ranges of `count` items leave; *left gets the sum.  Returns
 * false when memory ran out or the caller cancelled. */
static bool count_left(struct numbering *numbering, size_t count,
                       parallel_task *task, size_t *left) {
  size_t ranges = parallel_range_count(count, PARALLEL_ITEMS);
  mem_free(numbering->range);
  numbering->range = mem_calloc(ranges, sizeof *numbering->range);
  if (numbering->range == NULL || !for_ranges(numbering, count, task))
    return false;
  *left = 0;
  for (size_t r = 0; r < ranges; r++) {
    numbering->range[r].before = *left;
    *left += numbering->range[r].left;
  }
  return true;
}

/* ---- 1. Triangles -------------------------------------------------------- */

static bool count_left_triangles(void *user, struct parallel_range range) {
  const struct numbering *numbering = user;
  struct part_range *own = part_range_of(numbering, range);
  for (size_t t = range.begin; t < range.end; t++)
    if (is_triangle_culled(numbering, (uint32_t)t)) {
      own->flags |= numbering->whole->triangle_flags[t];
    } else {
      own->left++;
      own->flags = 0;
    }
  return true;
}

/* Hands the flags on from range to range: each gets those of the culled
 * triangles right before it. */
static void hand_flags_on(struct numbering *numbering) {
  size_t ranges =
      parallel_range_count(numbering->whole->triangle.count, PARALLEL_ITEMS);
  uint8_t before = 0;
  for (size_t r = 0; r < ranges; r++) {
    struct part_range *own = &numbering->range[r];
    uint8_t after = own->left > 0 ? own->flags : own->flags | before;
    own->flags = before;
    before = after;
  }
}

static bool store_left_triangles(void *user, struct parallel_range range) {
  const struct numbering *numbering = user;
  const struct sheet *whole = numbering->whole;
  const struct part_range *own = part_range_of(numbering, range);
  struct potentially_visible *part = numbering->part;
  size_t n = own->before;
  uint8_t flags = own->flags; /* of the pieces of a triangle that are left */
  for (size_t t = range.begin; t < range.end; t++) {
    flags |= whole->triangle_flags[t];
    if (is_triangle_culled(numbering, (uint32_t)t))
      continue;
    const struct sheet_triangle *triangle = &whole->triangle.item[t];
    const uint32_t *side = sheet_triangle_sides(whole, t);
    part->sheet.triangle.item[n] = *triangle;
    part->sheet.sides.item[n] = whole->sides.item[t];
    part->sheet.triangle_flags[n] =
        whole->triangle_flags[t] | (flags & SHEET_FIRST_PIECE);
    flags = 0;
    part->triangle[n] = (uint32_t)t;
    numbering->triangle[t] = (uint32_t)++n;
    for (int k = 0; k < 3; k++) {
      mark(&numbering->point[triangle->point[k]]);
      if (side[k] != SHEET_NONE)
        mark(&numbering->edge[side[k]]);
    }
  }
  return true;
}

static bool list_triangles(struct numbering *numbering) {
  struct potentially_visible *part = numbering->part;
  struct sheet *sheet = &part->sheet;
  size_t count = numbering->whole->triangle.count, left;
  if (!count_left(numbering, count, count_left_triangles, &left))
    return false;
  hand_flags_on(numbering);
  sheet->triangle_flags = mem_alloc(left, 1);
  part->triangle = mem_alloc(left, sizeof *part->triangle);
  if (!ARRAY_RESERVE(&sheet->triangle, left) ||
      !ARRAY_RESERVE(&sheet->sides, left) || sheet->triangle_flags == NULL ||
      part->triangle == NULL)
    return false;
  sheet->triangle.count = left;
  return for_ranges(numbering, count, store_left_triangles);
}

/* ---- 2. Edges ------------------------------------------------------------ */

/* Is the edge hidden, as one of a culled triangle or by its depth? */
static bool is_edge_culled(const struct numbering *numbering,
                           const struct sheet_edge *edge) {
  struct geom_segment s = sheet_ends(numbering->whole, edge->point);
  return is_triangle_culled(numbering, edge->triangle[0]) ||
         is_triangle_culled(numbering, edge->triangle[1]) ||
         occlusion_culling_hides(numbering->culling, s.p, s.q);
}

static bool count_left_edges(void *user, struct parallel_range range) {
  const struct numbering *numbering = user;
  const struct sheet *whole = numbering->whole;
  struct part_range *own = part_range_of(numbering, range);
  for (uint32_t e = (uint32_t)range.begin; e < range.end; e++) {
    if (!poll_at(e))
      return false;
    if (sheet_edge_is_drawn(whole, e) &&
        !is_edge_culled(numbering, &whole->edge.item[e]))
      numbering->edge[e] = EDGE_DRAWN;
    own->left += numbering->edge[e] != 0;
  }
  return true;
}

static bool store_left_edges(void *user, struct parallel_range range) {
  const struct numbering *numbering = user;
  struct potentially_visible *part = numbering->part;
  size_t n = part_range_of(numbering, range)->before;
  for (size_t e = range.begin; e < range.end; e++) {
    struct sheet_edge edge = numbering->whole->edge.item[e];
    if (numbering->edge[e] == 0)
      continue;
    if (numbering->edge[e] != EDGE_DRAWN)
      edge.edge_class = 0;
    for (int k = 0; k < 2; k++) {
      mark(&numbering->point[edge.point[k]]);
      if (edge.triangle[k] != SHEET_NONE) /* 0 becomes SHEET_NONE */
        edge.triangle[k] = numbering->triangle[edge.triangle[k]] - 1;
    }
    part->edge[n] = (uint32_t)e;
    part->sheet.edge.item[n] = edge;
    numbering->edge[e] = (uint32_t)++n;
  }
  return true;
}

static bool list_edges(struct numbering *numbering) {
  struct potentially_visible *part = numbering->part;
  size_t count = numbering->whole->edge.count, left;
  if (!count_left(numbering, count, count_left_edges, &left))
    return false;
  part->edge = mem_alloc(left, sizeof *part->edge);
  if (!ARRAY_RESERVE(&part->sheet.edge, left) || part->edge == NULL)
    return false;
  part->edges = part->sheet.edge.count = left;
  return for_ranges(numbering, count, store_left_edges);
}

/* ---- 3. Points ----------------------------------------------------------- */

static bool count_left_points(void *user, struct parallel_range range) {
  const struct numbering *numbering = user;
  struct part_range *own = part_range_of(numbering, range);
  for (size_t i = range.begin; i < range.end; i++)
    own->left += numbering->point[i] != 0;
  return true;
}

static bool store_left_points(void *user, struct parallel_range range) {
  const struct numbering *numbering = user;
  size_t n = part_range_of(numbering, range)->before;
  for (size_t i = range.begin; i < range.end; i++) {
    if (numbering->point[i] == 0)
      continue;
    numbering->part->sheet.point.item[n] = numbering->whole->point.item[i];
    numbering->point[i] = (uint32_t)++n;
  }
  return true;
}

static bool list_points(struct numbering *numbering) {
  struct potentially_visible *part = numbering->part;
  size_t count = numbering->whole->point.count, left;
  if (!count_left(numbering, count, count_left_points, &left) ||
      !ARRAY_RESERVE(&part->sheet.point, left))
    return false;
  part->points = part->sheet.point.count = left;
  return for_ranges(numbering, count, store_left_points);
}

/* ---- 4. Contours --------------------------------------------------------- */

static bool add_contour(struct potentially_visible *part,
                        const struct numbering *numbering, uint32_t p,
                        uint32_t q) {
  uint32_t from = numbering->point[p], to = numbering->point[q];
  struct sheet_contour contour = {{from - 1, to - 1}};
  return from == 0 || to == 0 || ARRAY_PUSH(&part->sheet.contour, contour);
}

/* Lists the sides of the triangles that are left which are no edges of the
 * sheet, by their points.  Returns false when memory ran out. */
static bool list_inner_sides(const struct potentially_visible *part,
                             const struct numbering *numbering,
                             inner_sides *sides) {
  const struct sheet_triangle *triangle = numbering->whole->triangle.item;
  bool ok = true;
  for (size_t n = 0; ok && n < part->sheet.triangle.count; n++) {
    const struct sheet_triangle *own = &triangle[part->triangle[n]];
    const uint32_t *edge =
        sheet_triangle_sides(numbering->whole, part->triangle[n]);
    ok = poll_at(n);
    for (int k = 0; ok && k < 3; k++)
      if (edge[k] == SHEET_NONE) {
        const struct sort_key side = {
            sort_pair_key(own->point[k], own->point[geom_next_corner(k)]), 0};
        ok = ARRAY_PUSH(sides, side);
      }
  }
  return ok && sort_keys_alone(sides->item, sides->count);
}

/* Lists those of them that one triangle alone has: what is beyond was culled,
 * whether the side is a diagonal or an edge that is not drawn. */
static bool list_torn_sides(struct potentially_visible *part,
                            const struct numbering *numbering) {
  inner_sides sides = {0};
  bool ok = list_inner_sides(part, numbering, &sides);
  for (size_t i = 0, past; ok && i < sides.count; i = past) {
    uint64_t key = sides.item[i].key;
    for (past = i + 1; past < sides.count && sides.item[past].key == key;)
      past++;
    ok = past == i + 2 ||
         add_contour(part, numbering, (uint32_t)(key >> 32), (uint32_t)key);
  }
  ARRAY_FREE(&sides);
  return ok;
}

/* Lists the contours of the whole sheet, and the sides beyond which a triangle
 * was culled. */
static bool list_contours(struct potentially_visible *part,
                          const struct numbering *numbering) {
  const struct sheet *whole = numbering->whole;
  bool ok = true;
  for (size_t i = 0; ok && i < whole->contour.count; i++)
    ok = poll_at(i) &&
         add_contour(part, numbering, whole->contour.item[i].point[0],
                     whole->contour.item[i].point[1]);
  for (size_t n = 0; ok && n < part->sheet.triangle.count; n++) {
    const struct sheet_triangle *own = &whole->triangle.item[part->triangle[n]];
    const uint32_t *side = sheet_triangle_sides(whole, part->triangle[n]);
    ok = poll_at(n);
    for (int k = 0; ok && k < 3; k++) {
      const uint32_t *beside =
          side[k] != SHEET_NONE ? whole->edge.item[side[k]].triangle : NULL;
      if (beside != NULL && (is_triangle_culled(numbering, beside[0]) ||
                             is_triangle_culled(numbering, beside[1])))
        ok = add_contour(part, numbering, own->point[k],
                         own->point[geom_next_corner(k)]);
    }
  }
  return ok && list_torn_sides(part, numbering);
}

/* ---- 5. Numbers ---------------------------------------------------------- */

static bool renumber_edges(void *user, struct parallel_range range) {
  const struct numbering *numbering = user;
  for (size_t e = range.begin; e < range.end; e++)
    for (int k = 0; k < 2; k++) {
      uint32_t *point = &numbering->part->sheet.edge.item[e].point[k];
      *point = numbering->point[*point] - 1;
    }
  return true;
}

static bool renumber_triangles(void *user, struct parallel_range range) {
  const struct numbering *numbering = user;
  struct sheet *sheet = &numbering->part->sheet;
  for (size_t t = range.begin; t < range.end; t++) {
    uint32_t *point = sheet->triangle.item[t].point,
             *side = sheet->sides.item[t].edge;
    for (int k = 0; k < 3; k++) {
      point[k] = numbering->point[point[k]] - 1;
      if (side[k] != SHEET_NONE)
        side[k] = numbering->edge[side[k]] - 1;
    }
  }
  return true;
}

static bool renumber(struct numbering *numbering) {
  const struct sheet *sheet = &numbering->part->sheet;
  return for_ranges(numbering, sheet->edge.count, renumber_edges) &&
         for_ranges(numbering, sheet->triangle.count, renumber_triangles);
}

/* ---- The part ------------------------------------------------------------ */

bool potentially_visible_init(struct potentially_visible *part,
                              const struct sheet *whole,
                              const struct occlusion_culling *culling) {
  struct numbering numbering = {
      .part = part,
      .whole = whole,
      .culling = culling,
      .point = mem_calloc(whole->point.count, sizeof *numbering.point),
      .triangle = mem_calloc(whole->triangle.count, sizeof *numbering.triangle),
      .edge = mem_calloc(whole->edge.count, sizeof *numbering.edge)};
  *part = (struct potentially_visible){.sheet = *whole};
  part->sheet.triangles_are_faces = false;
  part->sheet.triangle_flags = NULL;
  part->sheet.triangle_error = NULL;
  memset(&part->sheet.point, 0, sizeof part->sheet.point);
  memset(&part->sheet.triangle, 0, sizeof part->sheet.triangle);
  memset(&part->sheet.sides, 0, sizeof part->sheet.sides);
  memset(&part->sheet.edge, 0, sizeof part->sheet.edge);
  memset(&part->sheet.edge_group, 0, sizeof part->sheet.edge_group);
  memset(&part->sheet.contour, 0, sizeof part->sheet.contour);
  bool ok = numbering.point != NULL && numbering.triangle != NULL &&
            numbering.edge != NULL && list_triangles(&numbering) &&
            list_edges(&numbering) && list_points(&numbering) &&
            list_contours(part, &numbering) &&
            coordinate_error_store_all(&part->sheet) && renumber(&numbering);
  mem_free(numbering.range);
  mem_free(numbering.point);
  mem_free(numbering.triangle);
  mem_free(numbering.edge);
  return ok;
}

void potentially_visible_fini(struct potentially_visible *part) {
  /* The rest of its sheet is the whole one's. */
  ARRAY_FREE(&part->sheet.point);
  ARRAY_FREE(&part->sheet.triangle);
  ARRAY_FREE(&part->sheet.sides);
  ARRAY_FREE(&part->sheet.edge);
  ARRAY_FREE(&part->sheet.contour);
  mem_free(part->sheet.triangle_flags);
  mem_free(part->sheet.triangle_error);
  mem_free(part->triangle);
  mem_free(part->edge);
}
