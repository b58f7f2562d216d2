/* plan_section.c - writes and reads the sections of a plan, by one description
 * of the format. */
#include "parts/plan_section.h"

#include <string.h>

#include "parts/byte_codec.h"
#include "scene/limit.h"

enum { HEADER_BYTES = 96 };

/* How many there are of all, as the header of a section has it. */
struct section_counts {
  uint64_t points, ranges, faces, corners, runs, wires, wire_corners;
  bool are_triangles; /* so that no face needs a start */
};

/* Faces of one group that follow one another. */
struct group_runs {
  uint32_t *first, *group;
};

struct section_work {
  struct plan_bytes *bytes;
  struct plan_section *section;
  const struct plan_section_form *form;
  struct section_counts counts;
  struct group_runs runs;
  /* Of the ranges of precision: */
  uint8_t *stated;
  double *precision; /* absolute, relative */
  uint32_t *first_point;
};

static void section_work_fini(struct section_work *work) {
  mem_free(work->runs.first);
  mem_free(work->runs.group);
  mem_free(work->stated);
  mem_free(work->precision);
  mem_free(work->first_point);
}

/* ---- The header ---------------------------------------------------------- */

static void code_header(struct byte_codec *codec, struct section_work *work) {
  struct section_counts *counts = &work->counts;
  uint64_t *const all[] = {
      &counts->points, &counts->ranges, &counts->faces,       &counts->corners,
      &counts->runs,   &counts->wires,  &counts->wire_corners};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
    byte_codec_u64(codec, all[i]);
    byte_codec_require(codec, *all[i] < SCENE_LIMIT);
  }
  byte_codec_bool(codec, &counts->are_triangles);
  byte_codec_u32(codec, &work->section->index);
  for (int k = 0; k < 2; k++) {
    byte_codec_u32(codec, (uint32_t *)&work->section->window.low[k]);
    byte_codec_u32(codec, (uint32_t *)&work->section->window.high[k]);
  }
  byte_codec_require(codec, !counts->are_triangles ||
                                counts->corners == 3 * counts->faces);
}

/* ---- Arrays -------------------------------------------------------------- */

/* Takes one array after the other. */
typedef void array_fn(struct section_work *work, void *item, uint64_t count,
                      size_t size, uint64_t *sum);

static void add_array_size(struct section_work *work, void *item,
                           uint64_t count, size_t size, uint64_t *sum) {
  (void)work;
  (void)item;
  *sum += plan_bytes_size(count, size);
}

static void code_array(struct section_work *work, void *item, uint64_t count,
                       size_t size, uint64_t *sum) {
  (void)sum;
  plan_bytes_array(work->bytes, item, (size_t)count, size);
}

static uint64_t starts_of(uint64_t count) { return count > 0 ? count + 1 : 0; }

/* The arrays of a section, in their order. */
static void take_arrays(struct section_work *work, array_fn *take,
                        uint64_t *sum) {
  const struct section_counts *n = &work->counts;
  struct part_scene *part = &work->section->part;
  struct scene *scene = &part->scene;
  uint64_t with_ids = work->form->has_ids, with_tones = work->form->has_tones,
           with_marks = work->form->has_marks;
  take(work, part->point_number, n->points, 4, sum);
  take(work, scene->point.item, 3 * n->points, 8, sum);
  take(work, work->first_point, n->ranges, 4, sum);
  take(work, work->stated, n->ranges, 1, sum);
  take(work, work->precision, 2 * n->ranges, 8, sum);
  take(work, part->face_number, n->faces, 4, sum);
  if (!n->are_triangles)
    take(work, scene->face_start.item, starts_of(n->faces), 4, sum);
  take(work, scene->corner.item, n->corners, 4, sum);
  take(work, part->is_kept, n->faces, 1, sum);
  take(work, work->runs.first, n->runs, 4, sum);
  take(work, work->runs.group, n->runs, 4, sum);
  take(work, part->face_in_group, with_ids * n->faces, 4, sum);
  take(work, work->section->tone, with_tones * n->corners, 4, sum);
  take(work, work->section->uniform, with_tones * n->faces, 1, sum);
  take(work, part->crease_mark, with_marks * n->corners, 1, sum);
  take(work, part->wire_number, n->wires, 4, sum);
  take(work, scene->wire_start.item, starts_of(n->wires), 4, sum);
  take(work, scene->wire_corner.item, n->wire_corners, 4, sum);
  take(work, scene->wire_group.item, n->wires, 4, sum);
  take(work, part->wire_in_group, with_ids * n->wires, 4, sum);
}

/* Makes room for as much as the file has of an array. */
static void *make_room(uint64_t count, size_t size) {
  return mem_alloc(plan_bytes_room((size_t)count, size), size);
}

/* The same for an array that grows. */
#define MAKE_ROOM(array, size, number)                                         \
  (ARRAY_RESERVE((array), plan_bytes_room((size_t)(number), (size)))           \
       ? ((array)->count = (size_t)(number), true)                             \
       : false)

static bool make_room_for_wires(struct section_work *work) {
  const struct section_counts *n = &work->counts;
  struct part_scene *part = &work->section->part;
  struct scene *scene = &part->scene;
  part->wire_number = make_room(n->wires, 4);
  if (work->form->has_ids)
    part->wire_in_group = make_room(n->wires, 4);
  return part->wire_number != NULL &&
         (!work->form->has_ids || part->wire_in_group != NULL) &&
         MAKE_ROOM(&scene->wire_start, 4, starts_of(n->wires)) &&
         MAKE_ROOM(&scene->wire_corner, 4, n->wire_corners) &&
         MAKE_ROOM(&scene->wire_group, 4, n->wires);
}

static bool make_room_for_marks(struct section_work *work) {
  struct part_scene *part = &work->section->part;
  if (work->form->has_marks)
    part->crease_mark = make_room(work->counts.corners, 1);
  return !work->form->has_marks || part->crease_mark != NULL;
}

static bool make_room_for_tones(struct section_work *work) {
  struct plan_section *section = work->section;
  if (!work->form->has_tones)
    return true;
  section->tone = make_room(work->counts.corners, 4);
  section->uniform = make_room(work->counts.faces, 1);
  return section->tone != NULL && section->uniform != NULL;
}

/* Makes room for all arrays that are read. */
static bool make_room_for_section(struct section_work *work) {
  const struct section_counts *n = &work->counts;
  struct part_scene *part = &work->section->part;
  struct scene *scene = &part->scene;
  part->point_number = make_room(n->points, 4);
  work->first_point = make_room(n->ranges, 4);
  work->stated = make_room(n->ranges, 1);
  work->precision = make_room(2 * n->ranges, 8);
  scene->face_count = (uint32_t)n->faces;
  part->face_number = make_room(n->faces, 4);
  part->is_kept = make_room(n->faces, 1);
  work->runs.first = make_room(n->runs, 4);
  work->runs.group = make_room(n->runs, 4);
  if (work->form->has_ids)
    part->face_in_group = make_room(n->faces, 4);
  return part->point_number != NULL && work->first_point != NULL &&
         work->stated != NULL && work->precision != NULL &&
         part->face_number != NULL && part->is_kept != NULL &&
         work->runs.first != NULL && work->runs.group != NULL &&
         (!work->form->has_ids || part->face_in_group != NULL) &&
         MAKE_ROOM(&scene->point, sizeof *scene->point.item, n->points) &&
         (n->are_triangles ||
          MAKE_ROOM(&scene->face_start, 4, starts_of(n->faces))) &&
         MAKE_ROOM(&scene->corner, 4, n->corners) &&
         make_room_for_wires(work) && make_room_for_tones(work) &&
         make_room_for_marks(work);
}

/* ---- What is stored in another form -------------------------------------- */

static bool begins_run(const struct scene *scene, uint32_t face) {
  return face == 0 ||
         scene_face_group(scene, face) != scene_face_group(scene, face - 1);
}

/* Lists the runs of groups; false when memory ran out. */
static bool list_runs(struct section_work *work) {
  const struct scene *scene = &work->section->part.scene;
  uint32_t faces = scene_face_count(scene), runs = 0;
  for (uint32_t f = 0; f < faces; f++)
    runs += begins_run(scene, f);
  work->runs.first = mem_alloc(runs, 4);
  work->runs.group = mem_alloc(runs, 4);
  work->counts.runs = 0;
  if (work->runs.first == NULL || work->runs.group == NULL)
    return false;
  for (uint32_t f = 0; f < faces; f++)
    if (begins_run(scene, f)) {
      work->runs.first[work->counts.runs] = f;
      work->runs.group[work->counts.runs++] = scene_face_group(scene, f);
    }
  return true;
}

/* The face after those of a run. */
static uint64_t past_run(const struct section_work *work, uint64_t run) {
  const struct section_counts *n = &work->counts;
  return run + 1 < n->runs ? work->runs.first[run + 1] : n->faces;
}

/* Whether the runs go through all faces, and name groups that there are. */
static bool runs_are_valid(const struct section_work *work) {
  const struct section_counts *n = &work->counts;
  bool ok = (n->faces > 0) == (n->runs > 0) &&
            (n->runs == 0 || work->runs.first[0] == 0);
  for (uint64_t r = 0; r < n->runs && ok; r++)
    ok = work->runs.first[r] < past_run(work, r) &&
         past_run(work, r) <= n->faces &&
         work->runs.group[r] < work->form->groups;
  return ok;
}

/* Gives the faces their groups, which a scene does not store where all are of
 * the first; false when memory ran out. */
static bool spread_runs(struct section_work *work) {
  const struct section_counts *n = &work->counts;
  struct scene *scene = &work->section->part.scene;
  if (n->runs == 0 || (n->runs == 1 && work->runs.group[0] == 0))
    return true;
  if (!ARRAY_RESERVE(&scene->face_group, (size_t)n->faces))
    return false;
  scene->face_group.count = (size_t)n->faces;
  for (uint64_t r = 0; r < n->runs; r++)
    for (uint64_t f = work->runs.first[r]; f < past_run(work, r); f++)
      scene->face_group.item[f] = work->runs.group[r];
  return true;
}

static bool list_precisions(struct section_work *work) {
  const struct scene *scene = &work->section->part.scene;
  size_t count = scene->precision.count;
  work->first_point = mem_alloc(count, 4);
  work->stated = mem_alloc(count, 1);
  work->precision = mem_alloc(2 * count, 8);
  if (work->first_point == NULL || work->stated == NULL ||
      work->precision == NULL)
    return false;
  for (size_t r = 0; r < count; r++) {
    const struct precision_range *range = &scene->precision.item[r];
    work->first_point[r] = range->first_point;
    work->stated[r] = range->stated;
    work->precision[2 * r] = range->precision.absolute;
    work->precision[2 * r + 1] = range->precision.relative;
  }
  return true;
}

static bool add_section_precisions(struct section_work *work) {
  struct scene *scene = &work->section->part.scene;
  for (uint64_t r = 0; r < work->counts.ranges; r++)
    if (!ARRAY_PUSH(&scene->precision,
                    ((struct precision_range){
                        work->first_point[r],
                        work->stated[r] != 0,
                        {work->precision[2 * r], work->precision[2 * r + 1]}})))
      return false;
  return true;
}

/* ---- Sections ------------------------------------------------------------ */

static bool all_are_triangles(const struct scene *scene) {
  for (uint32_t f = 0; f < scene_face_count(scene); f++)
    if (scene_face_start(scene, f + 1) != 3 * (f + 1))
      return false;
  return true;
}

static void set_counts(struct section_work *work) {
  const struct scene *scene = &work->section->part.scene;
  work->counts =
      (struct section_counts){.points = scene->point.count,
                              .ranges = scene->precision.count,
                              .faces = scene_face_count(scene),
                              .corners = scene->corner.count,
                              .wires = scene_wire_count(scene),
                              .wire_corners = scene->wire_corner.count,
                              .are_triangles = all_are_triangles(scene)};
}

void plan_section_write(struct plan_bytes *bytes, struct plan_section *section,
                        const struct plan_section_form *form) {
  struct section_work work = {.bytes = bytes, .section = section, .form = form};
  struct byte_codec codec = {.writes = true};
  set_counts(&work);
  if (list_runs(&work) && list_precisions(&work)) {
    code_header(&codec, &work);
    while (codec.bytes.count < HEADER_BYTES && !codec.failed) {
      uint8_t nothing = 0;
      byte_codec_u8(&codec, &nothing);
    }
  } else {
    codec.failed = true;
  }
  if (codec.failed)
    bytes->status = error_memory(bytes->error);
  plan_bytes_array(bytes, codec.bytes.item, HEADER_BYTES, 1);
  take_arrays(&work, code_array, NULL);
  ARRAY_FREE(&codec.bytes);
  section_work_fini(&work);
}

/* Reads the header; false where the section has another size than it says. */
static bool read_header(struct section_work *work, uint64_t size) {
  unsigned char header[HEADER_BYTES + PLAN_BLOCK];
  uint64_t sum = HEADER_BYTES;
  if (size < HEADER_BYTES)
    return false;
  plan_bytes_array(work->bytes, header, HEADER_BYTES, 1);
  if (work->bytes->status != RECTO_OK)
    return true;
  struct byte_codec codec = {.at = header, .left = HEADER_BYTES};
  code_header(&codec, work);
  take_arrays(work, add_array_size, &sum);
  return !codec.failed && sum == size;
}

static recto_status refuse_section(const char *path, recto_error *error) {
  return error_set(error, RECTO_ERROR_FORMAT, path, 0,
                   "the plan is damaged: a value is out of range");
}

static recto_status read_section(struct section_work *work, uint64_t size,
                                 uint64_t sum, const char *path,
                                 recto_error *error) {
  if (!read_header(work, size))
    return refuse_section(path, error);
  if (work->bytes->status == RECTO_OK && !make_room_for_section(work))
    return error_memory(error);
  take_arrays(work, code_array, NULL);
  if (work->bytes->status != RECTO_OK)
    return work->bytes->status;
  if (plan_bytes_sum(work->bytes) != sum)
    return error_set(error, RECTO_ERROR_FORMAT, path, 0,
                     "the plan is damaged: the checksum of part %lu is wrong",
                     (unsigned long)work->section->index + 1);
  if (!runs_are_valid(work))
    return refuse_section(path, error);
  if (!spread_runs(work) || !add_section_precisions(work))
    return error_memory(error);
  recto_status status = plan_section_check(work->section, work->form);
  return status == RECTO_ERROR_MEMORY ? error_memory(error)
         : status != RECTO_OK         ? refuse_section(path, error)
                                      : RECTO_OK;
}

recto_status plan_section_read(struct plan_bytes *bytes,
                               struct plan_section *section,
                               const struct plan_section_form *form,
                               uint64_t size, uint64_t sum, const char *path,
                               recto_error *error) {
  struct section_work work = {.bytes = bytes, .section = section, .form = form};
  *section = (struct plan_section){.index = 0};
  bytes->status = RECTO_OK;
  bytes->error = error;
  plan_bytes_begin_sum(bytes);
  recto_status status = read_section(&work, size, sum, path, error);
  section_work_fini(&work);
  return status;
}

void plan_section_fini(struct plan_section *section) {
  part_scene_fini(&section->part);
  mem_free(section->tone);
  mem_free(section->uniform);
  *section = (struct plan_section){.index = 0};
}
