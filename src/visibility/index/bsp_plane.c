/* bsp_plane.c - chooses the splitters of a BSP, and decides on which sides of
 * them triangles lie.
 *
 * Correctness: why no pair is lost.  Two triangles, or an edge and a triangle,
 * concern each other only where they overlap in more than a point of the page:
 *   (a) one hides a part of the other,
 *   (b) they pierce each other,
 *   (c) an edge of one touches the plane of the other along what that one
 *       covers, or
 *   (d) edges of both run along each other within TOLERANCE_COINCIDENT_UNITS.
 *
 * A line of the page.  Of two triangles that are on different sides alone, both
 * are beyond the margin, except for the shared vertex.  So they overlap in no
 * more than that vertex, and no end of an edge of one is near an edge of the
 * other but there.
 *
 * A plane.
 *   (b) Piercing needs a common segment in space.  It would lie on the plane,
 *       where both have no more than the shared vertex.
 *   (c) Touching needs a point of the page where the two depths differ by no
 *       more than the contact tolerance of the triangle that is touched.
 *       - A triangle without the shared vertex is farther from the plane than
 *         that, everywhere.
 *       - Where both have it, their overlap on the page is a wedge with its
 *         vertex there, in which the difference of their depths grows linearly
 *         with the distance from it.  The other end of the edge must touch too,
 *         but its difference exceeds the tolerance, since its distance from the
 *         plane does.
 *       - Of two that have the shared edge the same is true along all of it,
 *         and such two are neighbours, which are not tested for touching along
 *         it.
 *   (a) What is in front of a plane, the shared vertex excepted, is nowhere
 *       farther than what is behind it.  (It may hide what is behind: hence a
 *       traversal for what may hide a shape behind the plane visits both
 *       sides.)  An end of an edge that was rounded to the grid is off the
 *       plane by less than the contact tolerance, since steeper planes are not
 *       used.
 */
#include "visibility/index/bsp_plane.h"

#include <math.h>
#include <stdlib.h>

enum {
  SAMPLE = 48,   /* triangles by which splitters are judged */
  CANDIDATES = 8 /* triangles whose sides and planes are tried */
};

/* A triangle whose contact tolerance, as depth, exceeds so many times the
 * median is steep: it is on both sides. */
#define STEEP_FACTOR 16

/* Shares of the pairs: a splitter must leave fewer than the first; once one
 * leaves no more than the second, no better one is sought. */
#define PAIRS_LEFT_MAX 0.85
#define PAIRS_LEFT_GOOD 0.6

/* On which sides of a line of the page a point lies. */
static int side_of_line(const struct bsp_plane *splitter, struct geom_point p) {
  int64_t value = geom_orient2d(splitter->from, splitter->to, p);
  return value > splitter->margin    ? BSP_LEFT
         : value < -splitter->margin ? BSP_RIGHT
                                     : BSP_BOTH;
}

/* The same of a plane, by a filter: a side is certified. */
static int side_of_plane(const struct bsp_plane *splitter,
                         struct geom_point p) {
  const struct plane_filter *plane = &splitter->plane;
  double x = p.x - plane->x, y = p.y - plane->y, z = (double)p.z - plane->z;
  double value = plane->nx * x + plane->ny * y + plane->nz * z;
  double bound = plane->ex * fabs(x) + plane->ey * fabs(y) +
                 plane->ez * fabs(z) + plane->nz * splitter->thickness;
  return value > bound ? BSP_LEFT : value < -bound ? BSP_RIGHT : BSP_BOTH;
}

static int side_of_splitter(const struct bsp_plane *splitter,
                            struct geom_point p) {
  return splitter->is_plane ? side_of_plane(splitter, p)
                            : side_of_line(splitter, p);
}

/* For a line of the page, points that differ in depth alone are the same. */
static bool is_shared_vertex(const struct bsp_plane *splitter,
                             struct geom_point p) {
  return p.x == splitter->shared_vertex.x && p.y == splitter->shared_vertex.y &&
         (!splitter->is_plane || p.z == splitter->shared_vertex.z);
}

/* The sides of all points but the shared vertex; both for two points there. */
static int side_of_points(const struct bsp_plane *splitter,
                          const struct geom_point *p, int count) {
  int sides = 0, shared = 0;
  for (int k = 0; k < count; k++)
    if (is_shared_vertex(splitter, p[k]))
      shared++;
    else
      sides |= side_of_splitter(splitter, p[k]);
  return shared > 1 ? BSP_BOTH : sides;
}

/* A segment that starts at the shared edge's other end is on the side of its
 * second end. */
int bsp_plane_side_of_segment(const struct bsp_plane *splitter,
                              struct geom_point p, struct geom_point q) {
  const struct geom_point end[2] = {p, q};
  int sides = 0;
  for (int k = 0; k < 2; k++)
    if (splitter->is_plane && geom_same_point(end[k], splitter->shared_edge))
      sides |= is_shared_vertex(splitter, end[1 - k])
                   ? BSP_BOTH
                   : side_of_splitter(splitter, end[1 - k]);
  return sides != 0 ? sides : side_of_points(splitter, end, 2);
}

/* The corner of a triangle opposite to the shared edge; -1 where the triangle
 * does not have that edge. */
static int corner_off_shared_edge(const struct bsp_plane *splitter,
                                  const struct sheet *sheet,
                                  uint32_t triangle) {
  const uint32_t *point = sheet->triangle.item[triangle].point;
  for (int k = 0; splitter->is_plane && k < 3; k++) {
    uint32_t a = point[geom_next_corner(k)], b = point[k == 0 ? 2 : k - 1];
    if ((a == splitter->point[0] && b == splitter->point[1]) ||
        (a == splitter->point[1] && b == splitter->point[0]))
      return k;
  }
  return -1;
}

/* On which sides a triangle lies, its steepness not considered. */
static int side_of_corners(const struct bsp_plane *splitter,
                           const struct sheet *sheet, uint32_t triangle,
                           const struct geom_point p[3]) {
  int off = corner_off_shared_edge(splitter, sheet, triangle);
  return off < 0 ? side_of_points(splitter, p, 3)
                 : side_of_splitter(splitter, p[off]);
}

int bsp_plane_side_of_corners(const struct bsp_plane *splitter,
                              const struct geom_point p[3]) {
  return side_of_splitter(splitter, p[0]) | side_of_splitter(splitter, p[1]) |
         side_of_splitter(splitter, p[2]);
}

int bsp_plane_side_of_triangle(const struct bsp_plane *splitter,
                               const struct sheet *sheet, uint32_t triangle) {
  const struct geom_triangle corners = sheet_corners(sheet, triangle);
  int sides = side_of_corners(splitter, sheet, triangle, corners.p);
  if (splitter->is_plane && sides != BSP_BOTH) {
    struct plane_filter plane = plane_filter_of(sheet, triangle);
    if (!(plane_filter_thickness(&plane) <= splitter->thickness))
      return BSP_BOTH;
  }
  return sides;
}

/* ---- Choosing ------------------------------------------------------------ */

/* A sample of the list, by which splitters are judged. */
struct sample {
  const struct sheet *sheet;
  uint32_t triangle[SAMPLE];
  struct geom_triangle corners[SAMPLE];
  double thickness[SAMPLE];
  int count;
};

/* The index in the list of sample i: stratified, a pseudo-random one in each of
 * `parts` equal parts.  A fixed stride would see only one triangle of each face
 * where all faces have two. */
static size_t index_of_sample(int i, size_t count, size_t parts) {
  size_t from = (size_t)i * count / parts,
         past = ((size_t)i + 1) * count / parts;
  uint32_t hash = (uint32_t)i * UINT32_C(2654435761);
  return from + (hash >> 16) % (past - from);
}

static void draw_sample(struct sample *sample, const struct sheet *sheet,
                        const uint32_t *triangle, size_t count, bool planes) {
  sample->sheet = sheet;
  sample->count = count < SAMPLE ? (int)count : SAMPLE;
  for (int i = 0; i < sample->count; i++) {
    uint32_t t = triangle[index_of_sample(i, count, (size_t)sample->count)];
    sample->triangle[i] = t;
    sample->corners[i] = sheet_corners(sheet, t);
    if (planes) {
      struct plane_filter plane = plane_filter_of(sheet, t);
      sample->thickness[i] = plane_filter_thickness(&plane);
    }
  }
}

/* STEEP_FACTOR times the median thickness of the sample. */
static double thickness_limit(const struct sample *sample) {
  double sorted[SAMPLE];
  for (int i = 0; i < sample->count; i++) {
    int k = i;
    for (; k > 0 && sorted[k - 1] > sample->thickness[i]; k--)
      sorted[k] = sorted[k - 1];
    sorted[k] = sample->thickness[i];
  }
  return STEEP_FACTOR * sorted[sample->count / 2];
}

/* How many triangles of the sample have a corner at the shared vertex. */
static int count_sharing(const struct sample *sample,
                         struct geom_point shared_vertex) {
  int sharing = 0;
  for (int i = 0; i < sample->count; i++)
    for (int k = 0; k < 3; k++)
      sharing += geom_same_point(sample->corners[i].p[k], shared_vertex);
  return sharing;
}

/* The share of the sample's pairs that a splitter leaves on a common side. */
static double pairs_left(const struct sample *sample,
                         const struct bsp_plane *splitter) {
  double left = 0, right = 0, all = sample->count;
  for (int i = 0; i < sample->count; i++) {
    int sides = side_of_corners(splitter, sample->sheet, sample->triangle[i],
                                sample->corners[i].p);
    if (splitter->is_plane && !(sample->thickness[i] <= splitter->thickness))
      sides = BSP_BOTH;
    left += (sides & BSP_LEFT) != 0;
    right += (sides & BSP_RIGHT) != 0;
  }
  return (left * left + right * right) / (all * all);
}

/* The line along side k of a triangle.
 * shared_vertex  the corner to be the shared vertex if it is an end of the
 *                side, else the side's first end is */
static struct bsp_plane line_along(const struct geom_point p[3], int k,
                                   int shared_vertex) {
  struct geom_point a = p[k], b = p[geom_next_corner(k)];
  int64_t length = llabs((int64_t)b.x - a.x) + llabs((int64_t)b.y - a.y);
  return (struct bsp_plane){.shared_vertex =
                                shared_vertex == geom_next_corner(k) ? b : a,
                            .from = a,
                            .to = b,
                            .margin = BSP_PLANE_MARGIN * length};
}

/* The plane of a triangle, with two of its corners as the shared edge. */
static struct bsp_plane
plane_through_corners(const struct sheet *sheet, uint32_t triangle,
                      int shared_vertex, int shared_edge, double thickness) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  return (struct bsp_plane){.shared_vertex =
                                sheet->point.item[p[shared_vertex]],
                            .shared_edge = sheet->point.item[p[shared_edge]],
                            .point = {p[shared_vertex], p[shared_edge]},
                            .is_plane = true,
                            .thickness = thickness,
                            .plane = plane_filter_of(sheet, triangle)};
}

/* The corner of a triangle of the sample that most others share.
 * except  a corner that is not allowed; 3: all are */
static int choose_shared_vertex(const struct sample *sample, int i,
                                int except) {
  int best = except == 0, most = -1;
  for (int k = 0; k < 3; k++) {
    if (k == except)
      continue;
    int sharing = count_sharing(sample, sample->corners[i].p[k]);
    if (sharing > most) {
      most = sharing;
      best = k;
    }
  }
  return best;
}

/* The best splitter so far, and the share of pairs that it leaves. */
struct plane_choice {
  struct bsp_plane *splitter;
  double pairs_left;
  bool found;
};

/* Takes a splitter if it is valid and better than the best so far. */
static void consider_splitter(struct plane_choice *choice,
                              const struct sample *sample,
                              const struct bsp_plane *splitter) {
  double left;
  if (splitter->is_plane
          ? !(plane_filter_thickness(&splitter->plane) <= splitter->thickness)
          : splitter->margin == 0)
    return;
  left = pairs_left(sample, splitter);
  if (left >= choice->pairs_left)
    return;
  choice->pairs_left = left;
  choice->found = true;
  *choice->splitter = *splitter;
}

bool bsp_plane_choose(struct bsp_plane *splitter, const struct sheet *sheet,
                      const uint32_t *triangle, size_t count, bool planes) {
  struct plane_choice choice = {splitter, PAIRS_LEFT_MAX, false};
  struct sample sample;
  double thickness = 0;
  draw_sample(&sample, sheet, triangle, count, planes);
  if (planes)
    thickness = thickness_limit(&sample);
  for (int c = 0; c < CANDIDATES && choice.pairs_left > PAIRS_LEFT_GOOD; c++) {
    int i = (2 * c + 1) * sample.count / (2 * CANDIDATES);
    int shared_vertex = choose_shared_vertex(&sample, i, 3);
    struct bsp_plane candidate;
    for (int k = 0; k < 3; k++) {
      candidate = line_along(sample.corners[i].p, k, shared_vertex);
      consider_splitter(&choice, &sample, &candidate);
    }
    if (planes) {
      candidate = plane_through_corners(
          sheet, sample.triangle[i], shared_vertex,
          choose_shared_vertex(&sample, i, shared_vertex), thickness);
      consider_splitter(&choice, &sample, &candidate);
    }
  }
  return choice.found;
}
