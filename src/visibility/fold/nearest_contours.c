/* nearest_contours.c - looks for contours in squares that grow about a point.
 *
 * How many entries the lists of a square's cells have is known by sums over all
 * cells below and to the left of each corner, so that an empty square takes no
 * time, and a crowded one is not looked at before smaller ones. */
#include "visibility/fold/nearest_contours.h"

#include <math.h>

#include "base/tolerance.h"
#include "geom/vector.h"
#include "view/project.h"

/* Half of the side of the first square, and the entries that it may have if it
 * is larger than a cell. */
#define FIRST_REACH (16 * TOLERANCE_OUTLINE_UNITS)

/* How far to the right of a line a contour of its surface may be, besides what
 * it bulges: the mesh is uneven. */
#define BEYOND (4 * TOLERANCE_OUTLINE_UNITS)
enum { FIRST_ENTRIES_MAX = 64 };

/* How far a contour may be from a line of its surface with a crease between, as
 * a share of the surface's faces: where these meet at the default crease angle
 * they are turned out of the line of sight by 15 degrees. */
#define BEYOND_CREASE_SHARE 0.25

/* A contour has a cusp where it turns back along itself, by more than 154
 * degrees. */
#define CUSP_COSINE 0.9

/* Contours that turn from an outline by more than 120 degrees are those of
 * another surface beside it. */
#define TURNED_COSINE (-0.5)

/* ---- Lists --------------------------------------------------------------- */

/* How far a contour is from the mesh on the page, grid units. */
static double bulge_of_contour(const struct nearest_contours *n,
                               uint32_t edge) {
  uint32_t i = edge - n->first;
  return i < n->bulges ? (double)n->bulge[i] : 0;
}

static bool list_near_contour(struct nearest_contours *n, uint32_t edge) {
  const uint32_t *point = n->sheet->edge.item[edge].point;
  for (int k = 0; k < 2; k++) {
    uint8_t *ends = &n->ends[point[k] - n->first_point];
    *ends = (uint8_t)(*ends + (*ends < 2));
  }
  n->bulge_most = fmax(n->bulge_most, bulge_of_contour(n, edge));
  return segment_grid_add(&n->contour, sheet_ends(n->sheet, point), edge);
}

static bool list_line(struct nearest_contours *n, uint32_t edge) {
  const struct sheet_edge *e = &n->sheet->edge.item[edge];
  bool is_crease =
      (e->edge_class & (RECTO_EDGE_CREASE | RECTO_EDGE_GROUP)) != 0;
  return segment_grid_add(is_crease ? &n->crease : &n->line,
                          sheet_ends(n->sheet, e->point), edge);
}

static bool list_visible(struct nearest_contours *n) {
  for (uint32_t e = 0; e < n->sheet->edge.count; e++)
    if (n->map->edge_state[e] != MAP_HIDDEN &&
        sheet_edge_is_drawn(n->sheet, e) &&
        !(e < n->first ? list_line(n, e) : list_near_contour(n, e)))
      return false;
  return true;
}

/* The point of one of two edges of a curve that they have in common;
 * SHEET_NONE: none. */
static uint32_t common_point(const uint32_t a[2], const uint32_t b[2]) {
  if (a[0] == b[0] || a[0] == b[1])
    return a[0];
  return a[1] == b[0] || a[1] == b[1] ? a[1] : SHEET_NONE;
}

/* Whether a curve has a cusp at the point that two edges have in common. */
static bool has_cusp(const struct sheet *sheet, const uint32_t a[2],
                     const uint32_t b[2], uint32_t common) {
  const struct geom_point *all = sheet->point.item;
  struct geom_point at = all[common], p = all[a[a[0] == common]],
                    q = all[b[b[0] == common]];
  double px = (double)p.x - at.x, py = (double)p.y - at.y;
  double qx = (double)q.x - at.x, qy = (double)q.y - at.y;
  return px * qx + py * qy >
         CUSP_COSINE * vector2_length(px, py) * vector2_length(qx, qy);
}

/* Lets contours end at their cusps: there no line goes on to what is beyond. */
static void end_at_cusps(struct nearest_contours *n) {
  const uint8_t *state = n->map->edge_state;
  for (uint32_t e = n->first; e + 1 < n->sheet->edge.count; e++) {
    const uint32_t *a = n->sheet->edge.item[e].point;
    const uint32_t *b = n->sheet->edge.item[e + 1].point;
    uint32_t at = common_point(a, b);
    if (at != SHEET_NONE && state[e] != MAP_HIDDEN &&
        state[e + 1] != MAP_HIDDEN && n->ends[at - n->first_point] == 2 &&
        has_cusp(n->sheet, a, b, at))
      n->ends[at - n->first_point] = 1;
  }
}

static bool list_by_cells(struct segment_grid *grid) {
  grid->contours = grid->segment.count;
  return grid->contours == 0 || segment_grid_make(grid);
}

/* Sums the lengths of the lists. */
static bool sum_lists(struct nearest_contours *n) {
  const struct triangle_grid *cell = &n->contour.cell;
  size_t columns = (size_t)cell->columns + 1, rows = (size_t)cell->rows + 1;
  if (n->contour.contours == 0)
    return true;
  n->sum = mem_calloc(columns * rows, sizeof *n->sum);
  for (size_t y = 1; n->sum != NULL && y < rows; y++) {
    uint32_t row = 0;
    for (size_t x = 1; x < columns; x++) {
      size_t i = (y - 1) * (columns - 1) + x - 1;
      row += cell->lists.start[i + 1] - cell->lists.start[i];
      n->sum[y * columns + x] = n->sum[(y - 1) * columns + x] + row;
    }
  }
  return n->sum != NULL;
}

bool nearest_contours_init(struct nearest_contours *nearest) {
  nearest->ends =
      mem_calloc(nearest->sheet->point.count - nearest->first_point, 1);
  if (nearest->ends == NULL || !list_visible(nearest))
    return false;
  if (nearest->cusps)
    end_at_cusps(nearest);
  return list_by_cells(&nearest->contour) && list_by_cells(&nearest->line) &&
         list_by_cells(&nearest->crease) && sum_lists(nearest);
}

void nearest_contours_fini(struct nearest_contours *nearest) {
  segment_grid_fini(&nearest->contour);
  segment_grid_fini(&nearest->line);
  segment_grid_fini(&nearest->crease);
  mem_free(nearest->sum);
  mem_free(nearest->ends);
}

/* ---- Segments ------------------------------------------------------------ */

/* Whether a contour only ends at a point. */
static bool is_loose_end(const struct nearest_contours *n, uint32_t point) {
  return n->ends[point - n->first_point] < 2;
}

/* How far a segment is from a point at least, to less than a unit. */
static inline double least_distance(const struct page_segment *s,
                                    struct geom_point p) {
  struct box2 box = box2_of_segment(s->p, s->q);
  double x = max_number(box.x0 - (double)p.x, p.x - (double)box.x1);
  double y = max_number(box.y0 - (double)p.y, p.y - (double)box.y1);
  return max_number(x, y) - 1;
}

/* Whether a contour is surely no nearer than the nearest points so far, of all
 * that it may change. */
static inline bool is_farther(const struct nearest_contours *n,
                              const struct page_segment *s, struct geom_point p,
                              const struct nearest_contour *best) {
  const uint32_t *ends = n->sheet->edge.item[s->owner].point;
  return least_distance(s, p) > best->any && !is_loose_end(n, ends[0]) &&
         !is_loose_end(n, ends[1]);
}

/* The nearest point of a segment to one. */
struct segment_place {
  double x, y;   /* the segment */
  double px, py; /* the point, from where it begins */
  double t;      /* the place */
  double distance;
};

static inline struct segment_place
place_on_segment(const struct page_segment *s, struct geom_point p) {
  struct segment_place at = {(double)s->q.x - s->p.x,
                             (double)s->q.y - s->p.y,
                             (double)p.x - s->p.x,
                             (double)p.y - s->p.y,
                             0,
                             0};
  double t = (at.px * at.x + at.py * at.y) / (at.x * at.x + at.y * at.y);
  at.t = min_number(max_number(t, 0), 1);
  double x = at.px - at.t * at.x, y = at.py - at.t * at.y;
  at.distance = sqrt(x * x + y * y);
  return at;
}

/* Whether all of a contour lies to the right of a line, where the line's
 * surface is not, by more than the contour may bulge: it is another
 * surface's. */
static bool is_on_other_side(const struct nearest_contours *n,
                             const struct page_segment *s, struct geom_point p,
                             const double along[2]) {
  double most = BEYOND + bulge_of_contour(n, s->owner);
  double from =
      along[1] * ((double)s->p.x - p.x) - along[0] * ((double)s->p.y - p.y);
  double to =
      along[1] * ((double)s->q.x - p.x) - along[0] * ((double)s->q.y - p.y);
  return from > most && to > most;
}

/* Tries a contour, unless the surface lies on its other side. */
static void try_near_contour(const struct nearest_contours *n,
                             const struct page_segment *s, struct geom_point p,
                             const double along[2],
                             struct nearest_contour *best) {
  struct segment_place of = place_on_segment(s, p);
  double x = of.x, y = of.y, px = of.px, py = of.py, t = of.t;
  if (x * along[0] + y * along[1] < TURNED_COSINE * sqrt(x * x + y * y) ||
      is_on_other_side(n, s, p, along))
    return;
  const uint32_t *ends = n->sheet->edge.item[s->owner].point;
  if (is_loose_end(n, ends[0]))
    best->end = min_number(best->end, px * px + py * py);
  if (is_loose_end(n, ends[1]))
    best->end =
        min_number(best->end, (px - x) * (px - x) + (py - y) * (py - y));
  uint32_t point = ends[t > 0];
  if ((t == 0 || t == 1) && is_loose_end(n, point)) {
    if (of.distance < best->loose ||
        (of.distance == best->loose && s->owner > best->loose_edge)) {
      best->loose = of.distance;
      best->loose_at = t == 0 ? s->p : s->q;
      best->loose_point = point;
      best->loose_edge = s->owner;
    }
  } else if (of.distance < best->any ||
             (of.distance == best->any && s->owner > best->any_edge)) {
    best->any = of.distance;
    best->any_edge = s->owner;
    best->at = (struct geom_point){
        (int32_t)lrint(s->p.x + t * x), (int32_t)lrint(s->p.y + t * y),
        s->p.z + (int64_t)(t * (double)(s->q.z - s->p.z))};
  }
}

/* ---- Squares ------------------------------------------------------------- */

static struct cell_range cells_of_square(const struct segment_grid *grid,
                                         struct geom_point p, int32_t by) {
  return triangle_grid_cells(
      &grid->cell, (struct box2){p.x - by, p.y - by, p.x + by, p.y + by});
}

static uint32_t entries_in(const struct nearest_contours *n,
                           struct cell_range r) {
  size_t columns = (size_t)n->contour.cell.columns + 1;
  const uint32_t *low = n->sum + (size_t)r.y0 * columns;
  const uint32_t *high = n->sum + ((size_t)r.y1 + 1) * columns;
  return high[r.x1 + 1] - high[r.x0] - low[r.x1 + 1] + low[r.x0];
}

/* Half of the side of the first square. */
static int32_t first_reach(const struct nearest_contours *n,
                           struct geom_point p, double radius) {
  int32_t by = (int32_t)fmin(FIRST_REACH, radius);
  while (by >> n->contour.cell.shift > 0 &&
         entries_in(n, cells_of_square(&n->contour, p, by)) > FIRST_ENTRIES_MAX)
    by /= 2;
  return by;
}

static void look_in_square(struct nearest_contours *n, struct cell_range range,
                           struct geom_point p, const double along[2],
                           struct nearest_contour *best) {
  const struct number_lists *lists = &n->contour.cell.lists;
  if (entries_in(n, range) == 0)
    return;
  for (int y = range.y0; y <= range.y1; y++)
    for (int x = range.x0; x <= range.x1; x++) {
      size_t cell = triangle_grid_index(&n->contour.cell, x, y);
      n->compared += lists->start[cell + 1] - lists->start[cell];
      for (uint32_t i = lists->start[cell]; i < lists->start[cell + 1]; i++) {
        const struct page_segment *s = &n->contour.segment.item[lists->item[i]];
        if (!is_farther(n, s, p, best))
          try_near_contour(n, s, p, along, best);
      }
    }
}

struct nearest_contour nearest_contours_find(struct nearest_contours *nearest,
                                             struct geom_point p,
                                             const double along[2],
                                             double radius) {
  struct nearest_contour best = {
      .any = INFINITY, .loose = INFINITY, .end = INFINITY};
  if (nearest->contour.contours == 0)
    return best;
  int32_t most = (int32_t)ceil(radius), by = first_reach(nearest, p, radius);
  for (;; by = by < most / 2 ? 2 * by + 1 : most) {
    look_in_square(nearest, cells_of_square(&nearest->contour, p, by), p, along,
                   &best);
    best.reach = by;
    if (by == most || fmin(best.any, best.loose) <= by)
      return best;
  }
}

bool nearest_contours_has_line(struct nearest_contours *nearest,
                               struct geom_point p) {
  enum { ABOUT = TOLERANCE_COINCIDENT_UNITS + 1 };
  const struct number_lists *lists = &nearest->line.cell.lists;
  if (nearest->line.contours == 0)
    return false;
  struct cell_range range = cells_of_square(&nearest->line, p, ABOUT);
  for (int y = range.y0; y <= range.y1; y++)
    for (int x = range.x0; x <= range.x1; x++) {
      size_t cell = triangle_grid_index(&nearest->line.cell, x, y);
      for (uint32_t i = lists->start[cell]; i < lists->start[cell + 1]; i++) {
        const struct page_segment *s =
            &nearest->line.segment.item[lists->item[i]];
        nearest->compared++;
        if (least_distance(s, p) <= TOLERANCE_COINCIDENT_UNITS &&
            place_on_segment(s, p).distance <= TOLERANCE_COINCIDENT_UNITS)
          return true;
      }
    }
  return false;
}

/* ---- Cover --------------------------------------------------------------- */

/* Whether a contour in front of a point covers it with its smooth surface, on
 * its left; no farther than it bulges, as the mesh does not.
 * beside  so far to its right the point may be instead */
static bool covers_point(const struct nearest_contours *n,
                         const struct page_segment *s, struct geom_point p,
                         double beside) {
  double most = TOLERANCE_OUTLINE_UNITS + bulge_of_contour(n, s->owner);
  if (least_distance(s, p) > fmax(most, beside))
    return false;
  struct segment_place at = place_on_segment(s, p);
  const uint32_t *ends = n->sheet->edge.item[s->owner].point;
  bool is_inside = at.t > 0 && at.t < 1;
  bool is_left = geom_orient2d(s->p, s->q, p) > 0;
  return at.distance <= (is_left ? most : beside) &&
         (is_inside || !is_loose_end(n, ends[at.t > 0])) &&
         page_segment_depth(s, at.t) > (double)p.z;
}

bool nearest_contours_cover(struct nearest_contours *nearest,
                            struct geom_point p, double beside, double radius) {
  double most = TOLERANCE_OUTLINE_UNITS + nearest->bulge_most;
  struct segment_walk walk = segment_grid_near(
      &nearest->contour, p.x, p.y, fmin(fmax(most, beside), radius));
  const struct page_segment *s;
  while ((s = segment_walk_next(&walk)) != NULL) {
    nearest->compared++;
    if (covers_point(nearest, s, p, beside))
      return true;
  }
  return false;
}

/* ---- Between ------------------------------------------------------------- */

/* The depth of a place of a segment in front of the eye. */
static double depth_in_view(const struct projection *projection,
                            const struct page_segment *s, double t) {
  struct geom_point at = {
      (int32_t)lrint(s->p.x + t * ((double)s->q.x - s->p.x)),
      (int32_t)lrint(s->p.y + t * ((double)s->q.y - s->p.y)),
      (int64_t)page_segment_depth(s, t)};
  return unproject_point(projection, at).d;
}

/* Whether a line is farther behind a way, where they cross, than a length on
 * the page, grid units. */
static bool is_behind(const struct nearest_contours *n,
                      const struct page_segment *way, double s,
                      const struct page_segment *line, double t,
                      double length) {
  struct projection projection = projection_of(&n->sheet->camera);
  double d = depth_in_view(&projection, way, s);
  double per_unit = projection.units / (projection.perspective ? d : 1);
  return depth_in_view(&projection, line, t) > d + length / per_unit;
}

/* Whether a way crosses a line that is no farther than a length behind it. */
static bool crosses_line(struct nearest_contours *n,
                         const struct segment_grid *grid,
                         const struct page_segment *way, double length) {
  const struct number_lists *lists = &grid->cell.lists;
  double s, t;
  if (grid->contours == 0)
    return false;
  struct cell_range range =
      triangle_grid_cells(&grid->cell, box2_of_segment(way->p, way->q));
  for (int y = range.y0; y <= range.y1; y++)
    for (int x = range.x0; x <= range.x1; x++) {
      size_t cell = triangle_grid_index(&grid->cell, x, y);
      n->compared += lists->start[cell + 1] - lists->start[cell];
      for (uint32_t i = lists->start[cell]; i < lists->start[cell + 1]; i++) {
        const struct page_segment *line = &grid->segment.item[lists->item[i]];
        if (page_segments_cross(way, line, &s, &t) &&
            (length == INFINITY || !is_behind(n, way, s, line, t, length)))
          return true;
      }
    }
  return false;
}

bool nearest_contours_has_line_between(struct nearest_contours *nearest,
                                       struct geom_point p,
                                       struct geom_point q) {
  const struct page_segment way = {.p = p, .q = q};
  return crosses_line(nearest, &nearest->line, &way, INFINITY);
}

bool nearest_contours_is_beyond_crease(struct nearest_contours *nearest,
                                       struct geom_point p,
                                       const struct nearest_contour *near,
                                       double radius) {
  const struct page_segment way = {.p = p, .q = near->at};
  return near->any > BEYOND_CREASE_SHARE * radius &&
         crosses_line(nearest, &nearest->crease, &way, radius);
}
