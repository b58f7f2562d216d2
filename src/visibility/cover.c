/* cover.c - what nearer triangles leave of one triangle. */
#include "visibility/cover.h"

#include <string.h>

void cover_init(struct cover *cover, const struct sheet *sheet) {
  memset(cover, 0, sizeof *cover);
  cover->sheet = sheet;
}

void cover_fini(struct cover *cover) {
  ARRAY_FREE(&cover->left);
  ARRAY_FREE(&cover->scratch);
  arena_fini(&cover->arena);
}

bool cover_start(struct cover *cover, uint32_t triangle,
                 const struct geom_convex *part) {
  struct geom_line *line;
  struct geom_convex piece;
  arena_reset(&cover->arena);
  cover->triangle = triangle;
  cover->plane = triangle_plane_of(cover->sheet, triangle);
  cover->box = page_box_of_triangle(cover->sheet, triangle);
  cover->left.count = 0;
  cover->whole = part == NULL;
  if (part != NULL)
    return ARRAY_PUSH(&cover->left, *part);
  line = arena_alloc(&cover->arena, 6, sizeof *line);
  if (line == NULL)
    return false;
  triangle_lines(cover->sheet, triangle, line, line + 3);
  return geom_convex_triangle(&piece, cover->plane.p, line, &cover->arena) &&
         ARRAY_PUSH(&cover->left, piece);
}

/* Does some piece have a corner left of each line?  Else nothing is taken. */
static bool may_meet(const struct cover *cover, const struct geom_line *line,
                     int count) {
  for (size_t i = 0; i < cover->left.count; i++) {
    const struct geom_convex *piece = &cover->left.item[i];
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

bool cover_take(struct cover *cover, const struct geom_line *line,
                const struct geom_line *back, int count) {
  struct geom_line *copy;
  geom_pieces swap;
  if (!may_meet(cover, line, count))
    return true;
  copy = arena_alloc(&cover->arena, 2 * (size_t)count, sizeof *copy);
  if (copy == NULL)
    return false;
  memcpy(copy, line, (size_t)count * sizeof *copy);
  memcpy(copy + count, back, (size_t)count * sizeof *copy);
  cover->scratch.count = 0;
  for (size_t i = 0; i < cover->left.count; i++) {
    struct geom_convex inside;
    if (!geom_convex_subtract(&cover->left.item[i], copy, copy + count, count,
                              &cover->scratch, &inside, &cover->arena))
      return false;
    if (inside.count > 0)
      cover->whole = false;
  }
  swap = cover->left;
  cover->left = cover->scratch;
  cover->scratch = swap;
  return true;
}

bool cover_keep(struct cover *cover, const struct geom_line *line,
                const struct geom_line *back, int count) {
  size_t n = (size_t)count, kept = 0;
  struct geom_line *copy = arena_alloc(&cover->arena, 2 * n, sizeof *copy);
  if (copy == NULL)
    return false;
  memcpy(copy, line, n * sizeof *copy);
  memcpy(copy + n, back, n * sizeof *copy);
  for (size_t i = 0; i < cover->left.count; i++) {
    struct geom_convex part = cover->left.item[i];
    uint32_t corners = part.count;
    for (size_t k = 0; k < n && part.count > 0; k++) {
      struct geom_convex inside, outside;
      if (!geom_convex_split(&part, &copy[k], &copy[n + k], &inside, &outside,
                             &cover->arena))
        return false;
      if (outside.count > 0)
        corners = 0;
      part = inside;
    }
    if (corners != part.count)
      cover->whole = false;
    if (part.count > 0)
      cover->left.item[kept++] = part;
  }
  cover->left.count = kept;
  return true;
}

bool cover_take_nearer(struct cover *cover, uint32_t g) {
  struct geom_line line[4], back[4];
  struct triangle_plane plane;
  enum nearness nearness;
  if (page_boxes_apart(cover->box, page_box_of_triangle(cover->sheet, g)))
    return true;
  cover->pairs++;
  if (triangles_part(cover->sheet, cover->triangle, g))
    return true;
  cover->overlapping++;
  plane = triangle_plane_of(cover->sheet, g);
  nearness = triangle_nearness(&cover->plane, cover->triangle, &plane, g,
                               &line[3], &back[3]);
  if (nearness == NEARER_NEVER)
    return true;
  cover->crossings += nearness == NEARER_BEYOND;
  triangle_lines(cover->sheet, g, line, back);
  return cover_take(cover, line, back, nearness == NEARER_ALWAYS ? 3 : 4);
}

bool cover_file(struct cover *cover, struct fragments *fragments) {
  if (cover->whole)
    return fragments_add_whole(fragments, cover->triangle);
  return fragments_add(fragments, cover->triangle, cover->left.item,
                       cover->left.count);
}

void cover_report(const struct cover *cover, struct report *report) {
  report_add(report, "faces", "pairs", (int64_t)cover->pairs);
  report_add(report, "faces", "overlapping", (int64_t)cover->overlapping);
  report_add(report, "faces", "depth_crossings", (int64_t)cover->crossings);
}
