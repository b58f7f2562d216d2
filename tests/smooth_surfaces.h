/* smooth_surfaces.h - meshes that sample smooth surfaces, and their drawings:
 * what the tests of smooth contours share. */
#ifndef TESTS_SMOOTH_SURFACES_H
#define TESTS_SMOOTH_SURFACES_H

#include "recto.h"

enum { SMOOTH_VIEWS = 20 };

#define SMOOTH_PAGE_MM 200.0
#define SMOOTH_SCALE_MM 60.0    /* a model unit */
#define SMOOTH_TORUS_RADIUS 0.4 /* of its tube; that of its circle is 1 */
#define SMOOTH_KNOT_RADIUS 0.2

/* A point of a surface at angles u and v. */
typedef void smooth_surface(double u, double v, double p[3]);
void smooth_torus(double u, double v, double p[3]);
void smooth_knot(double u, double v, double p[3]);
void smooth_sphere(double u, double v, double p[3]);
void smooth_ellipsoid(double u, double v, double p[3]);

/* A point of a curve: those about which the tubes lie. */
typedef void smooth_curve(double u, double p[3]);
void smooth_circle(double u, double p[3]);
void smooth_trefoil(double u, double p[3]);

/* Two directions across a curve, and each other. */
void smooth_frame(smooth_curve *at, double u, double normal[3],
                  double binormal[3]);

/* Adds a mesh of n x m quads, cut in two.
 * poles  v runs from pole to pole; else it is closed as u is */
void smooth_add(recto_scene *scene, smooth_surface *at, bool poles, int n,
                int m);

/* A scene of such a mesh. */
recto_scene *smooth_scene(smooth_surface *at, bool poles, int n, int m);

/* A scene of quadrilaterals; three coordinates a point. */
recto_scene *smooth_quads(const double *point, size_t points,
                          const uint32_t *corner, size_t corners);

/* A view of every direction but those along the axes and almost so. */
void smooth_view(recto_options *options, int view);

/* The directions on the page, and towards the viewer; up is +Y. */
struct smooth_axes {
  double right[3], up[3], back[3];
};

struct smooth_axes smooth_axes_of(const recto_options *options);

double smooth_dot(const double a[3], const double b[3]);

recto_drawing *smooth_draw(const recto_scene *scene,
                           const recto_options *options);

double smooth_distance_to_segment(const double at[2], const double p[2],
                                  const double q[2]);

/* The distance from a point to the strokes of these classes, mm. */
double smooth_distance_to_ink(const recto_drawing *drawing, unsigned classes,
                              const double at[2]);

/* How far the middles of a drawing's segments are from the ink of another one,
 * at most, mm. */
double smooth_farthest_middle(const recto_drawing *of,
                              const recto_drawing *from);

/* How many ends of strokes of some classes no other stroke of `others` is
 * within `mm` of. */
int smooth_loose_ends(const recto_drawing *drawing, unsigned classes,
                      unsigned others, double mm);

#endif
