/* face_union.c - unites the pieces of a face into its fragments. */
#include "visibility/fragments/face_union.h"

#include "base/sort.h"

void face_union_init(struct face_union *work, const struct fragments *fragments,
                     const struct line_index *sides) {
  *work = (struct face_union){.fragments = fragments};
  if (fragments->progress != NULL)
    work->progress = *fragments->progress;
  work->provenance = (struct side_provenance){.sheet = fragments->sheet,
                                              .grid = fragments->grid,
                                              .query = &work->query,
                                              .sides = sides};
}

void face_union_fini(struct face_union *work) {
  ARRAY_FREE(&work->own);
  ARRAY_FREE(&work->seen);
  ARRAY_FREE(&work->piece);
  side_provenance_fini(&work->provenance);
  triangle_grid_query_fini(&work->query);
  geom_region_fini(&work->region);
  arena_fini(&work->scratch);
}

/* Finds the triangles of the face that have area; the triangles of a face are
 * consecutive in the sheet. */
static bool find_own_triangles(struct face_union *work, uint32_t triangle) {
  const struct sheet *sheet = work->fragments->sheet;
  uint32_t first = triangle;
  work->own.count = 0;
  while (first > 0 && sheet->triangle.item[first - 1].face == work->face)
    first--;
  for (uint32_t t = first;
       t < sheet->triangle.count && sheet->triangle.item[t].face == work->face;
       t++)
    if (!sheet_is_edge_on(sheet, t) && !ARRAY_PUSH(&work->own, t))
      return false;
  return true;
}

static bool store_union_loop(struct face_union *work,
                             const struct geom_region_loop *loop) {
  const struct geom_region_side *side = work->region.side.item + loop->side;
  struct union_output *to = work->output;
  struct map_loop stored = {(uint32_t)to->corner.count, loop->count, 0};
  for (uint32_t k = 0; k < loop->count; k++) {
    struct map_corner corner;
    int64_t x, y;
    geom_corner_round(&side[k].corner, MAP_CORNER_BITS, &x, &y);
    corner.x = (double)x / MAP_CORNER_SCALE;
    corner.y = (double)y / MAP_CORNER_SCALE;
    if (!side_provenance_find(&work->provenance, side[k].line, &side[k].corner,
                              &side[(k + 1) % loop->count].corner, &corner.side,
                              &corner.id) ||
        !side_lines_add(&to->lines, &corner, side[k].line) ||
        !ARRAY_PUSH(&to->corner, corner))
      return false;
    work->counts.side[corner.side]++;
  }
  return ARRAY_PUSH(&to->loop, stored);
}

static bool store_region(struct face_union *work) {
  struct union_output *to = work->output;
  for (size_t l = 0; l < work->region.loop.count;) {
    struct map_fragment fragment = {work->face, (uint32_t)to->loop.count, 0};
    do {
      if (!store_union_loop(work, &work->region.loop.item[l++]))
        return false;
      fragment.loops++;
    } while (l < work->region.loop.count && work->region.loop.item[l].hole);
    if (!ARRAY_PUSH(&to->fragment, fragment))
      return false;
  }
  return true;
}

/* ---- Entirely visible faces ---------------------------------------------- */

/* Appends the sides of a triangle except `skip`, starting with the one after
 * it.  Returns how many. */
static uint32_t append_sides(const struct sheet *sheet, uint32_t triangle,
                             int skip, struct outline_side *side) {
  const uint32_t *point = sheet->triangle.item[triangle].point,
                 *edge = sheet_triangle_sides(sheet, triangle);
  for (int k = 1; k < 3; k++)
    side[k - 1] =
        (struct outline_side){point[(skip + k) % 3], edge[(skip + k) % 3]};
  return 2;
}

/* Lists the sides of a face that is one triangle, or two that share a
 * diagonal.  Returns the number of sides; 0 for any other face. */
static uint32_t list_face_sides(const struct face_union *work,
                                struct outline_side side[4]) {
  const struct sheet *sheet = work->fragments->sheet;
  uint32_t a = work->own.item[0];
  const uint32_t *p = sheet->triangle.item[a].point,
                 *p_edge = sheet_triangle_sides(sheet, a);
  if (work->own.count == 1) {
    side[0] = (struct outline_side){p[0], p_edge[0]};
    return 1 + append_sides(sheet, a, 0, side + 1);
  }
  if (work->own.count != 2)
    return 0;
  uint32_t b = work->own.item[1];
  const uint32_t *q = sheet->triangle.item[b].point,
                 *q_edge = sheet_triangle_sides(sheet, b);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      if (p_edge[i] == SHEET_NONE && q_edge[j] == SHEET_NONE &&
          p[i] == q[geom_next_corner(j)] && p[geom_next_corner(i)] == q[j])
        return append_sides(sheet, a, i, side) +
               append_sides(sheet, b, j, side + 2);
  return 0;
}

/* Whether a triangle or quadrilateral turns at each corner. */
static inline bool turns_at_corners(const struct geom_point p[4], uint32_t n) {
  if (n == 3)
    return geom_orient2d(p[0], p[1], p[2]) != 0;
  return geom_orient2d(p[0], p[1], p[2]) != 0 &&
         geom_orient2d(p[1], p[2], p[3]) != 0 &&
         geom_orient2d(p[2], p[3], p[0]) != 0 &&
         geom_orient2d(p[3], p[0], p[1]) != 0;
}

/* Sets `outline` to that of a face that is one or two triangles, entirely
 * visible, if its outer sides are all edges and it turns at each corner.  Such
 * a face is stored without the arithmetic of regions.  Returns whether it is
 * one. */
static bool find_outline(const struct face_union *work,
                         const struct fragment_piece *piece, size_t count,
                         struct face_outline *outline) {
  const struct sheet *sheet = work->fragments->sheet;
  struct outline_side side[4];
  struct geom_point p[4];
  uint32_t n, first = 0;
  if (count != work->own.count || count > 2 || piece[0].piece != NULL ||
      piece[count - 1].piece != NULL)
    return false;
  n = list_face_sides(work, side);
  for (uint32_t k = 0; k < n; k++) {
    if (side[k].edge == SHEET_NONE)
      return false;
    p[k] = sheet->point.item[side[k].point];
    if (p[k].x < p[first].x || (p[k].x == p[first].x && p[k].y < p[first].y))
      first = k;
  }
  if (n == 0 || !turns_at_corners(p, n))
    return false;
  for (uint32_t k = 0; k < n; k++)
    outline->side[k] = side[first + k < n ? first + k : first + k - n];
  outline->count = n;
  return true;
}

static bool store_outline(struct face_union *work,
                          const struct face_outline *outline) {
  struct union_output *to = work->output;
  struct map_fragment fragment = {work->face, (uint32_t)to->loop.count, 1};
  struct map_loop loop = {(uint32_t)to->corner.count, outline->count, 0};
  work->counts.outlines++;
  for (uint32_t k = 0; k < outline->count; k++) {
    const struct outline_side *side = &outline->side[k];
    struct geom_point p = work->fragments->sheet->point.item[side->point];
    struct map_corner corner = {p.x, p.y, MAP_SIDE_EDGE, side->edge};
    if (!side_lines_add(&to->lines, &corner, NULL) ||
        !ARRAY_PUSH(&to->corner, corner))
      return false;
  }
  return ARRAY_PUSH(&to->loop, loop) && ARRAY_PUSH(&to->fragment, fragment);
}

/* Finds which triangles of the face are visible, for labelling its sides. */
static bool find_visible_triangles(struct face_union *work,
                                   const struct fragment_piece *piece,
                                   size_t count) {
  size_t kept = 0;
  work->seen.count = 0;
  for (size_t i = 0; i < count; i++)
    if ((i == 0 || piece[i].triangle != piece[i - 1].triangle) &&
        !ARRAY_PUSH(&work->seen, piece[i].triangle))
      return false;
  if (!sort_ids(work->seen.item, work->seen.count))
    return false;
  for (size_t i = 0; i < work->seen.count; i++)
    if (i == 0 || work->seen.item[i] != work->seen.item[i - 1])
      work->seen.item[kept++] = work->seen.item[i];
  work->seen.count = kept;
  work->provenance.own = work->seen.item;
  work->provenance.own_count = kept;
  return true;
}

static bool unite_face(struct face_union *work,
                       const struct fragment_piece *piece, size_t count) {
  const struct sheet *sheet = work->fragments->sheet;
  if (work->query.stamp == NULL &&
      !triangle_grid_query_init(&work->query, work->fragments->grid))
    return false;
  work->piece.count = 0;
  for (size_t i = 0; i < count; i++) {
    struct geom_convex whole;
    if (piece[i].piece == NULL &&
        !triangle_as_convex(sheet, piece[i].triangle, &whole, &work->scratch))
      return false;
    if (!ARRAY_PUSH(&work->piece,
                    piece[i].piece != NULL ? *piece[i].piece : whole))
      return false;
  }
  work->counts.united++;
  work->counts.pieces += count;
  if (!find_visible_triangles(work, piece, count) ||
      !geom_region_unite(&work->region, work->piece.item, count) ||
      !store_region(work))
    return false;
  arena_reset(&work->scratch);
  return true;
}

bool face_union_has_outline(struct face_union *work,
                            const struct fragment_piece *piece, size_t count,
                            uint8_t *has_outline) {
  struct face_outline outline;
  work->face = piece->face;
  if (!find_own_triangles(work, piece->triangle))
    return false;
  *has_outline = find_outline(work, piece, count, &outline);
  return true;
}

bool face_union_store(struct face_union *work,
                      const struct fragment_piece *piece, size_t count,
                      bool has_outline, struct union_output *output) {
  struct face_outline outline;
  work->output = output;
  work->face = piece->face;
  if (!has_outline)
    return unite_face(work, piece, count);
  return find_own_triangles(work, piece->triangle) &&
         find_outline(work, piece, count, &outline) &&
         store_outline(work, &outline);
}
