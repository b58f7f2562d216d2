/* face_rewrite.c - copies faces, leaving some out, and giving others more
 * corners. */
#include "scene/weld/face_rewrite.h"

#include <string.h>

#include "base/poll.h"
#include "scene/corner_normals.h"

void face_rewrite_begin(struct scene *copy) {
  copy->face_count = 0;
  memset(&copy->corner, 0, sizeof copy->corner);
  memset(&copy->face_start, 0, sizeof copy->face_start);
  memset(&copy->face_group, 0, sizeof copy->face_group);
  memset(&copy->face_skipped, 0, sizeof copy->face_skipped);
  memset(&copy->corner_normal, 0, sizeof copy->corner_normal);
  memset(&copy->smoothing, 0, sizeof copy->smoothing);
}

void face_rewrite_fini(struct scene *copy) {
  ARRAY_FREE(&copy->corner);
  ARRAY_FREE(&copy->face_start);
  ARRAY_FREE(&copy->face_group);
  ARRAY_FREE(&copy->face_skipped);
  ARRAY_FREE(&copy->corner_normal);
  ARRAY_FREE(&copy->smoothing.range);
}

bool face_rewrite_smoothing(struct scene *to, const struct scene *from,
                            uint32_t face) {
  return from->smoothing.range.count == 0 ||
         smoothing_set(&to->smoothing, to->face_count,
                       smoothing_of_face(&from->smoothing, face));
}

bool face_rewrite_normals(struct scene *to, size_t first,
                          const struct scene *from, uint32_t face) {
  return from->point_normal.count == 0 ||
         corner_normals_copy(to, first, from, face);
}

/* What is copied, and how far it is. */
struct face_copy {
  struct scene *to;
  const struct scene *from;
  const uint64_t *thin;
  const struct slit_point *point, *end_point; /* on sides not yet copied */
  size_t skipped;                             /* of those that `from` skipped */
};

/* There is room for all corners. */
static bool copy_face(struct face_copy *copy, uint32_t face) {
  struct scene *to = copy->to;
  const struct scene *from = copy->from;
  size_t first = to->corner.count;
  to->current_group = scene_face_group(from, face);
  if (!face_rewrite_smoothing(to, from, face))
    return false;
  for (uint32_t c = scene_face_start(from, face);
       c < scene_face_start(from, face + 1); c++) {
    to->corner.item[to->corner.count++] = from->corner.item[c];
    for (; copy->point < copy->end_point && copy->point->corner == c;
         copy->point++)
      to->corner.item[to->corner.count++] = copy->point->point;
  }
  return scene_end_face(to, to->current_group) &&
         face_rewrite_normals(to, first, from, face);
}

/* Skips what `from` skipped before a face. */
static recto_status copy_skipped(struct face_copy *copy, uint32_t face,
                                 recto_error *error) {
  recto_status status = RECTO_OK;
  for (; status == RECTO_OK && copy->skipped < copy->from->face_skipped.count &&
         copy->from->face_skipped.item[copy->skipped] == face;
       copy->skipped++)
    status = scene_skip_face(copy->to, error);
  return status;
}

recto_status face_rewrite(struct scene *to, const struct scene *from,
                          const uint64_t *thin, const slit_points *points,
                          recto_error *error) {
  size_t more = points != NULL ? points->count : 0;
  struct face_copy copy = {.to = to, .from = from, .thin = thin};
  if (more > 0) {
    copy.point = points->item;
    copy.end_point = points->item + more;
  }
  recto_status status = RECTO_OK;
  if (!ARRAY_RESERVE(&to->corner, from->corner.count + more))
    return error_memory(error);
  for (uint32_t f = 0; f < from->face_count && status == RECTO_OK; f++) {
    if (!poll_at(f))
      return error_cancelled(error);
    status = copy_skipped(&copy, f, error);
    if (status == RECTO_OK && thin != NULL && (thin[f / 64] >> f % 64 & 1) != 0)
      status = scene_skip_face(to, error);
    else if (status == RECTO_OK && !copy_face(&copy, f))
      status = error_memory(error);
  }
  to->current_group = from->current_group;
  return status;
}
