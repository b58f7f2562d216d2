/* face_occluders.c - finds the triangles that occlude the current one, and
 * subtracts a few of them from a part of it.
 *
 * Most candidates are rejected by their bounding boxes, by their depth ranges,
 * by a side that separates the two triangles on the page, or by a
 * floating-point filter on their planes; the rest is decided by exact
 * arithmetic.  Every decision is exact.
 */
#include "visibility/fragments/face_occluders.h"

#include <math.h>
#include <string.h>

void face_occluders_init(struct face_occluders *occluders,
                         const struct sheet *sheet) {
  memset(occluders, 0, sizeof *occluders);
  occluders->sheet = sheet;
}

void face_occluders_fini(struct face_occluders *occluders) {
  ARRAY_FREE(&occluders->occluder);
  ARRAY_FREE(&occluders->left);
  ARRAY_FREE(&occluders->rest);
  ARRAY_FREE(&occluders->next);
  ARRAY_FREE(&occluders->region);
  ARRAY_FREE(&occluders->extent);
  ARRAY_FREE(&occluders->scratch);
  ARRAY_FREE(&occluders->key);
  arena_fini(&occluders->arena);
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

void face_occluders_start(struct face_occluders *occluders, uint32_t triangle) {
  arena_reset(&occluders->arena);
  occluders->triangle = triangle;
  occluders->plane = triangle_plane_of(occluders->sheet, triangle);
  occluders->filter = plane_filter_of(occluders->sheet, triangle);
  occluders->box = box2_of_triangle(occluders->sheet, triangle);
  find_depths(occluders->plane.p, &occluders->low, &occluders->high);
  occluders->covered = occluders->interpenetrating = false;
  occluders->occluder.count = 0;
}

/* ---- Collecting the occluders -------------------------------------------- */

/* As plane_sides, by the floating-point filter; -1 where it fails. */
static int filtered_plane_sides(const struct plane_filter *plane,
                                const struct geom_point p[3]) {
  int sides = 0;
  for (int k = 0; k < 3; k++) {
    int sign = plane_filter_sign(plane, p[k]);
    if (sign == 0)
      return -1;
    sides |= sign < 0 ? PLANE_BEHIND : PLANE_IN_FRONT;
  }
  return sides;
}

/* Decides by the floating-point filter how triangle g lies relative to the
 * current one.  Returns false where the filter fails. */
static bool filtered_depth_order(const struct face_occluders *occluders,
                                 uint32_t g, const struct geom_point p[3],
                                 enum depth_order *depth_order) {
  int sides = filtered_plane_sides(&occluders->filter, p);
  if (sides == PLANE_BEHIND || sides == PLANE_IN_FRONT) {
    *depth_order = sides == PLANE_BEHIND ? NEARER_NEVER : NEARER_ALWAYS;
    return true;
  }
  struct plane_filter plane = plane_filter_of(occluders->sheet, g);
  int others = filtered_plane_sides(&plane, occluders->plane.p);
  if (others == PLANE_BEHIND || others == PLANE_IN_FRONT) {
    *depth_order = others == PLANE_BEHIND ? NEARER_ALWAYS : NEARER_NEVER;
    return true;
  }
  *depth_order = NEARER_ON_LEFT;
  return sides >= 0 && others >= 0;
}

/* Returns whether triangle g contains triangle f on the page. */
static bool contains_triangle(const struct geom_point g[3],
                              const struct geom_point f[3]) {
  for (int k = 0; k < 3; k++)
    for (int i = 0; i < 3; i++)
      if (geom_orient2d(g[k], g[k == 2 ? 0 : k + 1], f[i]) < 0)
        return false;
  return true;
}

/* The area that two overlapping boxes share, in square grid units. */
static double shared_area(struct box2 a, struct box2 b) {
  double width = (double)box2_min(a.x1, b.x1) - box2_max(a.x0, b.x0);
  double height = (double)box2_min(a.y1, b.y1) - box2_max(a.y0, b.y0);
  return width * height;
}

bool face_occluders_test(struct face_occluders *occluders, uint32_t g) {
  const struct sheet *sheet = occluders->sheet;
  struct triangle_plane plane;
  struct box2 box = box2_of_triangle(sheet, g);
  struct face_occluder occluder = {g, shared_area(occluders->box, box), 3, NULL,
                                   false};
  struct geom_line line, back;
  enum depth_order depth_order = NEARER_ALWAYS;
  int64_t low, high;
  if (box2_disjoint(occluders->box, box))
    return true;
  occluders->counts.pairs++;
  for (int k = 0; k < 3; k++)
    plane.p[k] = sheet->point.item[sheet->triangle.item[g].point[k]];
  find_depths(plane.p, &low, &high);
  if (high < occluders->low ||
      triangles_disjoint(sheet, occluders->triangle, g))
    return true;
  occluders->counts.overlapping++;
  if (low <= occluders->high &&
      !filtered_depth_order(occluders, g, plane.p, &depth_order)) {
    occluders->counts.exact++;
    occluders->interpenetrating = true;
    plane = triangle_plane_of(sheet, g);
    depth_order = triangle_depth_order(&occluders->plane, occluders->triangle,
                                       &plane, g, &line, &back);
  }
  if (depth_order == NEARER_NEVER)
    return true;
  if (depth_order == NEARER_ON_LEFT) {
    occluders->counts.crossings++;
    occluders->interpenetrating = true;
    occluder.lines = 4;
  } else if (contains_triangle(plane.p, occluders->plane.p)) {
    occluders->covered = true;
  }
  return ARRAY_PUSH(&occluders->occluder, occluder);
}

/* ---- Occluders and convex pieces ----------------------------------------- */

bool face_occluder_make_lines(struct face_occluders *occluders,
                              struct face_occluder *occluder) {
  if (occluder->line != NULL)
    return true;
  struct geom_line *line =
      arena_alloc(&occluders->arena, 2 * (size_t)occluder->lines, sizeof *line);
  if (line == NULL)
    return false;
  triangle_lines(occluders->sheet, occluder->triangle, line,
                 line + occluder->lines);
  occluder->line = line;
  return true;
}

/* Computes the fourth line, in which the planes intersect, unless that was done
 * before. */
static void make_crossing(const struct face_occluders *occluders,
                          struct face_occluder *occluder) {
  struct geom_line *line = &occluder->line[3], *back = &occluder->line[7];
  if (occluder->crossing)
    return;
  struct triangle_plane plane =
      triangle_plane_of(occluders->sheet, occluder->triangle);
  (void)geom_line_between(line, &plane.plane, &occluders->plane.plane);
  *back = *line;
  geom_line_reverse(back);
  occluder->crossing = true;
}

/* How much of a piece lies in a region. */
enum coverage { COVERAGE_NONE, COVERAGE_PARTIAL, COVERAGE_FULL };

/* How much of a piece lies to the left of a line. */
static enum coverage coverage_of_line(const struct geom_line *line,
                                      const struct geom_convex *piece) {
  bool left = false, all = true;
  for (uint32_t c = 0; c < piece->count; c++) {
    int side = geom_line_side(line, &piece->corner[c]);
    left |= side > 0;
    all &= side >= 0;
  }
  return !left ? COVERAGE_NONE : all ? COVERAGE_FULL : COVERAGE_PARTIAL;
}

/* As coverage_of_line for the fourth line, which is computed only where the
 * floating-point filter fails for some corner. */
static enum coverage
coverage_of_crossing(const struct face_occluders *occluders,
                     struct face_occluder *occluder,
                     const struct geom_convex *piece) {
  int sum = 0, count = (int)piece->count;
  if (occluder->crossing)
    return coverage_of_line(&occluder->line[3], piece);
  struct plane_filter plane =
      plane_filter_of(occluders->sheet, occluder->triangle);
  for (uint32_t c = 0; c < piece->count; c++)
    sum += plane_filter_nearer(&occluders->filter, &plane, piece->corner[c].x,
                               piece->corner[c].y);
  if (sum == count || sum == -count)
    return sum > 0 ? COVERAGE_FULL : COVERAGE_NONE;
  make_crossing(occluders, occluder);
  return coverage_of_line(&occluder->line[3], piece);
}

/* How much of a piece an occluder covers: COVERAGE_NONE and COVERAGE_FULL are
 * certain, COVERAGE_PARTIAL may turn out to be nothing.
 * lines  receives how many of the occluder's lines bound the region to
 *        subtract: 4 only if the fourth one splits the piece */
static enum coverage coverage_of(const struct face_occluders *occluders,
                                 struct face_occluder *occluder,
                                 const struct geom_convex *piece, int *lines) {
  enum coverage coverage = COVERAGE_FULL;
  *lines = 3;
  for (int k = 0; k < 3; k++) {
    enum coverage now = coverage_of_line(&occluder->line[k], piece);
    if (now < coverage)
      coverage = now;
    if (now == COVERAGE_NONE)
      return now;
  }
  if (occluder->lines == 4) {
    enum coverage now = coverage_of_crossing(occluders, occluder, piece);
    if (now < coverage)
      coverage = now;
    if (now == COVERAGE_PARTIAL)
      *lines = 4;
  }
  return coverage;
}

bool face_occluder_covers(const struct face_occluders *occluders,
                          struct face_occluder *occluder,
                          const struct geom_convex *piece) {
  int lines;
  return coverage_of(occluders, occluder, piece, &lines) == COVERAGE_FULL;
}

bool face_occluder_subtract(struct face_occluders *occluders,
                            const struct geom_convex *piece,
                            struct face_occluder *occluder) {
  struct geom_convex inside = {0};
  if (!face_occluder_make_lines(occluders, occluder))
    return false;
  int lines;
  enum coverage coverage = coverage_of(occluders, occluder, piece, &lines);
  if (coverage == COVERAGE_NONE)
    return ARRAY_PUSH(&occluders->next, *piece);
  if (coverage == COVERAGE_PARTIAL &&
      !geom_convex_subtract(piece, occluder->line,
                            occluder->line + occluder->lines, lines,
                            &occluders->next, &inside, &occluders->arena))
    return false;
  occluders->counts.subtractions++;
  if (coverage == COVERAGE_FULL || inside.count > 0)
    occluders->whole = false;
  return true;
}

bool face_occluders_subtract_last(struct face_occluders *occluders,
                                  const struct geom_convex *piece,
                                  size_t count) {
  const struct face_occluder_extent *extent =
      occluders->extent.item + (occluders->extent.count - count);
  occluders->rest.count = 0;
  if (!ARRAY_PUSH(&occluders->rest, *piece))
    return false;
  for (size_t i = 0; i < count && occluders->rest.count > 0; i++) {
    occluders->next.count = 0;
    for (size_t k = 0; k < occluders->rest.count; k++)
      if (!face_occluder_subtract(
              occluders, &occluders->rest.item[k],
              &occluders->occluder.item[extent[i].occluder]))
        return false;
    geom_pieces swap = occluders->rest;
    occluders->rest = occluders->next;
    occluders->next = swap;
  }
  for (size_t k = 0; k < occluders->rest.count; k++)
    if (!ARRAY_PUSH(&occluders->left, occluders->rest.item[k]))
      return false;
  return true;
}

void face_occluders_report(const struct face_occluders_counts *counts,
                           struct report *report) {
  report_add(report, "faces", "pairs", (int64_t)counts->pairs);
  report_add(report, "faces", "overlapping", (int64_t)counts->overlapping);
  report_add(report, "faces", "filter_failures", (int64_t)counts->exact);
  report_add(report, "faces", "depth_crossings", (int64_t)counts->crossings);
  report_add(report, "faces", "splits", (int64_t)counts->splits);
  report_add(report, "faces", "cuts", (int64_t)counts->subtractions);
}
