/* part_scene.c - the faces that meet a window of the page, as a scene of their
 * own.
 *
 * Phases
 *   pick   faces about the window, in a pass over the model: more than are
 *          needed, as only they show how many these are
 *   local  their points, and where these lie on the page
 *   box    the window's, with those of the faces that it owns; where it goes
 *          beyond what was picked, those in it are picked anew
 *   keep   the faces whose boxes meet it
 *   ring   the faces with a corner at the place of one of theirs; where such
 *          corners lie beyond what was picked, picked anew
 *   trim   the others are dropped */
#include "parts/part_scene.h"

#include <string.h>

#include "base/poll.h"
#include "parts/part_points.h"

enum { LEFT_OUT, OF_RING, KEPT };

enum corner_flag {
  CORNER_KEPT = 0x10,     /* a face or a polyline that is kept has it */
  CORNER_ELSEWHERE = 0x20 /* it was looked up, and is at none of these */
};

struct part_scene_work {
  struct part_scene *part;
  struct face_pick *pick;
  const struct part_scene_request *request;
  struct part_window picked; /* what meets it was picked */
  struct part_window box;    /* what meets it is kept */
  uint8_t *face_state;
  uint8_t *flag; /* one a point: PAGE_OUTCODE of the box, enum corner_flag */
  recto_error *error;
};

/* ---- Boxes --------------------------------------------------------------- */

static struct part_window box_of_face(const struct part_scene *part,
                                      uint32_t face) {
  const struct scene *scene = &part->scene;
  return page_box(part->place,
                  scene->corner.item + scene_face_start(scene, face),
                  scene_face_corners(scene, face));
}

/* Whether one box lies within another. */
static bool window_is_within(const struct part_window *box,
                             const struct part_window *other) {
  for (int k = 0; k < 2; k++)
    if (box->low[k] < other->low[k] || box->high[k] > other->high[k])
      return false;
  return true;
}

static struct part_window first_box(const struct part_scene_request *request) {
  return page_window_widen(&request->window, request->margin + request->reach);
}

bool part_scene_aim(struct face_pick *pick,
                    const struct part_scene_request *request,
                    const struct page_place *place) {
  const struct part_window box = first_box(request);
  return face_pick_aim(pick, &box, place);
}

/* ---- Local points -------------------------------------------------------- */

static void set_scene(struct scene *scene, const struct scene *whole) {
  memcpy(scene->up, whole->up, sizeof scene->up);
  scene->unit_mm = whole->unit_mm;
  scene->group.item = whole->group.item;
  scene->group.count = whole->group.count;
}

/* Makes the part's scene of all that was picked, in place of what it was. */
static recto_status make_local(struct part_scene_work *work) {
  const struct scene *whole = work->pick->source.scene;
  struct part_scene *part = work->part;
  struct picked *picked = &work->pick->picked;
  part_scene_fini(part);
  part->scene = picked->scene;
  part->face_number = picked->face_number.item;
  part->wire_number = picked->wire_number.item;
  part->face_in_group = picked->face_in_group.item;
  part->wire_in_group = picked->wire_in_group.item;
  *picked = (struct picked){.face_number = {NULL, 0, 0}};
  struct scene *scene = &part->scene;
  set_scene(scene, whole);
  uint32_t *local = mem_calloc(whole->point.count, sizeof *local);
  bool ok = local != NULL;
  if (ok) {
    part_points_mark(local, scene->corner.item, scene->corner.count);
    part_points_mark(local, scene->wire_corner.item, scene->wire_corner.count);
    ok = part_points_copy(scene, &part->point_number, whole, local);
  }
  if (ok) {
    part_points_renumber(local, scene->corner.item, scene->corner.count);
    part_points_renumber(local, scene->wire_corner.item,
                         scene->wire_corner.count);
  }
  mem_free(local);
  part->place = ok ? page_places(work->request->camera, scene) : NULL;
  mem_free(work->face_state);
  mem_free(work->flag);
  work->face_state = mem_calloc(scene_face_count(scene), 1);
  work->flag = mem_calloc(scene->point.count, 1);
  return part->place != NULL && work->face_state != NULL && work->flag != NULL
             ? RECTO_OK
             : error_memory(work->error);
}

/* Passes over the model again.
 * kept  as face_pick.kept */
static recto_status pick_again(struct part_scene_work *work,
                               struct place_set *kept) {
  struct face_pick *pick = work->pick;
  const struct scene *whole = pick->source.scene;
  struct page_place *place = page_places(work->request->camera, whole);
  bool ok = place != NULL && face_pick_aim(pick, &work->box, place);
  mem_free(place);
  if (!ok)
    return error_memory(work->error);
  pick->kept = kept;
  recto_status status = face_pick_pass(pick, work->error);
  pick->kept = NULL;
  work->picked = work->box;
  return status;
}

/* ---- Faces that are kept ------------------------------------------------- */

/* Sets the box: that of the window, and where that is wanted of the faces that
 * it owns, with the margin. */
static void set_kept_box(struct part_scene_work *work) {
  const struct part_window *window = &work->request->window;
  const struct part_scene *part = work->part;
  work->box = *window;
  for (uint32_t f = 0;
       work->request->owned && f < scene_face_count(&part->scene) && poll_at(f);
       f++) {
    struct part_window box = box_of_face(part, f);
    if (page_window_owns(window, box.low))
      page_window_include(&work->box, &box);
  }
  work->box = page_window_widen(&work->box, work->request->margin);
}

/* Sets on which sides of the box the points lie. */
static void set_outcodes(struct part_scene_work *work) {
  const struct part_scene *part = work->part;
  for (size_t p = 0; p < part->scene.point.count; p++)
    work->flag[p] = page_outcode(&work->box, &part->place[p]);
}

/* A polyline is kept as a whole where one of its segments meets the box. */
static bool wire_is_kept(const struct part_scene_work *work, uint32_t wire) {
  const struct scene *scene = &work->part->scene;
  const uint32_t *corner = scene->wire_corner.item;
  for (uint32_t c = scene->wire_start.item[wire];
       c + 1 < scene->wire_start.item[wire + 1]; c++)
    if ((work->flag[corner[c]] & work->flag[corner[c + 1]] & PAGE_OUTCODE) == 0)
      return true;
  return false;
}

/* Keeps the corners of polylines that are kept: the faces there decide which
 * points they are welded to. */
static void keep_wire_corners(struct part_scene_work *work) {
  const struct scene *scene = &work->part->scene;
  for (uint32_t w = 0; w < scene_wire_count(scene); w++) {
    if (!wire_is_kept(work, w))
      continue;
    for (uint32_t c = scene->wire_start.item[w];
         c < scene->wire_start.item[w + 1]; c++)
      work->flag[scene->wire_corner.item[c]] |= CORNER_KEPT;
  }
}

/* Keeps the faces that meet the box. */
static void keep_faces(struct part_scene_work *work) {
  const struct scene *scene = &work->part->scene;
  set_outcodes(work);
  for (uint32_t f = 0; f < scene_face_count(scene) && poll_at(f); f++) {
    unsigned beyond = PAGE_OUTCODE;
    for (uint32_t c = scene_face_start(scene, f);
         c < scene_face_start(scene, f + 1); c++)
      beyond &= work->flag[scene->corner.item[c]];
    if (beyond != 0)
      continue;
    work->face_state[f] = KEPT;
    for (uint32_t c = scene_face_start(scene, f);
         c < scene_face_start(scene, f + 1); c++)
      work->flag[scene->corner.item[c]] |= CORNER_KEPT;
  }
  keep_wire_corners(work);
}

/* ---- Their ring ---------------------------------------------------------- */

/* Marks the kept corners beyond the box; returns the box with all of these.
 * Faces that are not kept have no corner within the box, and so none at the
 * place of one there. */
static struct part_window
list_corners_beyond(const struct part_scene_work *work, uint8_t *is_beyond) {
  const struct part_scene *part = work->part;
  struct part_window all = work->box;
  for (size_t p = 0; p < part->scene.point.count; p++) {
    const struct page_place *at = &part->place[p];
    is_beyond[p] = (work->flag[p] & CORNER_KEPT) != 0 &&
                   (work->flag[p] & PAGE_OUTCODE) != 0;
    if (is_beyond[p])
      page_window_include(&all, &(struct part_window){{at->at[0], at->at[1]},
                                                      {at->at[0], at->at[1]}});
  }
  return all;
}

/* Whether a point is at the place of a kept corner.
 * set  those beyond the box */
static bool is_at_kept_corner(struct part_scene_work *work,
                              const struct place_set *set, uint32_t point) {
  uint8_t *flag = &work->flag[point];
  if (*flag & (CORNER_KEPT | CORNER_ELSEWHERE))
    return (*flag & CORNER_KEPT) != 0;
  bool is_there = place_set_has(set, &work->part->scene.point.item[point]);
  *flag |= is_there ? CORNER_KEPT : CORNER_ELSEWHERE;
  return is_there;
}

/* Adds the ring of the kept faces. */
static recto_status add_ring(struct part_scene_work *work) {
  struct part_scene *part = work->part;
  struct place_set set;
  recto_status status = RECTO_OK;
  size_t points = part->scene.point.count;
  uint8_t *is_beyond = mem_alloc(points, 1);
  if (is_beyond == NULL)
    return error_memory(work->error);
  const struct part_window all = list_corners_beyond(work, is_beyond);
  bool ok = place_set_init(&set, part->scene.point.item, is_beyond, points);
  mem_free(is_beyond);
  if (!ok)
    return error_memory(work->error);
  bool is_picked = window_is_within(&all, &work->picked);
  if (!is_picked)
    status = pick_again(work, &set);
  const struct scene *scene = &part->scene;
  for (uint32_t f = 0; is_picked && f < scene_face_count(scene) && poll_at(f);
       f++)
    for (uint32_t c = scene_face_start(scene, f);
         c < scene_face_start(scene, f + 1) && work->face_state[f] == LEFT_OUT;
         c++)
      if (is_at_kept_corner(work, &set, scene->corner.item[c]))
        work->face_state[f] = OF_RING;
  place_set_fini(&set);
  if (is_picked || status != RECTO_OK)
    return status;
  status = make_local(work);
  if (status != RECTO_OK)
    return status;
  keep_faces(work);
  for (uint32_t f = 0; f < scene_face_count(&part->scene); f++)
    if (work->face_state[f] == LEFT_OUT)
      work->face_state[f] = OF_RING;
  return RECTO_OK;
}

bool part_scene_owns(const struct part_scene *part,
                     const struct part_window *window, uint32_t face) {
  const struct part_window box = box_of_face(part, face);
  return page_window_owns(window, box.low);
}

/* ---- Dropping the others ------------------------------------------------- */

static void trim_faces(struct part_scene_work *work, uint8_t *used) {
  struct part_scene *part = work->part;
  struct scene *scene = &part->scene;
  uint32_t faces = scene_face_count(scene), kept = 0, corners = 0;
  bool has_starts = scene->face_start.count > 0;
  bool has_groups = scene->face_group.count > 0;
  for (uint32_t f = 0; f < faces; f++) {
    uint32_t start = scene_face_start(scene, f);
    uint32_t count = scene_face_start(scene, f + 1) - start;
    if (work->face_state[f] == LEFT_OUT)
      continue;
    for (uint32_t i = 0; i < count; i++) {
      used[scene->corner.item[start + i]] = 1;
      scene->corner.item[corners + i] = scene->corner.item[start + i];
    }
    part->is_kept[kept] = work->face_state[f] == KEPT;
    part->face_number[kept] = part->face_number[f];
    if (part->face_in_group != NULL)
      part->face_in_group[kept] = part->face_in_group[f];
    if (has_groups)
      scene->face_group.item[kept] = scene->face_group.item[f];
    corners += count;
    kept++;
    if (has_starts)
      scene->face_start.item[kept] = corners;
  }
  if (has_starts)
    scene->face_start.count = kept > 0 ? (size_t)kept + 1 : 0;
  if (has_groups)
    scene->face_group.count = kept;
  scene->face_count = kept;
  scene->corner.count = corners;
}

static void trim_wires(struct part_scene_work *work, uint8_t *used) {
  struct part_scene *part = work->part;
  struct scene *scene = &part->scene;
  uint32_t wires = scene_wire_count(scene), kept = 0, corners = 0;
  for (uint32_t w = 0; w < wires; w++) {
    uint32_t start = scene->wire_start.item[w];
    uint32_t count = scene->wire_start.item[w + 1] - start;
    if (!wire_is_kept(work, w))
      continue;
    for (uint32_t i = 0; i < count; i++) {
      used[scene->wire_corner.item[start + i]] = 1;
      scene->wire_corner.item[corners + i] = scene->wire_corner.item[start + i];
    }
    part->wire_number[kept] = part->wire_number[w];
    if (part->wire_in_group != NULL)
      part->wire_in_group[kept] = part->wire_in_group[w];
    scene->wire_group.item[kept] = scene->wire_group.item[w];
    scene->wire_start.item[kept++] = corners;
    corners += count;
  }
  if (wires > 0)
    scene->wire_start.item[kept] = corners;
  scene->wire_start.count = kept > 0 ? (size_t)kept + 1 : 0;
  scene->wire_group.count = kept;
  scene->wire_corner.count = corners;
}

static recto_status trim_scene(struct part_scene_work *work) {
  struct part_scene *part = work->part;
  uint8_t *used = mem_calloc(part->scene.point.count, 1);
  uint32_t *local = mem_alloc(part->scene.point.count, sizeof *local);
  part->is_kept = mem_alloc(scene_face_count(&part->scene), 1);
  bool ok = used != NULL && local != NULL && part->is_kept != NULL;
  if (ok) {
    trim_wires(work, used);
    trim_faces(work, used);
    part_points_trim(&part->scene, part->point_number, part->place, used,
                     local);
  }
  mem_free(used);
  mem_free(local);
  return ok && !poll_is_cancelled() ? RECTO_OK : error_memory(work->error);
}

/* ---- All ----------------------------------------------------------------- */

static recto_status make_part_scene(struct part_scene_work *work) {
  recto_status status = make_local(work);
  if (status == RECTO_OK)
    set_kept_box(work);
  if (status == RECTO_OK && !window_is_within(&work->box, &work->picked)) {
    status = pick_again(work, NULL);
    if (status == RECTO_OK)
      status = make_local(work);
  }
  if (status != RECTO_OK)
    return status;
  keep_faces(work);
  status = add_ring(work);
  return status == RECTO_OK ? trim_scene(work) : status;
}

recto_status part_scene_make(struct part_scene *part, struct face_pick *pick,
                             const struct part_scene_request *request,
                             recto_error *error) {
  struct part_scene_work work = {.part = part,
                                 .pick = pick,
                                 .request = request,
                                 .picked = first_box(request),
                                 .error = error};
  *part = (struct part_scene){.point_number = NULL};
  recto_status status = make_part_scene(&work);
  mem_free(work.face_state);
  mem_free(work.flag);
  return status;
}

void part_scene_fini(struct part_scene *part) {
  memset(&part->scene.group, 0, sizeof part->scene.group); /* borrowed */
  scene_fini(&part->scene);
  mem_free(part->point_number);
  mem_free(part->face_number);
  mem_free(part->wire_number);
  mem_free(part->face_in_group);
  mem_free(part->wire_in_group);
  mem_free(part->place);
  mem_free(part->is_kept);
  mem_free(part->crease_mark);
  *part = (struct part_scene){.point_number = NULL};
}
