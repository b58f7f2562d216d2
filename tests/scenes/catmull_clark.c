/* catmull_clark.c - see catmull_clark.h. */
#include "tests/scenes/catmull_clark.h"

#include <stdlib.h>

#include "scene/topology/topology.h"
#include "tests/scenes/build.h"

/* What surrounds a point. */
struct ring {
  struct vector faces, edges, sharp; /* sums of face points, of middles of
                                        edges, of far ends of sharp ones */
  uint32_t face_count, edge_count, sharp_count;
};

struct step {
  const struct scene *from;
  struct topology topology;
  struct vector *face_point;
  struct ring *ring; /* of each point */
};

static struct vector place(const struct scene *scene, uint32_t point) {
  const struct scene_point *p = &scene->point.item[point];
  return vector_of(p->x, p->y, p->z);
}

static uint32_t point_at(const struct step *step, uint32_t corner) {
  uint32_t point = step->from->corner.item[corner];
  return step->topology.weld ? step->topology.weld[point] : point;
}

static bool is_sharp(const struct topology_edge *edge) {
  return edge->uses != 2 || edge->first == edge->second;
}

static void add_to(struct vector *sum, struct vector more) {
  *sum = vector_add(*sum, more);
}

static void find_face_points(struct step *step) {
  for (uint32_t f = 0; f < scene_face_count(step->from); f++) {
    uint32_t start = scene_face_start(step->from, f);
    uint32_t end = scene_face_start(step->from, f + 1);
    struct vector sum = vector_of(0, 0, 0);
    for (uint32_t c = start; c < end; c++)
      add_to(&sum, place(step->from, point_at(step, c)));
    step->face_point[f] = vector_scale(sum, 1.0 / (end - start));
    for (uint32_t c = start; c < end; c++) {
      struct ring *ring = &step->ring[point_at(step, c)];
      add_to(&ring->faces, step->face_point[f]);
      ring->face_count++;
    }
  }
}

static struct vector middle_of(const struct step *step,
                               const struct topology_edge *edge) {
  return vector_scale(vector_add(place(step->from, edge->point[0]),
                                 place(step->from, edge->point[1])),
                      0.5);
}

static void find_rings(struct step *step) {
  for (size_t e = 0; e < step->topology.edge.count; e++) {
    const struct topology_edge *edge = &step->topology.edge.item[e];
    for (int k = 0; k < 2; k++) {
      struct ring *ring = &step->ring[edge->point[k]];
      add_to(&ring->edges, middle_of(step, edge));
      ring->edge_count++;
      if (is_sharp(edge)) {
        add_to(&ring->sharp, place(step->from, edge->point[1 - k]));
        ring->sharp_count++;
      }
    }
  }
}

/* Where a point of the coarse mesh moves. */
static struct vector moved(const struct step *step, uint32_t point) {
  const struct ring *ring = &step->ring[point];
  struct vector p = place(step->from, point);
  if (ring->face_count == 0 ||
      (ring->sharp_count > 0 && ring->sharp_count != 2))
    return p;
  if (ring->sharp_count == 2)
    return vector_scale(vector_add(vector_scale(p, 6), ring->sharp), 1.0 / 8);
  double n = ring->edge_count;
  struct vector sum =
      vector_add(vector_scale(ring->faces, 1.0 / ring->face_count),
                 vector_scale(ring->edges, 2 / n));
  return vector_scale(vector_add(sum, vector_scale(p, n - 3)), 1 / n);
}

static struct vector edge_point(const struct step *step,
                                const struct topology_edge *edge) {
  struct vector middle = middle_of(step, edge);
  if (is_sharp(edge))
    return middle;
  struct vector sum =
      vector_add(step->face_point[edge->first], step->face_point[edge->second]);
  return vector_add(vector_scale(middle, 0.5), vector_scale(sum, 0.25));
}

static void add_face(const struct step *step, struct scene *to, uint32_t face) {
  uint32_t start = scene_face_start(step->from, face);
  uint32_t end = scene_face_start(step->from, face + 1);
  uint32_t first_edge = (uint32_t)step->from->point.count;
  uint32_t first_face = first_edge + (uint32_t)step->topology.edge.count;
  for (uint32_t c = start; c < end; c++) {
    uint32_t before = (c > start ? c : end) - 1;
    build_quad(to, point_at(step, c),
               first_edge + step->topology.corner_edge[c], first_face + face,
               first_edge + step->topology.corner_edge[before]);
  }
}

void scenes_catmull_clark(struct scene *to, const struct scene *from) {
  struct step step = {.from = from};
  uint32_t faces = scene_face_count(from);
  build_require(topology_init(&step.topology, from, NULL) == RECTO_OK);
  step.face_point = calloc(faces + 1, sizeof *step.face_point);
  step.ring = calloc(from->point.count + 1, sizeof *step.ring);
  build_require(step.face_point && step.ring);
  find_face_points(&step);
  find_rings(&step);
  build_group(to, "surface");
  for (uint32_t p = 0; p < from->point.count; p++)
    build_vector(to, moved(&step, p));
  for (size_t e = 0; e < step.topology.edge.count; e++)
    build_vector(to, edge_point(&step, &step.topology.edge.item[e]));
  for (uint32_t f = 0; f < faces; f++)
    build_vector(to, step.face_point[f]);
  for (uint32_t f = 0; f < faces; f++)
    add_face(&step, to, f);
  free(step.face_point);
  free(step.ring);
  topology_fini(&step.topology);
}
