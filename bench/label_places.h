/* label_places.h - where in a chart a label can stand: beside its mark, over no
 * other mark or label, and over as few curves as possible. */
#ifndef BENCH_LABEL_PLACES_H
#define BENCH_LABEL_PLACES_H

#include <stdbool.h>
#include <stddef.h>

enum { LABEL_BOXES = 2400, LABEL_CURVES = 1600 };

struct label_box {
  double x0, y0, x1, y1;
};

struct label_places {
  struct label_box within; /* labels stay in this */
  struct label_box box[LABEL_BOXES];
  size_t boxes;
  struct label_box curve[LABEL_CURVES]; /* from x0, y0 to x1, y1 */
  size_t curves;
};

/* What labels may not stand on, and what they had better not. */
void label_take_box(struct label_places *places, struct label_box box);
void label_take_curve(struct label_places *places, struct label_box curve);

/* Finds a place for a label of that size at the mark at x, y, and takes it.
 * *distance  gets how far it is from the mark; beside it: LABEL_BESIDE
 * False where there is none. */
enum { LABEL_BESIDE = 7 };
bool label_place(struct label_places *places, double x, double y, double width,
                 double height, struct label_box *at, double *distance);

#endif
