/* sheet.c - frees a sheet, or its triangles alone. */
#include "view/sheet.h"

#include <string.h>

void sheet_drop_triangles(struct sheet *sheet) {
  for (size_t e = 0; e < sheet->edge.count; e++) {
    uint32_t *triangle = sheet->edge.item[e].triangle;
    for (int k = 0; k < 2; k++)
      if (triangle[k] != SHEET_NONE)
        triangle[k] = sheet->triangle.item[triangle[k]].face;
  }
  sheet->triangles_dropped = true;
  ARRAY_FREE(&sheet->triangle);
  mem_free(sheet->triangle_flags);
  sheet->triangle_flags = NULL;
}

void sheet_fini(struct sheet *sheet) {
  ARRAY_FREE(&sheet->point);
  ARRAY_FREE(&sheet->triangle);
  ARRAY_FREE(&sheet->edge);
  ARRAY_FREE(&sheet->contour);
  ARRAY_FREE(&sheet->face_error);
  mem_free(sheet->triangle_flags);
  memset(sheet, 0, sizeof *sheet);
}
