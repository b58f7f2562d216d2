/* obj_triangles.c - triangles of an OBJ file that are passed over: their points
 * are marked, and their corners held, so that they are not parsed again. */
#include "scene/obj/obj_parser.h"

#include <string.h>

#include "base/poll.h"

/* ---- Marks --------------------------------------------------------------- */

/* Makes room for a mark of each point so far. */
static bool have_marks(struct obj_parser *p) {
  size_t count = p->mark.count, points = p->scene->point.count;
  if (count == points)
    return true;
  if (!ARRAY_RESERVE(&p->mark, points - count))
    return false;
  memset(p->mark.item + count, 0, points - count);
  p->mark.count = points;
  return true;
}

#if DIGITS_CHUNKS
enum { HELD_MAX = 1 << 23 }; /* corners */

/* Makes room for the corners that so many bytes may have; where there is none,
 * no more are held. */
static void have_room_to_hold(struct obj_parser *p, size_t bytes) {
  enum { LEAST_BYTES = 8 }; /* of a triangle */
  size_t most = 3 * (bytes / LEAST_BYTES + 1);
  p->holds =
      p->holds && p->held.count < HELD_MAX && ARRAY_RESERVE(&p->held, most);
}

/* Reads "f a b c" to its end, indices of up to seven digits; NULL where it is
 * something else, or has a point that is not there yet.  Eight bytes beyond the
 * end may be read. */
static inline const char *parse_plain_triangle(const char *at, size_t points,
                                               uint64_t index[3]) {
  at++;
  for (int k = 0; k < 3; k++) {
    if (*at != ' ')
      return NULL;
    at = digits_read_few(at + 1, &index[k]);
    if (at == NULL)
      return NULL;
    index[k]--;
  }
  return *at == '\n' && index[0] < points && index[1] < points &&
                 index[2] < points
             ? at + 1
             : NULL;
}

/* Marks the points of triangles, and holds these, for as long as they are
 * plain. */
static void mark_plain_triangles(struct obj_parser *p) {
  uint8_t *mark = p->mark.item;
  size_t points = p->mark.count;
  uint32_t first = (uint32_t)p->first;
  const char *at = p->at;
  uint64_t index[3];
  have_room_to_hold(p, (size_t)(p->end - p->at));
  uint32_t *held = ARRAY_AT(&p->held, p->held.count);
  while (at < p->end && *at == 'f') {
    const char *past = parse_plain_triangle(at, points, index);
    if (past == NULL)
      break;
    for (int k = 0; k < 3; k++) {
      mark[index[k]] = 1;
      if (p->holds)
        *held++ = first + (uint32_t)index[k];
    }
    at = past;
    p->line++;
  }
  p->plain_bytes += (size_t)(at - p->at);
  p->at = at;
  if (p->holds && held != NULL)
    p->held.count = (size_t)(held - p->held.item);
}
#else
static void mark_plain_triangles(struct obj_parser *p) { (void)p; }
#endif

/* Marks the points of any face. */
static void mark_face(struct obj_parser *p) {
  const char *at = p->at + 1;
  while (*at == ' ' && !p->mark_failed) {
    uint64_t index = 0;
    const char *stop = digits_gather(++at, p->end, &index);
    if (stop == at && *at >= '!') /* it is relative, or no number at all */
      p->mark_failed = true;
    if (stop == at)
      continue;
    if (index - 1 < p->mark.count)
      p->mark.item[index - 1] = 1;
    else
      p->mark_failed = true;
    at = *stop == '/' ? obj_skip_other_indices(stop) : stop;
  }
  p->at = at;
  obj_skip_line(p, true);
}

void obj_mark_faces(struct obj_parser *p) {
  p->others = true;
  p->mark_failed = p->mark_failed || !have_marks(p);
  if (p->mark_failed)
    return;
  do { /* what comes first may be a polyline */
    const char *start = p->at;
    mark_plain_triangles(p);
    if (p->at == start)
      mark_face(p);
  } while (p->at < p->end && p->at[0] == 'f' && p->at[1] == ' ' &&
           !p->mark_failed);
}

/* ---- What was held ------------------------------------------------------- */

recto_status obj_add_triangles(struct obj_parser *p, const uint32_t *corner,
                               size_t count) {
  struct scene *scene = p->scene;
  const struct scene_point *point = scene->point.item;
  if (!scene_reserve_faces(scene, count, 3 * count))
    return error_memory(p->error);
  for (size_t f = 0; f < count; f++, p->line++) {
    const uint32_t *own = corner + 3 * f;
    for (int k = 0; k < 3 && f + MEM_PREFETCH_AHEAD < count; k++)
      MEM_PREFETCH(&point[own[3 * MEM_PREFETCH_AHEAD + k]]);
    if (!poll_at(f))
      return error_cancelled(p->error);
    if (p->bad.count > 0 || p->renamed || scene->face_count == 0 ||
        !obj_is_surely_bent(scene, own)) {
      recto_status status = obj_add_triangle(p, own);
      if (status != RECTO_OK)
        return status;
      continue;
    }
    memcpy(scene->corner.item + scene->corner.count, own, 3 * sizeof *own);
    scene->corner.count += 3;
    if (!scene_end_face(scene, scene->current_group))
      return error_memory(p->error);
  }
  return RECTO_OK;
}
