/* judge.h - an independent judge of drawings, in double precision.
 *
 * It shares nothing with the solvers, the sheet or the camera: it has its own
 * projection, adjacency, bounding volumes and ray test, all in doubles, and of
 * a drawing it knows the strokes alone.  Two questions are asked:
 *
 *   false ink    is there, under every drawn point, an edge of the scene that
 *                is visible there?
 *   missing ink  is there ink near every visible point of every edge that was
 *                asked for?
 *
 * A point P of an edge is hidden where a ray from P to the eye meets a face
 * whose plane lies more than contact in front of P; or where an end of the
 * edge is a corner of that face, in front of where it leaves the face or ends:
 * it is hidden from its start or not at all.  Doubles cannot decide cases on
 * the border, so there are three answers: clear, blocked, unsure.
 * Rays start from P itself and from a hair (judge_options.hair_mm) to the left
 * and right of the edge on the page.  A point counts as false ink only if all
 * three are blocked, as missing only if all three are clear. */
#ifndef JUDGE_JUDGE_H
#define JUDGE_JUDGE_H

#include "scene/precision.h"
#include "scene/scene.h"
#include "judge/triangles.h"

/* ---- What a drawing says ------------------------------------------------- */

enum judge_role {
  JUDGE_INK,
  JUDGE_HIDDEN, /* a hidden line: not judged */
  JUDGE_DROPPED /* not drawn, for being too short: nothing is missing there */
};

struct judge_stroke {
  uint32_t point, count; /* a closed one repeats its first point */
  enum judge_role role;
};

struct judge_drawing {
  double width_mm, height_mm;
  ARRAY(struct judge_point2) point; /* mm, y up from the lower left corner */
  ARRAY(struct judge_stroke) stroke;
};

/* Reads an SVG file such as recto writes: a root in mm with a viewBox in the
 * same, paths of M, L, Z with absolute numbers, polylines and polygons.
 * Strokes of the class hidden are JUDGE_HIDDEN, and without a class those on a
 * layer labelled "hidden" or "2 hidden"; hatching and seams are left out.
 * Returns NULL, or what is wrong with it: JUDGE_NO_MEMORY itself where memory
 * ran out. */
const char *judge_read_svg(struct judge_drawing *drawing, const char *text,
                           size_t length);
extern const char JUDGE_NO_MEMORY[];
void judge_drawing_fini(struct judge_drawing *drawing);

/* ---- Where it is seen from ----------------------------------------------- */

struct judge_camera {
  double matrix[12]; /* model to page mm, homogeneous, row by row; the third
                        row is the depth in front of the eye (perspective) */
  bool perspective;
  struct judge_point3 eye;  /* orthographic: near_d counts from it */
  struct judge_point3 back; /* unit, towards the viewer */
  double near_d;            /* nothing nearer to the eye is drawn; perspective:
                             0 or more; orthographic: -INFINITY cuts nothing */
  double depth_step;        /* what rounding does to depths: scene units, in
                             perspective those of 1 / d; 0: nothing */
  double width_mm, height_mm;
  double margin_mm; /* edges are drawn inside of it alone */
};

/* As the design says of --no-fit: camera coordinates (x, y, -d) fall on the
 * page at (W/2 + s x/d, H/2 + s y/d), s = (H - 2 margin) / (2 tan(fov/2)). */
void judge_camera_look(struct judge_camera *camera, struct judge_point3 eye,
                       struct judge_point3 target, struct judge_point3 up,
                       double fov_deg, double width_mm, double height_mm,
                       double margin_mm);

/* From the camera's axes: on the page mm = middle + s (x, y) / d, in an
 * orthographic view s (x, y). */
void judge_camera_axes(struct judge_camera *camera, const double right[3],
                       const double up[3], const double back[3],
                       const double eye[3], bool perspective, double s,
                       const double middle_mm[2], const double page_mm[2]);

/* From the 3 x 4 matrix that a drawing's report holds. */
void judge_camera_matrix(struct judge_camera *camera, const double matrix[12],
                         double width_mm, double height_mm);

/* ---- The verdict --------------------------------------------------------- */

struct judge_options {
  double step_mm;    /* between samples */
  size_t samples;    /* so many of each kind, spread evenly; 0: by step_mm, at
                        least two on every piece */
  double reach_mm;   /* ink this near to a visible point is enough */
  double lateral_mm; /* an edge this near explains a drawn point: the file's
                        own rounding and a little */
  double hair_mm;    /* see above: well above the page grid */
  double contact;    /* scene units, as the drawing was made with; negative:
                        what rounding of the coordinates explains of a face */
  struct precision unstated;  /* of points whose precision nobody stated */
  struct judge_point3 origin; /* what was subtracted from all points, so that
                                their precision is known */
  double crease_deg;
  unsigned edges; /* classes asked for, a mask of recto_edge_class */
  const struct scene_point *given; /* the points to the last digit, where the
                                      scene's were moved; NULL: its own */
  double shortest_mm; /* strokes that are shorter need not be drawn: a visible
                         line without ink that is not surely so long is left
                         open; 0: none is too short */
  bool (*progress)(void *user, double share); /* false: no more is wanted;
                                                 NULL: nobody is asked */
  void *user;
};

/* 0.02 mm steps and reach, 30 degrees, the default classes. */
void judge_options_init(struct judge_options *options);

/* What shows a drawing to be wrong. */
struct judge_witness {
  struct judge_point2 at;
  bool on_edge; /* false: no edge is there, and so none of these */
  struct judge_point3 position; /* of the edge, seen or hidden */
  uint32_t point[2]; /* the edge's ends; SCENE_NONE: an intersection */
  uint32_t face[2];  /* two of its faces; SCENE_NONE */
  uint32_t blocker;  /* the face that hides it; SCENE_NONE */
};

/* Samples, and the length in mm that they stand for. */
struct judge_count {
  size_t samples;
  double mm;
};

struct judge_verdict {
  struct judge_count drawn, false_ink, unsure_ink; /* of strokes: the last two
                                                      are of the first */
  struct judge_count visible, missing;       /* of edges that were asked for */
  struct judge_count hidden, unsure;         /* of these without ink */
  struct judge_witness false_at, missing_at; /* the first of each */
  bool cancelled; /* the caller wanted no more: the rest is not known */
};

/* Judges the strokes that are ink.
 * Returns false when memory ran out. */
USE_RESULT bool judge_drawing(struct judge_verdict *verdict,
                              const struct judge_drawing *drawing,
                              const struct scene *scene,
                              const struct judge_camera *camera,
                              const struct judge_options *options);

#endif
