/* sheet.c - builds the scene's image on the page grid, phase by phase: see
 * build.h. */
#include "view/sheet.h"

#include <string.h>

#include "view/build.h"

static void free_build(struct build *build) {
  mem_free(build->point_map);
  mem_free(build->outcode);
  mem_free(build->sides);
  mem_free(build->edge_cut);
  ARRAY_FREE(&build->cut);
  ARRAY_FREE(&build->flags);
  ARRAY_FREE(&build->diagonal);
  triangulation_fini(&build->triangulation);
}

recto_status sheet_init(struct sheet *sheet, const struct scene *scene,
                        const struct topology *topology,
                        const struct camera *camera,
                        const recto_options *options, bool outlines,
                        recto_error *error) {
  memset(sheet, 0, sizeof *sheet);
  sheet->camera = *camera;
  sheet->face_group = scene->face_group.item;
  struct build build = {
      .sheet = sheet,
      .scene = scene,
      .topology = topology,
      .options = options,
      .outlines = outlines,
      .projection = projection_of(camera),
      .error = error,
  };
  sheet->z_scale = build.projection.z_scale;
  sheet->units_per_view = build.projection.units;
  recto_status status = build_points(&build);
  if (status == RECTO_OK)
    status = build_triangles(&build);
  if (status == RECTO_OK)
    status = build_edges(&build);
  if (status == RECTO_OK)
    status = build_wires(&build);
  if (status == RECTO_OK) {
    sheet->triangle_flags = build.flags.item;
    build.flags.item = NULL;
  } else {
    sheet_fini(sheet);
  }
  free_build(&build);
  return status;
}

void sheet_fini(struct sheet *sheet) {
  ARRAY_FREE(&sheet->point);
  ARRAY_FREE(&sheet->triangle);
  ARRAY_FREE(&sheet->edge);
  ARRAY_FREE(&sheet->contour);
  mem_free(sheet->triangle_flags);
  memset(sheet, 0, sizeof *sheet);
}
