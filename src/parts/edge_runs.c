/* edge_runs.c - how many edges begin at the faces that a window owns. */
#include "parts/edge_runs.h"

#include "base/poll.h"

/* A run in progress. */
struct run_work {
  struct part *part;
  const struct part_sources *from;
  uint8_t *has_class; /* one a topology edge */
  bool goes_on;       /* the last run, with the next edge */
};

uint32_t edge_runs_first_side(const struct part_sources *from, uint32_t edge) {
  uint32_t face = from->topology->edge.item[edge].first;
  uint32_t start = scene_face_start(&from->scene->scene, face), side = start;
  while (from->topology->corner_edge[side] != edge)
    side++;
  return side - start;
}

/* Marks the edges of the topology that have a class on the sheet. */
static void mark_edges_of_class(struct run_work *work) {
  const struct sheet *sheet = work->from->sheet;
  for (size_t e = 0; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    if (edge->edge_class != 0 && edge->source != SHEET_NONE &&
        edge->edge_class != RECTO_EDGE_WIRE)
      work->has_class[edge->source] = 1;
  }
}

/* Adds the edges that begin at a face: those that no face before it has. */
static bool add_runs_of_face(struct run_work *work, uint32_t face) {
  const struct part_scene *scene = work->from->scene;
  const struct topology *topology = work->from->topology;
  const uint32_t start[2] = {scene_face_start(&scene->scene, face),
                             scene_face_start(&scene->scene, face + 1)};
  struct part *part = work->part;
  for (uint32_t i = start[0]; i < start[1]; i++) {
    uint32_t edge = topology->corner_edge[i], place = i - start[0];
    if (topology->edge.item[edge].first != face ||
        edge_runs_first_side(work->from, edge) != place)
      continue;
    const struct part_edge_run own = {scene->face_number[face], place,
                                      scene_face_group(&scene->scene, face), 1};
    if (work->goes_on && !work->has_class[edge])
      part->run.item[part->run.count - 1].count++;
    else if (!ARRAY_PUSH(&part->run, own))
      return false;
    work->goes_on = true;
  }
  return true;
}

/* Whether one face follows another in the model, and in its group. */
static bool face_follows(const struct part_scene *scene, uint32_t before,
                         uint32_t face) {
  const uint32_t *number = scene->face_number;
  return number[before] + 1 == number[face] &&
         scene_face_group(&scene->scene, before) ==
             scene_face_group(&scene->scene, face);
}

bool edge_runs_collect(struct part *part, const struct part_sources *from) {
  const struct part_scene *scene = from->scene;
  struct run_work work = {.part = part,
                          .from = from,
                          .has_class =
                              mem_calloc(from->topology->edge.count, 1)};
  bool ok = work.has_class != NULL;
  if (ok)
    mark_edges_of_class(&work);
  for (uint32_t f = 0; ok && f < scene_face_count(&scene->scene); f++) {
    bool is_owned = part_scene_owns(scene, &part->window, f);
    work.goes_on = work.goes_on && is_owned && face_follows(scene, f - 1, f);
    ok = poll_at(f) && (!is_owned || add_runs_of_face(&work, f));
  }
  mem_free(work.has_class);
  return ok;
}
