/* folded_faces.c - finds warped faces by the diagonals that are silhouettes,
 * and their triangles by the images of their corners. */
#include "visibility/zero_set/folded_faces.h"

bool folded_faces_is_diagonal(const struct sheet *sheet,
                              const struct sheet_edge *edge) {
  return edge->source == SHEET_NONE && edge->edge_class == 0 &&
         edge->triangle[0] != SHEET_NONE && edge->triangle[1] != SHEET_NONE &&
         sheet->triangle.item[edge->triangle[0]].face ==
             sheet->triangle.item[edge->triangle[1]].face;
}

bool folded_faces_mark(struct folded_faces *f) {
  const struct sheet *sheet = f->sheet;
  for (uint32_t e = 0; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    if (!folded_faces_is_diagonal(sheet, edge))
      continue;
    if (f->is_folded == NULL)
      f->is_folded = mem_calloc(scene_face_count(sheet->scene), 1);
    if (f->is_folded == NULL)
      return false;
    f->is_folded[sheet->triangle.item[edge->triangle[0]].face] = 1;
  }
  return true;
}

void folded_faces_fini(struct folded_faces *f) { mem_free(f->is_folded); }

static bool has_corner(const struct geom_triangle *t, struct geom_point p) {
  return geom_same_point(t->p[0], p) || geom_same_point(t->p[1], p) ||
         geom_same_point(t->p[2], p);
}

unsigned folded_faces_sign(const struct folded_faces *f, uint32_t face,
                           struct geom_segment side) {
  const struct sheet *sheet = f->sheet;
  for (size_t t = first_triangle_of_face(sheet, face);
       t < sheet->triangle.count && sheet->triangle.item[t].face == face; t++) {
    struct geom_triangle of = sheet_corners(sheet, t);
    if (has_corner(&of, side.p) && has_corner(&of, side.q))
      return sheet_is_edge_on(sheet, t)                        ? 0
             : (sheet->triangle_flags[t] & SHEET_FLIPPED) != 0 ? FACING_BACK
                                                               : FACING_FRONT;
  }
  return 0;
}
