/* target_svg.c - drawings of any bytes, given to the judge: refused with a
 * reason, or judged, in memory that the file's size explains. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "judge/judge.h"
#include "judge/svg/svg.h"
#include "tests/fuzz/fuzz.h"

enum {
  /* Curves of few bytes may become many points, but not any number:
   * svg.c allows about 2^20 and some for each byte. */
  POINTS_AT_LEAST = 1 << 20,
  POINTS_A_BYTE = 1000,
  SAMPLES = 50
};

/* A square of 100 mm and a triangle that stands out of it, seen from above on
 * a page of 200 mm. */
static void fill_scene(struct scene *scene) {
  static const struct scene_point point[] = {
      {50, 50, 0},   {150, 50, 0},  {150, 150, 0}, {50, 150, 0},
      {20, 100, -5}, {100, 100, 5}, {100, 180, 5}};
  static const uint32_t corner[] = {0, 1, 2, 3, 4, 5, 6};
  for (size_t i = 0; i < sizeof point / sizeof point[0]; i++)
    if (!ARRAY_PUSH(&scene->point, point[i]))
      abort();
  if (scene_add_face(scene, corner, 4, 0, NULL, NULL) != RECTO_OK ||
      scene_add_face(scene, corner + 4, 3, 0, NULL, NULL) != RECTO_OK)
    abort();
}

static bool is_sound(const struct judge_count *count) {
  return isfinite(count->mm) && count->mm >= 0;
}

static void judge(const struct judge_drawing *drawing,
                  struct fuzz_finding *finding) {
  static const double right[3] = {1, 0, 0}, up[3] = {0, 1, 0},
                      back[3] = {0, 0, 1}, eye[3] = {0, 0, 100},
                      middle[2] = {0, 0}, page[2] = {200, 200};
  struct judge_camera camera;
  struct judge_options options;
  struct judge_verdict v;
  struct scene scene;
  scene_init(&scene);
  fill_scene(&scene);
  judge_options_init(&options);
  judge_camera_axes(&camera, right, up, back, eye, false, 1, middle, page);
  options.samples = SAMPLES;
  if (!judge_drawing(&v, drawing, &scene, &camera, &options))
    abort();
  if (!is_sound(&v.drawn) || !is_sound(&v.false_ink) ||
      !is_sound(&v.undecided_ink) || !is_sound(&v.visible) ||
      !is_sound(&v.missing))
    fuzz_found(finding, "the verdict has a length that is no length");
  scene_fini(&scene);
}

static void run(const uint8_t *bytes, size_t count,
                struct fuzz_finding *finding) {
  struct judge_drawing drawing = {0};
  /* A block of just this size, with nothing behind it. */
  char *block = malloc(count > 0 ? count : 1);
  if (block == NULL)
    abort();
  if (count > 0)
    memcpy(block, bytes, count);
  const char *fault = judge_read_svg(&drawing, block, count);
  free(block);
  if (fault != NULL && *fault == '\0')
    fuzz_found(finding, "refused without a reason");
  if (drawing.point.count > POINTS_AT_LEAST + POINTS_A_BYTE * count)
    fuzz_found(finding, "%zu bytes become %zu points", count,
               drawing.point.count);
  for (size_t i = 0; i < drawing.point.count; i++)
    if (!isfinite(drawing.point.item[i].x) ||
        !isfinite(drawing.point.item[i].y))
      fuzz_found(finding, "a point that is not finite");
  if (fault == NULL)
    judge(&drawing, finding);
  judge_drawing_fini(&drawing);
}

const struct fuzz_target fuzz_target_svg = {"svg", run, NULL};
