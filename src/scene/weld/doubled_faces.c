/* doubled_faces.c - finds faces on the same points by a hash of their sides.
 *
 * Phases
 *   ends   of the edges of more than two faces
 *   list   the faces that have two of these, with a hash of their sides and
 *          group that is the same in any order: faces on the same points that
 *          have other sides differ in it
 *   mark   of those whose hashes agree, the ones that have the points of an
 *          earlier face one after the other */
#include "scene/weld/doubled_faces.h"

#include "base/hash.h"
#include "base/memory.h"
#include "base/poll.h"
#include "base/sort.h"

struct doubled_search {
  const struct scene *scene;
  const struct topology *topology;
  uint8_t *is_end; /* one a point, of edges of more than two faces */
  ARRAY(struct sort_key) face; /* hashes and faces */
};

static uint32_t point_of_side(const struct doubled_search *search,
                              uint32_t corner) {
  uint32_t point = search->scene->corner.item[corner];
  return search->topology->weld != NULL ? search->topology->weld[point] : point;
}

/* Each side of a face is a use of an edge: there are twice as many as edges,
 * less one for each border, where no edge has more than two. */
static bool has_crowded_edges(const struct scene *scene,
                              const struct topology *topology) {
  return scene->corner.count + topology->borders > 2 * topology->edge.count;
}

static void mark_ends(struct doubled_search *search) {
  const struct topology *topology = search->topology;
  for (size_t e = 0; e < topology->edge.count; e++)
    for (int k = 0; k < 2 && topology->edge.item[e].uses > 2; k++)
      search->is_end[topology->edge.item[e].point[k]] = 1;
}

static bool list_at_ends(struct doubled_search *search) {
  const struct scene *scene = search->scene;
  for (uint32_t f = 0; f < scene_face_count(scene); f++) {
    uint64_t hash = hash_add(0, scene_face_group(scene, f));
    uint32_t start = scene_face_start(scene, f),
             end = scene_face_start(scene, f + 1),
             last = point_of_side(search, end - 1);
    int ends = 0;
    if (!poll_at(f))
      return false;
    for (uint32_t c = start; c < end; c++) {
      uint32_t point = point_of_side(search, c);
      hash += hash_add(0, sort_pair_key(last, point) + 1);
      ends += search->is_end[point];
      last = point;
    }
    if (ends >= 2 && !ARRAY_PUSH(&search->face, ((struct sort_key){hash, f})))
      return false;
  }
  return true;
}

/* Whether two faces have the same points one after the other, in either
 * direction. */
static bool has_same_points(const struct doubled_search *search, uint32_t a,
                            uint32_t b) {
  const struct scene *scene = search->scene;
  uint32_t count = scene_face_corners(scene, a);
  uint32_t from = scene_face_start(scene, a), to = scene_face_start(scene, b);
  if (scene_face_corners(scene, b) != count ||
      scene_face_group(scene, a) != scene_face_group(scene, b))
    return false;
  for (uint32_t turn = 0; turn < count; turn++) {
    uint32_t forward = 0, backward = 0; /* how many corners agree */
    while (forward < count &&
           point_of_side(search, from + forward) ==
               point_of_side(search, to + (turn + forward) % count))
      forward++;
    while (backward < count &&
           point_of_side(search, from + backward) ==
               point_of_side(search, to + (turn + count - backward) % count))
      backward++;
    if (forward == count || backward == count)
      return true;
  }
  return false;
}

/* Whether a listed face has the points of one that is listed before it, with
 * the same hash, and is not itself such a one.
 * begin  the first of that hash: the only one that is looked at where all are
 *        on the same points */
static bool has_earlier(const struct doubled_search *search, size_t begin,
                        size_t i, const uint64_t *doubled) {
  const struct sort_key *face = search->face.item;
  for (size_t k = begin; k < i; k++) {
    uint32_t other = face[k].value;
    if ((doubled[other / 64] >> other % 64 & 1) == 0 &&
        has_same_points(search, other, face[i].value))
      return true;
  }
  return false;
}

static bool mark_doubled(struct doubled_search *search, uint64_t *doubled,
                         size_t *count) {
  const struct sort_key *face = search->face.item;
  if (!sort_keys_alone(search->face.item, search->face.count))
    return false;
  for (size_t i = 0, begin = 0; i < search->face.count; i++) {
    if (face[i].key != face[begin].key)
      begin = i;
    if (has_earlier(search, begin, i, doubled)) {
      doubled[face[i].value / 64] |= UINT64_C(1) << face[i].value % 64;
      ++*count;
    }
  }
  return true;
}

bool doubled_faces_find(const struct scene *scene,
                        const struct topology *topology, uint64_t **doubled,
                        size_t *count) {
  struct doubled_search search = {.scene = scene, .topology = topology};
  *doubled = NULL;
  *count = 0;
  if (!has_crowded_edges(scene, topology))
    return true;
  *doubled = mem_calloc(scene_face_count(scene) / 64 + 1, sizeof **doubled);
  search.is_end = mem_calloc(scene->point.count, 1);
  bool ok = *doubled != NULL && search.is_end != NULL;
  if (ok)
    mark_ends(&search);
  ok = ok && list_at_ends(&search) && mark_doubled(&search, *doubled, count);
  mem_free(search.is_end);
  ARRAY_FREE(&search.face);
  return ok;
}
