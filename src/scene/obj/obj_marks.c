/* obj_marks.c - what an OBJ file says of hard and smooth edges: normals and
 * smoothing groups.
 *
 * Normals are counted like points: an index may name one that comes later, and
 * then all are read ahead.  A face whose normal is not there is a face without
 * normals, and no more is wrong with it. */
#include "scene/obj/obj_plain.h"

#include <string.h>

#include "scene/corner_normals.h"
#include "scene/diagnostics.h"

/* ---- vn ------------------------------------------------------------------ */

#if DIGITS_CHUNKS
static bool reserve_normals(struct obj_parser *p, size_t count) {
  return ARRAY_RESERVE(&p->normal, count);
}

/* Reads "vn x y z" for as long as the numbers are finite. */
static bool read_plain_normals(const struct obj_parser *p,
                               struct obj_run *run) {
  uint32_t *normal = p->normal.item + p->normal.count + run->before;
  for (; obj_has_room(run) && memcmp(run->at, "vn ", 3) == 0; run->count++) {
    double xyz[3];
    const char *past = obj_read_three_numbers(run, run->at + 2, xyz);
    if (past == NULL)
      break;
    normal[run->count] = corner_normal_encode(xyz[0], xyz[1], xyz[2]);
    run->at = past;
  }
  return true;
}

static bool add_plain_normals(struct obj_parser *p, const struct obj_run *run) {
  p->normal.count += run->count;
  p->normals_seen += run->count;
  return true;
}

const struct obj_run_kind obj_plain_normals = {
    reserve_normals, read_plain_normals, add_plain_normals};
#endif

recto_status obj_read_normal(struct obj_parser *p) {
  const char *start = p->at;
  unsigned long line = p->line;
  double xyz[3] = {0, 0, 0};
  uint32_t normal = 0;
  p->known = true;
  p->normals_seen++;
  if (p->ahead) {
    obj_skip_line(p, true);
    return RECTO_OK;
  }
  p->at += 2;
  for (int k = 0; k < 3; k++) {
    obj_skip_blanks(p);
    const char *stop = number_parse_double(p->at, p->end, &xyz[k]);
    if (stop == NULL || !obj_ends_word(*stop)) {
      recto_status status = obj_skip_broken(p, start, line, "normal");
      return status == RECTO_OK && !ARRAY_PUSH(&p->normal, 0)
                 ? error_memory(p->error)
                 : status;
    }
    p->at = stop;
  }
  obj_finish_statement(p);
  if (isfinite(xyz[0]) && isfinite(xyz[1]) && isfinite(xyz[2]))
    normal = corner_normal_encode(xyz[0], xyz[1], xyz[2]);
  else
    diagnostics_fault(p->diagnostics, SCENE_FAULT_NOT_FINITE, line,
                      "normal that is not finite, taken as none");
  return ARRAY_PUSH(&p->normal, normal) ? obj_run_normals(p)
                                        : error_memory(p->error);
}

/* ---- s ------------------------------------------------------------------- */

bool obj_parse_smoothing(const char *at, const char *stop, uint32_t *group) {
  uint64_t number = 0;
  size_t length = (size_t)(stop - at);
  bool is_off = length == 3 && memcmp(at, "off", length) == 0;
  if (is_off || (length == 2 && memcmp(at, "on", length) == 0)) {
    *group = is_off ? SMOOTHING_OFF : SMOOTHING_GROUPS;
    return true;
  }
  if (length == 0 || length > OBJ_DIGITS_MAX ||
      digits_gather(at, stop, &number) != stop ||
      number > UINT32_MAX - SMOOTHING_GROUPS)
    return false;
  *group =
      number == 0 ? SMOOTHING_OFF : (uint32_t)(number - 1) + SMOOTHING_GROUPS;
  return true;
}

recto_status obj_read_smoothing(struct obj_parser *p) {
  const char *start = p->at;
  unsigned long line = p->line;
  uint32_t group;
  p->known = true;
  p->run_bytes = 0; /* what follows is another run */
  p->at++;
  obj_skip_blanks(p);
  const char *word = p->at;
  while (p->at < p->end && !obj_ends_word(*p->at))
    p->at++;
  bool is_read = obj_parse_smoothing(word, p->at, &group);
  obj_skip_blanks(p);
  if (!is_read || !obj_is_at_end_of_line(p))
    return obj_skip_broken(p, start, line, "smoothing group");
  obj_finish_statement(p);
  return smoothing_set_in_file(&p->scene->smoothing, p->scene->face_count,
                               group)
             ? RECTO_OK
             : error_memory(p->error);
}

/* ---- The normals of a face ----------------------------------------------- */

bool obj_set_corner_normal(struct obj_parser *p, uint32_t normal) {
  size_t corner = p->corner.count;
  if (p->corner_normal.count > corner)
    p->corner_normal.count = corner;
  while (p->corner_normal.count < corner)
    if (!ARRAY_PUSH(&p->corner_normal, 0))
      return false;
  return ARRAY_PUSH(&p->corner_normal, normal);
}

recto_status obj_take_normal(struct obj_parser *p, const char *at) {
  const char *start = at;
  uint64_t index = 0;
  bool is_relative = *at == '-';
  if (*at == '-' || *at == '+')
    at++;
  const char *stop = digits_gather(at, p->end, &index);
  bool is_short = stop > at && stop - at <= OBJ_DIGITS_MAX;
  recto_status status = RECTO_OK;
  if (stop == start)
    return RECTO_OK; /* there is no index */
  if (is_short && !is_relative && index > p->normal.count && !p->ahead)
    status = obj_read_ahead(p);
  if (status != RECTO_OK)
    return status;
  if (is_relative)
    index = p->normals_seen + 1 - index; /* wraps around to one too large */
  if (is_short && index - 1 < p->normal.count)
    return obj_set_corner_normal(p, p->normal.item[index - 1])
               ? RECTO_OK
               : error_memory(p->error);
  if (p->missing_normal == NULL)
    p->missing_normal = start;
  return RECTO_OK;
}

/* The normals of the corners of the face that was read last; NULL: none, or not
 * of all of them. */
static const uint32_t *normals_of_face(struct obj_parser *p,
                                       unsigned long line) {
  if (p->missing_normal != NULL) {
    enum { SHOWN = 24 };
    int length = 0;
    while (!obj_ends_word(p->missing_normal[length]) && length < SHOWN)
      length++;
    diagnostics_fault(p->diagnostics, SCENE_FAULT_INDEX, line,
                      "face with normal %.*s where there are %zu, drawn "
                      "without normals",
                      length, p->missing_normal, p->normal.count);
    return NULL;
  }
  if (p->corner_normal.count != p->corner.count)
    return NULL;
  for (size_t c = 0; c < p->corner.count; c++)
    if (p->corner_normal.item[c] == 0)
      return NULL;
  return p->corner_normal.item;
}

recto_status obj_add_face(struct obj_parser *p, unsigned long line) {
  struct scene *scene = p->scene;
  uint32_t faces = scene->face_count;
  size_t first = scene->corner.count;
  recto_status status = scene_add_face(scene, p->corner.item, p->corner.count,
                                       line, p->diagnostics, p->error);
  if (status != RECTO_OK || !scene->needs_crease_marks ||
      scene->face_count == faces)
    return status;
  const uint32_t *normal = normals_of_face(p, line);
  /* Some of a face's corners may be left out. */
  if (scene->corner.count - first != p->corner.count)
    normal = NULL;
  return corner_normals_add(scene, first, normal) ? RECTO_OK
                                                  : error_memory(p->error);
}
