/* judge.h - an independent judge of drawings, in double precision.
 *
 * It shares nothing with the solvers, the sheet or the camera: it has its own
 * projection, adjacency, bounding volumes and ray test, all in doubles, and
 * it knows a drawing only from the SVG file.  Two questions are asked:
 *
 *   false ink    is there, under every drawn point, an edge of the scene that
 *                is visible there?
 *   missing ink  is there ink near every visible point of every edge that was
 *                asked for?
 *
 * A point P of an edge is hidden where a ray from P to the eye meets a face
 * whose plane lies more than `contact` in front of P.  Doubles cannot decide
 * cases on the border, so there are three answers: clear, blocked, unsure.
 * Rays start from P itself and from a hair (judge_options.hair_mm) to the left
 * and right of the edge on the page.  A point counts as false ink only if all
 * three are blocked, as missing only if all three are clear.
 *
 * Running out of memory ends the program: this is a test's means. */
#ifndef JUDGE_JUDGE_H
#define JUDGE_JUDGE_H

#include "scene/scene.h"
#include "tests/judge/triangles.h"

/* ---- What a drawing says ---------------------------------------------------
 */

struct judge_stroke {
  uint32_t point, count; /* a closed one repeats its first point */
  bool hidden;           /* on a layer whose label speaks of hidden */
};

struct judge_drawing {
  double width_mm, height_mm;
  ARRAY(struct judge_place) point; /* mm, y up from the lower left corner */
  ARRAY(struct judge_stroke) stroke;
};

/* Reads an SVG file such as recto writes: a root in mm with a viewBox in the
 * same, paths of M, L, Z with absolute numbers, polylines and polygons.
 * Returns NULL, or what is wrong with it. */
const char *judge_read_svg(struct judge_drawing *drawing, const char *text,
                           size_t length);
void judge_drawing_fini(struct judge_drawing *drawing);

/* ---- Where it is seen from
 * --------------------------------------------------- */

struct judge_camera {
  double matrix[12]; /* model to page mm, homogeneous, row by row; the third
                        row is the depth in front of the eye (perspective) */
  bool perspective;
  struct judge_spot eye;  /* perspective */
  struct judge_spot back; /* orthographic: unit, towards the viewer */
  double near_d;          /* perspective: nothing nearer is drawn */
  double width_mm, height_mm;
};

/* As the design says of --no-fit: camera coordinates (x, y, -d) fall on the
 * page at (W/2 + s x/d, H/2 + s y/d), s = (H - 2 margin) / (2 tan(fov/2)). */
void judge_camera_look(struct judge_camera *camera, struct judge_spot eye,
                       struct judge_spot target, struct judge_spot up,
                       double fov_deg, double width_mm, double height_mm,
                       double margin_mm);

/* From the 3 x 4 matrix that a drawing's report holds. */
void judge_camera_matrix(struct judge_camera *camera, const double matrix[12],
                         double width_mm, double height_mm);

/* ---- The verdict
 * ---------------------------------------------------------------- */

struct judge_options {
  double step_mm;    /* between samples */
  double reach_mm;   /* ink this near to a visible point is enough */
  double lateral_mm; /* an edge this near explains a drawn point: the file's
                        own rounding and a little */
  double hair_mm;    /* see above: well above the page grid */
  double contact;    /* scene units, as the drawing was made with; negative:
                        a millionth of the scene's diagonal */
  double crease_deg;
  unsigned edges; /* classes asked for, a mask of recto_edge_class */
};

/* 0.02 mm steps and reach, 30 degrees, the default classes. */
void judge_options_init(struct judge_options *options);

struct judge_verdict {
  size_t drawn, false_ink; /* samples of strokes */
  size_t visible, missing; /* samples of edges that were asked for */
  double drawn_mm;         /* length of the strokes */
  struct judge_place false_at, missing_at; /* the first of each */
};

/* Judges the strokes that are not on a hidden layer. */
void judge_drawing(struct judge_verdict *verdict,
                   const struct judge_drawing *drawing,
                   const struct scene *scene, const struct judge_camera *camera,
                   const struct judge_options *options);

#endif
