/* plan_faces.c - lists the faces and polylines that the parts of all windows
 * have.
 *
 * Phases
 *   boxes    of the windows: widened, where that is wanted by the faces that
 *            each owns
 *   cores    of the windows: a rectangle of each that no other box meets, so
 *            that a face within it is settled by three looks
 *   corners  of kept faces beyond the box: at their places lie the rings
 *   lists    in the order of the model
 *
 * Performance  Corners are all over the points, so all that is read of nearly
 * every point lies in two bytes. */
#include "parts/plan_faces.h"

#include "base/poll.h"
#include "parts/ring_corners.h"
#include "parts/window_grid.h"

enum { AT_RING = 0x8000 }; /* a kept corner beyond a box is at its place */

struct plan_work {
  struct plan_window *plan;
  uint32_t count;
  const struct plan_faces_request *request;
  struct part_window *box; /* of each window: what meets it is kept */
  struct part_window extent;
  struct window_grid grid; /* of the boxes */
  uint16_t *tag; /* one a point: the window in whose core it lies, + 1, or 0;
                    AT_RING */
  struct ring_corners ring;
  uint32_t *listed; /* of each window: the last face that it got, + 1 */
};

/* ---- Boxes --------------------------------------------------------------- */

static struct part_window extent_of_places(const struct page_place *place,
                                           size_t count) {
  struct part_window all = {{0, 0}, {0, 0}};
  for (size_t p = 0; p < count; p++)
    for (int k = 0; k < 2; k++) {
      int32_t at = place[p].at[k];
      all.low[k] = at < all.low[k] ? at : all.low[k];
      all.high[k] = at > all.high[k] ? at : all.high[k];
    }
  return all;
}

static struct part_window box_of_plan_face(const struct plan_work *work,
                                           uint32_t face) {
  const struct scene *scene = work->request->scene;
  return page_box(work->request->place,
                  scene->corner.item + scene_face_start(scene, face),
                  scene_face_corners(scene, face));
}

/* Enlarges the boxes by the faces that each window owns. */
static bool include_owned_faces(struct plan_work *work) {
  struct window_grid grid;
  struct part_window *window = mem_alloc(work->count, sizeof *window);
  for (uint32_t w = 0; window != NULL && w < work->count; w++)
    window[w] = work->plan[w].window;
  bool ok = window != NULL &&
            window_grid_init(&grid, window, work->count, &work->extent);
  uint32_t faces = scene_face_count(work->request->scene);
  for (uint32_t f = 0; ok && f < faces && poll_at(f); f++) {
    const struct part_window box = box_of_plan_face(work, f);
    const struct part_window low = {{box.low[0], box.low[1]},
                                    {box.low[0], box.low[1]}};
    uint32_t met = window_grid_meet(&grid, &low);
    for (uint32_t i = 0; i < met; i++)
      if (page_window_owns(&window[grid.met[i]], box.low))
        page_window_include(&work->box[grid.met[i]], &box);
  }
  if (window != NULL)
    window_grid_fini(&grid);
  mem_free(window);
  return ok;
}

static bool set_boxes(struct plan_work *work) {
  const struct plan_faces_request *request = work->request;
  work->extent = extent_of_places(request->place, request->scene->point.count);
  work->box = mem_alloc(work->count, sizeof *work->box);
  if (work->box == NULL)
    return false;
  for (uint32_t w = 0; w < work->count; w++)
    work->box[w] = work->plan[w].window;
  if (request->owned && !include_owned_faces(work))
    return false;
  for (uint32_t w = 0; w < work->count; w++)
    work->box[w] = page_window_widen(&work->box[w], request->margin);
  return window_grid_init(&work->grid, work->box, work->count, &work->extent);
}

/* ---- Cores --------------------------------------------------------------- */

/* Cuts a box off a core, which it meets: on the side where most is left. */
static void cut_core(struct part_window *core, const struct part_window *box) {
  double most = -1;
  struct part_window best = *core;
  for (int side = 0; side < 4; side++) {
    struct part_window left = *core;
    int k = side / 2;
    if (side % 2 == 0 && left.high[k] >= box->low[k])
      left.high[k] = box->low[k] - 1;
    else if (side % 2 == 1 && left.low[k] <= box->high[k])
      left.low[k] = box->high[k] + 1;
    double size[2];
    for (int axis = 0; axis < 2; axis++)
      size[axis] = (double)left.high[axis] - left.low[axis] + 1;
    double area = size[0] > 0 && size[1] > 0 ? size[0] * size[1] : 0;
    if (area > most) {
      most = area;
      best = left;
    }
  }
  *core = best;
}

/* The part of a window that no other box meets. */
static struct part_window find_core(const struct plan_work *work,
                                    uint32_t window) {
  struct part_window core = work->plan[window].window;
  for (uint32_t v = 0; v < work->count && core.low[0] <= core.high[0] &&
                       core.low[1] <= core.high[1];
       v++)
    if (v != window && part_window_meets(&work->box[v], core.low, core.high))
      cut_core(&core, &work->box[v]);
  return core;
}

/* Tags the points that lie in a core. */
static bool tag_points(struct plan_work *work) {
  _Static_assert((int)PAGE_WINDOWS_MAX < (int)AT_RING, "is a bit of its own");
  size_t points = work->request->scene->point.count;
  struct window_grid grid;
  struct part_window *core = mem_alloc(work->count, sizeof *core);
  work->tag = mem_alloc(points, sizeof *work->tag);
  for (uint32_t w = 0; core != NULL && w < work->count; w++)
    core[w] = find_core(work, w);
  bool ok =
      core != NULL && window_grid_init(&grid, core, work->count, &work->extent);
  for (size_t p = 0; ok && work->tag != NULL && p < points && poll_at(p); p++) {
    const int32_t *at = work->request->place[p].at;
    const struct part_window place = {{at[0], at[1]}, {at[0], at[1]}};
    work->tag[p] =
        window_grid_meet(&grid, &place) > 0 ? (uint16_t)(grid.met[0] + 1) : 0;
  }
  if (core != NULL)
    window_grid_fini(&grid);
  mem_free(core);
  return ok && work->tag != NULL;
}

/* The window in whose core all corners lie, + 1, if none of them has a further
 * mark; else 0. */
static uint16_t tag_of_corners(const struct plan_work *work,
                               const uint32_t *corner, uint32_t count) {
  uint16_t tag = work->tag[corner[0]];
  for (uint32_t c = 1; c < count; c++)
    if (work->tag[corner[c]] != tag)
      return 0;
  return (tag & AT_RING) != 0 ? 0 : tag;
}

/* ---- Corners beyond the boxes -------------------------------------------- */

static bool add_corners_beyond(struct plan_work *work, uint32_t window,
                               const uint32_t *corner, uint32_t count) {
  for (uint32_t c = 0; c < count; c++)
    if (page_outcode(&work->box[window], &work->request->place[corner[c]]) !=
            0 &&
        !ring_corners_add(&work->ring, corner[c], window))
      return false;
  return true;
}

static bool add_corners_of_faces(struct plan_work *work) {
  const struct scene *scene = work->request->scene;
  for (uint32_t f = 0; f < scene_face_count(scene) && poll_at(f); f++) {
    uint32_t start = scene_face_start(scene, f);
    uint32_t count = scene_face_corners(scene, f);
    const uint32_t *corner = scene->corner.item + start;
    if (tag_of_corners(work, corner, count) != 0)
      continue;
    const struct part_window box = box_of_plan_face(work, f);
    uint32_t met = window_grid_meet(&work->grid, &box);
    for (uint32_t i = 0; i < met; i++)
      if (!add_corners_beyond(work, work->grid.met[i], corner, count))
        return false;
  }
  return true;
}

/* Lists a polyline in the windows that one of its segments meets, and its
 * corners beyond these. */
static bool list_wire(struct plan_work *work, uint32_t wire) {
  const struct scene *scene = work->request->scene;
  uint32_t start = scene->wire_start.item[wire];
  uint32_t count = scene->wire_start.item[wire + 1] - start;
  const uint32_t *corner = scene->wire_corner.item + start;
  for (uint32_t c = 0; c + 1 < count; c++) {
    const struct part_window box =
        page_box(work->request->place, corner + c, 2);
    uint32_t met = window_grid_meet(&work->grid, &box);
    for (uint32_t i = 0; i < met; i++) {
      uint32_t w = work->grid.met[i];
      if (work->listed[w] == wire + 1)
        continue;
      work->listed[w] = wire + 1;
      if (!ARRAY_PUSH(&work->plan[w].wire, wire) ||
          !add_corners_beyond(work, w, corner, count))
        return false;
    }
  }
  return true;
}

static bool list_wires(struct plan_work *work) {
  bool ok = true;
  uint32_t wires = scene_wire_count(work->request->scene);
  for (uint32_t w = 0; ok && w < wires && poll_at(w); w++)
    ok = list_wire(work, w);
  for (uint32_t w = 0; w < work->count; w++)
    work->listed[w] = 0;
  return ok;
}

/* ---- Lists --------------------------------------------------------------- */

static bool list_face(struct plan_work *work, uint32_t window, uint32_t face,
                      uint32_t kept) {
  if (work->listed[window] == face + 1)
    return true;
  work->listed[window] = face + 1;
  return ARRAY_PUSH(&work->plan[window].face, face | kept);
}

/* Lists a face in the windows whose rings have it. */
static bool list_in_rings(struct plan_work *work, uint32_t face,
                          const uint32_t *corner, uint32_t count) {
  for (uint32_t c = 0; c < count; c++) {
    if ((work->tag[corner[c]] & AT_RING) == 0)
      continue;
    size_t past, i = ring_corners_at(&work->ring, corner[c], &past);
    for (; i < past; i++)
      if (!list_face(work, work->ring.at.item[i].value, face, 0))
        return false;
  }
  return true;
}

static bool list_faces_of_windows(struct plan_work *work) {
  const struct scene *scene = work->request->scene;
  for (uint32_t f = 0; f < scene_face_count(scene) && poll_at(f); f++) {
    uint32_t start = scene_face_start(scene, f);
    uint32_t count = scene_face_corners(scene, f);
    const uint32_t *corner = scene->corner.item + start;
    uint16_t tag = tag_of_corners(work, corner, count);
    if (tag != 0) {
      if (!ARRAY_PUSH(&work->plan[tag - 1].face, f | PLAN_KEPT))
        return false;
      continue;
    }
    const struct part_window box = box_of_plan_face(work, f);
    uint32_t met = window_grid_meet(&work->grid, &box);
    for (uint32_t i = 0; i < met; i++)
      if (!list_face(work, work->grid.met[i], f, PLAN_KEPT))
        return false;
    if (!list_in_rings(work, f, corner, count))
      return false;
  }
  return true;
}

static bool tag_ring_corners(struct plan_work *work) {
  const struct plan_faces_request *request = work->request;
  for (size_t p = 0; p < request->scene->point.count; p++)
    if (ring_corners_has(&work->ring, (uint32_t)p))
      work->tag[p] |= AT_RING;
  return true;
}

recto_status plan_faces_list(struct plan_window *plan, uint32_t count,
                             const struct plan_faces_request *request,
                             recto_error *error) {
  struct plan_work work = {
      .plan = plan,
      .count = count,
      .request = request,
      .ring = {.point = request->scene->point.item, .place = request->place}};
  work.listed = mem_calloc(count, sizeof *work.listed);
  bool ok = work.listed != NULL && set_boxes(&work) && tag_points(&work) &&
            list_wires(&work) && add_corners_of_faces(&work) &&
            ring_corners_close(&work.ring, request->scene->point.count) &&
            tag_ring_corners(&work) && list_faces_of_windows(&work);
  mem_free(work.listed);
  mem_free(work.box);
  mem_free(work.tag);
  window_grid_fini(&work.grid);
  ring_corners_fini(&work.ring);
  return ok && !poll_is_cancelled() ? RECTO_OK : error_memory(error);
}
