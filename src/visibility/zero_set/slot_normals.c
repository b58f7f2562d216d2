/* slot_normals.c - adds to each normal what the faces about it share in. */
#include "visibility/zero_set/facing.h"

#include <float.h>
#include <math.h>

#include "base/parallel.h"

static double angle_between(const double a[3], const double b[3]) {
  double cross[3];
  vector_cross(a, b, cross);
  return atan2(sqrt(vector_dot(cross, cross)), vector_dot(a, b));
}

double facing_angle(const struct facing *f, uint32_t face, uint32_t corner) {
  uint32_t start = scene_face_start(f->scene, face);
  uint32_t end = scene_face_start(f->scene, face + 1);
  double at[3], to[3], from[3];
  facing_position(f, facing_point(f, corner), at);
  facing_position(f, facing_point(f, corner + 1 < end ? corner + 1 : start),
                  to);
  facing_position(f, facing_point(f, corner > start ? corner - 1 : end - 1),
                  from);
  for (int k = 0; k < 3; k++) {
    to[k] -= at[k];
    from[k] -= at[k];
  }
  return angle_between(to, from);
}

/* Finds what a face adds to those of the normals at its corners that are
 * needed: nothing if it has none.
 * at  of near corners: its first one */
static void find_shares(const struct facing *f, uint32_t face, size_t at) {
  double(*share)[3] = f->share + at;
  uint32_t start = scene_face_start(f->scene, face);
  uint32_t end = scene_face_start(f->scene, face + 1), c = start;
  double n[3];
  while (c < end && f->corner_place[at + c - start] == 0)
    c++;
  if (c == end)
    return;
  newell_normal_of_face(f->scene, face, n);
  bool has_normal = vector_normalise(n);
  for (; c < end; c++) {
    if (f->corner_place[at + c - start] == 0)
      continue;
    double angle = has_normal ? facing_angle(f, face, c) : 0;
    for (int k = 0; k < 3; k++)
      share[c - start][k] = has_normal ? angle * n[k] : 0;
  }
}

/* Faces, or values, that a thread takes at once. */
enum { ITEMS_IN_RANGE = PARALLEL_RANGE(512) };

static bool find_shares_of_range(void *user, struct parallel_range range) {
  const struct facing *f = user;
  size_t at = ranked_set_rank(
      &f->near_corner, scene_face_start(f->scene, f->near.item[range.begin]));
  for (size_t i = range.begin; i < range.end; i++) {
    find_shares(f, f->near.item[i], at);
    at += scene_face_corners(f->scene, f->near.item[i]);
  }
  return true;
}

/* The shares of all near faces; they serve where more edges become creases, as
 * no more normals are needed then.  Returns false when memory ran out or the
 * caller cancelled. */
static bool find_all_shares(struct facing *f) {
  size_t n = f->near.count;
  f->share = mem_alloc(f->near_corners, sizeof *f->share);
  return f->share != NULL &&
         parallel_ranges(parallel_workers(n, ITEMS_IN_RANGE), n, ITEMS_IN_RANGE,
                         find_shares_of_range, f);
}

void facing_find_value(struct facing *f, uint32_t face, uint32_t corner) {
  uint32_t slot = facing_slot(f, corner), place = f->place[slot];
  double at[3], v[3];
  if (place == 0 || !isnan(f->value[place - 1]))
    return;
  facing_turn_normal(f, face, corner);
  facing_position(f, facing_point(f, corner), at);
  facing_view(f->camera, at, v);
  double g = facing_of_normal(f->normal[place - 1], v);
  /* Rounding does not change a sign on which all faces agree. */
  if (facing_signs(f, slot) == FACING_BACK)
    g = fmax(g, 0);
  else if (facing_signs(f, slot) == FACING_FRONT)
    g = fmin(g, -DBL_MIN);
  f->value[place - 1] = g;
}

/* Adds the shares of all near faces. */
static void add_shares(struct facing *f) {
  for (uint32_t i = 0; i < f->near_corners; i++) {
    uint32_t place = f->corner_place[i];
    for (int k = 0; place != 0 && k < 3; k++)
      f->normal[place - 1][k] += f->share[i][k];
  }
}

bool facing_find_normals(struct facing *f) {
  f->normal = mem_calloc(f->count, sizeof *f->normal);
  f->value = mem_alloc(f->count, sizeof *f->value);
  if (f->normal == NULL || f->value == NULL ||
      (f->share == NULL && !find_all_shares(f)))
    return false;
  add_shares(f);
  for (size_t i = 0; i < f->count; i++) {
    (void)vector_normalise(f->normal[i]);
    f->value[i] = NAN;
  }
  return !poll_is_cancelled();
}

/* Whether a face has corners of both signs. */
static bool has_both_signs(const struct facing *f, uint32_t face) {
  uint32_t start = scene_face_start(f->scene, face);
  bool first = facing_is_back(f, start);
  for (uint32_t c = start + 1; c < scene_face_start(f->scene, face + 1); c++)
    if (facing_is_back(f, c) != first)
      return true;
  return false;
}

/* With d from one corner to the other, and the sum of the normals there, the
 * normal in the middle has the direction of
 * (1 + |sum| / 2) sum - 2 (d . sum) d / d^2 (curved_triangle.c), and |sum| is
 * more than 4 / 3 where the normals turn by less than 96 degrees. */
bool facing_may_turn_between(const struct facing *f, uint32_t corner,
                             uint32_t other) {
  double p[3], q[3], v[3];
  uint32_t from = facing_place(f, facing_slot(f, corner)),
           to = facing_place(f, facing_slot(f, other));
  const double *m = f->normal[from], *n = f->normal[to];
  facing_position(f, facing_point(f, corner), p);
  facing_position(f, facing_point(f, other), q);
  const double d[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
  const double at[3] = {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2,
                        (p[2] + q[2]) / 2};
  facing_view(f->camera, at, v);
  double along = vector_dot(d, m) + vector_dot(d, n);
  return fabs(f->value[from] + f->value[to]) * vector_dot(d, d) <=
         1.2 * fabs(along * vector_dot(d, v));
}

/* Whether a contour may cross a face: it has corners of both signs, or the
 * surface may turn between two of them. */
static bool may_be_crossed(const struct facing *f, uint32_t face) {
  uint32_t start = scene_face_start(f->scene, face);
  uint32_t end = scene_face_start(f->scene, face + 1);
  if (has_both_signs(f, face))
    return true;
  for (uint32_t c = start; c < end; c++)
    if (facing_may_turn_between(f, c, c + 1 < end ? c + 1 : start))
      return true;
  return end - start == 4 && (facing_may_turn_between(f, start, start + 2) ||
                              facing_may_turn_between(f, start + 1, end - 1));
}

/* The values that are to be found. */
struct value_search {
  const struct facing *facing;
  uint32_t (*of)[2]; /* one a value: a face that has it, and its corner there;
                        corner SHEET_NONE: it is known */
};

static bool find_values_of_range(void *user, struct parallel_range range) {
  const struct value_search *search = user;
  struct large_face_normals large = large_face_normals_start();
  struct facing own = *search->facing;
  own.large = &large; /* as it is written */
  for (size_t i = range.begin; i < range.end; i++)
    if (search->of[i][1] != SHEET_NONE)
      facing_find_value(&own, search->of[i][0], search->of[i][1]);
  return true;
}

/* Notes the first corner of mixed faces of each value that is not known. */
static void list_values(const struct value_search *search) {
  const struct facing *f = search->facing;
  for (size_t i = 0; i < f->count; i++)
    search->of[i][1] = SHEET_NONE;
  for (size_t i = 0; i < f->mixed.count; i++) {
    uint32_t face = f->mixed.item[i], start = scene_face_start(f->scene, face);
    uint32_t at = ranked_set_rank(&f->near_corner, start);
    for (uint32_t c = start; c < scene_face_start(f->scene, face + 1); c++) {
      uint32_t value = f->corner_place[at + c - start] - 1;
      if (search->of[value][1] == SHEET_NONE && isnan(f->value[value])) {
        search->of[value][0] = face;
        search->of[value][1] = c;
      }
    }
  }
}

/* The search for the faces that may be crossed, whose values are known. */
struct crossed_search {
  struct facing *facing;
  size_t *kept; /* one a range: how many, at its beginning */
};

static bool keep_crossed_of_range(void *user, struct parallel_range range) {
  const struct crossed_search *search = user;
  const struct facing *f = search->facing;
  uint32_t *face = f->mixed.item;
  size_t kept = range.begin;
  for (size_t i = range.begin; i < range.end; i++)
    if (may_be_crossed(f, face[i]))
      face[kept++] = face[i];
  search->kept[range.begin / ITEMS_IN_RANGE] = kept - range.begin;
  return true;
}

/* Leaves out the mixed faces that are not crossed. */
static bool keep_crossed(struct facing *f) {
  size_t n = f->mixed.count;
  struct crossed_search search = {
      f,
      mem_alloc(parallel_range_count(n, ITEMS_IN_RANGE), sizeof *search.kept)};
  bool ok = search.kept != NULL &&
            parallel_ranges(parallel_workers(n, ITEMS_IN_RANGE), n,
                            ITEMS_IN_RANGE, keep_crossed_of_range, &search);
  if (ok)
    f->mixed.count = parallel_gather(f->mixed.item, sizeof *f->mixed.item, n,
                                     ITEMS_IN_RANGE, search.kept);
  mem_free(search.kept);
  return ok;
}

bool facing_find_values(struct facing *f) {
  struct value_search search = {f, mem_alloc(f->count, sizeof *search.of)};
  if (search.of == NULL)
    return false;
  list_values(&search);
  bool ok =
      parallel_ranges(parallel_workers(f->count, ITEMS_IN_RANGE), f->count,
                      ITEMS_IN_RANGE, find_values_of_range, &search);
  mem_free(search.of);
  return ok && keep_crossed(f);
}
