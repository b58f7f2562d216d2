/* occluder_subtraction.c - subtracts nearer triangles from one triangle, one
 * after another. */
#include "visibility/fragments/occluder_subtraction.h"

#include <string.h>

void occluder_subtraction_init(struct occluder_subtraction *subtraction,
                               const struct sheet *sheet) {
  memset(subtraction, 0, sizeof *subtraction);
  subtraction->sheet = sheet;
}

void occluder_subtraction_fini(struct occluder_subtraction *subtraction) {
  ARRAY_FREE(&subtraction->left);
  ARRAY_FREE(&subtraction->scratch);
  arena_fini(&subtraction->arena);
}

bool occluder_subtraction_start(struct occluder_subtraction *subtraction,
                                uint32_t triangle,
                                const struct geom_convex *part) {
  arena_reset(&subtraction->arena);
  subtraction->triangle = triangle;
  subtraction->plane = triangle_plane_of(subtraction->sheet, triangle);
  subtraction->box = box2_of_triangle(subtraction->sheet, triangle);
  subtraction->left.count = 0;
  subtraction->whole = part == NULL;
  if (part != NULL)
    return ARRAY_PUSH(&subtraction->left, *part);
  struct geom_line *line = arena_alloc(&subtraction->arena, 6, sizeof *line);
  if (line == NULL)
    return false;
  triangle_lines(subtraction->sheet, triangle, line, line + 3);
  struct geom_convex piece;
  return geom_convex_triangle(&piece, subtraction->plane.p, line,
                              &subtraction->arena) &&
         ARRAY_PUSH(&subtraction->left, piece);
}

/* Returns whether some piece has, for each line, a corner to its left;
 * otherwise the region to the left of all lines overlaps no piece. */
static bool may_overlap(const struct occluder_subtraction *subtraction,
                        const struct geom_line *line, int count) {
  for (size_t i = 0; i < subtraction->left.count; i++) {
    const struct geom_convex *piece = &subtraction->left.item[i];
    int k = 0;
    for (; k < count; k++) {
      uint32_t c = 0;
      while (c < piece->count &&
             geom_line_side(&line[k], &piece->corner[c]) <= 0)
        c++;
      if (c == piece->count)
        break;
    }
    if (k == count)
      return true;
  }
  return false;
}

bool occluder_subtraction_take(struct occluder_subtraction *subtraction,
                               const struct geom_line *line,
                               const struct geom_line *back, int count) {
  if (!may_overlap(subtraction, line, count))
    return true;
  struct geom_line *copy =
      arena_alloc(&subtraction->arena, 2 * (size_t)count, sizeof *copy);
  if (copy == NULL)
    return false;
  memcpy(copy, line, (size_t)count * sizeof *copy);
  memcpy(copy + count, back, (size_t)count * sizeof *copy);
  subtraction->scratch.count = 0;
  for (size_t i = 0; i < subtraction->left.count; i++) {
    struct geom_convex inside;
    if (!geom_convex_subtract(&subtraction->left.item[i], copy, copy + count,
                              count, &subtraction->scratch, &inside,
                              &subtraction->arena))
      return false;
    if (inside.count > 0)
      subtraction->whole = false;
  }
  geom_pieces swap = subtraction->left;
  subtraction->left = subtraction->scratch;
  subtraction->scratch = swap;
  return true;
}

bool occluder_subtraction_keep(struct occluder_subtraction *subtraction,
                               const struct geom_line *line,
                               const struct geom_line *back, int count) {
  size_t n = (size_t)count, kept = 0;
  struct geom_line *copy =
      arena_alloc(&subtraction->arena, 2 * n, sizeof *copy);
  if (copy == NULL)
    return false;
  memcpy(copy, line, n * sizeof *copy);
  memcpy(copy + n, back, n * sizeof *copy);
  for (size_t i = 0; i < subtraction->left.count; i++) {
    struct geom_convex part = subtraction->left.item[i];
    uint32_t corners = part.count;
    for (size_t k = 0; k < n && part.count > 0; k++) {
      struct geom_convex inside, outside;
      if (!geom_convex_split(&part, &copy[k], &copy[n + k], &inside, &outside,
                             &subtraction->arena))
        return false;
      if (outside.count > 0)
        corners = 0;
      part = inside;
    }
    if (corners != part.count)
      subtraction->whole = false;
    if (part.count > 0)
      subtraction->left.item[kept++] = part;
  }
  subtraction->left.count = kept;
  return true;
}

bool occluder_subtraction_take_nearer(struct occluder_subtraction *subtraction,
                                      uint32_t g) {
  struct geom_line line[4], back[4];
  if (box2_disjoint(subtraction->box, box2_of_triangle(subtraction->sheet, g)))
    return true;
  subtraction->pairs++;
  if (triangles_disjoint(subtraction->sheet, subtraction->triangle, g))
    return true;
  subtraction->overlapping++;
  struct triangle_plane plane = triangle_plane_of(subtraction->sheet, g);
  enum depth_order depth_order =
      triangle_depth_order(&subtraction->plane, subtraction->triangle, &plane,
                           g, &line[3], &back[3]);
  if (depth_order == NEARER_NEVER)
    return true;
  subtraction->crossings += depth_order == NEARER_ON_LEFT;
  triangle_lines(subtraction->sheet, g, line, back);
  return occluder_subtraction_take(subtraction, line, back,
                                   depth_order == NEARER_ALWAYS ? 3 : 4);
}

bool occluder_subtraction_store(struct occluder_subtraction *subtraction,
                                struct fragments *fragments) {
  if (subtraction->whole)
    return fragments_add_whole(fragments, subtraction->triangle);
  return fragments_add(fragments, subtraction->triangle, subtraction->left.item,
                       subtraction->left.count);
}

void occluder_subtraction_report(const struct occluder_subtraction *subtraction,
                                 struct report *report) {
  report_add(report, "faces", "pairs", (int64_t)subtraction->pairs);
  report_add(report, "faces", "overlapping", (int64_t)subtraction->overlapping);
  report_add(report, "faces", "depth_crossings",
             (int64_t)subtraction->crossings);
}
