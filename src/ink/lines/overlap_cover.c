/* overlap_cover.c - the part of a segment that another one overlaps, at the
 * output's precision. */
#include "ink/lines/overlap_cover.h"

#include <math.h>
#include <stdlib.h>

#include "geom/vector.h"

/* A segment with its derived quantities. */
struct measured_segment {
  struct ink_point from, to;
  int64_t dx, dy, cross_max; /* see nodes_near_segment.c */
  double length;             /* set by measure_length */
};

static struct measured_segment run_of(const struct vertex_snapping *snapping,
                                      const uint32_t node[2]) {
  struct measured_segment run = {.from = vertex_snapping_at(snapping, node[0]),
                                 .to = vertex_snapping_at(snapping, node[1])};
  run.dx = (int64_t)run.to.x - run.from.x;
  run.dy = (int64_t)run.to.y - run.from.y;
  run.cross_max = snapping->output_step * (llabs(run.dx) + llabs(run.dy));
  return run;
}

static void measure_length(struct measured_segment *run) {
  run->length = sqrt((double)(run->dx * run->dx + run->dy * run->dy));
}

/* How many ends of one are near the line of the other. */
static int count_near_line(const struct measured_segment *run,
                           const struct measured_segment *other) {
  const struct ink_point end[2] = {other->from, other->to};
  int count = 0;
  for (int k = 0; k < 2; k++) {
    int64_t x = (int64_t)end[k].x - run->from.x,
            y = (int64_t)end[k].y - run->from.y;
    count += llabs(run->dx * y - run->dy * x) <= run->cross_max;
  }
  return count;
}

/* Whether the point is near the segment; sets *along to its position, clamped
 * to the segment. */
static bool is_near_segment(const struct measured_segment *run,
                            struct ink_point p, double *along) {
  int64_t x = (int64_t)p.x - run->from.x, y = (int64_t)p.y - run->from.y;
  int64_t cross = run->dx * y - run->dy * x, dot = run->dx * x + run->dy * y;
  double at = (double)dot / run->length;
  *along = min_number(run->length, max_number(0, at));
  return llabs(cross) <= run->cross_max && dot >= -run->cross_max &&
         at - run->length <= (double)run->cross_max / run->length;
}

static void widen(struct overlap_cover *cover, double along, uint32_t node) {
  if (along < cover->from ||
      (along == cover->from && node == SEGMENT_GRAPH_NONE)) {
    cover->from = along;
    cover->node[0] = node;
  }
  if (along > cover->to || (along == cover->to && node == SEGMENT_GRAPH_NONE)) {
    cover->to = along;
    cover->node[1] = node;
  }
}

bool overlap_cover_find(const struct vertex_snapping *snapping,
                        const uint32_t a[2], const uint32_t b[2],
                        struct overlap_cover *cover) {
  struct measured_segment of_a = run_of(snapping, a),
                          of_b = run_of(snapping, b);
  /* Near one end alone they overlap in no more than a point. */
  if (count_near_line(&of_a, &of_b) + count_near_line(&of_b, &of_a) < 2)
    return false;
  measure_length(&of_a);
  measure_length(&of_b);
  *cover = (struct overlap_cover){
      INFINITY, -INFINITY, {SEGMENT_GRAPH_NONE, SEGMENT_GRAPH_NONE}};
  if (of_a.length == 0 || of_b.length == 0)
    return false;
  double along, at[2];
  for (int k = 0; k < 2; k++)
    if (is_near_segment(&of_a, k ? of_b.to : of_b.from, &at[k]))
      widen(cover, at[k],
            at[k] > 0 && at[k] < of_a.length ? b[k] : SEGMENT_GRAPH_NONE);
  if (is_near_segment(&of_b, of_a.from, &along))
    widen(cover, 0, SEGMENT_GRAPH_NONE);
  if (is_near_segment(&of_b, of_a.to, &along))
    widen(cover, of_a.length, SEGMENT_GRAPH_NONE);
  /* An end is near even a little beyond the other's end; the overlap itself
   * does not begin there, or short sides of a curve would overlap the next. */
  double shorter = fmin(of_a.length, of_b.length);
  double run = fmin(fabs(at[1] - at[0]), cover->to - cover->from);
  return run > fmin((double)snapping->output_step, shorter / 2);
}
