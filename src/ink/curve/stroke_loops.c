/* stroke_loops.c - finds the crossings of a stroke with itself that its curve
 * has not, and those that only the curve has. */
#include "ink/curve/stroke_loops.h"

#include <math.h>

#include "base/sort.h"

/* The chords of a curve's piece. */
enum { CHORDS = 32 };

/* The crossing of a stroke and that of its curve are the same if they are no
 * farther apart, as a multiple of the tolerance. */
#define SAME_TOLERANCES 2

static struct drawing_point point_at_share(const struct drawing_point p[4],
                                           double t) {
  struct drawing_point a = drawing_point_between(p[0], p[1], t);
  struct drawing_point b = drawing_point_between(p[1], p[2], t);
  struct drawing_point c = drawing_point_between(p[2], p[3], t);
  return drawing_point_between(drawing_point_between(a, b, t),
                               drawing_point_between(b, c, t), t);
}

static bool list_vertices(struct own_crossings *own,
                          const struct stroke_shape *shape) {
  own->line.count = 0;
  for (size_t i = 0; i < shape->vertex.count; i++) {
    const struct stroke_vertex *v = &shape->vertex.item[i];
    if (!ARRAY_PUSH(&own->line, ((struct own_point){v->at, v->along})))
      return false;
  }
  return true;
}

/* Lists the chords of the pieces. */
static bool list_chords(struct own_crossings *own,
                        const struct part_fit *pieces, size_t control) {
  const struct drawing_point *p = &pieces->drawing->control.item[control];
  double from = 0;
  own->line.count = 0;
  if (!ARRAY_PUSH(&own->line, ((struct own_point){p[0], 0})))
    return false;
  for (size_t i = 0; i < pieces->along.count; i++, p += 3) {
    double to = pieces->along.item[i];
    int chords = drawing_piece_is_straight(p) ? 1 : CHORDS;
    for (int k = 1; k <= chords; k++) {
      double t = k / (double)chords;
      struct own_point made = {k < chords ? point_at_share(p, t) : p[3],
                               from + t * (to - from)};
      if (!ARRAY_PUSH(&own->line, made))
        return false;
    }
    from = to;
  }
  return true;
}

/* Makes vertices within a distance along the shape corners, at least the ends
 * of the side there. */
static void keep_vertices(struct stroke_shape *shape, double along,
                          double about) {
  struct stroke_vertex *v = shape->vertex.item;
  size_t from = 0, last = shape->vertex.count - 1, to;
  LOWER_BOUND(from, 0, last, v[from + 1].along < along - about);
  for (to = from; to < last && v[to].along <= along + about; to++) {
    v[to].corner = true;
    v[to].straight = true;
  }
  v[to].corner = true;
  if (shape->closed)
    v[0].corner = v[last].corner = v[0].corner || v[last].corner;
  shape->ring = false;
}

static void keep_crossings(struct stroke_shape *shape,
                           const struct own_crossings *own, double about) {
  for (size_t i = 0; i < own->crossing.count; i++)
    for (int k = 0; k < 2; k++)
      keep_vertices(shape, own->crossing.item[i].along[k], about);
}

bool stroke_loops_keep(struct stroke_loops *loops, struct stroke_shape *shape,
                       const struct part_fit *pieces, size_t control,
                       double about, bool *same) {
  struct own_crossings *a = &loops->of_stroke, *b = &loops->of_pieces;
  if (!list_vertices(a, shape) || !list_chords(b, pieces, control) ||
      !own_crossings_find(a) || !own_crossings_find(b) ||
      !own_crossings_remove_common(a, b, SAME_TOLERANCES * pieces->tolerance))
    return false;
  *same = a->crossing.count == 0 && b->crossing.count == 0;
  keep_crossings(shape, a, about);
  keep_crossings(shape, b, about);
  return true;
}

void stroke_loops_fini(struct stroke_loops *loops) {
  own_crossings_fini(&loops->of_stroke);
  own_crossings_fini(&loops->of_pieces);
}
