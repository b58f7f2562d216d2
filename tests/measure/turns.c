/* turns.c - see turns.h. */
#include "tests/measure/turns.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/scenes/box.h"

/* ---- Scenes and cameras -------------------------------------------------- */

#define FILL(name, call)                                                       \
  static void fill_##name(struct scene *scene, recto_options *options) { call; }

FILL(cubes, scenes_cube_stack(scene, options, 8, 0))
FILL(cycles, scenes_cycle_field(scene, options, 3))
FILL(soup, scenes_soup(scene, options, 60, 1))
FILL(touching, scenes_touching_boxes(scene, options, 0))
FILL(surface, scenes_sinc(scene, options, 16))
FILL(room, scenes_room(scene, options, SCENES_EYE_ON_PLANE))

const struct scenes_entry turn_scenes[TURN_SCENES] = {
    {"a stack of 8 cubes", fill_cubes},
    {"9 cycles of three bars", fill_cycles},
    {"a large table with small things", scenes_large_table},
    {"60 triangles that pierce each other", fill_soup},
    {"two boxes that pierce each other", scenes_crossed_boxes},
    {"two boxes that touch", fill_touching},
    {"the surface sin(r)/r", fill_surface},
    {"a room, the eye in the plane of a face", fill_room},
};

/* An eye in a direction in which nothing lies by chance. */
static void choose_eye(const struct scene *scene,
                       recto_camera_options *camera) {
  static const double direction[3] = {0.6, -0.62, 0.5};
  double middle[3], size = 2 * box_measure(scene, middle);
  for (int k = 0; k < 3; k++) {
    camera->target[k] = middle[k];
    camera->eye[k] = camera->target[k] + 1.5 * size * direction[k];
  }
  camera->kind = RECTO_CAMERA_EYE;
  camera->has_target = true;
  camera->up[0] = camera->up[1] = 0;
  camera->up[2] = 1;
  camera->fov_deg = 50;
}

void turn_scene(struct scene *scene, recto_options *options, int index) {
  recto_options_init(options);
  scene_init(scene);
  turn_scenes[index].fill(scene, options);
  if (options->camera.kind != RECTO_CAMERA_EYE || options->camera.fov_deg == 0)
    choose_eye(scene, &options->camera);
  options->camera.fit = RECTO_FIT_NONE;
  options->page.width_mm = options->page.height_mm = 100;
  options->page.margin_mm = 5;
  options->solver.threads = 1;
}

/* A vector of that length in any direction. */
static void choose_vector(double vector[3], double length,
                          struct random *random) {
  double norm = 0;
  while (!(norm > 0.1 && norm < 1)) {
    norm = 0;
    for (int k = 0; k < 3; k++) {
      vector[k] = random_between(random, -1, 1);
      norm = hypot(norm, vector[k]);
    }
  }
  for (int k = 0; k < 3; k++)
    vector[k] *= length / norm;
}

void turn_camera(recto_options *moved, const recto_options *options,
                 enum turn_kind kind, double by, struct random *random) {
  recto_camera_options *camera = &moved->camera;
  double vector[3], distance = 0;
  *moved = *options;
  for (int k = 0; k < 3; k++)
    distance = hypot(distance, camera->target[k] - camera->eye[k]);
  choose_vector(vector, by * distance, random);
  if (kind == TURN_SCALE)
    camera->fov_deg *= 1 + (vector[0] < 0 ? -by : by);
  for (int k = 0; k < 3 && kind != TURN_SCALE; k++) {
    camera->target[k] += vector[k];
    if (kind == TURN_SHIFT)
      camera->eye[k] += vector[k];
  }
}

/* ---- What is visible of one edge or face --------------------------------- */

/* Identifies it in any sheet of the scene. */
enum visible_kind { OF_EDGE, OF_WIRE, OF_DIAGONAL, OF_INTERSECTION, OF_FACE };

struct visible {
  uint64_t kind, first, second; /* enum visible_kind; edge, or faces */
  uint64_t topology;            /* what must be equal to be the same */
  double amount;                /* mm, mm^2 */
};

typedef ARRAY(struct visible) visible_list;

static struct visible name_edge(const struct sheet *sheet,
                                const struct sheet_edge *edge) {
  struct visible v = {.kind = OF_EDGE, .first = edge->source};
  uint64_t face[2] = {SHEET_NONE, SHEET_NONE};
  for (int k = 0; k < 2; k++)
    if (edge->triangle[k] != SHEET_NONE)
      face[k] = sheet->triangle.item[edge->triangle[k]].face;
  if (edge->edge_class == RECTO_EDGE_WIRE) {
    v.kind = OF_WIRE;
    v.second = edge->part;
  } else if (edge->source == SHEET_NONE) {
    v.kind = edge->edge_class == RECTO_EDGE_INTERSECTION ? OF_INTERSECTION
                                                         : OF_DIAGONAL;
    v.first = face[0] < face[1] ? face[0] : face[1];
    v.second = face[0] < face[1] ? face[1] : face[0];
  }
  return v;
}

static int compare_names(const struct visible *p, const struct visible *q) {
  if (p->kind != q->kind)
    return p->kind < q->kind ? -1 : 1;
  if (p->first != q->first)
    return p->first < q->first ? -1 : 1;
  return p->second < q->second ? -1 : p->second > q->second;
}

static int compare_visible(const void *a, const void *b) {
  return compare_names(a, b);
}

/* Adds a part to the visible thing of that name: one for all parts of an edge
 * that clipping or intersections made. */
static bool add_visible(visible_list *list, struct visible v) {
  if (list->count > 0 && compare_names(&list->item[list->count - 1], &v) == 0) {
    struct visible *last = &list->item[list->count - 1];
    last->topology += v.topology;
    last->amount += v.amount;
    return true;
  }
  return ARRAY_PUSH(list, v);
}

/* How many intervals, and at how many ends of the edge they end. */
static bool add_edges(visible_list *list, const struct trial *trial) {
  const struct map *map = &trial->map;
  const struct sheet *sheet = &trial->sheet;
  size_t mixed = 0;
  for (size_t e = 0; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    if (edge->edge_class == 0 || map->edge_state[e] == MAP_HIDDEN)
      continue;
    struct geom_segment s = sheet_ends(sheet, edge->point);
    double length = hypot(s.q.x - s.p.x, s.q.y - s.p.y) / SHEET_UNITS_PER_MM;
    struct visible v = name_edge(sheet, edge);
    double share = 1;
    if (map->edge_state[e] == MAP_MIXED) {
      while (map->mixed.item[mixed].edge < e)
        mixed++;
      const struct map_mixed *m = &map->mixed.item[mixed];
      const struct map_interval *part = map->interval.item + m->interval;
      share = 0;
      for (uint32_t i = 0; i < m->count; i++)
        share += ratio_to_double(part[i].t1) - ratio_to_double(part[i].t0);
      v.topology = (uint64_t)m->count << 8;
      v.topology += ratio_to_double(part[0].t0) == 0;
      v.topology += ratio_to_double(part[m->count - 1].t1) == 1;
    } else {
      v.topology = 1 << 8 | 2;
    }
    v.amount = share * length;
    if (!ARRAY_PUSH(list, v))
      return false;
  }
  return true;
}

/* A number for what runs along a side, the same in any sheet of the scene. */
static uint64_t number_side(const struct sheet *sheet,
                            const struct map_corner *corner) {
  uint64_t id = corner->id;
  if (corner->side == MAP_SIDE_EDGE || corner->side == MAP_SIDE_OCCLUDER) {
    struct visible v = name_edge(sheet, &sheet->edge.item[corner->id]);
    id = v.kind + 5 * (v.first + 0x1000193 * v.second);
  }
  return (id + 1) * 0x9e3779b97f4a7c15u + corner->side;
}

static bool add_faces(visible_list *list, const struct trial *trial) {
  const struct map *map = &trial->map;
  for (size_t f = 0; f < map->fragment.count; f++) {
    const struct map_fragment *fragment = &map->fragment.item[f];
    struct visible v = {.kind = OF_FACE, .first = fragment->face};
    v.amount = measure_fragment_area(map, f);
    v.topology = 0x51ed270b;
    for (uint32_t l = fragment->loop; l < fragment->loop + fragment->loops;
         l++) {
      const struct map_loop *loop = &map->loop.item[l];
      v.topology += 0x2545f4914f6cdd1du;
      for (uint32_t i = 0; i < loop->count; i++)
        v.topology +=
            number_side(&trial->sheet, &map->corner.item[loop->corner + i]);
    }
    if (!ARRAY_PUSH(list, v))
      return false;
  }
  return true;
}

/* All of a trial, by name, each once. */
static bool list_visible(visible_list *list, const struct trial *trial) {
  visible_list parts = {0};
  bool ok = add_edges(&parts, trial) && add_faces(&parts, trial);
  if (ok && parts.count > 0)
    qsort(parts.item, parts.count, sizeof *parts.item, compare_visible);
  for (size_t i = 0; ok && i < parts.count; i++)
    ok = add_visible(list, parts.item[i]);
  ARRAY_FREE(&parts);
  return ok;
}

/* ---- Comparing ----------------------------------------------------------- */

/* Adds what became of it, such as "edge 3-7 became visible". */
static void name_change(struct turn_change *change, const struct trial *trial,
                        const struct visible *was, const struct visible *is) {
  const struct visible *v = was != NULL ? was : is;
  const char *what = was == NULL  ? "became visible"
                     : is == NULL ? "became hidden"
                                  : "is seen in other parts";
  unsigned first = (unsigned)v->first, second = (unsigned)v->second;
  char name[128];
  if (v->kind == OF_EDGE)
    snprintf(name, sizeof name, "edge %u-%u",
             trial->topology.edge.item[first].point[0],
             trial->topology.edge.item[first].point[1]);
  else if (v->kind == OF_WIRE)
    snprintf(name, sizeof name, "segment %u of wire %u", second, first);
  else if (v->kind == OF_FACE)
    snprintf(name, sizeof name, "face %u", first);
  else
    snprintf(name, sizeof name, "the %s of faces %u and %u",
             v->kind == OF_DIAGONAL ? "diagonal" : "intersection", first,
             second);
  size_t used = strlen(change->named);
  snprintf(change->named + used, sizeof change->named - used, "%s%s %s",
           used > 0 ? "; " : "", name, what);
}

static void add_change(struct turn_change *change, const struct trial *trial,
                       const struct visible *was, const struct visible *is) {
  const struct visible *v = was != NULL ? was : is;
  double by =
      fabs((is != NULL ? is->amount : 0) - (was != NULL ? was->amount : 0));
  bool same = was != NULL && is != NULL && was->topology == is->topology;
  if (!same)
    name_change(change, trial, was, is);
  if (v->kind == OF_FACE) {
    change->area += by;
    change->same_area += same ? by : 0;
    change->faces += !same;
  } else {
    change->length += by;
    change->same_length += same ? by : 0;
    change->edges += !same;
  }
}

bool turn_compare(struct turn_change *change, const struct trial *before,
                  const struct trial *after) {
  visible_list was = {0}, is = {0};
  double length = 0, area = 0;
  memset(change, 0, sizeof *change);
  bool ok = list_visible(&was, before) && list_visible(&is, after);
  for (size_t i = 0, j = 0; ok && (i < was.count || j < is.count);) {
    int order = i == was.count  ? 1
                : j == is.count ? -1
                                : compare_names(&was.item[i], &is.item[j]);
    const struct visible *p = order <= 0 ? &was.item[i++] : NULL;
    const struct visible *q = order >= 0 ? &is.item[j++] : NULL;
    add_change(change, before, p, q);
    if (p != NULL && p->kind == OF_FACE)
      area += p->amount;
    else if (p != NULL)
      length += p->amount;
  }
  change->length /= length;
  change->same_length /= length;
  change->area /= area;
  change->same_area /= area;
  ARRAY_FREE(&was);
  ARRAY_FREE(&is);
  return ok;
}
