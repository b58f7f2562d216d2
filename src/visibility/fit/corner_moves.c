/* corner_moves.c - finds where the corners of visible fragments go.
 *
 * Phases
 *   1 list the visible contour edges in the faces about each scene point
 *   2 find the move of each corner that lies on or beyond a contour
 *   3 choose one move for each point of the page */
#include "visibility/fit/corner_moves.h"

#include <math.h>
#include <string.h>

#include "base/hash.h"
#include "base/poll.h"
#include "base/tolerance.h"

/* How far a corner is moved, as a share of the width of the faces there: those
 * on a mesh's outline lie in the strip between it and the contour. */
#define MOVE_SHARE 0.5

/* ---- 1 Contour edges about points ---------------------------------------- */

/* Puts an edge into the lists of its face's points. */
static void list_contour(struct corner_moves *moves, uint32_t edge) {
  const struct scene *scene = moves->sheet->scene;
  uint32_t t = moves->sheet->edge.item[edge].triangle[0];
  if (t == SHEET_NONE || moves->map->edge_state[edge] != MAP_VISIBLE)
    return;
  uint32_t face = moves->sheet->triangle.item[t].face;
  for (uint32_t c = scene_face_start(scene, face);
       c < scene_face_start(scene, face + 1); c++) {
    uint32_t point = scene->corner.item[c];
    if (moves->topology->weld != NULL)
      point = moves->topology->weld[point];
    number_lists_put(&moves->of_point, point, edge);
  }
}

/* Finds the visible edges that meet at each of the contours' points, which are
 * the sheet's last ones. */
static bool join_edges(struct corner_moves *moves) {
  const struct sheet *sheet = moves->sheet;
  moves->first_point = (uint32_t)sheet->point.count;
  for (uint32_t e = moves->first; e < sheet->edge.count; e++)
    for (int k = 0; k < 2; k++)
      if (sheet->edge.item[e].point[k] < moves->first_point)
        moves->first_point = sheet->edge.item[e].point[k];
  size_t size =
      (sheet->point.count - moves->first_point) * sizeof *moves->at_point;
  moves->at_point = mem_alloc(size, 1);
  if (moves->at_point == NULL)
    return false;
  memset(moves->at_point, 0xff, size);
  for (uint32_t e = moves->first; e < sheet->edge.count; e++)
    for (int k = 0; k < 2 && moves->map->edge_state[e] == MAP_VISIBLE; k++) {
      uint32_t *two =
          moves->at_point[sheet->edge.item[e].point[k] - moves->first_point];
      two[two[0] != SHEET_NONE] = e;
    }
  return true;
}

static bool list_at_points(struct corner_moves *moves) {
  size_t points = moves->sheet->scene->point.count;
  if (!number_lists_init(&moves->of_point, points))
    return false;
  for (uint32_t e = moves->first; e < moves->sheet->edge.count; e++)
    list_contour(moves, e);
  if (!number_lists_allocate(&moves->of_point, points))
    return false;
  for (uint32_t e = moves->first; e < moves->sheet->edge.count; e++)
    list_contour(moves, e);
  return true;
}

/* ---- 2 Moves ------------------------------------------------------------- */

/* Takes a contour edge for a move if it is nearer than the one before.
 * beyond  only if the point lies beyond its inner part */
static void try_contour(const struct corner_moves *moves, uint32_t edge,
                        bool beyond, struct corner_move *move) {
  struct geom_segment s =
      sheet_ends(moves->sheet, moves->sheet->edge.item[edge].point);
  double x = (double)s.q.x - s.p.x, y = (double)s.q.y - s.p.y;
  double px = move->from[0] - s.p.x, py = move->from[1] - s.p.y;
  double square = x * x + y * y;
  double t = square > 0 ? (px * x + py * y) / square : 0;
  if (beyond && (x * py - y * px >= 0 || t < 0 || t > 1))
    return;
  t = fmin(fmax(t, 0), 1);
  double dx = px - t * x, dy = py - t * y, distance = dx * dx + dy * dy;
  if (distance >= move->distance)
    return;
  move->distance = distance;
  move->edge = edge;
  move->to[0] = s.p.x + t * x;
  move->to[1] = s.p.y + t * y;
}

static void try_point(const struct corner_moves *moves, uint32_t point,
                      bool beyond, struct corner_move *move) {
  for (uint32_t i = moves->of_point.start[point];
       i < moves->of_point.start[point + 1]; i++)
    try_contour(moves, moves->of_point.item[i], beyond, move);
}

/* Whether an edge is an outline: its triangles are on one side of it. */
static bool is_outline_edge(const struct sheet *sheet,
                            const struct sheet_edge *edge) {
  int side[2] = {0, 0};
  struct geom_segment s = sheet_ends(sheet, edge->point);
  for (int k = 0; k < 2; k++) {
    if (edge->triangle[k] == SHEET_NONE)
      return true;
    struct geom_triangle t = sheet_corners(sheet, edge->triangle[k]);
    for (int c = 0; c < 3; c++) {
      int64_t area = geom_orient2d(s.p, s.q, t.p[c]);
      if (!geom_same_point(t.p[c], s.p) && !geom_same_point(t.p[c], s.q))
        side[k] = area < 0 ? -1 : area > 0;
    }
  }
  return side[0] == side[1];
}

bool corner_moves_is_along(const struct corner_moves *moves,
                           const struct map_corner *corner) {
  if ((corner->side != MAP_SIDE_EDGE && corner->side != MAP_SIDE_OCCLUDER) ||
      corner->id >= moves->first)
    return false;
  const struct sheet_edge *edge = &moves->sheet->edge.item[corner->id];
  return edge->edge_class == 0 && edge->source < moves->topology->edge.count &&
         (corner->side == MAP_SIDE_OCCLUDER ||
          is_outline_edge(moves->sheet, edge));
}

/* How far a corner is moved on an edge, at most: by half of the width of the
 * wider face beside it, or of the narrower one within the picture. */
static double farthest_move(struct corner_moves *moves,
                            const struct sheet_edge *edge, bool within) {
  const struct sheet *sheet = moves->sheet;
  double width[2] = {0, 0};
  for (int k = 0; k < 2; k++)
    if (edge->triangle[k] != SHEET_NONE)
      width[k] = extent_of_face_by(
          &moves->last[k], sheet, sheet->triangle.item[edge->triangle[k]].face);
  return MOVE_SHARE *
         (within ? fmin(width[0], width[1]) : fmax(width[0], width[1]));
}

/* Tries the contours about the edge along a side that starts or ends at a
 * corner. */
static void try_side(struct corner_moves *moves,
                     const struct map_corner *corner,
                     struct corner_move *move) {
  const struct sheet *sheet = moves->sheet;
  if ((corner->side != MAP_SIDE_EDGE && corner->side != MAP_SIDE_OCCLUDER) ||
      corner->id >= moves->first)
    return;
  const struct sheet_edge *edge = &sheet->edge.item[corner->id];
  bool occluder = corner->side == MAP_SIDE_OCCLUDER;
  if (edge->edge_class != 0 || edge->source >= moves->topology->edge.count ||
      (move->occluder && !occluder))
    return;
  const uint32_t *point = moves->topology->edge.item[edge->source].point;
  if (moves->of_point.start[point[0]] == moves->of_point.start[point[0] + 1] &&
      moves->of_point.start[point[1]] == moves->of_point.start[point[1] + 1])
    return;
  struct corner_move moved = *move;
  if (occluder && !move->occluder) {
    moved.occluder = true;
    moved.distance = INFINITY;
  }
  bool beyond = !occluder && !is_outline_edge(sheet, edge);
  double most = farthest_move(moves, edge, beyond);
  double least = fmin(moved.distance, most * most);
  moved.distance = least;
  for (int k = 0; k < 2; k++)
    try_point(moves, point[k], beyond, &moved);
  if (moved.distance < least)
    *move = moved;
}

/* Where an outline passes behind a nearer one, moves a corner to the end of its
 * contour at the nearer contour, if there is one. */
static void meet_contours(struct corner_moves *moves,
                          const struct map_corner *nearer,
                          const struct map_corner *farther,
                          struct corner_move *move) {
  const struct sheet_edge *edge = moves->sheet->edge.item;
  if (move->distance == INFINITY || nearer->side != MAP_SIDE_OCCLUDER ||
      !corner_moves_is_along(moves, farther))
    return;
  double best = farthest_move(moves, &edge[farther->id], false);
  const uint32_t *ends =
      moves->topology->edge.item[edge[farther->id].source].point;
  for (int k = 0; k < 4; k++)
    for (uint32_t i = moves->of_point.start[ends[k / 2]];
         i < moves->of_point.start[ends[k / 2] + 1]; i++) {
      uint32_t point = edge[moves->of_point.item[i]].point[k % 2];
      struct geom_point p = moves->sheet->point.item[point];
      double away = hypot(p.x - move->from[0], p.y - move->from[1]);
      struct corner_move on = {.from = {p.x, p.y}, .distance = INFINITY};
      if (moves->at_point[point - moves->first_point][1] != SHEET_NONE ||
          away >= best)
        continue;
      try_side(moves, nearer, &on);
      if (on.distance > 4)
        continue;
      best = away;
      move->to[0] = p.x;
      move->to[1] = p.y;
      move->edge = on.edge;
      move->farther = moves->of_point.item[i];
      move->distance = away * away;
    }
}

/* Keeps a corner that is on a contour already where it is, rather than moving
 * it to another one. */
static void stay_on_contour(const struct corner_moves *moves,
                            struct corner_move *move) {
  static const double any[2] = {0, 0};
  if (move->distance <= (double)TOLERANCE_FILL_UNITS * TOLERANCE_FILL_UNITS ||
      move->distance == INFINITY)
    return;
  struct drawn_place on =
      drawn_outlines_find(moves->drawn, move->from, any, TOLERANCE_FILL_UNITS);
  if (on.distance > TOLERANCE_FILL_UNITS || on.edge < moves->first)
    return;
  move->to[0] = on.at[0];
  move->to[1] = on.at[1];
  move->edge = on.edge;
  move->farther = SHEET_NONE;
  move->distance = on.distance * on.distance;
}

/* Finds the move of the corner between two sides, if it has one. */
static bool add_move(struct corner_moves *moves,
                     const struct map_corner *before,
                     const struct map_corner *corner) {
  struct corner_move move = {.from = {corner->x, corner->y},
                             .farther = SHEET_NONE,
                             .distance = INFINITY};
  if (before->side == MAP_SIDE_CLIP || corner->side == MAP_SIDE_CLIP)
    return true;
  try_side(moves, before, &move);
  try_side(moves, corner, &move);
  meet_contours(moves, before, corner, &move);
  meet_contours(moves, corner, before, &move);
  stay_on_contour(moves, &move);
  return move.distance == INFINITY || ARRAY_PUSH(&moves->move, move);
}

static bool find_moves(struct corner_moves *moves) {
  for (size_t l = 0; l < moves->map->loop.count; l++) {
    const struct map_loop *loop = &moves->map->loop.item[l];
    const struct map_corner *corner = &moves->map->corner.item[loop->corner];
    if (!poll_at(l))
      return false;
    for (uint32_t c = 0; c < loop->count; c++)
      if (!add_move(moves, &corner[c > 0 ? c - 1 : loop->count - 1],
                    &corner[c]))
        return false;
  }
  return true;
}

/* ---- 3 Points ------------------------------------------------------------ */

static size_t hash_of_place(const struct corner_moves *moves, double x,
                            double y) {
  return (size_t)(hash_add_double(hash_add_double(0, x + 0.0), y + 0.0) *
                      HASH_GOLDEN >>
                  20) &
         moves->mask;
}

/* The place in the table of a point, or where it belongs. */
static uint32_t *place_of(const struct corner_moves *moves, double x,
                          double y) {
  size_t at = hash_of_place(moves, x, y);
  for (; moves->table[at] != 0; at = (at + 1) & moves->mask) {
    const double *from = moves->move.item[moves->table[at] - 1].from;
    if (from[0] == x && from[1] == y)
      break;
  }
  return &moves->table[at];
}

/* Whether a move is preferred to another one from the same point: to where two
 * contours meet, then to the nearer surface, then to the nearer contour. */
static bool is_preferred(const struct corner_move *a,
                         const struct corner_move *b) {
  if ((a->farther == SHEET_NONE) != (b->farther == SHEET_NONE))
    return a->farther != SHEET_NONE;
  if (a->occluder != b->occluder)
    return a->occluder;
  return a->distance < b->distance ||
         (a->distance == b->distance && a->edge < b->edge);
}

static bool choose_moves(struct corner_moves *moves) {
  moves->mask = 15;
  while (moves->mask < 2 * moves->move.count)
    moves->mask = 2 * moves->mask + 1;
  moves->table = mem_calloc(moves->mask + 1, sizeof *moves->table);
  moves->of_corner =
      mem_alloc(moves->map->corner.count, sizeof *moves->of_corner);
  if (moves->table == NULL || moves->of_corner == NULL)
    return false;
  for (uint32_t m = 0; m < moves->move.count; m++) {
    const struct corner_move *move = &moves->move.item[m];
    uint32_t *place = place_of(moves, move->from[0], move->from[1]);
    if (*place == 0 || is_preferred(move, &moves->move.item[*place - 1]))
      *place = m + 1;
  }
  for (size_t c = 0; c < moves->map->corner.count; c++) {
    const struct map_corner *corner = &moves->map->corner.item[c];
    moves->of_corner[c] = *place_of(moves, corner->x, corner->y);
  }
  return true;
}

bool corner_moves_find(struct corner_moves *moves) {
  return join_edges(moves) && list_at_points(moves) && find_moves(moves) &&
         choose_moves(moves);
}

void corner_moves_fini(struct corner_moves *moves) {
  mem_free(moves->at_point);
  number_lists_fini(&moves->of_point);
  ARRAY_FREE(&moves->move);
  mem_free(moves->table);
  mem_free(moves->of_corner);
}
