/* result_edges.c - the edges of a drawing with their visible and hidden parts.
 *
 * The parameters of an edge on the sheet run along the part of it that is on
 * the page, in perspective.  For the caller they are converted to the whole
 * edge in the scene: with the homogeneous images A and B of its points,
 *   x = (xA + t (xB - xA)) / (wA + t (wB - wA))
 * is solved for t in that of x and y in which the edge is longer. */
#include <math.h>

#include "api/handle.h"
#include "api/result.h"
#include "api/sized.h"
#include "base/poll.h"

/* The homogeneous images of an edge's two points in the scene. */
struct edge_image {
  bool is_known; /* false: the edge has no such points */
  double a[3], b[3];
};

struct edge_results {
  recto_drawing *drawing;
  const struct sheet *sheet;
  const struct map *map;
  const struct topology *topology;
  const struct scene *scene;
  int exponent;
  bool with_counts;
  size_t next_mixed, next_count; /* the first entries of the map that may be of
                                    the current edge */
  /* The current edge: */
  struct result_edge *edge;
  struct edge_image image;
  double at;                               /* where the part before ends */
  uint32_t next_invisible, past_invisible; /* its intervals with counts */
};

/* ---- Sources ------------------------------------------------------------- */

static uint32_t face_number(const struct edge_results *r, uint32_t triangle) {
  if (triangle == SHEET_NONE)
    return RECTO_NONE;
  uint32_t face = r->sheet->triangles_dropped
                      ? triangle
                      : r->sheet->triangle.item[triangle].face;
  return scene_face_number(r->scene, face);
}

/* The scene's points of an edge; false: it has none. */
static bool find_points(struct edge_results *r, const struct sheet_edge *edge,
                        uint32_t point[2]) {
  if (edge->source == SHEET_NONE)
    return false;
  if (edge->edge_class != RECTO_EDGE_WIRE) {
    for (int k = 0; k < 2; k++)
      point[k] = r->topology->edge.item[edge->source].point[k];
    return true;
  }
  uint32_t start = r->scene->wire_start.item[edge->source];
  uint32_t count = r->scene->wire_start.item[edge->source + 1] - start;
  if (count > UINT16_MAX + 1u) /* edge->part has 16 bits */
    return false;
  for (uint32_t k = 0; k < 2; k++)
    point[k] = r->scene->wire_corner.item[start + edge->part + k];
  return true;
}

/* ---- Parameters ---------------------------------------------------------- */

static void project_point_mm(const struct edge_results *r, uint32_t point,
                             double to[3]) {
  const double *m = r->drawing->matrix;
  const struct scene_point *p = &r->scene->point.item[point];
  double x = ldexp(p->x, r->exponent), y = ldexp(p->y, r->exponent);
  double z = ldexp(p->z, r->exponent);
  for (int i = 0; i < 3; i++, m += 4)
    to[i] = m[0] * x + m[1] * y + m[2] * z + m[3];
}

/* The number that a point has for the caller: none where a cut made it. */
static uint32_t point_number(const struct edge_results *r, uint32_t point) {
  const struct scene_cut *cut = r->scene->cut;
  return cut != NULL && point >= cut->first_point ? RECTO_NONE : point;
}

/* The point of the sheet's edge at a parameter, in mm. */
static void edge_point_mm(const struct edge_results *r,
                          const struct sheet_edge *edge, double t,
                          double mm[2]) {
  const struct geom_point *a = &r->sheet->point.item[edge->point[0]];
  const struct geom_point *b = &r->sheet->point.item[edge->point[1]];
  mm[0] = sheet_x_mm(r->sheet, (double)a->x + t * (double)(b->x - a->x));
  mm[1] = sheet_y_mm(r->sheet, (double)a->y + t * (double)(b->y - a->y));
}

/* Whether the image of a point was rounded to this point of the page. */
static bool is_image(const double image[3], const double mm[2]) {
  const double unit = 1 / SHEET_UNITS_PER_MM;
  return image[2] > 0 && fabs(image[0] / image[2] - mm[0]) <= unit &&
         fabs(image[1] / image[2] - mm[1]) <= unit;
}

/* The parameter along the edge in the scene of a point of its image.
 * t  along the edge on the sheet, for where the other cannot be found */
static double parameter_of(const struct edge_image *image, const double mm[2],
                           double t) {
  if (!image->is_known)
    return t;
  if ((t == 0 && is_image(image->a, mm)) || (t == 1 && is_image(image->b, mm)))
    return t;
  const double *a = image->a, *b = image->b;
  double above[2], below[2];
  for (int i = 0; i < 2; i++) {
    above[i] = mm[i] * a[2] - a[i];
    below[i] = b[i] - a[i] - mm[i] * (b[2] - a[2]);
  }
  int axis = fabs(below[0]) >= fabs(below[1]) ? 0 : 1;
  double found = above[axis] / below[axis];
  return isfinite(found) ? fmin(fmax(found, 0), 1) : t;
}

/* ---- Parts --------------------------------------------------------------- */

/* Adds the part up to the parameter t1 of the sheet's edge, from where the part
 * before it ends.  A part that is shorter than the page grid can show is left
 * to the next one, so that the parts are adjacent. */
static bool add_edge_part(struct edge_results *r, const struct sheet_edge *edge,
                          double t1, uint32_t hidden_by) {
  double t0 = r->at;
  if (!(t0 < t1))
    return true;
  recto_interval part = {.hidden_by = hidden_by};
  edge_point_mm(r, edge, t0, part.from_mm);
  edge_point_mm(r, edge, t1, part.to_mm);
  part.t0 = parameter_of(&r->image, part.from_mm, t0);
  part.t1 = parameter_of(&r->image, part.to_mm, t1);
  if (!(part.t0 < part.t1))
    return true;
  r->at = t1;
  r->edge->count++;
  return ARRAY_PUSH(&r->drawing->interval, part);
}

/* Adds the parts of a hidden interval that ends at t1, split by the number of
 * faces that hide them. */
static bool add_hidden(struct edge_results *r, const struct sheet_edge *edge,
                       double t1) {
  const struct map_invisible_interval *interval =
      ARRAY_AT(&r->map->invisible_interval, r->next_invisible);
  if (!r->with_counts)
    return add_edge_part(r, edge, t1, RECTO_NONE);
  for (; r->next_invisible < r->past_invisible;
       r->next_invisible++, interval++) {
    double from = ratio_to_double(interval->interval.t0);
    double to = ratio_to_double(interval->interval.t1);
    if (from >= t1)
      break;
    /* A raster method hides what no face hides. */
    if (!add_edge_part(r, edge, fmin(from, t1), RECTO_NONE) ||
        !add_edge_part(r, edge, fmin(to, t1), interval->faces))
      return false;
    if (to > t1)
      break;
  }
  return add_edge_part(r, edge, t1, RECTO_NONE);
}

static bool add_parts(struct edge_results *r, const struct sheet_edge *edge,
                      uint32_t e) {
  const struct map *map = r->map;
  r->at = 0;
  for (; r->next_count < map->invisible.count &&
         map->invisible.item[r->next_count].edge < e;)
    r->next_count++;
  r->next_invisible = r->past_invisible = 0;
  if (r->next_count < map->invisible.count &&
      map->invisible.item[r->next_count].edge == e) {
    r->next_invisible = map->invisible.item[r->next_count].interval;
    r->past_invisible =
        r->next_invisible + map->invisible.item[r->next_count].count;
  }
  if (map->edge_state[e] == MAP_VISIBLE)
    return add_edge_part(r, edge, 1, 0);
  if (map->edge_state[e] == MAP_MIXED) {
    while (map->mixed.item[r->next_mixed].edge < e)
      r->next_mixed++;
    const struct map_mixed *mixed = &map->mixed.item[r->next_mixed];
    for (uint32_t i = 0; i < mixed->count; i++) {
      const struct map_interval *visible =
          &map->interval.item[mixed->interval + i];
      if (!add_hidden(r, edge, ratio_to_double(visible->t0)) ||
          !add_edge_part(r, edge, ratio_to_double(visible->t1), 0))
        return false;
    }
  }
  return add_hidden(r, edge, 1);
}

static bool add_edge_result(struct edge_results *r, uint32_t e) {
  const struct sheet_edge *edge = &r->sheet->edge.item[e];
  struct result_edge result = {.point = {RECTO_NONE, RECTO_NONE},
                               .face = {face_number(r, edge->triangle[0]),
                                        face_number(r, edge->triangle[1])},
                               .group = sheet_edge_group(r->sheet, edge),
                               .number = edge->source,
                               .edge_class = (recto_edge_class)edge->edge_class,
                               .interval =
                                   (uint32_t)r->drawing->interval.count};
  r->image.is_known = find_points(r, edge, result.point);
  if (r->image.is_known) {
    project_point_mm(r, result.point[0], r->image.a);
    project_point_mm(r, result.point[1], r->image.b);
    result.point[0] = point_number(r, result.point[0]);
    result.point[1] = point_number(r, result.point[1]);
  }
  if (result.edge_class == RECTO_EDGE_WIRE && r->scene->cut != NULL)
    result.number = r->scene->cut->wire[result.number];
  r->edge = &result;
  return add_parts(r, edge, e) && ARRAY_PUSH(&r->drawing->edge, result);
}

recto_status drawing_store_edges(recto_drawing *drawing,
                                 const struct result_sources *sources,
                                 recto_error *error) {
  struct edge_results r = {.drawing = drawing,
                           .sheet = sources->sheet,
                           .map = sources->map,
                           .topology = sources->topology,
                           .scene = sources->scene,
                           .exponent = sources->exponent,
                           .with_counts = sources->with_counts};
  for (uint32_t e = 0; e < r.map->edge_count; e++)
    if (!poll_at(e) ||
        (sheet_edge_is_drawn(r.sheet, e) && !add_edge_result(&r, e)))
      return error_memory(error);
  return RECTO_OK;
}

/* ---- For the caller ------------------------------------------------------ */

size_t recto_drawing_edge_count(const recto_drawing *drawing) {
  return drawing != NULL ? drawing->edge.count : 0;
}

bool recto_drawing_edge_sized(const recto_drawing *drawing, size_t index,
                              recto_edge *edge, size_t size) {
  recto_edge own = {.points = {RECTO_NONE, RECTO_NONE},
                    .faces = {RECTO_NONE, RECTO_NONE},
                    .group = RECTO_NONE,
                    .number = RECTO_NONE};
  bool is_there = index < recto_drawing_edge_count(drawing);
  if (is_there) {
    const struct result_edge *from = &drawing->edge.item[index];
    own =
        (recto_edge){.edge_class = from->edge_class,
                     .points = {from->point[0], from->point[1]},
                     .faces = {from->face[0], from->face[1]},
                     .group = from->group,
                     .number = from->number,
                     .intervals = ARRAY_AT(&drawing->interval, from->interval),
                     .interval_count = from->count};
  }
  return sized_copy_out(edge, size, &own, sizeof own) && is_there;
}
