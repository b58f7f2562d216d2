/* curvature_noise.c - compares the curvature at each vertex near a contour with
 * that of its neighbours. */
#include "visibility/zero_set/curvature_noise.h"

#include <math.h>

/* Sums over the edges at a vertex, each with its weight. */
struct edge_sums {
  double along, lengths; /* along the normal; squared */
  double sizes;          /* of what is along the normal */
  double curvature;      /* of the vertex: along / lengths */
  double others;         /* the neighbours' curvatures */
  double weights;
};

/* The place of the one normal of a point, from 1 on; 0: it has none, or
 * several. */
static uint32_t place_of_point(const struct facing *f, uint32_t point) {
  return (f->point_flags[point] & FACING_SPLIT) != 0 ? 0 : f->place[point];
}

/* An edge from a point. */
struct edge_vector {
  double along, length; /* along the point's normal; squared */
  double weight[CURVATURE_WEIGHTS];
};

static struct edge_vector edge_from(const struct facing *f, uint32_t from,
                                    uint32_t to, uint32_t place) {
  double p[3], q[3];
  facing_position(f, from, p);
  facing_position(f, to, q);
  const double d[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
  double length = vector_dot(d, d);
  return (struct edge_vector){
      vector_dot(d, f->normal[place - 1]), length, {1, 1 / (length * length)}};
}

/* The sums of a place, one a weight. */
static struct edge_sums *sums_at(struct edge_sums *sums, size_t place) {
  return sums + CURVATURE_WEIGHTS * (place - 1);
}

/* Adds an edge to the sums at one of its ends. */
static void add_edge(const struct facing *f, struct edge_sums *sums,
                     const uint32_t point[2], int k) {
  uint32_t place = place_of_point(f, point[k]);
  if (place == 0)
    return;
  struct edge_vector edge = edge_from(f, point[k], point[1 - k], place);
  struct edge_sums *at = sums_at(sums, place);
  for (int i = 0; i < CURVATURE_WEIGHTS; i++) {
    at[i].along += edge.weight[i] * edge.along;
    at[i].lengths += edge.weight[i] * edge.length;
    at[i].sizes += edge.weight[i] * fabs(edge.along);
    at[i].weights += edge.weight[i];
  }
}

/* Adds the curvature of one end of an edge to the sums at the other one; that
 * of a point without one normal is not known. */
static void add_curvature(const struct facing *f, struct edge_sums *sums,
                          const uint32_t point[2], int k) {
  uint32_t place = place_of_point(f, point[k]);
  uint32_t other = place_of_point(f, point[1 - k]);
  if (place == 0)
    return;
  struct edge_vector edge = edge_from(f, point[k], point[1 - k], place);
  struct edge_sums *at = sums_at(sums, place);
  for (int i = 0; i < CURVATURE_WEIGHTS; i++) {
    double curvature = other == 0 ? NAN : sums_at(sums, other)[i].curvature;
    at[i].others += edge.weight[i] * curvature;
  }
}

static void find_sums(const struct facing *f, struct edge_sums *sums) {
  const struct topology_edge *edge = f->topology->edge.item;
  const uint32_t *near = f->near_edge.item;
  for (size_t i = 0; i < f->near_edge.count; i++)
    for (int k = 0; k < 2; k++)
      add_edge(f, sums, edge[near[i]].point, k);
  for (size_t i = 0; i < CURVATURE_WEIGHTS * f->count; i++)
    sums[i].curvature =
        sums[i].lengths > 0 ? sums[i].along / sums[i].lengths : 0;
  for (size_t i = 0; i < f->near_edge.count; i++)
    for (int k = 0; k < 2; k++)
      add_curvature(f, sums, edge[near[i]].point, k);
}

/* The squares at a vertex; 0 where they are not known. */
static struct curvature_squares squares_of(const struct edge_sums *sums) {
  struct curvature_squares made = {.known = 0};
  for (int i = 0; i < CURVATURE_WEIGHTS; i++) {
    double noise = sums[i].curvature - sums[i].others / sums[i].weights;
    double size = sums[i].sizes / sums[i].lengths;
    if (!isfinite(noise * noise) || !isfinite(size * size))
      continue;
    made.noise[i] = noise * noise;
    made.curvature[i] = size * size;
    made.known = 1;
  }
  made.unknown = 1 - made.known;
  return made;
}

bool curvature_noise_find(struct curvature_noise *c, const struct facing *f) {
  struct edge_sums *sums =
      mem_calloc(CURVATURE_WEIGHTS * f->count, sizeof *sums);
  c->at = mem_calloc(f->count, sizeof *c->at);
  bool ok = sums != NULL && c->at != NULL;
  if (ok)
    find_sums(f, sums);
  for (size_t i = 0; ok && i < f->count; i++)
    c->at[i] = squares_of(sums_at(sums, i + 1));
  mem_free(sums);
  return ok;
}

void curvature_noise_fini(struct curvature_noise *c) { mem_free(c->at); }

struct curvature_squares curvature_noise_sum(const struct curvature_noise *c,
                                             const struct facing *f,
                                             const uint32_t *point, int count) {
  struct curvature_squares sum = {{0}, {0}, 0, 0};
  for (int k = 0; k < count; k++) {
    uint32_t place = place_of_point(f, point[k]);
    if (place == 0 || c->at == NULL)
      sum.unknown++;
    else
      curvature_squares_add(&sum, c->at[place - 1]);
  }
  return sum;
}
