/* svg_elements.h - writes strokes and fills as elements of SVG. */
#ifndef BACKENDS_SVG_ELEMENTS_H
#define BACKENDS_SVG_ELEMENTS_H

#include "backends/svg_text.h"
#include "backends/writer.h"

/* A point rounded to the last decimal that is written, y down. */
struct svg_point {
  int64_t x, y;
};

struct svg {
  const struct drawing *drawing;
  const struct writer_options *options;
  struct stream *out;
  double scale;                   /* 10 to the power of the precision */
  ARRAY(struct svg_point) point;  /* of the current stroke or loop */
  struct drawing_polyline chords; /* of the current stroke's curve */
  struct svg_ids ids;             /* of groups; empty: not by groups */
};

const char *svg_class_name(const struct drawing_stroke *stroke);

/* Writes a stroke, unless rounding has reduced it to one point.  Returns false
 * when memory ran out. */
USE_RESULT bool svg_write_stroke(struct svg *svg, uint32_t index);

/* Writes a fill, or its seam stroke, unless rounding has reduced all loops to
 * fewer than three points.  Returns false when memory ran out. */
USE_RESULT bool svg_write_fill(struct svg *svg, uint32_t index, bool seam);

#endif
