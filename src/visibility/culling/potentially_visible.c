/* potentially_visible.c - what culling leaves of a sheet, as a sheet of its
 * own.
 *
 * Phases
 *   1 list the triangles that are left; mark their points and edges
 *   2 list these edges, and wires that are not hidden; mark their points
 *   3 list the points
 *   4 list the contours
 *   5 number points and edges anew
 */
#include "visibility/culling/potentially_visible.h"

#include <string.h>

#include "base/poll.h"
#include "base/sort.h"
#include "view/coordinate_error.h"

/* The numbers in the part, plus 1, of what is in it, else 0; before it is
 * numbered, 1. */
struct numbering {
  const struct sheet *whole;
  const struct occlusion_culling *culling;
  uint32_t *point, *triangle, *edge;
};

static bool is_triangle_culled(const struct numbering *numbering,
                               uint32_t triangle) {
  return triangle != SHEET_NONE &&
         occlusion_culling_is_culled(numbering->culling, triangle);
}

typedef ARRAY(struct sort_key) inner_sides;

/* ---- 1. Triangles -------------------------------------------------------- */

static bool list_triangles(struct potentially_visible *part,
                           const struct numbering *numbering) {
  const struct sheet *whole = numbering->whole;
  struct sheet *sheet = &part->sheet;
  size_t left = whole->triangle.count - numbering->culling->count;
  sheet->triangle_flags = mem_alloc(left, 1);
  part->triangle = mem_alloc(left, sizeof *part->triangle);
  if (!ARRAY_RESERVE(&sheet->triangle, left) ||
      !ARRAY_RESERVE(&sheet->sides, left) || sheet->triangle_flags == NULL ||
      part->triangle == NULL)
    return false;
  uint8_t first = 0; /* of the pieces of a triangle that are left */
  for (uint32_t t = 0; t < whole->triangle.count; t++) {
    if (!poll_at(t))
      return false;
    first |= whole->triangle_flags[t] & SHEET_FIRST_PIECE;
    if (is_triangle_culled(numbering, t))
      continue;
    const struct sheet_triangle *triangle = &whole->triangle.item[t];
    size_t n = sheet->triangle.count++;
    const uint32_t *side = sheet_triangle_sides(whole, t);
    sheet->triangle.item[n] = *triangle;
    sheet->sides.item[n] = whole->sides.item[t];
    sheet->triangle_flags[n] = whole->triangle_flags[t] | first;
    first = 0;
    part->triangle[n] = t;
    numbering->triangle[t] = (uint32_t)n + 1;
    for (int k = 0; k < 3; k++) {
      numbering->point[triangle->point[k]] = 1;
      if (side[k] != SHEET_NONE)
        numbering->edge[side[k]] = 1;
    }
  }
  return true;
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

static bool list_edges(struct potentially_visible *part,
                       const struct numbering *numbering) {
  const struct sheet *whole = numbering->whole;
  ARRAY(uint32_t) number = {0};
  bool ok = true;
  for (uint32_t e = 0; ok && e < whole->edge.count; e++) {
    struct sheet_edge edge = whole->edge.item[e];
    bool drawn =
        sheet_edge_is_drawn(whole, e) && !is_edge_culled(numbering, &edge);
    ok = poll_at(e);
    if (!drawn && numbering->edge[e] == 0)
      continue;
    edge.edge_class = drawn ? edge.edge_class : 0;
    for (int k = 0; k < 2; k++) {
      numbering->point[edge.point[k]] = 1;
      if (edge.triangle[k] != SHEET_NONE) /* 0 becomes SHEET_NONE */
        edge.triangle[k] = numbering->triangle[edge.triangle[k]] - 1;
    }
    ok = ok && ARRAY_PUSH(&number, e) && ARRAY_PUSH(&part->sheet.edge, edge);
    numbering->edge[e] = (uint32_t)part->sheet.edge.count;
  }
  part->edge = number.item;
  part->edges = part->sheet.edge.count;
  return ok;
}

/* ---- 3. Points ----------------------------------------------------------- */

static bool list_points(struct potentially_visible *part,
                        const struct numbering *numbering) {
  const struct sheet *whole = numbering->whole;
  for (size_t i = 0; i < whole->point.count; i++) {
    if (!poll_at(i))
      return false;
    if (numbering->point[i] == 0)
      continue;
    if (!ARRAY_PUSH(&part->sheet.point, whole->point.item[i]))
      return false;
    numbering->point[i] = (uint32_t)part->sheet.point.count;
  }
  part->points = part->sheet.point.count;
  return true;
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

static void renumber(struct potentially_visible *part,
                     const struct numbering *numbering) {
  for (size_t e = 0; e < part->sheet.edge.count; e++)
    for (int k = 0; k < 2; k++) {
      uint32_t *point = &part->sheet.edge.item[e].point[k];
      *point = numbering->point[*point] - 1;
    }
  for (size_t t = 0; t < part->sheet.triangle.count; t++) {
    uint32_t *point = part->sheet.triangle.item[t].point,
             *side = part->sheet.sides.item[t].edge;
    for (int k = 0; k < 3; k++) {
      point[k] = numbering->point[point[k]] - 1;
      if (side[k] != SHEET_NONE)
        side[k] = numbering->edge[side[k]] - 1;
    }
  }
}

/* ---- The part ------------------------------------------------------------ */

bool potentially_visible_init(struct potentially_visible *part,
                              const struct sheet *whole,
                              const struct occlusion_culling *culling) {
  struct numbering numbering = {
      whole, culling, mem_calloc(whole->point.count, sizeof *numbering.point),
      mem_calloc(whole->triangle.count, sizeof *numbering.triangle),
      mem_calloc(whole->edge.count, sizeof *numbering.edge)};
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
            numbering.edge != NULL && list_triangles(part, &numbering) &&
            list_edges(part, &numbering) && list_points(part, &numbering) &&
            list_contours(part, &numbering) &&
            coordinate_error_store_all(&part->sheet);
  if (ok)
    renumber(part, &numbering);
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

/* ---- Back to the whole sheet --------------------------------------------- */

/* Appends the edges of intersections, and their points, to the whole sheet. */
static bool append_intersections(const struct potentially_visible *part,
                                 struct sheet *whole) {
  const struct sheet *sheet = &part->sheet;
  size_t points = sheet->point.count - part->points,
         edges = sheet->edge.count - part->edges;
  uint32_t past = (uint32_t)(whole->point.count - part->points);
  if (edges == 0)
    return true;
  if (!ARRAY_RESERVE(&whole->point, points) ||
      !ARRAY_RESERVE(&whole->edge, edges))
    return false;
  memcpy(whole->point.item + whole->point.count,
         sheet->point.item + part->points, points * sizeof *sheet->point.item);
  whole->point.count += points;
  for (size_t e = part->edges; e < sheet->edge.count; e++) {
    struct sheet_edge edge = sheet->edge.item[e];
    for (int k = 0; k < 2; k++) {
      edge.point[k] += past; /* both were added */
      edge.triangle[k] = part->triangle[edge.triangle[k]];
    }
    whole->edge.item[whole->edge.count++] = edge;
  }
  return true;
}

/* The whole sheet's number of an edge of the part.
 * past  what the intersections' numbers are greater by */
static uint32_t whole_edge_number(const struct potentially_visible *part,
                                  uint32_t edge, uint32_t past) {
  return edge < part->edges ? part->edge[edge] : edge + past;
}

bool potentially_visible_restore(struct potentially_visible *part,
                                 struct sheet *whole, struct map *map) {
  uint32_t past = (uint32_t)(whole->edge.count - part->edges);
  if (!append_intersections(part, whole))
    return false;
  if (map->edge_state != NULL) {
    uint8_t *state = mem_calloc(whole->edge.count, 1);
    if (state == NULL)
      return false;
    for (uint32_t e = 0; e < map->edge_count; e++)
      state[whole_edge_number(part, e, past)] = map->edge_state[e];
    mem_free(map->edge_state);
    map->edge_state = state;
    map->edge_count = whole->edge.count;
  }
  for (size_t i = 0; i < map->mixed.count; i++)
    map->mixed.item[i].edge =
        whole_edge_number(part, map->mixed.item[i].edge, past);
  for (size_t i = 0; i < map->corner.count; i++) {
    struct map_corner *corner = &map->corner.item[i];
    if (corner->side == MAP_SIDE_EDGE || corner->side == MAP_SIDE_OCCLUDER)
      corner->id = whole_edge_number(part, corner->id, past);
  }
  return true;
}
