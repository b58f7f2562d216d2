/* svg_path.c - converts SVG path data and arcs to line segments.
 *
 * An arc becomes cubic curves of at most a quarter turn, with an error of at
 * most 3/10000 of its radius.
 * Source  SVG 1.1, appendix F.6, for the arc's centre. */
#include "judge/svg/svg_path.h"

#include <math.h>

/* ---- Arcs ---------------------------------------------------------------- */

/* An ellipse: its centre, its radii, and the direction of its x axis. */
struct ellipse {
  double x, y, rx, ry, cosine, sine;
};

static struct judge_point2 on_ellipse(const struct ellipse *e, double u,
                                      double v) {
  u *= e->rx;
  v *= e->ry;
  return (struct judge_point2){e->x + e->cosine * u - e->sine * v,
                               e->y + e->sine * u + e->cosine * v};
}

/* Draws from angle `from` by `turn`, |turn| <= 2 pi, in the ellipse's own
 * circle. */
static void draw_arc(struct svg_pen *pen, const struct ellipse *e, double from,
                     double turn, struct judge_point2 to) {
  int n = (int)ceil(fabs(turn) / (acos(-1) / 2));
  n = n < 1 ? 1 : n;
  double step = turn / n, handle = 4.0 / 3 * tan(step / 4);
  for (int i = 0; i < n; i++) {
    double a = from + i * step, b = a + step;
    struct judge_point2 first =
        on_ellipse(e, cos(a) - handle * sin(a), sin(a) + handle * cos(a));
    struct judge_point2 second =
        on_ellipse(e, cos(b) + handle * sin(b), sin(b) - handle * cos(b));
    svg_pen_curve(pen, first, second,
                  i + 1 < n ? on_ellipse(e, cos(b), sin(b)) : to);
  }
}

/* The square of half the chord over the radius below which an arc is taken as
 * straight: with radii of 2^19 times its chord, on a page of 2 m, the error is
 * less than TOLERANCE_CURVE_MM, and the centre is too far away for doubles. */
#define STRAIGHT 0x1p-40

void svg_pen_arc(struct svg_pen *pen, double rx, double ry, double angle_deg,
                 bool large, bool sweep, struct judge_point2 to) {
  double angle = angle_deg / 180 * acos(-1);
  struct ellipse e = {0, 0, fabs(rx), fabs(ry), cos(angle), sin(angle)};
  struct judge_point2 from = pen->here;
  /* Half of the chord, in the ellipse's axes and then in its circle. */
  double hx = (from.x - to.x) / 2, hy = (from.y - to.y) / 2;
  double u = (e.cosine * hx + e.sine * hy) / e.rx;
  double v = (e.cosine * hy - e.sine * hx) / e.ry;
  double square = u * u + v * v;
  double times = isfinite(square) ? sqrt(square) : hypot(u, v);
  if (!(e.rx > 0 && e.ry > 0 && square > (large ? 0 : STRAIGHT) &&
        isfinite(times))) {
    svg_pen_line(pen, to.x, to.y);
    return;
  }
  if (square > 1) { /* the radii are too small and must be scaled up */
    e.rx *= times;
    e.ry *= times;
    u /= times;
    v /= times;
    square = 1;
  }
  /* The centre is on the perpendicular bisector of the chord. */
  double factor = sqrt((1 - square) / square) * (large != sweep ? 1 : -1);
  double cu = factor * v, cv = -factor * u;
  struct judge_point2 offset = on_ellipse(&e, cu, cv);
  e.x = (from.x + to.x) / 2 + offset.x;
  e.y = (from.y + to.y) / 2 + offset.y;
  double first = atan2(v - cv, u - cu), last = atan2(-v - cv, -u - cu);
  double turn = last - first;
  if (!isfinite(turn)) {
    svg_pen_line(pen, to.x, to.y);
    return;
  }
  if (sweep && turn < 0)
    turn += 2 * acos(-1);
  else if (!sweep && turn > 0)
    turn -= 2 * acos(-1);
  draw_arc(pen, &e, first, turn, to);
}

/* ---- Path data ----------------------------------------------------------- */

struct path {
  struct svg_pen *pen;
  struct svg_text data;
  char command; /* in capitals */
  bool relative;
  char before;                 /* the command before, in capitals */
  struct judge_point2 control; /* the last one of a curve before */
};

/* Reads numbers of a command. */
static bool numbers(struct path *path, double *value, int count) {
  for (int i = 0; i < count; i++)
    if (!svg_number(&path->data, &value[i]))
      return false;
  return true;
}

/* A flag of an arc is one digit, with or without a space behind it. */
static bool flag(struct path *path, bool *value) {
  svg_skip_spaces(&path->data);
  if (path->data.at == path->data.end ||
      (*path->data.at != '0' && *path->data.at != '1'))
    return false;
  *value = *path->data.at++ == '1';
  return true;
}

static struct judge_point2 page_point(const struct path *path, double x,
                                      double y) {
  struct judge_point2 here = path->pen->here;
  return path->relative ? (struct judge_point2){here.x + x, here.y + y}
                        : (struct judge_point2){x, y};
}

/* The control point of the previous curve, mirrored at the current position;
 * the current position where the previous command was no such curve. */
static struct judge_point2 mirrored(const struct path *path, char one,
                                    char other) {
  struct judge_point2 here = path->pen->here, c = path->control;
  if (path->before != one && path->before != other)
    return here;
  return (struct judge_point2){2 * here.x - c.x, 2 * here.y - c.y};
}

static void cubic(struct path *path, struct judge_point2 b,
                  struct judge_point2 c, struct judge_point2 d) {
  path->control = c;
  svg_pen_curve(path->pen, b, c, d);
}

/* Degree elevation: a quadratic curve is a cubic one whose control points are
 * two thirds of the way from either end to its control point. */
static void quadratic(struct path *path, struct judge_point2 b,
                      struct judge_point2 c) {
  struct judge_point2 a = path->pen->here;
  svg_pen_curve(path->pen,
                (struct judge_point2){(a.x + 2 * b.x) / 3, (a.y + 2 * b.y) / 3},
                (struct judge_point2){(c.x + 2 * b.x) / 3, (c.y + 2 * b.y) / 3},
                c);
  path->control = b;
}

static bool draw_line(struct path *path) {
  double v[2] = {0, 0};
  struct judge_point2 here = path->pen->here, to;
  bool across = path->command == 'H', along = path->command == 'V';
  if (!numbers(path, along ? &v[1] : v, across || along ? 1 : 2))
    return false;
  to = page_point(path, v[0], v[1]);
  svg_pen_line(path->pen, along ? here.x : to.x, across ? here.y : to.y);
  return true;
}

static bool draw_curve(struct path *path) {
  double v[6];
  int count = path->command == 'C' ? 6 : path->command == 'T' ? 2 : 4;
  if (!numbers(path, v, count))
    return false;
  struct judge_point2 end = page_point(path, v[count - 2], v[count - 1]);
  struct judge_point2 first = page_point(path, v[0], v[1]);
  if (path->command == 'C')
    cubic(path, first, page_point(path, v[2], v[3]), end);
  else if (path->command == 'S')
    cubic(path, mirrored(path, 'C', 'S'), first, end);
  else
    quadratic(path, path->command == 'Q' ? first : mirrored(path, 'Q', 'T'),
              end);
  return true;
}

static bool draw_arc_to(struct path *path) {
  double v[3], to[2];
  bool large, sweep;
  if (!numbers(path, v, 3) || !flag(path, &large) || !flag(path, &sweep) ||
      !numbers(path, to, 2))
    return false;
  svg_pen_arc(path->pen, v[0], v[1], v[2], large, sweep,
              page_point(path, to[0], to[1]));
  return true;
}

/* A move; pairs behind it are lines. */
static bool move(struct path *path) {
  double v[2];
  if (!numbers(path, v, 2))
    return false;
  struct judge_point2 to = page_point(path, v[0], v[1]);
  svg_pen_move(path->pen, to.x, to.y);
  return true;
}

/* Draws one command with one set of numbers. */
static bool draw_command(struct path *path) {
  switch (path->command) {
  case 'M':
    return move(path);
  case 'L':
  case 'H':
  case 'V':
    return draw_line(path);
  case 'C':
  case 'S':
  case 'Q':
  case 'T':
    return draw_curve(path);
  case 'A':
    return draw_arc_to(path);
  case 'Z':
    svg_pen_close(path->pen);
    return true;
  default:
    return false;
  }
}

/* Reads the next command, or repeats the previous one where numbers follow. */
static void next_command(struct path *path) {
  char c = *path->data.at;
  path->before = path->command;
  if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')) {
    path->relative = c >= 'a';
    path->command = path->relative ? (char)(c - 'a' + 'A') : c;
    path->data.at++;
  } else if (path->command == 'M') {
    path->command = 'L';
  } else if (path->command == 'Z') {
    path->command = '\0'; /* numbers have no meaning there */
  }
}

const char *svg_path(struct svg_pen *pen, struct svg_text data) {
  struct path path = {.pen = pen, .data = data};
  pen->here = pen->start = (struct judge_point2){0, 0};
  pen->down = false;
  for (svg_skip_spaces(&path.data); path.data.at < path.data.end;
       svg_skip_spaces(&path.data)) {
    if (pen->fault != NULL || pen->out_of_memory)
      break;
    next_command(&path);
    if (path.before == '\0' && path.command != 'M')
      return "a path that does not start with M";
    if (!draw_command(&path))
      return "a path with a broken command or number";
  }
  return pen->fault;
}
