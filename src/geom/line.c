/* line.c - exact lines of the page and the corners where they meet.
 *
 * With direction (b, -a) a line a x + b y + c has its positive side on the
 * left.  Two lines meet at the homogeneous point
 *   (b1 c2 - b2 c1,  c1 a2 - c2 a1,  a1 b2 - a2 b1)
 * so the value of a third line there has the sign of det(l1, l2, l3) times
 * the sign of the last component.
 *
 * Of grid lines that is 127 bits at most, so machine words decide where doubles
 * cannot; wide.h is for plane intersections.
 *
 * Filter: the nine inputs are within 2^-52 of the true coefficients (the
 * digits are cut off); each of the six triple products gathers at most 3 such
 * errors and 5 roundings in all: 11 roundings, within FILTER_ERROR.
 */
#include "geom/line.h"

#include <math.h>
#include <string.h>

#include "geom/wide.h"

void geom_line_through(struct geom_line *line, struct geom_point p,
                       struct geom_point q) {
  int64_t a = (int64_t)p.y - q.y, b = (int64_t)q.x - p.x;
  memset(line, 0, sizeof *line);
  line->is_grid_line = true;
  line->x0 = p.x;
  line->y0 = p.y;
  line->x1 = q.x;
  line->y1 = q.y;
  line->a = (double)a;
  line->b = (double)b;
  line->c = (double)-(a * p.x + b * p.y);
}

static void store_coefficient(struct geom_line *line, int k,
                              const struct wide *value, double *nearest) {
  line->sign[k] = (int8_t)value->sign;
  for (int i = 0; i < GEOM_LINE_LIMBS; i++)
    line->limb[k][i] = i < value->count ? value->limb[i] : 0;
  *nearest = wide_to_double(value);
}

/* nx a.x + ny a.y + nz a.z: below 2^105, as predicate.h derives. */
static int128 constant_of(const struct geom_plane *plane) {
  return plane->nx * plane->a.x + plane->ny * plane->a.y +
         (int128)plane->nz * plane->a.z;
}

/* plane: nx x + ny y + nz z = K. */
static void load_plane(struct wide n[3], struct wide *k,
                       const struct geom_plane *plane) {
  n[0] = wide_of_int128(plane->nx);
  n[1] = wide_of_int128(plane->ny);
  n[2] = wide_of_int128(plane->nz);
  *k = wide_of_int128(constant_of(plane));
}

int geom_line_between(struct geom_line *line, const struct geom_plane *front,
                      const struct geom_plane *back) {
  struct wide g[3], f[3], kg, kf, value;
  load_plane(g, &kg, front);
  load_plane(f, &kf, back);
  memset(line, 0, sizeof *line);
  /* z = (K - nx x - ny y) / nz for both; their difference times both nz. */
  wide_cross(&value, &f[0], &g[2], &g[0], &f[2]);
  store_coefficient(line, 0, &value, &line->a);
  wide_cross(&value, &f[1], &g[2], &g[1], &f[2]);
  store_coefficient(line, 1, &value, &line->b);
  wide_cross(&value, &kg, &f[2], &kf, &g[2]);
  store_coefficient(line, 2, &value, &line->c);
  if (line->sign[0] != 0 || line->sign[1] != 0)
    return 0;
  return line->sign[2] == 0 ? GEOM_SAME_PLANE : line->sign[2];
}

void geom_line_level(struct geom_line *line, struct ratio height) {
  struct wide value;
  if (height.num % height.den == 0) {
    int32_t y = (int32_t)(height.num / height.den);
    geom_line_through(line, (struct geom_point){0, y, 0},
                      (struct geom_point){1, y, 0});
    return;
  }
  memset(line, 0, sizeof *line);
  value = wide_of_int128(height.den);
  store_coefficient(line, 1, &value, &line->b);
  value = wide_of_int128(-height.num);
  store_coefficient(line, 2, &value, &line->c);
}

struct geom_line geom_line_reversed(const struct geom_line *line) {
  struct geom_line to = *line;
  to.x0 = line->x1;
  to.y0 = line->y1;
  to.x1 = line->x0;
  to.y1 = line->y0;
  to.a = -to.a;
  to.b = -to.b;
  to.c = -to.c;
  for (int k = 0; k < 3; k++)
    to.sign[k] = (int8_t)-to.sign[k];
  return to;
}

/* ---- Exact coefficients -------------------------------------------------- */

void geom_line_exact(struct wide l[3], const struct geom_line *line) {
  if (line->is_grid_line) {
    struct geom_line_integers n = geom_line_integers_of(line);
    l[0] = wide_of_int128(n.a);
    l[1] = wide_of_int128(n.b);
    l[2] = wide_of_int128(n.c);
    return;
  }
  for (int k = 0; k < 3; k++)
    l[k] = wide_of_limbs(line->limb[k], GEOM_LINE_LIMBS, line->sign[k]);
}

void geom_corner_exact(const struct geom_corner *corner, struct wide h[3]) {
  struct wide p[3], q[3];
  if (corner->l1 == NULL) {
    h[0] = wide_of_int128(corner->ix);
    h[1] = wide_of_int128(corner->iy);
    h[2] = wide_of_int128(1);
    return;
  }
  geom_line_exact(p, corner->l1);
  geom_line_exact(q, corner->l2);
  wide_cross(&h[0], &p[1], &q[2], &q[1], &p[2]);
  wide_cross(&h[1], &p[2], &q[0], &q[2], &p[0]);
  wide_cross(&h[2], &p[0], &q[1], &q[0], &p[1]);
  if (h[2].sign < 0)
    for (int k = 0; k < 3; k++)
      wide_negate(&h[k]);
}

/* ---- The same of grid lines, in machine words ---------------------------- */

/* x, y < 2^94, 0 < w < 2^63 */
struct corner_integers {
  int128 x, y;
  int64_t w;
};

/* The corner as homogeneous integers; false where one of its lines is no grid
 * line. */
static bool grid_lines_meet(struct corner_integers *h,
                            const struct geom_corner *corner) {
  struct geom_line_integers p, q;
  if (corner->l1 == NULL) {
    *h = (struct corner_integers){corner->ix, corner->iy, 1};
    return true;
  }
  if (!corner->l1->is_grid_line || !corner->l2->is_grid_line)
    return false;
  p = geom_line_integers_of(corner->l1);
  q = geom_line_integers_of(corner->l2);
  h->x = (int128)p.b * q.c - (int128)q.b * p.c;
  h->y = (int128)p.c * q.a - (int128)q.c * p.a;
  h->w = p.a * q.b - q.a * p.b;
  if (h->w < 0) {
    h->x = -h->x;
    h->y = -h->y;
    h->w = -h->w;
  }
  return true;
}

/* ---- Predicates ---------------------------------------------------------- */

static int side_exact(const struct geom_line *line,
                      const struct geom_corner *corner) {
  struct corner_integers c;
  struct wide l[3], h[3], ax, by, sum, value;
  if (line->is_grid_line && grid_lines_meet(&c, corner)) {
    struct geom_line_integers n =
        geom_line_integers_of(line); /* 2^125 each: the sum fits */
    return geom_sign128(n.a * c.x + n.b * c.y + (int128)n.c * c.w);
  }
  geom_line_exact(l, line);
  geom_corner_exact(corner, h);
  wide_multiply(&ax, &l[0], &h[0]);
  wide_multiply(&by, &l[1], &h[1]);
  wide_add(&sum, &ax, &by);
  wide_multiply(&ax, &l[2], &h[2]);
  wide_add(&value, &sum, &ax);
  return value.sign;
}

static bool same_line(const struct geom_line *l, const struct geom_line *m) {
  if (l == m)
    return true;
  if (!l->is_grid_line || !m->is_grid_line)
    return false;
  return (l->x0 == m->x0 && l->y0 == m->y0 && l->x1 == m->x1 &&
          l->y1 == m->y1) ||
         (l->x0 == m->x1 && l->y0 == m->y1 && l->x1 == m->x0 && l->y1 == m->y0);
}

/* The side of a point of the grid on which it lies of a line that is none. */
static int side_of_point(const struct geom_line *line,
                         const struct geom_corner *corner) {
  double value, size;
  value = line->a * corner->ix + line->b * corner->iy + line->c;
  size =
      fabs(line->a * corner->ix) + fabs(line->b * corner->iy) + fabs(line->c);
  if (value > FILTER_ERROR * size)
    return 1;
  if (value < -FILTER_ERROR * size)
    return -1;
  return side_exact(line, corner);
}

/* How far a corner's doubles may be from the truth: see CORNER_SINE; nearer to
 * parallel they are rounded to 2^-9. */
#define CORNER_ERROR 0x1p-2

/* The side where the corner's doubles are far enough from the line to decide,
 * else 0: all but the corners next to it. */
static int side_of_doubles(const struct geom_line *line,
                           const struct geom_corner *corner) {
  double ax, by, c, value, bound;
  if (line->is_grid_line) {
    ax = line->a * (corner->x - line->x0);
    by = line->b * (corner->y - line->y0);
    c = 0;
  } else {
    ax = line->a * corner->x;
    by = line->b * corner->y;
    c = line->c;
  }
  value = ax + by + c;
  bound = CORNER_ERROR * (fabs(line->a) + fabs(line->b)) +
          FILTER_ERROR * (fabs(ax) + fabs(by) + fabs(c));
  return (value > bound) - (value < -bound);
}

int geom_line_side_of_any(const struct geom_line *line,
                          const struct geom_corner *corner) {
  const struct geom_line *p = corner->l1, *q = corner->l2;
  double x1, x2, y1, y2, w1, w2, w, det, size;
  int side;
  if (p == NULL)
    return side_of_point(line, corner);
  side = side_of_doubles(line, corner);
  if (side != 0)
    return side;
  if (same_line(line, p) || same_line(line, q))
    return 0;
  x1 = p->b * q->c, x2 = q->b * p->c;
  y1 = p->c * q->a, y2 = q->c * p->a;
  w1 = p->a * q->b, w2 = q->a * p->b;
  w = w1 - w2;
  det = line->a * (x1 - x2) + line->b * (y1 - y2) + line->c * w;
  size = fabs(line->a) * (fabs(x1) + fabs(x2)) +
         fabs(line->b) * (fabs(y1) + fabs(y2)) +
         fabs(line->c) * (fabs(w1) + fabs(w2));
  if (fabs(det) > FILTER_ERROR * size &&
      fabs(w) > FILTER_ERROR * (fabs(w1) + fabs(w2)))
    return (det > 0) == (w > 0) ? 1 : -1;
  return side_exact(line, corner);
}

/* The sign of a1 b2 - a2 b1, of which the directions' cross product is the
 * same, or of a1 a2 + b1 b2. */
static int product_exact(const struct geom_line *l1, const struct geom_line *l2,
                         bool dot) {
  struct wide p[3], q[3], value;
  if (l1->is_grid_line && l2->is_grid_line) {
    struct geom_line_integers m = geom_line_integers_of(l1),
                              n = geom_line_integers_of(l2);
    return geom_sign64(dot ? m.a * n.a + m.b * n.b : m.a * n.b - n.a * m.b);
  }
  geom_line_exact(p, l1);
  geom_line_exact(q, l2);
  if (dot) {
    wide_negate(&q[1]);
    wide_cross(&value, &p[0], &q[0], &p[1], &q[1]);
  } else {
    wide_cross(&value, &p[0], &q[1], &q[0], &p[1]);
  }
  return value.sign;
}

int geom_line_turn(const struct geom_line *l1, const struct geom_line *l2) {
  double w1 = l1->a * l2->b, w2 = l2->a * l1->b, w = w1 - w2;
  if (fabs(w) > FILTER_ERROR * (fabs(w1) + fabs(w2)))
    return w > 0 ? 1 : -1;
  if (same_line(l1, l2))
    return 0;
  return product_exact(l1, l2, false);
}

int geom_line_along(const struct geom_line *l1, const struct geom_line *l2) {
  double w1 = l1->a * l2->a, w2 = l1->b * l2->b, w = w1 + w2;
  if (fabs(w) > FILTER_ERROR * (fabs(w1) + fabs(w2)))
    return w > 0 ? 1 : -1;
  return product_exact(l1, l2, true);
}

/* ---- Corners ------------------------------------------------------------- */

struct geom_corner geom_corner_at(struct geom_point p) {
  return (struct geom_corner){(double)p.x, (double)p.y, NULL, NULL, p.x, p.y};
}

/* Below this sine of the angle between two lines, doubles do not place their
 * crossing well enough.  With |l| = |a| + |b| and a corner on the page,
 * |c| <= 2^30 |l|; the terms of x, y and w gather at most 6 roundings, so x is
 * off by less than
 *     6 * 2^-53 * (2^31 + 2^30) |l1| |l2| / |w|:
 * at this sine 9/64, within CORNER_ERROR.  (Compared with the terms of w alone,
 * two lines nearly along an axis would pass for far from parallel: c is what is
 * large there.) */
#define CORNER_SINE 0x1p-16

struct geom_corner geom_corner_of(const struct geom_line *l1,
                                  const struct geom_line *l2) {
  double w = l1->a * l2->b - l2->a * l1->b;
  double size = (fabs(l1->a) + fabs(l1->b)) * (fabs(l2->a) + fabs(l2->b));
  struct geom_corner corner = {(l1->b * l2->c - l2->b * l1->c) / w,
                               (l1->c * l2->a - l2->c * l1->a) / w,
                               l1,
                               l2,
                               0,
                               0};
  if (fabs(w) <= CORNER_SINE * size) {
    int64_t x, y; /* nearly parallel: the doubles would be far off */
    geom_corner_round(&corner, 8, &x, &y);
    corner.x = (double)x * 0x1p-8;
    corner.y = (double)y * 0x1p-8;
  }
  return corner;
}

static int compare_exact(const struct geom_corner *p,
                         const struct geom_corner *q) {
  struct corner_integers m, n;
  struct wide g[3], h[3], value;
  int order = 0;
  if (grid_lines_meet(&m, p) && grid_lines_meet(&n, q)) {
    order = ratio_compare((struct ratio){m.x, m.w}, (struct ratio){n.x, n.w});
    return order != 0 ? order
                      : ratio_compare((struct ratio){m.y, m.w},
                                      (struct ratio){n.y, n.w});
  }
  geom_corner_exact(p, g);
  geom_corner_exact(q, h);
  for (int k = 0; k < 2 && order == 0; k++) {
    wide_cross(&value, &g[k], &h[2], &h[k], &g[2]);
    order = value.sign;
  }
  return order;
}

int geom_corner_compare(const struct geom_corner *p,
                        const struct geom_corner *q) {
  if (p->l1 == NULL && q->l1 == NULL) {
    if (p->ix != q->ix)
      return p->ix < q->ix ? -1 : 1;
    return (p->iy > q->iy) - (p->iy < q->iy);
  }
  if (fabs(p->x - q->x) > 2 * CORNER_ERROR)
    return p->x < q->x ? -1 : 1;
  if (p->l1 != NULL && p->l1 == q->l1 && p->l2 == q->l2)
    return 0;
  return compare_exact(p, q);
}

/* floor(2^bits num / den + 1/2), num < 2^94 */
static int64_t round_quotient(int128 num, int64_t den, int bits) {
  int128 twice = num * ((int128)2 << bits) + den, whole = twice / den / 2;
  if (whole * 2 * den > twice)
    whole--;
  return (int64_t)whole;
}

void geom_corner_round(const struct geom_corner *corner, int bits, int64_t *x,
                       int64_t *y) {
  struct corner_integers c;
  struct wide h[3];
  if (grid_lines_meet(&c, corner)) {
    *x = round_quotient(c.x, c.w, bits);
    *y = round_quotient(c.y, c.w, bits);
    return;
  }
  geom_corner_exact(corner, h);
  *x = wide_round_quotient(&h[0], &h[2], bits);
  *y = wide_round_quotient(&h[1], &h[2], bits);
}
