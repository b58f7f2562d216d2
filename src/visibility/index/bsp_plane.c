/* bsp_plane.c - a line of the page, or a plane, that parts a crowd of triangles.
 *
 * Why nothing is lost.  Two triangles, or an edge and one, concern each other
 * where they share a stretch of the page: one hides a stretch of the other, or
 * they pierce each other, or an edge of one touches the plane of the other
 * along what that one covers, or edges of both run along each other within
 * TOLERANCE_COINCIDENT_UNITS.
 *   A line.  Of two that are on different sides alone, one is beyond the margin
 *   but for the apex, and so is the other: they share no more than the apex,
 *   and no end of an edge of one is near an edge of the other but there.
 *   A plane.  Piercing needs a common stretch in space, which would be on the
 *   plane, where both have no more than the apex.  Touching needs a place of
 *   the page where their depths differ by no more than the thickness of the
 *   triangle that is touched.  One that does not have the apex is farther
 *   from the plane than that, everywhere.  Where both have it, all that they
 *   share on the page is a wedge at the apex, and their depths part from there
 *   on at a steady rate: at the other end of the edge, which must touch too, it
 *   is off by more than the thickness, since it is off the plane by more.
 *   Of two that have the side from the apex to the hinge the same is true of
 * all along that side, and such two share an edge, so that they are not asked
 * about touching along it.
 *   Hiding.  What is before a plane, the apex aside, is nowhere farther than
 *   what is behind it.  (It may be hidden the other way round.)  An end of it
 *   that was rounded to the grid is off the plane by less than the thickness,
 *   since planes that are steeper than that are not taken.
 */
#include "visibility/index/bsp_plane.h"

#include <math.h>

enum {
  SAMPLE = 48, /* triangles by which cuts are judged */
  CANDIDATES = 8
};

/* Steeper than so many times the middling triangle is on both sides. */
#define THICKEST 16

/* Shares of the pairs: a cut must leave fewer than the first; one that leaves
 * no more than the other needs no better. */
#define MOST_LEFT 0.85
#define GOOD 0.6

static int side_of_line(const struct bsp_plane *cut, struct geom_point p) {
  int64_t value = cut->dx * ((int64_t)p.y - cut->shared_vertex.y) -
                  cut->dy * ((int64_t)p.x - cut->shared_vertex.x);
  return value > cut->margin    ? BSP_LEFT
         : value < -cut->margin ? BSP_RIGHT
                                : BSP_BOTH;
}

static int side_of_plane(const struct bsp_plane *cut, struct geom_point p) {
  const struct plane_filter *plane = &cut->plane;
  double x = p.x - plane->x, y = p.y - plane->y, z = (double)p.z - plane->z;
  double value = plane->nx * x + plane->ny * y + plane->nz * z;
  double bound = plane->ex * fabs(x) + plane->ey * fabs(y) +
                 plane->ez * fabs(z) + plane->nz * cut->thickness;
  return value > bound ? BSP_LEFT : value < -bound ? BSP_RIGHT : BSP_BOTH;
}

static int side_of_point(const struct bsp_plane *cut, struct geom_point p) {
  return cut->is_plane ? side_of_plane(cut, p) : side_of_line(cut, p);
}

/* Lines end where the page does: for them all points at one place are one. */
static bool is_shared_vertex(const struct bsp_plane *cut, struct geom_point p) {
  return p.x == cut->shared_vertex.x && p.y == cut->shared_vertex.y &&
         (!cut->is_plane || p.z == cut->shared_vertex.z);
}

static int side_of_points(const struct bsp_plane *cut,
                          const struct geom_point *p, int count) {
  int sides = 0, apexes = 0;
  for (int k = 0; k < count; k++)
    if (is_shared_vertex(cut, p[k]))
      apexes++;
    else
      sides |= side_of_point(cut, p[k]);
  return apexes > 1 ? BSP_BOTH : sides;
}

/* A segment that starts on the hinge is on the side that it leads to. */
int bsp_plane_side_of_segment(const struct bsp_plane *cut, struct geom_point p,
                              struct geom_point q) {
  const struct geom_point end[2] = {p, q};
  int sides = 0;
  for (int k = 0; k < 2; k++)
    if (cut->is_plane && geom_same_point(end[k], cut->shared_edge))
      sides |= is_shared_vertex(cut, end[1 - k])
                   ? BSP_BOTH
                   : side_of_point(cut, end[1 - k]);
  return sides != 0 ? sides : side_of_points(cut, end, 2);
}

/* The corner of a triangle that has the side from the apex to the hinge, which
 * is not on it; -1: it has no such side. */
static int corner_off_shared_edge(const struct bsp_plane *cut,
                                  const struct sheet *sheet,
                                  uint32_t triangle) {
  const uint32_t *point = sheet->triangle.item[triangle].point;
  for (int k = 0; cut->is_plane && k < 3; k++) {
    uint32_t a = point[k == 2 ? 0 : k + 1], b = point[k == 0 ? 2 : k - 1];
    if ((a == cut->point[0] && b == cut->point[1]) ||
        (a == cut->point[1] && b == cut->point[0]))
      return k;
  }
  return -1;
}

static int side_of_corners(const struct bsp_plane *cut,
                           const struct sheet *sheet, uint32_t triangle,
                           const struct geom_point p[3]) {
  int off = corner_off_shared_edge(cut, sheet, triangle);
  return off < 0 ? side_of_points(cut, p, 3) : side_of_point(cut, p[off]);
}

int bsp_plane_side_of_corners(const struct bsp_plane *cut,
                              const struct geom_point p[3]) {
  return side_of_point(cut, p[0]) | side_of_point(cut, p[1]) |
         side_of_point(cut, p[2]);
}

static void corners_of(const struct sheet *sheet, uint32_t triangle,
                       struct geom_point p[3]) {
  const uint32_t *t = sheet->triangle.item[triangle].point;
  for (int k = 0; k < 3; k++)
    p[k] = sheet->point.item[t[k]];
}

/* The contact tolerance of a triangle, as depth. */
static double thickness_of(const struct plane_filter *plane) {
  double most = plane->t0 + plane->t0_more + plane->t_off +
                (plane->t1 + plane->t1_more) * (double)SHEET_Z_MAX;
  return plane->nz > 0 ? most / plane->nz * (1 + 0x1p-40) : INFINITY;
}

int bsp_plane_side_of_triangle(const struct bsp_plane *cut,
                               const struct sheet *sheet, uint32_t triangle) {
  struct geom_point p[3];
  int sides;
  corners_of(sheet, triangle, p);
  sides = side_of_corners(cut, sheet, triangle, p);
  if (cut->is_plane && sides != BSP_BOTH) {
    struct plane_filter plane = plane_filter_of(sheet, triangle);
    if (!(thickness_of(&plane) <= cut->thickness))
      return BSP_BOTH;
  }
  return sides;
}

/* ---- Choosing ------------------------------------------------------------ */

/* What stands for the crowd while cuts are judged. */
struct sample {
  const struct sheet *sheet;
  uint32_t triangle[SAMPLE];
  struct geom_point p[SAMPLE][3];
  double thickness[SAMPLE];
  int count;
};

/* Places in as many equal parts of the crowd, each anywhere in its part: faces
 * of two triangles each alternate. */
static size_t place_of_sample(int i, size_t count, size_t parts) {
  size_t from = (size_t)i * count / parts,
         past = ((size_t)i + 1) * count / parts;
  uint32_t stirred = (uint32_t)i * UINT32_C(2654435761);
  return from + (stirred >> 16) % (past - from);
}

static void take_sample(struct sample *sample, const struct sheet *sheet,
                        const uint32_t *triangle, size_t count, bool planes) {
  sample->sheet = sheet;
  sample->count = count < SAMPLE ? (int)count : SAMPLE;
  for (int i = 0; i < sample->count; i++) {
    uint32_t t = triangle[place_of_sample(i, count, (size_t)sample->count)];
    sample->triangle[i] = t;
    corners_of(sheet, t, sample->p[i]);
    if (planes) {
      struct plane_filter plane = plane_filter_of(sheet, t);
      sample->thickness[i] = thickness_of(&plane);
    }
  }
}

/* THICKEST times the thickness that half of the sample stays below. */
static double greatest_thickness(const struct sample *sample) {
  double sorted[SAMPLE];
  for (int i = 0; i < sample->count; i++) {
    int k = i;
    for (; k > 0 && sorted[k - 1] > sample->thickness[i]; k--)
      sorted[k] = sorted[k - 1];
    sorted[k] = sample->thickness[i];
  }
  return THICKEST * sorted[sample->count / 2];
}

/* How many of the sample have a corner there. */
static int count_sharing(const struct sample *sample,
                         struct geom_point shared_vertex) {
  int sharing = 0;
  for (int i = 0; i < sample->count; i++)
    for (int k = 0; k < 3; k++)
      sharing += geom_same_point(sample->p[i][k], shared_vertex);
  return sharing;
}

/* The pairs that a cut leaves of the sample's, as a share. */
static double pairs_left(const struct sample *sample,
                         const struct bsp_plane *cut) {
  double left = 0, right = 0, all = sample->count;
  for (int i = 0; i < sample->count; i++) {
    int sides =
        side_of_corners(cut, sample->sheet, sample->triangle[i], sample->p[i]);
    if (cut->is_plane && !(sample->thickness[i] <= cut->thickness))
      sides = BSP_BOTH;
    left += (sides & BSP_LEFT) != 0;
    right += (sides & BSP_RIGHT) != 0;
  }
  return (left * left + right * right) / (all * all);
}

/* The line along side k of a triangle, with one end of it as its apex. */
static struct bsp_plane line_along(const struct geom_point p[3], int k,
                                   int shared_vertex) {
  struct geom_point a = p[k], b = p[(k + 1) % 3];
  struct bsp_plane cut = {.shared_vertex =
                              shared_vertex == (k + 1) % 3 ? b : a};
  cut.dx = (int64_t)b.x - a.x;
  cut.dy = (int64_t)b.y - a.y;
  cut.margin = BSP_PLANE_MARGIN * ((cut.dx < 0 ? -cut.dx : cut.dx) +
                                   (cut.dy < 0 ? -cut.dy : cut.dy));
  return cut;
}

static struct bsp_plane plane_of(const struct sheet *sheet, uint32_t triangle,
                                 int shared_vertex, int shared_edge,
                                 double thickness) {
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
 * but  a corner that it is not to be; 3: any */
static int choose_shared_vertex(const struct sample *sample, int i, int but) {
  int best = but == 0, most = -1;
  for (int k = 0; k < 3; k++) {
    if (k == but)
      continue;
    int sharing = count_sharing(sample, sample->p[i][k]);
    if (sharing > most) {
      most = sharing;
      best = k;
    }
  }
  return best;
}

/* The best cut so far, and the pairs that it leaves. */
struct plane_choice {
  struct bsp_plane *cut;
  double left;
  bool found;
};

static void consider(struct plane_choice *choice, const struct sample *sample,
                     const struct bsp_plane *cut) {
  double left;
  if (cut->is_plane ? !(thickness_of(&cut->plane) <= cut->thickness)
                    : cut->dx == 0 && cut->dy == 0)
    return;
  left = pairs_left(sample, cut);
  if (left >= choice->left)
    return;
  choice->left = left;
  choice->found = true;
  *choice->cut = *cut;
}

bool bsp_plane_choose(struct bsp_plane *cut, const struct sheet *sheet,
                      const uint32_t *triangle, size_t count, bool planes) {
  struct plane_choice choice = {cut, MOST_LEFT, false};
  struct sample sample;
  double thickness = 0;
  take_sample(&sample, sheet, triangle, count, planes);
  if (planes)
    thickness = greatest_thickness(&sample);
  for (int c = 0; c < CANDIDATES && choice.left > GOOD; c++) {
    int i = (2 * c + 1) * sample.count / (2 * CANDIDATES);
    int shared_vertex = choose_shared_vertex(&sample, i, 3);
    struct bsp_plane now;
    for (int k = 0; k < 3; k++) {
      now = line_along(sample.p[i], k, shared_vertex);
      consider(&choice, &sample, &now);
    }
    if (planes) {
      now =
          plane_of(sheet, sample.triangle[i], shared_vertex,
                   choose_shared_vertex(&sample, i, shared_vertex), thickness);
      consider(&choice, &sample, &now);
    }
  }
  return choice.found;
}
