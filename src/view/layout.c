/* layout.c - projects a scene to a sheet by running the phases of
 * layout_phases.h one after the other. */
#include "view/layout.h"

#include <string.h>

#include "view/layout_face_ranges.h"

void layout_free_face(struct layout *layout) {
  ARRAY_FREE(&layout->diagonal);
  ARRAY_FREE(&layout->part);
  ARRAY_FREE(&layout->whole);
  ARRAY_FREE(&layout->corner);
  triangulation_fini(&layout->triangulation);
}

static void free_layout(struct layout *layout) {
  layout_free_face(layout);
  mem_free(layout->point_map);
  mem_free(layout->outcode);
  mem_free(layout->sides);
  mem_free(layout->class_masks);
  mem_free(layout->coarse);
  mem_free(layout->ids.bits);
  mem_free(layout->ids.before);
  layout_free_face_ranges(layout);
  mem_free(layout->edge_clipped);
  ARRAY_FREE(&layout->clipped);
  ARRAY_FREE(&layout->flags);
  ARRAY_FREE(&layout->clipped_ends.list);
  mem_free(layout->clipped_ends.slot);
  ARRAY_FREE(&layout->fold);
}

/* Gives the memory of the topology's edges to the triangles, which need about
 * as much: the system need not clear new pages for them.  False when memory ran
 * out. */
static bool reuse_edges(struct layout *layout) {
  struct topology *topology = layout->topology;
  struct sheet *sheet = layout->sheet;
  size_t count = layout->flags.count > 0 ? layout->flags.count : 1;
  if (!topology->drop_edges || topology->edge.item == NULL)
    return true;
  void *block =
      mem_resize(topology->edge.item, count, sizeof *sheet->triangle.item);
  if (block == NULL)
    return false;
  memset(&topology->edge, 0, sizeof topology->edge);
  sheet->triangle.item = block;
  sheet->triangle.capacity = count;
  return true;
}

/* Makes the triangles that were left out before there were edges; what they do
 * not need is freed first. */
static recto_status make_late_triangles(struct layout *layout) {
  mem_free(layout->sides);
  mem_free(layout->class_masks);
  mem_free(layout->outcode);
  layout->sides = layout->class_masks = layout->outcode = NULL;
  bool ok = reuse_edges(layout) && layout_make_all_triangles(layout);
  layout_free_face_ranges(layout);
  return ok ? RECTO_OK : error_memory(layout->error);
}

/* Runs the phases. */
static recto_status run_phases(struct layout *layout) {
  recto_status status = RECTO_OK;
  if (layout->scene->face_start.count > 0 &&
      !topology_find_corners(layout->topology, layout->scene))
    status = error_memory(layout->error);
  if (status == RECTO_OK)
    status = layout_classes(layout);
  if (status == RECTO_OK)
    status = layout_points(layout);
  if (status == RECTO_OK)
    status = layout_triangles(layout);
  bool late = layout->face_range != NULL;
  if ((!late || layout->leaves_out_sides) && layout->topology->drop_corners)
    topology_drop_corners(layout->topology);
  if (status == RECTO_OK)
    status = layout_edges(layout);
  if (status == RECTO_OK)
    status = layout_wires(layout);
  if (status == RECTO_OK && late)
    status = make_late_triangles(layout);
  if (layout->topology->drop_corners)
    topology_drop_corners(layout->topology);
  return status;
}

recto_status layout_sheet(struct sheet *sheet, const struct scene *scene,
                          struct topology *topology,
                          const struct camera *camera,
                          const recto_options *options, bool all_edges,
                          recto_error *error) {
  memset(sheet, 0, sizeof *sheet);
  sheet->camera = *camera;
  sheet->scene = scene;
  sheet->face_group =
      scene->face_group.count > 0 ? scene->face_group.item : NULL;
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
  recto_status status = run_phases(&layout);
  if (status == RECTO_OK) {
    sheet->triangle_flags = layout.flags.item;
    layout.flags.item = NULL;
  } else {
    sheet_fini(sheet);
  }
  free_layout(&layout);
  return status;
}
