/* hatch_region.h - hatches a region by parallel lines at one pitch. */
#ifndef INK_HATCH_HATCH_REGION_H
#define INK_HATCH_HATCH_REGION_H

#include "base/number_lists.h"
#include "ink/hatch/hatch_lines.h"
#include "ink/hatch/hatch_regions.h"
#include "ink/lines/stroke.h"

/* The hatching of one region after another, by one thread. */
struct hatch {
  /* Set by the caller, before hatch_init, */
  const struct sheet *sheet;
  const struct hatch_regions *regions;
  const struct pens *pens;
  /* and before each region: */
  struct drawing *drawing; /* gets the strokes */
  uint32_t pen;
  double shortest;       /* mm: shorter strokes are left out */
  double inked_distance; /* mm from a side within which a move is on its ink */
  double inset; /* mm that the pen keeps from all sides; 0: it does not */
  struct drawing_stroke attributes; /* of all strokes of the region */
  /* private */
  struct hatch_lines lines;
  int64_t first, strips;
  struct number_lists strip; /* the sides that reach into strip first + k */
  struct stroke_line line;   /* the current stroke */
};

void hatch_init(struct hatch *h, double pitch_mm, double angle_deg);
void hatch_fini(struct hatch *h);

/* Hatches the region whose fragments are those of regions->fragment from
 * `begin` to before `end`.
 * Returns false when memory ran out, or the caller cancelled. */
USE_RESULT bool hatch_region(struct hatch *h, const struct map *map,
                             size_t begin, size_t end);

#endif
