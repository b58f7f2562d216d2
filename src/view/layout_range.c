/* layout_range.c - computes the depth range of what is drawn.
 *
 * The sheet's depths are integers over a range.  What is outside the page, or
 * in front of the near plane, is not part of it: a ground plane that reaches to
 * the horizon, or a far corner of a face that the page's border clips, must not
 * make the depths of what is drawn coarser.  So faces that leave the page are
 * clipped twice: here for their depths, and in layout_triangles.c.
 *
 * A face seen edge-on hides nothing, so only the order of its depths against
 * those of other faces matters: the near edge of a floor in a front view is in
 * front of everything and the far edge behind.  A side of such a face, or a
 * polyline, that is wholly outside the range is set to the end of the range
 * (project_point); where it overlaps the range, the range is extended to
 * include it, so that it stays straight.  If there is one behind the range, the
 * far end is moved back by the length of the range, so that what is set to it
 * is not in contact with the farthest face.  A range that is so short that it
 * would be, as that of a single face seen from the front, includes all lines.
 * Where what is left of a face seen edge-on is nearer than the range, as where
 * the near plane cuts it, the near end is moved towards it, at most so far that
 * the range of z is twice as long, so that it pierces the nearest face instead
 * of ending on it.
 */
#include "base/poll.h"
#include "geom/vector.h"
#include "view/layout_phases.h"

/* Whether a default near plane clips anything visible is tested by clipping to
 * a near plane at this fraction of its distance. */
#define NEARER 0x1p-20

struct depth_range {
  double low, high;
  double edge_on; /* the least depth of triangles without an area */
  bool is_passed; /* lines were left out that are wholly behind it */
};

#define EMPTY_RANGE                                                            \
  { .low = INFINITY, .high = -INFINITY, .edge_on = INFINITY }

/* Extending the range by one line may make it overlap another, so the lines are
 * gone through until nothing changes; in the last of so many rounds all of them
 * are included. */
enum { MAX_ROUNDS = 8 };

static void grow_range(struct depth_range *range, double d) {
  range->low = min_number(range->low, d);
  range->high = max_number(range->high, d);
}

/* Whether a convex polygon has an area after rounding to the page grid. */
static bool has_area(const struct projection *projection,
                     const struct clip_polygon *polygon) {
  struct geom_point first = project_point(projection, polygon->corner[0].at);
  struct geom_point last = project_point(projection, polygon->corner[1].at);
  for (int k = 2; k < polygon->count; k++) {
    struct geom_point next = project_point(projection, polygon->corner[k].at);
    if (geom_orient2d(first, last, next) != 0)
      return true;
    last = next;
  }
  return false;
}

static void sort_pair(uint32_t *a, uint32_t *b) {
  uint32_t low = *a < *b ? *a : *b;
  *b = *a < *b ? *b : *a;
  *a = low;
}

/* Includes the depths of a clipped triangle, if it has an area on the page; if
 * not, in `edge_on`.
 * Its corners are taken in the order of their indices, so that the range does
 * not depend, not even in the last bit, on the face's own order. */
static void grow_by_triangle(struct depth_range *range,
                             const struct layout *layout,
                             const struct projection *projection,
                             const uint32_t point[3]) {
  const bool forward[3] = {true, true, false};
  struct view_point corner[3];
  struct clip_polygon polygon;
  uint32_t own[3];
  for (int k = 0; k < 3; k++)
    own[k] = layout_weld(layout, point[k]);
  sort_pair(&own[0], &own[1]);
  sort_pair(&own[1], &own[2]);
  sort_pair(&own[0], &own[1]);
  for (int k = 0; k < 3; k++)
    corner[k] = layout_view(layout, own[k]);
  if (!clip_triangle(projection, corner, forward, &polygon))
    return;
  bool area = has_area(projection, &polygon);
  for (int k = 0; k < polygon.count; k++) {
    double d = polygon.corner[k].at.d;
    if (area)
      grow_range(range, d);
    else
      range->edge_on = min_number(range->edge_on, d);
  }
}

/* The same for a face.  Returns false when memory ran out. */
static bool grow_by_face(struct depth_range *range, struct layout *layout,
                         const struct projection *projection, uint32_t face) {
  uint32_t start = scene_face_start(layout->scene, face);
  uint32_t count = scene_face_start(layout->scene, face + 1) - start;
  const uint32_t *corner = layout->scene->corner.item + start;
  if (count == 3) {
    grow_by_triangle(range, layout, projection, corner);
    return true;
  }
  if (!triangulate(&layout->triangulation, layout->scene->point.item, corner,
                   count))
    return false;
  for (size_t t = 0; t < layout->triangulation.triangle.count; t++) {
    const uint32_t *own = layout->triangulation.triangle.item[t].corner;
    const uint32_t point[3] = {corner[own[0]], corner[own[1]], corner[own[2]]};
    grow_by_triangle(range, layout, projection, point);
  }
  return true;
}

/* Whether the default near plane clips a part of a face that would be on the
 * page. */
static bool is_cut_near(struct layout *layout, uint32_t face, bool *cut) {
  struct projection nearer = layout->projection;
  struct depth_range range = {.low = INFINITY, .high = -INFINITY};
  nearer.near_d *= NEARER;
  bool ok = grow_by_face(&range, layout, &nearer, face);
  *cut = range.low < layout->projection.near_d;
  return ok;
}

static bool grow_by_faces(struct depth_range *range, struct layout *layout) {
  bool look =
      layout->projection.perspective && layout->sheet->camera.near_chosen;
  for (uint32_t face = 0; face < scene_face_count(layout->scene); face++) {
    unsigned any = 0, all = ~0u;
    for (uint32_t c = scene_face_start(layout->scene, face);
         c < scene_face_start(layout->scene, face + 1); c++) {
      uint8_t code =
          layout->outcode[layout_weld(layout, layout->scene->corner.item[c])];
      any |= code;
      all &= code;
    }
    bool cut = false;
    if (!poll_at(face))
      return false;
    if (look && (any & CLIP_NEAR_BIT) && !is_cut_near(layout, face, &cut))
      return false;
    layout->sheet->cut_near += cut;
    if (any && !all && !grow_by_face(range, layout, &layout->projection, face))
      return false;
  }
  return true;
}

/* Includes the depths of a clipped segment if they overlap the range.
 * force  include them in any case
 * Returns whether the range grew. */
static bool grow_by_segment(struct depth_range *range,
                            const struct layout *layout, uint32_t from,
                            uint32_t to, bool force) {
  uint32_t own[2] = {layout_weld(layout, from), layout_weld(layout, to)};
  sort_pair(&own[0], &own[1]);
  struct view_point end[2] = {layout_view(layout, own[0]),
                              layout_view(layout, own[1])};
  bool moved[2];
  if (!clip_segment(&layout->projection, end, moved))
    return false;
  double low = fmin(end[0].d, end[1].d), high = fmax(end[0].d, end[1].d);
  if (!force && (high < range->low || low > range->high)) {
    range->is_passed |= low > range->high;
    return false;
  }
  bool grows = low < range->low || high > range->high;
  grow_range(range, low);
  grow_range(range, high);
  return grows;
}

/* The same for the segments between consecutive corners.
 * closed  whether a segment joins the last corner to the first */
static bool grow_by_lines(struct depth_range *range,
                          const struct layout *layout, const uint32_t *corner,
                          uint32_t count, bool closed, bool force) {
  unsigned any = 0;
  bool grew = false;
  for (uint32_t c = 0; c < count; c++)
    any |= layout->outcode[layout_weld(layout, corner[c])];
  for (uint32_t c = closed ? 0 : 1; any && c < count; c++)
    grew |= grow_by_segment(range, layout, corner[c == 0 ? count - 1 : c - 1],
                            corner[c], force);
  return grew;
}

/* One round over all lines that leave the page.  Returns whether the range
 * grew. */
static bool grow_by_all_lines(struct depth_range *range,
                              const struct layout *layout, bool force) {
  const struct scene *scene = layout->scene;
  bool grew = false;
  for (uint32_t face = 0; face < scene_face_count(scene); face++) {
    uint32_t start = scene_face_start(scene, face);
    grew |=
        grow_by_lines(range, layout, scene->corner.item + start,
                      scene_face_start(scene, face + 1) - start, true, force);
  }
  for (uint32_t w = 0; w < scene_wire_count(scene); w++) {
    uint32_t start = scene->wire_start.item[w];
    grew |= grow_by_lines(range, layout, scene->wire_corner.item + start,
                          scene->wire_start.item[w + 1] - start, false, force);
  }
  return grew;
}

/* Sets the outcodes of the used points and includes the depths of those on the
 * page. */
static void grow_by_points(struct depth_range *range, struct layout *layout,
                           const uint8_t *used) {
  for (size_t p = 0; p < layout->scene->point.count; p++) {
    if (!used[p])
      continue;
    struct view_point at = layout_view(layout, (uint32_t)p);
    layout->outcode[p] = clip_outcode(&layout->projection, at);
    if (layout->outcode[p] == 0)
      grow_range(range, at.d);
  }
}

recto_status layout_range(struct layout *layout, const uint8_t *used) {
  struct camera *camera = &layout->sheet->camera;
  struct depth_range range = EMPTY_RANGE;
  if (camera->all_on_page)
    return RECTO_OK;
  grow_by_points(&range, layout, used);
  if (!grow_by_faces(&range, layout))
    return error_memory(layout->error);
  bool shallow = range.high - range.low <= 4 * camera->contact_most,
       grew = true;
  for (int round = 1; grew && round <= MAX_ROUNDS; round++) {
    range.is_passed = false;
    grew = grow_by_all_lines(&range, layout, shallow || round == MAX_ROUNDS);
  }
  if (range.low > range.high)
    return RECTO_OK;
  double high = range.high;
  if (range.is_passed)
    range.high += high - range.low;
  if (range.edge_on < range.low)
    range.low = max_number(range.edge_on, camera->perspective
                                              ? 1 / (2 / range.low - 1 / high)
                                              : 2 * range.low - high);
  camera->d_min = range.low;
  camera->d_max = range.high;
  layout->projection = projection_of(camera);
  return RECTO_OK;
}
