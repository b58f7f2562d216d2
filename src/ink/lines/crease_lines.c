/* crease_lines.c - joins creases to lines, and finds how sharp they are. */
#include "ink/lines/crease_lines.h"

#include <math.h>
#include <string.h>

#include "base/parallel.h"
#include "base/union_find.h"
#include "scene/angle.h"
#include "scene/crease_marks.h"
#include "scene/newell_normal.h"

/* Faces of more corners have their normals kept. */
enum { SMALL_FACE_MAX = 16 };

static void find_normal(const struct scene *scene, uint32_t face,
                        struct large_face_normals *normals, double normal[3]) {
  if (scene_face_corners(scene, face) <= SMALL_FACE_MAX) {
    newell_normal_of_face(scene, face, normal);
    return;
  }
  int k = normals->last;
  if (normals->face[k] != face)
    k = 1 - k;
  if (normals->face[k] != face) {
    newell_normal_of_face(scene, face, normals->normal[k]);
    normals->face[k] = face;
  }
  normals->last = k;
  memcpy(normal, normals->normal[k], sizeof normals->normal[k]);
}

static int mark_of_edge(const struct sheet *sheet,
                        const struct sheet_edge *edge) {
  return sheet->topology != NULL && sheet->topology->crease_mark != NULL &&
                 edge->source != SHEET_NONE
             ? sheet->topology->crease_mark[edge->source]
             : CREASE_MARK_NONE;
}

double crease_cosine(const struct sheet *sheet, const struct sheet_edge *edge,
                     struct large_face_normals *normals) {
  double n[2][3], dot = 0, square[2] = {0, 0};
  if ((edge->edge_class & (RECTO_EDGE_CREASE | RECTO_EDGE_SILHOUETTE)) == 0)
    return 1;
  switch (mark_of_edge(sheet, edge)) {
  case CREASE_MARK_HARD:
    return -1;
  case CREASE_MARK_SOFT:
    return 1;
  default:
    break;
  }
  for (int k = 0; k < 2; k++) {
    uint32_t face = edge->triangle[k];
    if (face == SHEET_NONE)
      return 1;
    if (!sheet->triangles_dropped)
      face = sheet->triangle.item[face].face;
    find_normal(sheet->scene, face, normals, n[k]);
  }
  for (int i = 0; i < 3; i++) {
    dot += n[0][i] * n[1][i];
    square[0] += n[0][i] * n[0][i];
    square[1] += n[1][i] * n[1][i];
  }
  double lengths = sqrt(square[0] * square[1]);
  return lengths > 0 ? dot / lengths : -1;
}

struct crease_marks {
  const struct sheet *sheet;
  double crease;
  uint8_t *is_joined; /* one an edge */
};

static bool mark_joined_of_range(void *user, struct parallel_range range) {
  const struct crease_marks *marks = user;
  struct large_face_normals normals = large_face_normals_start();
  for (size_t e = range.begin; e < range.end; e++) {
    const struct sheet_edge *edge = &marks->sheet->edge.item[e];
    marks->is_joined[e] = crease_is_joined(
        edge, crease_cosine(marks->sheet, edge, &normals), marks->crease);
  }
  return true;
}

uint32_t *crease_lines_create(const struct sheet *sheet, double crease_deg) {
  size_t count = sheet->edge.count;
  uint32_t *line = union_find_create(sheet->point.count);
  struct crease_marks marks = {sheet, angle_of_degrees(crease_deg).cosine,
                               mem_alloc(count, 1)};
  bool ok = line != NULL && marks.is_joined != NULL &&
            parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                            PARALLEL_ITEMS, mark_joined_of_range, &marks);
  for (size_t e = 0; ok && e < count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    (void)poll_at(e);
    if (marks.is_joined[e])
      union_find_join(line, edge->point[0], edge->point[1]);
  }
  mem_free(marks.is_joined);
  if (ok)
    return line;
  mem_free(line);
  return NULL;
}
