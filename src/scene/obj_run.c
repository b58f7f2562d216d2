/* obj_run.c - runs of plain points and faces of an OBJ file.
 *
 * Nearly all statements are like the one before them, and plain: they are read
 * without a question that only others need.  What follows a run is left to
 * reader_obj.c. */
#include "scene/obj_parser.h"

#include "base/number.h"
#include "scene/exact.h"
#include "scene/limit.h"

#if DIGITS_WINDOWS

enum {
  PLAIN_ROOM = 128, /* bytes, more than a plain statement has */
  PLAIN_RUN = 4096  /* statements that room is made for */
};

/* Is the next statement one of that letter, with room to look at? */
static inline bool is_short_statement(const struct obj_parser *p,
                                      char keyword) {
  return p->end - p->at > PLAIN_ROOM && p->at[0] == keyword && p->at[1] == ' ';
}

/* Looks at the numbers of "v x y z", which are plain. */
static void sample_point(struct obj_parser *p,
                         const struct scene_point *point) {
  const double xyz[3] = {point->x, point->y, point->z};
  const char *at = p->at + 2;
  for (int k = 0; k < 3; k++) {
    const char *start = at;
    while (*at > ' ')
      at++;
    precision_add_literal(&p->sample, start, at++, xyz[k]);
  }
}

recto_status obj_run_points(struct obj_parser *p) {
  struct scene *scene = p->scene;
  if (scene->point.count > SCENE_LIMIT - PLAIN_RUN)
    return RECTO_OK;
  if (!ARRAY_RESERVE(&scene->point, PLAIN_RUN))
    return error_memory(p->error);
  for (int i = 0; i < PLAIN_RUN && is_short_statement(p, 'v'); i++) {
    struct scene_point point;
    const char *at = number_parse_plain(p->at + 2, &point.x);
    if (at != NULL && *at == ' ')
      at = number_parse_plain(at + 1, &point.y);
    else
      break;
    if (at != NULL && *at == ' ')
      at = number_parse_plain(at + 1, &point.z);
    else
      break;
    if (at == NULL || *at != '\n')
      break;
    if (precision_is_sampled(&p->sample, p->seen))
      sample_point(p, &point);
    p->at = at + 1;
    p->line++;
    p->seen++;
    scene->point.item[scene->point.count++] = point;
  }
  return RECTO_OK;
}

/* Reads " index" or " index/other/other" of up to seven digits, of a point
 * seen so far; NULL where it is something else. */
static inline const char *read_plain_index(const struct obj_parser *p,
                                           const char *at, uint32_t *point) {
  uint64_t window;
  if (*at != ' ')
    return NULL;
  int count = digits_count(++at, &window);
  if (count == 0 || count == 8)
    return NULL;
  uint64_t index = digits_sum(window, count) - 1;
  if (index >= p->seen)
    return NULL;
  *point = (uint32_t)(p->first + index);
  return at[count] == '/' ? obj_skip_other_indices(at + count) : at + count;
}

/* Reads "f a b c" to its end; NULL where it is something else, or where a
 * closer look is needed. */
static inline const char *read_plain_face(const struct obj_parser *p,
                                          uint32_t corner[3]) {
  const char *at = p->at + 1;
  for (int k = 0; k < 3; k++) {
    at = read_plain_index(p, at, &corner[k]);
    if (at == NULL || at - p->at > PLAIN_ROOM / 2)
      return NULL;
  }
  const struct scene_point *point = p->scene->point.item;
  const struct scene_point *a = &point[corner[0]], *b = &point[corner[1]],
                           *c = &point[corner[2]];
  bool bent = exact_surely_turns(a->x, a->y, b->x, b->y, c->x, c->y) ||
              exact_surely_turns(a->y, a->z, b->y, b->z, c->y, c->z);
  return bent && *at == '\n' ? at + 1 : NULL;
}

recto_status obj_run_faces(struct obj_parser *p) {
  struct scene *scene = p->scene;
  if (p->bad.count || p->renamed || scene->face_start.count == 0)
    return RECTO_OK;
  if (scene->corner.count > SCENE_LIMIT - 3 * PLAIN_RUN)
    return RECTO_OK;
  if (!ARRAY_RESERVE(&scene->corner, 3 * PLAIN_RUN) ||
      !ARRAY_RESERVE(&scene->face_start, PLAIN_RUN) ||
      !ARRAY_RESERVE(&scene->face_group, PLAIN_RUN))
    return error_memory(p->error);
  for (int i = 0; i < PLAIN_RUN && is_short_statement(p, 'f'); i++) {
    uint32_t *corner = scene->corner.item + scene->corner.count;
    const char *past = read_plain_face(p, corner);
    if (past == NULL)
      break;
    p->at = past;
    p->line++;
    scene->corner.count += 3;
    scene->face_start.item[scene->face_start.count++] =
        (uint32_t)scene->corner.count;
    scene->face_group.item[scene->face_group.count++] = scene->current_group;
  }
  return RECTO_OK;
}

#else

recto_status obj_run_points(struct obj_parser *p) {
  (void)p;
  return RECTO_OK;
}

recto_status obj_run_faces(struct obj_parser *p) {
  (void)p;
  return RECTO_OK;
}

#endif
