/* loop_stack.c - measures what is on the stack. */
#include "visibility/contour/loop_stack.h"

#include <math.h>

#include "geom/vector.h"

/* The length of a segment from which on, in heights, its triangle is a sliver,
 * where noise goes as far. */
#define SLIVER_HEIGHTS 2

/* The segments whose boxes are united. */
enum { BLOCK_SEGMENTS = 8 };

void loop_stack_fini(struct loop_stack *l) {
  ARRAY_FREE(&l->measure);
  ARRAY_FREE(&l->block);
}

/* ---- Segments ------------------------------------------------------------ */

/* Whether the image turns back at a step, by more than 90 degrees. */
static bool image_turns_back(const struct loop_stack *l, size_t i) {
  struct page_segment a = loop_stack_image(l, i - 1),
                      b = loop_stack_image(l, i);
  double x = ((double)a.q.x - a.p.x) * ((double)b.q.x - b.p.x);
  double y = ((double)a.q.y - a.p.y) * ((double)b.q.y - b.p.y);
  return x + y < 0;
}

/* Unites the box of a segment with that of its block, of which it is the last
 * one. */
static bool extend_block(struct loop_stack *l, size_t i) {
  size_t at = i - l->first;
  struct box2 box = loop_stack_measure(l, i)->box;
  l->block.count = at / BLOCK_SEGMENTS + (at % BLOCK_SEGMENTS != 0);
  if (at % BLOCK_SEGMENTS == 0)
    return ARRAY_PUSH(&l->block, box);
  struct box2 *block = &l->block.item[l->block.count - 1];
  *block = box2_union(*block, box);
  return true;
}

bool loop_stack_measure_segment(struct loop_stack *l, size_t i) {
  struct page_segment s = loop_stack_image(l, i);
  struct stack_segment made = {
      .length = vector2_length((double)s.q.x - s.p.x, (double)s.q.y - s.p.y),
      .height = contour_height(l->camera, loop_stack_node(l, i),
                               &l->set->segment.item[l->step.item[i].segment]),
      .box = box2_of_segment(s.p, s.q),
      .turn = i};
  l->measure.count = i - l->first;
  if (i > l->first && !image_turns_back(l, i))
    made.turn = loop_stack_measure(l, i - 1)->turn;
  return ARRAY_PUSH(&l->measure, made) && extend_block(l, i);
}

bool loop_stack_push(struct loop_stack *l, struct contour_step step,
                     uint32_t end) {
  l->step.item[l->step.count - 1] = step;
  return ARRAY_PUSH(&l->step, ((struct contour_step){end, SHEET_NONE})) &&
         loop_stack_measure_segment(l, l->step.count - 2);
}

/* ---- Thin loops ---------------------------------------------------------- */

struct page_loop loop_stack_loop(const struct loop_stack *l, size_t from,
                                 size_t to, double s) {
  struct page_segment first = loop_stack_image(l, from);
  double x0 = first.p.x + s * ((double)first.q.x - first.p.x);
  double y0 = first.p.y + s * ((double)first.q.y - first.p.y);
  double x = 0, y = 0, area = 0;
  struct page_loop loop = {.segments = to - from, .is_concave = true};
  for (size_t i = from + 1; i <= to; i++) {
    struct geom_point p = loop_stack_node(l, i)->page;
    const struct contour_segment *of =
        &l->set->segment.item[l->step.item[i].segment];
    curvature_squares_add(&loop.curvature, of->curvature);
    loop.has_crease = loop.has_crease || of->in_network;
    loop.is_concave = loop.is_concave && !(of->in_network && of->radial >= 0);
    double next_x = p.x - x0, next_y = p.y - y0;
    area += x * next_y - y * next_x;
    loop.length += vector2_length(next_x - x, next_y - y);
    loop.height += loop_stack_measure(l, i)->height;
    x = next_x;
    y = next_y;
  }
  loop.area = fabs(area);
  loop.length += vector2_length(x, y);
  loop.is_large = loop.length >= 2 * l->long_on_page &&
                  loop.length <= SLIVER_HEIGHTS * loop.height;
  loop.height /= (double)loop.segments;
  return loop;
}

/* ---- Taking loops off --------------------------------------------------- */

/* Adds the node at a place of a segment of the stack. */
static bool add_node_on(struct loop_stack *l, size_t i, double t,
                        uint32_t *node) {
  struct contour_node made = *loop_stack_node(l, i);
  const struct contour_node *next = loop_stack_node(l, i + 1);
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

bool loop_stack_take_off(struct loop_stack *l, size_t from, double s,
                         double t) {
  struct contour_step *step = l->step.item;
  size_t last = l->step.count - 2;
  struct page_segment a = loop_stack_image(l, from),
                      b = loop_stack_image(l, last);
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
  return loop_stack_measure_segment(l, from) &&
         loop_stack_measure_segment(l, from + 1);
}

size_t loop_stack_previous_in_box(const struct loop_stack *l, size_t i,
                                  size_t lowest, struct box2 box) {
  size_t at = i - l->first;
  while (at % BLOCK_SEGMENTS == 0 && at > lowest - l->first &&
         box2_disjoint(l->block.item[at / BLOCK_SEGMENTS - 1], box))
    at -= BLOCK_SEGMENTS;
  return at > 0 ? l->first + at - 1 : l->first;
}
