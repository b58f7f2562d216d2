/* hpgl_strokes.c - writes strokes as commands of HPGL, clipped to where a
 * plotter reaches. */
#include "backends/hpgl_strokes.h"

#include <math.h>

#define POINTS_PER_COMMAND 100

struct plot_point {
  double x, y; /* device units, not rounded */
};

/* ---- Commands ------------------------------------------------------------ */

static void write_pair(struct hpgl_strokes *plot, int32_t x, int32_t y) {
  stream_int(plot->stream, x);
  stream_text(plot->stream, ",");
  stream_int(plot->stream, y);
}

static void end_command(struct hpgl_strokes *plot) {
  if (plot->points > 0)
    stream_text(plot->stream, ";\n");
  plot->points = 0;
}

static void end_stroke(struct hpgl_strokes *plot) {
  end_command(plot);
  plot->down = false;
}

/* Ends the current stroke and begins one at x, y. */
static void begin_stroke(struct hpgl_strokes *plot, int32_t x, int32_t y) {
  end_stroke(plot);
  plot->x = x;
  plot->y = y;
}

/* Draws a line to x, y.  Nothing is written before the first point that differs
 * from the start, so a stroke that rounding has shrunk to a point writes
 * nothing. */
static void plot_to(struct hpgl_strokes *plot, int32_t x, int32_t y) {
  if (x == plot->x && y == plot->y)
    return;
  if (!plot->down) {
    stream_text(plot->stream, "PU");
    write_pair(plot, plot->x, plot->y);
    stream_text(plot->stream, ";\n");
    plot->down = true;
  }
  if (plot->points == POINTS_PER_COMMAND)
    end_command(plot);
  stream_text(plot->stream, plot->points == 0 ? "PD" : ",");
  write_pair(plot, x, y);
  plot->points++;
  plot->x = x;
  plot->y = y;
}

/* ---- Clipping ------------------------------------------------------------ */

/* Whether a point is in the hard-clip area, which for this test is extended by
 * half a unit on every side: a point that rounds into the area is inside. */
static bool is_inside(const struct device_placement *place,
                      struct plot_point p) {
  return p.x >= place->x0 - 0.5 && p.x <= place->x1 + 0.5 &&
         p.y >= place->y0 - 0.5 && p.y <= place->y1 + 0.5;
}

/* Clips the parameter interval *from..*to of the line start + t run against low
 * and high, in one coordinate (Liang-Barsky).  Returns false if nothing is
 * left. */
static bool clip_axis(double start, double run, double low, double high,
                      double *from, double *to) {
  if (run == 0)
    return start >= low && start <= high;
  double enter = ((run > 0 ? low : high) - start) / run;
  double leave = ((run > 0 ? high : low) - start) / run;
  *from = fmax(*from, enter);
  *to = fmin(*to, leave);
  return *from <= *to;
}

/* Clips the line a b to the extended area; returns false if nothing is left. */
static bool clip_line(const struct device_placement *place,
                      struct plot_point *a, struct plot_point *b) {
  double from = 0, to = 1;
  struct plot_point start = *a, run = {b->x - a->x, b->y - a->y};
  if (!clip_axis(start.x, run.x, place->x0 - 0.5, place->x1 + 0.5, &from,
                 &to) ||
      !clip_axis(start.y, run.y, place->y0 - 0.5, place->y1 + 0.5, &from, &to))
    return false;
  if (from > 0)
    *a = (struct plot_point){start.x + from * run.x, start.y + from * run.y};
  if (to < 1)
    *b = (struct plot_point){start.x + to * run.x, start.y + to * run.y};
  return true;
}

/* Rounds to an integer in low..high.  The value is clamped first: a point on
 * the boundary of the extended area, half a unit outside, or beyond it by a
 * rounding error of the clipping, would else round to a point outside. */
static int32_t round_into(double value, int32_t low, int32_t high) {
  return (int32_t)lround(fmin(fmax(value, low), high));
}

/* ---- Strokes ------------------------------------------------------------- */

static struct plot_point to_device(const struct hpgl_strokes *plot,
                                   const struct drawing_point *point) {
  struct plot_point p;
  device_point(&plot->place, point->x, point->y, &p.x, &p.y);
  return p;
}

/* The corner at which to begin a stroke.  A loop that leaves the area begins at
 * a corner outside, so that none of its pieces inside is split in two. */
static size_t choose_stroke_start(const struct hpgl_strokes *plot,
                                  const struct drawing_point *point,
                                  size_t count, bool closed) {
  for (size_t i = 0; closed && i < count; i++)
    if (!is_inside(&plot->place, to_device(plot, &point[i])))
      return i;
  return 0;
}

/* Plots a polyline, clipped to the hard-clip area. */
static void plot_points(struct hpgl_strokes *plot,
                        const struct drawing_point *point, size_t count,
                        bool closed) {
  const struct device_placement *place = &plot->place;
  size_t start = choose_stroke_start(plot, point, count, closed);
  size_t lines = count - (closed ? 0 : 1);
  bool whole = true;
  for (size_t i = 0; i < lines; i++) {
    struct plot_point a = to_device(plot, &point[(start + i) % count]);
    struct plot_point b = to_device(plot, &point[(start + i + 1) % count]);
    bool a_inside = is_inside(place, a), b_inside = is_inside(place, b);
    whole = whole && a_inside && b_inside;
    double length = hypot(b.x - a.x, b.y - a.y);
    if ((!a_inside || !b_inside) && !clip_line(place, &a, &b)) {
      plot->lost += length;
      continue;
    }
    plot->lost += length - hypot(b.x - a.x, b.y - a.y);
    if (i == 0 || !a_inside)
      begin_stroke(plot, round_into(a.x, place->x0, place->x1),
                   round_into(a.y, place->y0, place->y1));
    plot_to(plot, round_into(b.x, place->x0, place->x1),
            round_into(b.y, place->y0, place->y1));
  }
  end_stroke(plot);
  plot->clipped += whole ? 0 : 1;
}

bool hpgl_write_stroke(struct hpgl_strokes *plot, const struct drawing *drawing,
                       size_t index) {
  const struct drawing_stroke *stroke = &drawing->stroke.item[index];
  const struct drawing_curve *curve = drawing_curve_of(drawing, index);
  if (curve == NULL)
    plot_points(plot, drawing->point.item + stroke->point, stroke->count,
                stroke->closed);
  else if (drawing_flatten(drawing, stroke, curve, plot->place.unit_mm / 2,
                           &plot->chords))
    plot_points(plot, plot->chords.point.item, plot->chords.point.count,
                stroke->closed);
  else
    return false;
  return true;
}
