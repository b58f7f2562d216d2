/* intersection_cuts.c - finds the places of curves that are nearest to where
 * visible intersections end.
 *
 * Where a contour passes through a face, the intersection with it passes from
 * what is seen of the contour's surface to what is not: it ends there, and its
 * image is tangent to that of the contour.  So their crossing on the page is
 * ill-conditioned, and of a mesh, about whose outline the contour winds, there
 * may be none.  The place of the curve's image on the flat mesh that is nearest
 * to the end is found instead. */
#include "visibility/contour/intersection_cuts.h"

#include <math.h>

#include "base/poll.h"
#include "geom/nearest.h"
#include "view/project.h"
#include "visibility/contour/intersection_ends.h"
#include "visibility/contour/segment_grid.h"

/* The place of a curve that is nearest to an end. */
struct nearest_place {
  uint32_t curve;
  struct contour_cut cut;
  double away; /* on the page, grid units */
};

struct intersection_cuts {
  const struct sheet *sheet;
  struct contour_curves *curves;
  struct projection projection;
  struct intersection_ends end;     /* of the intersections */
  struct segment_grid grid;         /* of the curves' images on the mesh */
  ARRAY(struct nearest_place) near; /* of the current end: one a curve */
  uint32_t *place; /* one a curve: where it is in `near`, if it is there */
  uint32_t
      *seen_by; /* one a segment: the last end, from 1 on, that it was looked
                        at for, as it lies in several cells */
};

/* ---- The nearest place --------------------------------------------------- */

static struct geom_point image_on_mesh(const struct intersection_cuts *c,
                                       uint32_t step) {
  const double *at = contour_curves_node(c->curves, step)->flat;
  return project_point(&c->projection,
                       camera_view(&c->sheet->camera,
                                   &(struct scene_point){at[0], at[1], at[2]}));
}

static bool add_curves(struct intersection_cuts *c) {
  for (uint32_t i = 0; i < c->curves->step.count; i++)
    if (c->curves->step.item[i].segment != SHEET_NONE &&
        !segment_grid_add(
            &c->grid,
            (struct geom_segment){image_on_mesh(c, i), image_on_mesh(c, i + 1)},
            i))
      return false;
  c->grid.contours = c->grid.segment.count;
  c->place = mem_calloc(c->curves->curve.count, sizeof *c->place);
  c->seen_by = mem_calloc(c->grid.contours, sizeof *c->seen_by);
  return c->place != NULL && c->seen_by != NULL &&
         (c->grid.contours == 0 || segment_grid_make(&c->grid));
}

static double distance_in_view(struct view_point a, struct view_point b) {
  return hypot(hypot(a.x - b.x, a.y - b.y), a.d - b.d);
}

/* How far a curve may be from an end where it passes through a face: the length
 * of the longest side of the two triangles that intersect there, in view
 * coordinates. */
static double reach_of(const struct intersection_cuts *c, uint32_t edge) {
  double most = 0;
  for (int k = 0; k < 2; k++) {
    struct geom_triangle t =
        sheet_corners(c->sheet, c->sheet->edge.item[edge].triangle[k]);
    for (int i = 0; i < 3; i++)
      most = fmax(most,
                  distance_in_view(unproject_point(&c->projection, t.p[i]),
                                   unproject_point(&c->projection,
                                                   t.p[geom_next_corner(i)])));
  }
  return most;
}

/* The curve of a step: the last one that starts at it or before. */
static uint32_t curve_of_step(const struct intersection_cuts *c,
                              uint32_t step) {
  const struct contour_curve *curve = c->curves->curve.item;
  size_t low = 0, high = c->curves->curve.count;
  while (high - low > 1) {
    size_t middle = low + (high - low) / 2;
    if (curve[middle].step <= step)
      low = middle;
    else
      high = middle;
  }
  return (uint32_t)low;
}

/* Keeps a place if it is the nearest one of its curve. */
static bool keep_nearest(struct intersection_cuts *c,
                         struct nearest_place place) {
  uint32_t i = c->place[place.curve];
  if (i < c->near.count && c->near.item[i].curve == place.curve) {
    if (place.away < c->near.item[i].away)
      c->near.item[i] = place;
    return true;
  }
  c->place[place.curve] = (uint32_t)c->near.count;
  return ARRAY_PUSH(&c->near, place);
}

/* Looks for the nearest place on a segment; it must not be farther away in
 * space than `reach`. */
static bool look_at(struct intersection_cuts *c, const struct page_segment *s,
                    const struct intersection_end *end, double reach) {
  c->curves->compared++;
  double dx = (double)s->q.x - s->p.x, dy = (double)s->q.y - s->p.y;
  double px = (double)end->at.x - s->p.x, py = (double)end->at.y - s->p.y;
  double t = geom_nearest_parameter(dx, dy, px, py);
  const struct geom_point at = {(int32_t)snap(s->p.x + t * dx),
                                (int32_t)snap(s->p.y + t * dy),
                                (int64_t)page_segment_depth(s, t)};
  if (distance_in_view(unproject_point(&c->projection, at),
                       unproject_point(&c->projection, end->at)) > reach)
    return true;
  return keep_nearest(
      c, (struct nearest_place){curve_of_step(c, s->owner),
                                {s->owner, fmin(t, 1 - 0x1p-30), true, 0},
                                hypot(px - t * dx, py - t * dy)});
}

/* How far the reach of an end goes on the page. */
static double units_about(const struct intersection_cuts *c,
                          const struct intersection_end *end, double reach) {
  const struct projection *projection = &c->projection;
  double units = reach * projection->units;
  return projection->perspective
             ? units / unproject_point(projection, end->at).d
             : units;
}

static bool is_first_look(struct intersection_cuts *c, size_t segment,
                          const struct intersection_end *end) {
  uint32_t number = (uint32_t)(end - c->end.item) + 1;
  bool is_first = c->seen_by[segment] != number;
  c->seen_by[segment] = number;
  return is_first;
}

/* Cuts the curves that are near an end. */
static bool cut_curves_near(struct intersection_cuts *c,
                            const struct intersection_end *end) {
  double reach = reach_of(c, end->edge);
  struct segment_walk walk = segment_grid_near(&c->grid, end->at.x, end->at.y,
                                               units_about(c, end, reach));
  const struct page_segment *s;
  c->near.count = 0;
  while ((s = segment_walk_next(&walk)) != NULL)
    if (is_first_look(c, (size_t)(s - c->grid.segment.item), end) &&
        !look_at(c, s, end, reach))
      return false;
  for (size_t i = 0; i < c->near.count; i++)
    if (!ARRAY_PUSH(&c->curves->cut, c->near.item[i].cut))
      return false;
  return true;
}

bool intersection_cuts_add(struct contour_curves *curves,
                           const struct sheet *sheet, const struct map *map) {
  struct intersection_cuts c = {.sheet = sheet,
                                .curves = curves,
                                .projection = projection_of(&sheet->camera)};
  bool ok =
      intersection_ends_list(&c.end, sheet, map, (uint32_t)sheet->edge.count) &&
      (c.end.count == 0 || add_curves(&c));
  for (size_t i = 0; ok && i < c.end.count && c.grid.contours > 0; i++)
    ok = poll_at(i) && cut_curves_near(&c, &c.end.item[i]);
  ARRAY_FREE(&c.end);
  ARRAY_FREE(&c.near);
  mem_free(c.place);
  mem_free(c.seen_by);
  segment_grid_fini(&c.grid);
  return ok;
}
