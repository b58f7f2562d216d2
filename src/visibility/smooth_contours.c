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
#include "geom/vector.h"
#include "view/clip.h"
#include "visibility/contour/contour_creases.h"
#include "visibility/contour/curve_pieces.h"
#include "visibility/contour/divided_curves.h"
#include "visibility/contour/doubled_contours.h"
#include "visibility/contour/intersection_cuts.h"
#include "visibility/fit/border_ends.h"
#include "visibility/fit/fit_fragments.h"
#include "visibility/fit/fit_outline.h"
#include "visibility/fit/line_ends.h"
#include "visibility/fold/fold_bridges.h"
#include "visibility/fold/fold_lines.h"
#include "visibility/fold/intersection_gaps.h"
#include "visibility/fold/outline_gaps.h"
#include "visibility/fold/outlined_curves.h"
#include "visibility/index/partial_grid.h"
#include "visibility/zero_set/folded_faces.h"

struct contour_pieces {
  struct sheet *sheet;
  struct map *map;
  struct zero_set *set;
  const struct outline_chains *chains;
  struct contour_curves *curves;
  struct divided_curves divided;
  struct partial_grid grid; /* about the curves and the mesh's outlines */
  struct triangle_grid_query query;
  struct occluders occluders;
  bool exact;
  struct smooth_contours_options options;
  ARRAY(float) height; /* one an edge made: that of its triangle on the page,
                          grid units */
  ARRAY(float) bulge;  /* the same: how far it is from the mesh there */
};

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

/* How far the curve is from the mesh about a step on the page, grid units. */
static double bulge_at(const struct contour_pieces *c, uint32_t step) {
  double most = 0;
  for (uint32_t i = step; i <= step + 1; i++) {
    const struct contour_node *node = contour_curves_node(c->curves, i);
    struct geom_point flat = divided_curves_project(&c->divided, node->flat);
    most = fmax(most, vector2_length((double)node->page.x - flat.x,
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
        .edge_class = RECTO_EDGE_SILHOUETTE};
    float height = (float)contour_height(
        &sheet->camera, contour_curves_node(c->curves, at.step),
        contour_curves_segment(c->curves, at.step));
    if (!point_at(c, next, &edge.point[1]) || !ARRAY_PUSH(&sheet->edge, edge) ||
        !ARRAY_PUSH(&c->height, height) ||
        !ARRAY_PUSH(&c->bulge, (float)bulge_at(c, at.step)))
      return false;
    if (!contour_curves_surface_is_left(c->curves, &sheet->camera,
                                        &c->divided.projection, at.step,
                                        piece->side)) {
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

static bool add_curve(struct contour_pieces *c, size_t index) {
  uint32_t point = SHEET_NONE;
  const struct divided_curve *of = &c->divided.curve.item[index];
  struct curve_pieces pieces = {c->curves, &c->curves->curve.item[index],
                                c->divided.piece.item + of->first, of->count};
  curve_pieces_absorb_short(&pieces);
  if (!c->exact) {
    curve_pieces_hide_covered(&pieces, &c->sheet->camera);
    curve_pieces_hide_concave(&pieces);
    curve_pieces_absorb_runs(&pieces, &c->sheet->camera);
    curve_pieces_trim_hooks(&pieces, &c->sheet->camera);
  }
  for (size_t i = 0; i < pieces.count; i++) {
    const struct contour_piece *piece = &pieces.piece[i];
    if (point == SHEET_NONE && !point_at(c, piece->from, &point))
      return false;
    if (is_too_deep(c, piece))
      point = SHEET_NONE;
    else if (!add_edges(c, piece, &point))
      return false;
  }
  return true;
}

/* Hides a curve's edges, from `first` on, if it is no more than a dot on the
 * page, as where a straight line of its surface is seen end-on: it has no
 * direction, so that no line ends at it, and the outline goes on there. */
static void hide_dot(struct contour_pieces *c, size_t first) {
  const struct sheet *sheet = c->sheet;
  struct box2 box = {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN};
  for (size_t e = first; e < sheet->edge.count; e++) {
    struct geom_segment s = sheet_ends(sheet, sheet->edge.item[e].point);
    box = box2_union(box, box2_of_segment(s.p, s.q));
  }
  if (first < sheet->edge.count &&
      fmax((double)box.x1 - box.x0, (double)box.y1 - box.y0) <
          TOLERANCE_OUTLINE_UNITS)
    memset(c->map->edge_state + first, MAP_HIDDEN, sheet->edge.count - first);
}

static bool add_all_curves(struct contour_pieces *c) {
  struct map *map = c->map;
  size_t most =
      c->sheet->edge.count + c->curves->step.count + c->curves->cut.count;
  uint8_t *state = mem_resize(map->edge_state, most, 1);
  if (state == NULL)
    return false;
  map->edge_state = state;
  for (size_t i = 0; i < c->curves->curve.count; i++) {
    size_t first = c->sheet->edge.count;
    if (!poll_at(i) || !add_curve(c, i))
      return false;
    hide_dot(c, first);
  }
  return true;
}

/* ---- Triangles ----------------------------------------------------------- */

/* Lists the triangles where points are tested: at the samples of the curves,
 * and beside the mesh's outlines. */
static bool list_triangles_about(struct contour_pieces *c) {
  /* How many triangles hide a point may depend on which ones are duplicates of
   * others in any list. */
  if (c->options.hidden_max > 0)
    return triangle_grid_init(&c->grid.grid, c->sheet);
  if (!partial_grid_shape(&c->grid, c->sheet))
    return false;
  for (size_t i = 0; i < c->divided.sample.count; i++) {
    const struct contour_sample *s = &c->divided.sample.item[i];
    const struct geom_point *all[] = {&s->aside.off, &s->aside.on, &s->at.off,
                                      &s->at.on};
    for (int k = 0; k < 4; k++)
      partial_grid_want(
          &c->grid, (struct box2){all[k]->x, all[k]->y, all[k]->x, all[k]->y});
  }
  for (size_t i = 0; i < c->set->outline.count; i++)
    partial_grid_want(&c->grid, outline_gaps_box(&c->set->outline.item[i]));
  return partial_grid_fill(&c->grid, c->sheet);
}

/* Whether a triangle is on the left of one of its sides. */
static bool has_triangle_left(const struct sheet *sheet, uint32_t triangle,
                              struct geom_segment side) {
  struct geom_triangle t = sheet_corners(sheet, triangle);
  int64_t area = 0;
  for (int k = 0; k < 3; k++)
    if (!geom_same_point(t.p[k], side.p) && !geom_same_point(t.p[k], side.q))
      area = geom_orient2d(side.p, side.q, t.p[k]);
  return area >= 0;
}

/* Lists the diagonals along which warped faces fold over as the mesh's
 * outlines: they are edges of the sheet alone. */
static bool list_folded_diagonals(struct contour_pieces *c) {
  const struct sheet *sheet = c->sheet;
  for (uint32_t e = 0; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    if (!folded_faces_is_diagonal(sheet, edge))
      continue;
    uint32_t face = sheet->triangle.item[edge->triangle[0]].face;
    struct contour_outline made = {.image = sheet_ends(sheet, edge->point),
                                   .face = face};
    if (!has_triangle_left(sheet, edge->triangle[0], made.image)) {
      struct geom_point p = made.image.p;
      made.image.p = made.image.q;
      made.image.q = p;
    }
    if (!ARRAY_PUSH(&c->set->outline, made))
      return false;
  }
  return true;
}

/* ---- The whole ----------------------------------------------------------- */

/* Adds what curves lack.
 * first, first_point  of the sheet's edges and points: those of the curves */
static bool close_gaps(struct contour_pieces *c, uint32_t first,
                       uint32_t first_point) {
  const struct outline_gaps_input input = {
      .sheet = c->sheet,
      .map = c->map,
      .set = c->set,
      .chains = c->chains,
      .first = first,
      .first_point = first_point,
      .curve_points = (uint32_t)c->sheet->point.count - first_point,
      .bulge = c->bulge.item,
      .bulges = (uint32_t)c->bulge.count,
      .grid = &c->grid.grid,
      .query = &c->query,
      .compared = &c->curves->compared,
      .exact = c->exact};
  return fold_bridges_add(&input, c->height.item) && border_ends_show(&input) &&
         outline_gaps_close(&input) && fold_lines_add(&input) &&
         (!c->options.intersections || intersection_gaps_close(&input));
}

static bool add_pieces(struct contour_pieces *c) {
  uint32_t first = (uint32_t)c->sheet->edge.count;
  uint32_t first_point = (uint32_t)c->sheet->point.count;
  if (!list_folded_diagonals(c))
    return false;
  if (c->set->outline.count == 0 && c->set->segment.count == 0)
    return true;
  bool ok = intersection_cuts_add(c->curves, c->sheet, c->map) &&
            contour_cuts_sort(&c->curves->cut) &&
            divided_curves_find(&c->divided) && list_triangles_about(c) &&
            triangle_grid_query_init(&c->query, &c->grid.grid);
  return ok && divided_curves_count(&c->divided, &c->occluders) &&
         add_all_curves(c) &&
         doubled_contours_hide(c->sheet, c->map, first, c->height.item,
                               c->exact ? RECTO_FINEST_MM * SHEET_UNITS_PER_MM
                                        : TOLERANCE_OUTLINE_UNITS,
                               &c->curves->compared) &&
         contour_creases_leave_out(c->sheet, c->map, first) &&
         close_gaps(c, first, first_point);
}

static void fini_pieces(struct contour_pieces *c) {
  divided_curves_fini(&c->divided);
  triangle_grid_query_fini(&c->query);
  near_faces_fini(&c->occluders.near);
  partial_grid_fini(&c->grid);
  ARRAY_FREE(&c->height);
  ARRAY_FREE(&c->bulge);
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

recto_status smooth_contours_add(struct map *map, struct smooth_curves **curves,
                                 const struct smooth_curves_input *input,
                                 struct smooth_contours_options options,
                                 struct smooth_contours_counts *counts,
                                 recto_error *error) {
  struct sheet *sheet = input->sheet;
  uint32_t first = (uint32_t)sheet->edge.count;
  struct outlined_curves *found = NULL;
  recto_status status = smooth_curves_find(curves, input, &found, error);
  *counts = (struct smooth_contours_counts){.segments = 0};
  if (found == NULL)
    return status;
  struct contour_pieces pieces = {
      .sheet = sheet,
      .map = map,
      .set = &found->set,
      .chains = &found->chains,
      .curves = &found->curves,
      .divided = {.sheet = sheet,
                  .curves = &found->curves,
                  .projection = projection_of(&sheet->camera),
                  .exact = input->exact},
      .occluders = {.sheet = sheet,
                    .grid = &pieces.grid.grid,
                    .query = &pieces.query,
                    .near = {.scene = sheet->scene,
                             .topology = input->topology},
                    /* Their number is asked for by is_too_deep alone. */
                    .most = options.hidden_max > 0 ? INT_MAX : 1},
      .exact = input->exact,
      .options = options};
  if (!(add_pieces(&pieces) &&
        end_at_contours(sheet, map, input->topology, first)))
    status = error_memory(error);
  if (!options.intersections)
    forget_intersections(sheet);
  *counts = (struct smooth_contours_counts){
      found->set.segment.count, found->curves.curve.count,
      pieces.divided.piece.count,
      found->curves.compared + pieces.occluders.near.searched};
  fini_pieces(&pieces);
  return status;
}
