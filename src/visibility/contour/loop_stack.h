/* loop_stack.h - the segments of a contour curve, moved one by one to a stack,
 * from which loops of its image are taken off. */
#ifndef VISIBILITY_CONTOUR_LOOP_STACK_H
#define VISIBILITY_CONTOUR_LOOP_STACK_H

#include "visibility/contour/contour_curves.h"
#include "visibility/contour/page_loop.h"
#include "visibility/contour/segment_grid.h"

/* What is known of a segment of the stack. */
struct stack_segment {
  double length, height; /* of its triangle; on the page, grid units */
  double off; /* how far what became straight there is from it, at most; parts
                  that a loop was taken off from have 0 */
  struct box2 box; /* of its image */
  size_t turn;     /* the last node up to its first one at which the image turns
                  back; the curve's first: none */
};

struct loop_stack {
  struct zero_set *set;        /* borrowed, not owned */
  const struct camera *camera; /* the same */
  double long_on_page; /* of a loop whose half is as long: a large one; grid
                          units */
  ARRAY(struct contour_step) step; /* the stack; its last one has no segment */
  ARRAY(struct stack_segment) measure; /* one a segment of the curve */
  ARRAY(struct box2) block; /* of each few segments of the curve: a box about
                               their images */
  size_t first;             /* of the steps: the curve's */
};

/* Frees all but the steps. */
void loop_stack_fini(struct loop_stack *stack);

static inline const struct contour_node *
loop_stack_node(const struct loop_stack *l, size_t i) {
  return &l->set->node.item[l->step.item[i].node];
}

static inline struct page_segment loop_stack_image(const struct loop_stack *l,
                                                   size_t i) {
  return (struct page_segment){.p = loop_stack_node(l, i)->page,
                               .q = loop_stack_node(l, i + 1)->page};
}

static inline const struct stack_segment *
loop_stack_measure(const struct loop_stack *l, size_t i) {
  return &l->measure.item[i - l->first];
}

/* Moves a step to the stack, and the node where its segment ends.  Returns
 * false when memory ran out. */
USE_RESULT bool loop_stack_push(struct loop_stack *stack,
                                struct contour_step step, uint32_t end);

/* Measures the last segment of the stack, or the one before it; likewise. */
USE_RESULT bool loop_stack_measure_segment(struct loop_stack *stack, size_t i);

/* Measures the loop that begins on segment `from`, at `s` of it, and ends on
 * segment `to` there. */
struct page_loop loop_stack_loop(const struct loop_stack *stack, size_t from,
                                 size_t to, double s);

/* Takes off the loop from segment `from`, at s, to the last one, at t.  The
 * crossing is a node of the part that is nearer to the viewer.  Returns false
 * when memory ran out. */
USE_RESULT bool loop_stack_take_off(struct loop_stack *stack, size_t from,
                                    double s, double t);

/* The last segment before one, no lower than `lowest`, that a box may meet;
 * what is below where there is none. */
size_t loop_stack_previous_in_box(const struct loop_stack *stack, size_t i,
                                  size_t lowest, struct box2 box);

#endif
