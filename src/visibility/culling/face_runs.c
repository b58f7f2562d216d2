/* face_runs.c - runs of consecutive faces, with a box in space around each. */
#include "visibility/culling/face_runs.h"

#include <math.h>

#include "base/poll.h"
#include "geom/vector.h"

enum {
  FACES_MIN = 16, /* of a run, unless the next face is of another group */
  FACES_MAX = 256,
  POINTS_MORE = 64 /* points of a range beside twice as many as corners */
};

struct box3 {
  double low[3], high[3];
};

static inline struct box3 box_of_point(const struct scene_point *p) {
  return (struct box3){{p->x, p->y, p->z}, {p->x, p->y, p->z}};
}

static inline void extend_box(struct box3 *box, const struct scene_point *p) {
  box->low[0] = min_number(box->low[0], p->x);
  box->low[1] = min_number(box->low[1], p->y);
  box->low[2] = min_number(box->low[2], p->z);
  box->high[0] = max_number(box->high[0], p->x);
  box->high[1] = max_number(box->high[1], p->y);
  box->high[2] = max_number(box->high[2], p->z);
}

static inline struct box3 space_of_face(const struct scene *scene,
                                        uint32_t start, uint32_t end) {
  const struct scene_point *point = scene->point.item;
  struct box3 box = box_of_point(&point[scene->corner.item[start]]);
  for (uint32_t c = start + 1; c < end; c++)
    extend_box(&box, &point[scene->corner.item[c]]);
  return box;
}

static inline double size_of(const struct box3 *box) {
  double x = box->high[0] - box->low[0], y = box->high[1] - box->low[1],
         z = box->high[2] - box->low[2];
  return max_number(x * y, max_number(y * z, z * x));
}

double face_runs_size(const struct scene *scene, uint32_t face) {
  struct box3 box = space_of_face(scene, scene_face_start(scene, face),
                                  scene_face_start(scene, face + 1));
  return size_of(&box);
}

/* Whether all faces within a box are small; it may hold points that no face
 * uses, which may be anywhere. */
static inline bool has_small_faces(const struct box3 *box, double large) {
  double sum = 0;
  for (int k = 0; k < 3; k++)
    sum += box->high[k] - box->low[k];
  return sum < INFINITY && size_of(box) < large;
}

/* ---- Ranges of points ---------------------------------------------------- */

struct point_range {
  uint32_t first, end;
};

static inline struct point_range points_of_face(const struct scene *scene,
                                                uint32_t start, uint32_t end) {
  const uint32_t *corner = scene->corner.item;
  uint32_t least = corner[start], most = least;
  for (uint32_t c = start + 1; c < end; c++) {
    least = corner[c] < least ? corner[c] : least;
    most = corner[c] > most ? corner[c] : most;
  }
  return (struct point_range){least, most + 1};
}

static inline struct point_range unite_ranges(struct point_range a,
                                              struct point_range b) {
  return (struct point_range){a.first < b.first ? a.first : b.first,
                              a.end > b.end ? a.end : b.end};
}

/* Whether an end of a range is within another one. */
static inline bool has_end_within(struct point_range a, struct point_range b) {
  return (a.first >= b.first && a.first < b.end) ||
         (a.end > b.first && a.end <= b.end);
}

/* Finds how many faces from one on are a run by the ranges of their points.
 * points  gets the range of all of these
 * Returns the first face after the run; `first`: their points are too far from
 * each other in the file. */
static uint32_t find_run(const struct scene *scene, uint32_t first,
                         struct point_range *points) {
  uint32_t faces = scene_face_count(scene), f = first,
           start = scene_face_start(scene, first), at = start;
  *points = (struct point_range){SCENE_NONE, 0};
  for (; f < faces && f - first < FACES_MAX &&
         scene_face_group(scene, f) == scene_face_group(scene, first);
       f++) {
    uint32_t end = scene_face_start(scene, f + 1);
    struct point_range own = points_of_face(scene, at, end),
                       all = unite_ranges(*points, own);
    bool is_dense = all.end - all.first <= 2 * (end - start) + POINTS_MORE;
    if (f - first < FACES_MIN ? !is_dense
                              : !is_dense || !has_end_within(own, *points))
      return f - first < FACES_MIN ? first : f;
    *points = all;
    at = end;
  }
  return f;
}

/* The box of all points of a range. */
static struct box3 space_of_points(const struct scene *scene,
                                   struct point_range points) {
  const struct scene_point *p = &scene->point.item[points.first],
                           *end = scene->point.item + points.end;
  struct box3 box = box_of_point(p);
  for (p++; p < end; p++)
    extend_box(&box, p);
  return box;
}

/* ---- Runs ---------------------------------------------------------------- */

static inline bool is_beside_run(const struct face_run *run,
                                 const struct box3 *box) {
  bool beside = false;
  for (int k = 0; k < 3; k++)
    beside |= box->low[k] > run->high[k] || box->high[k] < run->low[k];
  return beside;
}

/* Whether a run ends before a face. */
static inline bool ends_run(const struct scene *scene,
                            const struct face_run *last, uint32_t face,
                            const struct box3 *box) {
  return scene_face_group(scene, face) != scene_face_group(scene, face - 1) ||
         (face - last->first >= FACES_MIN && is_beside_run(last, box));
}

static bool begin_run(struct face_runs *runs, uint32_t face,
                      struct point_range points, const struct box3 *box) {
  struct face_run run = {.first = face,
                         .first_point = points.first,
                         .end_point = points.end,
                         .low = {box->low[0], box->low[1], box->low[2]},
                         .high = {box->high[0], box->high[1], box->high[2]}};
  return ARRAY_PUSH(&runs->run, run);
}

static inline void grow_run(struct face_run *run, struct point_range points,
                            const struct box3 *box) {
  struct point_range own = {run->first_point, run->end_point};
  own = unite_ranges(own, points);
  run->first_point = own.first;
  run->end_point = own.end;
  for (int k = 0; k < 3; k++) {
    run->low[k] = min_number(run->low[k], box->low[k]);
    run->high[k] = max_number(run->high[k], box->high[k]);
  }
}

/* Divides faces, FACES_MAX or less, into runs by the box of each. */
static bool divide_by_boxes(struct face_runs *runs, const struct scene *scene,
                            double large, uint32_t first, uint32_t end_face) {
  uint32_t start = scene_face_start(scene, first);
  bool was_large = true;
  for (uint32_t f = first; f < end_face; f++) {
    uint32_t end = scene_face_start(scene, f + 1);
    struct box3 box = space_of_face(scene, start, end);
    struct point_range points = points_of_face(scene, start, end);
    struct large_face own = {f, size_of(&box)};
    bool is_large = !(own.size < large);
    struct face_run *last = ARRAY_AT(&runs->run, runs->run.count - 1);
    start = end;
    if (is_large && !ARRAY_PUSH(&runs->large, own))
      return false;
    if (is_large || was_large || ends_run(scene, last, f, &box)) {
      if (!begin_run(runs, f, points, &box))
        return false;
    } else {
      grow_run(last, points, &box);
    }
    was_large = is_large;
  }
  return true;
}

bool face_runs_init(struct face_runs *runs, const struct scene *scene,
                    double large) {
  uint32_t faces = scene_face_count(scene), end;
  *runs = (struct face_runs){.run = {0}};
  for (uint32_t f = 0; f < faces; f = end) {
    struct point_range points;
    struct box3 box;
    end = find_run(scene, f, &points);
    bool is_run = end > f;
    if (is_run) {
      box = space_of_points(scene, points);
      is_run = has_small_faces(&box, large);
    } else {
      end = faces - f < FACES_MAX ? faces : f + FACES_MAX;
    }
    if (!poll_at(runs->run.count) ||
        !(is_run ? begin_run(runs, f, points, &box)
                 : divide_by_boxes(runs, scene, large, f, end)))
      return false;
  }
  return true;
}

void face_runs_fini(struct face_runs *runs) {
  ARRAY_FREE(&runs->run);
  ARRAY_FREE(&runs->large);
}
