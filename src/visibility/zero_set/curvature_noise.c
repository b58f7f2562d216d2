/* curvature_noise.c - compares the curvature at each vertex near a contour with
 * that of its neighbours. */
#include "visibility/zero_set/curvature_noise.h"

#include <math.h>

/* Sums over the edges at a vertex. */
struct edge_sums {
  double along, lengths; /* along the normal; squared */
  double sizes;          /* of what is along the normal */
  double curvature;      /* of the vertex: along / lengths */
  double others;         /* the neighbours' curvatures */
  double edges;
};

/* The place of the one normal of a point, from 1 on; 0: it has none, or
 * several. */
static uint32_t place_of_point(const struct facing *f, uint32_t point) {
  return (f->point_flags[point] & FACING_SPLIT) != 0 ? 0 : f->place[point];
}

/* Adds an edge to the sums at one of its ends. */
static void add_edge(const struct facing *f, struct edge_sums *sums,
                     const uint32_t point[2], int k) {
  uint32_t place = place_of_point(f, point[k]);
  double p[3], q[3];
  if (place == 0)
    return;
  facing_position(f, point[k], p);
  facing_position(f, point[1 - k], q);
  const double d[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
  double along = vector_dot(d, f->normal[place - 1]);
  double length = vector_dot(d, d);
  struct edge_sums *at = &sums[place - 1];
  at->along += along;
  at->lengths += length;
  at->sizes += fabs(along);
  at->edges++;
}

/* Adds the curvature of one end of an edge to the sums at the other one; that
 * of a point without one normal is not known. */
static void add_curvature(const struct facing *f, struct edge_sums *sums,
                          const uint32_t point[2], int k) {
  uint32_t place = place_of_point(f, point[k]);
  uint32_t other = place_of_point(f, point[1 - k]);
  if (place != 0)
    sums[place - 1].others += other != 0 ? sums[other - 1].curvature : NAN;
}

static void find_sums(const struct facing *f, struct edge_sums *sums) {
  const struct topology_edge *edge = f->topology->edge.item;
  const uint32_t *near = f->near_edge.item;
  for (size_t i = 0; i < f->near_edge.count; i++)
    for (int k = 0; k < 2; k++)
      add_edge(f, sums, edge[near[i]].point, k);
  for (size_t i = 0; i < f->count; i++)
    sums[i].curvature =
        sums[i].lengths > 0 ? sums[i].along / sums[i].lengths : 0;
  for (size_t i = 0; i < f->near_edge.count; i++)
    for (int k = 0; k < 2; k++)
      add_curvature(f, sums, edge[near[i]].point, k);
}

bool curvature_noise_find(struct curvature_noise *c, const struct facing *f) {
  struct edge_sums *sums = mem_calloc(f->count, sizeof *sums);
  c->at = mem_calloc(f->count, sizeof *c->at);
  bool ok = sums != NULL && c->at != NULL;
  if (ok)
    find_sums(f, sums);
  for (size_t i = 0; ok && i < f->count; i++) {
    double noise = sums[i].curvature - sums[i].others / sums[i].edges;
    double size = sums[i].sizes / sums[i].lengths;
    if (isfinite(noise * noise) && isfinite(size * size))
      c->at[i] = (struct curvature_squares){noise * noise, size * size};
  }
  mem_free(sums);
  return ok;
}

void curvature_noise_fini(struct curvature_noise *c) { mem_free(c->at); }

struct curvature_squares curvature_noise_sum(const struct curvature_noise *c,
                                             const struct facing *f,
                                             const uint32_t *point, int count) {
  struct curvature_squares sum = {0, 0};
  for (int k = 0; k < count; k++) {
    uint32_t place = place_of_point(f, point[k]);
    if (place != 0)
      curvature_squares_add(&sum, c->at[place - 1]);
  }
  return sum;
}
