/* face_runs.c - runs of consecutive faces, with a box in space around each. */
#include "visibility/culling/face_runs.h"

#include <math.h>

#include "base/poll.h"
#include "geom/vector.h"

enum {
  FACES_MIN = 16, /* of a run, unless the next face is of another group */
  FACES_MAX = 256
};

struct box3 {
  double low[3], high[3];
};

static inline struct box3 space_of_face(const struct scene *scene,
                                        uint32_t start, uint32_t end) {
  const struct scene_point *point = scene->point.item;
  const struct scene_point *p = &point[scene->corner.item[start]];
  struct box3 box = {{p->x, p->y, p->z}, {p->x, p->y, p->z}};
  for (uint32_t c = start + 1; c < end; c++) {
    p = &point[scene->corner.item[c]];
    box.low[0] = min_number(box.low[0], p->x);
    box.low[1] = min_number(box.low[1], p->y);
    box.low[2] = min_number(box.low[2], p->z);
    box.high[0] = max_number(box.high[0], p->x);
    box.high[1] = max_number(box.high[1], p->y);
    box.high[2] = max_number(box.high[2], p->z);
  }
  return box;
}

static inline double size_of(const struct box3 *box) {
  double x = box->high[0] - box->low[0], y = box->high[1] - box->low[1],
         z = box->high[2] - box->low[2];
  return max_number(x * y, max_number(y * z, z * x));
}

static inline bool is_beside_run(const struct face_run *run,
                                 const struct box3 *box) {
  bool beside = false;
  for (int k = 0; k < 3; k++)
    beside |= box->low[k] > run->high[k] || box->high[k] < run->low[k];
  return beside;
}

static inline void grow_run(struct face_run *run, const struct box3 *box) {
  for (int k = 0; k < 3; k++) {
    run->low[k] = min_number(run->low[k], box->low[k]);
    run->high[k] = max_number(run->high[k], box->high[k]);
  }
}

/* Whether a run ends before a face. */
static inline bool ends_run(const struct scene *scene,
                            const struct face_run *last, uint32_t face,
                            const struct box3 *box) {
  uint32_t faces = face - last->first;
  return faces >= FACES_MAX ||
         scene_face_group(scene, face) != scene_face_group(scene, face - 1) ||
         (faces >= FACES_MIN && is_beside_run(last, box));
}

static bool begin_run(struct face_runs *runs, uint32_t face,
                      const struct box3 *box) {
  struct face_run run = {.first = face,
                         .low = {box->low[0], box->low[1], box->low[2]},
                         .high = {box->high[0], box->high[1], box->high[2]}};
  return ARRAY_PUSH(&runs->run, run);
}

bool face_runs_init(struct face_runs *runs, const struct scene *scene,
                    double large) {
  uint32_t faces = scene_face_count(scene), start = 0;
  bool was_large = true;
  *runs = (struct face_runs){.run = {0}};
  for (uint32_t f = 0; f < faces; f++) {
    uint32_t end = scene_face_start(scene, f + 1);
    struct box3 box = space_of_face(scene, start, end);
    struct large_face own = {f, size_of(&box)};
    bool is_large = !(own.size < large);
    struct face_run *last = ARRAY_AT(&runs->run, runs->run.count - 1);
    start = end;
    if (!poll_at(f) || (is_large && !ARRAY_PUSH(&runs->large, own)))
      return false;
    if (is_large || was_large || ends_run(scene, last, f, &box)) {
      if (!begin_run(runs, f, &box))
        return false;
    } else {
      grow_run(last, &box);
    }
    was_large = is_large;
  }
  return true;
}

void face_runs_fini(struct face_runs *runs) {
  ARRAY_FREE(&runs->run);
  ARRAY_FREE(&runs->large);
}
