/* dash.c - splits lines into dashes as geometry, since plotters have no dashed
 * pens.
 *
 * Dashing starts anew at each corner of a line, so that every edge of a box
 * begins and ends with ink.  The number of dashes is the one that brings their
 * length nearest to the requested one; the difference is spread over all of
 * them. */
#include <math.h>

#include "ink/lines/stroke.h"

/* A position on a line: on the side that leaves point `side`, whose start is
 * `start` mm along the line. */
struct cursor {
  const struct stroke_line *line;
  size_t side;
  double start;
};

static struct drawing_point corner(const struct stroke_line *line, size_t i) {
  return line->point.item[i < line->point.count ? i : 0];
}

static double side_length(const struct cursor *c) {
  return drawing_distance(corner(c->line, c->side),
                          corner(c->line, c->side + 1));
}

/* The number of sides, including the closing one. */
static size_t count_line_sides(const struct stroke_line *line) {
  return line->point.count - !line->closed;
}

static struct drawing_point point_along(const struct cursor *c, double along) {
  struct drawing_point a = corner(c->line, c->side);
  struct drawing_point b = corner(c->line, c->side + 1);
  double length = side_length(c);
  double t = length > 0 ? (along - c->start) / length : 0;
  t = t < 0 ? 0 : t > 1 ? 1 : t;
  return (struct drawing_point){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

static void go_to_next_side(struct cursor *c) {
  c->start += side_length(c);
  c->side++;
}

/* Advances while the side ends at or before `along`. */
static void skip_sides(struct cursor *c, double along) {
  while (c->side + 1 < count_line_sides(c->line) &&
         c->start + side_length(c) <= along)
    go_to_next_side(c);
}

/* Stores the part of the line between two positions in `piece` and advances the
 * cursor to its end. */
static bool cut_piece(struct cursor *c, double from, double to,
                      struct stroke_line *piece) {
  piece->point.count = 0;
  skip_sides(c, from);
  if (!ARRAY_PUSH(&piece->point, point_along(c, from)))
    return false;
  while (c->side + 1 < count_line_sides(c->line) &&
         c->start + side_length(c) < to) {
    go_to_next_side(c);
    if (!ARRAY_PUSH(&piece->point, corner(c->line, c->side)))
      return false;
  }
  return ARRAY_PUSH(&piece->point, point_along(c, to));
}

/* The number of dashes, each followed by a gap, for that length. */
static double count_dashes(double length, double dash, double gap) {
  double n = floor(length / (dash + gap) + 0.5);
  return n < 2 ? 2 : n;
}

/* Dashes a line without corners. */
static bool add_dashes(struct drawing *drawing,
                       const struct drawing_stroke *like,
                       const struct stroke_line *line, double dash,
                       double gap) {
  double length = stroke_line_length(line);
  /* An open line lacks the last gap; with it, it is periodic too. */
  double period = line->closed ? length : length + gap;
  if (period < 4 * gap)
    return stroke_add(drawing, like, line->point.item, line->point.count,
                      line->closed);
  struct cursor cursor = {.line = line};
  struct stroke_line piece = {0};
  double n = count_dashes(period, dash, gap);
  bool ok = true;
  for (double i = 0; ok && i < n; i++) {
    double from = i * period / n, to = (i + 1) * period / n - gap;
    ok = cut_piece(&cursor, from, to, &piece);
    if (ok && !line->closed && i + 1 == n) /* the very end, unrounded */
      piece.point.item[piece.point.count - 1] =
          line->point.item[line->point.count - 1];
    ok = ok &&
         stroke_add(drawing, like, piece.point.item, piece.point.count, false);
  }
  ARRAY_FREE(&piece.point);
  return ok;
}

/* ---- Corners ------------------------------------------------------------- */

/* A line has a corner where it turns by more than 30 degrees (the cosine of
 * which this is): a box has corners, a circle of 16 sides has none. */
#define CORNER_COSINE 0.8660254037844386

static bool is_line_corner(const struct stroke_line *line, size_t i) {
  size_t count = line->point.count;
  struct drawing_point p = line->point.item[i > 0 ? i - 1 : count - 1];
  struct drawing_point q = line->point.item[i], r = corner(line, i + 1);
  double dot = (q.x - p.x) * (r.x - q.x) + (q.y - p.y) * (r.y - q.y);
  return dot < CORNER_COSINE * drawing_distance(p, q) * drawing_distance(q, r);
}

/* The next corner after point i, with indices that continue past the end of a
 * loop; without one, the end of the line or `end`. */
static size_t find_next_corner(const struct stroke_line *line, size_t i,
                               size_t end) {
  size_t count = line->point.count;
  for (i++; i < end && !is_line_corner(line, i % count); i++)
    continue;
  return i;
}

bool stroke_add_dashed(struct drawing *drawing,
                       const struct drawing_stroke *like,
                       const struct stroke_line *line, double dash,
                       double gap) {
  size_t count = line->point.count, first = 0, end = count - 1;
  if (line->closed) {
    while (first < count && !is_line_corner(line, first))
      first++;
    if (first == count)
      return add_dashes(drawing, like, line, dash, gap);
    end = first + count;
  }
  struct stroke_line piece = {0};
  bool ok = true;
  for (size_t i = first, next; ok && i < end; i = next) {
    next = find_next_corner(line, i, end);
    piece.point.count = 0;
    for (size_t k = i; ok && k <= next; k++)
      ok = ARRAY_PUSH(&piece.point, line->point.item[k % count]);
    ok = ok && add_dashes(drawing, like, &piece, dash, gap);
  }
  ARRAY_FREE(&piece.point);
  return ok;
}
