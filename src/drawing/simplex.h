/* simplex.h - the glyphs of Hershey's simplex Roman font, single strokes. */
#ifndef DRAWING_SIMPLEX_H
#define DRAWING_SIMPLEX_H

/* The characters of ASCII from the space on, and at last the degree sign. */
enum { SIMPLEX_FIRST = ' ', SIMPLEX_GLYPHS = 96 };

/* Pairs of letters, x and y from 'R', y downwards: first the left and the right
 * bound, then the points of polylines; " R" stands between two of them. */
extern const char *const simplex_glyph[SIMPLEX_GLYPHS];

/* In units of the font: what a capital is high, and where its foot is. */
#define SIMPLEX_CAPITAL 21
#define SIMPLEX_BASELINE 9

#endif
