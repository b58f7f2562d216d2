/* newell_piece.c - the sides and the shapes of pieces. */
#include "visibility/newell/newell_piece.h"

struct geom_line *newell_piece_lines(const struct newell_order *order,
                                     uint32_t piece, int *count,
                                     struct arena *arena) {
  const struct newell_piece *p = &order->piece.item[piece];
  size_t n = p->shape == NULL ? 3 : p->shape->count;
  struct geom_line *line = arena_alloc(arena, 2 * n, sizeof *line);
  *count = (int)n;
  if (line == NULL)
    return NULL;
  if (p->shape == NULL) {
    triangle_lines(order->sheet, p->triangle, line, line + n);
    return line;
  }
  for (size_t k = 0; k < n; k++) {
    line[k] = *p->shape->side[k];
    line[n + k] = geom_line_reversed(&line[k]);
  }
  return line;
}

bool newell_piece_shape(struct newell_order *order, uint32_t piece,
                        struct geom_convex *shape) {
  const struct newell_piece *p = &order->piece.item[piece];
  struct geom_line *line;
  int count;
  if (p->shape != NULL) {
    *shape = *p->shape;
    return true;
  }
  line = newell_piece_lines(order, piece, &count, &order->scratch);
  return line != NULL &&
         geom_convex_triangle(shape, sheet_corners(order->sheet, p->triangle).p,
                              line, &order->scratch);
}
