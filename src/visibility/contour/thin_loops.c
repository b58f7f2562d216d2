/* thin_loops.c - finds loops by comparing each segment with those shortly
 * before it.
 *
 * The segments of a curve are moved to a stack one by one.  One that crosses
 * one of the last on the stack ends a loop; a thin one is taken off again.  So
 * of loops within each other the inner ones come first, and the area of one
 * without others is what its signed area says. */
#include "visibility/contour/thin_loops.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "geom/vector.h"
#include "visibility/contour/page_loop.h"
#include "visibility/contour/segment_grid.h"

/* The segments of a loop, at most. */
enum { LOOP_SEGMENTS_MAX = 160 };

/* A fold has at most so many segments, and as much is drawn back and forth, as
 * a multiple of the triangles' mean height. */
enum { FOLD_SEGMENTS_MAX = 32 };
#define FOLD_HEIGHTS 2

/* The faces of a body for each segment of a loop that is none of its
 * contours. */
enum { BODY_FACES = 4 };

/* What is known of a segment of the stack. */
struct stack_segment {
  double length, height; /* of its triangle; on the page, grid units */
  double off; /* how far what became straight there is from it, at most; parts
                  that a loop was taken off from have 0 */
  struct box2 box; /* of its image */
  size_t turn;     /* the last node up to its first one at which the image turns
                  back; the curve's first: none */
};

/* The segments whose boxes are united. */
enum { BLOCK_SEGMENTS = 8 };

struct thin_loops {
  struct zero_set *set;
  const struct camera *camera;
  struct part_size part;
  ARRAY(struct contour_step) step; /* the stack; its last one has no segment */
  ARRAY(struct stack_segment) measure; /* one a segment of the curve */
  ARRAY(struct box2) block; /* of each BLOCK_SEGMENTS of the curve: a box about
                               their images */
  size_t first;             /* of the steps: the curve's */
  size_t lowest;            /* loops begin at no segment before it */
};

static const struct contour_node *stack_node(const struct thin_loops *l,
                                             size_t i) {
  return &l->set->node.item[l->step.item[i].node];
}

static struct page_segment stack_image(const struct thin_loops *l, size_t i) {
  return (struct page_segment){.p = stack_node(l, i)->page,
                               .q = stack_node(l, i + 1)->page};
}

static const struct stack_segment *measure_of(const struct thin_loops *l,
                                              size_t i) {
  return &l->measure.item[i - l->first];
}

/* ---- Segments ------------------------------------------------------------ */

/* Whether the image turns back at a step, by more than 90 degrees. */
static bool image_turns_back(const struct thin_loops *l, size_t i) {
  struct page_segment a = stack_image(l, i - 1), b = stack_image(l, i);
  double x = ((double)a.q.x - a.p.x) * ((double)b.q.x - b.p.x);
  double y = ((double)a.q.y - a.p.y) * ((double)b.q.y - b.p.y);
  return x + y < 0;
}

/* Unites the box of a segment with that of its block, of which it is the last
 * one. */
static bool extend_block(struct thin_loops *l, size_t i) {
  size_t at = i - l->first;
  struct box2 box = measure_of(l, i)->box;
  l->block.count = at / BLOCK_SEGMENTS + (at % BLOCK_SEGMENTS != 0);
  if (at % BLOCK_SEGMENTS == 0)
    return ARRAY_PUSH(&l->block, box);
  struct box2 *block = &l->block.item[l->block.count - 1];
  *block = box2_union(*block, box);
  return true;
}

/* Measures a segment of the stack, after those before it. */
static bool measure_segment(struct thin_loops *l, size_t i) {
  struct page_segment s = stack_image(l, i);
  struct stack_segment made = {
      .length = vector2_length((double)s.q.x - s.p.x, (double)s.q.y - s.p.y),
      .height = contour_height(l->camera, stack_node(l, i),
                               &l->set->segment.item[l->step.item[i].segment]),
      .box = box2_of_segment(s.p, s.q),
      .turn = i};
  l->measure.count = i - l->first;
  if (i > l->first && !image_turns_back(l, i))
    made.turn = measure_of(l, i - 1)->turn;
  return ARRAY_PUSH(&l->measure, made) && extend_block(l, i);
}

/* ---- Thin loops ---------------------------------------------------------- */

/* Measures the loop that begins on segment `from`, at `s` of it, and ends on
 * segment `to` there. */
static struct page_loop measure_loop(const struct thin_loops *l, size_t from,
                                     size_t to, double s) {
  struct page_segment first = stack_image(l, from);
  double x0 = first.p.x + s * ((double)first.q.x - first.p.x);
  double y0 = first.p.y + s * ((double)first.q.y - first.p.y);
  double x = 0, y = 0, area = 0;
  struct page_loop loop = {.segments = to - from, .is_concave = true};
  for (size_t i = from + 1; i <= to; i++) {
    struct geom_point p = stack_node(l, i)->page;
    const struct contour_segment *of =
        &l->set->segment.item[l->step.item[i].segment];
    curvature_squares_add(&loop.curvature, of->curvature);
    loop.has_crease = loop.has_crease || of->in_network;
    loop.is_concave = loop.is_concave && !(of->in_network && of->radial >= 0);
    double next_x = p.x - x0, next_y = p.y - y0;
    area += x * next_y - y * next_x;
    loop.length += vector2_length(next_x - x, next_y - y);
    loop.height += measure_of(l, i)->height;
    x = next_x;
    y = next_y;
  }
  loop.area = fabs(area);
  loop.length += vector2_length(x, y);
  loop.height /= (double)loop.segments;
  return loop;
}

/* ---- The stack ----------------------------------------------------------- */

/* Adds the node at a place of a segment of the stack. */
static bool add_node_on(struct thin_loops *l, size_t i, double t,
                        uint32_t *node) {
  struct contour_node made = *stack_node(l, i);
  const struct contour_node *next = stack_node(l, i + 1);
  for (int k = 0; k < 3; k++) {
    made.at[k] += t * (next->at[k] - made.at[k]);
    made.flat[k] += t * (next->flat[k] - made.flat[k]);
  }
  made.page.x += (int32_t)lrint(t * ((double)next->page.x - made.page.x));
  made.page.y += (int32_t)lrint(t * ((double)next->page.y - made.page.y));
  made.page.z += (int64_t)(t * (double)(next->page.z - made.page.z));
  made.sheet_point = SHEET_NONE;
  made.is_cut = true;
  *node = (uint32_t)l->set->node.count;
  return ARRAY_PUSH(&l->set->node, made);
}

/* Takes off the loop from segment `from`, at s, to the last one, at t.  The
 * crossing is a node of the part that is nearer to the viewer. */
static bool take_off(struct thin_loops *l, size_t from, double s, double t) {
  struct contour_step *step = l->step.item;
  size_t last = l->step.count - 2;
  struct page_segment a = stack_image(l, from), b = stack_image(l, last);
  bool first_is_nearer = page_segment_depth(&a, s) > page_segment_depth(&b, t);
  uint32_t node, rest, end = step[last + 1].node;
  if (!add_node_on(l, first_is_nearer ? from : last, first_is_nearer ? s : t,
                   &node) ||
      !zero_set_add_part(l->set, step[from].segment, step[from].node, node,
                         &step[from].segment) ||
      !zero_set_add_part(l->set, step[last].segment, node, end, &rest))
    return false;
  step[from + 1] = (struct contour_step){node, rest};
  step[from + 2] = (struct contour_step){end, SHEET_NONE};
  l->step.count = from + 3;
  return measure_segment(l, from) && measure_segment(l, from + 1);
}

/* The last segment before one, no lower than `lowest`, whose block's box meets
 * another box, or that is in the same block; what is below where there is
 * none. */
static size_t previous_in_box(const struct thin_loops *l, size_t i,
                              size_t lowest, struct box2 box) {
  size_t at = i - l->first;
  while (at % BLOCK_SEGMENTS == 0 && at > lowest - l->first &&
         box2_disjoint(l->block.item[at / BLOCK_SEGMENTS - 1], box))
    at -= BLOCK_SEGMENTS;
  return at > 0 ? l->first + at - 1 : l->first;
}

/* Takes off the thin loops that end on the last segment of the stack. */
static bool take_off_loops(struct thin_loops *l) {
  size_t last = l->step.count - 2;
  size_t lowest = last > LOOP_SEGMENTS_MAX ? last - LOOP_SEGMENTS_MAX : 0;
  if (lowest < l->lowest)
    lowest = l->lowest;
  struct page_segment b = stack_image(l, last);
  struct box2 box = measure_of(l, last)->box;
  size_t i = last > lowest ? last - 1 : lowest;
  while (i > lowest) {
    double s, t;
    i = previous_in_box(l, i, lowest, box);
    if (i < lowest)
      break;
    if (box2_disjoint(measure_of(l, i)->box, box))
      continue;
    struct page_segment a = stack_image(l, i);
    if (!page_segments_cross(&a, &b, &s, &t))
      continue;
    struct page_loop loop = measure_loop(l, i, last, s);
    if (!page_loop_is_thin(&loop) ||
        page_loop_is_fold(&loop, LONG_LOOP_HEIGHTS)) {
      l->lowest = i + 1;
      return true;
    }
    if (!take_off(l, i, s, t))
      return false;
    last = i + 1;
    b = stack_image(l, last);
    box = measure_of(l, last)->box;
  }
  return true;
}

/* ---- Folds --------------------------------------------------------------- */

/* Whether all that was between two steps of the stack, before any of it became
 * straight, is as near to the straight line between these as a share of the
 * triangles' mean height, and as ink.
 * off  gets how near it is, if so */
static bool is_straight_fold(const struct thin_loops *l, size_t from, size_t to,
                             double *off) {
  struct geom_point p = stack_node(l, from)->page, q = stack_node(l, to)->page;
  double x = (double)q.x - p.x, y = (double)q.y - p.y;
  double heights = 0, length = 0, square = x * x + y * y;
  for (size_t i = from; i < to; i++) {
    length += measure_of(l, i)->length;
    heights += measure_of(l, i)->height;
  }
  heights /= (double)(to - from);
  if (!(length - sqrt(square) < FOLD_HEIGHTS * heights))
    return false;
  *off = 0;
  double before = 0; /* of the step before */
  double most = fmin(THIN_SHARE * heights, VISIBLE_WIDTH);
  for (size_t i = from; i < to && *off < most; i++) {
    struct geom_point at = stack_node(l, i + 1)->page;
    double px = (double)at.x - p.x, py = (double)at.y - p.y;
    double t = square > 0 ? (px * x + py * y) / square : 0;
    t = fmin(fmax(t, 0), 1);
    double away = vector2_length(px - t * x, py - t * y);
    *off = fmax(*off, fmax(before, away) + measure_of(l, i)->off);
    before = away;
  }
  return *off < most;
}

/* A filter for is_straight_fold, by sums in another order: false only where
 * that is. */
static bool is_back_and_forth(const struct thin_loops *l, size_t from,
                              size_t to, double length, double heights) {
  struct geom_point p = stack_node(l, from)->page, q = stack_node(l, to)->page;
  double x = (double)q.x - p.x, y = (double)q.y - p.y;
  double most = FOLD_HEIGHTS * heights / (double)(to - from);
  return length - sqrt(x * x + y * y) < most + 0x1p-32 * (length + most);
}

/* How much the segments of the stack from one on say that the surface is convex
 * there.  Where they have opposite normals, as faces on either side of an edge
 * are listed in opposite directions, the outer side is that of most of them.
 * is_turned  gets whether this is the inner one of the first of them */
static double convexity_from(const struct thin_loops *l, size_t from,
                             bool *is_turned) {
  const struct contour_segment *segment = l->set->segment.item;
  const double *normal = segment[l->step.item[from].segment].normal;
  double sum = 0, same = 0;
  for (size_t i = from; i + 1 < l->step.count; i++) {
    const struct contour_segment *of = &segment[l->step.item[i].segment];
    double sign = vector_dot(of->normal, normal) < 0 ? -1 : 1;
    sum += sign * contour_convexity(stack_node(l, i), stack_node(l, i + 1), of);
    same += sign * measure_of(l, i)->length;
  }
  *is_turned = same < 0;
  return *is_turned ? -sum : sum;
}

/* Makes one segment of a step of the stack and those after it.  It leaves the
 * crease along which the first one ran, and the surface beside that is as high
 * as the triangle: what is on the crease itself would be within it.  Where the
 * triangle is narrower than ink the crease and the line are one.  The surface
 * bends there as most of what it stands for says. */
static bool straighten(struct thin_loops *l, size_t from, double off) {
  struct contour_step *step = &l->step.item[from];
  struct contour_step end = l->step.item[l->step.count - 1];
  bool is_turned;
  double convexity = convexity_from(l, from, &is_turned);
  l->step.count = from + 2;
  double height = measure_of(l, from)->height;
  step[1] = end;
  l->set->node.item[step->node].is_cut = true;
  l->set->node.item[end.node].is_cut = true;
  if (!zero_set_add_part(l->set, step->segment, step->node, end.node,
                         &step->segment))
    return false;
  struct contour_segment *made = &l->set->segment.item[step->segment];
  made->radial = copysign(made->radial, convexity);
  for (int k = 0; is_turned && k < 3; k++)
    made->normal[k] = -made->normal[k];
  if (height >= VISIBLE_WIDTH) {
    made->along_crease = false;
    made->width = made->height;
  }
  bool ok = measure_segment(l, from);
  l->measure.item[from - l->first].off = off;
  return ok;
}

/* Makes one segment of the last ones of the stack that fold back and forth
 * along a straight line. */
static bool straighten_fold(struct thin_loops *l) {
  size_t last = l->step.count - 1;
  size_t lowest = last > FOLD_SEGMENTS_MAX ? last - FOLD_SEGMENTS_MAX : 0;
  if (lowest < l->lowest)
    lowest = l->lowest;
  if (last <= lowest)
    return true;
  /* It turns back twice at least. */
  size_t turn = measure_of(l, last - 1)->turn;
  if (turn > lowest)
    turn = measure_of(l, turn - 1)->turn;
  if (turn <= lowest)
    return true;
  double length = 0, heights = 0, off;
  for (size_t i = last; i > lowest; i--) {
    length += measure_of(l, i - 1)->length;
    heights += measure_of(l, i - 1)->height;
    if (i <= turn && is_back_and_forth(l, i - 1, last, length, heights) &&
        is_straight_fold(l, i - 1, last, &off))
      return straighten(l, i - 1, off);
  }
  return true;
}

/* ---- Curves -------------------------------------------------------------- */

/* Moves a step to the stack, and the node where its segment ends. */
static bool push_step(struct thin_loops *l, struct contour_step step,
                      uint32_t end) {
  l->step.item[l->step.count - 1] = step;
  return ARRAY_PUSH(&l->step, ((struct contour_step){end, SHEET_NONE})) &&
         measure_segment(l, l->step.count - 2) && take_off_loops(l) &&
         straighten_fold(l);
}

/* Moves a curve to the stack, from its step `start` on if it is closed. */
static bool push_curve(struct thin_loops *l, const struct contour_step *step,
                       uint32_t count, uint32_t start) {
  struct contour_step first = {step[start].node, SHEET_NONE};
  l->first = l->lowest = l->step.count;
  if (!ARRAY_PUSH(&l->step, first))
    return false;
  for (uint32_t i = 0; i < count; i++) {
    uint32_t at = (start + i) % count;
    if (!poll_at(i) || !push_step(l, step[at], step[at + 1].node))
      return false;
  }
  return true;
}

/* A closed curve is passed once more from its middle on, for loops where it
 * begins. */
static bool pass_again(struct thin_loops *l) {
  uint32_t count = (uint32_t)(l->step.count - l->first) - 1;
  ARRAY(struct contour_step) once = {NULL, 0, 0};
  if (!ARRAY_RESERVE(&once, count + 1))
    return false;
  memcpy(once.item, l->step.item + l->first, (count + 1) * sizeof *once.item);
  l->step.count = l->first;
  bool ok = push_curve(l, once.item, count, count / 2);
  ARRAY_FREE(&once);
  return ok;
}

/* Takes off a whole curve if it is a thin loop of a body of many faces. */
static bool take_off_curve(struct thin_loops *l) {
  const struct contour_step *step = l->step.item;
  size_t last = l->step.count - 1, segments = last - l->first, faces;
  if (segments < 3 || segments > LOOP_SEGMENTS_MAX || l->lowest > l->first ||
      step[last].node != step[l->first].node)
    return true;
  struct page_loop loop = measure_loop(l, l->first, last - 1, 0);
  if (!page_loop_is_thin(&loop) || page_loop_is_fold(&loop, LONG_CURVE_HEIGHTS))
    return true;
  uint32_t face = l->set->segment.item[step[l->first].segment].face;
  if (!part_size_count(&l->part, face, BODY_FACES * segments, &faces))
    return false;
  if (faces >= BODY_FACES * segments)
    l->step.count = l->first;
  return true;
}

bool thin_loops_remove(struct contour_curves *curves, struct zero_set *set,
                       const struct sheet *sheet,
                       const struct topology *topology) {
  struct thin_loops l = {.set = set,
                         .camera = &sheet->camera,
                         .part = {.scene = sheet->scene, .topology = topology}};
  size_t kept = 0;
  bool ok = true;
  for (size_t i = 0; ok && i < curves->curve.count; i++) {
    const struct contour_curve *curve = &curves->curve.item[i];
    ok = push_curve(&l, curves->step.item + curve->step, curve->count, 0) &&
         (!curve->closed || pass_again(&l)) && take_off_curve(&l);
    if (l.step.count > l.first)
      curves->curve.item[kept++] = (struct contour_curve){
          .step = (uint32_t)l.first,
          .count = (uint32_t)(l.step.count - l.first) - 1,
          .closed = curve->closed};
  }
  curves->curve.count = kept;
  part_size_fini(&l.part);
  ARRAY_FREE(&l.measure);
  ARRAY_FREE(&l.block);
  ARRAY_FREE(&curves->step);
  curves->step.item = l.step.item;
  curves->step.count = l.step.count;
  curves->step.capacity = l.step.capacity;
  return ok;
}
