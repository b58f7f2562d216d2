/* weld_near.c - a scene in which the corners of borders that lie close together
 * are one.
 *
 * Phases
 *   candidates  the points of edges that only one face has, once those at equal
 *               positions are one (weld_equal.h).
 *   length      over which points may be joined at most: the requested one; or
 *               where there is none, what rounding explains: see below.
 *   isolated    points that have no other within it are left out.
 *   radius      of each other, the requested length or what rounding explains.
 *   join        into clusters (cluster.h); one member's position represents
 *               all, none is made up.
 *   rewrite     faces and polylines use the points that represent theirs.
 *   doubled     faces that are listed twice are left out once
 *               (doubled_faces.h).
 *   slits       thin faces are left out, and slits are closed (face_rewrite.h).
 *
 * What rounding explains.  A file's coordinates have a common scale S, the
 * power of two below which nine in ten of the candidates' coordinates lie: one
 * far corner does not widen it, and near x = 0 it is no less, for noise is not
 * either.  Of it rounding moved them by E (precision.h).  Two roundings of one
 * point are up to 2 sqrt(3) E apart; coordinates that were computed in several
 * ways more, so up to 32 E are joined where that is invisible,
 * TOLERANCE_WELD_SHARE.  No point joins another over more than a small share
 * of its smallest face, TOLERANCE_WELD_FACE_SHARE: where S is too large for a
 * part of the model, that keeps its parts.  The longest side of a face is
 * taken for its size, because rounding makes needles of faces without area,
 * and the short sides of those are what should be joined.
 */
#include "scene/weld/weld_near.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "base/tolerance.h"
#include "geom/vector.h"
#include "scene/corner_normals.h"
#include "scene/weld/doubled_faces.h"
#include "scene/weld/face_rewrite.h"
#include "scene/weld/isolated_members.h"
#include "scene/weld/slits.h"
#include "scene/weld/thin_faces.h"
#include "scene/weld/weld_candidates.h"

/* ---- Radii --------------------------------------------------------------- */

/* As of frexp, of a number that is not negative. */
static inline int exponent_of(double size) {
  int exponent = 0;
  if (size < DBL_MIN) {
    frexp(size, &exponent);
    return exponent;
  }
  uint64_t bits;
  memcpy(&bits, &size, sizeof bits);
  return (int)(bits >> (DBL_MANT_DIG - 1)) - (DBL_MAX_EXP - 2);
}

/* The power of two below which nine in ten of the members' largest coordinates
 * lie. */
static double common_scale(const struct scene *scene,
                           const struct cluster_member *member, size_t count) {
  enum { LEAST = -1100, COUNT = 2200, ONE_IN = 10 };
  uint32_t histogram[COUNT] = {0};
  for (size_t i = 0; i < count; i++) {
    const struct scene_point *p = &scene->point.item[member[i].point];
    double size = max_number(fabs(p->x), max_number(fabs(p->y), fabs(p->z)));
    histogram[(size > 0 ? exponent_of(size) : LEAST) - LEAST]++;
  }
  size_t sum = 0;
  int slot = COUNT;
  while (slot > 0 && ONE_IN * sum <= count)
    sum += histogram[--slot];
  return ldexp(1, slot + LEAST);
}

/* What rounding explains of points with a common scale. */
static double explained_length(double scale, struct precision precision) {
  const double certain = 4; /* 2 sqrt(3), rounded up */
  double error = precision_error(precision, scale);
  return fmax(certain * error, fmin(TOLERANCE_WELD_ERRORS * error,
                                    TOLERANCE_WELD_SHARE * scale));
}

/* The distance that rounding explains for the points up to a number. */
struct rounding_length {
  uint32_t end_point;
  double length;
};

typedef ARRAY(struct rounding_length) rounding_lengths;

/* The first point from which on the precision is not that of this one. */
static uint32_t end_of_precision(const struct scene *scene, uint32_t point) {
  uint32_t end = SCENE_NONE;
  for (size_t r = scene->precision.count; r > 0; r--)
    if (scene->precision.item[r - 1].first_point > point)
      end = scene->precision.item[r - 1].first_point;
  return end;
}

/* Finds for each range of the members' points that has a precision of its own
 * the distance that rounding of its coordinates explains.
 * most  gets the longest of these
 * Returns false when memory ran out. */
static bool find_rounding_lengths(const struct scene *scene,
                                  const struct weld_candidates *candidates,
                                  struct precision unstated,
                                  rounding_lengths *lengths, double *most) {
  const struct cluster_member *member = candidates->member.item;
  *most = 0;
  for (size_t i = 0, end; i < candidates->member.count; i = end) {
    uint32_t end_point = end_of_precision(scene, member[i].point);
    for (end = i + 1;
         end < candidates->member.count && member[end].point < end_point;)
      end++;
    double length = explained_length(
        common_scale(scene, member + i, end - i),
        scene_point_precision(scene, member[i].point, unstated));
    struct rounding_length range = {end_point, length};
    if (!ARRAY_PUSH(lengths, range))
      return false;
    *most = fmax(*most, length);
  }
  return true;
}

/* Sets the radii that rounding explains.  Returns false when memory ran out. */
static bool set_explained_radii(struct weld_candidates *candidates,
                                const struct scene *scene,
                                const struct topology *topology,
                                const rounding_lengths *lengths,
                                double length) {
  size_t range = 0;
  if (!weld_candidates_measure(candidates, scene, topology))
    return false;
  for (size_t i = 0; i < candidates->member.count; i++) {
    struct cluster_member *member = &candidates->member.item[i];
    while (member->point >= lengths->item[range].end_point)
      range++;
    double face = sqrt(candidates->size[i]) * TOLERANCE_WELD_FACE_SHARE;
    weld_candidate_set_radius(member, length,
                              fmin(lengths->item[range].length, face));
  }
  return true;
}

double weld_near_length_most(const struct scene *scene,
                             const struct weld_request *request) {
  double largest = 0, most = 0;
  int exponent;
  if (request->length >= 0)
    return fmin(request->length, WELD_LENGTH_MAX);
  for (size_t p = 0; p < scene->point.count; p++) {
    const struct scene_point *at = &scene->point.item[p];
    largest = max_number(largest, fabs(at->x));
    largest = max_number(largest, fabs(at->y));
    largest = max_number(largest, fabs(at->z));
  }
  frexp(largest, &exponent);
  most = explained_length(ldexp(1, exponent), request->unstated);
  for (size_t r = 0; r < scene->precision.count; r++)
    if (scene->precision.item[r].stated)
      most = fmax(most, explained_length(ldexp(1, exponent),
                                         scene->precision.item[r].precision));
  return most;
}

/* ---- Rewriting ----------------------------------------------------------- */

/* Makes `number` the map from each point to the one it is welded to, which is
 * the lowest of those at one position. */
static uint32_t *make_map(struct weld_candidates *candidates,
                          const struct scene *scene,
                          const struct topology *topology) {
  const struct cluster_member *member = candidates->member.item;
  uint32_t *map = candidates->number;
  for (size_t p = 0; p < scene->point.count; p++) {
    uint32_t same = topology->weld != NULL ? topology->weld[p] : (uint32_t)p;
    if (same != p)
      map[p] = map[same];
    else
      map[p] = map[p] ? member[member[map[p] - 1].representative].point
                      : (uint32_t)p;
  }
  return map;
}

/* The corners as the map has them; returns whether one is another. */
static bool map_corners(const uint32_t *corner, size_t count,
                        const uint32_t *map, uint32_t *to) {
  bool changed = false;
  for (size_t i = 0; i < count; i++) {
    to[i] = map[corner[i]];
    changed = changed || to[i] != corner[i];
  }
  return changed;
}

/* Adds a face of `from` with its corners mapped.  One that keeps them is
 * without fault; others are examined as if they were new.
 * corner  room for its corners */
static recto_status map_face(struct scene *to, const struct scene *from,
                             uint32_t face, const uint32_t *map,
                             uint32_t *corner, recto_error *error) {
  const uint32_t *own = from->corner.item + scene_face_start(from, face);
  uint32_t count = scene_face_corners(from, face);
  size_t first = to->corner.count;
  recto_status status = RECTO_OK;
  to->current_group = scene_face_group(from, face);
  if (!face_rewrite_smoothing(to, from, face))
    return error_memory(error);
  if (map_corners(own, count, map, corner)) {
    status = scene_add_face(to, corner, count, 0, NULL, error);
  } else {
    memcpy(to->corner.item + first, corner, count * sizeof *corner);
    to->corner.count += count;
    if (!scene_end_face(to, to->current_group))
      status = error_memory(error);
  }
  return status == RECTO_OK && !face_rewrite_normals(to, first, from, face)
             ? error_memory(error)
             : status;
}

/* Adds the faces of `from` with their corners mapped. */
static recto_status map_faces(struct scene *to, const struct scene *from,
                              const uint32_t *map, uint32_t *corner,
                              recto_error *error) {
  recto_status status = RECTO_OK;
  uint32_t faces = scene_face_count(from);
  size_t skipped = 0; /* of those that `from` skipped */
  if (!ARRAY_RESERVE(&to->corner, from->corner.count))
    return error_memory(error);
  for (uint32_t f = 0; f < faces && status == RECTO_OK; f++) {
    if (!poll_at(f))
      status = error_cancelled(error);
    for (; status == RECTO_OK && skipped < from->face_skipped.count &&
           from->face_skipped.item[skipped] == f;
         skipped++)
      status = scene_skip_face(to, error);
    if (status == RECTO_OK)
      status = map_face(to, from, f, map, corner, error);
  }
  return status;
}

static recto_status map_wires(struct scene *to, const struct scene *from,
                              const uint32_t *map, uint32_t *corner,
                              recto_error *error) {
  recto_status status = RECTO_OK;
  for (uint32_t w = 0; w < scene_wire_count(from) && status == RECTO_OK; w++) {
    uint32_t start = from->wire_start.item[w];
    uint32_t count = from->wire_start.item[w + 1] - start;
    to->current_group = from->wire_group.item[w];
    map_corners(from->wire_corner.item + start, count, map, corner);
    status = scene_add_wire(to, corner, count, 0, NULL, error);
  }
  return status;
}

/* Makes the welded scene share all arrays but those of faces and polylines. */
static void share_arrays(struct welded *welded, const struct scene *scene) {
  struct scene *own = &welded->scene;
  *own = *scene;
  face_rewrite_begin(own);
  welded->owns_faces = welded->owns_wires = true;
  memset(&own->wire_corner, 0, sizeof own->wire_corner);
  memset(&own->wire_start, 0, sizeof own->wire_start);
  memset(&own->wire_group, 0, sizeof own->wire_group);
}

static recto_status rewrite(struct welded *welded, const struct scene *scene,
                            const uint32_t *map, recto_error *error) {
  size_t most = scene->corner.count > scene->wire_corner.count
                    ? scene->corner.count
                    : scene->wire_corner.count;
  uint32_t *corner = mem_alloc(most, sizeof *corner);
  share_arrays(welded, scene);
  recto_status status =
      corner != NULL ? map_faces(&welded->scene, scene, map, corner, error)
                     : error_memory(error);
  if (status == RECTO_OK)
    status = map_wires(&welded->scene, scene, map, corner, error);
  mem_free(corner);
  welded->scene.current_group = scene->current_group;
  welded->lost = scene_face_count(scene) - scene_face_count(&welded->scene);
  return status;
}

/* ---- All of it ----------------------------------------------------------- */

/* Joins the members that are left when those without neighbours were dropped.
 * lengths  of ranges of points; empty: all may be joined over welded->length
 * Returns false when memory ran out. */
static bool join_members(struct welded *welded,
                         struct weld_candidates *candidates,
                         const struct topology *topology,
                         const rounding_lengths *lengths) {
  enum { LENGTHS = 64 }; /* far less than most faces */
  const struct scene *scene = &welded->scene;
  struct cluster_member *member = candidates->member.item;
  if (!isolated_members_drop(scene, welded->length, LENGTHS, member,
                             &candidates->member.count))
    return false;
  if (candidates->member.count == 0)
    return true;
  if (!weld_candidates_number(candidates, scene) ||
      (lengths->count > 0 && !set_explained_radii(candidates, scene, topology,
                                                  lengths, welded->length)))
    return false;
  welded->joined =
      cluster_join(scene, welded->length, member, candidates->member.count);
  return welded->joined != SIZE_MAX;
}

/* Finds the length and joins; false when memory ran out. */
static bool join_close_points(struct welded *welded,
                              struct weld_candidates *candidates,
                              const struct topology *topology,
                              const struct weld_request *request) {
  const struct scene *scene = &welded->scene;
  rounding_lengths lengths = {.item = NULL};
  if (!weld_candidates_list(candidates, scene, topology))
    return false;
  if (candidates->member.count == 0)
    return true;
  welded->length = fmin(request->length, WELD_LENGTH_MAX);
  bool ok = request->length >= 0 ||
            find_rounding_lengths(scene, candidates, request->unstated,
                                  &lengths, &welded->length);
  if (ok && welded->length >= WELD_LENGTH_LEAST)
    ok = join_members(welded, candidates, topology, &lengths);
  ARRAY_FREE(&lengths);
  return ok;
}

/* Builds the edges and welds. */
static recto_status weld_points(struct welded *welded,
                                struct topology *topology,
                                const struct scene *scene,
                                const struct weld_request *request,
                                recto_error *error) {
  struct weld_candidates candidates = {.number = NULL};
  recto_status status = request->leaves_out_corners
                            ? topology_init_edges(topology, scene, error)
                            : topology_init(topology, scene, error);
  if (status != RECTO_OK)
    return status;
  if (request->length == 0 || topology->borders == 0)
    return status;
  if (!join_close_points(welded, &candidates, topology, request)) {
    welded->joined = 0;
    status = error_memory(error);
  } else if (welded->joined > 0) {
    const uint32_t *map = make_map(&candidates, scene, topology);
    topology_fini(topology);
    status = rewrite(welded, scene, map, error);
    if (status == RECTO_OK)
      status = topology_init(topology, &welded->scene, error);
  }
  weld_candidates_fini(&candidates);
  return status;
}

/* ---- Slits --------------------------------------------------------------- */

/* Replaces the faces by those without the marked ones, which have the points
 * that lie on their sides, and builds the edges anew. */
static recto_status replace_faces(struct welded *welded,
                                  struct topology *topology,
                                  const uint64_t *left_out,
                                  const slit_points *points,
                                  recto_error *error) {
  struct scene next = welded->scene;
  face_rewrite_begin(&next);
  topology_fini(topology);
  recto_status status =
      face_rewrite(&next, &welded->scene, left_out, points, error);
  if (welded->owns_faces)
    face_rewrite_fini(&welded->scene);
  welded->scene = next;
  welded->owns_faces = true;
  return status == RECTO_OK ? topology_init(topology, &welded->scene, error)
                            : status;
}

/* Leaves out the faces that are listed twice, or thin ones. */
static recto_status drop_faces(struct welded *welded, struct topology *topology,
                               struct precision unstated, bool doubled,
                               recto_error *error) {
  const struct scene *scene = &welded->scene;
  uint64_t *map;
  size_t *count = doubled ? &welded->doubled : &welded->thin;
  bool ok = doubled ? doubled_faces_find(scene, topology, &map, count)
                    : thin_faces_find(scene, topology, unstated, &map, count);
  recto_status status = ok ? RECTO_OK : error_memory(error);
  if (ok && *count > 0)
    status = replace_faces(welded, topology, map, NULL, error);
  mem_free(map);
  return status;
}

static recto_status close_slits(struct welded *welded,
                                struct topology *topology,
                                const struct weld_request *request,
                                recto_error *error) {
  slit_points points = {.item = NULL};
  recto_status status = RECTO_OK;
  if (!slits_find(&welded->scene, topology, request->unstated, &points))
    status = error_memory(error);
  else if (points.count > 0)
    status = replace_faces(welded, topology, NULL, &points, error);
  ARRAY_FREE(&points);
  return status;
}

recto_status weld_near(struct welded *welded, struct topology *topology,
                       const struct scene *scene,
                       const struct weld_request *request, recto_error *error) {
  *welded = (struct welded){.scene = *scene};
  recto_status status = weld_points(welded, topology, scene, request, error);
  if (status == RECTO_OK && request->length != 0 && !request->keeps_doubled)
    status = drop_faces(welded, topology, request->unstated, true, error);
  if (status == RECTO_OK && request->length != 0)
    status = drop_faces(welded, topology, request->unstated, false, error);
  if (status == RECTO_OK && request->length != 0)
    status = close_slits(welded, topology, request, error);
  welded->borders = topology->borders;
  if (status != RECTO_OK) {
    topology_fini(topology);
    welded_fini(welded);
  }
  return status;
}

void welded_fini(struct welded *welded) {
  struct scene *own = &welded->scene;
  if (welded->owns_faces)
    face_rewrite_fini(own);
  if (welded->owns_wires) {
    ARRAY_FREE(&own->wire_corner);
    ARRAY_FREE(&own->wire_start);
    ARRAY_FREE(&own->wire_group);
  }
  memset(welded, 0, sizeof *welded);
}
