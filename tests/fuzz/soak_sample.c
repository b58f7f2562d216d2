/* soak_sample.c - see soak_sample.h. */
#include "tests/fuzz/soak_sample.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/stream.h"
#include "tests/fuzz/decode.h"
#include "tests/fuzz/soak_kinds.h"
#include "tests/scenes/write_obj.h"

_Noreturn void soak_fail(const char *what, const char *where) {
  fprintf(stderr, "soak: %s: %s\n", where, what);
  exit(2);
}

void sample_add_word(struct sample *sample, const char *format, ...) {
  va_list arguments;
  if (sample->words == SAMPLE_WORDS_MAX)
    soak_fail("too many words", sample->kind);
  va_start(arguments, format);
  vsnprintf(sample->word[sample->words++], SAMPLE_WORD_SIZE, format, arguments);
  va_end(arguments);
}

/* ---- Options ------------------------------------------------------------- */

/* Half of the time the first, which says nothing. */
static void add_options(struct sample *sample, struct random *random) {
  static const char *const option[][6] = {
      {"", "--edges=all", "--edges=silhouette,border", "--edges=intersection"},
      {"", "--fill=paint", "--fill=shade", "--fill=hatch"},
      {"", "", "--light=1,2,3"},
      {"", "--hidden=dashed", "--hidden=layer", "--hidden=2"},
      {"", "--contact=0"},
      {"", "--crease=0", "--crease=90", "--crease=180", "--crease=20,50"},
      {"", "--exact", "--min-stroke=0"},
      {"", "--page=50x200", "--page=A5"},
      {"", "--order=near", "--ids"},
      {"", "", "--contours=smooth"},
      {"", "", "--curves=0.1", "--curves=3"},
      {"", "", "--threads=2"}};
  bool has_threads = false;
  for (size_t i = 0; i < sizeof option / sizeof *option; i++) {
    unsigned count = 0;
    while (count < 6 && option[i][count] != NULL)
      count++;
    unsigned chosen = random_below(random, 2) ? random_below(random, count) : 0;
    if (*option[i][chosen] != '\0')
      sample_add_word(sample, "%s", option[i][chosen]);
    has_threads = strcmp(option[i][chosen], "--threads=2") == 0;
  }
  if (!has_threads)
    sample_add_word(sample, "--threads=1");
}

/* A point of the scene, or one of the box about it. */
static struct vector choose_place(const struct scene *scene,
                                  struct random *random) {
  struct vector low = {INFINITY, INFINITY, INFINITY};
  struct vector high = {-INFINITY, -INFINITY, -INFINITY};
  size_t count = scene->point.count;
  if (count == 0)
    return vector_of(0, 0, 0);
  const struct scene_point *p =
      &scene->point.item[random_below(random, (uint32_t)count)];
  if (random_below(random, 2))
    return vector_of(p->x, p->y, p->z);
  for (size_t i = 0; i < count; i++) {
    p = &scene->point.item[i];
    low = vector_of(fmin(low.x, p->x), fmin(low.y, p->y), fmin(low.z, p->z));
    high =
        vector_of(fmax(high.x, p->x), fmax(high.y, p->y), fmax(high.z, p->z));
  }
  double x = random_between(random, low.x, high.x);
  double y = random_between(random, low.y, high.y);
  return vector_of(x, y, random_between(random, low.z, high.z));
}

/* One scene in four is cut, by one plane mostly: across an axis or in any
 * direction, through a corner or not. */
static void add_cuts(struct sample *sample, const struct scene *scene,
                     struct random *random) {
  static const char *const fill[] = {"none", "solid", "hatch"};
  unsigned planes = random_below(random, 4) ? 1 : 2 + random_below(random, 2);
  if (random_below(random, 4) > 0)
    return;
  for (unsigned i = 0; i < planes; i++) {
    struct vector at = choose_place(scene, random);
    unsigned axis = random_below(random, 4);
    double normal[3];
    for (unsigned k = 0; k < 3; k++)
      normal[k] = axis == 3 ? random_between(random, -1, 1) : k == axis;
    if (random_below(random, 2))
      for (unsigned k = 0; k < 3; k++)
        normal[k] = -normal[k];
    sample_add_word(sample, "--cut=%.17g,%.17g,%.17g,%.17g", normal[0],
                    normal[1], normal[2],
                    normal[0] * at.x + normal[1] * at.y + normal[2] * at.z);
  }
  sample_add_word(sample, "--cut-fill=%s", fill[random_below(random, 3)]);
}

/* ---- Views --------------------------------------------------------------- */

static void add_direction(struct sample *sample, struct random *random) {
  static const double right[] = {0, 90, 180, 45, 26.56505117707799, 1e-7};
  bool special = random_below(random, 3) == 0;
  sample_add_word(sample, "--azimuth=%.17g",
                  special ? right[random_below(random, 6)]
                          : random_between(random, -180, 180));
  sample_add_word(sample, "--elevation=%.17g",
                  special ? right[random_below(random, 2)]
                          : random_between(random, -90, 90));
  if (random_below(random, 3) == 0)
    sample_add_word(sample, "--fov=%d", random_int(random, 5, 120));
}

static void add_eye(struct sample *sample, struct vector eye,
                    struct vector target, double fov_deg) {
  sample_add_word(sample, "--camera=%.17g,%.17g,%.17g", eye.x, eye.y, eye.z);
  sample_add_word(sample, "--lookat=%.17g,%.17g,%.17g", target.x, target.y,
                  target.z);
  if (fov_deg > 0)
    sample_add_word(sample, "--fov=%.17g", fov_deg);
  else
    sample_add_word(sample, "--ortho");
}

static void add_own_camera(struct sample *sample,
                           const recto_camera_options *camera) {
  const double *eye = camera->eye, *target = camera->target;
  if (camera->kind == RECTO_CAMERA_EYE && camera->has_target) {
    add_eye(sample, vector_of(eye[0], eye[1], eye[2]),
            vector_of(target[0], target[1], target[2]), camera->fov_deg);
    return;
  }
  sample_add_word(sample, "--azimuth=%.17g", camera->azimuth_deg);
  sample_add_word(sample, "--elevation=%.17g", camera->elevation_deg);
}

static void add_sheet(struct sample *sample, struct random *random) {
  static const char *const views[] = {"", "front,left,iso:2",
                                      "front,back,bottom", "top,right,dimetric",
                                      "left"};
  const char *chosen = views[random_below(random, 5)];
  sample_add_word(sample, "--sheet=%s",
                  random_below(random, 2) ? "third" : "first");
  if (*chosen != '\0')
    sample_add_word(sample, "--views=%s", chosen);
  if (random_below(random, 2))
    sample_add_word(sample, "--view-names");
  if (random_below(random, 4) == 0)
    sample_add_word(sample, "--detail=%d,%d,10,2", random_int(random, 20, 60),
                    random_int(random, 20, 60));
}

/* A sheet, the generator's camera, an eye near the scene or in it, or a
 * direction. */
static void add_view(struct sample *sample, const struct scene *scene,
                     const recto_camera_options *camera,
                     struct random *random) {
  bool has_up = camera->up[0] != 0 || camera->up[1] != 0;
  unsigned chosen = random_below(random, 10);
  if (chosen == 0) {
    add_sheet(sample, random);
  } else if (chosen < 4) {
    add_own_camera(sample, camera);
  } else if (chosen == 4) {
    struct vector eye = choose_place(scene, random);
    add_eye(sample, eye, choose_place(scene, random),
            random_int(random, 20, 120));
  } else {
    add_direction(sample, random);
  }
  if (chosen > 0 && chosen < 4 && has_up)
    sample_add_word(sample, "--up=%.17g,%.17g,%.17g", camera->up[0],
                    camera->up[1], camera->up[2]);
  else
    sample_add_word(sample, "--up=0,0,1");
}

/* ---- Scenes -------------------------------------------------------------- */

static void set_obj(struct sample *sample, const char *text, size_t length) {
  if (length >= SAMPLE_TEXT_MAX)
    soak_fail("too long", sample->kind);
  memcpy(sample->obj, text, length);
  sample->obj[length] = '\0';
  sample->length = length;
}

static void make_generated(struct sample *sample, struct random *random) {
  const struct soak_kind *kind =
      &soak_kinds[random_below(random, soak_kind_count)];
  struct scene scene;
  recto_options options;
  struct stream *stream;
  size_t length;
  snprintf(sample->kind, sizeof sample->kind, "%s", kind->name);
  scene_init(&scene);
  recto_options_init(&options);
  kind->make(&scene, &options, random);
  if (stream_open_memory(&stream, NULL) != RECTO_OK)
    soak_fail("no memory", kind->name);
  scene_write_obj(&scene, stream);
  const char *text = stream_memory(stream, &length);
  set_obj(sample, text, length);
  stream_discard(stream);
  add_options(sample, random);
  add_cuts(sample, &scene, random);
  add_view(sample, &scene, &options.camera, random);
  scene_fini(&scene);
}

/* As the fuzzer's, whose words name the files last. */
static void make_lattice(struct sample *sample, struct random *random) {
  static struct decoded decoded;
  uint8_t bytes[120];
  for (size_t i = 0; i < sizeof bytes; i++)
    bytes[i] =
        i < 20 && random_below(random, 2) ? 0 : (uint8_t)random_next(random);
  decode_scene(&decoded, bytes, sizeof bytes);
  snprintf(sample->kind, sizeof sample->kind, "lattice");
  set_obj(sample, decoded.obj, decoded.obj_length);
  for (int i = 1; i + 3 < decoded.argc; i++)
    sample_add_word(sample, "%s", decoded.argv[i]);
}

void sample_make(struct sample *sample, uint64_t seed) {
  struct random random = {seed};
  sample->words = 0;
  if (random_below(&random, 4) == 0)
    make_lattice(sample, &random);
  else
    make_generated(sample, &random);
}
