/* smoothing.c - stores the smoothing groups of faces, as ranges of faces that
 * follow one another. */
#include "scene/smoothing.h"

#include "base/sort.h"

static uint32_t last_group(const struct smoothing_groups *smoothing) {
  return smoothing->range.count > 0
             ? smoothing->range.item[smoothing->range.count - 1].group
             : SMOOTHING_UNKNOWN;
}

bool smoothing_set(struct smoothing_groups *smoothing, uint32_t face,
                   uint32_t group) {
  size_t count = smoothing->range.count;
  const struct smoothing_range range = {face, group};
  if (group == last_group(smoothing))
    return true;
  if (count > 0 && smoothing->range.item[count - 1].first_face == face) {
    smoothing->range.item[count - 1] = range;
    return true;
  }
  /* One more, so that the last one can be ended. */
  if (!ARRAY_RESERVE(&smoothing->range, 2))
    return false;
  smoothing->range.item[smoothing->range.count++] = range;
  return true;
}

bool smoothing_set_in_file(struct smoothing_groups *smoothing, uint32_t face,
                           uint32_t group) {
  uint32_t first = smoothing->first_file_face, last = last_group(smoothing);
  bool has_faces = face > first || smoothing->has_dropped_faces;
  smoothing->has_several =
      smoothing->has_several ||
      (group != last && (last != SMOOTHING_UNKNOWN || has_faces));
  return (last != SMOOTHING_UNKNOWN || face == first ||
          smoothing_set(smoothing, first, SMOOTHING_OFF)) &&
         smoothing_set(smoothing, face, group);
}

/* Ends the last range before a face; there is room for that. */
static void end_last(struct smoothing_groups *smoothing, uint32_t face) {
  const struct smoothing_range unknown = {face, SMOOTHING_UNKNOWN};
  if (last_group(smoothing) != SMOOTHING_UNKNOWN)
    smoothing->range.item[smoothing->range.count++] = unknown;
}

void smoothing_begin_file(struct smoothing_groups *smoothing, uint32_t face) {
  smoothing->first_file_face = face;
  end_last(smoothing, face);
}

void smoothing_restore(struct smoothing_groups *smoothing, uint32_t face) {
  const struct smoothing_range *range = smoothing->range.item;
  size_t *count = &smoothing->range.count;
  while (*count > 0 && range[*count - 1].first_face >= face)
    --*count;
  end_last(smoothing, face);
}

void smoothing_drop_faces(struct smoothing_groups *smoothing, uint32_t faces) {
  const struct smoothing_range all = {0, last_group(smoothing)};
  smoothing->has_dropped_faces = smoothing->has_dropped_faces || faces > 0;
  if (smoothing->range.count > 0)
    smoothing->range.item[0] = all;
  smoothing->range.count = all.group != SMOOTHING_UNKNOWN;
}

bool smoothing_has_several(const struct smoothing_groups *smoothing) {
  const struct smoothing_range *range = smoothing->range.item;
  uint32_t known = SMOOTHING_UNKNOWN;
  for (size_t i = 0; i < smoothing->range.count; i++) {
    if (range[i].group == SMOOTHING_UNKNOWN)
      continue;
    if (known != SMOOTHING_UNKNOWN && range[i].group != known)
      return true;
    known = range[i].group;
  }
  return false;
}

uint32_t smoothing_of_face(const struct smoothing_groups *smoothing,
                           uint32_t face) {
  const struct smoothing_range *range = smoothing->range.item;
  size_t past;
  LOWER_BOUND(past, 0, smoothing->range.count, range[past].first_face <= face);
  return past > 0 ? range[past - 1].group : SMOOTHING_UNKNOWN;
}
