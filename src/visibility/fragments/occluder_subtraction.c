/* occluder_subtraction.c - subtracts occluding triangles from one triangle.
 *
 * Most candidates are rejected by their bounding boxes, by their depth ranges,
 * by a side that separates the two triangles on the page, or by a
 * floating-point filter on their planes; the rest is decided by exact
 * arithmetic.  Every decision is exact.
 */
#include "visibility/fragments/occluder_subtraction.h"

#include <math.h>
#include <string.h>

void occluder_subtraction_init(struct occluder_subtraction *subtraction,
                               const struct sheet *sheet) {
  memset(subtraction, 0, sizeof *subtraction);
  subtraction->sheet = sheet;
}

void occluder_subtraction_fini(struct occluder_subtraction *subtraction) {
  ARRAY_FREE(&subtraction->occluder);
  ARRAY_FREE(&subtraction->left);
  ARRAY_FREE(&subtraction->rest);
  ARRAY_FREE(&subtraction->next);
  ARRAY_FREE(&subtraction->key);
  ARRAY_FREE(&subtraction->list);
  bsp_fini(&subtraction->bsp);
  ARRAY_FREE(&subtraction->region);
  arena_fini(&subtraction->arena);
}

void occluder_subtraction_begin(struct occluder_subtraction *subtraction,
                                uint32_t triangle) {
  arena_reset(&subtraction->arena);
  subtraction->triangle = triangle;
  subtraction->plane = triangle_plane_of(subtraction->sheet, triangle);
  subtraction->filter =
      plane_filter_without_contact(subtraction->sheet, triangle);
  subtraction->box = box2_of_triangle(subtraction->sheet, triangle);
  geom_depth_range(subtraction->plane.p, &subtraction->low, &subtraction->high);
  subtraction->covered = subtraction->interpenetrating = false;
  subtraction->occluder.count = subtraction->left.count = 0;
  subtraction->whole = true;
}

bool occluder_subtraction_take(struct occluder_subtraction *subtraction,
                               const struct geom_convex *part) {
  subtraction->whole = part == NULL;
  if (part != NULL)
    return ARRAY_PUSH(&subtraction->left, *part);
  struct geom_convex piece;
  return triangle_as_convex(subtraction->sheet, subtraction->triangle, &piece,
                            &subtraction->arena) &&
         ARRAY_PUSH(&subtraction->left, piece);
}

bool occluder_subtraction_start(struct occluder_subtraction *subtraction,
                                uint32_t triangle,
                                const struct geom_convex *part) {
  occluder_subtraction_begin(subtraction, triangle);
  return occluder_subtraction_take(subtraction, part);
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
static bool filtered_depth_order(const struct occluder_subtraction *subtraction,
                                 uint32_t g, const struct geom_point p[3],
                                 enum depth_order *depth_order) {
  int sides = filtered_plane_sides(&subtraction->filter, p);
  if (sides == PLANE_BEHIND || sides == PLANE_IN_FRONT) {
    *depth_order = sides == PLANE_BEHIND ? NEARER_NEVER : NEARER_ALWAYS;
    return true;
  }
  struct plane_filter plane =
      plane_filter_without_contact(subtraction->sheet, g);
  int others = filtered_plane_sides(&plane, subtraction->plane.p);
  if (others == PLANE_BEHIND || others == PLANE_IN_FRONT) {
    *depth_order = others == PLANE_BEHIND ? NEARER_ALWAYS : NEARER_NEVER;
    return true;
  }
  *depth_order = NEARER_ON_LEFT;
  return sides >= 0 && others >= 0;
}

/* Returns whether triangle f is on the left of all sides of triangle g but one;
 * side 3: of all, so that g contains f on the page. */
static bool is_left_of_sides(const struct geom_point g[3], int but,
                             const struct geom_point f[3]) {
  for (int k = 0; k < 3; k++)
    for (int i = 0; i < 3 && k != but; i++)
      if (geom_orient2d(g[k], g[geom_next_corner(k)], f[i]) < 0)
        return false;
  return true;
}

/* Returns whether two triangles that share a side contain triangle f together:
 * what is on the left of all other sides of a simple polygon lies in it. */
static bool is_within_pair(const struct sheet *sheet, uint32_t g, uint32_t h,
                           const struct geom_point f[3]) {
  const uint32_t *p = sheet->triangle.item[g].point,
                 *q = sheet->triangle.item[h].point;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      if (p[i] == q[geom_next_corner(j)] && p[geom_next_corner(i)] == q[j])
        return is_left_of_sides(sheet_corners(sheet, g).p, i, f) &&
               is_left_of_sides(sheet_corners(sheet, h).p, j, f);
  return false;
}

/* Whether an occluder that is nearer everywhere covers all of the current
 * triangle, alone or with the one that was collected before it. */
static bool covers_triangle(const struct occluder_subtraction *subtraction,
                            const struct triangle_occluder *occluder,
                            const struct geom_point p[3]) {
  const struct geom_point *f = subtraction->plane.p;
  uint32_t g = occluder->triangle;
  if (is_left_of_sides(p, 3, f))
    return true;
  if (subtraction->occluder.count == 0)
    return false;
  const struct triangle_occluder *last =
      &subtraction->occluder.item[subtraction->occluder.count - 1];
  return (last->triangle + 1 == g || g + 1 == last->triangle) &&
         !last->crosses &&
         box2_contains(box2_union(last->box, occluder->box),
                       subtraction->box) &&
         is_within_pair(subtraction->sheet, g, last->triangle, f);
}

bool occluder_subtraction_collect(struct occluder_subtraction *subtraction,
                                  uint32_t g) {
  const struct sheet *sheet = subtraction->sheet;
  struct geom_line line, reversed;
  enum depth_order depth_order = NEARER_ALWAYS;
  int64_t low, high;
  struct box2 box = box2_of_triangle(sheet, g);
  if (box2_disjoint(subtraction->box, box))
    return true;
  struct triangle_occluder occluder = {.triangle = g, .sides = 3, .box = box};
  struct triangle_plane plane;
  subtraction->counts.pairs++;
  for (int k = 0; k < 3; k++)
    plane.p[k] = sheet->point.item[sheet->triangle.item[g].point[k]];
  geom_depth_range(plane.p, &low, &high);
  /* Its own sides first: who searched for it tested the current one's. */
  if (high < subtraction->low ||
      triangle_corners_disjoint(plane.p, subtraction->plane.p))
    return true;
  subtraction->counts.overlapping++;
  if (low <= subtraction->high &&
      !filtered_depth_order(subtraction, g, plane.p, &depth_order)) {
    subtraction->counts.exact++;
    subtraction->interpenetrating = true;
    plane = triangle_plane_of(sheet, g);
    depth_order =
        triangle_depth_order(&subtraction->plane, subtraction->triangle, &plane,
                             g, &line, &reversed);
  }
  if (depth_order == NEARER_NEVER)
    return true;
  if (depth_order == NEARER_ON_LEFT) {
    subtraction->counts.crossings++;
    subtraction->interpenetrating = true;
    occluder.crosses = true;
  } else if (covers_triangle(subtraction, &occluder, plane.p)) {
    subtraction->covered = true;
  }
  return ARRAY_PUSH(&subtraction->occluder, occluder);
}

/* ---- Occluders and convex pieces ----------------------------------------- */

/* How many lines bound an occluder, and so where the reversed ones start. */
static int line_count(const struct triangle_occluder *occluder) {
  return occluder->sides + occluder->crosses;
}

/* Computes the lines of an occluder's sides unless that was done before; the
 * line of the crossing is computed only when it is needed. */
static bool make_lines(struct occluder_subtraction *subtraction,
                       struct triangle_occluder *occluder) {
  if (occluder->line != NULL)
    return true;
  int count = line_count(occluder);
  struct geom_line *line =
      arena_alloc(&subtraction->arena, 2 * (size_t)count, sizeof *line);
  if (line == NULL)
    return false;
  triangle_lines(subtraction->sheet, occluder->triangle, line, line + count);
  occluder->line = line;
  return true;
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

/* As coverage_of_line for the line in which the planes intersect, which is
 * computed only where the floating-point filter fails for some corner. */
static enum coverage
coverage_of_crossing(const struct occluder_subtraction *subtraction,
                     struct triangle_occluder *occluder,
                     const struct geom_convex *piece) {
  struct geom_line *line = &occluder->line[occluder->sides];
  if (!occluder->crossing_made) {
    int sum = 0, count = (int)piece->count;
    struct plane_filter filter =
        plane_filter_without_contact(subtraction->sheet, occluder->triangle);
    for (uint32_t c = 0; c < piece->count; c++)
      sum += plane_filter_compare(&subtraction->filter, &filter,
                                  piece->corner[c].x, piece->corner[c].y);
    if (sum == count || sum == -count)
      return sum > 0 ? COVERAGE_FULL : COVERAGE_NONE;
    struct triangle_plane plane =
        triangle_plane_of(subtraction->sheet, occluder->triangle);
    (void)geom_line_between(line, &plane.plane, &subtraction->plane.plane);
    struct geom_line *reversed = line + line_count(occluder);
    *reversed = geom_line_reversed(line);
    occluder->crossing_made = true;
  }
  return coverage_of_line(line, piece);
}

/* How much of a piece an occluder covers: COVERAGE_NONE and COVERAGE_FULL are
 * certain, COVERAGE_PARTIAL may turn out to be nothing.
 * lines  receives how many of the occluder's lines bound the region to
 *        subtract: that of the crossing only if it splits the piece */
static enum coverage coverage_of(const struct occluder_subtraction *subtraction,
                                 struct triangle_occluder *occluder,
                                 const struct geom_convex *piece, int *lines) {
  const struct box2 *box = &occluder->box;
  enum coverage coverage = COVERAGE_FULL;
  *lines = occluder->sides;
  if (piece->x1 < box->x0 || piece->x0 > box->x1 || piece->y1 < box->y0 ||
      piece->y0 > box->y1)
    return COVERAGE_NONE;
  for (int k = 0; k < occluder->sides; k++) {
    enum coverage now = coverage_of_line(&occluder->line[k], piece);
    if (now < coverage)
      coverage = now;
    if (now == COVERAGE_NONE)
      return now;
  }
  if (occluder->crosses) {
    enum coverage now = coverage_of_crossing(subtraction, occluder, piece);
    if (now < coverage)
      coverage = now;
    *lines += now == COVERAGE_PARTIAL;
  }
  return coverage;
}

bool triangle_occluder_subtract(struct occluder_subtraction *subtraction,
                                geom_pieces *pieces,
                                struct triangle_occluder *occluder) {
  if (!make_lines(subtraction, occluder))
    return false;
  subtraction->next.count = 0;
  for (size_t i = 0; i < pieces->count; i++) {
    const struct geom_convex *piece = &pieces->item[i];
    struct geom_convex inside = {0};
    int lines;
    enum coverage coverage = coverage_of(subtraction, occluder, piece, &lines);
    if (coverage == COVERAGE_NONE) {
      if (!ARRAY_PUSH(&subtraction->next, *piece))
        return false;
      continue;
    }
    if (coverage == COVERAGE_PARTIAL &&
        !geom_convex_subtract(piece, occluder->line,
                              occluder->line + line_count(occluder), lines,
                              &subtraction->next, &inside, &subtraction->arena))
      return false;
    subtraction->counts.subtractions++;
    if (coverage == COVERAGE_FULL || inside.count > 0)
      subtraction->whole = false;
  }
  geom_pieces swap = *pieces;
  *pieces = subtraction->next;
  subtraction->next = swap;
  return true;
}

bool occluder_subtraction_subtract(struct occluder_subtraction *subtraction,
                                   struct triangle_occluder *occluder) {
  return triangle_occluder_subtract(subtraction, &subtraction->left, occluder);
}

bool occluder_subtraction_subtract_nearer(
    struct occluder_subtraction *subtraction, uint32_t g) {
  subtraction->occluder.count = 0;
  return occluder_subtraction_collect(subtraction, g) &&
         (subtraction->occluder.count == 0 ||
          occluder_subtraction_subtract(subtraction,
                                        subtraction->occluder.item));
}

bool occluder_subtraction_store(struct occluder_subtraction *subtraction,
                                struct fragments *fragments) {
  if (subtraction->whole)
    return fragments_add_whole(fragments, subtraction->triangle);
  return fragments_add(fragments, subtraction->triangle, subtraction->left.item,
                       subtraction->left.count);
}

void occluder_subtraction_counts_add(
    struct occluder_subtraction_counts *sum,
    const struct occluder_subtraction_counts *more) {
  sum->pairs += more->pairs;
  sum->overlapping += more->overlapping;
  sum->exact += more->exact;
  sum->crossings += more->crossings;
  sum->splits += more->splits;
  sum->subtractions += more->subtractions;
}

void occluder_subtraction_report(
    const struct occluder_subtraction_counts *counts, struct report *report) {
  report_add(report, "faces", "pairs", counts->pairs);
  report_add(report, "faces", "overlapping", counts->overlapping);
  report_add(report, "faces", "filter_failures", counts->exact);
  report_add(report, "faces", "depth_crossings", counts->crossings);
  report_add(report, "faces", "splits", counts->splits);
  report_add(report, "faces", "subtractions", counts->subtractions);
}
