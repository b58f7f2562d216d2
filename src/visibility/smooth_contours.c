/* smooth_contours.c - decides which pieces of the contour curves are visible,
 * and makes edges of them. */
#include "visibility/smooth_contours.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/poll.h"
#include "base/sort.h"
#include "base/tolerance.h"
#include "view/clip.h"
#include "visibility/contour/curve_pieces.h"
#include "visibility/contour/doubled_contours.h"
#include "visibility/contour/fit_fragments.h"
#include "visibility/contour/fit_outline.h"
#include "visibility/contour/fold_bridges.h"
#include "visibility/contour/intersection_cuts.h"
#include "visibility/contour/line_ends.h"
#include "visibility/contour/occluders.h"
#include "visibility/contour/outline_gaps.h"
#include "visibility/contour/page_crossings.h"
#include "visibility/contour/thin_loops.h"
#include "visibility/index/triangle_grid.h"

/* Visibility is sampled off the surface, by so many heights of the triangles
 * about it: outwards and towards the viewer where the surface bends away from
 * the line of sight, since the mesh about it is uneven; else inwards. */
#define OFFSET_OUT 0.1
#define OFFSET_NEARER 1.0
#define OFFSET_IN 0.6

/* The samples of a piece, at most, and segments whose heights give the offset,
 * to either side of one. */
enum { SAMPLES_MAX = 31, HEIGHT_REACH = 10 };

struct contour_pieces {
  struct sheet *sheet;
  struct map *map;
  const struct topology *topology;
  struct zero_set *set;
  struct contour_curves *curves;
  struct projection projection;
  struct triangle_grid grid;
  struct triangle_grid_query query;
  struct smooth_contours_options options;
  ARRAY(struct contour_piece) piece; /* of the current curve */
  ARRAY(float) height; /* one an edge made: that of its triangle on the page,
                          grid units */
  ARRAY(float) bulge;  /* the same: how far it is from the mesh there */
  uint64_t piece_count;
};

/* ---- The visibility of a point ------------------------------------------- */

static struct geom_point project_place(const struct contour_pieces *c,
                                       const double at[3]) {
  return project_point(&c->projection,
                       camera_view(&c->sheet->camera,
                                   &(struct scene_point){at[0], at[1], at[2]}));
}

/* The median of the triangles' heights along a curve about one of its steps. */
static double height_about(const struct contour_pieces *c,
                           const struct contour_curve *curve, uint32_t step) {
  double height[2 * HEIGHT_REACH + 1];
  size_t count = 0;
  const struct contour_segment *own = contour_curves_segment(c->curves, step);
  for (int i = -HEIGHT_REACH; i <= HEIGHT_REACH; i++) {
    int64_t at = (int64_t)step + i;
    if (at < curve->step || at >= (int64_t)curve->step + curve->count)
      continue;
    const struct contour_segment *s =
        contour_curves_segment(c->curves, (size_t)at);
    if (s != own && (s->along_crease || own->along_crease))
      continue;
    size_t k = count++; /* they are few: each is put where it belongs */
    for (; k > 0 && height[k - 1] > s->width; k--)
      height[k] = height[k - 1];
    height[k] = s->width;
  }
  return height[count / 2];
}

/* How many triangles hide a point of a curve; negative when memory ran out.
 * side  1: the surface bends away from the line of sight, so that the point is
 *       sampled in front of it; -1: it bends into it, which hides the point
 *       unless it is the other side of the surface that is seen */
static int count_occluders_at(struct contour_pieces *c,
                              const struct contour_curve *curve, uint32_t step,
                              double t, int side) {
  const struct contour_node *a = contour_curves_node(c->curves, step);
  const struct contour_node *b = contour_curves_node(c->curves, step + 1);
  const double *normal = contour_curves_segment(c->curves, step)->normal;
  double height = height_about(c, curve, step), at[3], view[3];
  facing_view(&c->sheet->camera, a->flat, view);
  (void)vector_normalise(view);
  double off = height * (side > 0 ? OFFSET_OUT : -OFFSET_IN);
  double near = side > 0 ? height * OFFSET_NEARER : 0;
  for (int k = 0; k < 3; k++)
    at[k] = a->flat[k] + t * (b->flat[k] - a->flat[k]) + off * normal[k] -
            near * view[k];
  return occluders_count(c->sheet, &c->grid, &c->query, project_place(c, at));
}

/* ---- Pieces -------------------------------------------------------------- */

/* The side of the surface on which the line of sight passes a piece: the outer
 * one, as normals have it, unless the surface bends into the line there; then
 * its other side is seen, or nothing. */
static int side_of_piece(const struct contour_pieces *c,
                         const struct contour_piece *piece) {
  int64_t sum = 0;
  for (uint32_t i = piece->from.step; contour_position(piece->to) > i; i++)
    sum += contour_curves_segment(c->curves, i)->radial < 0 ? -1 : 1;
  return sum < 0 ? -1 : 1;
}

static bool sample_piece(struct contour_pieces *c,
                         const struct contour_curve *curve,
                         struct contour_piece *piece) {
  double from = contour_position(piece->from), to = contour_position(piece->to);
  double last = (double)curve->step + curve->count - 1;
  piece->side = side_of_piece(c, piece);
  uint32_t samples = (uint32_t)fmin(ceil(to - from), SAMPLES_MAX) | 1;
  for (uint32_t i = 0; i < samples; i++) {
    double at = from + (to - from) * ((i + 0.5) / samples);
    double step = fmin(floor(at), last);
    int count =
        count_occluders_at(c, curve, (uint32_t)step, at - step, piece->side);
    if (count < 0)
      return false;
    piece->samples++;
    piece->visible += count == 0;
    piece->occluders += (uint32_t)count;
  }
  return true;
}

/* ---- Edges --------------------------------------------------------------- */

static bool add_sheet_point(struct sheet *sheet, struct geom_point at,
                            uint32_t *point) {
  *point = (uint32_t)sheet->point.count;
  return ARRAY_PUSH(&sheet->point, at);
}

/* The sheet's point at a place of a curve. */
static bool point_at(struct contour_pieces *c, struct contour_cut at,
                     uint32_t *point) {
  struct contour_node *node =
      &c->set->node.item[c->curves->step.item[at.step].node];
  if (at.t != 0) {
    const struct geom_point p = node->page,
                            q = contour_curves_node(c->curves, at.step + 1)
                                    ->page;
    return add_sheet_point(
        c->sheet,
        (struct geom_point){(int32_t)snap(p.x + at.t * ((double)q.x - p.x)),
                            (int32_t)snap(p.y + at.t * ((double)q.y - p.y)),
                            p.z + (int64_t)(at.t * (double)(q.z - p.z))},
        point);
  }
  if (node->sheet_point == SHEET_NONE &&
      !add_sheet_point(c->sheet, node->page, &node->sheet_point))
    return false;
  *point = node->sheet_point;
  return true;
}

/* Whether the surface is on the left of a step's segment on the page. */
static bool has_surface_left(const struct contour_pieces *c, uint32_t step,
                             int side) {
  const struct contour_node *a = contour_curves_node(c->curves, step);
  const struct contour_segment *s = contour_curves_segment(c->curves, step);
  double off = s->width * side;
  struct geom_point outside =
      project_place(c, (const double[3]){a->at[0] + off * s->normal[0],
                                         a->at[1] + off * s->normal[1],
                                         a->at[2] + off * s->normal[2]});
  return geom_orient2d(a->page, contour_curves_node(c->curves, step + 1)->page,
                       outside) <= 0;
}

/* How far the curve is from the mesh about a step on the page, grid units. */
static double bulge_at(const struct contour_pieces *c, uint32_t step) {
  double most = 0;
  for (uint32_t i = step; i <= step + 1; i++) {
    const struct contour_node *node = contour_curves_node(c->curves, i);
    struct geom_point flat = project_place(c, node->flat);
    most = fmax(most, hypot((double)node->page.x - flat.x,
                            (double)node->page.y - flat.y));
  }
  return most;
}

/* Makes edges of a piece; *point is the sheet's point where it starts, and gets
 * that where it ends. */
static bool add_edges(struct contour_pieces *c,
                      const struct contour_piece *piece, uint32_t *point) {
  struct sheet *sheet = c->sheet;
  struct contour_cut at = piece->from;
  while (contour_position(at) < contour_position(piece->to)) {
    struct contour_cut next = contour_cut_at(at.step + 1);
    if (at.step == piece->to.step)
      next = piece->to;
    uint32_t face =
        c->set->segment.item[c->curves->step.item[at.step].segment].face;
    struct sheet_edge edge = {
        .point = {*point},
        .triangle = {first_triangle_of_face(sheet, face), SHEET_NONE},
        .source = SHEET_NONE,
        .group = sheet_face_group(sheet, face),
        .edge_class = RECTO_EDGE_SILHOUETTE};
    float height = (float)contour_height(
        &sheet->camera, contour_curves_node(c->curves, at.step),
        contour_curves_segment(c->curves, at.step));
    if (!point_at(c, next, &edge.point[1]) || !ARRAY_PUSH(&sheet->edge, edge) ||
        !ARRAY_PUSH(&c->height, height) ||
        !ARRAY_PUSH(&c->bulge, (float)bulge_at(c, at.step)))
      return false;
    if (!has_surface_left(c, at.step, piece->side)) {
      struct sheet_edge *made = &sheet->edge.item[sheet->edge.count - 1];
      made->point[0] = edge.point[1];
      made->point[1] = edge.point[0];
    }
    c->map->edge_state[c->map->edge_count++] =
        piece->is_visible ? MAP_VISIBLE : MAP_HIDDEN;
    *point = edge.point[1];
    at = next;
  }
  return true;
}

/* Whether more triangles hide a piece than are requested. */
static bool is_too_deep(const struct contour_pieces *c,
                        const struct contour_piece *piece) {
  int most = c->options.hidden_max;
  return most > 0 && !piece->is_visible &&
         piece->occluders > (uint64_t)most * piece->samples;
}

/* ---- Curves -------------------------------------------------------------- */

/* Divides a curve at its cuts, of which *cut is the first, and passes them. */
static bool divide(struct contour_pieces *c, const struct contour_curve *curve,
                   size_t *cut) {
  const struct contour_cut *all = c->curves->cut.item;
  uint32_t end = curve->step + curve->count;
  struct contour_cut from = contour_cut_at(curve->step);
  bool begins_with_cut = false;
  c->piece.count = 0;
  while (contour_position(from) < end) {
    struct contour_piece made = {.from = from, .to = contour_cut_at(end)};
    if (*cut < c->curves->cut.count && all[*cut].step < end)
      made.to = all[(*cut)++];
    from = made.to;
    if (contour_position(made.from) == contour_position(made.to))
      begins_with_cut = true;
    else if (!sample_piece(c, curve, &made) || !ARRAY_PUSH(&c->piece, made))
      return false;
  }
  /* A closed curve's first and last piece are one. */
  if (curve->closed && !begins_with_cut && c->piece.count > 1) {
    struct contour_piece *first = &c->piece.item[0],
                         *last = &c->piece.item[c->piece.count - 1];
    first->visible = last->visible += first->visible;
    first->samples = last->samples += first->samples;
    first->occluders = last->occluders += first->occluders;
  }
  for (size_t i = 0; i < c->piece.count; i++)
    c->piece.item[i].is_visible =
        2 * c->piece.item[i].visible > c->piece.item[i].samples;
  return true;
}

static bool add_curve(struct contour_pieces *c,
                      const struct contour_curve *curve, size_t *cut) {
  uint32_t point = SHEET_NONE;
  if (!divide(c, curve, cut))
    return false;
  struct curve_pieces pieces = {c->curves, curve, c->piece.item,
                                c->piece.count};
  curve_pieces_hide_pierced(&pieces, c->sheet);
  curve_pieces_absorb_short(&pieces);
  if (!c->options.exact)
    curve_pieces_absorb_runs(&pieces, &c->sheet->camera);
  for (size_t i = 0; i < c->piece.count; i++) {
    const struct contour_piece *piece = &c->piece.item[i];
    if (point == SHEET_NONE && !point_at(c, piece->from, &point))
      return false;
    if (is_too_deep(c, piece))
      point = SHEET_NONE;
    else if (!add_edges(c, piece, &point))
      return false;
  }
  c->piece_count += c->piece.count;
  return true;
}

static bool add_all_curves(struct contour_pieces *c) {
  struct map *map = c->map;
  size_t most =
      c->sheet->edge.count + c->curves->step.count + c->curves->cut.count;
  uint8_t *state = mem_resize(map->edge_state, most, 1);
  if (state == NULL)
    return false;
  map->edge_state = state;
  size_t cut = 0;
  for (size_t i = 0; i < c->curves->curve.count; i++)
    if (!poll_at(i) || !add_curve(c, &c->curves->curve.item[i], &cut))
      return false;
  return true;
}

/* ---- The whole ----------------------------------------------------------- */

/* Adds what curves lack.
 * first, first_point  of the sheet's edges and points: those of the curves */
static bool close_gaps(struct contour_pieces *c, uint32_t first,
                       uint32_t first_point) {
  const struct outline_gaps_input input = {.sheet = c->sheet,
                                           .map = c->map,
                                           .set = c->set,
                                           .first = first,
                                           .first_point = first_point,
                                           .bulge = c->bulge.item,
                                           .bulges = (uint32_t)c->bulge.count,
                                           .grid = &c->grid,
                                           .query = &c->query};
  return fold_bridges_add(&input, c->height.item) && outline_gaps_close(&input);
}

static bool add_pieces(struct contour_pieces *c) {
  uint32_t first = (uint32_t)c->sheet->edge.count;
  uint32_t first_point = (uint32_t)c->sheet->point.count;
  if (c->set->outline.count == 0 && c->set->segment.count == 0)
    return true;
  bool ok = contour_curves_join(c->curves, c->set, c->options.crease_deg) &&
            (c->options.exact ||
             thin_loops_remove(c->curves, c->set, c->sheet, c->topology)) &&
            contour_curves_cut_at_cusps(c->curves) &&
            page_crossings_cut(c->curves) &&
            intersection_cuts_add(c->curves, c->sheet, c->map) &&
            contour_cuts_sort(&c->curves->cut) &&
            triangle_grid_init(&c->grid, c->sheet);
  if (!ok)
    return false;
  ok = triangle_grid_query_init(&c->query, &c->grid) && add_all_curves(c) &&
       doubled_contours_hide(c->sheet, c->map, first, c->height.item,
                             c->options.exact
                                 ? RECTO_FINEST_MM * SHEET_UNITS_PER_MM
                                 : TOLERANCE_OUTLINE_UNITS) &&
       close_gaps(c, first, first_point);
  triangle_grid_query_fini(&c->query);
  triangle_grid_fini(&c->grid);
  ARRAY_FREE(&c->piece);
  ARRAY_FREE(&c->height);
  ARRAY_FREE(&c->bulge);
  return ok;
}

/* Makes the visible fragments end at the contours. */
static bool fit_to_contours(const struct sheet *sheet, struct map *map,
                            const struct topology *topology, uint32_t first) {
  struct drawn_outlines drawn = {.map = map, .sheet = sheet, .first = first};
  bool ok = drawn_outlines_list(&drawn) &&
            fit_fragments(map, sheet, topology, &drawn) &&
            fit_outline(map, sheet, &drawn);
  drawn_outlines_fini(&drawn);
  return ok;
}

/* Makes other lines and the visible fragments end at the contours, which are
 * the sheet's edges from `first` on. */
static bool end_at_contours(const struct sheet *sheet, struct map *map,
                            const struct topology *topology, uint32_t first) {
  return first == sheet->edge.count ||
         (line_ends_move(map, sheet, first) &&
          (map->fragment.count == 0 ||
           fit_to_contours(sheet, map, topology, first)));
}

/* Intersections that are known only since contours end at them are not
 * drawn. */
static void forget_intersections(struct sheet *sheet) {
  for (size_t e = 0; e < sheet->edge.count; e++)
    if (sheet->edge.item[e].edge_class == RECTO_EDGE_INTERSECTION)
      sheet->edge.item[e].edge_class = 0;
}

recto_status smooth_contours_add(struct sheet *sheet, struct map *map,
                                 const struct topology *topology,
                                 struct smooth_contours_options options,
                                 struct smooth_contours_counts *counts,
                                 recto_error *error) {
  uint32_t first = (uint32_t)sheet->edge.count;
  struct facing facing;
  struct zero_set set = {.node = {0}};
  struct contour_curves curves = {.set = &set};
  recto_status status =
      facing_init(&facing, sheet, topology, options.crease_deg, error);
  if (status == RECTO_OK)
    status = zero_set_find(&set, &facing, error);
  facing_fini(&facing);
  struct contour_pieces pieces = {.sheet = sheet,
                                  .map = map,
                                  .topology = topology,
                                  .set = &set,
                                  .curves = &curves,
                                  .projection = projection_of(&sheet->camera),
                                  .options = options};
  if (status == RECTO_OK &&
      !(add_pieces(&pieces) && end_at_contours(sheet, map, topology, first)))
    status = error_memory(error);
  if (!options.intersections)
    forget_intersections(sheet);
  *counts = (struct smooth_contours_counts){
      set.segment.count, curves.curve.count, pieces.piece_count};
  contour_curves_fini(&curves);
  zero_set_fini(&set);
  return status;
}
