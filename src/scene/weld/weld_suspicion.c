/* weld_suspicion.c - decides whether the borders of a scene look like edges
 * whose corners were moved apart. */
#include <math.h>

#include "base/hash.h"
#include "base/tolerance.h"
#include "geom/vector.h"
#include "scene/weld/isolated_members.h"
#include "scene/weld/weld_candidates.h"
#include "scene/weld/weld_near.h"

/* The length that is the share of a face of this squared size. */
static double gap_length(double size) {
  return TOLERANCE_GAP_SHARE * sqrt(size);
}

/* Of the faces that have a border; the edges of a face follow one another. */
static double largest_face_size(const struct scene *scene,
                                const struct topology *topology) {
  uint32_t face = SCENE_NONE;
  double size = 0;
  for (uint32_t e = topology_next_border(topology, 0); e < topology->edge.count;
       e = topology_next_border(topology, e + 1)) {
    if (topology->edge.item[e].first == face)
      continue;
    face = topology->edge.item[e].first;
    size = max_number(size, weld_face_size(scene, face));
  }
  return size;
}

/* Adds the block that a coordinate is in to a hash: the nearest whole number of
 * sides, which the sum is rounded to; far away, a multiple of a power of
 * two. */
static inline uint64_t hash_add_block(uint64_t hash, double coordinate,
                                      double per_side) {
  const double rounds_to_whole = 0x1.8p52;
  return hash_add_double(hash, coordinate * per_side + rounds_to_whole);
}

/* Whether a point lies in a block of space that is in the sample, as those are
 * whose hash is below a limit.
 * per_side  1 / the side of the blocks */
static inline bool is_in_sample(const struct scene_point *p, double per_side,
                                uint64_t limit) {
  uint64_t hash = hash_add_block(0, p->x, per_side);
  hash = hash_add_block(hash, p->y, per_side);
  hash = hash_add_block(hash, p->z, per_side);
  return hash * HASH_GOLDEN < limit;
}

/* Lists as candidates a sample of the points: those of some blocks of space, so
 * that each is listed with all its neighbours but for those beyond the sides of
 * its block.  Lists all where there are few, or few in these blocks.
 * length  a radius of each, or a longer one
 * Returns false when memory ran out. */
static bool list_sample(struct weld_candidates *candidates,
                        const struct scene *scene, double length,
                        const uint32_t *point, size_t count) {
  enum { SAMPLE = 1 << 13, SAMPLE_MIN = SAMPLE / 8, RADII = 64 };
  size_t one_in = count / SAMPLE;
  double per_side = 1 / (RADII * length);
  ARRAY(uint32_t) kept = {.item = NULL};
  bool ok = true;
  for (size_t i = 0; ok && one_in >= 2 && i < count; i++)
    if (is_in_sample(&scene->point.item[point[i]], per_side,
                     UINT64_MAX / one_in))
      ok = ARRAY_PUSH(&kept, point[i]);
  bool is_sample = kept.count >= SAMPLE_MIN;
  ok = ok && weld_candidates_set(candidates, is_sample ? kept.item : point,
                                 is_sample ? kept.count : count);
  ARRAY_FREE(&kept);
  return ok;
}

/* Lists points of borders, their radii unknown.  Returns false when memory ran
 * out.
 * *length  gets a radius of each, or a longer one; where it is too short to
 *          join anything, none are listed */
static bool list_sampled_borders(struct weld_candidates *candidates,
                                 const struct scene *scene,
                                 const struct topology *topology,
                                 double *length) {
  uint32_t *point;
  size_t count;
  *length = gap_length(largest_face_size(scene, topology));
  if (*length < WELD_LENGTH_LEAST)
    return true;
  bool ok =
      topology_border_points(topology, scene->point.count, &point, &count) &&
      list_sample(candidates, scene, *length, point, count);
  mem_free(point);
  return ok;
}

static void set_radii(struct weld_candidates *candidates, double length) {
  for (size_t i = 0; i < candidates->member.count; i++) {
    struct cluster_member *member = &candidates->member.item[i];
    double size = candidates->size[candidates->number[member->point] - 1];
    weld_candidate_set_radius(member, length, gap_length(size));
  }
}

/* Joins members; returns how many another one represents, SIZE_MAX when memory
 * ran out. */
static size_t join_candidates(struct weld_candidates *candidates,
                              const struct scene *scene, double length) {
  enum { LENGTHS = 4 }; /* a sixteenth of a face */
  struct cluster_member *member = candidates->member.item;
  return isolated_members_drop(scene, length, LENGTHS, member,
                               &candidates->member.count)
             ? cluster_join(scene, length, member, candidates->member.count)
             : SIZE_MAX;
}

bool welded_is_suspicious(const struct welded *welded,
                          const struct topology *topology) {
  enum { FEWEST_FACES = 100, TENTHS_OF_EDGES = 3, ONE_POINT_IN = 4 };
  const struct scene *scene = &welded->scene;
  struct weld_candidates candidates = {.number = NULL};
  double length;
  size_t joined = 0;
  if (scene_face_count(scene) < FEWEST_FACES ||
      10 * welded->borders <= TENTHS_OF_EDGES * topology->edge.count)
    return false;
  bool ok = list_sampled_borders(&candidates, scene, topology, &length);
  size_t count = candidates.member.count;
  if (ok && count > 0 && weld_candidates_number(&candidates, scene) &&
      weld_candidates_measure(&candidates, scene, topology)) {
    set_radii(&candidates, length);
    joined = join_candidates(&candidates, scene, length);
  }
  weld_candidates_fini(&candidates);
  return joined != SIZE_MAX && joined > 0 && ONE_POINT_IN * joined >= count;
}
