/* judged.c - see judged.h. */
#include "tests/judged.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "judge/svg/svg.h"
#include "tests/scenes/judge_camera.h"

void judged_camera(struct judge_camera *camera,
                   const struct pipeline *pipeline) {
  const struct camera *used = &pipeline->camera;
  double matrix[12];
  camera_matrix(used, matrix);
  judge_camera_matrix(camera, matrix, used->page_mm[0], used->page_mm[1]);
  camera->margin_mm = used->margin_mm;
  if (used->perspective)
    camera->near_d = used->near_d;
}

void judged_assert(const struct scene *scene, const recto_options *options,
                   unsigned required, const char *name) {
  struct pipeline pipeline;
  struct judge_drawing drawing;
  struct judge_camera camera;
  struct judge_options judging;
  struct judge_verdict verdict;
  size_t length;
  pipeline_run(&pipeline, scene, options, &solver_newell);
  if (pipeline.status != RECTO_OK)
    fail_msg("%s: %s", name, pipeline.error.text);
  char *text = pipeline_svg(&pipeline, options, &length);
  assert_null(judge_read_svg(&drawing, text, length));
  judged_camera(&camera, &pipeline);
  judge_options_init(&judging);
  judging.edges = required;
  judging.contact = pipeline.camera.contact;
  judging.crease_deg = options->mesh.crease_deg;
  assert_true(judge_drawing(&verdict, &drawing, scene, &camera, &judging));
  if (verdict.false_ink.samples > 0)
    fail_msg("%s: false ink at %.4f %.4f and in %lu of %lu samples", name,
             verdict.false_at.at.x, verdict.false_at.at.y,
             (unsigned long)verdict.false_ink.samples,
             (unsigned long)verdict.drawn.samples);
  if (verdict.missing.samples > 0)
    fail_msg("%s: missing ink at %.4f %.4f and in %lu of %lu samples", name,
             verdict.missing_at.at.x, verdict.missing_at.at.y,
             (unsigned long)verdict.missing.samples,
             (unsigned long)verdict.visible.samples);
  judge_drawing_fini(&drawing);
  mem_free(text);
  pipeline_fini(&pipeline);
}

void judged_count_states(const struct pipeline *pipeline, unsigned count[3]) {
  memset(count, 0, 3 * sizeof *count);
  for (size_t i = 0; i < pipeline->map.edge_count; i++)
    if (pipeline->sheet.edge.item[i].edge_class != 0)
      count[pipeline->map.edge_state[i]]++;
}

double judged_area(const struct pipeline *pipeline, uint32_t face) {
  const struct map *map = &pipeline->map;
  double twice = 0;
  for (size_t i = 0; i < map->fragment.count; i++) {
    const struct map_fragment *fragment = &map->fragment.item[i];
    for (uint32_t l = 0; fragment->face == face && l < fragment->loops; l++) {
      const struct map_loop *loop = &map->loop.item[fragment->loop + l];
      const struct map_corner *corner = map->corner.item + loop->corner;
      for (uint32_t k = 0; k < loop->count; k++) {
        const struct map_corner *next = &corner[(k + 1) % loop->count];
        twice += corner[k].x * next->y - next->x * corner[k].y;
      }
    }
  }
  return twice / 2 / (SHEET_UNITS_PER_MM * SHEET_UNITS_PER_MM);
}

void judged_assert_near(double a, double b, double within, const char *name) {
  if (!(fabs(a - b) <= within))
    fail_msg("%s: %.9g is not %.9g (within %g)", name, a, b, within);
}
