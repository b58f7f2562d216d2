/* obj_short_runs.c - reads short runs of points and faces that take turns, as
 * the parts of an assembly do in a file, by several threads.
 *
 * What follows is divided into parts at the ends of lines, some of which are a
 * window:
 *   count  the points, normals, faces and corners of each part, line by line
 *   place  where those of each part belong follows from all before it
 *   parse  numbers go straight to the scene's arrays
 *   check  faces are without fault, once all points are there
 *   join   names, which statements after them depend on, are used in order
 * Parts are taken as a whole, up to the first that has something else than
 * plain statements: that one is read as all others are, from its beginning.
 * Windows grow while nothing else comes, so that little is read in vain. */
#include "scene/obj/obj_short_runs.h"

#include "base/parallel.h"
#include "scene/corner_normals.h"
#include "scene/diagnostics.h"
#include "scene/limit.h"
#include "scene/obj/obj_counted_part.h"

#if DIGITS_CHUNKS

enum {
  LEAST_PARTS = 8, /* of a window */
  MOST_PARTS = 64,
  MOST_WAIT = 64 /* blocks after which it is tried again */
};

struct window {
  struct obj_parser *p;
  off_t from; /* where it begins in the file */
  struct obj_counted_part *part;
  size_t count;
};

/* ---- Parts --------------------------------------------------------------- */

static bool count_part(void *user, struct parallel_range range) {
  const struct window *window = user;
  obj_counted_part_count(&window->part[range.begin], window->p->lines,
                         window->from, range.begin);
  return true;
}

/* Sums up what comes before each part, and makes room for all; false when
 * memory ran out. */
static bool place_parts(const struct window *window) {
  const struct scene *scene = window->p->scene;
  size_t points = 0, normals = 0, faces = 0, corners = 0;
  bool only_triangles = scene->face_start.count == 0;
  for (size_t i = 0; i < window->count; i++) {
    struct obj_counted_part *part = &window->part[i];
    part->is_plain =
        part->is_plain && (!only_triangles || part->corners == 3 * part->faces);
    part->face = faces;
    part->corner = corners;
    part->points.before = points;
    part->normals.before = normals;
    points += part->points.most;
    normals += part->normals.most;
    faces += part->faces;
    corners += part->corners;
  }
  return ARRAY_RESERVE(&window->p->scene->point, points) &&
         (!scene->needs_crease_marks ||
          ARRAY_RESERVE(&window->p->normal, normals)) &&
         scene_reserve_faces(window->p->scene, faces, corners);
}

static bool parse_counted_part(void *user, struct parallel_range range) {
  const struct window *window = user;
  obj_counted_part_parse(&window->part[range.begin], window->p);
  return true;
}

static bool check_part(void *user, struct parallel_range range) {
  const struct window *window = user;
  obj_counted_part_check(&window->part[range.begin], window->p);
  return true;
}

/* ---- Joining ------------------------------------------------------------- */

/* Adds faces that were read to the current group. */
static recto_status add_faces_of_group(struct obj_parser *p, size_t count) {
  struct scene *scene = p->scene;
  recto_status status = RECTO_OK;
  if (count == 0)
    return RECTO_OK;
  if (p->renamed)
    status = obj_use_named_group(p);
  if (status != RECTO_OK)
    return status;
  if ((scene->current_group != 0 && !scene_list_groups(scene)) ||
      (scene->face_group.count > 0 &&
       !ARRAY_RESERVE(&scene->face_group, count)))
    return error_memory(p->error);
  for (size_t f = 0; scene->face_group.count > 0 && f < count; f++)
    scene->face_group.item[scene->face_group.count++] = scene->current_group;
  scene->face_count += (uint32_t)count;
  return RECTO_OK;
}

/* Adds what files say of hard and smooth edges beside normals. */
static bool add_smoothing(struct scene *scene,
                          const struct obj_counted_part *part) {
  for (size_t i = 0; i < part->smoothing.count; i++) {
    const struct obj_counted_smoothing *own = &part->smoothing.item[i];
    if (!smoothing_set_in_file(&scene->smoothing,
                               scene->face_count + (uint32_t)own->face,
                               own->group))
      return false;
  }
  return true;
}

/* Adds the faces of a part, each to the group of the names before it. */
static recto_status add_faces_of_part(struct obj_parser *p,
                                      const struct obj_counted_part *part) {
  size_t face = 0;
  recto_status status = RECTO_OK;
  for (size_t i = 0; status == RECTO_OK && i < part->name.count; i++) {
    const struct obj_counted_name *name = &part->name.item[i];
    status = add_faces_of_group(p, name->face - face);
    face = name->face;
    p->name[name->kind] =
        (struct material_name){.start = part->buffer.item + name->start,
                               .length = name->length,
                               .line = p->line + name->line};
    p->renamed = true;
  }
  return status == RECTO_OK ? add_faces_of_group(p, part->faces - face)
                            : status;
}

/* Takes a part whose statements were read. */
static recto_status take_part(struct obj_parser *p,
                              const struct obj_counted_part *part) {
  struct scene *scene = p->scene;
  size_t first = scene->corner.count;
  if (!obj_plain_points.add(p, &part->points) ||
      !obj_plain_normals.add(p, &part->normals) || !add_smoothing(scene, part))
    return error_memory(p->error);
  scene->corner.count += part->corners;
  recto_status status = add_faces_of_part(p, part);
  if (scene->face_start.count > 0)
    scene->face_start.count += part->faces;
  if (status == RECTO_OK && scene->needs_crease_marks &&
      !corner_normals_add(scene, first,
                          part->has_normals ? part->normal.item : NULL))
    status = error_memory(p->error);
  p->line += part->lines;
  return status;
}

/* How many parts come before the first that is not plain. */
static size_t plain_parts(const struct window *window) {
  size_t i = 0;
  while (i < window->count && window->part[i].is_plain)
    i++;
  return i;
}

/* Reads a window; *taken: how many of its parts were plain, and are taken. */
static recto_status read_window(struct window *window, int workers,
                                size_t *taken) {
  struct obj_parser *p = window->p;
  size_t count = window->count, plain;
  recto_status status = diagnostics_poll(p->diagnostics, p->at, p->error);
  *taken = 0;
  if (status != RECTO_OK)
    return status;
  window->from = obj_place_in_file(p);
  if (!parallel_ranges(workers, count, 1, count_part, window) ||
      !place_parts(window) ||
      !parallel_ranges(workers, count, 1, parse_counted_part, window))
    return error_memory(p->error);
  /* Those after it may name points that were not read. */
  plain = plain_parts(window);
  if (!parallel_ranges(workers, plain, 1, check_part, window))
    return error_memory(p->error);
  plain = plain_parts(window);
  while (status == RECTO_OK && *taken < plain)
    status = take_part(p, &window->part[(*taken)++]);
  if (status == RECTO_OK)
    status = obj_keep_names(p);
  if (*taken > 0)
    obj_go_on(p, window->part[*taken - 1].past);
  return status;
}

/* ---- Windows ------------------------------------------------------------- */

/* Whether what follows may be read so.  The first face of a scene is read
 * alone: groups are listed from it on. */
static bool may_have_short_runs(const struct obj_parser *p) {
  const struct scene *scene = p->scene;
  enum { WINDOW_BYTES = MOST_PARTS * (OBJ_COUNTED_BYTES + OBJ_COUNTED_ROOM) };
  return p->known && scene->face_count > 0 && p->bad.count == 0 && !p->ahead &&
         p->run_bytes < OBJ_COUNTED_BYTES &&
         scene->corner.count < SCENE_LIMIT - WINDOW_BYTES &&
         scene->point.count < SCENE_LIMIT - WINDOW_BYTES;
}

/* Reads windows for as long as all parts of each are plain. */
static recto_status read_windows(struct window *window) {
  struct obj_parser *p = window->p;
  recto_status status = RECTO_OK;
  size_t taken = 0, most = LEAST_PARTS;
  bool any = false;
  do {
    size_t left = obj_bytes_left(p) / OBJ_COUNTED_BYTES;
    window->count = left < most ? left : most;
    int workers = parallel_workers(window->count, 1);
    if (workers < 2 || !may_have_short_runs(p))
      break;
    status = read_window(window, workers, &taken);
    any = any || taken > 0;
    most = most < MOST_PARTS ? 2 * most : MOST_PARTS;
  } while (status == RECTO_OK && taken == window->count);
  p->short_pause = any ? 0 : 2 * p->short_pause + 1;
  if (p->short_pause > MOST_WAIT)
    p->short_pause = MOST_WAIT;
  p->short_wait = p->short_pause;
  return status;
}

recto_status obj_read_short_runs(struct obj_parser *p) {
  if (p->short_wait > 0) {
    p->short_wait--;
    return RECTO_OK;
  }
  if (parallel_threads() < 2 || !may_have_short_runs(p))
    return RECTO_OK;
  struct window window = {.p = p,
                          .part = mem_calloc(MOST_PARTS, sizeof *window.part)};
  if (window.part == NULL)
    return error_memory(p->error);
  recto_status status = read_windows(&window);
  for (size_t i = 0; i < MOST_PARTS; i++)
    obj_counted_part_fini(&window.part[i]);
  mem_free(window.part);
  return status;
}

#else

recto_status obj_read_short_runs(struct obj_parser *p) {
  (void)p;
  return RECTO_OK;
}

#endif
