/* label_places.c - see label_places.h. */
#include "bench/label_places.h"

#include <math.h>

void label_take_box(struct label_places *places, struct label_box box) {
  if (places->boxes < LABEL_BOXES)
    places->box[places->boxes++] = box;
}

void label_take_curve(struct label_places *places, struct label_box curve) {
  if (places->curves < LABEL_CURVES)
    places->curve[places->curves++] = curve;
}

/* Clips the range *low .. *high of a segment's parameter to where it lies
 * between two lines. */
static bool clip(double from, double by, double first, double last, double *low,
                 double *high) {
  if (by == 0)
    return first < from && from < last;
  double a = (first - from) / by, b = (last - from) / by;
  *low = fmax(*low, fmin(a, b));
  *high = fmin(*high, fmax(a, b));
  return *low < *high;
}

static bool crosses(const struct label_box *segment,
                    const struct label_box *box) {
  double low = 0, high = 1;
  return clip(segment->x0, segment->x1 - segment->x0, box->x0, box->x1, &low,
              &high) &&
         clip(segment->y0, segment->y1 - segment->y0, box->y0, box->y1, &low,
              &high);
}

static bool overlap(const struct label_box *a, const struct label_box *b) {
  return a->x0 < b->x1 && b->x0 < a->x1 && a->y0 < b->y1 && b->y0 < a->y1;
}

static bool is_free(const struct label_places *places,
                    const struct label_box *box) {
  const struct label_box *within = &places->within;
  if (box->x0 < within->x0 || box->x1 > within->x1 || box->y0 < within->y0 ||
      box->y1 > within->y1)
    return false;
  for (size_t i = 0; i < places->boxes; i++)
    if (overlap(box, &places->box[i]))
      return false;
  return true;
}

/* How much a place is to be avoided: its distance, and the curves and what else
 * it or the line to its mark stands on. */
static double cost_of(const struct label_places *places,
                      const struct label_box *box,
                      const struct label_box *leader, double distance) {
  double cost = distance;
  for (size_t i = 0; i < places->curves; i++)
    cost += crosses(&places->curve[i], box) ? 20 : 0;
  if (distance > LABEL_BESIDE)
    for (size_t i = 0; i < places->boxes; i++)
      cost += crosses(leader, &places->box[i]) ? 8 : 0;
  return cost;
}

bool label_place(struct label_places *places, double x, double y, double width,
                 double height, struct label_box *at, double *distance) {
  static const double way[][2] = {{1, 0},   {-1, 0},  {0, -1},   {0, 1},
                                  {1, -1},  {-1, -1}, {1, 1},    {-1, 1},
                                  {1, -.5}, {1, .5},  {-1, -.5}, {-1, .5},
                                  {.5, -1}, {.5, 1},  {-.5, -1}, {-.5, 1}};
  static const double rings[] = {LABEL_BESIDE, 14, 22, 32, 44, 58, 74, 92};
  double best = INFINITY;
  for (size_t r = 0; r < sizeof rings / sizeof *rings; r++)
    for (size_t i = 0; i < sizeof way / sizeof *way; i++) {
      double cx = x + way[i][0] * (width / 2 + rings[r]);
      double cy = y + way[i][1] * (height / 2 + rings[r]);
      struct label_box box = {cx - width / 2, cy - height / 2, cx + width / 2,
                              cy + height / 2};
      /* The line is drawn up to the label, from beside the mark. */
      struct label_box leader = {x + (cx - x) * 0.3, y + (cy - y) * 0.3,
                                 x + (cx - x) * 0.6, y + (cy - y) * 0.6};
      if (!is_free(places, &box))
        continue;
      double cost = cost_of(places, &box, &leader, rings[r]) + 0.1 * (double)i;
      if (cost < best) {
        best = cost;
        *at = box;
        *distance = rings[r];
      }
    }
  if (isfinite(best))
    label_take_box(places, *at);
  return isfinite(best);
}
