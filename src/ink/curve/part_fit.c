/* part_fit.c - curves and lines in place of a smooth part of a stroke.
 *
 * As much of the part as one cubic fits is replaced by it, and what follows
 * goes on from there in the same direction.  Where that takes more characters
 * than lines do that hardly turn, or than the curves so far have saved, it is
 * replaced by lines, each in the place of as many sides as it fits.
 * Cost  near linear in the samples: the number of sides tried at once doubles
 *   until it fits no longer, and then is halved. */
#include "ink/curve/part_fit.h"

#include <math.h>

#include "base/tolerance.h"

/* Numbers of sides that are tried in vain before a curve is given up. */
enum { FAILURES_MAX = 3 };

/* The most sides that are tried at once, which bounds the time of a trial. */
enum { KNOTS_MAX = 1 << 11 };

/* Numbers up to that are counted digit by digit. */
#define NUMBER_MAX 100000

/* Lines are sought until they take so many times more characters than a
 * curve. */
enum { SAVED_RATIO = 2 };

/* How far about a knot its direction is looked for after a line, as a multiple
 * of the tolerance. */
#define LINE_DIRECTION 16

/* How far a line may be from sides in whose place a curve would fit, as a share
 * of the tolerance: where the two meet they hardly turn. */
#define LINE_SHARE 0.5

/* The most by which such a line may turn from what is before it, radians. */
#define LINE_TURN (1.0 / 64)

/* ---- Output -------------------------------------------------------------- */

static bool add_fitted_piece(struct part_fit *c,
                             const struct drawing_point piece[4]) {
  return ARRAY_PUSH(&c->drawing->control, piece[1]) &&
         ARRAY_PUSH(&c->drawing->control, piece[2]) &&
         ARRAY_PUSH(&c->drawing->control, piece[3]);
}

/* ---- Directions ---------------------------------------------------------- */

/* The unit vector from one point towards another one. */
static struct drawing_point unit_towards(struct drawing_point a,
                                         struct drawing_point b) {
  double length = drawing_distance(a, b);
  return length > 0 ? (struct drawing_point){(b.x - a.x) / length,
                                             (b.y - a.y) / length}
                    : (struct drawing_point){1, 0};
}

struct drawing_point part_fit_direction(const struct curve_samples *samples,
                                        const struct stroke_part *part,
                                        size_t at, double before,
                                        double after) {
  const struct fit_sample *sample = samples->sample.item, *here = &sample[at];
  double s2 = 0, s3 = 0, s4 = 0, x1 = 0, x2 = 0, y1 = 0, y2 = 0;
  size_t low = at, high = at;
  while (low > part->from && here->along - sample[low - 1].along <= before)
    low--;
  while (high < part->to && sample[high + 1].along - here->along <= after)
    high++;
  if (low == at && before > 0 && low > part->from) /* one at least */
    low--;
  if (high == at && after > 0 && high < part->to)
    high++;
  for (size_t i = low; i <= high; i++) {
    double s = sample[i].along - here->along;
    double x = sample[i].target.x - here->target.x;
    double y = sample[i].target.y - here->target.y;
    s2 += s * s;
    s3 += s * s * s;
    s4 += s * s * s * s;
    x1 += s * x;
    x2 += s * s * x;
    y1 += s * y;
    y2 += s * s * y;
  }
  double determinant = s2 * s4 - s3 * s3;
  struct drawing_point run = {x1, y1};
  if (determinant > TOLERANCE_PARABOLA_SHARE * s2 * s4)
    run = (struct drawing_point){s4 * x1 - s3 * x2, s4 * y1 - s3 * y2};
  return unit_towards((struct drawing_point){0, 0}, run);
}

static bool is_prescribed(struct drawing_point direction) {
  return direction.x != 0 || direction.y != 0;
}

/* ---- Trials -------------------------------------------------------------- */

/* A piece that was fitted, with its directions. */
struct fitted_piece {
  struct drawing_point control[4];
  struct drawing_point start, end; /* start is (0, 0): not prescribed */
  double line_tolerance; /* mm: how far a line may be from its sides */
};

static struct drawing_point last_direction(const struct fitted_piece *piece) {
  bool straight = drawing_piece_is_straight(piece->control);
  return unit_towards(piece->control[straight ? 0 : 2], piece->control[3]);
}

/* Fits a piece to the samples of a part from one knot to another one. */
typedef bool fit_piece(struct part_fit *c, const struct stroke_part *part,
                       size_t from, size_t to, struct fitted_piece *piece);

/* What is not prescribed follows from the piece's length: the longer it is, the
 * less may its ends follow the noise of single sides. */
static bool fit_curve(struct part_fit *c, const struct stroke_part *part,
                      size_t from, size_t to, struct fitted_piece *piece) {
  const struct fit_sample *sample = c->of.sample.item;
  double length = sample[to].along - sample[from].along;
  struct drawing_point start = piece->start;
  if (!is_prescribed(start))
    start = part_fit_direction(&c->of, part, from, 0, length / 2);
  if (to < part->to)
    piece->end = part_fit_direction(&c->of, part, to, length / 4, length / 4);
  else if (is_prescribed(part->end))
    piece->end = part->end;
  else
    piece->end = part_fit_direction(&c->of, part, to, length / 2, 0);
  const struct cubic_fit problem = {.sample = &sample[from],
                                    .samples = to - from + 1,
                                    .tolerance = c->tolerance,
                                    .start = start,
                                    .end = piece->end,
                                    .end_limit = c->of.limit.item[to]};
  if (!cubic_fit(&problem, c->parameter.item, piece->control))
    return false;
  if (to < part->to)
    piece->end = last_direction(piece);
  return true;
}

static bool fit_line(struct part_fit *c, const struct stroke_part *part,
                     size_t from, size_t to, struct fitted_piece *piece) {
  (void)part;
  const struct cubic_fit problem = {.sample = &c->of.sample.item[from],
                                    .samples = to - from + 1,
                                    .tolerance = piece->line_tolerance,
                                    .end_limit = c->of.limit.item[to]};
  return line_fit(&problem, c->parameter.item, piece->control);
}

/* The sample `knots` knots after `from`, but not past the end of the part; of a
 * curve, not past one where other ink is met; of a line, a vertex. */
static size_t find_knot(const struct part_fit *c,
                        const struct stroke_part *part, size_t from,
                        size_t knots, bool line) {
  const uint8_t *flags = c->of.flags.item;
  size_t i = from;
  while (knots > 0 && i < part->to) {
    i++;
    knots -= line ? flags[i] & CURVE_VERTEX : flags[i] != 0;
    if (!line && (flags[i] & CURVE_MEETING))
      break;
  }
  return i;
}

/* Finds the most knots after `from` that one piece passes.  Returns the last of
 * them; `from` where there is no piece. */
static size_t find_longest(struct part_fit *c, const struct stroke_part *part,
                           size_t from, bool line, struct fitted_piece *piece) {
  fit_piece *fit = line ? fit_line : fit_curve;
  struct fitted_piece trial = *piece;
  size_t best = from, good = 0, bad = 0, before = from;
  int failures = 0;
  for (size_t knots = 1; failures < FAILURES_MAX && knots <= KNOTS_MAX;
       knots *= 2) {
    size_t to = find_knot(c, part, from, knots, line);
    if (to == before)
      break;
    before = to;
    if (fit(c, part, from, to, &trial)) {
      *piece = trial;
      best = to;
      good = knots;
      bad = 0;
      failures = 0;
    } else {
      bad = failures++ == 0 ? knots : bad;
    }
  }
  while (good > 0 && bad > good + 1) {
    size_t knots = good + (bad - good) / 2;
    size_t to = find_knot(c, part, from, knots, line);
    if (to > best && fit(c, part, from, to, &trial)) {
      *piece = trial;
      best = to;
      good = knots;
    } else {
      bad = knots;
    }
  }
  return best;
}

static double turn_between(struct drawing_point a, struct drawing_point b) {
  return fabs(atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y));
}

/* How many sides of the stroke end between two samples. */
static size_t count_ended_sides(const struct part_fit *c, size_t from,
                                size_t to) {
  size_t sides = 0;
  for (size_t i = from + 1; i <= to; i++)
    sides += c->of.flags.item[i] & CURVE_VERTEX;
  return sides;
}

/* Replaces samples by the longest line.  Returns where that ends. */
static size_t find_line(struct part_fit *c, const struct stroke_part *part,
                        size_t from, struct fitted_piece *piece) {
  struct fit_sample *sample = c->of.sample.item;
  size_t to = find_longest(c, part, from, true, piece);
  if (to == from) {
    to = find_knot(c, part, from, 1, true);
    piece->control[0] = piece->control[1] = sample[from].target;
    piece->control[2] = piece->control[3] = sample[to].at;
  }
  return to;
}

/* ---- Bytes --------------------------------------------------------------- */

/* How many characters a number takes, with what separates it. */
static int count_number(double number) {
  long thousandths = lround(fmin(fabs(number), NUMBER_MAX) * 1000);
  long whole = thousandths / 1000, rest = thousandths % 1000;
  int characters = 1;
  for (; whole > 0; whole /= 10)
    characters++;
  if (rest > 0)
    characters += rest % 100 == 0 ? 2 : rest % 10 == 0 ? 3 : 4;
  return characters;
}

/* How many characters the points of a piece take in SVG. */
static int count_characters(const struct fitted_piece *piece) {
  const struct drawing_point *p = piece->control;
  int characters = 0;
  for (int k = drawing_piece_is_straight(p) ? 3 : 1; k < 4; k++)
    characters += count_number(p[k].x - p[0].x) + count_number(p[k].y - p[0].y);
  return characters;
}

/* The lines that could take the place of samples. */
struct line_cost {
  int characters;
  bool turns; /* they turn visibly, where they begin or between them */
};

/* Finds the lines in the place of samples of a part, until they take so many
 * characters.
 * start  the direction before them; (0, 0): none */
static struct line_cost find_lines(struct part_fit *c,
                                   const struct stroke_part *part, size_t from,
                                   size_t to, struct drawing_point start,
                                   int most) {
  struct line_cost cost = {0, false};
  struct fitted_piece piece = {.line_tolerance = LINE_SHARE * c->tolerance};
  for (size_t at = from, next; at < to && cost.characters <= most; at = next) {
    next = find_line(c, part, at, &piece);
    struct drawing_point run = {piece.control[3].x - piece.control[0].x,
                                piece.control[3].y - piece.control[0].y};
    cost.turns = cost.turns ||
                 (is_prescribed(start) && turn_between(start, run) > LINE_TURN);
    cost.characters += count_characters(&piece);
    start = run;
  }
  if (to == part->to && is_prescribed(part->end))
    cost.turns = cost.turns || turn_between(start, part->end) > LINE_TURN;
  return cost;
}

/* ---- The part ------------------------------------------------------------ */

/* Whether a curve is to take the place of samples up to `to`: lines are longer,
 * or they turn and the curves of the part save what it takes more.
 * saved  characters */
static bool is_worth_while(struct part_fit *c, const struct stroke_part *part,
                           size_t from, size_t to,
                           const struct fitted_piece *piece, int *saved) {
  int curve = count_characters(piece);
  struct line_cost lines =
      find_lines(c, part, from, to, piece->start, SAVED_RATIO * curve);
  if (!lines.turns && lines.characters <= curve)
    return false;
  if (lines.characters + *saved < curve)
    return false;
  *saved += lines.characters - curve;
  return true;
}

bool part_fit_add(struct part_fit *c, const struct stroke_part *part) {
  struct fit_sample *sample = c->of.sample.item;
  struct fitted_piece piece = {.start = part->start};
  double reach = LINE_DIRECTION * c->tolerance;
  size_t next;
  int saved = 0;
  bool ok = true;
  for (size_t at = part->from; ok && at < part->to; at = next) {
    next = part->straight ? at : find_longest(c, part, at, false, &piece);
    piece.line_tolerance = (next > at ? LINE_SHARE : 1) * c->tolerance;
    if (next > at && is_worth_while(c, part, at, next, &piece, &saved)) {
      c->has_curves = true;
    } else {
      next = find_line(c, part, at, &piece);
      c->has_curves = c->has_curves || count_ended_sides(c, at, next) > 1;
      piece.end = part_fit_direction(&c->of, part, next, reach, reach);
    }
    sample[next].target = piece.control[3];
    ok = add_fitted_piece(c, piece.control) &&
         ARRAY_PUSH(&c->along, sample[next].along);
    piece.start = piece.end;
  }
  return ok;
}
