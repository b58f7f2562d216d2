/* crease_marks.c - finds which edges a file marks as hard or as smooth.
 *
 * Phases
 *   1 normals   of the sides of an edge's two faces, at both of its ends
 *   2 read      what these, or the faces' smoothing groups, say of the edge
 *   3 judge     which parts of the mesh have marks that mean something
 *   4 settle    the marks that count at the angle of their edge
 * Where a program writes one kind of mark all over a body, as smooth normals
 * for a cube or flat ones for a scan, it says nothing about its edges. */
#include "scene/edges/crease_marks.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

#include "base/parallel.h"
#include "base/tolerance.h"
#include "base/union_find.h"
#include "scene/angle.h"
#include "scene/corner_normals.h"
#include "scene/newell_normal.h"
#include "scene/topology/side_iterator.h"
#include "scene/topology/weld_equal.h"

/* Of two faces that are flat by themselves; none of these is left at the end.
 */
enum { CREASE_MARK_FLAT = CREASE_MARK_SOFT + 1, CREASE_MARK_COUNT };

/* The largest share of edges of flat faces in a part where such edges count:
 * one in so many. */
enum { FLAT_SHARE = 4 };

struct crease_mark_range crease_mark_range_of(recto_crease_marks which,
                                              double crease_deg) {
  if (which == RECTO_CREASE_MARKS_ALL)
    return (struct crease_mark_range){0, 180};
  if (which == RECTO_CREASE_MARKS_NONE || crease_deg >= 180)
    return (struct crease_mark_range){crease_deg, crease_deg};
  return (struct crease_mark_range){crease_deg / 2, fmin(2 * crease_deg, 180)};
}

/* ---- Whether there are any ----------------------------------------------- */

/* Whether a scene's files mark edges, but for normals that differ because
 * points are welded. */
static bool has_marks(const struct scene *scene, recto_crease_marks which) {
  if (which == RECTO_CREASE_MARKS_NONE)
    return false;
  if (which == RECTO_CREASE_MARKS_ALL)
    return scene->point_normal.count > 0 || scene->smoothing.range.count > 0;
  return scene->corner_normal.count > 0 || scene->has_several_normals ||
         (scene->is_read_in_passes && scene->smoothing.has_several) ||
         smoothing_has_several(&scene->smoothing);
}

/* Whether welded points may have several normals that count. */
static bool may_differ_where_welded(const struct scene *scene,
                                    recto_crease_marks which) {
  return which == RECTO_CREASE_MARKS_AUTO && scene->point_normal.count > 0;
}

bool crease_marks_exist(const struct scene *scene, recto_crease_marks which,
                        bool *found) {
  *found = has_marks(scene, which);
  if (*found || !may_differ_where_welded(scene, which))
    return true;
  /* Points at one position are one point. */
  uint32_t *weld = NULL;
  size_t count = scene->point_normal.count;
  uint32_t *point = mem_alloc(count, sizeof *point);
  for (size_t p = 0; point != NULL && p < count; p++)
    point[p] = (uint32_t)p;
  bool ok = point != NULL && weld_equal(scene, point, count, &weld);
  for (size_t p = 0; ok && weld != NULL && p < count; p++)
    *found = *found ||
             scene->point_normal.item[p] != scene->point_normal.item[weld[p]];
  mem_free(point);
  mem_free(weld);
  return ok;
}

/* ---- Reading ------------------------------------------------------------- */

/* The normals of two faces, each at the lower and the upper end of their edge;
 * 0: none. */
struct end_normals {
  uint32_t normal[2][2];
};

struct mark_search {
  const struct scene *scene;
  const struct topology *topology;
  struct end_normals *end; /* one an edge of two faces; NULL: there are none */
  atomic_uchar *flatness; /* one a face: 0, or enum flatness once it is known */
  uint8_t *mark;          /* one an edge: enum crease_mark */
  double cosine[2];       /* of the lowest and the highest angle that counts */
  atomic_bool any;        /* an edge has a mark that counts */
};

/* Does a task for ranges of all edges; false when the caller cancelled. */
static bool divide_edges(struct mark_search *s, parallel_task *task) {
  size_t edges = s->topology->edge.count;
  return parallel_ranges(parallel_workers(edges, PARALLEL_ITEMS), edges,
                         PARALLEL_ITEMS, task, s);
}

static bool has_two_faces(const struct topology_edge *edge) {
  return edge->uses == 2 && edge->first != edge->second;
}

/* Whether two faces have one normal at a point.
 * same_way  their windings disagree, and so may the signs of the normals */
static bool have_one_normal(uint32_t a, uint32_t b, bool same_way) {
  return corner_normals_agree(a, b) ||
         (same_way && corner_normals_agree(a, corner_normal_opposite(b)));
}

enum flatness { FLATNESS_BENT = 1, FLATNESS_FLAT };

/* Whether the normals of a face are all that of its plane. */
static uint8_t find_flatness(const struct scene *scene, uint32_t face) {
  double n[3];
  newell_normal_of_face(scene, face, n);
  uint32_t normal = corner_normal_encode(n[0], n[1], n[2]);
  for (uint32_t c = scene_face_start(scene, face);
       normal != 0 && c < scene_face_start(scene, face + 1); c++) {
    uint32_t own = corner_normal_of(scene, c);
    if (own == 0 || !have_one_normal(own, normal, true))
      return FLATNESS_BENT;
  }
  return FLATNESS_FLAT;
}

/* Threads may find it for one face at once, and find the same. */
static bool is_flat(const struct mark_search *s, uint32_t face) {
  uint8_t flatness =
      atomic_load_explicit(&s->flatness[face], memory_order_relaxed);
  if (flatness == 0) {
    flatness = find_flatness(s->scene, face);
    atomic_store_explicit(&s->flatness[face], flatness, memory_order_relaxed);
  }
  return flatness == FLATNESS_FLAT;
}

static uint8_t mark_by_groups(const struct scene *scene,
                              const struct topology_edge *edge) {
  uint32_t a = smoothing_of_face(&scene->smoothing, edge->first);
  uint32_t b = smoothing_of_face(&scene->smoothing, edge->second);
  if (a == SMOOTHING_UNKNOWN || b == SMOOTHING_UNKNOWN)
    return CREASE_MARK_NONE;
  if (a == SMOOTHING_OFF && b == SMOOTHING_OFF)
    return CREASE_MARK_FLAT;
  return a == b ? CREASE_MARK_SOFT : CREASE_MARK_HARD;
}

/* Where both faces have normals, these alone count.  Those that differ at one
 * end alone say nothing: there a hard line ends, or the apex of a cone is. */
static uint8_t mark_by_normals(const struct mark_search *s,
                               const struct topology_edge *edge,
                               const struct end_normals *end) {
  int common = 0;
  for (int k = 0; k < 2; k++) {
    uint32_t first = end->normal[0][k], second = end->normal[1][k];
    if (first == 0 || second == 0)
      return mark_by_groups(s->scene, edge);
    common += have_one_normal(first, second, edge->same_way);
  }
  if (common > 0)
    return common == 2 ? CREASE_MARK_SOFT : CREASE_MARK_NONE;
  return is_flat(s, edge->first) && is_flat(s, edge->second) ? CREASE_MARK_FLAT
                                                             : CREASE_MARK_HARD;
}

/* Gives the edges of faces their normals: each side has a place of its own. */
static bool collect_normals(void *user, struct parallel_range range) {
  const struct mark_search *s = user;
  const struct scene *scene = s->scene;
  for (struct side_iterator it =
           iterate_sides(scene, s->topology->weld, (uint32_t)range.begin,
                         (uint32_t)range.end);
       next_side(&it);) {
    uint32_t e = s->topology->corner_edge[it.corner];
    const struct topology_edge *edge = &s->topology->edge.item[e];
    if (!has_two_faces(edge))
      continue;
    uint32_t *own = s->end[e].normal[it.face != edge->first];
    uint32_t next = scene_next_corner(scene, it.face, it.corner);
    int from = it.from != edge->point[0];
    own[from] = corner_normal_of(scene, it.corner);
    own[1 - from] = corner_normal_of(scene, next);
  }
  return true;
}

static bool read_marks_of_range(void *user, struct parallel_range range) {
  const struct mark_search *s = user;
  for (size_t e = range.begin; e < range.end; e++) {
    const struct topology_edge *edge = &s->topology->edge.item[e];
    if (has_two_faces(edge))
      s->mark[e] = s->end != NULL ? mark_by_normals(s, edge, &s->end[e])
                                  : mark_by_groups(s->scene, edge);
  }
  return true;
}

/* Reads all marks.  Returns false when memory ran out. */
static bool read_marks(struct mark_search *s) {
  enum { FACES = PARALLEL_RANGE(POLL_ITEMS / 4) };
  size_t edges = s->topology->edge.count, faces = scene_face_count(s->scene);
  bool ok = true;
  if (s->scene->point_normal.count > 0) {
    s->end = mem_calloc(edges, sizeof *s->end);
    s->flatness = mem_calloc(faces, sizeof *s->flatness);
    ok = s->end != NULL && s->flatness != NULL &&
         parallel_ranges(parallel_workers(faces, FACES), faces, FACES,
                         collect_normals, s);
  }
  ok = ok && divide_edges(s, read_marks_of_range);
  mem_free(s->end);
  mem_free(s->flatness);
  return ok;
}

/* ---- Judging ------------------------------------------------------------- */

/* Whether any part may have hard edges and smooth ones. */
static bool has_both_kinds(const struct mark_search *s) {
  bool has[CREASE_MARK_COUNT] = {false};
  for (size_t e = 0; e < s->topology->edge.count; e++)
    has[s->mark[e]] = true;
  return has[CREASE_MARK_HARD] && has[CREASE_MARK_SOFT];
}

/* The cosine of the angle between the faces of an edge; 1: they bend by too
 * little to be marked. */
static double cosine_of_faces(const struct mark_search *s, size_t e) {
  const struct topology_edge *edge = &s->topology->edge.item[e];
  double n[2][3], dot = 0, square[2] = {0, 0};
  newell_normal_of_face(s->scene, edge->first, n[0]);
  newell_normal_of_face(s->scene, edge->second, n[1]);
  for (int i = 0; i < 3; i++) {
    dot += n[0][i] * n[1][i];
    square[0] += n[0][i] * n[0][i];
    square[1] += n[1][i] * n[1][i];
  }
  double lengths = sqrt(square[0]) * sqrt(square[1]);
  double cosine = lengths > 0 ? dot / lengths : 1;
  cosine = edge->same_way ? -cosine : cosine;
  return cosine > 0 && cosine * cosine >= TOLERANCE_NORMAL_SQUARED_COSINE
             ? 1
             : cosine;
}

/* Drops the marks of edges that do not bend, and those that do not count at the
 * angle of their edge but for smooth ones, which show that there are such. */
static bool drop_by_angle(void *user, struct parallel_range range) {
  const struct mark_search *s = user;
  for (size_t e = range.begin; e < range.end; e++) {
    if (s->mark[e] == CREASE_MARK_NONE)
      continue;
    double cosine = cosine_of_faces(s, e);
    bool is_soft = s->mark[e] == CREASE_MARK_SOFT;
    if (cosine == 1 || (!is_soft && cosine >= s->cosine[0]))
      s->mark[e] = CREASE_MARK_NONE;
  }
  return true;
}

/* Counts the marks of each connected part of the mesh.
 * part   gets a union-find of the points
 * count  CREASE_MARK_COUNT of each root */
static void count_marks(const struct mark_search *s, uint32_t *part,
                        uint32_t *count) {
  const struct topology_edge *edge = s->topology->edge.item;
  for (size_t e = 0; e < s->topology->edge.count; e++)
    union_find_join(part, edge[e].point[0], edge[e].point[1]);
  for (size_t e = 0; e < s->topology->edge.count; e++) {
    size_t root = union_find_root(part, edge[e].point[0]);
    count[root * CREASE_MARK_COUNT + s->mark[e]]++;
  }
}

/* Drops the marks of parts that have but one kind.
 * Returns false when memory ran out. */
static bool drop_by_part(const struct mark_search *s) {
  size_t points = s->scene->point.count;
  uint32_t *part = union_find_create(points);
  uint32_t *counts = mem_calloc(points, CREASE_MARK_COUNT * sizeof *counts);
  bool ok = part != NULL && counts != NULL;
  if (ok)
    count_marks(s, part, counts);
  for (size_t e = 0; ok && e < s->topology->edge.count && poll_at(e); e++) {
    size_t root = union_find_root(part, s->topology->edge.item[e].point[0]);
    const uint32_t *count = counts + root * CREASE_MARK_COUNT;
    uint64_t hard = count[CREASE_MARK_HARD], soft = count[CREASE_MARK_SOFT],
             flat = count[CREASE_MARK_FLAT];
    bool drops_flat = FLAT_SHARE * flat > hard + soft + flat;
    if (hard == 0 || soft == 0 ||
        (s->mark[e] == CREASE_MARK_FLAT && drops_flat))
      s->mark[e] = CREASE_MARK_NONE;
  }
  mem_free(part);
  mem_free(counts);
  return ok;
}

/* Makes what is left marks that say whether an edge is a crease, and notes
 * whether there are any. */
static bool settle_marks(void *user, struct parallel_range range) {
  struct mark_search *s = user;
  bool found = false;
  for (size_t e = range.begin; e < range.end; e++) {
    if (s->mark[e] == CREASE_MARK_FLAT)
      s->mark[e] = CREASE_MARK_HARD;
    if (s->mark[e] == CREASE_MARK_SOFT && cosine_of_faces(s, e) < s->cosine[1])
      s->mark[e] = CREASE_MARK_NONE;
    found = found || s->mark[e] != CREASE_MARK_NONE;
  }
  if (found)
    atomic_store(&s->any, true);
  return true;
}

bool crease_marks_find(struct topology *topology, const struct scene *scene,
                       recto_crease_marks which, double crease_deg) {
  const struct crease_mark_range range =
      crease_mark_range_of(which, crease_deg);
  size_t edges = topology->edge.count;
  bool is_welded = topology->weld != NULL;
  if (edges == 0 || (!has_marks(scene, which) &&
                     !(is_welded && may_differ_where_welded(scene, which))))
    return true;
  struct mark_search s = {
      .scene = scene,
      .topology = topology,
      .cosine = {
          angle_of_degrees(range.low_deg).cosine - TOLERANCE_CREASE_COSINE,
          range.high_deg >= 180 ? -2
                                : angle_of_degrees(range.high_deg).cosine -
                                      TOLERANCE_CREASE_COSINE}};
  bool by_parts = which != RECTO_CREASE_MARKS_ALL;
  s.mark = mem_calloc(edges, sizeof *s.mark);
  bool ok = s.mark != NULL && read_marks(&s);
  bool may_be = ok && (!by_parts || has_both_kinds(&s));
  if (may_be)
    ok = divide_edges(&s, drop_by_angle);
  if (may_be && ok && by_parts)
    ok = drop_by_part(&s);
  if (may_be && ok)
    ok = divide_edges(&s, settle_marks);
  if (ok && atomic_load(&s.any))
    topology->crease_mark = s.mark;
  else
    mem_free(s.mark);
  return ok;
}

/* ---- Cuts ---------------------------------------------------------------- */

bool crease_pairs_list(struct crease_pairs *pairs,
                       const struct topology *topology) {
  for (size_t e = 0; topology->crease_mark && e < topology->edge.count; e++) {
    const struct topology_edge *edge = &topology->edge.item[e];
    const struct sort_key pair = {sort_pair_key(edge->first, edge->second),
                                  topology->crease_mark[e]};
    if (pair.value != CREASE_MARK_NONE && !ARRAY_PUSH(&pairs->pair, pair))
      return false;
  }
  if (pairs->pair.count == 0)
    return true;
  return sort_keys_alone(pairs->pair.item, pairs->pair.count);
}

/* The mark of all edges that two faces have in common; none where these differ.
 */
static uint8_t mark_of_pair(const struct crease_pairs *pairs, uint32_t a,
                            uint32_t b) {
  const struct sort_key *pair = pairs->pair.item;
  uint64_t key = sort_pair_key(a, b);
  size_t at, count = pairs->pair.count;
  LOWER_BOUND(at, 0, count, pair[at].key < key);
  uint8_t mark = CREASE_MARK_NONE;
  for (size_t i = at; i < count && pair[i].key == key; i++) {
    if (i > at && pair[i].value != mark)
      return CREASE_MARK_NONE;
    mark = (uint8_t)pair[i].value;
  }
  return mark;
}

bool crease_pairs_mark(const struct crease_pairs *pairs,
                       struct topology *topology, const struct scene *cut) {
  size_t edges = topology->edge.count;
  if (pairs->pair.count == 0 || edges == 0)
    return true;
  topology->crease_mark = mem_calloc(edges, sizeof *topology->crease_mark);
  for (size_t e = 0; topology->crease_mark && e < edges; e++) {
    const struct topology_edge *edge = &topology->edge.item[e];
    if (edge->uses == 2 && edge->first < cut->cut->first_face &&
        edge->second < cut->cut->first_face)
      topology->crease_mark[e] = mark_of_pair(
          pairs, cut->cut->face[edge->first], cut->cut->face[edge->second]);
  }
  return topology->crease_mark != NULL;
}

/* ---- Classes ------------------------------------------------------------- */

void crease_marks_apply(const struct topology *topology, uint8_t *class_masks) {
  const unsigned smooth = RECTO_EDGE_SMOOTH;
  for (size_t e = 0; topology->crease_mark && e < topology->edge.count; e++) {
    if (topology->crease_mark[e] == CREASE_MARK_NONE)
      continue;
    unsigned mask = crease_mark_apply(topology, e, class_masks[e] & ~smooth);
    class_masks[e] = (uint8_t)(mask != 0 ? mask : smooth);
  }
}
