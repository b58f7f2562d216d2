/* repeated_part.c - finds faces that the next ones repeat with other points.
 *
 * A face that has only points higher than those of all faces before it in the
 * search is a *start*.  Where parts follow each other in a file, each begins
 * with one; so a part is sought that ends before one of the next starts. */
#include "scene/topology/repeated_part.h"

#include <string.h>

/* Numbers are compared by lanes, and so many before it is asked whether all of
 * them agree. */
enum { LANES = 4, BLOCK = 64 };
typedef uint32_t number_lanes __attribute__((vector_size(16)));

static inline number_lanes number_lanes_of(const uint32_t *number) {
  number_lanes lanes;
  memcpy(&lanes, number, sizeof lanes);
  return lanes;
}

/* How far is searched, at first for a start, and how many starts are tried. */
enum { SIDES_TO_START = 1 << 12, SIDES_MAX = 1 << 14, STARTS_MAX = 16 };

/* Parts with fewer corners are taken several at once. */
enum { CORNERS_MIN = 32 };

/* A part is not taken for one where so many times as many points as corners lie
 * between its lowest and its highest. */
enum { POINTS_PER_CORNER_MAX = 2 };

struct point_span {
  uint32_t low, high;
};

static inline struct point_span span_of_corners(const uint32_t *corner,
                                                uint32_t count) {
  struct point_span span = {corner[0], corner[0]};
  for (uint32_t i = 1; i < count; i++) {
    span.low = corner[i] < span.low ? corner[i] : span.low;
    span.high = corner[i] > span.high ? corner[i] : span.high;
  }
  return span;
}

static bool are_free(const uint32_t *free, const uint32_t *corner,
                     uint32_t count) {
  bool all = true;
  for (uint32_t i = 0; free != NULL && i < count; i++)
    all &= free[corner[i]] == SCENE_NONE;
  return all;
}

/* Ends the part before a face; returns whether it is repeated from there on. */
static bool is_repeated_at(struct repeated_part *part,
                           const struct scene *scene, struct point_span points,
                           uint32_t face, uint32_t end_face) {
  uint32_t shift;
  part->faces = face - part->face;
  part->corners = scene_face_start(scene, face) - part->corner;
  part->point = points.low;
  part->points = points.high - points.low + 1;
  return part->corners >= CORNERS_MIN &&
         part->points / POINTS_PER_CORNER_MAX <= part->corners &&
         repeated_part_is_at(part, scene, face, end_face, &shift);
}

bool repeated_part_find(struct repeated_part *part, const struct scene *scene,
                        const uint32_t *free, uint32_t face,
                        uint32_t end_face) {
  uint32_t start = scene_face_start(scene, face), first = start, starts = 0;
  struct point_span all = {SCENE_NONE, 0};
  for (uint32_t f = face;
       f < end_face && starts <= STARTS_MAX &&
       start - first < (starts > 0 ? SIDES_MAX : SIDES_TO_START);
       f++) {
    const uint32_t *corner = scene->corner.item + start;
    uint32_t count = scene_face_corners(scene, f);
    struct point_span own = span_of_corners(corner, count);
    bool is_start = f == face ? free != NULL : own.low > all.high;
    if (is_start && starts > 0 && is_repeated_at(part, scene, all, f, end_face))
      return true;
    if (is_start && starts == 0 && are_free(free, corner, count)) {
      *part = (struct repeated_part){.face = f, .corner = start};
      all.low = own.low;
      starts = 1;
    } else {
      starts += is_start && starts > 0;
      all.low = own.low < all.low ? own.low : all.low;
    }
    all.high = own.high > all.high ? own.high : all.high;
    start += count;
  }
  return false;
}

/* Whether all numbers are larger by `by`, modulo 2^32. */
static bool are_shifted(const uint32_t *number, const uint32_t *from,
                        uint32_t count, uint32_t by) {
  const number_lanes shift = {by, by, by, by};
  uint32_t i = 0, differ = 0;
  while (count - i >= LANES && differ == 0) {
    number_lanes all = {0};
    for (uint32_t end = i + BLOCK; i < end && count - i >= LANES; i += LANES)
      all |= (number_lanes_of(number + i) - number_lanes_of(from + i)) ^ shift;
    differ = all[0] | all[1] | all[2] | all[3];
  }
  for (; i < count; i++)
    differ |= (number[i] - from[i]) ^ by;
  return differ == 0;
}

/* Whether as many faces have as many corners each. */
static bool has_same_starts(const struct repeated_part *part,
                            const struct scene *scene, uint32_t face) {
  const uint32_t *start = scene->face_start.item;
  return scene->face_start.count == 0 ||
         are_shifted(start + face + 1, start + part->face + 1, part->faces,
                     start[face] - part->corner);
}

bool repeated_part_is_at(const struct repeated_part *part,
                         const struct scene *scene, uint32_t face,
                         uint32_t end_face, uint32_t *shift) {
  if (end_face - face < part->faces || !has_same_starts(part, scene, face))
    return false;
  const uint32_t *corner = scene->corner.item + scene_face_start(scene, face),
                 *own = scene->corner.item + part->corner;
  *shift = corner[0] - own[0];
  return *shift >= part->points &&
         are_shifted(corner, own, part->corners, *shift);
}

bool repeated_parts_fill(const struct scene *scene, int samples) {
  enum { COPIES = 16 };
  uint64_t faces = scene_face_count(scene), ranges = (uint64_t)samples;
  bool repeated = true;
  for (uint64_t r = 0; repeated && r < ranges; r++) {
    struct repeated_part part;
    uint32_t shift, first = (uint32_t)(faces * (2 * r + 1) / (2 * ranges));
    repeated = repeated_part_find(&part, scene, NULL, first, (uint32_t)faces) &&
               part.faces <= (faces - part.face) / COPIES;
    for (uint32_t i = 2; repeated && i < COPIES; i++)
      repeated = repeated_part_is_at(&part, scene, part.face + i * part.faces,
                                     (uint32_t)faces, &shift);
  }
  return repeated;
}
