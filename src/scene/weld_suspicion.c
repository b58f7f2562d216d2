/* weld_suspicion.c - decides whether the borders of a scene look like edges
 * whose corners were moved apart. */
#include <math.h>

#include "base/hash.h"
#include "base/tolerance.h"
#include "scene/isolated_members.h"
#include "scene/weld_candidates.h"
#include "scene/weld_near.h"

/* Whether the member lies in a block of space that is in the sample: one block
 * in `one_in` is.
 * side  of the blocks */
static bool is_in_sample(const struct scene *scene,
                         const struct cluster_member *member, double side,
                         size_t one_in) {
  const struct scene_point *p = &scene->point.item[member->point];
  uint64_t hash = hash_add_double(0, floor(p->x / side));
  hash = hash_add_double(hash, floor(p->y / side));
  hash = hash_add_double(hash, floor(p->z / side));
  return hash % one_in == 0;
}

/* Keeps a sample of the members: those of some blocks of space, so that each is
 * kept with all its neighbours but for those beyond the sides of its block.
 * Keeps all where there are few, or few in these blocks.
 * length  the longest radius
 * Returns false when memory ran out. */
static bool keep_sample(struct weld_candidates *candidates,
                        const struct scene *scene, double length) {
  enum { SAMPLE = 1 << 15, SAMPLE_MIN = SAMPLE / 8, RADII = 64 };
  size_t count = candidates->member.count, one_in = count / SAMPLE;
  cluster_members kept = {.item = NULL};
  if (one_in < 2)
    return true;
  for (size_t i = 0; i < count; i++)
    if (is_in_sample(scene, &candidates->member.item[i], RADII * length,
                     one_in) &&
        !ARRAY_PUSH(&kept, candidates->member.item[i])) {
      ARRAY_FREE(&kept);
      return false;
    }
  if (kept.count < SAMPLE_MIN) {
    ARRAY_FREE(&kept);
    return true;
  }
  ARRAY_FREE(&candidates->member);
  candidates->member = kept;
  return true;
}

/* The length that is the share of a face of this squared size. */
static double gap_length(double size) {
  return TOLERANCE_GAP_SHARE * sqrt(size);
}

static double largest_size(const struct weld_candidates *candidates) {
  double size = 0;
  for (size_t i = 0; i < candidates->member.count; i++)
    size = fmax(size, candidates->size[i]);
  return size;
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
  size_t joined = 0, count = 0;
  if (scene_face_count(scene) < FEWEST_FACES ||
      10 * welded->borders <= TENTHS_OF_EDGES * topology->edge.count)
    return false;
  if (weld_candidates_list(&candidates, scene, topology) &&
      weld_candidates_number(&candidates, scene) &&
      weld_candidates_measure(&candidates, scene, topology)) {
    double length = gap_length(largest_size(&candidates));
    if (length >= WELD_LENGTH_LEAST &&
        keep_sample(&candidates, scene, length)) {
      set_radii(&candidates, length);
      count = candidates.member.count;
      joined = join_candidates(&candidates, scene, length);
    }
  }
  weld_candidates_fini(&candidates);
  return joined != SIZE_MAX && joined > 0 && ONE_POINT_IN * joined >= count;
}
