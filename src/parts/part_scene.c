/* part_scene.c - the faces that meet a window of the page, as a scene of their
 * own.
 *
 * Phases
 *   box    the window's box, with those of the faces that it owns
 *   keep   the faces whose boxes meet it; the places of their corners
 *   ring   the faces with a corner at such a place
 *   copy   those faces, in order, and their points */
#include "parts/part_scene.h"

#include <string.h>

#include "base/hash.h"
#include "base/poll.h"

/* A set of places in the scene: a table of point numbers + 1 by linear
 * probing. */
struct place_set {
  const struct scene_point *point;
  uint32_t *slot;
  size_t mask;
};

enum { LEFT_OUT, OF_RING, KEPT };

struct part_scene_work {
  struct part_scene *part;
  const struct scene *whole;
  const struct page_place *place;
  const struct part_scene_request *request;
  struct part_window box; /* what meets it is kept */
  uint8_t *face_state;    /* one a face of the model */
  uint8_t *wire_state;
  uint8_t *outcode;     /* one a point: against the current box */
  uint8_t *corner_kept; /* one a point: a corner of a kept face */
  uint8_t *used;        /* one a point of the model */
  uint32_t *local;      /* point of the model -> of the part */
};

/* ---- Boxes --------------------------------------------------------------- */

struct element_box {
  int32_t low[2], high[2];
};

static struct element_box box_of(const struct page_place *place,
                                 const uint32_t *corner, uint32_t count) {
  struct element_box box;
  for (int k = 0; k < 2; k++) {
    box.low[k] = box.high[k] = place[corner[0]].at[k];
    for (uint32_t c = 1; c < count; c++) {
      int32_t at = place[corner[c]].at[k];
      box.low[k] = at < box.low[k] ? at : box.low[k];
      box.high[k] = at > box.high[k] ? at : box.high[k];
    }
  }
  return box;
}

static struct element_box box_of_face(const struct part_scene_work *work,
                                      uint32_t face) {
  const struct scene *whole = work->whole;
  uint32_t start = whole->face_start.item[face];
  return box_of(work->place, whole->corner.item + start,
                whole->face_start.item[face + 1] - start);
}

static int32_t limit_to_sheet(int64_t at) {
  return at < -SHEET_XY_MAX  ? -SHEET_XY_MAX
         : at > SHEET_XY_MAX ? SHEET_XY_MAX
                             : (int32_t)at;
}

/* ---- Faces that are kept ------------------------------------------------- */

/* On which sides of the box a place lies, a bit each: a Cohen-Sutherland
 * outcode. */
static uint8_t outcode_of(const struct part_window *box,
                          const struct page_place *place) {
  unsigned code = 0;
  for (int k = 0; k < 2; k++)
    code |= (unsigned)(place->at[k] < box->low[k]) << 2 * k |
            (unsigned)(place->at[k] > box->high[k]) << (2 * k + 1);
  return (uint8_t)code;
}

static void set_outcodes(const struct part_scene_work *work,
                         const struct part_window *box) {
  for (size_t p = 0; p < work->whole->point.count; p++)
    work->outcode[p] = outcode_of(box, &work->place[p]);
}

/* Whether the bounding box of a face meets the box of the outcodes: unless all
 * corners lie beyond one of its sides. */
static inline bool face_meets_box(const struct part_scene_work *work,
                                  uint32_t face) {
  const struct scene *whole = work->whole;
  unsigned all = 0xf;
  for (uint32_t c = whole->face_start.item[face];
       c < whole->face_start.item[face + 1]; c++)
    all &= work->outcode[whole->corner.item[c]];
  return all == 0;
}

/* Sets the box: that of the window, and where fragments are wanted of the faces
 * that it owns, with the margin. */
static void set_kept_box(struct part_scene_work *work) {
  const struct part_window *window = &work->request->window;
  work->box = *window;
  if (work->request->fragments)
    set_outcodes(work, window);
  for (uint32_t f = 0; work->request->fragments &&
                       f < scene_face_count(work->whole) && poll_at(f);
       f++) {
    if (!face_meets_box(work, f))
      continue;
    struct element_box box = box_of_face(work, f);
    for (int k = 0; k < 2 && page_window_owns(window, box.low); k++)
      if (work->box.high[k] < box.high[k])
        work->box.high[k] = box.high[k];
  }
  for (int k = 0; k < 2 && window->low[0] <= window->high[0]; k++) {
    work->box.low[k] = limit_to_sheet(work->box.low[k] - work->request->margin);
    work->box.high[k] =
        limit_to_sheet(work->box.high[k] + work->request->margin);
  }
}

static void keep_faces(struct part_scene_work *work) {
  const struct scene *whole = work->whole;
  set_outcodes(work, &work->box);
  for (uint32_t f = 0; f < scene_face_count(whole) && poll_at(f); f++) {
    if (!face_meets_box(work, f))
      continue;
    work->face_state[f] = KEPT;
    for (uint32_t c = whole->face_start.item[f];
         c < whole->face_start.item[f + 1]; c++)
      work->corner_kept[whole->corner.item[c]] = 1;
  }
}

/* A polyline is kept as a whole where one of its segments meets the box. */
static void keep_wires(struct part_scene_work *work) {
  const struct scene *whole = work->whole;
  for (uint32_t w = 0; w < scene_wire_count(whole); w++)
    for (uint32_t c = whole->wire_start.item[w];
         c + 1 < whole->wire_start.item[w + 1] && !work->wire_state[w]; c++) {
      struct element_box box =
          box_of(work->place, whole->wire_corner.item + c, 2);
      work->wire_state[w] =
          part_window_meets(&work->box, box.low, box.high) ? KEPT : LEFT_OUT;
    }
}

/* ---- Their ring ---------------------------------------------------------- */

static uint64_t hash_of_position(const struct scene_point *p) {
  uint64_t hash = hash_add_double(0, p->x + 0.0); /* -0 becomes 0 */
  hash = hash_add_double(hash_add_double(hash, p->y + 0.0), p->z + 0.0);
  return hash * HASH_GOLDEN >> 20;
}

/* The slot of a place, or the free one where it belongs. */
static size_t find_position(const struct place_set *set,
                            const struct scene_point *p) {
  size_t k = (size_t)hash_of_position(p) & set->mask;
  for (; set->slot[k] != 0; k = (k + 1) & set->mask) {
    const struct scene_point *q = &set->point[set->slot[k] - 1];
    if (p->x == q->x && p->y == q->y && p->z == q->z)
      break;
  }
  return k;
}

static bool make_place_set(struct place_set *set,
                           const struct part_scene_work *work) {
  size_t count = 0, slots = 16;
  for (size_t p = 0; p < work->whole->point.count; p++)
    count += work->corner_kept[p];
  while (slots < 2 * count)
    slots *= 2;
  *set = (struct place_set){work->whole->point.item,
                            mem_calloc(slots, sizeof *set->slot), slots - 1};
  for (size_t p = 0; set->slot != NULL && p < work->whole->point.count; p++)
    if (work->corner_kept[p]) {
      size_t k = find_position(set, &set->point[p]);
      if (set->slot[k] == 0)
        set->slot[k] = (uint32_t)p + 1;
    }
  return set->slot != NULL;
}

/* Whether a point lies at the place of a kept corner.
 * known  one a point: 0: not yet looked up; 1: no; 2: yes */
static bool is_at_kept(const struct part_scene_work *work,
                       const struct place_set *set, uint8_t *known,
                       uint32_t point) {
  if (work->corner_kept[point])
    return true;
  if (known[point] == 0) {
    size_t k = find_position(set, &set->point[point]);
    known[point] = set->slot[k] != 0 ? 2 : 1;
  }
  return known[point] == 2;
}

static bool add_ring(struct part_scene_work *work) {
  const struct scene *whole = work->whole;
  struct place_set set;
  uint8_t *known = mem_calloc(whole->point.count, 1);
  bool ok = make_place_set(&set, work) && known != NULL;
  for (uint32_t f = 0; ok && f < scene_face_count(whole) && poll_at(f); f++)
    for (uint32_t c = whole->face_start.item[f];
         c < whole->face_start.item[f + 1] && work->face_state[f] == LEFT_OUT;
         c++)
      if (is_at_kept(work, &set, known, whole->corner.item[c]))
        work->face_state[f] = OF_RING;
  mem_free(set.slot);
  mem_free(known);
  return ok;
}

/* ---- Copying ------------------------------------------------------------- */

static void mark_used(uint8_t *used, const uint32_t *corner, uint32_t start,
                      uint32_t end) {
  for (uint32_t c = start; c < end; c++)
    used[corner[c]] = 1;
}

/* Numbers the points of the part, and copies them and their precision. */
static bool copy_kept_points(struct part_scene_work *work) {
  const struct scene *whole = work->whole;
  struct scene *scene = &work->part->scene;
  size_t count = 0, range = 0;
  for (uint32_t f = 0; f < scene_face_count(whole); f++)
    if (work->face_state[f] != LEFT_OUT)
      mark_used(work->used, whole->corner.item, whole->face_start.item[f],
                whole->face_start.item[f + 1]);
  for (uint32_t w = 0; w < scene_wire_count(whole); w++)
    if (work->wire_state[w] != LEFT_OUT)
      mark_used(work->used, whole->wire_corner.item, whole->wire_start.item[w],
                whole->wire_start.item[w + 1]);
  for (size_t p = 0; p < whole->point.count; p++)
    count += work->used[p];
  work->part->point_number = mem_alloc(count, sizeof *work->local);
  if (work->part->point_number == NULL || !ARRAY_RESERVE(&scene->point, count))
    return false;
  for (size_t p = 0; p < whole->point.count; p++) {
    for (; range < whole->precision.count &&
           whole->precision.item[range].first_point <= p;
         range++) {
      struct precision_range own = whole->precision.item[range];
      own.first_point = (uint32_t)scene->point.count;
      size_t last = scene->precision.count;
      if (last > 0 &&
          scene->precision.item[last - 1].first_point == own.first_point)
        scene->precision.item[last - 1] = own;
      else if (!ARRAY_PUSH(&scene->precision, own))
        return false;
    }
    if (!work->used[p])
      continue;
    work->local[p] = (uint32_t)scene->point.count;
    work->part->point_number[scene->point.count] = (uint32_t)p;
    scene->point.item[scene->point.count++] = whole->point.item[p];
  }
  return true;
}

static bool copy_kept_faces(struct part_scene_work *work) {
  const struct scene *whole = work->whole;
  struct part_scene *part = work->part;
  struct scene *scene = &part->scene;
  size_t count = 0, corners = 0, at = 0, skipped = 0;
  for (uint32_t f = 0; f < scene_face_count(whole); f++)
    if (work->face_state[f] != LEFT_OUT) {
      count++;
      corners += whole->face_start.item[f + 1] - whole->face_start.item[f];
    }
  part->face_number = mem_alloc(count, sizeof *part->face_number);
  part->is_kept = mem_alloc(count, 1);
  if (part->face_number == NULL || part->is_kept == NULL ||
      !ARRAY_RESERVE(&scene->corner, corners) ||
      !ARRAY_RESERVE(&scene->face_start, count + 1) ||
      !ARRAY_RESERVE(&scene->face_group, count))
    return false;
  if (count > 0)
    scene->face_start.item[scene->face_start.count++] = 0;
  for (uint32_t f = 0; f < scene_face_count(whole); f++) {
    while (skipped < whole->face_skipped.count &&
           whole->face_skipped.item[skipped] <= f)
      skipped++;
    if (work->face_state[f] == LEFT_OUT)
      continue;
    part->is_kept[at] = work->face_state[f] == KEPT;
    part->face_number[at++] = f + (uint32_t)skipped;
    for (uint32_t c = whole->face_start.item[f];
         c < whole->face_start.item[f + 1]; c++)
      scene->corner.item[scene->corner.count++] =
          work->local[whole->corner.item[c]];
    scene->face_start.item[scene->face_start.count++] =
        (uint32_t)scene->corner.count;
    scene->face_group.item[scene->face_group.count++] =
        whole->face_group.item[f];
  }
  return true;
}

static bool copy_kept_wires(struct part_scene_work *work) {
  const struct scene *whole = work->whole;
  struct part_scene *part = work->part;
  struct scene *scene = &part->scene;
  part->wire_number =
      mem_alloc(scene_wire_count(whole), sizeof *part->wire_number);
  if (part->wire_number == NULL)
    return false;
  for (uint32_t w = 0; w < scene_wire_count(whole); w++) {
    if (work->wire_state[w] == LEFT_OUT)
      continue;
    if (scene->wire_start.count == 0 && !ARRAY_PUSH(&scene->wire_start, 0))
      return false;
    for (uint32_t c = whole->wire_start.item[w];
         c < whole->wire_start.item[w + 1]; c++)
      if (!ARRAY_PUSH(&scene->wire_corner,
                      work->local[whole->wire_corner.item[c]]))
        return false;
    part->wire_number[scene->wire_group.count] = w;
    if (!ARRAY_PUSH(&scene->wire_start, (uint32_t)scene->wire_corner.count) ||
        !ARRAY_PUSH(&scene->wire_group, whole->wire_group.item[w]))
      return false;
  }
  return true;
}

static bool make_all(struct part_scene_work *work) {
  const struct scene *whole = work->whole;
  struct scene *scene = &work->part->scene;
  scene_init(scene);
  memcpy(scene->up, whole->up, sizeof scene->up);
  scene->unit_mm = whole->unit_mm;
  scene->group.item = whole->group.item;
  scene->group.count = whole->group.count;
  work->face_state = mem_calloc(scene_face_count(whole), 1);
  work->wire_state = mem_calloc(scene_wire_count(whole), 1);
  work->outcode = mem_alloc(whole->point.count, 1);
  work->corner_kept = mem_calloc(whole->point.count, 1);
  work->used = mem_calloc(whole->point.count, 1);
  work->local = mem_alloc(whole->point.count, sizeof *work->local);
  if (work->face_state == NULL || work->wire_state == NULL ||
      work->outcode == NULL || work->corner_kept == NULL ||
      work->used == NULL || work->local == NULL)
    return false;
  set_kept_box(work);
  keep_faces(work);
  keep_wires(work);
  return add_ring(work) && copy_kept_points(work) && copy_kept_faces(work) &&
         copy_kept_wires(work) && !poll_is_cancelled();
}

recto_status part_scene_make(struct part_scene *part, const struct scene *whole,
                             const struct page_place *place,
                             const struct part_scene_request *request,
                             recto_error *error) {
  struct part_scene_work work = {
      .part = part, .whole = whole, .place = place, .request = request};
  *part = (struct part_scene){.point_number = NULL};
  bool ok = make_all(&work);
  mem_free(work.face_state);
  mem_free(work.wire_state);
  mem_free(work.outcode);
  mem_free(work.corner_kept);
  mem_free(work.used);
  mem_free(work.local);
  return ok ? RECTO_OK : error_memory(error);
}

void part_scene_fini(struct part_scene *part) {
  memset(&part->scene.group, 0, sizeof part->scene.group); /* borrowed */
  scene_fini(&part->scene);
  mem_free(part->point_number);
  mem_free(part->face_number);
  mem_free(part->wire_number);
  mem_free(part->is_kept);
  *part = (struct part_scene){.point_number = NULL};
}
