/* drawing.h - the drawing: strokes and fills in millimetres, grouped by layer.
 *
 * A drawing is all that a backend receives. */
#ifndef DRAWING_DRAWING_H
#define DRAWING_DRAWING_H

#include <math.h>

#include "base/memory.h"
#include "base/status.h"

#define DRAWING_NONE UINT32_MAX

struct drawing_point {
  double x, y; /* mm from the lower left corner of the page, x right, y up */
};

/* A polyline.  If it is closed, a further side joins the last point to the
 * first, which is not repeated. */
struct drawing_stroke {
  uint32_t point, count;
  uint32_t layer;
  uint32_t face, edge, group; /* of its first segment, or DRAWING_NONE */
  uint16_t edge_class;        /* one recto_edge_class, or 0 for a hatch line */
  bool closed;
  bool hidden; /* a hidden part of a line */
  bool text;   /* no line of the model: its edge_class is 0 */
};

/* The cubic Bezier curves that stand for a stroke in formats that have curves:
 * control points p0 c c p1 c c p2 ..., where every third is a point of the
 * curve.  The last one of a closed stroke is the first one again.  A straight
 * piece has its inner control points at its ends. */
struct drawing_curve {
  uint32_t control, count; /* 0: there is none, the stroke is its points */
};

/* A region bounded by closed loops, outer ones and holes, filled even-odd. */
struct drawing_fill {
  uint32_t loop, loops;
  uint32_t layer;
  uint32_t colour; /* 0xRRGGBB */
  uint32_t face, group;
};

struct drawing_loop {
  uint32_t point, count; /* closed; the first point is not repeated */
};

/* Layers are drawn in their order; within a layer, fills before strokes. */
struct drawing_layer {
  unsigned pen;    /* counts from 1; 0: a layer of fills without a pen */
  char label[64];  /* such as "1 visible": the pen's number, then a name */
  uint32_t colour; /* of its strokes, 0xRRGGBB */
  double width_mm;
  const char *view; /* of a sheet: the view's name, a literal; NULL: none */
  bool hidden;      /* the hidden lines of a pen that draws others as well */
};

/* The numbers of a face and of an edge within their group, or DRAWING_NONE. */
struct drawing_source {
  uint32_t face, edge;
};

/* What was counted while the drawing was made. */
struct drawing_counts {
  size_t segments;       /* visible intervals of edges, and hidden ones */
  size_t without_length; /* of these, points */
  size_t drawn_twice;    /* of these, removed as others cover them */
  size_t too_short;      /* lines dropped */
  size_t covered;        /* lines dropped as others cover them */
  size_t pen_lifts;
  double travel_before_mm; /* of strokes in their first order */
};

struct drawing {
  double width_mm, height_mm; /* the page */
  /* If > 0: below the fills of a layer, strokes of this width along the outline
   * of each fill in the fill's colour.  They close the hairline gaps that
   * viewers show between neighbouring fills. */
  double seam_mm;
  /* The width of a class's visible lines as a multiple of their pen's width,
   * indexed by the number of the class's bit.  0 stands for 1. */
  double weight[RECTO_EDGE_CLASS_COUNT];
  bool weighted; /* they differ; the strokes of a class are consecutive then */
  /* Set before it is drawn: it is for a plotter, which takes one pen after the
   * other, and where it does not matter what lies below. */
  bool by_pens;
  /* Set before it is drawn, or with ids: strokes of a group of the model are
   * consecutive in a layer, no stroke has parts of several, and each group is
   * written as an element. */
  bool by_groups;
  ARRAY(struct drawing_layer) layer;
  ARRAY(struct drawing_stroke) stroke; /* in drawing order within a layer */
  ARRAY(struct drawing_fill) fill;
  ARRAY(struct drawing_loop) loop;
  ARRAY(struct drawing_point) point;
  /* For those who judge the drawing: visible lines that are not drawn as they
   * are too short or covered, and their points; and the ends of gaps that were
   * closed, in pairs. */
  ARRAY(struct drawing_stroke) dropped;
  ARRAY(struct drawing_point) dropped_point, gap_end;
  ARRAY(struct drawing_curve) curve; /* one a stroke; or none at all */
  ARRAY(struct drawing_point) control;
  char *title, *description; /* owned; NULL: none */
  ARRAY(char *) group_name;  /* of the scene, owned; written if ids */
  /* With ids, of each stroke and of each fill. */
  ARRAY(struct drawing_source) stroke_source, fill_source;
  bool ids; /* write faces, edges and groups of elements */
  struct drawing_counts counts;
};

void drawing_init(struct drawing *drawing);
void drawing_fini(struct drawing *drawing);

/* The stroke's width in mm: its layer's, which for a visible line is multiplied
 * by the weight of its class. */
double drawing_width_mm(const struct drawing *drawing,
                        const struct drawing_stroke *stroke);

static inline double drawing_distance(struct drawing_point a,
                                      struct drawing_point b) {
  double dx = b.x - a.x, dy = b.y - a.y;
  return sqrt(dx * dx + dy * dy);
}

/* The point of a segment at the parameter t, from 0 to 1. */
static inline struct drawing_point drawing_point_between(struct drawing_point a,
                                                         struct drawing_point b,
                                                         double t) {
  return (struct drawing_point){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/* The length of a polyline, with the side that closes it if it is closed. */
double drawing_polyline_mm(const struct drawing_point *point, size_t count,
                           bool closed);

/* The stroke's length in mm, its closing side included. */
double drawing_stroke_mm(const struct drawing *drawing,
                         const struct drawing_stroke *stroke);

/* The curve of the stroke at `index`; NULL: it has none. */
const struct drawing_curve *drawing_curve_of(const struct drawing *drawing,
                                             size_t index);

/* Whether the piece of a curve with these control points is straight. */
bool drawing_piece_is_straight(const struct drawing_point control[4]);

/* Finds where the piece of a curve with these control points turns back to the
 * left or right, up or down: these points and its ends span its bounding box.
 * Returns how many there are. */
int drawing_piece_extrema(const struct drawing_point control[4],
                          struct drawing_point extremum[4]);

/* A polyline that is owned by its user. */
struct drawing_polyline {
  ARRAY(struct drawing_point) point;
};

/* Stores a polyline that is nowhere farther than `distance` mm from the curve;
 * that of a closed stroke does not repeat its first point.
 * Source  the number of chords: [Filip1986]
 * Returns false when memory ran out. */
USE_RESULT bool drawing_flatten(const struct drawing *drawing,
                                const struct drawing_stroke *stroke,
                                const struct drawing_curve *curve,
                                double distance, struct drawing_polyline *line);

struct drawing_circle {
  double x, y, radius; /* page mm */
};

/* Appends the points of an arc, both ends included, counter-clockwise.
 * from, to  radians, to >= from
 * Returns false when memory ran out. */
USE_RESULT bool drawing_add_arc(struct drawing *drawing,
                                const struct drawing_circle *circle,
                                double from, double to);

/* A rectangle of the page. */
struct drawing_window {
  double x0, y0, x1, y1; /* page mm */
};

/* The page, or if `tight` the bounding box of the ink, unless there is no ink.
 * The box of the points, and of those where curves turn, extended by half the
 * pen's width is exact, since caps and joins are round. */
struct drawing_window drawing_window(const struct drawing *drawing, bool tight);

/* The drawn length, and the pen-up travel in drawing order over all layers from
 * the lower left corner of the page.  Both in mm.
 * Cost  linear; the travel takes a pass over all strokes for every layer. */
double drawing_length_mm(const struct drawing *drawing);
double drawing_travel_mm(const struct drawing *drawing);

#endif
