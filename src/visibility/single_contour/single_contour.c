/* single_contour.c - sheets of which one outline tells that nothing asked for is
 * hidden.
 *
 * Phases
 *   1 doubt     what surely lies in several layers is not looked at further
 *   2 walk      the contours: one loop, every point of it on two of them
 *   3 see       the loop from its middle: it turns round it just once, always
 *               onwards, so it is simple
 *   4 compare   the drawn edges with the loop, or the areas
 *
 * Where intersections are drawn, edges that run along each other as near as
 * two lines that count as one may be among them (intersection.h).  Of one layer no
 * two do where every triangle is higher than that and the loop has long sides
 * and next to no dents: about each point there is a star of triangles, wider
 * than that, which no other edge enters; and to come back to itself from
 * outside the loop would have to turn, within less than its sides are long.
 */
#include "visibility/single_contour/single_contour.h"

#include <string.h>

#include "base/sort.h"
#include "visibility/index/bsp_plane.h"
#include "visibility/fragments/fragments.h"
#include "visibility/predicate/edge_intervals.h"

enum {
  SAMPLE = 1024,    /* triangles by which layers are counted first */
  SIDE_LEAST = 1024 /* units: sides so long are longer than a dent is deep */
};

/* So many layers, by a sample, are no single one. */
static const double LAYERS_MOST = 1.25;

struct loop {
  uint32_t *point;      /* sheet points, counter-clockwise */
  struct sort_key *key; /* these, ascending, with their places in the loop */
  size_t count;
  int128 area2;
};

static void loop_fini(struct loop *loop) {
  mem_free(loop->point);
  mem_free(loop->key);
}

/* ---- 1. Doubt ------------------------------------------------------------ */

static int64_t area2_of(const struct sheet *sheet, size_t t) {
  const uint32_t *p = sheet->triangle.item[t].point;
  return geom_orient2d(sheet->point.item[p[0]], sheet->point.item[p[1]],
                       sheet->point.item[p[2]]);
}

/* May the faces lie in one layer, by some of them? */
static bool may_be_one_layer(const struct sheet *sheet) {
  size_t n = sheet->triangle.count, stride = n / SAMPLE + 1, asked = 0;
  double x0 = INT32_MAX, y0 = INT32_MAX, x1 = INT32_MIN, y1 = INT32_MIN;
  double area = 0;
  for (size_t t = 0; t < n; t += stride, asked++) {
    struct box2 box = box2_of_triangle(sheet, (uint32_t)t);
    x0 = box.x0 < x0 ? box.x0 : x0;
    y0 = box.y0 < y0 ? box.y0 : y0;
    x1 = box.x1 > x1 ? box.x1 : x1;
    y1 = box.y1 > y1 ? box.y1 : y1;
    area += 0.5 * (double)area2_of(sheet, t);
  }
  return asked > 0 && area / (double)asked * (double)n <=
                          LAYERS_MOST * (x1 - x0) * (y1 - y0);
}

/* ---- 2. Walk ------------------------------------------------------------- */

/* The ends of all contours by their points: end k of contour i is 2 i + k.
 * False where not every point has two. */
static bool pair_ends(const struct sheet *sheet, struct sort_key *key) {
  size_t n = 2 * sheet->contour.count;
  for (size_t i = 0; i < n; i++)
    key[i] =
        (struct sort_key){sheet->contour.item[i / 2].point[i % 2], (uint32_t)i};
  sort_keys(key, key + n, n);
  for (size_t i = 0; i < n; i += 2)
    if (key[i].key != key[i + 1].key || (i > 0 && key[i].key == key[i - 1].key))
      return false;
  return true;
}

/* Walks the contours from end to end; false where they are not one loop. */
static bool walk(const struct sheet *sheet, struct loop *loop) {
  size_t n = sheet->contour.count;
  struct sort_key *key = mem_alloc(4 * n, sizeof *key);
  uint32_t *mate = mem_alloc(2 * n, sizeof *mate), end = 0;
  bool ok = key != NULL && mate != NULL && pair_ends(sheet, key);
  for (size_t i = 0; ok && i < 2 * n; i++)
    mate[key[i].value] = key[i ^ 1].value;
  loop->count = 0;
  while (ok && loop->count < n && (loop->count == 0 || end != 0)) {
    loop->point[loop->count++] = sheet->contour.item[end / 2].point[end % 2];
    end = mate[end ^ 1];
  }
  mem_free(key);
  mem_free(mate);
  return ok && loop->count == n && end == 0;
}

/* ---- 3. See -------------------------------------------------------------- */

static struct geom_point corner_of(const struct sheet *sheet,
                                   const struct loop *loop, size_t i) {
  return sheet->point.item[loop->point[i < loop->count ? i : i - loop->count]];
}

static struct geom_point middle_of(const struct sheet *sheet,
                                   const struct loop *loop) {
  int64_t x = 0, y = 0, n = (int64_t)loop->count;
  for (size_t i = 0; i < loop->count; i++) {
    x += sheet->point.item[loop->point[i]].x;
    y += sheet->point.item[loop->point[i]].y;
  }
  return (struct geom_point){(int32_t)(x / n), (int32_t)(y / n), 0};
}

static void turn_round(struct loop *loop) {
  for (size_t i = 0, j = loop->count - 1; i < j; i++, j--) {
    uint32_t swap = loop->point[i];
    loop->point[i] = loop->point[j];
    loop->point[j] = swap;
  }
}

/* Is the loop simple, as seen from its middle?  Its area. */
static bool see(const struct sheet *sheet, struct loop *loop) {
  struct geom_point middle = middle_of(sheet, loop);
  int turns = 0;
  if (geom_orient2d(middle, corner_of(sheet, loop, 0),
                    corner_of(sheet, loop, 1)) < 0)
    turn_round(loop);
  loop->area2 = 0;
  for (size_t i = 0; i < loop->count; i++) {
    struct geom_point p = corner_of(sheet, loop, i),
                      q = corner_of(sheet, loop, i + 1);
    int64_t area2 = geom_orient2d(middle, p, q);
    if (area2 <= 0)
      return false;
    loop->area2 += area2;
    turns += p.y <= middle.y && q.y > middle.y;
  }
  return turns == 1;
}

/* ---- 4. Compare ---------------------------------------------------------- */

/* A bound of what is within BSP_PLANE_MARGIN of a line, as an area. */
static int64_t near_line(struct geom_point p, struct geom_point q) {
  int64_t dx = (int64_t)q.x - p.x, dy = (int64_t)q.y - p.y;
  return BSP_PLANE_MARGIN * ((dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy));
}

/* Has the loop long sides, and next to no dents? */
static bool is_even(const struct sheet *sheet, const struct loop *loop) {
  for (size_t i = 0; i < loop->count; i++) {
    struct geom_point p = corner_of(sheet, loop, i),
                      q = corner_of(sheet, loop, i + 1),
                      r = corner_of(sheet, loop, i + 2);
    if (near_line(p, q) < (int64_t)BSP_PLANE_MARGIN * SIDE_LEAST ||
        geom_orient2d(p, q, r) < -near_line(p, q))
      return false;
  }
  return true;
}

/* Is the triangle higher over each side than what counts as one line? */
static bool is_high(const struct sheet *sheet, size_t t, int64_t area2) {
  const uint32_t *p = sheet->triangle.item[t].point;
  for (int k = 0; k < 3; k++)
    if (area2 <= near_line(sheet->point.item[p[k]],
                           sheet->point.item[p[k == 2 ? 0 : k + 1]]))
      return false;
  return true;
}

/* Does just one face lie over every point within the loop?
 * apart  and does no edge run along another? */
static bool is_one_layer(const struct sheet *sheet, const struct loop *loop,
                         bool apart) {
  int128 left = loop->area2;
  if (apart && !is_even(sheet, loop))
    return false;
  for (size_t t = 0; t < sheet->triangle.count && left >= 0; t++) {
    int64_t area2 = area2_of(sheet, t);
    if (area2 <= 0 || (apart && !is_high(sheet, t, area2)))
      return false;
    left -= area2;
  }
  return left == 0;
}

/* The place of a point in the loop; its count: none. */
static size_t find_place(const struct loop *loop, uint32_t point) {
  size_t low = 0, high = loop->count;
  while (low < high) {
    size_t middle = (low + high) / 2;
    if (loop->key[middle].key < point)
      low = middle + 1;
    else
      high = middle;
  }
  return low < loop->count && loop->key[low].key == point ? loop->key[low].value
                                                          : loop->count;
}

/* Are all drawn edges sides of the loop? */
static bool has_drawn_edges(const struct sheet *sheet, struct loop *loop) {
  size_t n = loop->count;
  for (size_t i = 0; i < n; i++)
    loop->key[i] = (struct sort_key){loop->point[i], (uint32_t)i};
  sort_keys(loop->key, loop->key + n, n);
  for (size_t e = 0; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    size_t i, j;
    if (edge->edge_class == 0)
      continue;
    i = find_place(loop, edge->point[0]);
    j = find_place(loop, edge->point[1]);
    if (i == n || j == n || ((i + 1) % n != j && (j + 1) % n != i))
      return false;
  }
  return true;
}

static bool has_wires(const struct sheet *sheet) {
  size_t n = sheet->edge.count;
  for (size_t e = 0; e < n; e++)
    if (sheet->edge.item[e].edge_class != 0 &&
        sheet->edge.item[e].triangle[0] == SHEET_NONE)
      return true;
  return false;
}

bool single_contour_suffices(const struct sheet *sheet,
                             const struct solver_request *request) {
  struct loop loop = {0};
  size_t n = sheet->contour.count;
  bool lines = !request->fragments && !request->intersections;
  bool layer = may_be_one_layer(sheet) && !has_wires(sheet), told = false;
  if (n < 3 || sheet->clipped_near > 0 || sheet->clipped_page > 0 ||
      !(lines || layer))
    return false;
  loop.point = mem_alloc(n, sizeof *loop.point);
  loop.key = mem_alloc(2 * n, sizeof *loop.key);
  if (loop.point != NULL && loop.key != NULL && walk(sheet, &loop) &&
      see(sheet, &loop))
    told = (lines && has_drawn_edges(sheet, &loop)) ||
           (layer && is_one_layer(sheet, &loop, request->intersections));
  loop_fini(&loop);
  return told;
}

/* ---- The solver ---------------------------------------------------------- */

static bool show_edges(const struct sheet *sheet, struct map *map) {
  if (!edge_intervals_open_map(map, sheet->edge.count))
    return false;
  for (size_t e = 0; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    struct geom_point p = sheet->point.item[edge->point[0]],
                      q = sheet->point.item[edge->point[1]];
    if (edge->edge_class != 0 && (p.x != q.x || p.y != q.y))
      map->edge_state[e] = MAP_VISIBLE;
  }
  return true;
}

static bool show_faces(const struct sheet *sheet, bool exact_corners,
                       struct map *map, struct report *report) {
  struct fragments fragments;
  struct triangle_grid grid;
  bool ok;
  if (!triangle_grid_init(&grid, sheet))
    return false;
  ok = fragments_init(&fragments, sheet, &grid, true);
  fragments.report = report;
  for (size_t t = 0; ok && t < sheet->triangle.count; t++)
    ok = fragments_add_without_contact(&fragments, (uint32_t)t);
  ok = ok && fragments_finish(&fragments, exact_corners, map);
  fragments_fini(&fragments);
  triangle_grid_fini(&grid);
  return ok;
}

static recto_status solve(struct sheet *sheet,
                          const struct solver_request *request, struct map *map,
                          struct report *report, recto_error *error) {
  if ((request->strokes && !show_edges(sheet, map)) ||
      (request->fragments &&
       !show_faces(sheet, request->exact_corners, map, report)))
    return error_memory(error);
  return RECTO_OK;
}

const struct solver solver_single_contour = {RECTO_METHOD_AUTO, "outline", true,
                                             solve};
