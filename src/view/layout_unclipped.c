/* layout_unclipped.c - makes the sheet's triangles of faces that need neither
 * triangulation nor clipping, one after the other. */
#include "view/layout_unclipped.h"

#include "base/memory.h"
#include "view/layout_clipping.h"

/* As layout_unclipped_faces, to an end of the arrays of triangles. */
static inline uint32_t add_unclipped_faces(struct layout *layout,
                                           struct layout_triangle_sink *to,
                                           uint32_t face, uint32_t end) {
  enum { AHEAD = 3 * MEM_PREFETCH_AHEAD };
  const struct scene *scene = layout->scene;
  const uint32_t *own = scene->corner.item;
  const uint32_t *corner_edge = layout->topology->corner_edge;
  struct layout_triangle_sink sink = *to; /* in registers */
  const size_t corners = scene->corner.count;
  for (; face < end && sink.remaining > 0; face++) {
    uint32_t c = scene_face_start(scene, face), corner[3], point[3];
    for (uint32_t k = c; k < c + 3 && k + AHEAD < corners; k++)
      MEM_PREFETCH(&sink.point[layout_sheet_point(layout, own[k + AHEAD])]);
    if (scene_face_start(scene, face + 1) - c != 3 ||
        !layout_welded_corners(corner, own + c, layout->topology->weld))
      break;
    for (int k = 0; k < 3; k++)
      point[k] = layout_sheet_point(layout, corner[k]);
    if (point[0] == SHEET_NONE || point[1] == SHEET_NONE ||
        point[2] == SHEET_NONE)
      break;
    const uint32_t *edge = corner_edge + c;
    int sign = geom_sign64(layout_sink_triangle(&sink, face, point, edge));
    layout_record_edge(layout, edge[0], corner[0] < corner[1], sign);
    layout_record_edge(layout, edge[1], corner[1] < corner[2], sign);
    layout_record_edge(layout, edge[2], corner[2] < corner[0], sign);
  }
  *to = sink;
  return face;
}

uint32_t layout_unclipped_faces(struct layout *layout, uint32_t face,
                                uint32_t end) {
  if (face == end || scene_face_corners(layout->scene, face) != 3)
    return face;
  struct layout_triangle_sink sink = layout_sink_of(layout);
  face = add_unclipped_faces(layout, &sink, face, end);
  layout_sink_close(layout, &sink);
  return face;
}
