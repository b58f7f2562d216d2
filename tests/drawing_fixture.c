/* drawing_fixture.c - see drawing_fixture.h. */
#include "tests/drawing_fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void need(bool ok) {
  if (ok)
    return;
  fputs("maker: out of memory\n", stderr);
  abort();
}

/* ---- Pieces -------------------------------------------------------------- */

void drawing_fixture_page(struct drawing *drawing, double width_mm,
                          double height_mm) {
  drawing_init(drawing);
  drawing->width_mm = width_mm;
  drawing->height_mm = height_mm;
}

uint32_t drawing_fixture_layer(struct drawing *drawing, unsigned pen,
                               double width_mm, uint32_t colour) {
  struct drawing_layer layer = {
      .pen = pen, .colour = colour, .width_mm = width_mm};
  snprintf(layer.label, sizeof layer.label, "%u test", pen);
  need(ARRAY_PUSH(&drawing->layer, layer));
  return (uint32_t)drawing->layer.count - 1;
}

/* Returns the index of the first. */
static uint32_t add_points(struct drawing *drawing, const double *xy,
                           uint32_t count) {
  uint32_t first = (uint32_t)drawing->point.count;
  for (size_t i = 0; i < count; i++) {
    struct drawing_point point = {xy[2 * i], xy[2 * i + 1]};
    need(ARRAY_PUSH(&drawing->point, point));
  }
  return first;
}

void drawing_fixture_stroke(struct drawing *drawing, uint32_t layer,
                            const double *xy, uint32_t count, bool closed) {
  struct drawing_stroke stroke = {.point = add_points(drawing, xy, count),
                                  .count = count,
                                  .layer = layer,
                                  .face = DRAWING_NONE,
                                  .edge = DRAWING_NONE,
                                  .group = DRAWING_NONE,
                                  .edge_class = RECTO_EDGE_WIRE,
                                  .closed = closed};
  need(ARRAY_PUSH(&drawing->stroke, stroke));
}

void drawing_fixture_line(struct drawing *drawing, uint32_t layer, double x0,
                          double y0, double x1, double y1) {
  drawing_fixture_stroke(drawing, layer, (double[]){x0, y0, x1, y1}, 2, false);
}

void drawing_fixture_box(struct drawing *drawing, uint32_t layer, double x0,
                         double y0, double x1, double y1) {
  drawing_fixture_stroke(drawing, layer,
                         (double[]){x0, y0, x1, y0, x1, y1, x0, y1}, 4, true);
}

void drawing_fixture_loop(struct drawing *drawing, const double *xy,
                          uint32_t count) {
  struct drawing_loop loop = {add_points(drawing, xy, count), count};
  need(ARRAY_PUSH(&drawing->loop, loop));
  drawing->fill.item[drawing->fill.count - 1].loops++;
}

void drawing_fixture_fill(struct drawing *drawing, uint32_t layer,
                          uint32_t colour, const double *xy, uint32_t count) {
  struct drawing_fill fill = {.loop = (uint32_t)drawing->loop.count,
                              .layer = layer,
                              .colour = colour,
                              .face = DRAWING_NONE,
                              .group = DRAWING_NONE};
  need(ARRAY_PUSH(&drawing->fill, fill));
  drawing_fixture_loop(drawing, xy, count);
}

/* ---- Whole drawings ------------------------------------------------------ */

static const double full_turn = 6.283185307179586;

static void make_calibration(struct drawing *drawing) {
  drawing_fixture_page(drawing, 210, 297);
  uint32_t square = drawing_fixture_layer(drawing, 1, 0.3, 0x000000);
  uint32_t grid = drawing_fixture_layer(drawing, 2, 0.3, 0x000000);
  drawing_fixture_box(drawing, square, 23, 33, 123, 133);
  for (int i = 1; i <= 20; i++)
    drawing_fixture_line(drawing, grid, 10 * i, 10, 10 * i, 280);
  for (int i = 1; i <= 28; i++)
    drawing_fixture_line(drawing, grid, 10, 10 * i, 200, 10 * i);
}

/* One long polyline. */
static void make_spiral(struct drawing *drawing) {
  enum { POINTS = 1200 };
  double xy[2 * POINTS];
  drawing_fixture_page(drawing, 210, 297);
  for (size_t i = 0; i < POINTS; i++) {
    double share = (double)i / POINTS, angle = full_turn * 9 * share;
    xy[2 * i] = 100 + (4 + 80 * share) * cos(angle);
    xy[2 * i + 1] = 160 + (4 + 80 * share) * sin(angle);
  }
  drawing_fixture_stroke(drawing, drawing_fixture_layer(drawing, 1, 0.5, 0), xy,
                         POINTS, false);
}

/* Closed strokes with sharp corners, of all sizes. */
static void make_stars(struct drawing *drawing) {
  drawing_fixture_page(drawing, 297, 210);
  uint32_t layer = drawing_fixture_layer(drawing, 1, 0.5, 0);
  for (int star = 0; star < 24; star++) {
    double xy[2 * 14];
    int column = star % 6, row = star / 6;
    double x = 30 + 45 * column, y = 30 + 45 * row;
    for (size_t i = 0; i < 14; i++) {
      double radius = (i % 2 ? 0.4 : 1) * (2 + star * 0.8);
      double angle = full_turn * (double)i / 14 + star;
      xy[2 * i] = x + radius * cos(angle);
      xy[2 * i + 1] = y + radius * sin(angle);
    }
    drawing_fixture_stroke(drawing, layer, xy, 14, true);
  }
}

/* Many short lines that meet. */
static void make_lattice(struct drawing *drawing) {
  drawing_fixture_page(drawing, 210, 297);
  uint32_t layer = drawing_fixture_layer(drawing, 1, 0.5, 0);
  for (int i = 0; i < 16; i++) {
    for (int j = 0; j < 20; j++) {
      double x = 15 + 11 * i + 2 * sin(j), y = 20 + 13 * j + 3 * cos(i);
      drawing_fixture_line(drawing, layer, x, y, x + 9, y + 4);
      if ((i + 2 * j) % 3)
        drawing_fixture_line(drawing, layer, x, y, x - 1, y + 11);
    }
  }
}

/* Lines through one point, at every slope. */
static void make_fan(struct drawing *drawing) {
  drawing_fixture_page(drawing, 210, 297);
  uint32_t layer = drawing_fixture_layer(drawing, 1, 0.5, 0);
  for (int i = 0; i < 90; i++) {
    double angle = full_turn * i / 97;
    drawing_fixture_line(
        drawing, layer, 90 + 12 * cos(angle), 130 + 12 * sin(angle),
        90 + (40 + i / 2.0) * cos(angle), 130 + (40 + i / 2.0) * sin(angle));
  }
}

/* Close parallel polylines, as of a hatching. */
static void make_waves(struct drawing *drawing) {
  drawing_fixture_page(drawing, 297, 210);
  uint32_t layer = drawing_fixture_layer(drawing, 1, 0.4, 0);
  for (int line = 0; line < 60; line++) {
    double xy[2 * 130];
    for (size_t i = 0; i < 130; i++) {
      double at = (double)i;
      xy[2 * i] = 15 + 2 * at;
      xy[2 * i + 1] =
          20 + 2.5 * line + 4 * sin(at / 9 + line / 7.0) * sin(at / 31);
    }
    drawing_fixture_stroke(drawing, layer, xy, 130, false);
  }
}

/* Several pens and widths, one layer empty. */
static void make_pens(struct drawing *drawing) {
  drawing_fixture_page(drawing, 210, 297);
  for (int pen = 1; pen <= 4; pen++) {
    uint32_t layer = drawing_fixture_layer(drawing, (unsigned)pen, 0.5, 0);
    if (pen == 3)
      continue;
    for (int i = 0; i < 12; i++)
      drawing_fixture_box(drawing, layer, 10 + 14 * i + pen, 20 + 50 * pen + i,
                          20 + 14 * i, 50 + 50 * pen + 2 * i);
  }
}

static const struct {
  const char *name;
  void (*make)(struct drawing *);
} drawings[] = {
    {"calibration", make_calibration},
    {"spiral", make_spiral},
    {"stars", make_stars},
    {"lattice", make_lattice},
    {"fan", make_fan},
    {"waves", make_waves},
    {"pens", make_pens},
};

bool drawing_fixture_named(struct drawing *drawing, const char *name) {
  for (size_t i = 0; i < sizeof drawings / sizeof *drawings; i++)
    if (strcmp(drawings[i].name, name) == 0) {
      drawings[i].make(drawing);
      return true;
    }
  return false;
}

const char *drawing_fixture_name(size_t index) {
  return index < sizeof drawings / sizeof *drawings ? drawings[index].name
                                                    : NULL;
}
