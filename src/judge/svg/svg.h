/* svg.h - reads the stroked lines of an SVG file. */
#ifndef JUDGE_SVG_SVG_H
#define JUDGE_SVG_SVG_H

#include "judge/drawing.h"

/* Reads an SVG file such as recto writes: a root in mm with a viewBox in the
 * same, paths of M, L, Z with absolute numbers, polylines and polygons.
 * Strokes of the class hidden are JUDGE_HIDDEN, and without a class those on a
 * layer labelled "hidden" or "2 hidden"; hatching, seams and text are left
 * out.
 * Returns NULL, or what is wrong with it: JUDGE_NO_MEMORY itself where memory
 * ran out. */
const char *judge_read_svg(struct judge_drawing *drawing, const char *text,
                           size_t length);
extern const char JUDGE_NO_MEMORY[];

#endif
