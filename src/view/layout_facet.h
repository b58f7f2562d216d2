/* layout_facet.h - one triangle of a face on its way to the sheet. */
#ifndef VIEW_LAYOUT_FACET_H
#define VIEW_LAYOUT_FACET_H

#include "geom/predicate.h"
#include "view/layout_phases.h"

/* A triangle of a face, before clipping. */
struct layout_facet {
  uint32_t face;
  uint32_t point[3];    /* scene points, welded */
  uint32_t side[3];     /* topology edges; SHEET_NONE: a diagonal */
  bool forward[3];      /* whether the side runs in its canonical direction */
  uint32_t diagonal[3]; /* where the side is one: its number in the face */
};

/* What a side is called until it is known which diagonals are folds: as a
 * topology edge, or where it is the face's n-th diagonal as n folds on from
 * those that there are. */
static inline uint32_t layout_name_of(const struct layout *layout,
                                      const struct layout_facet *facet, int k) {
  return facet->side[k] != SHEET_NONE
             ? facet->side[k]
             : (uint32_t)layout->topology->edge.count +
                   (uint32_t)layout->fold.count + facet->diagonal[k];
}

/* The side of a facet that is a diagonal, or an edge, learns where it lies. */
static inline void layout_learn_side(struct layout *layout,
                                     const struct layout_facet *facet, int k,
                                     int sign) {
  uint8_t *sides = facet->side[k] != SHEET_NONE
                       ? &layout->sides[facet->side[k]]
                       : &layout->diagonal.item[facet->diagonal[k]].sides;
  layout_learn(sides, facet->forward[k], sign);
}

/* Where triangles go, held in registers by those who add many. */
struct layout_triangle_sink {
  const struct geom_point *point;
  struct sheet_triangle *triangle; /* the next one */
  uint8_t *flags;
  size_t room;
};

static inline struct layout_triangle_sink
layout_sink_of(const struct layout *layout) {
  const struct sheet *sheet = layout->sheet;
  size_t room = sheet->triangle.capacity - sheet->triangle.count;
  size_t flags_room = layout->flags.capacity - layout->flags.count;
  return (struct layout_triangle_sink){
      sheet->point.item, sheet->triangle.item + sheet->triangle.count,
      layout->flags.item + layout->flags.count,
      room < flags_room ? room : flags_room};
}

static inline void layout_sink_close(struct layout *layout,
                                     const struct layout_triangle_sink *sink) {
  layout->sheet->triangle.count =
      (size_t)(sink->triangle - layout->sheet->triangle.item);
  layout->flags.count = layout->sheet->triangle.count;
}

/* Adds a triangle of three sheet points; there is room for it.
 * Returns twice its signed area on the page, as the face winds. */
static inline int64_t layout_sink_triangle(struct layout_triangle_sink *sink,
                                           uint32_t face,
                                           const uint32_t point[3],
                                           const uint32_t side[3]) {
  int64_t area = geom_orient2d(sink->point[point[0]], sink->point[point[1]],
                               sink->point[point[2]]);
  bool flip = area < 0;
  *sink->triangle++ =
      (struct sheet_triangle){{point[0], point[1 + flip], point[2 - flip]},
                              {side[2 * flip], side[1], side[2 - 2 * flip]},
                              face};
  *sink->flags++ = flip ? SHEET_FLIPPED : area == 0 ? SHEET_FLAT : 0;
  sink->room--;
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

/* Makes room for more triangles. */
static inline bool layout_reserve(struct layout *layout, size_t extra) {
  return ARRAY_RESERVE(&layout->sheet->triangle, extra) &&
         ARRAY_RESERVE(&layout->flags, extra);
}

/* Adds a facet whose corners are all on the sheet; there is room for it.
 * Returns the sign of its area on the page, as the face winds. */
static inline int layout_add_facet(struct layout *layout,
                                   const struct layout_facet *facet) {
  const uint32_t *map = layout->point_map;
  const uint32_t point[3] = {map[facet->point[0]], map[facet->point[1]],
                             map[facet->point[2]]};
  const uint32_t side[3] = {layout_name_of(layout, facet, 0),
                            layout_name_of(layout, facet, 1),
                            layout_name_of(layout, facet, 2)};
  return geom_sign64(layout_add_triangle(layout, facet->face, point, side));
}

/* The sides of a facet learn where it lies. */
static inline void layout_learn_sides(struct layout *layout,
                                      const struct layout_facet *facet,
                                      int sign) {
  for (int k = 0; k < 3; k++)
    layout_learn_side(layout, facet, k, sign);
}

/* Adds what is left of a facet inside of the paper and the near plane; its
 * sides learn where that lies. */
USE_RESULT recto_status layout_cut_facet(struct layout *layout,
                                         const struct layout_facet *facet);

/* The cut of a diagonal of the face at hand. */
USE_RESULT recto_status layout_diagonal_cut(struct layout *layout,
                                            struct layout_diagonal *diagonal,
                                            struct layout_cut *cut);

#endif
