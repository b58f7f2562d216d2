/* pierced.c - the lines along which triangles pierce each other. */
#include <string.h>

#include "judge/edges.h"

struct piercer {
  struct judge_edges *edges;
  const struct judge_triangles *all;
  const struct judge_camera *camera;
  double contact;
  uint32_t current; /* the triangle whose neighbours are looked up */
};

/* Where a triangle's sides cross a plane: at most two spots. */
struct cut {
  struct judge_spot end[2];
  unsigned count;
  double before, behind; /* how far it reaches to either side of the plane */
};

static struct cut cut_by_plane(const struct judge_triangle *t,
                               const struct judge_triangle *plane) {
  struct cut cut = {.count = 0};
  double away[3];
  for (int k = 0; k < 3; k++) {
    away[k] = spot_dot(plane->normal, spot_sub(t->p[k], plane->p[0]));
    cut.before = fmax(cut.before, away[k]);
    cut.behind = fmax(cut.behind, -away[k]);
  }
  for (int k = 0; k < 3; k++) {
    int l = (k + 1) % 3;
    if ((away[k] > 0) == (away[l] > 0) || cut.count == 2)
      continue;
    cut.end[cut.count++] = spot_along(t->p[k], away[k] / (away[k] - away[l]),
                                      spot_sub(t->p[l], t->p[k]));
  }
  return cut;
}

static unsigned shared_corners(const struct judge_triangle *s,
                               const struct judge_triangle *t) {
  unsigned shared = 0;
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++)
      shared += s->p[i].x == t->p[k].x && s->p[i].y == t->p[k].y &&
                s->p[i].z == t->p[k].z;
  return shared;
}

/* Adds what two triangles' cuts by each other's planes have in common; both
 * lie on the line of those planes. */
static bool add_common(struct piercer *piercer, const struct cut *s,
                       const struct cut *t, struct judge_spot along,
                       uint32_t other) {
  double s0 = spot_dot(along, s->end[0]), s1 = spot_dot(along, s->end[1]);
  double t0 = spot_dot(along, t->end[0]), t1 = spot_dot(along, t->end[1]);
  double low = fmax(fmin(s0, s1), fmin(t0, t1));
  double high = fmin(fmax(s0, s1), fmax(t0, t1));
  if (!(low < high))
    return true;
  struct judge_spot a = spot_along(s->end[0], low - s0, along);
  struct judge_spot b = spot_along(s->end[0], high - s0, along);
  /* Sure where all four reaches are well beyond what counts as contact, and
   * there is one way to cut both faces. */
  double reach = fmin(fmin(s->before, s->behind), fmin(t->before, t->behind));
  const struct judge_triangle *triangle = piercer->all->triangle.item;
  bool sure = reach > 10 * piercer->contact &&
              triangle[piercer->current].cut == JUDGE_PLANAR &&
              triangle[other].cut == JUDGE_PLANAR;
  const struct judge_source source = {
      {SCENE_NONE, SCENE_NONE},
      {triangle[piercer->current].face, triangle[other].face},
      sure ? RECTO_EDGE_INTERSECTION : 0,
      false};
  return judge_edges_add(piercer->edges, piercer->camera, a, b, &source);
}

static bool pierce(void *user, uint32_t other) {
  struct piercer *piercer = user;
  if (other <= piercer->current)
    return true;
  const struct judge_triangle *s =
      &piercer->all->triangle.item[piercer->current];
  const struct judge_triangle *t = &piercer->all->triangle.item[other];
  if (s->face == t->face || shared_corners(s, t) >= 2)
    return true;
  struct judge_spot along = spot_cross(s->normal, t->normal);
  if (!(spot_length(along) > 0))
    return true;
  struct cut cs = cut_by_plane(s, t), ct = cut_by_plane(t, s);
  return cs.count != 2 || ct.count != 2 ||
         add_common(piercer, &cs, &ct, spot_unit(along), other);
}

bool judge_edges_pierced(struct judge_edges *edges,
                         const struct judge_triangles *all,
                         const struct judge_camera *camera, double contact) {
  struct piercer piercer = {edges, all, camera, contact, 0};
  for (uint32_t i = 0; i < all->triangle.count; i++) {
    struct judge_box box = judge_triangle_box(&all->triangle.item[i]);
    piercer.current = i;
    if (!judge_triangles_near(all, &box, pierce, &piercer))
      return false;
  }
  return true;
}
