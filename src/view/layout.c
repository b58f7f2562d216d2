/* layout.c - projects a scene to a sheet by running the phases of
 * layout_phases.h one after the other. */
#include "view/layout.h"

#include <string.h>

#include "view/layout_phases.h"

static void free_layout(struct layout *layout) {
  mem_free(layout->point_map);
  mem_free(layout->outcode);
  mem_free(layout->sides);
  mem_free(layout->edge_clipped);
  ARRAY_FREE(&layout->clipped);
  ARRAY_FREE(&layout->flags);
  ARRAY_FREE(&layout->clipped_ends.list);
  mem_free(layout->clipped_ends.slot);
  ARRAY_FREE(&layout->diagonal);
  ARRAY_FREE(&layout->part);
  ARRAY_FREE(&layout->fold);
  ARRAY_FREE(&layout->corner);
  triangulation_fini(&layout->triangulation);
}

recto_status layout_sheet(struct sheet *sheet, const struct scene *scene,
                          struct topology *topology,
                          const struct camera *camera,
                          const recto_options *options, bool all_edges,
                          recto_error *error) {
  memset(sheet, 0, sizeof *sheet);
  sheet->camera = *camera;
  sheet->scene = scene;
  sheet->face_group = scene->face_group.item;
  sheet->topology = topology;
  struct layout layout = {
      .sheet = sheet,
      .scene = scene,
      .topology = topology,
      .options = options,
      .all_edges = all_edges,
      .projection = projection_of(camera),
      .error = error,
  };
  recto_status status = layout_points(&layout);
  if (status == RECTO_OK)
    status = layout_triangles(&layout);
  if (topology->drop_after_sheet)
    topology_drop_corners(topology);
  if (status == RECTO_OK)
    status = layout_edges(&layout);
  if (status == RECTO_OK)
    status = layout_wires(&layout);
  if (status == RECTO_OK) {
    sheet->triangle_flags = layout.flags.item;
    layout.flags.item = NULL;
  } else {
    sheet_fini(sheet);
  }
  free_layout(&layout);
  return status;
}
