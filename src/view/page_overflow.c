/* page_overflow.c - measures the requested lines that the page's margins clip
 * away. */
#include "view/page_overflow.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "geom/vector.h"
#include "scene/edges/edge_classes.h"
#include "view/project.h"

struct measure {
  struct page_overflow *overflow;
  const struct scene *scene;
  const struct topology *topology;
  const struct camera *camera;
};

struct page_point {
  double mm[2];
};

/* ---- One line ------------------------------------------------------------ */

static struct page_point page_point_of(const struct camera *camera,
                                       struct view_point p) {
  double scale = camera->perspective ? camera->s / p.d : camera->s;
  return (struct page_point){
      {camera->middle_mm[0] + scale * p.x, camera->middle_mm[1] + scale * p.y}};
}

/* Clips to the near plane; false where nothing is left. */
static bool cut_near(const struct camera *camera, struct view_point end[2]) {
  double a = end[0].d - camera->near_d, b = end[1].d - camera->near_d;
  if (a < 0 && b < 0)
    return false;
  if (a >= 0 && b >= 0)
    return true;
  int outside = b < 0;
  double t = a / (a - b);
  end[outside] =
      (struct view_point){end[0].x + t * (end[1].x - end[0].x),
                          end[0].y + t * (end[1].y - end[0].y), camera->near_d};
  return true;
}

/* The fraction of a line's length that is inside the margins. */
static double share_inside(const struct camera *camera,
                           const struct page_point *a,
                           const struct page_point *b) {
  double from = 0, to = 1;
  for (int k = 0; k < 2; k++) {
    double low = camera->margin_mm - SHEET_BLEED / SHEET_UNITS_PER_MM;
    double high = camera->page_mm[k] - low;
    double run = b->mm[k] - a->mm[k];
    if (run == 0 && (a->mm[k] < low || a->mm[k] > high))
      return 0;
    if (run == 0)
      continue;
    double in = (low - a->mm[k]) / run, out = (high - a->mm[k]) / run;
    from = fmax(from, fmin(in, out));
    to = fmin(to, fmax(in, out));
  }
  return fmax(0, to - from);
}

static void record_excess(struct measure *measure,
                          const struct page_point *at) {
  const struct camera *camera = measure->camera;
  for (int k = 0; k < 2; k++) {
    double low = camera->margin_mm, high = camera->page_mm[k] - low;
    double excess = fmax(low - at->mm[k], at->mm[k] - high);
    if (excess < RECTO_FINEST_MM)
      continue;
    measure->overflow->axis[k] = true;
    measure->overflow->excess_mm = fmax(measure->overflow->excess_mm, excess);
  }
}

static struct view_point view_of_scene_point(const struct measure *measure,
                                             uint32_t point) {
  return camera_view(measure->camera, &measure->scene->point.item[point]);
}

/* Adds what a line loses; losses shorter than RECTO_FINEST_MM, which no pen
 * can draw, are ignored. */
static void measure_line(struct measure *measure, uint32_t from, uint32_t to) {
  struct view_point end[2] = {view_of_scene_point(measure, from),
                              view_of_scene_point(measure, to)};
  if (!cut_near(measure->camera, end))
    return;
  struct page_point a = page_point_of(measure->camera, end[0]);
  struct page_point b = page_point_of(measure->camera, end[1]);
  double length = hypot(b.mm[0] - a.mm[0], b.mm[1] - a.mm[1]);
  double lost = length * (1 - share_inside(measure->camera, &a, &b));
  if (!(lost >= RECTO_FINEST_MM))
    return;
  measure->overflow->edges++;
  measure->overflow->mm += lost;
  record_excess(measure, &a);
  record_excess(measure, &b);
}

/* ---- Edges --------------------------------------------------------------- */

/* A number that is positive where a face is seen from one side and negative
 * where it is seen from the other: the signed volume that it spans with the
 * eye, in the order of its corners. */
static double side_of_face(const struct measure *measure, uint32_t face) {
  const struct scene *scene = measure->scene;
  uint32_t start = scene_face_start(scene, face);
  uint32_t end = scene_face_start(scene, face + 1);
  struct view_point at =
      view_of_scene_point(measure, scene->corner.item[start]);
  double normal[3] = {0, 0, 0};
  struct view_point last =
      view_of_scene_point(measure, scene->corner.item[start + 1]);
  for (uint32_t c = start + 2; c < end; c++) {
    struct view_point here =
        view_of_scene_point(measure, scene->corner.item[c]);
    const double u[3] = {last.x - at.x, last.y - at.y, last.d - at.d};
    const double v[3] = {here.x - at.x, here.y - at.y, here.d - at.d};
    double cross[3];
    vector_cross(u, v, cross);
    for (int k = 0; k < 3; k++)
      normal[k] += cross[k];
    last = here;
  }
  return measure->camera->perspective
             ? normal[0] * at.x + normal[1] * at.y + normal[2] * at.d
             : normal[2];
}

static bool is_silhouette(const struct measure *measure,
                          const struct topology_edge *edge) {
  if (edge->uses != 2 || edge->first == edge->second)
    return false;
  double a = side_of_face(measure, edge->first);
  double b = side_of_face(measure, edge->second);
  return edge->same_way ? a * b > 0 : a * b < 0;
}

static recto_status measure_edges(struct measure *measure,
                                  const recto_options *options,
                                  recto_error *error) {
  const struct topology *topology = measure->topology;
  uint8_t *class_masks = mem_alloc(topology->edge.count, sizeof *class_masks);
  bool ok = class_masks != NULL &&
            topology_class_masks(topology, measure->scene,
                                 options->mesh.crease_deg, class_masks);
  for (size_t e = 0; ok && e < topology->edge.count; e++) {
    const struct topology_edge *edge = &topology->edge.item[e];
    if ((class_masks[e] & options->ink.edges) != 0 ||
        ((options->ink.edges & RECTO_EDGE_SILHOUETTE) != 0 &&
         is_silhouette(measure, edge)))
      measure_line(measure, edge->point[0], edge->point[1]);
    ok = poll_at(e);
  }
  mem_free(class_masks);
  return ok ? RECTO_OK : error_memory(error);
}

static void measure_polylines(struct measure *measure) {
  const struct scene *scene = measure->scene;
  for (uint32_t w = 0; w < scene_wire_count(scene); w++)
    for (uint32_t c = scene->wire_start.item[w];
         c + 1 < scene->wire_start.item[w + 1]; c++)
      measure_line(measure, scene->wire_corner.item[c],
                   scene->wire_corner.item[c + 1]);
}

recto_status page_overflow_measure(struct page_overflow *overflow,
                                   const struct scene *scene,
                                   const struct topology *topology,
                                   const struct camera *camera,
                                   const recto_options *options,
                                   recto_error *error) {
  const unsigned of_faces =
      RECTO_EDGES_ALL & ~(unsigned)(RECTO_EDGE_WIRE | RECTO_EDGE_INTERSECTION);
  struct measure measure = {overflow, scene, topology, camera};
  *overflow = (struct page_overflow){0};
  if ((options->ink.edges & RECTO_EDGE_WIRE) != 0)
    measure_polylines(&measure);
  return (options->ink.edges & of_faces) != 0
             ? measure_edges(&measure, options, error)
             : RECTO_OK;
}
