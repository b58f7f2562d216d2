/* facets.c - convex planar facets: unions of triangles of one face. */
#include "visibility/scan/facets.h"

#include <string.h>

#include "base/sort.h"

/* The triangles [first, past) of one face and their diagonals. */
struct facet_joining {
  const struct sheet *sheet;
  struct facets *facets;
  uint32_t first, past;
  struct sort_key *diagonal, *scratch; /* keyed by the two points; value:
                                          3 * (triangle - first) + side */
  size_t diagonals, capacity;
  uint32_t corner[FACET_CORNERS_MAX], side[FACET_CORNERS_MAX];
  uint32_t count;
};

static uint32_t next_of(uint32_t k, uint32_t count) {
  return k + 1 == count ? 0 : k + 1;
}

static bool list_diagonals(struct facet_joining *joining) {
  const struct sheet *sheet = joining->sheet;
  size_t most = 3 * (size_t)(joining->past - joining->first);
  if (most > joining->capacity) {
    struct sort_key *grown =
        mem_resize(joining->diagonal, 2 * most, sizeof *grown);
    if (grown == NULL)
      return false;
    joining->diagonal = grown;
    joining->capacity = most;
  }
  joining->diagonals = 0;
  for (uint32_t t = joining->first; t < joining->past; t++) {
    const uint32_t *point = sheet->triangle.item[t].point,
                   *side = sheet_triangle_sides(sheet, t);
    for (uint32_t k = 0; k < 3; k++)
      if (side[k] == SHEET_NONE)
        joining->diagonal[joining->diagonals++] =
            (struct sort_key){sort_pair_key(point[k], point[next_of(k, 3)]),
                              3 * (t - joining->first) + k};
  }
  sort_keys(joining->diagonal, joining->diagonal + joining->capacity,
            joining->diagonals);
  return true;
}

/* The first diagonal not below the key. */
static size_t find_diagonal(const struct facet_joining *joining, uint64_t key) {
  size_t i;
  LOWER_BOUND(i, 0, joining->diagonals, joining->diagonal[i].key < key);
  return i;
}

static struct geom_point sheet_point(const struct facet_joining *joining,
                                     uint32_t point) {
  return joining->sheet->point.item[point];
}

static struct geom_plane plane_at(const struct facet_joining *joining,
                                  uint32_t triangle) {
  const uint32_t *p = joining->sheet->triangle.item[triangle].point;
  return geom_plane_of(sheet_point(joining, p[0]), sheet_point(joining, p[1]),
                       sheet_point(joining, p[2]));
}

static bool turns_left(const struct facet_joining *joining, uint32_t a,
                       uint32_t b, uint32_t c) {
  return geom_orient2d(sheet_point(joining, a), sheet_point(joining, b),
                       sheet_point(joining, c)) >= 0;
}

/* Is the outline still convex with `point` put in after corner k? */
static bool stays_convex(const struct facet_joining *joining, uint32_t k,
                         uint32_t point) {
  uint32_t count = joining->count;
  uint32_t u = joining->corner[k], v = joining->corner[next_of(k, count)];
  uint32_t before = joining->corner[k == 0 ? count - 1 : k - 1];
  uint32_t after = joining->corner[next_of(next_of(k, count), count)];
  return turns_left(joining, before, u, point) &&
         turns_left(joining, point, v, after);
}

/* Joins the triangle on the other side of side k, if there is one that fits:
 * free, with area, in the plane, the union convex. */
static bool join_across(struct facet_joining *joining,
                        const struct geom_plane *plane, uint32_t k) {
  const struct sheet *sheet = joining->sheet;
  uint32_t u = joining->corner[k];
  uint32_t v = joining->corner[next_of(k, joining->count)];
  uint64_t key = sort_pair_key(u, v);
  size_t i = find_diagonal(joining, key);
  for (; i < joining->diagonals && joining->diagonal[i].key == key; i++) {
    uint32_t t = joining->first + joining->diagonal[i].value / 3;
    uint32_t at = joining->diagonal[i].value % 3, past = next_of(at, 3);
    const struct sheet_triangle *other = &sheet->triangle.item[t];
    const uint32_t *side = sheet_triangle_sides(sheet, t);
    uint32_t shared_vertex = other->point[next_of(past, 3)];
    uint32_t tail = joining->count - k - 1;
    if (other->point[at] != v || joining->facets->part[t] != SHEET_NONE ||
        sheet_is_edge_on(sheet, t) ||
        geom_plane_value(plane, sheet_point(joining, shared_vertex)) != 0 ||
        !stays_convex(joining, k, shared_vertex))
      continue;
    memmove(joining->corner + k + 2, joining->corner + k + 1,
            tail * sizeof *joining->corner);
    memmove(joining->side + k + 2, joining->side + k + 1,
            tail * sizeof *joining->side);
    joining->corner[k + 1] = shared_vertex;
    joining->side[k] = side[past];
    joining->side[k + 1] = side[next_of(past, 3)];
    joining->count++;
    joining->facets->part[t] = (uint32_t)joining->facets->joined.count;
    return true;
  }
  return false;
}

/* Grows a facet from a triangle; it is stored if it has grown at all. */
static bool grow_facet(struct facet_joining *joining, uint32_t triangle) {
  struct facets *facets = joining->facets;
  const struct sheet_triangle *seed = &joining->sheet->triangle.item[triangle];
  struct geom_plane plane = plane_at(joining, triangle);
  struct facet facet = {triangle, (uint32_t)facets->corner.count, 0};
  joining->count = 3;
  memcpy(joining->corner, seed->point, sizeof seed->point);
  memcpy(joining->side, sheet_triangle_sides(joining->sheet, triangle),
         3 * sizeof *joining->side);
  facets->part[triangle] = (uint32_t)facets->joined.count;
  for (uint32_t k = 0; k < joining->count;)
    if (joining->side[k] != SHEET_NONE || joining->count == FACET_CORNERS_MAX ||
        !join_across(joining, &plane, k))
      k++;
  if (joining->count == 3) {
    facets->part[triangle] = SHEET_NONE;
    return true;
  }
  facet.count = joining->count;
  if (!ARRAY_RESERVE(&facets->corner, facet.count) ||
      !ARRAY_RESERVE(&facets->side, facet.count))
    return false;
  memcpy(facets->corner.item + facet.corner, joining->corner,
         facet.count * sizeof *joining->corner);
  memcpy(facets->side.item + facet.corner, joining->side,
         facet.count * sizeof *joining->side);
  facets->corner.count += facet.count;
  facets->side.count += facet.count;
  return ARRAY_PUSH(&facets->joined, facet);
}

static bool join_face(struct facet_joining *joining) {
  if (!list_diagonals(joining))
    return false;
  for (uint32_t t = joining->first; t < joining->past; t++)
    if (joining->facets->part[t] == SHEET_NONE &&
        !sheet_is_edge_on(joining->sheet, t) && !grow_facet(joining, t))
      return false;
  return true;
}

bool facets_init(struct facets *facets, const struct sheet *sheet) {
  struct facet_joining joining = {.sheet = sheet, .facets = facets};
  uint32_t count = (uint32_t)sheet->triangle.count, t = 0;
  const struct sheet_triangle *triangle = sheet->triangle.item;
  bool ok = true;
  memset(facets, 0, sizeof *facets);
  while (t + 1 < count && triangle[t].face != triangle[t + 1].face)
    t++;
  if (t + 1 >= count)
    return true;
  facets->part = mem_alloc(count, sizeof *facets->part);
  if (facets->part == NULL)
    return false;
  memset(facets->part, 0xff, count * sizeof *facets->part);
  for (; t < count && ok; t = joining.past) {
    joining.first = t;
    joining.past = t + 1;
    while (joining.past < count &&
           triangle[joining.past].face == triangle[t].face)
      joining.past++;
    ok = joining.past - t == 1 || join_face(&joining);
  }
  mem_free(joining.diagonal);
  if (!ok)
    facets_fini(facets);
  return ok;
}

void facets_fini(struct facets *facets) {
  ARRAY_FREE(&facets->joined);
  ARRAY_FREE(&facets->corner);
  ARRAY_FREE(&facets->side);
  mem_free(facets->part);
  facets->part = NULL;
}

/* ---- Planes -------------------------------------------------------------- */

/* Most values fit into 64 bits, whose conversion is fast. */
static double to_double(int128 value) {
  int64_t low = (int64_t)value;
  return low == value ? (double)low : (double)value;
}

void facet_slopes(const struct sheet *sheet, const struct scan_grid *grid,
                  uint32_t facet, double *per_column, double *per_line) {
  struct geom_plane plane = sheet_plane(sheet, facet);
  double scale = 1 / ((double)plane.nz * (double)grid->den);
  *per_column = -to_double(plane.nx) * (double)grid->x_step * scale;
  *per_line = -to_double(plane.ny) * (double)grid->y_step * scale;
}
