/* rivals.c - which triangles are nearer than one at hand, and what a few of
 * them leave of a part of it.
 *
 * Most of what is about is sorted out by boxes, by depths, by sides between the
 * two on the page, and by planes in doubles; all that is decided is exact.
 */
#include "visibility/rivals.h"

#include <math.h>
#include <string.h>

void rivals_init(struct rivals *rivals, const struct sheet *sheet) {
  memset(rivals, 0, sizeof *rivals);
  rivals->sheet = sheet;
}

void rivals_fini(struct rivals *rivals) {
  ARRAY_FREE(&rivals->rival);
  ARRAY_FREE(&rivals->left);
  ARRAY_FREE(&rivals->rest);
  ARRAY_FREE(&rivals->next);
  ARRAY_FREE(&rivals->part);
  ARRAY_FREE(&rivals->reach);
  ARRAY_FREE(&rivals->scratch);
  ARRAY_FREE(&rivals->key);
  arena_fini(&rivals->arena);
}

static void find_depths(const struct geom_point p[3], int64_t *low,
                        int64_t *high) {
  *low = *high = p[0].z;
  for (int k = 1; k < 3; k++) {
    if (p[k].z < *low)
      *low = p[k].z;
    if (p[k].z > *high)
      *high = p[k].z;
  }
}

void rivals_start(struct rivals *rivals, uint32_t triangle) {
  arena_reset(&rivals->arena);
  rivals->triangle = triangle;
  rivals->plane = triangle_plane_of(rivals->sheet, triangle);
  rivals->stance = stance_plane_of(rivals->sheet, triangle);
  rivals->box = page_box_of_triangle(rivals->sheet, triangle);
  find_depths(rivals->plane.p, &rivals->low, &rivals->high);
  rivals->covered = rivals->mingled = false;
  rivals->rival.count = 0;
}

/* ---- Gathering ----------------------------------------------------------- */

/* A mask as of plane_sides; -1 where doubles cannot tell. */
static int near_sides(const struct stance_plane *plane,
                      const struct geom_point p[3]) {
  int sides = 0;
  for (int k = 0; k < 3; k++) {
    int sign = stance_sign(plane, p[k]);
    if (sign == 0)
      return -1;
    sides |= sign < 0 ? PLANE_BEHIND : PLANE_BEFORE;
  }
  return sides;
}

/* How g lies to the triangle at hand where doubles can tell, strictly; else
 * false. */
static bool tell_nearness(const struct rivals *rivals, uint32_t g,
                          const struct geom_point p[3],
                          enum nearness *nearness) {
  struct stance_plane plane;
  int sides = near_sides(&rivals->stance, p);
  if (sides == PLANE_BEHIND || sides == PLANE_BEFORE) {
    *nearness = sides == PLANE_BEHIND ? NEARER_NEVER : NEARER_ALWAYS;
    return true;
  }
  plane = stance_plane_of(rivals->sheet, g);
  int others = near_sides(&plane, rivals->plane.p);
  if (others == PLANE_BEHIND || others == PLANE_BEFORE) {
    *nearness = others == PLANE_BEHIND ? NEARER_ALWAYS : NEARER_NEVER;
    return true;
  }
  *nearness = NEARER_BEYOND;
  return sides >= 0 && others >= 0;
}

static bool holds_all(const struct geom_point g[3],
                      const struct geom_point f[3]) {
  for (int k = 0; k < 3; k++)
    for (int i = 0; i < 3; i++)
      if (geom_orient2d(g[k], g[k == 2 ? 0 : k + 1], f[i]) < 0)
        return false;
  return true;
}

/* Of two boxes that meet. */
static double shared_area(struct page_box a, struct page_box b) {
  double width = (double)page_least(a.x1, b.x1) - page_most(a.x0, b.x0);
  double height = (double)page_least(a.y1, b.y1) - page_most(a.y0, b.y0);
  return width * height;
}

bool rivals_ask(struct rivals *rivals, uint32_t g) {
  const struct sheet *sheet = rivals->sheet;
  struct triangle_plane plane;
  struct page_box box = page_box_of_triangle(sheet, g);
  struct rival rival = {g, shared_area(rivals->box, box), 3, NULL, false};
  struct geom_line line, back;
  enum nearness nearness = NEARER_ALWAYS;
  int64_t low, high;
  if (page_boxes_apart(rivals->box, box))
    return true;
  rivals->counts.pairs++;
  for (int k = 0; k < 3; k++)
    plane.p[k] = sheet->point.item[sheet->triangle.item[g].point[k]];
  find_depths(plane.p, &low, &high);
  if (high < rivals->low || triangles_part(sheet, rivals->triangle, g))
    return true;
  rivals->counts.overlapping++;
  if (low <= rivals->high && !tell_nearness(rivals, g, plane.p, &nearness)) {
    rivals->counts.exact++;
    rivals->mingled = true;
    plane = triangle_plane_of(sheet, g);
    nearness = triangle_nearness(&rivals->plane, rivals->triangle, &plane, g,
                                 &line, &back);
  }
  if (nearness == NEARER_NEVER)
    return true;
  if (nearness == NEARER_BEYOND) {
    rivals->counts.crossings++;
    rivals->mingled = true;
    rival.lines = 4;
  } else if (holds_all(plane.p, rivals->plane.p)) {
    rivals->covered = true;
  }
  return ARRAY_PUSH(&rivals->rival, rival);
}

/* ---- Rivals and parts ---------------------------------------------------- */

bool rivals_make_lines(struct rivals *rivals, struct rival *rival) {
  struct geom_line *line;
  if (rival->line != NULL)
    return true;
  line = arena_alloc(&rivals->arena, 2 * (size_t)rival->lines, sizeof *line);
  if (line == NULL)
    return false;
  triangle_lines(rivals->sheet, rival->triangle, line, line + rival->lines);
  rival->line = line;
  return true;
}

/* Makes the fourth line, if it was not. */
static void make_crossing(const struct rivals *rivals, struct rival *rival) {
  struct triangle_plane plane;
  struct geom_line *line = &rival->line[3], *back = &rival->line[7];
  if (rival->crossing)
    return;
  plane = triangle_plane_of(rivals->sheet, rival->triangle);
  (void)geom_line_between(line, &plane.plane, &rivals->plane.plane);
  *back = *line;
  geom_line_reverse(back);
  rival->crossing = true;
}

enum meeting { MEETING_NONE, MEETING_PART, MEETING_ALL };

/* How much of a part is left of a line. */
static enum meeting side_of_line(const struct geom_line *line,
                                 const struct geom_convex *piece) {
  bool left = false, all = true;
  for (uint32_t c = 0; c < piece->count; c++) {
    int side = geom_line_side(line, &piece->corner[c]);
    left |= side > 0;
    all &= side >= 0;
  }
  return !left ? MEETING_NONE : all ? MEETING_ALL : MEETING_PART;
}

/* The same of the fourth line, which need not be made where doubles can tell
 * all corners' sides. */
static enum meeting side_of_crossing(const struct rivals *rivals,
                                     struct rival *rival,
                                     const struct geom_convex *piece) {
  struct stance_plane plane;
  int sum = 0, count = (int)piece->count;
  if (rival->crossing)
    return side_of_line(&rival->line[3], piece);
  plane = stance_plane_of(rivals->sheet, rival->triangle);
  for (uint32_t c = 0; c < piece->count; c++)
    sum += stance_nearer(&rivals->stance, &plane, piece->corner[c].x,
                         piece->corner[c].y);
  if (sum == count || sum == -count)
    return sum > 0 ? MEETING_ALL : MEETING_NONE;
  make_crossing(rivals, rival);
  return side_of_line(&rival->line[3], piece);
}

/* How much of a part a rival may cover: a NONE and an ALL are certain.  With a
 * PART, `lines` of its lines count. */
static enum meeting meeting_of(const struct rivals *rivals, struct rival *rival,
                               const struct geom_convex *piece, int *lines) {
  enum meeting meeting = MEETING_ALL;
  *lines = 3;
  for (int k = 0; k < 3; k++) {
    enum meeting now = side_of_line(&rival->line[k], piece);
    if (now < meeting)
      meeting = now;
    if (now == MEETING_NONE)
      return now;
  }
  if (rival->lines == 4) {
    enum meeting now = side_of_crossing(rivals, rival, piece);
    if (now < meeting)
      meeting = now;
    if (now == MEETING_PART)
      *lines = 4;
  }
  return meeting;
}

bool rivals_cover(const struct rivals *rivals, struct rival *rival,
                  const struct geom_convex *piece) {
  int lines;
  return meeting_of(rivals, rival, piece, &lines) == MEETING_ALL;
}

bool rivals_subtract(struct rivals *rivals, const struct geom_convex *piece,
                     struct rival *rival) {
  struct geom_convex inside = {0};
  enum meeting meeting;
  int lines;
  if (!rivals_make_lines(rivals, rival))
    return false;
  meeting = meeting_of(rivals, rival, piece, &lines);
  if (meeting == MEETING_NONE)
    return ARRAY_PUSH(&rivals->next, *piece);
  if (meeting == MEETING_PART &&
      !geom_convex_subtract(piece, rival->line, rival->line + rival->lines,
                            lines, &rivals->next, &inside, &rivals->arena))
    return false;
  rivals->counts.cuts++;
  if (meeting == MEETING_ALL || inside.count > 0)
    rivals->whole = false;
  return true;
}

bool rivals_take_few(struct rivals *rivals, const struct geom_convex *piece,
                     size_t count) {
  const struct rival_reach *reach =
      rivals->reach.item + (rivals->reach.count - count);
  geom_pieces swap;
  rivals->rest.count = 0;
  if (!ARRAY_PUSH(&rivals->rest, *piece))
    return false;
  for (size_t i = 0; i < count && rivals->rest.count > 0; i++) {
    rivals->next.count = 0;
    for (size_t k = 0; k < rivals->rest.count; k++)
      if (!rivals_subtract(rivals, &rivals->rest.item[k],
                           &rivals->rival.item[reach[i].rival]))
        return false;
    swap = rivals->rest;
    rivals->rest = rivals->next;
    rivals->next = swap;
  }
  for (size_t k = 0; k < rivals->rest.count; k++)
    if (!ARRAY_PUSH(&rivals->left, rivals->rest.item[k]))
      return false;
  return true;
}

void rivals_report(const struct rivals_counts *counts, struct report *report) {
  report_add(report, "faces", "pairs", (int64_t)counts->pairs);
  report_add(report, "faces", "overlapping", (int64_t)counts->overlapping);
  report_add(report, "faces", "filter_failures", (int64_t)counts->exact);
  report_add(report, "faces", "depth_crossings", (int64_t)counts->crossings);
  report_add(report, "faces", "partings", (int64_t)counts->partings);
  report_add(report, "faces", "cuts", (int64_t)counts->cuts);
}
