/* contour_creases.c - finds creases that stand alone beside smooth contours.
 *
 * The silhouette of a mesh zigzags about the contour of the surface.  Where its
 * sides bend by more than the crease angle they are creases as well, and stay
 * where silhouettes are smooth: pieces that end where the contour crosses
 * them. */
#include "visibility/contour/contour_creases.h"

#include <math.h>

#include "base/poll.h"
#include "base/union_find.h"
#include "geom/nearest.h"
#include "geom/vector.h"
#include "visibility/contour/segment_grid.h"

/* How far from the contour either end of a crease may be on the page, as a
 * share of its length. */
#define BESIDE_SHARE 0.25

struct contour_creases {
  struct sheet *sheet;
  const struct map *map;
  uint32_t first;
  struct segment_grid grid; /* of the visible contours */
  uint8_t *is_crossed; /* one a face: a visible contour passes through it */
  uint32_t *run;       /* a union-find of points over the creases beside
                          contours */
  uint8_t *is_kept;    /* one a point: another line that is seen is there, or
                          at another point of its run */
};

static bool is_seen(const struct contour_creases *c, uint32_t e) {
  return c->map->edge_state[e] != MAP_HIDDEN &&
         sheet_edge_is_drawn(c->sheet, e);
}

static bool is_face_crossed(const struct contour_creases *c,
                            uint32_t triangle) {
  return c->is_crossed[c->sheet->triangle.item[triangle].face] != 0;
}

/* On which side of an edge on the page a triangle is: a sign. */
static int side_of_triangle(const struct contour_creases *c,
                            const struct sheet_edge *edge, uint32_t triangle) {
  const uint32_t *corner = c->sheet->triangle.item[triangle].point;
  struct geom_triangle t = sheet_corners(c->sheet, triangle);
  struct geom_segment s = sheet_ends(c->sheet, edge->point);
  int64_t side = 0;
  for (int k = 0; k < 3; k++)
    if (corner[k] != edge->point[0] && corner[k] != edge->point[1])
      side = geom_orient2d(s.p, s.q, t.p[k]);
  return (side > 0) - (side < 0);
}

static double distance_to_segment(const struct page_segment *s,
                                  struct geom_point p) {
  double x = (double)s->q.x - s->p.x, y = (double)s->q.y - s->p.y;
  double px = (double)p.x - s->p.x, py = (double)p.y - s->p.y;
  double t = geom_nearest_parameter(x, y, px, py);
  return vector2_length(px - t * x, py - t * y);
}

/* Whether a visible contour is within reach of a point of the page. */
static bool is_near_contour(const struct contour_creases *c,
                            struct geom_point p, double reach) {
  struct segment_walk walk = segment_grid_near(&c->grid, p.x, p.y, reach);
  const struct page_segment *s;
  while ((s = segment_walk_next(&walk)) != NULL)
    if (distance_to_segment(s, p) <= reach)
      return true;
  return false;
}

static bool are_ends_near(const struct contour_creases *c,
                          const struct sheet_edge *edge) {
  struct geom_segment s = sheet_ends(c->sheet, edge->point);
  double reach = BESIDE_SHARE *
                 vector2_length((double)s.q.x - s.p.x, (double)s.q.y - s.p.y);
  return is_near_contour(c, s.p, reach) && is_near_contour(c, s.q, reach);
}

/* Whether an edge is a crease that is seen, a silhouette of the mesh, as both
 * of its faces are on one side of it, and beside a contour over its length. */
static bool is_beside_contour(const struct contour_creases *c, uint32_t e) {
  const struct sheet_edge *edge = &c->sheet->edge.item[e];
  const uint32_t *t = edge->triangle;
  return edge->edge_class == RECTO_EDGE_CREASE && is_seen(c, e) &&
         t[0] != SHEET_NONE && t[1] != SHEET_NONE &&
         (is_face_crossed(c, t[0]) || is_face_crossed(c, t[1])) &&
         side_of_triangle(c, edge, t[0]) * side_of_triangle(c, edge, t[1]) >
             0 &&
         are_ends_near(c, edge);
}

/* Lists the visible contours, and marks the faces that they pass through. */
static bool list_seen_contours(struct contour_creases *c) {
  for (uint32_t e = c->first; e < c->sheet->edge.count; e++) {
    const struct sheet_edge *edge = &c->sheet->edge.item[e];
    if (!poll_at(e))
      return false;
    if (edge->triangle[0] == SHEET_NONE || !is_seen(c, e))
      continue;
    c->is_crossed[c->sheet->triangle.item[edge->triangle[0]].face] = 1;
    if (!segment_grid_add(&c->grid, sheet_ends(c->sheet, edge->point), e))
      return false;
  }
  c->grid.contours = c->grid.segment.count;
  return c->grid.contours == 0 || segment_grid_make(&c->grid);
}

/* Finds the runs of creases beside contours, and which of them other lines
 * continue. */
static bool find_runs(struct contour_creases *c) {
  for (uint32_t e = 0; e < c->first; e++) {
    const uint32_t *point = c->sheet->edge.item[e].point;
    if (!poll_at(e))
      return false;
    if (is_beside_contour(c, e))
      union_find_join(c->run, point[0], point[1]);
    else if (is_seen(c, e))
      c->is_kept[point[0]] = c->is_kept[point[1]] = 1;
  }
  for (uint32_t p = 0; p < c->sheet->point.count && poll_at(p); p++)
    if (c->is_kept[p])
      c->is_kept[union_find_root(c->run, p)] = 1;
  return poll_now();
}

static bool drop_unjoined(struct contour_creases *c) {
  for (uint32_t e = 0; e < c->first && poll_at(e); e++) {
    struct sheet_edge *edge = &c->sheet->edge.item[e];
    if (is_beside_contour(c, e) &&
        !c->is_kept[union_find_root(c->run, edge->point[0])])
      edge->edge_class = 0;
  }
  return poll_now();
}

bool contour_creases_leave_out(struct sheet *sheet, const struct map *map,
                               uint32_t first) {
  struct contour_creases c = {.sheet = sheet,
                              .map = map,
                              .first = first,
                              .is_crossed =
                                  mem_calloc(scene_face_count(sheet->scene), 1),
                              .run = union_find_create(sheet->point.count),
                              .is_kept = mem_calloc(sheet->point.count, 1)};
  bool ok = c.is_crossed != NULL && c.run != NULL && c.is_kept != NULL &&
            list_seen_contours(&c) &&
            (c.grid.contours == 0 || (find_runs(&c) && drop_unjoined(&c)));
  segment_grid_fini(&c.grid);
  mem_free(c.is_crossed);
  mem_free(c.run);
  mem_free(c.is_kept);
  return ok;
}
