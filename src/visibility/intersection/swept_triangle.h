/* swept_triangle.h - a triangle of a list that is swept for pairs
 * (candidate_pairs.h), and whether two of them are neighbours on the mesh. */
#ifndef VISIBILITY_INTERSECTION_SWEPT_TRIANGLE_H
#define VISIBILITY_INTERSECTION_SWEPT_TRIANGLE_H

#include "visibility/predicate/box2.h"
#include "visibility/predicate/coarse_plane.h"
#include "visibility/predicate/plane_filter.h"
#include "visibility/predicate/point_lanes.h"

typedef int32_t swept_numbers __attribute__((vector_size(16)));
typedef int64_t swept_pair __attribute__((vector_size(16)));

/* A vector on the page. */
struct page_vector {
  int64_t x, y;
};

static inline struct page_vector vector_between(struct geom_point a,
                                                struct geom_point b) {
  return (struct page_vector){(int64_t)b.x - a.x, (int64_t)b.y - a.y};
}

/* What the tests use of a triangle, computed once per list, in its order; keys
 * say which comes when. */
struct swept_triangle {
  struct box2 box;
  int64_t high; /* depth of the nearest corner, or the high end of its range
                   along another direction */
  int x0, y0;   /* the cell of the box's lower left corner */
  uint32_t triangle;
  swept_numbers point[3]; /* its points: from the first one on, from the second,
                             and from the third */
  struct geom_triangle corners;
  struct page_vector side[3]; /* from each corner to the next one */
  uint64_t right_copy;        /* bsp.h */
  bool in_group;              /* it is not tested with others that are, too */
  bool has_inner_sides;       /* some side is no edge of the mesh */
  bool has_coarse_plane, has_plane; /* they have been computed */
  struct coarse_plane coarse_plane;
  struct plane_filter plane;
};

/* A box as numbers that are compared all at once, and whether the triangle is
 * listed in the cells before the current one in its row and in its column, if
 * these are selected: two that both are, are tested there. */
struct swept_box {
  swept_numbers begin[2], end[2];
};

/* low, high  the ends of the box; the complements of ends have their order
 *            reversed
 * before     -1 in lanes 0 and 1 where it is listed in such a cell; else 0 */
static inline struct swept_box swept_box_of(point_lanes low, point_lanes high,
                                            point_lanes before) {
  swept_pair from = (swept_pair)low, to = (swept_pair)high;
  return (struct swept_box){
      {(swept_numbers)(swept_pair){from[0], ~to[0]}, -before},
      {(swept_numbers)(swept_pair){to[0], ~from[0]}, 1 + before}};
}

/* Do two boxes meet, and are they not tested in a cell before? */
static inline bool swept_boxes_meet(const struct swept_box *f,
                                    const struct swept_box *g) {
  swept_pair apart =
      (swept_pair)((g->begin[0] > f->end[0]) | (g->begin[1] > f->end[1]));
  return (apart[0] | apart[1]) == 0;
}

/* Do two triangles overlap in depth?  Others are never tested, whatever the
 * direction is. */
static inline bool swept_depths_overlap(const struct swept_triangle *f,
                                        const struct swept_triangle *g) {
  int64_t f_low, f_high, g_low, g_high;
  geom_depth_range(f->corners.p, &f_low, &f_high);
  geom_depth_range(g->corners.p, &g_low, &g_high);
  return f_low <= g_high && g_low <= f_high;
}

/* The corners that two triangles share: bit 3 i + j stands for corner i of f,
 * which is corner j of g. */
static inline unsigned shared_corners(const struct swept_triangle *f,
                                      const struct swept_triangle *g) {
  const swept_numbers bits[3] = {{1 << 0, 1 << 4, 1 << 8},
                                 {1 << 1, 1 << 5, 1 << 6},
                                 {1 << 2, 1 << 3, 1 << 7}};
  const swept_numbers own = f->point[0];
  swept_pair shared = (swept_pair)(((own == g->point[0]) & bits[0]) |
                                   ((own == g->point[1]) & bits[1]) |
                                   ((own == g->point[2]) & bits[2]));
  uint64_t all = (uint64_t)(shared[0] | shared[1]);
  return (unsigned)(all | all >> 32);
}

/* The cross product of two vectors, in 63 bits. */
static inline int64_t cross_product(struct page_vector a,
                                    struct page_vector b) {
  return a.x * b.y - a.y * b.x;
}

/* Do two counter-clockwise triangles that share a corner, i of f and j of g,
 * have no other point of the page in common?  On a dense mesh nearly all such
 * pairs have none.  So it is where a side that ends in that corner separates
 * them: all of the other triangle is strictly to the right of the side that
 * begins there, or to the left of the one that ends there. */
static inline bool are_disjoint_at_corner(const struct swept_triangle *f, int i,
                                          const struct swept_triangle *g,
                                          int j) {
  const struct page_vector f_next = f->side[i], g_next = g->side[j];
  const struct page_vector f_last = f->side[i == 0 ? 2 : i - 1],
                           g_last = g->side[j == 0 ? 2 : j - 1];
  int64_t next_next = cross_product(f_next, g_next),
          next_last = -cross_product(f_next, g_last),
          last_next = -cross_product(f_last, g_next),
          last_last = cross_product(f_last, g_last);
  return (next_next & next_last) < 0 || ((last_next > 0) & (last_last > 0)) ||
         ((next_next > 0) & (last_next > 0)) || (next_last & last_last) < 0;
}

/* Is the side that triangle f shares with triangle g an edge of the mesh? */
static inline bool is_mesh_edge(const struct sheet *sheet, uint32_t f,
                                uint32_t g) {
  const uint32_t *p = sheet->triangle.item[f].point;
  const uint32_t *q = sheet->triangle.item[g].point;
  int other = 0; /* the corner of f that is not shared */
  while (p[other] == q[0] || p[other] == q[1] || p[other] == q[2])
    other++;
  return !sheet_is_inner_side(sheet, f, geom_next_corner(other));
}

/* Are triangles that share a side parts of one face, or is the side an edge of
 * the mesh?  Where it is a diagonal of one of two faces, these may cross in
 * it. */
static inline bool are_neighbours_at_side(const struct sheet *sheet,
                                          const struct swept_triangle *f,
                                          const struct swept_triangle *g) {
  if (!f->has_inner_sides && !g->has_inner_sides)
    return true;
  return sheet->triangle.item[f->triangle].face ==
             sheet->triangle.item[g->triangle].face ||
         (is_mesh_edge(sheet, f->triangle, g->triangle) &&
          is_mesh_edge(sheet, g->triangle, f->triangle));
}

/* Do two triangles share an edge of the mesh, a diagonal of one face, or a
 * corner and nothing more?  Then they do not pierce each other. */
static inline bool are_neighbours(const struct sheet *sheet,
                                  const struct swept_triangle *f,
                                  const struct swept_triangle *g) {
  unsigned shared = shared_corners(f, g), others = shared & (shared - 1);
  if (shared == 0)
    return false;
  if (others == 0) {
    int first = __builtin_ctz(shared);
    return are_disjoint_at_corner(f, first / 3, g, first % 3);
  }
  return (others & (others - 1)) != 0 || are_neighbours_at_side(sheet, f, g);
}

#endif
