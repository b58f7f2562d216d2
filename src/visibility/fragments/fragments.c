/* fragments.c - collects the visible pieces that a solver finds, and passes
 * them on to earlier faces in contact: phases 1 and 2. */
#include "visibility/fragments/fragments.h"

#include <string.h>

#include "base/sort.h"
#include "visibility/predicate/coarse_plane.h"
#include "visibility/predicate/plane_filter.h"
#include "visibility/predicate/triangle_pair.h"

bool fragments_init(struct fragments *fragments, const struct sheet *sheet,
                    const struct triangle_grid *grid, bool contact) {
  memset(fragments, 0, sizeof *fragments);
  fragments->sheet = sheet;
  fragments->grid = grid;
  fragments->contact = contact;
  return triangle_grid_query_init(&fragments->query, grid);
}

void fragments_fini(struct fragments *fragments) {
  triangle_grid_query_fini(&fragments->query);
  arena_fini(&fragments->arena);
  arena_fini(&fragments->scratch);
  ARRAY_FREE(&fragments->touching);
  ARRAY_FREE(&fragments->piece);
}

/* ---- Parts --------------------------------------------------------------- */

void fragments_init_part(struct fragments *part,
                         const struct fragments *whole) {
  memset(part, 0, sizeof *part);
  part->sheet = whole->sheet;
  part->grid = whole->grid;
  part->contact = whole->contact;
}

bool fragments_append(struct fragments *whole, const struct fragments *part,
                      size_t begin, size_t end) {
  if (begin == end)
    return true;
  if (!ARRAY_RESERVE(&whole->piece, end - begin))
    return false;
  memcpy(whole->piece.item + whole->piece.count, part->piece.item + begin,
         (end - begin) * sizeof *part->piece.item);
  whole->piece.count += end - begin;
  return true;
}

void fragments_adopt(struct fragments *whole, struct fragments *part) {
  whole->counts.whole += part->counts.whole;
  whole->counts.cut += part->counts.cut;
  whole->counts.contact_pairs += part->counts.contact_pairs;
  whole->counts.contact_exact += part->counts.contact_exact;
  whole->counts.contacts += part->counts.contacts;
  arena_adopt(&whole->arena, &part->arena);
}

/* ---- Contact: passing pieces on to earlier faces ------------------------- */

/* May the two touch, as their planes with the contact tolerance of each
 * say? */
static bool planes_may_touch(const struct sheet *sheet, uint32_t f,
                             uint32_t g) {
  struct plane_filter sf = plane_filter_of(sheet, f),
                      sg = plane_filter_of(sheet, g);
  return triangles_may_touch(sheet, &sf, f, &sg, g);
}

/* Finds the earlier triangles of other faces among the candidates that are in
 * contact with this one. */
static bool find_touching(struct fragments *f, uint32_t triangle,
                          const uint32_t *candidate, size_t count) {
  const struct sheet *sheet = f->sheet;
  struct box2 box = box2_of_triangle(sheet, triangle);
  struct geom_triangle corners = sheet_corners(sheet, triangle);
  struct occlusion_bound all = occlusion_tolerance_bound_all(sheet);
  struct coarse_plane coarse = coarse_plane_of(&all, corners.p);
  for (size_t i = 0; i < count; i++) {
    uint32_t g = candidate[i];
    if (g < triangle && !sheet_is_edge_on(sheet, g) &&
        sheet->triangle.item[g].face != sheet->triangle.item[triangle].face &&
        !box2_disjoint(box, box2_of_triangle(sheet, g))) {
      f->counts.contact_pairs++;
      struct geom_triangle others = sheet_corners(sheet, g);
      struct coarse_plane other = coarse_plane_of(&all, others.p);
      if ((!coarse_plane_may_touch(&coarse, others.p) &&
           !coarse_plane_may_touch(&other, corners.p)) ||
          !planes_may_touch(sheet, triangle, g) ||
          triangles_disjoint(sheet, triangle, g))
        continue;
      f->counts.contact_exact++;
      if (triangles_touch(sheet, triangle, g) && !ARRAY_PUSH(&f->touching, g))
        return false;
    }
  }
  f->counts.contacts += f->touching.count;
  return sort_ids(f->touching.item, f->touching.count);
}

static bool keep_piece(struct fragments *f, uint32_t triangle,
                       const struct geom_convex *piece) {
  struct fragment_piece kept = {f->sheet->triangle.item[triangle].face,
                                triangle, NULL};
  if (piece != NULL) {
    kept.piece = arena_alloc(&f->arena, 1, sizeof *kept.piece);
    if (kept.piece == NULL || !geom_convex_copy(kept.piece, piece, &f->arena))
      return false;
  }
  return ARRAY_PUSH(&f->piece, kept);
}

/* Assigns to each touching triangle, in ascending order, the part of the pieces
 * that it overlaps, and the rest to `triangle`. */
static bool distribute_pieces(struct fragments *f, uint32_t triangle,
                              const struct geom_convex *piece, size_t count) {
  geom_pieces left = {0}, rest = {0}, swap;
  bool ok = false;
  for (size_t i = 0; i < count; i++)
    if (!ARRAY_PUSH(&left, piece[i]))
      goto end;
  for (size_t i = 0; i < f->touching.count; i++) {
    uint32_t g = f->touching.item[i];
    struct geom_line *line = arena_alloc(&f->scratch, 6, sizeof *line);
    if (line == NULL)
      goto end;
    triangle_lines(f->sheet, g, line, line + 3);
    rest.count = 0;
    for (size_t k = 0; k < left.count; k++) {
      struct geom_convex inside;
      if (!geom_convex_subtract(&left.item[k], line, line + 3, 3, &rest,
                                &inside, &f->scratch) ||
          (inside.count > 0 && !keep_piece(f, g, &inside)))
        goto end;
    }
    swap = left;
    left = rest;
    rest = swap;
  }
  for (size_t k = 0; k < left.count; k++)
    if (!keep_piece(f, triangle, &left.item[k]))
      goto end;
  ok = true;
end:
  ARRAY_FREE(&left);
  ARRAY_FREE(&rest);
  arena_reset(&f->scratch);
  return ok;
}

bool fragments_add_without_contact(struct fragments *f, uint32_t triangle) {
  if (!sheet_is_filled(f->sheet, triangle))
    return true;
  f->counts.whole++;
  return keep_piece(f, triangle, NULL);
}

bool fragments_add_with_candidates(struct fragments *f, uint32_t triangle,
                                   const struct geom_convex *piece,
                                   size_t count, const uint32_t *candidate,
                                   size_t candidate_count) {
  struct geom_convex whole;
  if ((piece != NULL && count == 0) || !sheet_is_filled(f->sheet, triangle))
    return true;
  f->counts.whole += piece == NULL;
  f->counts.cut += piece != NULL;
  f->touching.count = 0;
  if (f->contact && !find_touching(f, triangle, candidate, candidate_count))
    return false;
  if (piece == NULL) {
    if (f->touching.count == 0)
      return keep_piece(f, triangle, NULL);
    if (!triangle_as_convex(f->sheet, triangle, &whole, &f->scratch))
      return false;
    piece = &whole;
    count = 1;
  }
  return distribute_pieces(f, triangle, piece, count);
}

/* As fragments_add_with_candidates, with the candidates from the grid. */
static bool add_pieces_with_grid(struct fragments *f, uint32_t triangle,
                                 const struct geom_convex *piece,
                                 size_t count) {
  f->query.found.count = 0;
  if (!sheet_is_filled(f->sheet, triangle))
    return true;
  if (f->contact &&
      !triangle_grid_find_overlapping(f->grid, triangle, &f->query))
    return false;
  return fragments_add_with_candidates(
      f, triangle, piece, count, f->query.found.item, f->query.found.count);
}

bool fragments_add_whole(struct fragments *f, uint32_t triangle) {
  return add_pieces_with_grid(f, triangle, NULL, 0);
}

bool fragments_add(struct fragments *f, uint32_t triangle,
                   const struct geom_convex *piece, size_t count) {
  return count == 0 || add_pieces_with_grid(f, triangle, piece, count);
}
