/* judge_context.c - what is built of a drawing and its scene before
 * sampling. */
#include "judge/judge_context.h"

#include <math.h>

#include "base/poll.h"
#include "base/tolerance.h"
#include "judge/contact.h"
#include "judge/open_surfaces.h"

static void collect_strokes(struct judge_context *context, enum judge_role role,
                            uint32_t *count) {
  const struct judge_drawing *drawing = context->drawing;
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    const struct judge_stroke *stroke = &drawing->stroke.item[i];
    (void)poll_at(i);
    for (uint32_t k = 1; stroke->role == role && k < stroke->count; k++) {
      const struct judge_point2 *at =
          &drawing->point.item[stroke->point + k - 1];
      context->ink[context->inks + context->drops] =
          (struct judge_segment){at[0], at[1]};
      ++*count;
    }
  }
}

static bool collect_ink(struct judge_context *context) {
  context->ink = mem_alloc(context->drawing->point.count, sizeof *context->ink);
  if (context->ink == NULL)
    return false;
  collect_strokes(context, JUDGE_INK, &context->inks);
  collect_strokes(context, JUDGE_DROPPED, &context->drops);
  return true;
}

static bool collect_images(struct judge_context *context) {
  size_t count = context->edges.edge.count;
  context->image = mem_alloc(count, sizeof *context->image);
  if (context->image == NULL)
    return false;
  for (size_t i = 0; i < count && poll_at(i); i++) {
    const struct judge_edge *edge = &context->edges.edge.item[i];
    context->image[i] = (struct judge_segment){edge->at[0], edge->at[1]};
    if (edge->source.near_mm > context->options.lateral_mm &&
        !ARRAY_PUSH(&context->shallow, (uint32_t)i))
      return false;
  }
  return true;
}

/* The largest rounding error at the corners of the scene's bounding box. */
static double largest_rounding(const struct judge_context *context) {
  double most = 0;
  for (int corner = 0; context->all.nodes > 0 && corner < 8; corner++) {
    const struct judge_box *box = &context->all.node[0].box;
    struct judge_point3 at = {(corner & 1 ? box->high : box->low)[0],
                              (corner & 2 ? box->high : box->low)[1],
                              (corner & 4 ? box->high : box->low)[2]};
    most = fmax(most, judge_rounding_at(&context->camera,
                                        context->sampler.ray_offset_mm, at));
  }
  return most;
}

/* What is removed of the triangles, with the limits of doubles. */
static void set_removed(struct judge_context *context) {
  struct judge_removed *removed = &context->all.removed;
  *removed = context->options.removed;
  removed->near = context->all.size * TOLERANCE_JUDGE_CUT_SHARE;
  for (size_t t = 0; removed->planes > 0 && t < context->all.triangle.count;
       t++)
    removed->contact =
        fmax(removed->contact, context->all.triangle.item[t].contact);
  if (removed->planes > 0)
    context->camera.near_error = removed->near;
}

bool judge_context_build(struct judge_context *context,
                         const struct scene *scene) {
  const struct judge_camera *camera = &context->camera;
  double width = camera->width_mm, height = camera->height_mm;
  const double cells = 400;
  double cell = fmax(width, height) / cells;
  if (!judge_triangles_init(&context->all, scene, context->options.given,
                            context->options.contact) ||
      !judge_contact_set(&context->all, &context->options))
    return false;
  set_removed(context);
  context->sampler = (struct judge_sampler){&context->all, camera,
                                            context->options.ray_offset_mm};
  context->grid = largest_rounding(context);
  return judge_edges_init(&context->edges, &context->all, camera,
                          &context->options) &&
         judge_mark_borders(&context->all, context->edges.border) &&
         collect_images(context) && collect_ink(context) &&
         judge_grid_init(&context->by_image, context->image,
                         (uint32_t)context->edges.edge.count, width, height,
                         cell, context->options.lateral_mm) &&
         judge_grid_init(&context->by_ink, context->ink,
                         context->inks + context->drops, width, height, cell,
                         context->options.ink_distance_mm);
}

void judge_context_fini(struct judge_context *context) {
  judge_grid_fini(&context->by_image);
  judge_grid_fini(&context->by_ink);
  ARRAY_FREE(&context->shallow);
  mem_free(context->image);
  mem_free(context->ink);
  judge_edges_fini(&context->edges);
  (void)poll_now();
  judge_triangles_fini(&context->all);
}
