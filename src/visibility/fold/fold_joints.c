/* fold_joints.c - finds ends of contours by a grid of their segments. */
#include "visibility/fold/fold_joints.h"

#include <math.h>

#include "base/poll.h"
#include "base/sort.h"
#include "geom/vector.h"
#include "visibility/contour/curve_ends.h"

/* What continues a contour turns from it by no more than 60 degrees. */
#define JOINT_COSINE 0.5

/* How far from a sample the end of a contour may be that a line continues, and
 * over how much of the contour its direction is found, as its last segments may
 * turn back; in heights. */
#define JOINT_HEIGHTS 1.5
#define DIRECTION_HEIGHTS 0.5

/* ---- What is drawn ------------------------------------------------------- */

static int compare_joint_ends(const void *a, const void *b, void *user) {
  const struct joint_end *p = a, *q = b;
  (void)user;
  return (p->x > q->x) - (p->x < q->x);
}

static bool list_joint_ends(struct fold_joints *j) {
  for (size_t i = 0; i < j->grid.segment.count; i++) {
    const struct page_segment *s = &j->grid.segment.item[i];
    const uint32_t *point = j->in->sheet->edge.item[s->owner].point;
    for (int k = 0; s->owner >= j->in->first && k < 2; k++) {
      const struct geom_point *at = k == 0 ? &s->p : &s->q;
      if (fold_joints_is_loose(j, point[k]) &&
          !ARRAY_PUSH(&j->loose, ((struct joint_end){at->x, at->y})))
        return false;
    }
  }
  return sort_stable(j->loose.item, j->loose.count, sizeof *j->loose.item,
                     compare_joint_ends, NULL);
}

static void mark_curve_nodes(struct fold_joints *j) {
  const struct zero_set *set = j->in->set;
  for (size_t i = 0; i < set->node.count; i++)
    if (set->node.item[i].sheet_point != SHEET_NONE)
      j->is_node[set->node.item[i].sheet_point - j->in->first_point] = 1;
}

/* How far contours that are visible are from the mesh, at most. */
static double find_bulge_most(const struct outline_gaps_input *in) {
  double most = 0;
  for (uint32_t i = 0; i < in->bulges; i++)
    if (in->map->edge_state[in->first + i] != MAP_HIDDEN)
      most = fmax(most, (double)in->bulge[i]);
  return most;
}

bool fold_joints_list(struct fold_joints *j) {
  const struct sheet *sheet = j->in->sheet;
  j->ends = mem_calloc(sheet->point.count - j->in->first_point, 1);
  j->is_node = mem_calloc(j->in->curve_points, 1);
  if (j->ends == NULL || j->is_node == NULL)
    return false;
  mark_curve_nodes(j);
  j->bulge_most = find_bulge_most(j->in);
  for (uint32_t e = 0; e < sheet->edge.count; e++) {
    const uint32_t *point = sheet->edge.item[e].point;
    if (!poll_at(e))
      return false;
    if (j->in->map->edge_state[e] == MAP_HIDDEN ||
        !sheet_edge_is_drawn(sheet, e))
      continue;
    if (!segment_grid_add(&j->grid, sheet_ends(sheet, point), e))
      return false;
    for (int k = 0; e >= j->in->first && k < 2; k++) {
      uint8_t *ends = &j->ends[point[k] - j->in->first_point];
      *ends = (uint8_t)(*ends + (*ends < 2));
    }
  }
  j->grid.contours = j->grid.segment.count;
  return list_joint_ends(j) &&
         (j->grid.contours == 0 || segment_grid_make(&j->grid));
}

void fold_joints_fini(struct fold_joints *j) {
  segment_grid_fini(&j->grid);
  mem_free(j->ends);
  mem_free(j->is_node);
  ARRAY_FREE(&j->loose);
}

/* ---- Joints -------------------------------------------------------------- */

bool fold_joints_may_join(const struct fold_joints *j, struct fold_run chain,
                          double heights) {
  double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
  double height = 0, length = 0;
  for (size_t i = 0; i < chain.count; i++) {
    const struct fold_sample *s = &chain.sample[i];
    x0 = fmin(x0, s->x);
    x1 = fmax(x1, s->x);
    y0 = fmin(y0, s->y);
    y1 = fmax(y1, s->y);
    height += s->step * s->height;
    length += s->step;
  }
  height = length > 0 ? height / length : 0;
  if (length < heights * height)
    return false;
  double by = JOINT_HEIGHTS * height;
  size_t i = 0;
  LOWER_BOUND(i, 0, j->loose.count, j->loose.item[i].x < x0 - by);
  for (; i < j->loose.count && j->loose.item[i].x <= x1 + by; i++)
    if (j->loose.item[i].y >= y0 - by && j->loose.item[i].y <= y1 + by)
      return true;
  return false;
}

/* Whether a contour that ends at its edge's point k has there, over a distance,
 * about the direction of a sample. */
static bool has_direction(const struct fold_joints *j, uint32_t edge, int k,
                          double distance, const struct fold_sample *s) {
  const struct sheet *sheet = j->in->sheet;
  struct geom_point end = sheet->point.item[sheet->edge.item[edge].point[k]];
  struct geom_point before =
      curve_before_end(sheet, j->in->first, edge, k, distance);
  double x = (double)end.x - before.x, y = (double)end.y - before.y;
  double along = x * s->along[0] + y * s->along[1];
  return (k == 1 ? along : -along) >= JOINT_COSINE * vector2_length(x, y);
}

/* Finds the end of a contour that a line continues at a sample, if `k` is 1, or
 * that continues it, if it is 0; SHEET_NONE: none.
 * distance  from the sample, at most; gets that of the end */
static uint32_t find_joint(const struct fold_joints *j,
                           const struct fold_sample *s, int k, double height,
                           double *distance) {
  struct segment_walk walk = segment_grid_near(&j->grid, s->x, s->y, *distance);
  const struct page_segment *g;
  uint32_t best = SHEET_NONE;
  while ((g = segment_walk_next(&walk)) != NULL) {
    uint32_t point = j->in->sheet->edge.item[g->owner].point[k];
    struct geom_point end = k == 0 ? g->p : g->q;
    double away = vector2_length(end.x - s->x, end.y - s->y);
    if (g->owner < j->in->first || away >= *distance ||
        !fold_joints_is_loose(j, point) ||
        !has_direction(j, g->owner, k, DIRECTION_HEIGHTS * height, s))
      continue;
    *distance = away;
    best = point;
  }
  return best;
}

void fold_joints_lead_on(const struct fold_joints *j,
                         const struct fold_sample *sample, size_t count,
                         size_t *at, int k, double height, uint32_t *joint) {
  double least = JOINT_HEIGHTS * height, passed = 0;
  *joint = SHEET_NONE;
  for (size_t i = *at; passed <= FOLD_LEAD_HEIGHTS * height;
       i += k == 0 ? SIZE_MAX : 1) {
    passed += sample[i].step;
    uint32_t found = find_joint(j, &sample[i], 1 - k, height, &least);
    if (found != SHEET_NONE) {
      *joint = found;
      *at = i;
    }
    if (i == (k == 0 ? 0 : count - 1))
      break;
  }
}
