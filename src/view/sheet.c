/* sheet.c - frees a sheet, or its triangles alone. */
#include "view/sheet.h"

#include <string.h>

#include "base/parallel.h"

static bool name_faces_of_range(void *user, struct parallel_range range) {
  struct sheet *sheet = user;
  for (size_t e = range.begin; e < range.end; e++) {
    uint32_t *triangle = sheet->edge.item[e].triangle;
    for (int k = 0; k < 2; k++)
      if (triangle[k] != SHEET_NONE)
        triangle[k] = sheet->triangle.item[triangle[k]].face;
  }
  return true;
}

bool sheet_drop_triangles(struct sheet *sheet) {
  size_t edges = sheet->edge.count;
  if (!sheet->triangles_are_faces &&
      !parallel_ranges(parallel_workers(edges, PARALLEL_ITEMS), edges,
                       PARALLEL_ITEMS, name_faces_of_range, sheet))
    return false;
  sheet->triangles_dropped = true;
  ARRAY_FREE(&sheet->triangle);
  ARRAY_FREE(&sheet->sides);
  mem_free(sheet->triangle_flags);
  mem_free(sheet->triangle_error);
  sheet->triangle_flags = NULL;
  return true;
}

size_t sheet_count_requested(const struct sheet *sheet) {
  size_t count = 0;
  for (size_t e = 0; e < sheet->edge.count; e++)
    count += sheet->edge.item[e].edge_class != 0;
  return count;
}

void sheet_fini(struct sheet *sheet) {
  ARRAY_FREE(&sheet->point);
  ARRAY_FREE(&sheet->triangle);
  ARRAY_FREE(&sheet->sides);
  ARRAY_FREE(&sheet->edge);
  ARRAY_FREE(&sheet->edge_group);
  ARRAY_FREE(&sheet->contour);
  ARRAY_FREE(&sheet->face_error);
  mem_free(sheet->triangle_flags);
  memset(sheet, 0, sizeof *sheet);
}
