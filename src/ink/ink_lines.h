/* ink_lines.h - from the visible map to the strokes of lines. */
#ifndef INK_INK_LINES_H
#define INK_INK_LINES_H

#include "drawing/drawing.h"
#include "ink/pens.h"
#include "visibility/map.h"

struct crease_lines;

/* What a drawing is made of. */
struct ink {
  struct drawing *drawing;
  const struct sheet *sheet;
  const struct scene *scene;
  const struct map *map;
  const recto_options *options;
  const struct pens *pens;
  struct crease_lines *creases; /* while lines are added */
  uint8_t *dropped; /* one a sheet edge: it closes a short cycle; NULL: none */
};

/* Whether lines are drawn as a pen shows them, rather than as they are. */
bool ink_is_tidied(const recto_options *options);

/* Adds the strokes of the lines that are visible, and hidden if requested.
 * Errors  RECTO_ERROR_MEMORY, RECTO_ERROR_LIMIT */
USE_RESULT recto_status ink_lines_add(struct ink *ink, recto_error *error);

#endif
