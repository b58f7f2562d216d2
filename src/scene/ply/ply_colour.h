/* ply_colour.h - colours of a PLY file, which become groups. */
#ifndef SCENE_PLY_PLY_COLOUR_H
#define SCENE_PLY_PLY_COLOUR_H

#include "scene/ply/ply_parser.h"

/* So many groups are made of the colours of a file at most. */
enum { PLY_COLOUR_MAX = 4096 };

/* The colour of the element that was taken last, 0xRRGGBB: numbers with a
 * point run from 0 to 1, 16 bits from 0 to 65535, others from 0 to 255. */
uint32_t ply_colour_of(const struct ply_parser *p,
                       const struct ply_element *element);

/* Whether elements of that kind have one. */
static inline bool ply_has_colour(const struct ply_element *element) {
  return element->has[PLY_RED] && element->has[PLY_GREEN] &&
         element->has[PLY_BLUE];
}

/* The mean of the colours of the corners that were taken last. */
uint32_t ply_mean_colour(const struct ply_parser *p, const uint32_t *corner,
                         size_t count);

/* Of a face without a colour. */
#define PLY_NO_COLOUR UINT32_MAX

/* Puts the faces from `first` on, of which `face_colour` has the colours, into
 * groups "colour #rrggbb".  Where there are more than PLY_COLOUR_MAX colours,
 * those that agree in their upper bits, as many as make no more than that,
 * become their mean.
 * Errors  RECTO_ERROR_MEMORY */
USE_RESULT recto_status ply_colour_faces(struct ply_parser *p, size_t first);

#endif
