/* layout_classes.c - finds the classes of edges that do not depend on the
 * camera, if any is requested, and the parts that sample no smooth surface. */
#include "scene/coarse_parts.h"
#include "scene/edge_classes.h"
#include "view/layout_phases.h"

recto_status layout_classes(struct layout *layout) {
  struct topology *topology = layout->topology;
  const struct scene *scene = layout->scene;
  double crease_deg = layout->options->mesh.crease_deg;
  double start_deg = layout->options->mesh.crease_start_deg;
  if (!(layout->options->ink.edges & LAYOUT_FACE_CLASSES))
    return RECTO_OK;
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
