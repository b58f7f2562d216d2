/* thin_loops.c - finds loops by comparing each segment with those shortly
 * before it.
 *
 * The segments of a curve are moved to a stack one by one.  One that crosses
 * one of the last on the stack ends a loop; a thin one is taken off again.  So
 * of loops within each other the inner ones come first, and the area of one
 * without others is what its signed area says.  Of two that share a part the
 * shorter one comes first, and of the two parts of a closed curve that crosses
 * itself the shorter one is the loop: which of them is left out does not depend
 * on where the curve begins. */
#include "visibility/contour/thin_loops.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "geom/vector.h"
#include "visibility/contour/loop_stack.h"

/* The segments of a loop, at most. */
enum { LOOP_SEGMENTS_MAX = 160 };

/* A fold has at most so many segments, and as much is drawn back and forth, as
 * a multiple of the triangles' mean height. */
enum { FOLD_SEGMENTS_MAX = 32 };
#define FOLD_HEIGHTS 2

/* The faces of a body for each segment of a loop that is none of its
 * contours. */
enum { BODY_FACES = 4 };

/* The steps of a curve that are not on the stack yet. */
struct coming_steps {
  const struct contour_step *step; /* all of the curve's */
  uint32_t count;                  /* of its segments */
  uint32_t next;                   /* the first of those to come */
  uint32_t left; /* so many come; those of a closed curve go on from its first
                    one */
};

struct thin_loops {
  struct loop_stack stack;
  struct part_size part;
  size_t lowest;  /* loops begin at no segment before it */
  double longest; /* the length of a loop, at most, grid units */
  struct coming_steps coming;
};

/* ---- Loops --------------------------------------------------------------- */

/* Whether a loop is to be left out. */
static bool is_noise_loop(const struct page_loop *loop) {
  return page_loop_is_thin(loop) && !page_loop_is_fold(loop, LONG_LOOP_HEIGHTS);
}

/* Moves the next of the coming steps to the stack. */
static bool push_coming(struct thin_loops *l, struct coming_steps *coming) {
  const struct contour_step *step = &coming->step[coming->next];
  coming->next = (coming->next + 1) % coming->count;
  coming->left--;
  return loop_stack_push(&l->stack, step[0], step[1].node);
}

/* Whether the last segment of the stack ends a thin loop that begins between
 * two segments and is shorter than a length. */
static bool ends_shorter_loop(const struct loop_stack *l, size_t after,
                              size_t before, double length) {
  size_t last = l->step.count - 2;
  struct page_segment b = loop_stack_image(l, last);
  struct box2 box = loop_stack_measure(l, last)->box;
  for (size_t i = before - 1; i > after; i--) {
    double s, t;
    struct page_segment a = loop_stack_image(l, i);
    if (box2_disjoint(loop_stack_measure(l, i)->box, box) ||
        !page_segments_cross(&a, &b, &s, &t))
      continue;
    struct page_loop loop = loop_stack_loop(l, i, last, s);
    if (loop.length < length && is_noise_loop(&loop))
      return true;
  }
  return false;
}

/* Finds whether a loop from a segment to the last one of the stack shares a
 * part with a shorter one that is to come.  Returns false when memory ran
 * out. */
static bool find_shorter_loop(struct thin_loops *l, size_t from, double length,
                              bool *found) {
  struct loop_stack *stack = &l->stack;
  size_t last = stack->step.count - 2;
  struct contour_step end = stack->step.item[last + 1];
  struct coming_steps coming = l->coming;
  double passed = 0;
  bool ok = true;
  *found = false;
  for (int i = 0; ok && !*found && i < LOOP_SEGMENTS_MAX && coming.left > 0 &&
                  passed < length;
       i++) {
    ok = push_coming(l, &coming);
    *found = ok && ends_shorter_loop(stack, from, last, length);
    passed += loop_stack_measure(stack, stack->step.count - 2)->length;
  }
  stack->step.count = last + 2;
  stack->step.item[last + 1] = end;
  return ok;
}

/* Takes off the thin loops that end on the last segment of the stack. */
static bool take_off_loops(struct thin_loops *l) {
  size_t last = l->stack.step.count - 2;
  size_t lowest = last > LOOP_SEGMENTS_MAX ? last - LOOP_SEGMENTS_MAX : 0;
  if (lowest < l->lowest)
    lowest = l->lowest;
  struct page_segment b = loop_stack_image(&l->stack, last);
  struct box2 box = loop_stack_measure(&l->stack, last)->box;
  size_t i = last > lowest ? last - 1 : lowest;
  while (i > lowest) {
    double s, t;
    i = loop_stack_previous_in_box(&l->stack, i, lowest, box);
    if (i < lowest)
      break;
    if (box2_disjoint(loop_stack_measure(&l->stack, i)->box, box))
      continue;
    struct page_segment a = loop_stack_image(&l->stack, i);
    if (!page_segments_cross(&a, &b, &s, &t))
      continue;
    struct page_loop loop = loop_stack_loop(&l->stack, i, last, s);
    if (loop.length > l->longest || !is_noise_loop(&loop)) {
      l->lowest = i + 1;
      return true;
    }
    bool waits;
    if (!find_shorter_loop(l, i, loop.length, &waits))
      return false;
    if (waits)
      return true;
    if (!loop_stack_take_off(&l->stack, i, s, t))
      return false;
    last = i + 1;
    b = loop_stack_image(&l->stack, last);
    box = loop_stack_measure(&l->stack, last)->box;
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
  struct geom_point p = loop_stack_node(&l->stack, from)->page,
                    q = loop_stack_node(&l->stack, to)->page;
  double x = (double)q.x - p.x, y = (double)q.y - p.y;
  double heights = 0, length = 0, square = x * x + y * y;
  for (size_t i = from; i < to; i++) {
    length += loop_stack_measure(&l->stack, i)->length;
    heights += loop_stack_measure(&l->stack, i)->height;
  }
  heights /= (double)(to - from);
  if (!(length - sqrt(square) < FOLD_HEIGHTS * heights))
    return false;
  *off = 0;
  double before = 0; /* of the step before */
  double most = fmin(THIN_SHARE * heights, VISIBLE_WIDTH);
  for (size_t i = from; i < to && *off < most; i++) {
    struct geom_point at = loop_stack_node(&l->stack, i + 1)->page;
    double px = (double)at.x - p.x, py = (double)at.y - p.y;
    double t = square > 0 ? (px * x + py * y) / square : 0;
    t = fmin(fmax(t, 0), 1);
    double away = vector2_length(px - t * x, py - t * y);
    *off =
        fmax(*off, fmax(before, away) + loop_stack_measure(&l->stack, i)->off);
    before = away;
  }
  return *off < most;
}

/* A filter for is_straight_fold, by sums in another order: false only where
 * that is. */
static bool is_back_and_forth(const struct thin_loops *l, size_t from,
                              size_t to, double length, double heights) {
  struct geom_point p = loop_stack_node(&l->stack, from)->page,
                    q = loop_stack_node(&l->stack, to)->page;
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
  const struct loop_stack *stack = &l->stack;
  const struct contour_segment *segment = stack->set->segment.item;
  const double *normal = segment[stack->step.item[from].segment].normal;
  double sum = 0, same = 0;
  for (size_t i = from; i + 1 < stack->step.count; i++) {
    const struct contour_segment *of = &segment[stack->step.item[i].segment];
    double sign = vector_dot(of->normal, normal) < 0 ? -1 : 1;
    sum += sign * contour_convexity(loop_stack_node(stack, i),
                                    loop_stack_node(stack, i + 1), of);
    same += sign * loop_stack_measure(stack, i)->length;
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
  struct contour_step *step = &l->stack.step.item[from];
  struct contour_step end = l->stack.step.item[l->stack.step.count - 1];
  bool is_turned;
  double convexity = convexity_from(l, from, &is_turned);
  l->stack.step.count = from + 2;
  double height = loop_stack_measure(&l->stack, from)->height;
  step[1] = end;
  l->stack.set->node.item[step->node].is_cut = true;
  l->stack.set->node.item[end.node].is_cut = true;
  if (!zero_set_add_part(l->stack.set, step->segment, step->node, end.node,
                         &step->segment))
    return false;
  struct contour_segment *made = &l->stack.set->segment.item[step->segment];
  made->radial = copysign(made->radial, convexity);
  for (int k = 0; is_turned && k < 3; k++)
    made->normal[k] = -made->normal[k];
  if (height >= VISIBLE_WIDTH) {
    made->along_crease = false;
    made->width = made->height;
  }
  bool ok = loop_stack_measure_segment(&l->stack, from);
  l->stack.measure.item[from - l->stack.first].off = off;
  return ok;
}

/* Makes one segment of the last ones of the stack that fold back and forth
 * along a straight line. */
static bool straighten_fold(struct thin_loops *l) {
  size_t last = l->stack.step.count - 1;
  size_t lowest = last > FOLD_SEGMENTS_MAX ? last - FOLD_SEGMENTS_MAX : 0;
  if (lowest < l->lowest)
    lowest = l->lowest;
  if (last <= lowest)
    return true;
  /* It turns back twice at least. */
  size_t turn = loop_stack_measure(&l->stack, last - 1)->turn;
  if (turn > lowest)
    turn = loop_stack_measure(&l->stack, turn - 1)->turn;
  if (turn <= lowest)
    return true;
  double length = 0, heights = 0, off;
  for (size_t i = last; i > lowest; i--) {
    length += loop_stack_measure(&l->stack, i - 1)->length;
    heights += loop_stack_measure(&l->stack, i - 1)->height;
    if (i <= turn && is_back_and_forth(l, i - 1, last, length, heights) &&
        is_straight_fold(l, i - 1, last, &off))
      return straighten(l, i - 1, off);
  }
  return true;
}

/* ---- Curves -------------------------------------------------------------- */

/* The length of the image of some steps' segments. */
static double length_of_steps(const struct thin_loops *l,
                              const struct contour_step *step, uint32_t count) {
  const struct contour_node *node = l->stack.set->node.item;
  double sum = 0;
  for (uint32_t i = 0; i < count; i++) {
    struct geom_point p = node[step[i].node].page,
                      q = node[step[i + 1].node].page;
    sum += vector2_length((double)q.x - p.x, (double)q.y - p.y);
  }
  return sum;
}

/* Moves a curve to the stack, from its step `start` on if it is closed.
 * length  of its image, if it is; else INFINITY */
static bool push_curve(struct thin_loops *l, const struct contour_step *step,
                       uint32_t count, uint32_t start, double length) {
  bool closed = length < INFINITY;
  l->stack.first = l->lowest = l->stack.step.count;
  l->longest = length / 2;
  l->coming = (struct coming_steps){step, count, start, 0};
  if (!ARRAY_PUSH(&l->stack.step,
                  ((struct contour_step){step[start].node, SHEET_NONE})))
    return false;
  for (uint32_t i = 0; i < count; i++) {
    l->coming.left = closed ? count : count - i;
    if (!poll_at(i) || !push_coming(l, &l->coming) || !take_off_loops(l) ||
        !straighten_fold(l))
      return false;
  }
  return true;
}

/* A closed curve is passed once more from its middle on, for loops where it
 * begins. */
static bool pass_again(struct thin_loops *l) {
  struct loop_stack *stack = &l->stack;
  uint32_t count = (uint32_t)(stack->step.count - stack->first) - 1;
  ARRAY(struct contour_step) once = {NULL, 0, 0};
  if (!ARRAY_RESERVE(&once, count + 1))
    return false;
  memcpy(once.item, stack->step.item + stack->first,
         (count + 1) * sizeof *once.item);
  stack->step.count = stack->first;
  bool ok = push_curve(l, once.item, count, count / 2,
                       length_of_steps(l, once.item, count));
  ARRAY_FREE(&once);
  return ok;
}

/* Takes off a whole curve if it is a thin loop of a body of many faces. */
static bool take_off_curve(struct thin_loops *l) {
  const struct contour_step *step = l->stack.step.item;
  size_t last = l->stack.step.count - 1, segments = last - l->stack.first,
         faces;
  if (segments < 3 || segments > LOOP_SEGMENTS_MAX ||
      l->lowest > l->stack.first ||
      step[last].node != step[l->stack.first].node)
    return true;
  struct page_loop loop =
      loop_stack_loop(&l->stack, l->stack.first, last - 1, 0);
  if (!page_loop_is_thin(&loop) || page_loop_is_fold(&loop, LONG_CURVE_HEIGHTS))
    return true;
  uint32_t face = l->stack.set->segment.item[step[l->stack.first].segment].face;
  if (!part_size_count(&l->part, face, BODY_FACES * segments, &faces))
    return false;
  if (faces >= BODY_FACES * segments)
    l->stack.step.count = l->stack.first;
  return true;
}

bool thin_loops_remove(struct contour_curves *curves, struct zero_set *set,
                       const struct sheet *sheet,
                       const struct topology *topology) {
  struct thin_loops l = {
      .stack = {.set = set,
                .camera = &sheet->camera,
                .long_on_page = contour_outlines_long_on_page(set)},
      .part = {.scene = sheet->scene, .topology = topology}};
  size_t kept = 0;
  bool ok = true;
  for (size_t i = 0; ok && i < curves->curve.count; i++) {
    const struct contour_curve *curve = &curves->curve.item[i];
    const struct contour_step *step = curves->step.item + curve->step;
    double length =
        curve->closed ? length_of_steps(&l, step, curve->count) : INFINITY;
    ok = push_curve(&l, step, curve->count, 0, length) &&
         (!curve->closed || pass_again(&l)) && take_off_curve(&l);
    if (l.stack.step.count > l.stack.first)
      curves->curve.item[kept++] = (struct contour_curve){
          .step = (uint32_t)l.stack.first,
          .count = (uint32_t)(l.stack.step.count - l.stack.first) - 1,
          .closed = curve->closed};
  }
  curves->curve.count = kept;
  part_size_fini(&l.part);
  loop_stack_fini(&l.stack);
  ARRAY_FREE(&curves->step);
  curves->step.item = l.stack.step.item;
  curves->step.count = l.stack.step.count;
  curves->step.capacity = l.stack.step.capacity;
  return ok;
}
