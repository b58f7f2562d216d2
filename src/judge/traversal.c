/* traversal.c - descends the tree of bounding boxes. */
#include "judge/traversal.h"

/* ---- The tree ------------------------------------------------------------ */

typedef bool found_triangle(void *user, uint32_t triangle);

/* Calls found(user, i) for the triangles of all leaves that `meets`, and below
 * nodes that it does, until it returns false; returns whether it never did. */
static bool visit_leaves(const struct judge_triangles *all,
                         bool (*meets)(const void *query,
                                       const struct judge_node *node),
                         const void *query, found_triangle *found, void *user) {
  uint32_t stack[JUDGE_STACK_SIZE];
  unsigned depth = 0;
  if (all->nodes > 0)
    stack[depth++] = 0;
  while (depth > 0) {
    const struct judge_node *node = &all->node[stack[--depth]];
    if (!meets(query, node))
      continue;
    if (node->count == 0) {
      stack[depth++] = node->first;
      stack[depth++] = node->first + 1;
      continue;
    }
    for (uint32_t i = 0; i < node->count; i++)
      if (!found(user, node->first + i))
        return false;
  }
  return true;
}

/* ---- Along a ray --------------------------------------------------------- */

struct slab_ray {
  double from[3], inverse[3]; /* 1 / direction */
  bool parallel[3];           /* direction 0 */
  double t_max;
};

static bool ray_meets(const void *query, const struct judge_node *node) {
  const struct slab_ray *ray = query;
  const struct judge_box *box = &node->box;
  double t0 = 0, t1 = ray->t_max;
  for (int k = 0; k < 3; k++) {
    if (ray->parallel[k]) {
      if (ray->from[k] < box->low[k] || ray->from[k] > box->high[k])
        return false;
      continue;
    }
    double a = (box->low[k] - ray->from[k]) * ray->inverse[k];
    double b = (box->high[k] - ray->from[k]) * ray->inverse[k];
    double first = a < b ? a : b, last = a < b ? b : a;
    t0 = first > t0 ? first : t0;
    t1 = last < t1 ? last : t1;
  }
  return t0 <= t1;
}

bool judge_triangles_along(const struct judge_triangles *all,
                           struct judge_point3 from,
                           struct judge_point3 towards, double t_max,
                           bool (*found)(void *user, uint32_t triangle),
                           void *user) {
  const struct slab_ray ray = {{from.x, from.y, from.z},
                               {1 / towards.x, 1 / towards.y, 1 / towards.z},
                               {towards.x == 0, towards.y == 0, towards.z == 0},
                               t_max};
  return visit_leaves(all, ray_meets, &ray, found, user);
}

/* ---- Near a box ---------------------------------------------------------- */

struct box_query {
  const struct judge_box *box;
  uint32_t but; /* a face */
};

static bool box_meets(const void *query, const struct judge_node *node) {
  const struct box_query *near = query;
  for (int k = 0; k < 3; k++)
    if (node->box.high[k] < near->box->low[k] ||
        near->box->high[k] < node->box.low[k])
      return false;
  return node->face != near->but;
}

bool judge_triangles_near(const struct judge_triangles *all,
                          const struct judge_box *box, uint32_t but,
                          bool (*found)(void *user, uint32_t triangle),
                          void *user) {
  const struct box_query near = {box, but};
  return visit_leaves(all, box_meets, &near, found, user);
}
