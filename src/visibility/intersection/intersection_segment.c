/* intersection_segment.c - the segment in which two triangles intersect. */
#include "visibility/intersection/intersection_segment.h"

struct corner_counts corner_counts_of(const struct occluder *plane,
                                      const struct geom_point p[3]) {
  struct corner_counts count = {0, 0, 0};
  for (int k = 0; k < 3; k++) {
    int side = occluder_side(plane, p[k]);
    count.behind += side < 0;
    count.in_front += side > 0;
    if (side != 0)
      count.off_plane = k;
  }
  return count;
}

bool triangles_coplanar_within_rounding(const struct sheet *sheet, uint32_t f,
                                        uint32_t g, const struct occluder *hf,
                                        const struct occluder *hg) {
  if ((sheet->triangle_flags[f] | sheet->triangle_flags[g]) & SHEET_EDGE_ON)
    return false;
  for (int k = 0; k < 3; k++) {
    int next = geom_next_corner(k);
    if (occluder_edge_is_off_plane(hg, sheet, hf->p[k], hf->p[next]) ||
        occluder_edge_is_off_plane(hf, sheet, hg->p[k], hg->p[next]))
      return false;
  }
  return true;
}

/* Is an edge, clipped to the projection of a triangle, off its plane by more
 * than twice the contact tolerance?  The factor is for rounding. */
static bool edge_is_off_plane(const struct coarse_plane *plane,
                              const struct geom_point triangle[3],
                              struct geom_point p, struct geom_point q) {
  struct occluded_interval part;
  if (!occlude_by_projection(triangle, p, q, &part))
    return false;
  double at_p = coarse_plane_value(plane, p),
         more = coarse_plane_value(plane, q) - at_p;
  return fabs(at_p + ratio_to_double(part.from) * more) > 2 * plane->most ||
         fabs(at_p + ratio_to_double(part.to) * more) > 2 * plane->most;
}

bool triangles_are_off_plane(const struct geom_point f[3],
                             const struct geom_point g[3],
                             const struct coarse_plane *cf,
                             const struct coarse_plane *cg) {
  for (int k = 0; k < 3; k++) {
    int next = geom_next_corner(k);
    if (edge_is_off_plane(cg, g, f[k], f[next]) ||
        edge_is_off_plane(cf, f, g[k], g[next]))
      return true;
  }
  return false;
}

/* The sign of the volume of the tetrahedron a, b, c, d. */
static int volume_sign(struct geom_point a, struct geom_point b,
                       struct geom_point c, struct geom_point d) {
  struct geom_plane plane = geom_plane_of(a, b, c);
  return geom_sign128(geom_plane_value(&plane, d));
}

/* Does the line through a and b meet the triangle p?  It does where the three
 * volumes with its sides do not differ in sign. */
static bool line_meets(struct geom_point a, struct geom_point b,
                       const struct geom_point p[3]) {
  bool left = false, right = false;
  for (int k = 0; k < 3; k++) {
    int side = volume_sign(a, b, p[k], p[geom_next_corner(k)]);
    left |= side > 0;
    right |= side < 0;
  }
  return !(left && right);
}

/* The points found so far on the common line: the least and the greatest. */
struct segment_ends {
  int count;
  struct geom_point low, high;
};

static void add_segment_end(struct segment_ends *ends, struct geom_point p) {
  if (ends->count == 0 || geom_compare_points(p, ends->low) < 0)
    ends->low = p;
  if (ends->count == 0 || geom_compare_points(p, ends->high) > 0)
    ends->high = p;
  ends->count++;
}

/* Adds the points where edges of triangle f pass through triangle g. */
static void add_piercing_points(const struct sheet *sheet, uint32_t f,
                                const struct triangle_plane *pg,
                                struct segment_ends *ends) {
  const uint32_t *point = sheet->triangle.item[f].point;
  for (int k = 0; k < 3; k++) {
    uint32_t i = point[k], j = point[geom_next_corner(k)];
    struct geom_point a, b;
    int128 va, vb;
    struct ratio t;
    if (i > j) { /* one direction, whichever triangle it is an edge of */
      uint32_t swap = i;
      i = j;
      j = swap;
    }
    a = sheet->point.item[i];
    b = sheet->point.item[j];
    va = geom_plane_value(&pg->plane, a);
    vb = geom_plane_value(&pg->plane, b);
    if ((va > 0 && vb > 0) || (va < 0 && vb < 0) || va == vb)
      continue;
    if (!line_meets(a, b, pg->p))
      continue;
    t = va > vb ? (struct ratio){va, va - vb} : (struct ratio){-va, vb - va};
    add_segment_end(ends, (struct geom_point){(int32_t)ratio_lerp(t, a.x, b.x),
                                              (int32_t)ratio_lerp(t, a.y, b.y),
                                              ratio_lerp(t, a.z, b.z)});
  }
}

/* How many corners of the two have equal coordinates. */
static int count_equal_corners(const struct geom_point f[3],
                               const struct geom_point g[3]) {
  int shared = 0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      shared += geom_same_point(f[i], g[j]);
  return shared;
}

bool intersection_segment_of_planes(const struct sheet *sheet, uint32_t f,
                                    uint32_t g, const struct triangle_plane *pf,
                                    const struct triangle_plane *pg,
                                    struct intersection_segment *segment) {
  struct segment_ends ends = {0};
  if (count_equal_corners(pf->p, pg->p) > 1)
    return false;
  add_piercing_points(sheet, f, pg, &ends);
  add_piercing_points(sheet, g, pf, &ends);
  if (ends.count < 2 ||
      (ends.low.x == ends.high.x && ends.low.y == ends.high.y))
    return false;
  *segment = (struct intersection_segment){{f < g ? f : g, f < g ? g : f},
                                           {ends.low, ends.high}};
  return true;
}

static struct triangle_plane plane_of_occluder(const struct occluder *h) {
  return (struct triangle_plane){{h->p[0], h->p[1], h->p[2]}, h->plane};
}

bool intersection_segment_find(const struct sheet *sheet, uint32_t f,
                               uint32_t g, const struct occluder *hf,
                               const struct occluder *hg,
                               struct intersection_segment *segment) {
  struct triangle_plane pf = plane_of_occluder(hf), pg = plane_of_occluder(hg);
  return intersection_segment_of_planes(sheet, f, g, &pf, &pg, segment);
}
