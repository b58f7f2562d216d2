/* subdivide.c - see subdivide.h. */
#include "tests/scenes/subdivide.h"

#include <string.h>

#include "tests/scenes/build.h"

struct split_edge {
  uint32_t a, b;        /* a < b; a == b marks a free slot */
  uint32_t opposite[2]; /* third corners of its first two triangles */
  uint32_t uses;
  uint32_t middle; /* its new point */
};

struct subdivision {
  struct scene *to;
  const struct scene *from;
  struct split_edge *table; /* open addressing, a power of two */
  size_t mask;
  uint32_t *order; /* places in the table, by first use */
  size_t edges;
};

/* What surrounds a point. */
struct ring {
  struct vector sum, border_sum;
  uint32_t neighbours, border_neighbours;
};

/* The edge's slot in the table, free or not. */
static size_t find_edge(const struct subdivision *sub, uint32_t a, uint32_t b) {
  uint64_t key = (uint64_t)a << 32 | b;
  key *= UINT64_C(0x9e3779b97f4a7c15);
  size_t slot = (size_t)(key >> 20) & sub->mask;
  while (sub->table[slot].a != sub->table[slot].b &&
         (sub->table[slot].a != a || sub->table[slot].b != b))
    slot = (slot + 1) & sub->mask;
  return slot;
}

static struct split_edge *edge_of(const struct subdivision *sub, uint32_t a,
                                  uint32_t b) {
  return &sub->table[find_edge(sub, a < b ? a : b, a < b ? b : a)];
}

static void note_side(struct subdivision *sub, uint32_t a, uint32_t b,
                      uint32_t opposite) {
  uint32_t low = a < b ? a : b, high = a < b ? b : a;
  size_t slot = find_edge(sub, low, high);
  struct split_edge *edge = &sub->table[slot];
  if (edge->a == edge->b) {
    edge->a = low;
    edge->b = high;
    sub->order[sub->edges++] = (uint32_t)slot;
  }
  if (edge->uses < 2)
    edge->opposite[edge->uses] = opposite;
  edge->uses++;
}

/* Calls visit for each triangle of each face's fan. */
static void visit_triangles(struct subdivision *sub,
                            void (*visit)(struct subdivision *sub,
                                          const uint32_t corner[3],
                                          uint32_t face)) {
  const struct scene *from = sub->from;
  for (uint32_t i = 0; i < scene_face_count(from); i++) {
    uint32_t start = scene_face_start(from, i);
    for (uint32_t k = start + 2; k < scene_face_start(from, i + 1); k++) {
      const uint32_t corner[3] = {from->corner.item[start],
                                  from->corner.item[k - 1],
                                  from->corner.item[k]};
      visit(sub, corner, i);
    }
  }
}

static void note_triangle(struct subdivision *sub, const uint32_t corner[3],
                          uint32_t face) {
  (void)face;
  for (int k = 0; k < 3; k++)
    note_side(sub, corner[k], corner[(k + 1) % 3], corner[(k + 2) % 3]);
}

static struct vector at(const struct subdivision *sub, uint32_t point) {
  const struct scene_point *p = &sub->from->point.item[point];
  return vector_of(p->x, p->y, p->z);
}

/* ---- New places ---------------------------------------------------------- */

static void add_middles(struct subdivision *sub, enum subdivide_rule rule) {
  for (size_t i = 0; i < sub->edges; i++) {
    struct split_edge *edge = &sub->table[sub->order[i]];
    struct vector ends = vector_add(at(sub, edge->a), at(sub, edge->b));
    struct vector middle = vector_scale(ends, 0.5);
    if (rule == SUBDIVIDE_LOOP && edge->uses == 2) {
      struct vector sides =
          vector_add(at(sub, edge->opposite[0]), at(sub, edge->opposite[1]));
      middle =
          vector_add(vector_scale(ends, 0.375), vector_scale(sides, 0.125));
    }
    edge->middle = build_vector(sub->to, middle);
  }
}

/* Where Loop's rule puts an old point. */
static struct vector smooth(struct vector old, const struct ring *ring) {
  if (ring->border_neighbours == 2)
    return vector_add(vector_scale(old, 0.75),
                      vector_scale(ring->border_sum, 0.125));
  if (ring->border_neighbours != 0 || ring->neighbours < 3)
    return old; /* a corner of several borders, or a loose point */
  double n = ring->neighbours;
  double weight = ring->neighbours == 3 ? 0.1875 : 0.375 / n;
  return vector_add(vector_scale(old, 1 - n * weight),
                    vector_scale(ring->sum, weight));
}

static void note_neighbour(struct ring *ring, struct vector neighbour,
                           bool border) {
  ring->sum = vector_add(ring->sum, neighbour);
  ring->neighbours++;
  if (!border)
    return;
  ring->border_sum = vector_add(ring->border_sum, neighbour);
  ring->border_neighbours++;
}

static void move_old_points(struct subdivision *sub) {
  size_t points = sub->from->point.count;
  struct ring *ring = mem_calloc(points, sizeof *ring);
  build_require(ring != NULL);
  for (size_t i = 0; i < sub->edges; i++) {
    const struct split_edge *edge = &sub->table[sub->order[i]];
    bool border = edge->uses != 2;
    note_neighbour(&ring[edge->a], at(sub, edge->b), border);
    note_neighbour(&ring[edge->b], at(sub, edge->a), border);
  }
  for (uint32_t i = 0; i < points; i++) {
    struct vector moved = smooth(at(sub, i), &ring[i]);
    sub->to->point.item[i] = (struct scene_point){moved.x, moved.y, moved.z};
  }
  mem_free(ring);
}

static void add_quarters(struct subdivision *sub, const uint32_t corner[3],
                         uint32_t face) {
  uint32_t middle[3];
  for (int k = 0; k < 3; k++)
    middle[k] = edge_of(sub, corner[k], corner[(k + 1) % 3])->middle;
  sub->to->current_group = scene_face_group(sub->from, face);
  build_triangle(sub->to, corner[0], middle[0], middle[2]);
  build_triangle(sub->to, corner[1], middle[1], middle[0]);
  build_triangle(sub->to, corner[2], middle[2], middle[1]);
  build_triangle(sub->to, middle[0], middle[1], middle[2]);
}

void scenes_subdivide(struct scene *to, const struct scene *from,
                      enum subdivide_rule rule) {
  struct subdivision sub = {.to = to, .from = from};
  size_t sides = 3 * from->corner.count, places = 16;
  while (places < sides)
    places *= 2;
  sub.mask = places - 1;
  sub.table = mem_calloc(places, sizeof *sub.table);
  sub.order = mem_alloc(sides, sizeof *sub.order);
  build_require(sub.table != NULL && sub.order != NULL);
  memcpy(to->up, from->up, sizeof to->up);
  for (size_t i = 0; i < from->group.count; i++)
    build_group(to, from->group.item[i].name);
  for (size_t i = 0; i < from->point.count; i++)
    build_require(ARRAY_PUSH(&to->point, from->point.item[i]));
  visit_triangles(&sub, note_triangle);
  add_middles(&sub, rule);
  if (rule == SUBDIVIDE_LOOP)
    move_old_points(&sub);
  visit_triangles(&sub, add_quarters);
  mem_free(sub.order);
  mem_free(sub.table);
}
