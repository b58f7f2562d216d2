/* layout_classes.c - finds the classes of edges that do not depend on the
 * camera, if any is requested, and the parts that sample no smooth surface. */
#include "scene/edges/coarse_parts.h"
#include "scene/edges/edge_classes.h"
#include "view/layout_phases.h"

/* Whether edges get their classes one by one, when they are chosen: nobody
 * needs those of all, and nearly all are smooth. */
static bool are_found_late(const struct layout *layout) {
  const struct topology *topology = layout->topology;
  const recto_options *options = layout->options;
  return topology->class_masks == NULL && topology->crease_mark == NULL &&
         options->mesh.crease_start_deg <= options->mesh.crease_deg &&
         options->ink.contours != RECTO_CONTOURS_SMOOTH;
}

/* Prepares that. */
static recto_status find_late(struct layout *layout) {
  struct topology *topology = layout->topology;
  if (topology->direction == NULL)
    topology->direction =
        face_directions_find(layout->scene, NULL, &topology->face_sizes);
  layout->class_masks =
      mem_calloc(topology->edge.count, sizeof *layout->class_masks);
  layout->filter = crease_filter_of(layout->scene, topology->direction,
                                    layout->options->mesh.crease_deg);
  return topology->direction != NULL && layout->class_masks != NULL
             ? RECTO_OK
             : error_memory(layout->error);
}

recto_status layout_classes(struct layout *layout) {
  struct topology *topology = layout->topology;
  const struct scene *scene = layout->scene;
  double crease_deg = layout->options->mesh.crease_deg;
  double start_deg = layout->options->mesh.crease_start_deg;
  if (!(layout->options->ink.edges & LAYOUT_FACE_CLASSES))
    return RECTO_OK;
  if (are_found_late(layout))
    return find_late(layout);
  uint8_t *masks = mem_alloc(topology->edge.count, sizeof *masks);
  layout->class_masks = masks;
  if (masks == NULL ||
      !topology_class_masks(topology, scene, crease_deg, masks) ||
      (start_deg > crease_deg &&
       !topology_drop_weak_creases(topology, scene, start_deg, masks)))
    return error_memory(layout->error);
  topology_drop_directions(topology);
  if (layout->options->ink.contours != RECTO_CONTOURS_SMOOTH)
    return RECTO_OK;
  layout->coarse = mem_alloc(scene->point.count, 1);
  return layout->coarse != NULL &&
                 topology_coarse_parts(topology, scene, masks, layout->coarse)
             ? RECTO_OK
             : error_memory(layout->error);
}
