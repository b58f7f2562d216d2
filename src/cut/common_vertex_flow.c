/* common_vertex_flow.c - opens the lines of a cut that would run past the
 * common vertex.
 *
 * Where the vertex that three planes have in common is outside the scene's box,
 * it is outside all solids: lines that would go around it there are of a
 * surface that is open, though they are closed. */
#include <string.h>

#include "base/union_find.h"
#include "cut/cut_phases.h"

/* Whether a point of a plane is on its common line before the common vertex. */
static bool is_before_common_vertex(const struct cutter *cutter, unsigned plane,
                                    uint32_t point) {
  unsigned on = cut_point_of(&cutter->points, point)->on;
  return on >> (plane + 1) % 3 & 1;
}

/* What runs past the common vertex in a plane. */
struct vertex_flow {
  uint32_t *set;     /* of connected points that were made */
  int32_t *of_set;   /* lines that end before it, less those that begin */
  int32_t *of_label; /* the same */
};

static void find_vertex_flow(const struct cutter *cutter, unsigned plane,
                             struct vertex_flow *flow) {
  uint32_t first = cutter->points.first;
  memset(flow->of_set, 0, cutter->points.point.count * sizeof *flow->of_set);
  memset(flow->of_label, 0,
         cutter->scene->group.count * sizeof *flow->of_label);
  for (size_t i = 0; i < cutter->lines.line.count; i++) {
    const struct cut_line *line = &cutter->lines.line.item[i];
    const uint32_t end[2] = {cut_place(cutter, line->from),
                             cut_place(cutter, line->to)};
    for (int k = 0; k < 2 && line->plane == plane && !line->open; k++)
      if (is_before_common_vertex(cutter, plane, end[k])) {
        flow->of_set[union_find_root(flow->set, end[k] - first)] += 2 * k - 1;
        flow->of_label[line->group] += 2 * k - 1;
      }
  }
}

/* Opens the lines that run past it, of labels of which the sum does. */
static void open_lines_of_flow(struct cutter *cutter,
                               const struct vertex_flow *flow,
                               uint32_t *open_at) {
  uint32_t first = cutter->points.first;
  for (size_t g = 0; g < cutter->scene->group.count; g++)
    cutter->cut->open += flow->of_label[g] != 0;
  for (size_t i = 0; i < cutter->lines.line.count; i++) {
    struct cut_line *line = &cutter->lines.line.item[i];
    uint32_t from = cut_place(cutter, line->from);
    if (line->open || flow->of_label[line->group] == 0 ||
        flow->of_set[union_find_root(flow->set, from - first)] == 0)
      continue;
    line->open = true;
    *open_at = *open_at == SCENE_NONE ? from : *open_at;
  }
}

bool cut_open_lines_past_vertex(struct cutter *cutter, uint32_t *open_at) {
  size_t points = cutter->points.point.count;
  uint32_t first = cutter->points.first;
  if (!cutter->has_common_vertex || cutter->common_vertex != SCENE_NONE)
    return true;
  struct vertex_flow flow = {
      .set = union_find_create(points),
      .of_set = mem_alloc(points, sizeof *flow.of_set),
      .of_label = mem_alloc(cutter->scene->group.count, sizeof *flow.of_label)};
  bool ok = flow.set != NULL && flow.of_set != NULL && flow.of_label != NULL;
  for (size_t i = 0; ok && i < cutter->lines.line.count; i++) {
    const struct cut_line *line = &cutter->lines.line.item[i];
    union_find_join(flow.set, cut_place(cutter, line->from) - first,
                    cut_place(cutter, line->to) - first);
  }
  for (unsigned plane = 0; ok && plane < 3; plane++) {
    find_vertex_flow(cutter, plane, &flow);
    open_lines_of_flow(cutter, &flow, open_at);
  }
  mem_free(flow.set);
  mem_free(flow.of_set);
  mem_free(flow.of_label);
  return ok;
}
