/* sheet.c - builds the scene's image on the page grid, phase by phase: see
 * layout.h. */
#include "view/sheet.h"

#include <string.h>

#include "view/layout.h"

static void free_layout(struct layout *layout) {
  mem_free(layout->point_map);
  mem_free(layout->outcode);
  mem_free(layout->sides);
  mem_free(layout->edge_cut);
  ARRAY_FREE(&layout->cut);
  ARRAY_FREE(&layout->flags);
  ARRAY_FREE(&layout->diagonal);
  ARRAY_FREE(&layout->fold);
  ARRAY_FREE(&layout->corner);
  triangulation_fini(&layout->triangulation);
}

recto_status sheet_init(struct sheet *sheet, const struct scene *scene,
                        struct topology *topology, const struct camera *camera,
                        const recto_options *options, bool outlines,
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
      .outlines = outlines,
      .projection = projection_of(camera),
      .error = error,
  };
  recto_status status = layout_points(&layout);
  if (status == RECTO_OK)
    status = layout_triangles(&layout);
  if (topology->brief)
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

void sheet_drop_triangles(struct sheet *sheet) {
  for (size_t e = 0; e < sheet->edge.count; e++) {
    uint32_t *triangle = sheet->edge.item[e].triangle;
    for (int k = 0; k < 2; k++)
      if (triangle[k] != SHEET_NONE)
        triangle[k] = sheet->triangle.item[triangle[k]].face;
  }
  sheet->edges_of_faces = true;
  ARRAY_FREE(&sheet->triangle);
  mem_free(sheet->triangle_flags);
  sheet->triangle_flags = NULL;
}

void sheet_fini(struct sheet *sheet) {
  ARRAY_FREE(&sheet->point);
  ARRAY_FREE(&sheet->triangle);
  ARRAY_FREE(&sheet->edge);
  ARRAY_FREE(&sheet->contour);
  mem_free(sheet->triangle_flags);
  memset(sheet, 0, sizeof *sheet);
}
