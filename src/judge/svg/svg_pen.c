/* svg_pen.c - adds lines and curves of an SVG file to a drawing, clipped to the
 * page.
 *
 * Curves are transformed to the page before they are subdivided, so that the
 * tolerance holds there.  A curve that would need more than MOST segments is
 * halved first, and a half outside the page becomes one segment: so their
 * number depends on what is on the page, not on the distance of control points.
 */
#include "judge/svg/svg_pen.h"

#include <math.h>

#include "base/tolerance.h"

/* A quarter of the widest pen that the options allow. */
#define MARGIN_MM 25

/* ---- Lines --------------------------------------------------------------- */

static void add_stroke_point(struct svg_pen *pen, struct judge_point2 at) {
  struct judge_drawing *drawing = pen->drawing;
  if (pen->out_of_memory)
    return;
  pen->out_of_memory = !ARRAY_PUSH(&drawing->point, at);
  if (!pen->out_of_memory)
    drawing->stroke.item[drawing->stroke.count - 1].count++;
}

/* Begins a stroke. */
static void begin_svg_stroke(struct svg_pen *pen, struct judge_point2 at) {
  struct judge_stroke stroke = {(uint32_t)pen->drawing->point.count, 0,
                                pen->role};
  if (pen->out_of_memory)
    return;
  pen->out_of_memory = !ARRAY_PUSH(&pen->drawing->stroke, stroke);
  add_stroke_point(pen, at);
}

/* Clips a segment at x = limit; false where all of it is outside.
 * sign  1: greater x is outside; -1: lesser x is
 * The crossing is computed from the end that is nearer, with halved operands:
 * coordinates may be as large as doubles get. */
static bool cut_at(double limit, double sign, double *ax, double *ay,
                   double *bx, double *by) {
  bool a_beyond = sign * *ax > sign * limit,
       b_beyond = sign * *bx > sign * limit;
  if (!a_beyond || !b_beyond) {
    if (a_beyond == b_beyond)
      return true;
    double slope = (*by / 2 - *ay / 2) / (*bx / 2 - *ax / 2);
    bool from_a = fabs(limit - *ax) < fabs(limit - *bx);
    double y =
        from_a ? *ay + (limit - *ax) * slope : *by + (limit - *bx) * slope;
    y = fmin(fmax(y, fmin(*ay, *by)), fmax(*ay, *by));
    *(a_beyond ? ax : bx) = limit;
    *(a_beyond ? ay : by) = y;
    return true;
  }
  return false;
}

/* Clips the segment from a to b to the page and its margin; false where it is
 * outside. */
static bool cut(const struct svg_pen *pen, struct judge_point2 *a,
                struct judge_point2 *b) {
  double right = pen->drawing->width_mm + MARGIN_MM;
  double top = pen->drawing->height_mm + MARGIN_MM;
  return cut_at(-MARGIN_MM, -1, &a->x, &a->y, &b->x, &b->y) &&
         cut_at(right, 1, &a->x, &a->y, &b->x, &b->y) &&
         cut_at(-MARGIN_MM, -1, &a->y, &a->x, &b->y, &b->x) &&
         cut_at(top, 1, &a->y, &a->x, &b->y, &b->x);
}

static bool is_same_point2(struct judge_point2 a, struct judge_point2 b) {
  return a.x == b.x && a.y == b.y;
}

/* Whether a point is finite; if not, the drawing is an error. */
static bool is_finite_point(struct svg_pen *pen, struct judge_point2 at) {
  if (isfinite(at.x) && isfinite(at.y))
    return true;
  pen->fault = "coordinates that are too large";
  return false;
}

/* Adds a point to the current stroke. */
static void draw_to(struct svg_pen *pen, struct judge_point2 to) {
  struct judge_point2 a = pen->last, b = to;
  if (!is_finite_point(pen, to))
    return;
  bool seen = cut(pen, &a, &b);
  if (seen && !(pen->joined && is_same_point2(a, pen->last)))
    begin_svg_stroke(pen, a);
  if (seen)
    add_stroke_point(pen, b);
  pen->joined = seen && is_same_point2(b, to);
  pen->last = to;
}

/* Starts at the current position, unless a line ended there. */
static void lower_pen(struct svg_pen *pen) {
  if (pen->down)
    return;
  pen->last = svg_apply(&pen->to_page, pen->here.x, pen->here.y);
  pen->down = is_finite_point(pen, pen->last);
  pen->joined = false;
}

void svg_pen_move(struct svg_pen *pen, double x, double y) {
  pen->start = pen->here = (struct judge_point2){x, y};
  pen->down = false;
}

void svg_pen_line(struct svg_pen *pen, double x, double y) {
  lower_pen(pen);
  pen->here = (struct judge_point2){x, y};
  if (pen->fault == NULL)
    draw_to(pen, svg_apply(&pen->to_page, x, y));
}

void svg_pen_close(struct svg_pen *pen) {
  svg_pen_line(pen, pen->start.x, pen->start.y);
  pen->down = false;
}

/* ---- Curves -------------------------------------------------------------- */

struct cubic {
  struct judge_point2 p[4]; /* on the page */
  int halved;               /* how often */
};

/* The length of the second difference of three control points. */
static double second_difference(struct judge_point2 a, struct judge_point2 b,
                                struct judge_point2 c) {
  return hypot(a.x - 2 * b.x + c.x, a.y - 2 * b.y + c.y);
}

/* The number of segments n for the tolerance.  A chord over 1 / n of the
 * parameter range is off by at most max |curve''| / (8 n^2), and |curve''| is
 * at most 6 times the larger second difference of the control points. */
static double pieces_of(const struct cubic *c) {
  double bent = fmax(second_difference(c->p[0], c->p[1], c->p[2]),
                     second_difference(c->p[1], c->p[2], c->p[3]));
  return ceil(sqrt(bent * 6 / (8 * TOLERANCE_CURVE_MM)));
}

static double bernstein(double a, double b, double c, double d, double t) {
  double s = 1 - t;
  return s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d;
}

static struct judge_point2 middle(struct judge_point2 a,
                                  struct judge_point2 b) {
  return (struct judge_point2){a.x / 2 + b.x / 2, a.y / 2 + b.y / 2};
}

/* Splits a curve in two (de Casteljau); the first half replaces it. */
static struct cubic halve(struct cubic *c) {
  struct judge_point2 ab = middle(c->p[0], c->p[1]),
                      bc = middle(c->p[1], c->p[2]),
                      cd = middle(c->p[2], c->p[3]);
  struct judge_point2 abc = middle(ab, bc), bcd = middle(bc, cd);
  struct judge_point2 at = middle(abc, bcd);
  int halved = c->halved + 1;
  struct cubic second = {{at, bcd, cd, c->p[3]}, halved};
  *c = (struct cubic){{c->p[0], ab, abc, at}, halved};
  return second;
}

/* Whether all control points are outside one border of the page with its
 * margin. */
static bool is_off_page(const struct svg_pen *pen, const struct cubic *c) {
  double right = pen->drawing->width_mm + MARGIN_MM;
  double top = pen->drawing->height_mm + MARGIN_MM;
  unsigned beyond = 15;
  for (int i = 0; i < 4; i++)
    beyond &= (c->p[i].x < -MARGIN_MM ? 1u : 0) | (c->p[i].x > right ? 2u : 0) |
              (c->p[i].y < -MARGIN_MM ? 4u : 0) | (c->p[i].y > top ? 8u : 0);
  return beyond != 0;
}

static void draw_pieces(struct svg_pen *pen, const struct cubic *c, int n) {
  const struct judge_point2 *p = c->p;
  size_t before = pen->drawing->point.count, stored;
  for (int i = 1; i < n && pen->fault == NULL; i++) {
    double t = (double)i / n;
    draw_to(pen, (struct judge_point2){
                     bernstein(p[0].x, p[1].x, p[2].x, p[3].x, t),
                     bernstein(p[0].y, p[1].y, p[2].y, p[3].y, t)});
  }
  if (pen->fault == NULL)
    draw_to(pen, p[3]);
  stored = pen->drawing->point.count - before;
  if (stored > *pen->pieces && pen->fault == NULL)
    pen->fault = "curves that take too many pieces";
  *pen->pieces -= stored < *pen->pieces ? stored : *pen->pieces;
}

/* A curve that needs halving is halved until it needs only a few segments, so
 * that parts outside the page are found early. */
static void draw_cubic(struct svg_pen *pen, struct cubic curve) {
  enum { MOST = 1000, FEW = 16, HALVINGS = 64 };
  struct cubic rest[HALVINGS + 1];
  int left = 0;
  rest[left++] = curve;
  while (left > 0 && pen->fault == NULL && !pen->out_of_memory) {
    struct cubic *c = &rest[left - 1];
    double n = pieces_of(c), most = c->halved == 0 ? MOST : FEW;
    if (n > most && c->halved < HALVINGS && !is_off_page(pen, c)) {
      struct cubic second = halve(c);
      rest[left++] = *c;
      rest[left - 2] = second;
    } else {
      left--;
      draw_pieces(pen, c, n > 1 && n <= most ? (int)n : 1);
    }
  }
}

void svg_pen_curve(struct svg_pen *pen, struct judge_point2 b,
                   struct judge_point2 c, struct judge_point2 d) {
  struct cubic curve = {.halved = 0};
  lower_pen(pen);
  curve.p[0] = svg_apply(&pen->to_page, pen->here.x, pen->here.y);
  curve.p[1] = svg_apply(&pen->to_page, b.x, b.y);
  curve.p[2] = svg_apply(&pen->to_page, c.x, c.y);
  curve.p[3] = svg_apply(&pen->to_page, d.x, d.y);
  pen->here = d;
  for (int i = 0; i < 4 && pen->fault == NULL; i++)
    (void)is_finite_point(pen, curve.p[i]);
  if (pen->fault == NULL)
    draw_cubic(pen, curve);
}
