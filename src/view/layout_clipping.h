/* layout_clipping.h - adds triangles of scene faces to the sheet, clipped where
 * they leave the view. */
#ifndef VIEW_LAYOUT_CLIPPING_H
#define VIEW_LAYOUT_CLIPPING_H

#include "geom/predicate.h"
#include "view/layout_phases.h"

/* A triangle of a face, before clipping. */
struct layout_triangle {
  uint32_t face;
  uint32_t point[3];    /* scene points, welded */
  uint32_t side[3];     /* topology edges; SHEET_NONE: a diagonal */
  bool forward[3];      /* whether the side runs in its canonical direction */
  uint32_t diagonal[3]; /* of a side that is one: its number in the face */
};

/* The provisional number of a side, until it is known which diagonals are
 * folds: its topology edge, or for diagonal n of the face
 *     number of topology edges + number of folds so far + n. */
static inline uint32_t layout_side_id(const struct layout *layout,
                                      const struct layout_triangle *triangle,
                                      int k) {
  return triangle->side[k] != SHEET_NONE
             ? triangle->side[k]
             : (uint32_t)layout->topology->edge.count +
                   (uint32_t)layout->fold.count + triangle->diagonal[k];
}

/* Records on which side of the edge or diagonal of side k a triangle lies. */
static inline void
layout_record_triangle_side(struct layout *layout,
                            const struct layout_triangle *triangle, int k,
                            int sign) {
  if (triangle->side[k] != SHEET_NONE)
    layout_record_edge(layout, triangle->side[k], triangle->forward[k], sign);
  else
    layout_record_side(&layout->diagonal.item[triangle->diagonal[k]].sides,
                       triangle->forward[k], sign);
}

/* The end of the arrays of triangles, as a local variable, so that a loop which
 * adds many keeps it in registers. */
struct layout_triangle_sink {
  const struct geom_point *point;
  struct sheet_triangle *triangle; /* the next one */
  struct sheet_sides *sides;
  uint8_t *flags;
  size_t remaining;
};

static inline struct layout_triangle_sink
layout_sink_of(const struct layout *layout) {
  const struct sheet *sheet = layout->sheet;
  size_t count = sheet->triangle.count, capacity = sheet->triangle.capacity;
  if (sheet->sides.capacity < capacity)
    capacity = sheet->sides.capacity;
  if (layout->flags.capacity < capacity)
    capacity = layout->flags.capacity;
  return (struct layout_triangle_sink){
      sheet->point.item, sheet->triangle.item + count,
      sheet->sides.item + count, layout->flags.item + count, capacity - count};
}

static inline void layout_sink_close(struct layout *layout,
                                     const struct layout_triangle_sink *sink) {
  layout->sheet->triangle.count =
      (size_t)(sink->triangle - layout->sheet->triangle.item);
  layout->sheet->sides.count = layout->sheet->triangle.count;
  layout->flags.count = layout->sheet->triangle.count;
}

/* Adds a triangle of three sheet points; capacity must have been reserved.
 * Returns twice its signed area on the page, in the face's winding. */
static inline int64_t layout_sink_triangle(struct layout_triangle_sink *sink,
                                           uint32_t face,
                                           const uint32_t point[3],
                                           const uint32_t side[3]) {
  int64_t area = geom_orient2d(sink->point[point[0]], sink->point[point[1]],
                               sink->point[point[2]]);
  *sink->triangle++ = layout_oriented_triangle(point, face, area < 0);
  *sink->sides++ = layout_oriented_sides(side, area < 0);
  *sink->flags++ = layout_flags_of_area(area);
  sink->remaining--;
  return area;
}

static inline int64_t layout_add_triangle(struct layout *layout, uint32_t face,
                                          const uint32_t point[3],
                                          const uint32_t side[3]) {
  struct layout_triangle_sink sink = layout_sink_of(layout);
  int64_t area = layout_sink_triangle(&sink, face, point, side);
  layout_sink_close(layout, &sink);
  return area;
}

/* Reserves capacity for more triangles. */
static inline bool layout_reserve(struct layout *layout, size_t extra) {
  return ARRAY_RESERVE(&layout->sheet->triangle, extra) &&
         ARRAY_RESERVE(&layout->sheet->sides, extra) &&
         ARRAY_RESERVE(&layout->flags, extra);
}

/* Adds a triangle that needs no clipping; capacity must have been reserved.
 * Returns the sign of its area on the page, in the face's winding. */
static inline int layout_add_whole(struct layout *layout,
                                   const struct layout_triangle *triangle) {
  const uint32_t point[3] = {layout_sheet_point(layout, triangle->point[0]),
                             layout_sheet_point(layout, triangle->point[1]),
                             layout_sheet_point(layout, triangle->point[2])};
  const uint32_t side[3] = {layout_side_id(layout, triangle, 0),
                            layout_side_id(layout, triangle, 1),
                            layout_side_id(layout, triangle, 2)};
  return geom_sign64(layout_add_triangle(layout, triangle->face, point, side));
}

/* Records on which side of each of its sides a triangle lies. */
static inline void
layout_record_triangle_sides(struct layout *layout,
                             const struct layout_triangle *triangle, int sign) {
  for (int k = 0; k < 3; k++)
    layout_record_triangle_side(layout, triangle, k, sign);
}

/* Records on which side of those of its sides that are left a triangle lies. */
static inline void
layout_record_clipped(struct layout *layout,
                      const struct layout_triangle *triangle,
                      const struct layout_clipped_triangle *left, int sign) {
  for (int k = 0; k < 3; k++)
    if (left->sides & 1u << k)
      layout_record_triangle_side(layout, triangle, k, sign);
}

/* Clips a triangle and adds what is left of it. */
USE_RESULT recto_status layout_add_clipped(
    struct layout *layout, const struct layout_triangle *triangle,
    struct layout_clipped_triangle *left);

#endif
