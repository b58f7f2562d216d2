/* reading.c - files given as text to a reader, and the result. */
#include "tests/reading.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/poll.h"
#include "scene/corner_normals.h"
#include "scene/read.h"

bool reading_takes_marks = true;

static void keep_warning(void *user, const char *file, unsigned long line,
                         const char *text) {
  struct reading *reading = user;
  int i = reading->warnings++;
  (void)file;
  if (i < READING_WARNINGS)
    snprintf(reading->warning[i], sizeof reading->warning[i], "%lu: %.250s",
             line, text);
}

void reading_init(struct reading *reading) {
  memset(reading, 0, sizeof *reading);
  scene_init(&reading->scene);
  reading->scene.needs_crease_marks = reading_takes_marks;
  reading->diagnostics.file = "file";
  reading->diagnostics.warning = keep_warning;
  reading->diagnostics.user = reading;
}

void reading_fini(struct reading *reading) { scene_fini(&reading->scene); }

recto_status reading_bytes(struct reading *reading, const struct reader *reader,
                           const char *bytes, size_t count) {
  char *block = malloc(count + 1);
  if (block == NULL)
    abort();
  memcpy(block, bytes, count);
  block[count] = '\0';
  reading->status =
      reader->read(&reading->scene, block, count, "file", reader->name,
                   &reading->diagnostics, &reading->error);
  free(block);
  return reading->status;
}

void reading_of(struct reading *reading, const struct reader *reader,
                const char *text) {
  reading_init(reading);
  (void)reading_bytes(reading, reader, text, strlen(text));
}

/* ---- Invariants ---------------------------------------------------------- */

static bool same_place(const struct scene_point *a,
                       const struct scene_point *b) {
  return a->x == b->x && a->y == b->y && a->z == b->z;
}

/* What is wrong with faces (`closed`) or polylines given by their arrays. */
static const char *element_fault(const struct scene *scene, bool closed,
                                 const uint32_t *start, size_t starts,
                                 const uint32_t *corner, size_t corners,
                                 const uint32_t *group, size_t count) {
  const struct scene_point *point = scene->point.item;
  if (count == 0)
    return starts == 0 && corners == 0 ? NULL : "corners of no element";
  if (starts != count + 1 || start[0] != 0 || start[count] != corners)
    return "starts do not fit the elements";
  for (size_t i = 0; i < corners; i++)
    if (corner[i] >= scene->point.count)
      return "corner out of range";
  for (size_t i = 0; i < count; i++) {
    uint32_t n = start[i + 1] - start[i];
    const uint32_t *c = corner + start[i];
    if (start[i + 1] < start[i] || n < (closed ? 3 : 2))
      return "too few corners";
    if (group[i] >= scene->group.count)
      return "group out of range";
    for (uint32_t k = 0; k + !closed < n; k++)
      if (same_place(&point[c[k]], &point[c[(k + 1) % n]]))
        return "neighbouring corners at one place";
  }
  return NULL;
}

/* The same for faces, whose starts and groups need not be stored. */
static const char *faces_fault(const struct scene *scene) {
  uint32_t faces = scene_face_count(scene);
  uint32_t *start = calloc(faces + 1, sizeof *start);
  uint32_t *group = calloc(faces + 1, sizeof *group);
  const char *fault = "no memory";
  if (start != NULL && group != NULL) {
    for (uint32_t f = 0; f <= faces; f++)
      start[f] = scene_face_start(scene, f);
    for (uint32_t f = 0; f < faces; f++)
      group[f] = scene_face_group(scene, f);
    size_t starts = scene->face_start.count, groups = scene->face_group.count;
    fault = element_fault(scene, true, start,
                          starts > 0  ? starts
                          : faces > 0 ? (size_t)faces + 1
                                      : 0,
                          scene->corner.item, scene->corner.count, group,
                          groups > 0 ? groups : faces);
  }
  free(start);
  free(group);
  return fault;
}

const char *reading_fault(const struct scene *scene) {
  for (size_t i = 0; i < scene->point.count; i++) {
    const struct scene_point *p = &scene->point.item[i];
    if (!isfinite(p->x) || !isfinite(p->y) || !isfinite(p->z))
      return "a point that is not finite";
  }
  for (size_t i = 0; i < scene->group.count; i++) {
    if (!scene->group.item[i].name || !*scene->group.item[i].name)
      return "a group without a name";
    for (size_t k = 0; k < i && i < 100; k++)
      if (strcmp(scene->group.item[i].name, scene->group.item[k].name) == 0)
        return "two groups of one name";
  }
  if (scene->point_normal.count > scene->point.count ||
      scene->corner_normal.count > scene->corner.count)
    return "normals of nothing";
  for (size_t i = 1; i < scene->smoothing.range.count; i++)
    if (scene->smoothing.range.item[i].first_face <
        scene->smoothing.range.item[i - 1].first_face)
      return "smoothing groups out of order";
  const char *fault = faces_fault(scene);
  if (fault != NULL)
    return fault;
  return element_fault(scene, false, scene->wire_start.item,
                       scene->wire_start.count, scene->wire_corner.item,
                       scene->wire_corner.count, scene->wire_group.item,
                       scene->wire_group.count);
}

static bool same_indices(const uint32_t *a, size_t a_count, const uint32_t *b,
                         size_t b_count) {
  return a_count == b_count &&
         (a_count == 0 || memcmp(a, b, a_count * sizeof *a) == 0);
}

#define SAME(a, b, array)                                                      \
  same_indices((a)->array.item, (a)->array.count, (b)->array.item,             \
               (b)->array.count)

static bool same_precision(const struct scene *a, const struct scene *b) {
  const struct precision_range *p = a->precision.item, *q = b->precision.item;
  if (a->precision.count != b->precision.count)
    return false;
  for (size_t i = 0; i < a->precision.count; i++)
    if (p[i].first_point != q[i].first_point || p[i].stated != q[i].stated ||
        p[i].precision.absolute != q[i].precision.absolute ||
        p[i].precision.relative != q[i].precision.relative)
      return false;
  return true;
}

static bool same_marks(const struct scene *a, const struct scene *b) {
  for (uint32_t c = 0; c < a->corner.count; c++)
    if (corner_normal_of(a, c) != corner_normal_of(b, c))
      return false;
  for (uint32_t f = 0; f < a->face_count; f++)
    if (smoothing_of_face(&a->smoothing, f) !=
        smoothing_of_face(&b->smoothing, f))
      return false;
  return true;
}

bool reading_same(const struct scene *a, const struct scene *b) {
  if (a->point.count != b->point.count || a->group.count != b->group.count)
    return false;
  for (size_t i = 0; i < a->point.count; i++)
    if (memcmp(&a->point.item[i], &b->point.item[i], sizeof *a->point.item))
      return false;
  for (size_t i = 0; i < a->group.count; i++)
    if (strcmp(a->group.item[i].name, b->group.item[i].name) != 0)
      return false;
  if (a->face_count != b->face_count)
    return false;
  for (uint32_t f = 0; f < a->face_count; f++)
    if (scene_face_start(a, f + 1) != scene_face_start(b, f + 1) ||
        scene_face_group(a, f) != scene_face_group(b, f))
      return false;
  return SAME(a, b, corner) && SAME(a, b, wire_start) &&
         SAME(a, b, wire_corner) && SAME(a, b, wire_group) && same_marks(a, b);
}

/* ---- Threads ------------------------------------------------------------- */

void reading_with_threads(struct reading *reading, const struct reader *reader,
                          const char *bytes, size_t count, const char *path,
                          int threads) {
  recto_options options;
  struct poll poll;
  recto_options_init(&options);
  options.solver.threads = threads;
  poll_open(&poll, &options);
  reading_init(reading);
  if (bytes != NULL)
    (void)reading_bytes(reading, reader, bytes, count);
  else
    reading->status = scene_read(&reading->scene, path, reader->name,
                                 &reading->diagnostics, &reading->error);
  poll_close(&poll);
}

static const char *reading_difference(const struct reading *a,
                                      const struct reading *b) {
  if (a->status != b->status)
    return "another status";
  if (a->status != RECTO_OK && (a->error.line != b->error.line ||
                                strcmp(a->error.text, b->error.text) != 0))
    return "another error";
  if (a->status == RECTO_OK && (!reading_same(&a->scene, &b->scene) ||
                                !same_precision(&a->scene, &b->scene)))
    return "another scene";
  if (a->warnings != b->warnings)
    return "another number of warnings";
  for (int i = 0; i < a->warnings && i < READING_WARNINGS; i++)
    if (strcmp(a->warning[i], b->warning[i]) != 0)
      return "another warning";
  return NULL;
}

static const char *parallel_fault(const struct reader *reader,
                                  const char *bytes, size_t count,
                                  const char *path) {
  struct reading one, several;
  reading_with_threads(&one, reader, bytes, count, path, 1);
  reading_with_threads(&several, reader, bytes, count, path, 4);
  const char *fault = reading_difference(&one, &several);
  reading_fini(&one);
  reading_fini(&several);
  return fault;
}

const char *reading_parallel_fault(const struct reader *reader,
                                   const char *bytes, size_t count) {
  return parallel_fault(reader, bytes, count, NULL);
}

const char *reading_parallel_file_fault(const struct reader *reader,
                                        const char *path) {
  return parallel_fault(reader, NULL, 0, path);
}
