/* box2.h - axis-aligned bounding boxes of edges and triangles on the page. */
#ifndef VISIBILITY_PREDICATE_BOX2_H
#define VISIBILITY_PREDICATE_BOX2_H

#include "view/sheet.h"

/* A closed axis-aligned rectangle of the page: a bounding box, or one of
 * Warnock's windows (window.h). */
struct box2 {
  int32_t x0, y0, x1, y1; /* grid units, x0 <= x1, y0 <= y1 */
};

static inline int32_t box2_min(int32_t a, int32_t b) { return a < b ? a : b; }
static inline int32_t box2_max(int32_t a, int32_t b) { return a > b ? a : b; }

static inline struct box2 box2_union(struct box2 a, struct box2 b) {
  return (struct box2){box2_min(a.x0, b.x0), box2_min(a.y0, b.y0),
                       box2_max(a.x1, b.x1), box2_max(a.y1, b.y1)};
}

static inline struct box2 box2_of_segment(struct geom_point p,
                                          struct geom_point q) {
  return (struct box2){box2_min(p.x, q.x), box2_min(p.y, q.y),
                       box2_max(p.x, q.x), box2_max(p.y, q.y)};
}

static inline struct box2 box2_of_corners(const struct geom_point *a,
                                          const struct geom_point *b,
                                          const struct geom_point *c) {
  return (struct box2){box2_min(a->x, box2_min(b->x, c->x)),
                       box2_min(a->y, box2_min(b->y, c->y)),
                       box2_max(a->x, box2_max(b->x, c->x)),
                       box2_max(a->y, box2_max(b->y, c->y))};
}

static inline struct box2 box2_of_triangle(const struct sheet *sheet,
                                           uint32_t triangle) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  const struct geom_point *point = sheet->point.item;
  return box2_of_corners(&point[p[0]], &point[p[1]], &point[p[2]]);
}

/* The box of all points, those of wires too: triangles use nearly all.  Of
 * none, it is a point. */
struct box2 box2_of_sheet(const struct sheet *sheet);

/* Boxes that only touch are not disjoint. */
static inline bool box2_disjoint(struct box2 a, struct box2 b) {
  return a.x1 < b.x0 || b.x1 < a.x0 || a.y1 < b.y0 || b.y1 < a.y0;
}

/* Whether all of b lies in a. */
static inline bool box2_contains(struct box2 a, struct box2 b) {
  return a.x0 <= b.x0 && b.x1 <= a.x1 && a.y0 <= b.y0 && b.y1 <= a.y1;
}

#endif
