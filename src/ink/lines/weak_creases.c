/* weak_creases.c - finds the creases that end free and are nowhere sharp.
 *
 * A rounded part of a mesh bends by about the crease angle at many edges, some
 * of which exceed it: lines that start and end anywhere.  What joins edges is
 * the mesh: it does not matter what of them is seen, nor that some of them are
 * silhouettes in this view. */
#include "ink/lines/paths.h"

#include <math.h>

#include "base/poll.h"
#include "base/union_find.h"
#include "scene/angle.h"
#include "scene/newell_normal.h"

/* The cosine of the angle between the two faces of an edge that is drawn as a
 * crease or a silhouette; 1 where it has other faces than two.  Faces that run
 * the same way along it count as bent sharply. */
static double cosine_of_bend(const struct sheet *sheet,
                             const struct sheet_edge *edge) {
  double n[2][3], dot = 0, square[2] = {0, 0};
  if ((edge->edge_class & (RECTO_EDGE_CREASE | RECTO_EDGE_SILHOUETTE)) == 0)
    return 1;
  for (int k = 0; k < 2; k++) {
    uint32_t face = edge->triangle[k];
    if (face == SHEET_NONE)
      return 1;
    if (!sheet->triangles_dropped)
      face = sheet->triangle.item[face].face;
    newell_normal_of_face(sheet->scene, face, n[k]);
  }
  for (int i = 0; i < 3; i++) {
    dot += n[0][i] * n[1][i];
    square[0] += n[0][i] * n[0][i];
    square[1] += n[1][i] * n[1][i];
  }
  double lengths = sqrt(square[0] * square[1]);
  return lengths > 0 ? dot / lengths : -1;
}

bool paths_find_weak(struct ink_paths *paths, const struct segment_graph *graph,
                     const struct sheet *sheet, double crease_deg,
                     double start_deg) {
  size_t candidates = 0;
  if (start_deg == 0 || sheet->scene == NULL)
    return true;
  for (size_t i = 0; i < paths->path.count; i++) {
    struct ink_path *path = &paths->path.item[i];
    path->is_weak = path->is_free && path->classes == RECTO_EDGE_CREASE;
    candidates += path->is_weak;
  }
  if (candidates == 0)
    return true;
  double crease = angle_of_degrees(crease_deg).cosine;
  double start = angle_of_degrees(start_deg).cosine;
  uint32_t *line = union_find_create(sheet->point.count);
  uint8_t *is_sharp = mem_calloc(sheet->point.count, 1);
  bool ok = line != NULL && is_sharp != NULL;
  for (size_t e = 0; ok && e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    double cosine = cosine_of_bend(sheet, edge);
    (void)poll_at(e);
    if (cosine < crease || edge->edge_class == RECTO_EDGE_CREASE)
      union_find_join(line, edge->point[0], edge->point[1]);
    if (cosine < start)
      is_sharp[edge->point[0]] = 1;
  }
  for (uint32_t p = 0; ok && p < sheet->point.count; p++)
    if (is_sharp[p])
      is_sharp[union_find_root(line, p)] = 1;
  for (size_t i = 0; ok && i < paths->path.count; i++) {
    struct ink_path *path = &paths->path.item[i];
    for (int k = 0; k < 2 && path->is_weak; k++) {
      uint32_t edge = graph->segment.item[path->end[k] >> 1].edge;
      uint32_t point = sheet->edge.item[edge].point[0];
      path->is_weak = !is_sharp[union_find_root(line, point)];
    }
  }
  mem_free(line);
  mem_free(is_sharp);
  return ok;
}
