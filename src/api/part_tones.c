/* part_tones.c - the tones of tone hatching for the faces of a part.
 *
 * Phases
 *   whole   all faces of the model, in a pass over it
 *   tones   as ink finds them for an undivided drawing, by the same code
 *   select  those of the part's faces; the rest is dropped */
#include "api/part_tones.h"

#include <string.h>

#include "scene/topology/topology.h"

bool part_tones_are_wanted(const recto_options *options) {
  const double *light = options->ink.light;
  return options->ink.fill == RECTO_FILL_HATCH &&
         (light[0] != 0 || light[1] != 0 || light[2] != 0);
}

/* The tones of one face after the other; where a part has it, they are kept. */
static void select_tones(struct part_tones *to, const struct part_scene *part,
                         const struct tones *tones, const struct picked *all) {
  const struct scene *scene = &part->scene;
  uint32_t face = 0;
  for (uint32_t f = 0; f < scene_face_count(scene); f++) {
    uint32_t start = scene_face_start(scene, f);
    while (all->face_number.item[face] < part->face_number[f])
      face++;
    to->uniform[f] = tones->uniform[face];
    memcpy(to->corner + start,
           tones->corner + scene_face_start(&all->scene, face),
           (scene_face_start(scene, f + 1) - start) * sizeof *to->corner);
  }
}

recto_status part_tones_of_whole(struct tones *tones, const struct scene *whole,
                                 const uint8_t *mark,
                                 const struct camera *camera,
                                 const recto_options *options,
                                 recto_error *error) {
  struct topology topology = {.corner_edge = NULL};
  recto_status status = topology_init(&topology, whole, error);
  if (status == RECTO_OK && !side_marks_apply(mark, &topology, whole))
    status = error_memory(error);
  const struct sheet sheet = {.camera = *camera, .topology = &topology};
  if (status == RECTO_OK && !tones_init(tones, &sheet, whole, options))
    status = error_memory(error);
  topology_fini(&topology);
  return status;
}

recto_status part_tones_find(struct part_tones *tones,
                             const struct part_scene *part,
                             const struct face_source *source,
                             const struct side_marks *marks,
                             const struct camera *camera,
                             const recto_options *options, recto_error *error) {
  const struct scene *scene = &part->scene;
  struct face_pick all = {.source = *source, .picks_all = true};
  struct tones of_whole = {.corner = NULL};
  tones->corner = mem_alloc(scene->corner.count, sizeof *tones->corner);
  tones->uniform = mem_alloc(scene_face_count(scene), 1);
  recto_status status = tones->corner != NULL && tones->uniform != NULL
                            ? face_pick_pass(&all, error)
                            : error_memory(error);
  if (status == RECTO_OK) {
    const struct scene whole = face_pick_scene(&all);
    uint8_t *mark =
        side_marks_select(marks, &whole, all.picked.face_number.item);
    status = mark != NULL ? part_tones_of_whole(&of_whole, &whole, mark, camera,
                                                options, error)
                          : error_memory(error);
    mem_free(mark);
  }
  if (status == RECTO_OK)
    select_tones(tones, part, &of_whole, &all.picked);
  tones_fini(&of_whole);
  face_pick_fini(&all);
  return status;
}

void part_tones_fini(struct part_tones *tones) {
  mem_free(tones->corner);
  mem_free(tones->uniform);
  *tones = (struct part_tones){.corner = NULL};
}
