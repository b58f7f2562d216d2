/* clearance.c - finds ink near a point by a uniform grid of short pieces.
 *
 * Invariants  A piece is at most half a cell long and is listed in the cell of
 *   its middle.  The reach is at most half a cell.  So the pieces within reach
 *   of a point, or of a part of a stroke of at most clearance_step, are in the
 *   3 x 3 cells about it. */
#include "ink/curve/clearance.h"

#include <math.h>

#include "base/poll.h"
#include "geom/nearest.h"

enum { CELLS_A_SIDE_MAX = 1 << 11 };

struct clearance_piece {
  struct drawing_point from, to, middle;
  double half;  /* of its length, mm */
  double along; /* of its middle, mm from the stroke's first point */
  uint32_t stroke;
};

/* ---- Pieces -------------------------------------------------------------- */

typedef bool visit_piece(void *user, const struct clearance_piece *piece);

static bool cut_stroke_side(struct drawing_point a, struct drawing_point b,
                            double longest, double along, uint32_t stroke,
                            visit_piece *visit, void *user) {
  double length = drawing_distance(a, b);
  uint32_t pieces = (uint32_t)fmax(1, ceil(length / longest));
  bool ok = true;
  for (uint32_t k = 0; ok && k < pieces; k++) {
    struct clearance_piece piece = {
        .from = drawing_point_between(a, b, k / (double)pieces),
        .to = drawing_point_between(a, b, (k + 1) / (double)pieces),
        .middle = drawing_point_between(a, b, (k + 0.5) / pieces),
        .half = length / pieces / 2,
        .along = along + length * (k + 0.5) / pieces,
        .stroke = stroke};
    ok = visit(user, &piece);
  }
  return ok;
}

/* Cuts all strokes into pieces of at most `longest` mm. */
static bool cut_strokes(const struct drawing *drawing, double longest,
                        visit_piece *visit, void *user) {
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    const struct drawing_point *point = drawing->point.item + stroke->point;
    uint32_t sides = stroke->count - !stroke->closed;
    double along = 0;
    if (!poll_at(i))
      return false;
    for (uint32_t k = 0; stroke->count > 0 && k < sides; k++) {
      struct drawing_point a = point[k], b = point[(k + 1) % stroke->count];
      if (!cut_stroke_side(a, b, longest, along, (uint32_t)i, visit, user))
        return false;
      along += drawing_distance(a, b);
    }
  }
  return true;
}

/* ---- The grid ------------------------------------------------------------ */

static uint32_t cell_index(double at, double low, double cell, uint32_t cells) {
  double index = floor((at - low) / cell);
  return index < 0 ? 0 : index < cells ? (uint32_t)index : cells - 1;
}

/* The cell of a piece's middle.  Those outside the grid are in the cells at its
 * border, which brings no two of them farther apart. */
static uint32_t find_cell(const struct clearance *c,
                          const struct clearance_piece *piece) {
  return cell_index(piece->middle.y, c->low[1], c->cell, c->rows) * c->columns +
         cell_index(piece->middle.x, c->low[0], c->cell, c->columns);
}

static bool count_piece(void *user, const struct clearance_piece *piece) {
  struct clearance *c = user;
  if (c->start[c->columns * c->rows] == UINT32_MAX)
    return false;
  c->start[find_cell(c, piece)]++;
  c->start[c->columns * c->rows]++;
  return true;
}

static bool list_piece(void *user, const struct clearance_piece *piece) {
  struct clearance *c = user;
  c->piece[--c->start[find_cell(c, piece)]] = *piece;
  return true;
}

bool clearance_init(struct clearance *c, const struct drawing *drawing,
                    double reach, double apart) {
  double side = fmax(drawing->width_mm, drawing->height_mm);
  *c = (struct clearance){.reach = reach, .apart = apart};
  c->cell = fmax(2 * reach, side / CELLS_A_SIDE_MAX);
  c->columns = (uint32_t)fmax(1, ceil(drawing->width_mm / c->cell));
  c->rows = (uint32_t)fmax(1, ceil(drawing->height_mm / c->cell));
  size_t cells = (size_t)c->columns * c->rows;
  c->start = mem_calloc(cells + 1, sizeof *c->start);
  if (c->start == NULL || !cut_strokes(drawing, c->cell / 2, count_piece, c))
    return false;
  c->piece = mem_alloc(c->start[cells], sizeof *c->piece);
  if (c->piece == NULL)
    return false;
  for (size_t i = 1; i < cells; i++)
    c->start[i] += c->start[i - 1];
  return cut_strokes(drawing, c->cell / 2, list_piece, c);
}

void clearance_fini(struct clearance *c) {
  mem_free(c->start);
  mem_free(c->piece);
  *c = (struct clearance){0};
}

double clearance_step(const struct clearance *c) { return c->cell / 2; }

/* ---- Searching ----------------------------------------------------------- */

/* Whether the piece is other ink for that place. */
static bool is_other(const struct clearance *c,
                     const struct clearance_piece *piece,
                     const struct clearance_place *place) {
  if (piece->stroke != place->stroke)
    return true;
  double ahead =
      remainder(piece->along - (place->start + place->along), place->whole);
  double along = place->along + ahead;
  return fabs(ahead) > c->apart || along < place->low || along > place->high;
}

/* The parameter, 0 to 1, of the point of the segment a b that is nearest to
 * p. */
static double nearest_parameter(struct drawing_point a, struct drawing_point b,
                                struct drawing_point p) {
  return geom_nearest_parameter(b.x - a.x, b.y - a.y, p.x - a.x, p.y - a.y);
}

static double distance_of_segment(struct drawing_point a,
                                  struct drawing_point b,
                                  struct drawing_point p) {
  return drawing_distance(
      drawing_point_between(a, b, nearest_parameter(a, b, p)), p);
}

/* A search about a part of a stroke. */
struct ink_search {
  struct drawing_point from, to; /* the part */
  struct clearance_place middle; /* of it */
  double half;                   /* of its length, mm */
  double within; /* mm: ink farther from the part does not matter */
  double t;      /* of the part's place nearest to ink so far */
  double touch;
};

static struct ink_search search_about(const struct clearance_part *part,
                                      double within) {
  struct ink_search search = {
      .from = part->from.at, .to = part->to.at, .within = within};
  search.middle = part->from;
  search.middle.at = drawing_point_between(search.from, search.to, 0.5);
  search.middle.along = (part->from.along + part->to.along) / 2;
  search.half = drawing_distance(search.from, search.to) / 2;
  return search;
}

typedef void take_piece(struct ink_search *search,
                        const struct clearance_piece *piece);

static bool may_matter(const struct ink_search *search,
                       const struct clearance_piece *piece) {
  double dx = piece->middle.x - search->middle.at.x;
  double dy = piece->middle.y - search->middle.at.y;
  double most = search->within + search->half + piece->half;
  return dx * dx + dy * dy <= most * most;
}

/* Calls `take` for the other ink in the 3 x 3 cells about the part. */
static void search_ink(const struct clearance *c, struct ink_search *search,
                       take_piece *take) {
  struct drawing_point at = search->middle.at;
  uint32_t column = cell_index(at.x, c->low[0], c->cell, c->columns);
  uint32_t row = cell_index(at.y, c->low[1], c->cell, c->rows);
  uint32_t left = column > 0 ? column - 1 : 0, right = column + 1;
  right = right < c->columns ? right : c->columns - 1;
  for (uint32_t y = row > 0 ? row - 1 : 0; y <= row + 1 && y < c->rows; y++) {
    uint32_t end = c->start[y * c->columns + right + 1];
    for (uint32_t k = c->start[y * c->columns + left]; k < end; k++)
      if (may_matter(search, &c->piece[k]) &&
          is_other(c, &c->piece[k], &search->middle))
        take(search, &c->piece[k]);
  }
}

/* ---- Distances ----------------------------------------------------------- */

static double area_beside(struct drawing_point o, struct drawing_point a,
                          struct drawing_point b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/* The parameter on a b of its crossing with c d; negative: they do not
 * cross. */
static double crossing_parameter(struct drawing_point a, struct drawing_point b,
                                 struct drawing_point c,
                                 struct drawing_point d) {
  double p = area_beside(c, d, a), q = area_beside(c, d, b);
  double r = area_beside(a, b, c), s = area_beside(a, b, d);
  bool do_cross = (p > 0) != (q > 0) && (r > 0) != (s > 0);
  return do_cross ? p / (p - q) : -1;
}

static void take_nearer(struct ink_search *search, double t, double distance) {
  if (distance < search->within) {
    search->within = distance;
    search->t = t;
  }
}

static void take_nearest(struct ink_search *search,
                         const struct clearance_piece *piece) {
  struct drawing_point a = search->from, b = search->to;
  struct drawing_point c = piece->from, d = piece->to;
  double t = crossing_parameter(a, b, c, d);
  double at_c = nearest_parameter(a, b, c), at_d = nearest_parameter(a, b, d);
  if (t >= 0)
    take_nearer(search, t, 0);
  take_nearer(search, 0, distance_of_segment(c, d, a));
  take_nearer(search, 1, distance_of_segment(c, d, b));
  take_nearer(search, at_c,
              drawing_distance(drawing_point_between(a, b, at_c), c));
  take_nearer(search, at_d,
              drawing_distance(drawing_point_between(a, b, at_d), d));
}

double clearance_of(const struct clearance *c,
                    const struct clearance_part *part, double *nearest) {
  struct ink_search search = search_about(part, c->reach);
  search_ink(c, &search, take_nearest);
  *nearest = search.t;
  return search.within;
}

/* ---- Slopes -------------------------------------------------------------- */

/* The slope to the piece from p, beside which the part begins, to q. */
static double find_slope(const struct ink_search *search,
                         struct drawing_point p, struct drawing_point q) {
  struct drawing_point own = {search->to.x - search->from.x,
                              search->to.y - search->from.y};
  struct drawing_point other = {q.x - p.x, q.y - p.y};
  double across = own.x * other.y - own.y * other.x;
  double along = own.x * other.x + own.y * other.y;
  return along > 0 ? fabs(across) / hypot(across, along) : 1;
}

/* Lowers the distance at the part's end that the slope so far gives. */
static void take_slope(struct ink_search *search,
                       const struct clearance_piece *piece) {
  double t = nearest_parameter(piece->from, piece->to, search->from);
  struct drawing_point foot = drawing_point_between(piece->from, piece->to, t);
  double length = 2 * search->half, slope = INFINITY;
  if (drawing_distance(foot, search->from) > search->touch) {
    take_nearest(search, piece);
    return;
  }
  if (drawing_distance(foot, piece->from) > search->touch)
    slope = fmin(slope, find_slope(search, foot, piece->from));
  if (drawing_distance(foot, piece->to) > search->touch)
    slope = fmin(slope, find_slope(search, foot, piece->to));
  search->within = fmin(search->within, slope * length);
}

double clearance_slope(const struct clearance *c,
                       const struct clearance_part *part, double touch) {
  struct ink_search search = search_about(part, INFINITY);
  search.touch = touch;
  search.within = 2 * search.half;
  search_ink(c, &search, take_slope);
  return search.half > 0 ? search.within / (2 * search.half) : 0;
}
