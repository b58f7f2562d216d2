/* common_corners.c - the corners that all triangles of a set share, and the
 * sectors of the page about these in which the triangles lie. */
#include "visibility/index/common_corners.h"

#include <stdlib.h>

static bool is_corner(const struct geom_triangle *corners,
                      struct geom_point p) {
  return geom_same_point(corners->p[0], p) ||
         geom_same_point(corners->p[1], p) || geom_same_point(corners->p[2], p);
}

struct common_corners common_corners_of(const struct sheet *sheet,
                                        const uint32_t *triangle,
                                        size_t count) {
  struct common_corners common = {.count = 0};
  size_t i = 0;
  while (i < count && sheet_is_edge_on(sheet, triangle[i]))
    i++;
  if (i == count)
    return common;
  struct geom_triangle corners = sheet_corners(sheet, triangle[i]);
  for (common.count = 0; common.count < 3; common.count++)
    common.p[common.count] = corners.p[common.count];
  for (; i < count && common.count > 0; i++) {
    int kept = 0;
    if (sheet_is_edge_on(sheet, triangle[i]))
      continue;
    corners = sheet_corners(sheet, triangle[i]);
    for (int k = 0; k < common.count; k++)
      if (is_corner(&corners, common.p[k]))
        common.p[kept++] = common.p[k];
    common.count = kept;
  }
  return common;
}

/* The turn from the vertex through `ray` to p: positive where p is to the left
 * of the ray. */
#define TURN(sector, ray, p)                                                   \
  geom_orient2d(                                                               \
      (struct geom_point){(sector)->vertex.x, (sector)->vertex.y, 0},          \
      (struct geom_point){(sector)->ray.x, (sector)->ray.y, 0}, p)

/* Is p at the vertex? */
static bool is_at_vertex(const struct page_sector *sector,
                         struct geom_point p) {
  return p.x == sector->vertex.x && p.y == sector->vertex.y;
}

/* Opens the sector to contain p, which is not at the vertex. */
static void open_sector(struct page_sector *sector, struct geom_point p) {
  if (is_at_vertex(sector,
                   (struct geom_point){sector->right.x, sector->right.y, 0})) {
    sector->right.x = sector->left.x = p.x;
    sector->right.y = sector->left.y = p.y;
  } else if (TURN(sector, right, p) < 0) {
    sector->right.x = p.x;
    sector->right.y = p.y;
  } else if (TURN(sector, left, p) > 0) {
    sector->left.x = p.x;
    sector->left.y = p.y;
  }
}

bool page_sector_of(const struct sheet *sheet, const uint32_t *triangle,
                    size_t count, struct geom_point vertex,
                    struct page_sector *sector) {
  *sector = (struct page_sector){
      {vertex.x, vertex.y}, {vertex.x, vertex.y}, {vertex.x, vertex.y}};
  for (int pass = 0; pass < 2; pass++) {
    for (size_t i = 0; i < count; i++) {
      struct geom_triangle corners = sheet_corners(sheet, triangle[i]);
      if (sheet_is_edge_on(sheet, triangle[i]))
        continue;
      for (int k = 0; k < 3; k++) {
        struct geom_point p = corners.p[k];
        if (is_at_vertex(sector, p))
          continue;
        if (pass == 0)
          open_sector(sector, p);
        else if (TURN(sector, right, p) < 0 || TURN(sector, left, p) > 0)
          return false;
      }
    }
  }
  return TURN(sector, right,
              ((struct geom_point){sector->left.x, sector->left.y, 0})) > 0;
}

/* Are both ends beyond a ray, or one of them at the vertex? */
static bool is_beyond(int64_t turn_p, int64_t turn_q, bool p_at_vertex,
                      bool q_at_vertex, int64_t margin) {
  return (turn_p > margin || p_at_vertex) && (turn_q > margin || q_at_vertex) &&
         !(p_at_vertex && q_at_vertex);
}

/* The margin of a ray for coordinates that are off. */
#define MARGIN(sector, ray, off)                                               \
  ((off) * (llabs((int64_t)(sector)->ray.x - (sector)->vertex.x) +             \
            llabs((int64_t)(sector)->ray.y - (sector)->vertex.y)))

bool page_sector_excludes(const struct page_sector *sector,
                          const struct geom_point end[2], int64_t off) {
  bool p_at = is_at_vertex(sector, end[0]), q_at = is_at_vertex(sector, end[1]);
  return is_beyond(-TURN(sector, right, end[0]), -TURN(sector, right, end[1]),
                   p_at, q_at, MARGIN(sector, right, off)) ||
         is_beyond(TURN(sector, left, end[0]), TURN(sector, left, end[1]), p_at,
                   q_at, MARGIN(sector, left, off));
}
