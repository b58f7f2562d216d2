/* hpgl_strokes.h - writes strokes as commands of HPGL, clipped to where a
 * plotter reaches.
 *
 *   PUx,y;PDx,y,...;
 *
 * Each command is on a line of its own and has a limited number of points. */
#ifndef BACKENDS_HPGL_STROKES_H
#define BACKENDS_HPGL_STROKES_H

#include "backends/device.h"
#include "base/stream.h"
#include "drawing/drawing.h"

/* Strokes that one thread writes. */
struct hpgl_strokes {
  struct stream *stream;
  struct device_placement place;
  uint64_t clipped; /* the number of strokes clipped */
  double lost;      /* the length clipped off, in units */
  /* private */
  int32_t x, y; /* the last point of the current stroke */
  bool down;    /* the pen is down in the current stroke */
  int points;   /* in the current PD command; 0: none is open */
  struct drawing_polyline chords; /* of the current stroke's curve */
};

/* Writes a stroke, or a polyline within half a unit of its curve.  Returns
 * false when memory ran out. */
USE_RESULT bool hpgl_write_stroke(struct hpgl_strokes *strokes,
                                  const struct drawing *drawing, size_t index);

#endif
