/* collinear_cuts.c - finds edges that a cut gives the same ends, by sorting
 * them by the end that they leave and their direction from there. */
#include "judge/collinear_cuts.h"

#include "base/poll.h"
#include "base/sort.h"
#include "base/tolerance.h"
#include "judge/open_surfaces.h"

/* An edge seen from one of its ends. */
struct leaving_edge {
  uint32_t from; /* the first point at the position of that end */
  uint32_t edge;
  struct judge_point3 direction; /* unit */
};

struct leaving_edges {
  ARRAY(struct leaving_edge) item;
};

static int compare_leaving_edges(const void *a, const void *b, void *user) {
  const struct leaving_edge *s = a, *t = b;
  (void)user;
  if (s->from != t->from)
    return s->from < t->from ? -1 : 1;
  if (s->direction.x != t->direction.x)
    return s->direction.x < t->direction.x ? -1 : 1;
  return s->edge < t->edge ? -1 : s->edge > t->edge;
}

/* Adds an edge of faces that a plane cuts, by either end. */
static bool add_leaving(struct leaving_edges *leaving,
                        const struct judge_edges *edges,
                        const struct judge_triangles *all,
                        const uint32_t *first_at, uint32_t edge) {
  const struct judge_source *source = &edges->edge.item[edge].source;
  if (source->point[0] == SCENE_NONE || source->face[0] == SCENE_NONE)
    return true;
  const struct judge_point3 p[2] = {
      judge_point3_at(all->scene, source->point[0]),
      judge_point3_at(all->scene, source->point[1])};
  if (!judge_is_cut_between(&all->removed, p[0], p[1]))
    return true;
  for (int k = 0; k < 2; k++) {
    const struct leaving_edge item = {first_at[source->point[k]], edge,
                                      point3_unit(point3_sub(p[1 - k], p[k]))};
    if (!ARRAY_PUSH(&leaving->item, item))
      return false;
  }
  return true;
}

/* Takes the classes from two edges if they have one direction. */
static void doubt_pair(struct judge_edges *edges, const struct leaving_edge *a,
                       const struct leaving_edge *b) {
  struct judge_source *one = &edges->edge.item[a->edge].source;
  struct judge_source *two = &edges->edge.item[b->edge].source;
  bool same = one->point[0] == two->point[0] && one->point[1] == two->point[1];
  if (same || point3_length(point3_sub(a->direction, b->direction)) >
                  TOLERANCE_JUDGE_ANGLE)
    return;
  one->class_mask = two->class_mask = 0;
}

bool judge_doubt_collinear_cuts(struct judge_edges *edges,
                                const struct judge_triangles *all,
                                const uint32_t *first_at) {
  struct leaving_edges leaving = {{0}};
  size_t count = edges->edge.count;
  bool ok = true;
  for (uint32_t i = 0; ok && all->removed.planes > 0 && i < count; i++)
    ok = poll_at(i) && add_leaving(&leaving, edges, all, first_at, i);
  ok =
      ok && sort_stable(leaving.item.item, leaving.item.count,
                        sizeof *leaving.item.item, compare_leaving_edges, NULL);
  for (size_t i = 0; ok && i < leaving.item.count; i++) {
    const struct leaving_edge *a = &leaving.item.item[i];
    ok = poll_at(i);
    for (size_t j = i + 1;
         j < leaving.item.count && leaving.item.item[j].from == a->from &&
         leaving.item.item[j].direction.x - a->direction.x <=
             TOLERANCE_JUDGE_ANGLE;
         j++)
      doubt_pair(edges, a, &leaving.item.item[j]);
  }
  ARRAY_FREE(&leaving.item);
  return ok;
}
