/* fold_bridges.c - finds ends of contours that face each other.
 *
 * Contours have their surface on the left, so that a gap leads from an edge's
 * second point to another one's first. */
#include "visibility/fold/fold_bridges.h"

#include <math.h>

#include "base/poll.h"
#include "base/sort.h"
#include "geom/nearest.h"
#include "geom/vector.h"
#include "visibility/contour/occluders.h"
#include "visibility/contour/segment_grid.h"

/* The length of a gap, at most, as a multiple of the triangles' heights. */
#define BRIDGE_HEIGHTS 6

/* What faces each other turns by no more than 37 degrees, and folds that are
 * beside a gap by no more than 60. */
#define FACING_COSINE 0.8
#define BESIDE_COSINE 0.5

/* How far along a gap of more than a height its samples are from the folds
 * beside them, on average and as a share of its length, at most.  Where folds
 * end where the gap begins and ends, and none is beside it, that is a
 * quarter. */
#define BESIDE_SHARE 0.175

/* The share of a gap, at most, beside which the surface contradicts the
 * fold. */
#define CONTRADICTED_SHARE 0.5

/* The samples of a gap for each height of its triangles. */
enum { SAMPLES_A_HEIGHT = 4 };

/* What the points of contours are.  Where one passes behind another line, or
 * through a face, it is hidden from there on, and no gap begins. */
enum node_kind {
  NODE_NONE, /* something crosses the curve there */
  NODE_OF_CURVE,
  NODE_CUT /* the same, and a thin loop was left out there */
};

struct bridge_end {
  uint32_t point, edge;
  double x, y;
  double dx, dy; /* the direction of its contour, of unit length */
};

struct fold_bridges {
  const struct outline_gaps_input *in;
  const float *heights;
  uint8_t *degree; /* one a point of contours: visible ones there, at most 2 */
  uint8_t *node;   /* the same: an enum node_kind */
  ARRAY(struct bridge_end) start;
  ARRAY(struct bridge_end) stop;
  struct segment_grid grid; /* visible contours, and the mesh's outlines with
                               the owners from the number of edges on */
  uint32_t edges;           /* of the sheet, before any are added */
};

/* ---- Ends ---------------------------------------------------------------- */

static bool is_visible_contour(const struct fold_bridges *b, uint32_t edge) {
  return b->in->map->edge_state[edge] != MAP_HIDDEN;
}

/* Whether a gap may begin or end at a point: where a contour does, or, if
 * `at_cuts`, where one turns since a loop was left out, whose side led on. */
static bool is_open(const struct fold_bridges *b, uint32_t point,
                    bool at_cuts) {
  uint32_t at = point - b->in->first_point;
  return (b->degree[at] == 1 && b->node[at] != NODE_NONE) ||
         (at_cuts && b->node[at] == NODE_CUT);
}

static bool list_end(struct fold_bridges *b, uint32_t edge, int k) {
  const struct sheet *sheet = b->in->sheet;
  uint32_t point = sheet->edge.item[edge].point[k];
  struct geom_segment s = sheet_ends(sheet, sheet->edge.item[edge].point);
  double x = (double)s.q.x - s.p.x, y = (double)s.q.y - s.p.y;
  double length = vector2_length(x, y);
  if (!is_open(b, point, true) || length == 0)
    return true;
  struct geom_point at = k == 0 ? s.p : s.q;
  struct bridge_end end = {point, edge, at.x, at.y, x / length, y / length};
  return k == 0 ? ARRAY_PUSH(&b->start, end) : ARRAY_PUSH(&b->stop, end);
}

static int compare_bridge_ends(const void *a, const void *b, void *user) {
  const struct bridge_end *p = a, *q = b;
  (void)user;
  return (p->x > q->x) - (p->x < q->x);
}

static void mark_nodes(struct fold_bridges *b) {
  const struct zero_set *set = b->in->set;
  for (size_t i = 0; i < set->node.count; i++)
    if (set->node.item[i].sheet_point != SHEET_NONE)
      b->node[set->node.item[i].sheet_point - b->in->first_point] =
          set->node.item[i].is_cut ? NODE_CUT : NODE_OF_CURVE;
}

static bool list_bridge_ends(struct fold_bridges *b) {
  const struct sheet *sheet = b->in->sheet;
  b->degree = mem_calloc(sheet->point.count - b->in->first_point, 1);
  b->node = mem_calloc(sheet->point.count - b->in->first_point, 1);
  if (b->degree == NULL || b->node == NULL)
    return false;
  mark_nodes(b);
  for (uint32_t e = b->in->first; e < sheet->edge.count; e++)
    for (int k = 0; is_visible_contour(b, e) && k < 2; k++) {
      uint8_t *degree =
          &b->degree[sheet->edge.item[e].point[k] - b->in->first_point];
      *degree = (uint8_t)(*degree + (*degree < 2));
    }
  for (uint32_t e = b->in->first; e < b->in->first + b->in->bulges; e++)
    for (int k = 0; is_visible_contour(b, e) && k < 2; k++)
      if (!list_end(b, e, k))
        return false;
  return sort_stable(b->start.item, b->start.count, sizeof *b->start.item,
                     compare_bridge_ends, NULL);
}

/* ---- Gaps ---------------------------------------------------------------- */

/* The end that faces one; NULL: there is none.
 * at_cut  one of the two is where a loop was left out, and not both */
static const struct bridge_end *find_facing(const struct fold_bridges *b,
                                            const struct bridge_end *from,
                                            double height, bool at_cut) {
  bool to_cut = at_cut && is_open(b, from->point, false);
  double least = BRIDGE_HEIGHTS * height, reach = least;
  const struct bridge_end *best = NULL;
  size_t first = 0;
  LOWER_BOUND(first, 0, b->start.count,
              b->start.item[first].x < from->x - reach);
  for (size_t i = first;
       i < b->start.count && b->start.item[i].x <= from->x + reach; i++) {
    const struct bridge_end *to = &b->start.item[i];
    double x = to->x - from->x, y = to->y - from->y,
           length = vector2_length(x, y);
    if (length == 0 || length >= least || !is_open(b, to->point, to_cut) ||
        is_open(b, to->point, false) == to_cut ||
        x * from->dx + y * from->dy < FACING_COSINE * length ||
        x * to->dx + y * to->dy < FACING_COSINE * length)
      continue;
    least = length;
    best = to;
  }
  return best;
}

/* Lists contours and outlines; they are needed for the first gap only. */
static bool make_grid(struct fold_bridges *b) {
  const struct sheet *sheet = b->in->sheet;
  if (b->grid.contours > 0)
    return true;
  for (uint32_t e = b->in->first; e < b->edges; e++)
    if (is_visible_contour(b, e) &&
        !segment_grid_add(&b->grid,
                          sheet_ends(sheet, sheet->edge.item[e].point), e))
      return false;
  for (size_t i = 0; i < b->in->set->outline.count; i++)
    if (!segment_grid_add(&b->grid, b->in->set->outline.item[i].image,
                          b->edges + (uint32_t)i))
      return false;
  b->grid.contours = b->grid.segment.count;
  return segment_grid_make(&b->grid);
}

/* What runs beside a place of a gap. */
struct bridge_sides {
  double fold;    /* how far a visible fold is, grid units; INFINITY: none */
  double along;   /* how far that is in the direction of the gap */
  double contour; /* how far a visible contour is, not only an end of it */
  const struct contour_outline *outline; /* of the fold */
};

/* Looks at a segment; returns false when memory ran out. */
static bool look_beside(const struct fold_bridges *b,
                        const struct page_segment *s, const double at[2],
                        const double along[2], double height,
                        struct bridge_sides *sides) {
  double x = (double)s->q.x - s->p.x, y = (double)s->q.y - s->p.y;
  double px = at[0] - s->p.x, py = at[1] - s->p.y;
  double t = geom_nearest_parameter(x, y, px, py);
  double away = vector2_length(px - t * x, py - t * y);
  if (away > height ||
      x * along[0] + y * along[1] < BESIDE_COSINE * vector2_length(x, y))
    return true;
  if (s->owner < b->edges) {
    if (t > 0 && t < 1)
      sides->contour = fmin(sides->contour, away);
    return true;
  }
  if (away >= sides->fold)
    return true;
  struct geom_point p = {(int32_t)lrint(s->p.x + t * x),
                         (int32_t)lrint(s->p.y + t * y),
                         s->p.z + (int64_t)(t * (double)(s->q.z - s->p.z))};
  int count = occluders_count(b->in->sheet, b->in->grid, b->in->query, p, 1);
  if (count == 0) {
    sides->fold = away;
    sides->outline = &b->in->set->outline.item[s->owner - b->edges];
    sides->along = fabs((px - t * x) * along[0] + (py - t * y) * along[1]);
  }
  return count >= 0;
}

/* Returns false when memory ran out. */
static bool look_all_beside(const struct fold_bridges *b, const double at[2],
                            const double along[2], double height,
                            struct bridge_sides *sides) {
  struct segment_walk walk = segment_grid_near(&b->grid, at[0], at[1], height);
  const struct page_segment *s;
  while ((s = segment_walk_next(&walk)) != NULL)
    if (!look_beside(b, s, at, along, height, sides))
      return false;
  return true;
}

/* Whether the mesh folds over all along a gap, nearer to it than to any contour
 * that is drawn there, and a smooth surface that it samples does not deny that;
 * *ok is false when memory ran out. */
static bool is_along_folds(struct fold_bridges *b,
                           const struct bridge_end *from,
                           const struct bridge_end *to, double height,
                           bool *ok) {
  double x = to->x - from->x, y = to->y - from->y,
         length = vector2_length(x, y);
  const double along[2] = {x / length, y / length};
  int samples = (int)ceil(SAMPLES_A_HEIGHT * length / height);
  int contradicted = 0;
  struct curvature_squares curvature = {.known = 0};
  struct bridge_sides all = {0, 0, INFINITY, NULL};
  *ok = make_grid(b);
  for (int i = 0; *ok && i < samples; i++) {
    double t = (i + 0.5) / samples;
    const double at[2] = {from->x + t * x, from->y + t * y};
    struct bridge_sides sides = {INFINITY, 0, INFINITY, NULL};
    *ok = look_all_beside(b, at, along, height, &sides);
    all.fold = fmax(all.fold, sides.fold);
    all.along += sides.along / samples;
    all.contour = fmin(all.contour, sides.contour);
    if (all.fold == INFINITY || 2 * all.fold >= all.contour)
      return false;
    contradicted += sides.outline->is_contradicted;
    curvature_squares_add(&curvature, sides.outline->curvature);
  }
  return *ok &&
         (length <= height || (all.along <= BESIDE_SHARE * length &&
                               (contradicted <= CONTRADICTED_SHARE * samples ||
                                !curvature_is_smooth(curvature))));
}

static bool add_bridge(const struct fold_bridges *b,
                       const struct bridge_end *from,
                       const struct bridge_end *to) {
  struct sheet *sheet = b->in->sheet;
  struct map *map = b->in->map;
  struct sheet_edge edge = sheet->edge.item[from->edge];
  uint8_t *state = mem_resize(map->edge_state, sheet->edge.count + 1, 1);
  if (state == NULL)
    return false;
  map->edge_state = state;
  edge.point[0] = from->point;
  edge.point[1] = to->point;
  b->degree[from->point - b->in->first_point] = 2;
  b->degree[to->point - b->in->first_point] = 2;
  b->node[from->point - b->in->first_point] = NODE_OF_CURVE;
  b->node[to->point - b->in->first_point] = NODE_OF_CURVE;
  map->edge_state[map->edge_count++] = MAP_VISIBLE;
  return ARRAY_PUSH(&sheet->edge, edge);
}

/* at_cuts  gaps between an end and where a loop was left out, and no others */
static bool bridge_all_gaps(struct fold_bridges *b, bool at_cuts) {
  bool ok = true;
  for (size_t i = 0; ok && i < b->stop.count; i++) {
    const struct bridge_end *from = &b->stop.item[i];
    double height = (double)b->heights[from->edge - b->in->first];
    if (!poll_at(i))
      return false;
    if (!is_open(b, from->point, at_cuts))
      continue;
    const struct bridge_end *to = find_facing(b, from, height, at_cuts);
    if (to != NULL && is_along_folds(b, from, to, height, &ok) && ok)
      ok = add_bridge(b, from, to);
  }
  return ok;
}

bool fold_bridges_add(const struct outline_gaps_input *input,
                      const float *heights) {
  struct fold_bridges b = {.in = input,
                           .heights = heights,
                           .edges = (uint32_t)input->sheet->edge.count};
  bool ok = list_bridge_ends(&b) && bridge_all_gaps(&b, false) &&
            bridge_all_gaps(&b, true);
  segment_grid_fini(&b.grid);
  mem_free(b.degree);
  mem_free(b.node);
  ARRAY_FREE(&b.start);
  ARRAY_FREE(&b.stop);
  return ok;
}
