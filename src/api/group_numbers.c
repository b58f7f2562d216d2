/* group_numbers.c - numbers faces and edges within their groups, and within the
 * scene. */
#include "api/group_numbers.h"

#include "base/poll.h"

/* The numbers of all faces, mesh edges and polylines. */
struct group_numbers {
  uint32_t *face, *edge, *wire;
  size_t faces, edges, wires;
};

/* Numbers the faces; `next` has a 0 for each group. */
static void number_group_faces(struct group_numbers *numbers,
                               const struct scene *scene, uint32_t *next) {
  for (uint32_t f = 0; f < numbers->faces && poll_at(f); f++) {
    uint32_t group = scene_face_group(scene, f);
    if (f > 0 && group == scene_face_group(scene, f - 1))
      next[group] +=
          scene_face_number(scene, f) - scene_face_number(scene, f - 1) - 1;
    numbers->face[f] = next[group]++;
  }
}

static bool allocate_numbers(struct group_numbers *numbers,
                             const struct scene *whole,
                             const struct topology *topology) {
  *numbers = (struct group_numbers){
      .faces = scene_face_count(whole),
      .edges = topology != NULL ? topology->edge.count : 0,
      .wires = whole->wire_group.count};
  numbers->face = mem_alloc(numbers->faces, sizeof *numbers->face);
  numbers->edge = mem_alloc(numbers->edges, sizeof *numbers->edge);
  numbers->wire = mem_alloc(numbers->wires, sizeof *numbers->wire);
  return numbers->face != NULL && numbers->edge != NULL &&
         numbers->wire != NULL;
}

static bool make_numbers(struct group_numbers *numbers,
                         const struct scene *scene, const struct scene *whole,
                         const struct topology *topology) {
  size_t groups = scene->group.count > whole->group.count ? scene->group.count
                                                          : whole->group.count;
  uint32_t *next = mem_calloc(groups, 3 * sizeof *next);
  bool ok = allocate_numbers(numbers, whole, topology) && next != NULL;
  uint32_t *next_edge = next + groups;
  uint32_t *next_wire = next_edge + groups;
  if (ok)
    number_group_faces(numbers, whole, next);
  for (uint32_t e = 0; ok && e < numbers->edges && poll_at(e); e++) {
    uint32_t face = topology->edge.item[e].first;
    numbers->edge[e] = next_edge[scene_face_group(scene, face)]++;
  }
  for (uint32_t w = 0; ok && w < numbers->wires && poll_at(w); w++)
    numbers->wire[w] = next_wire[whole->wire_group.item[w]]++;
  mem_free(next);
  return ok;
}

/* The face of the whole scene that a face of the drawn one is a part of. */
static uint32_t whole_face(const struct scene *scene, uint32_t face) {
  if (scene->cut == NULL || face == DRAWING_NONE)
    return face;
  return face < scene->cut->first_face ? scene->cut->face[face] : DRAWING_NONE;
}

static uint32_t whole_wire(const struct scene *scene, uint32_t wire) {
  bool is_whole = scene->cut == NULL || wire == DRAWING_NONE;
  return is_whole ? wire : scene->cut->wire[wire];
}

static uint32_t number_at(const uint32_t *number, size_t count, uint32_t at) {
  return at < count ? number[at] : DRAWING_NONE;
}

bool group_numbers_set(struct drawing *drawing, const struct scene *scene,
                       const struct scene *whole,
                       const struct topology *topology) {
  struct group_numbers numbers;
  bool ok = make_numbers(&numbers, scene, whole, topology) &&
            ARRAY_RESERVE(&drawing->stroke_source, drawing->stroke.count) &&
            ARRAY_RESERVE(&drawing->fill_source, drawing->fill.count);
  for (size_t i = 0; ok && i < drawing->stroke.count; i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    bool is_wire = stroke->edge_class == RECTO_EDGE_WIRE;
    struct drawing_source source = {
        number_at(numbers.face, numbers.faces, whole_face(scene, stroke->face)),
        is_wire ? number_at(numbers.wire, numbers.wires,
                            whole_wire(scene, stroke->edge))
                : number_at(numbers.edge, numbers.edges, stroke->edge)};
    drawing->stroke_source.item[drawing->stroke_source.count++] = source;
  }
  for (size_t i = 0; ok && i < drawing->fill.count; i++)
    drawing->fill_source.item[drawing->fill_source.count++] =
        (struct drawing_source){
            number_at(numbers.face, numbers.faces,
                      whole_face(scene, drawing->fill.item[i].face)),
            DRAWING_NONE};
  mem_free(numbers.face);
  mem_free(numbers.edge);
  mem_free(numbers.wire);
  return ok;
}

/* ---- Within the scene ---------------------------------------------------- */

void source_numbers_set(struct drawing *drawing, const struct scene *scene) {
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    struct drawing_stroke *stroke = &drawing->stroke.item[i];
    uint32_t *face = &stroke->face;
    *face = *face == DRAWING_NONE ? *face : scene_face_number(scene, *face);
    if (stroke->edge_class == RECTO_EDGE_WIRE && scene->cut != NULL)
      stroke->edge = scene->cut->wire[stroke->edge];
  }
  for (size_t i = 0; i < drawing->fill.count; i++) {
    uint32_t *face = &drawing->fill.item[i].face;
    *face = *face == DRAWING_NONE ? *face : scene_face_number(scene, *face);
  }
}
