/* dash.c - splits lines into dashes as geometry, since plotters have no dashed
 * pens.
 *
 * Dashing starts anew at each corner of a line, so that every edge of a box
 * begins and ends with ink, but where it continues a visible line: there a gap
 * shows where that one ends.  The pattern is repeated as often as brings the
 * longest dashes nearest to their length; the difference is spread over all of
 * these.  Gaps, and dashes that are shorter, such as dots, keep their lengths.
 * Source  [ISO128], part 21 */
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

/* ---- Fitting ------------------------------------------------------------- */

/* A pattern fitted to a line: repetition i begins at i * whole / times. */
struct fitted_pattern {
  struct dash_pattern pattern; /* the longest dashes as they are drawn */
  double whole, times;
  double dashes; /* how many; all are followed by a gap, but the last one of an
                    open line */
};

/* Fits a pattern to the length of a line.
 *   open    n repetitions and the first dash once more.  If that is one of the
 *           k longest ones, which become l long, and the rest of a repetition
 *           is r,
 *               length = n (k l + r) + l,
 *           so that a repetition is (k length + r) / (n k + 1)
 *   closed  n repetitions
 * Where a gap is wider than all dashes, all lengths are fitted alike.  There
 * are two dashes at least.  Returns false where the longest ones would be
 * shorter than a gap, and than half of what is requested. */
static bool fit_pattern(struct fitted_pattern *fitted,
                        const struct dash_pattern *pattern, double length,
                        bool closed) {
  double longest = 0, widest = 0, period = 0, k = 0;
  for (int i = 0; i < pattern->count; i += 2) {
    longest = fmax(longest, pattern->mm[i]);
    widest = fmax(widest, pattern->mm[i + 1]);
    period += pattern->mm[i] + pattern->mm[i + 1];
  }
  for (int i = 0; i < pattern->count; i += 2)
    k += pattern->mm[i] == longest;
  double first = pattern->mm[0], rest = period - k * longest;
  double n = floor((closed ? length : length - first) / period + 0.5);
  n = fmax(n, closed && pattern->count == 2 ? 2 : 1);
  *fitted = (struct fitted_pattern){.pattern = *pattern,
                                    .whole = closed ? length : length - first,
                                    .times = n,
                                    .dashes = n * pattern->count / 2 + !closed};
  if (widest > longest) {
    fitted->whole = period * length;
    fitted->times = n * period + (closed ? 0 : first);
    for (int i = 0; i < pattern->count; i++)
      fitted->pattern.mm[i] *= length / fitted->times;
    return length >= fitted->times / 2;
  }
  if (!closed && first == longest) {
    fitted->whole = k * length + rest;
    fitted->times = n * k + 1;
  }
  double drawn = (fitted->whole / fitted->times - rest) / k;
  for (int i = 0; i < pattern->count; i += 2)
    if (pattern->mm[i] == longest)
      fitted->pattern.mm[i] = drawn;
  return drawn >= fmin(widest, longest / 2);
}

/* ---- Dashes -------------------------------------------------------------- */

/* Dashes a line without corners that begins and ends with a dash. */
static bool add_dashes_and_gaps(struct drawing *drawing,
                                const struct drawing_stroke *like,
                                const struct stroke_line *line,
                                const struct dash_pattern *pattern) {
  struct fitted_pattern fitted;
  if (!fit_pattern(&fitted, pattern, stroke_line_length(line), line->closed))
    return stroke_add(drawing, like, line->point.item, line->point.count,
                      line->closed);
  struct cursor cursor = {.line = line};
  struct stroke_line piece = {0};
  double repetition = 0, from = 0;
  bool ok = true;
  for (double i = 0; ok && i < fitted.dashes; i++) {
    int at = (int)fmod(2 * i, pattern->count);
    const double *mm = &fitted.pattern.mm[at];
    bool is_last = !line->closed && i + 1 == fitted.dashes;
    /* Gaps end where the next dash begins, which for the last of a repetition
     * does not add up the errors of all before it. */
    double next = from + mm[0] + mm[1];
    if (at + 2 == pattern->count)
      next = ++repetition * fitted.whole / fitted.times;
    ok = cut_piece(&cursor, from, next - mm[1], &piece);
    if (ok && is_last) /* the very end, unrounded */
      piece.point.item[piece.point.count - 1] =
          line->point.item[line->point.count - 1];
    ok = ok &&
         stroke_add(drawing, like, piece.point.item, piece.point.count, false);
    if (ok && !like->hidden && !is_last)
      ok = cut_piece(&cursor, next - mm[1], next, &piece) &&
           stroke_add_dropped(drawing, like, piece.point.item,
                              piece.point.count, false);
    from = next;
  }
  ARRAY_FREE(&piece.point);
  return ok;
}

/* Dashes a line without corners.  Where a gap comes before the first dash or
 * after the last, it is as long as the dash that is left at most. */
static bool add_dashes(struct drawing *drawing,
                       const struct drawing_stroke *like,
                       const struct stroke_line *line,
                       const struct dash_pattern *pattern) {
  const bool *at = line->is_continued;
  if (line->closed || !(at[0] || at[1]))
    return add_dashes_and_gaps(drawing, like, line, pattern);
  struct cursor cursor = {.line = line};
  struct stroke_line inner = {0};
  double length = stroke_line_length(line);
  double gap =
      fmin(pattern->mm[pattern->count - 1], length / (1 + at[0] + at[1]));
  bool ok = cut_piece(&cursor, at[0] ? gap : 0, at[1] ? length - gap : length,
                      &inner);
  if (ok && !at[1]) /* the very end, unrounded */
    inner.point.item[inner.point.count - 1] =
        line->point.item[line->point.count - 1];
  ok = ok && add_dashes_and_gaps(drawing, like, &inner, pattern);
  ARRAY_FREE(&inner.point);
  return ok;
}

/* ---- Corners ------------------------------------------------------------- */

bool stroke_turns_sharply(struct drawing_point p, struct drawing_point q,
                          struct drawing_point r) {
  const double cosine = 0.8660254037844386; /* of 30 degrees */
  double dot = (q.x - p.x) * (r.x - q.x) + (q.y - p.y) * (r.y - q.y);
  return dot < cosine * drawing_distance(p, q) * drawing_distance(q, r);
}

static bool is_line_corner(const struct stroke_line *line, size_t i) {
  size_t count = line->point.count;
  return stroke_turns_sharply(line->point.item[i > 0 ? i - 1 : count - 1],
                              line->point.item[i], corner(line, i + 1));
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
                       const struct stroke_line *line,
                       const struct dash_pattern *pattern) {
  size_t count = line->point.count, first = 0, end = count - 1;
  if (line->closed) {
    while (first < count && !is_line_corner(line, first))
      first++;
    if (first == count)
      return add_dashes(drawing, like, line, pattern);
    end = first + count;
  }
  struct stroke_line piece = {0};
  bool ok = true;
  for (size_t i = first, next; ok && i < end; i = next) {
    next = find_next_corner(line, i, end);
    piece.point.count = 0;
    piece.is_continued[0] = line->is_continued[0] && i == first;
    piece.is_continued[1] = line->is_continued[1] && next == end;
    for (size_t k = i; ok && k <= next; k++)
      ok = ARRAY_PUSH(&piece.point, line->point.item[k % count]);
    ok = ok && add_dashes(drawing, like, &piece, pattern);
  }
  ARRAY_FREE(&piece.point);
  return ok;
}
