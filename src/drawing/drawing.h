/* drawing.h - strokes and fills in millimetres, by layer: all that a backend
 * sees. */
#ifndef DRAWING_DRAWING_H
#define DRAWING_DRAWING_H

#include "base/memory.h"
#include "base/report.h"
#include "base/status.h"

#define DRAWING_NONE UINT32_MAX

struct drawing_point {
  double x, y; /* page mm, x right and y up from the lower left corner */
};

/* A polyline; where closed, the last point joins the first (which is not
 * repeated). */
struct drawing_stroke {
  uint32_t point, count;
  uint32_t layer;
  uint32_t face, edge, group; /* of its first segment; DRAWING_NONE */
  uint16_t edge_class;        /* one recto_edge_class; 0: a hatch line */
  bool closed;
  bool hidden; /* part of a hidden line */
};

/* A region: an outer loop and its holes, even-odd. */
struct drawing_fill {
  uint32_t loop, loops;
  uint32_t layer;
  uint32_t colour; /* 0xRRGGBB */
  uint32_t face, group;
};

struct drawing_loop {
  uint32_t point, count; /* closed, the first point is not repeated */
};

/* Layers are written in their order; within one, fills before strokes. */
struct drawing_layer {
  unsigned pen;    /* 1 is the first; 0: no pen, a layer of fills alone */
  char label[48];  /* "1 visible": the pen's number, then words */
  uint32_t colour; /* 0xRRGGBB, of its strokes */
  double width_mm;
};

struct drawing {
  double width_mm, height_mm; /* the page */
  double seam_mm; /* > 0: below the fills, strokes of their colours */
  /* Widths of a class's visible lines in those of their pen, by place of the
   * class's bit; 0: 1. */
  double weight[RECTO_EDGE_CLASS_COUNT];
  ARRAY(struct drawing_layer) layer;
  ARRAY(struct drawing_stroke) stroke; /* in drawing order within a layer */
  ARRAY(struct drawing_fill) fill;
  ARRAY(struct drawing_loop) loop;
  ARRAY(struct drawing_point) point;
  ARRAY(char *) group_name; /* owned; for ids */
  bool ids;
  struct report *report; /* owned */
};

void drawing_init(struct drawing *drawing);
void drawing_fini(struct drawing *drawing);

/* The stroke's width in mm: its layer's, where visible times its weight. */
double drawing_width_mm(const struct drawing *drawing,
                        const struct drawing_stroke *stroke);

/* The stroke's length in mm, its closing side included. */
double drawing_stroke_mm(const struct drawing *drawing,
                         const struct drawing_stroke *stroke);

/* Drawn length in mm; pen-up travel in mm in drawing order, from the lower
 * left corner, over all layers. */
double drawing_length_mm(const struct drawing *drawing);
double drawing_travel_mm(const struct drawing *drawing);

#endif
