/* import_format.c - what the importer hands over becomes part of the scene.
 *
 * Robustness  A broken model may make the importer write anything: all counts
 * are compared with the bytes that there are, points must be finite and
 * indices in range. */
#include "scene/readers/import_format.h"

#include <math.h>
#include <string.h>

#include "scene/corner_normals.h"
#include "scene/diagnostics.h"
#include "scene/limit.h"
#include "scene/readers/unusable.h"

struct import_parser {
  struct scene *scene;
  const char *at, *end;
  const char *path, *format;
  long mb;
  struct import_record record; /* the current one */
  const char *name, *point, *normal, *count, *index;
  ARRAY(uint32_t) corner;
  struct unusable unusable;
  struct diagnostics *diagnostics;
  recto_error *error;
};

static recto_status import_fault(const struct import_parser *f) {
  return error_set(f->error, RECTO_ERROR_FORMAT, f->path, 0,
                   "malformed output of the importer");
}

/* The next `count` items of that size; NULL where there are fewer. */
static const char *next_items(struct import_parser *f, uint64_t count,
                              size_t size) {
  const char *start = f->at;
  if (count > (size_t)(f->end - f->at) / size)
    return NULL;
  f->at += count * size;
  return start;
}

static uint32_t load(const char *array, size_t i) {
  uint32_t value;
  memcpy(&value, array + i * sizeof value, sizeof value);
  return value;
}

/* Finds the parts of the next record; false where they are not all there. */
static bool next_record(struct import_parser *f) {
  struct import_record *r = &f->record;
  const char *start = next_items(f, 1, sizeof *r);
  if (start == NULL)
    return false;
  memcpy(r, start, sizeof *r);
  if (r->kind != IMPORT_MESH)
    r->points = r->normals = r->elements = r->corners = 0;
  return (r->normals == 0 || r->normals == r->points) &&
         (f->name = next_items(f, r->name_length, 1)) != NULL &&
         (f->point = next_items(f, r->points, 3 * sizeof(double))) != NULL &&
         (f->normal = next_items(f, r->normals, 3 * sizeof(float))) != NULL &&
         (f->count = next_items(f, r->elements, sizeof(uint32_t))) != NULL &&
         (f->index = next_items(f, r->corners, sizeof(uint32_t))) != NULL;
}

/* ---- Meshes -------------------------------------------------------------- */

static recto_status use_import_group(struct import_parser *f) {
  recto_status status = scene_use_group(
      f->scene, f->name, (size_t)f->record.name_length, f->error);
  if (status == RECTO_OK && f->record.has_colour) {
    struct scene_group *group = &f->scene->group.item[f->scene->current_group];
    group->colour = f->record.colour & 0xffffff;
    group->has_colour = true;
  }
  return status;
}

static recto_status add_import_points(struct import_parser *f) {
  struct scene *scene = f->scene;
  size_t count = (size_t)f->record.points, first = scene->point.count;
  if (count > SCENE_LIMIT - first)
    return error_set(f->error, RECTO_ERROR_LIMIT, f->path, 0,
                     "the scene has more than 2^31 points");
  f->unusable.point.count = 0;
  if (!ARRAY_RESERVE(&scene->point, count))
    return error_memory(f->error);
  for (size_t i = 0; i < count; i++) {
    struct scene_point point;
    memcpy(&point, f->point + i * sizeof point, sizeof point);
    if (!isfinite(point.x) || !isfinite(point.y) || !isfinite(point.z)) {
      diagnostics_fault(f->diagnostics, SCENE_FAULT_NOT_FINITE, 0,
                        "point that is not finite; its faces are skipped");
      if (!ARRAY_PUSH(&f->unusable.point, (uint32_t)(first + i)))
        return error_memory(f->error);
    }
    scene->point.item[scene->point.count++] = point;
  }
  unusable_replace(&f->unusable, scene, first);
  return RECTO_OK;
}

/* Adds the normals of the points that were added last. */
static recto_status add_import_normals(struct import_parser *f, size_t first) {
  struct scene *scene = f->scene;
  if (!scene->needs_crease_marks || f->record.normals == 0)
    return RECTO_OK;
  if (!corner_normals_begin_points(scene))
    return error_memory(f->error);
  for (size_t i = first; i < scene->point.count; i++) {
    float n[3];
    memcpy(n, f->normal + (i - first) * sizeof n, sizeof n);
    scene->point_normal.item[i] =
        corner_normal_encode((double)n[0], (double)n[1], (double)n[2]);
  }
  return RECTO_OK;
}

/* Adds the element whose corners are the `count` indices from `start` on. */
static recto_status add_element(struct import_parser *f, size_t first,
                                uint64_t start, uint32_t count) {
  f->corner.count = 0;
  if (!ARRAY_RESERVE(&f->corner, count))
    return error_memory(f->error);
  for (size_t i = 0; i < count; i++) {
    uint32_t index = load(f->index, (size_t)start + i);
    f->corner.item[f->corner.count++] =
        index < f->record.points ? (uint32_t)(first + index) : SCENE_NONE;
  }
  if (unusable_has_any(&f->unusable, f->corner.item, count)) {
    diagnostics_fault(f->diagnostics, SCENE_FAULT_NOT_FINITE, 0,
                      "face with a point that is not finite, skipped");
    return count == 2 ? RECTO_OK : scene_skip_face(f->scene, f->error);
  }
  if (count == 2)
    return scene_add_wire(f->scene, f->corner.item, count, 0, f->diagnostics,
                          f->error);
  return scene_add_face(f->scene, f->corner.item, count, 0, f->diagnostics,
                        f->error);
}

/* Elements of a single corner are nothing to us. */
static recto_status add_mesh(struct import_parser *f) {
  size_t first = f->scene->point.count;
  recto_status status = use_import_group(f);
  if (status == RECTO_OK)
    status = add_import_points(f);
  if (status == RECTO_OK)
    status = add_import_normals(f, first);
  uint64_t start = 0;
  for (size_t i = 0; i < f->record.elements && status == RECTO_OK; i++) {
    uint32_t count = load(f->count, i);
    if (count > f->record.corners - start)
      return import_fault(f);
    if (count >= 2)
      status = add_element(f, first, start, count);
    start += count;
  }
  return status;
}

/* ---- Records ------------------------------------------------------------- */

/* Adds the files to those that no output may replace. */
static recto_status add_files(struct import_parser *f) {
  size_t count = (size_t)f->record.name_length / sizeof(struct file_identity);
  if (f->record.name_length % sizeof(struct file_identity) != 0)
    return import_fault(f);
  if (!ARRAY_RESERVE(&f->scene->file, count))
    return error_memory(f->error);
  for (size_t i = 0; i < count; i++)
    memcpy(&f->scene->file.item[f->scene->file.count++],
           f->name + i * sizeof(struct file_identity),
           sizeof(struct file_identity));
  return RECTO_OK;
}

/* Warns of an error that the importer read on after. */
static recto_status warn_of_import(const struct import_parser *f) {
  const struct import_record *r = &f->record;
  diagnostics_fault(f->diagnostics, SCENE_FAULT_SYNTAX, 0,
                    "parts of the model may be missing: %.*s",
                    r->name_length < 200 ? (int)r->name_length : 200, f->name);
  return RECTO_OK;
}

static recto_status importer_error(const struct import_parser *f) {
  const struct import_record *r = &f->record;
  if (r->why == IMPORT_UNKNOWN_FORMAT)
    return error_set(f->error, RECTO_ERROR_UNSUPPORTED, f->path, 0,
                     "no reader for the format '%s'", f->format);
  if (r->why == IMPORT_NO_MEMORY)
    return error_set(f->error, RECTO_ERROR_LIMIT, f->path, 0,
                     "the importer needs more than %ld MB", f->mb);
  return error_set(f->error, RECTO_ERROR_FORMAT, f->path, 0, "%.*s",
                   r->name_length < 200 ? (int)r->name_length : 200, f->name);
}

recto_status import_format_read(struct scene *scene, const char *bytes,
                                size_t count, const char *path,
                                const char *format, long mb,
                                struct diagnostics *diagnostics,
                                recto_error *error) {
  struct import_parser f = {.scene = scene,
                            .at = bytes,
                            .end = bytes + count,
                            .path = path,
                            .format = format,
                            .mb = mb,
                            .diagnostics = diagnostics,
                            .error = error};
  const char *magic = next_items(&f, sizeof IMPORT_MAGIC - 1, 1);
  recto_status status = RECTO_OK;
  bool ok = false;
  if (magic == NULL ||
      memcmp(magic, IMPORT_MAGIC, sizeof IMPORT_MAGIC - 1) != 0)
    status = import_fault(&f);
  while (status == RECTO_OK && !ok) {
    if (!next_record(&f))
      status = import_fault(&f);
    else if (f.record.kind == IMPORT_MESH)
      status = add_mesh(&f);
    else if (f.record.kind == IMPORT_FILES)
      status = add_files(&f);
    else if (f.record.kind == IMPORT_ERROR)
      status = warn_of_import(&f);
    else if (f.record.kind == IMPORT_FAILED)
      status = importer_error(&f);
    else if (f.record.kind == IMPORT_DONE)
      ok = true;
    else
      status = import_fault(&f);
  }
  if (ok && f.record.unit_mm > 0 && isfinite(f.record.unit_mm))
    scene->file_unit_mm = f.record.unit_mm;
  ARRAY_FREE(&f.corner);
  ARRAY_FREE(&f.unusable.point);
  return status;
}

bool import_format_is_whole(const char *bytes, size_t count) {
  struct import_record last;
  if (count < sizeof last)
    return false;
  memcpy(&last, bytes + count - sizeof last, sizeof last);
  return last.kind == IMPORT_DONE && last.name_length == 0;
}
