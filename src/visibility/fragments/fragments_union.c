/* fragments_union.c - unites the pieces of each face into the map's fragments:
 * phases 3 to 5 of fragments.h. */
#include "visibility/fragments/fragments.h"

#include <string.h>

#include "base/poll.h"
#include "base/sort.h"
#include "geom/region.h"
#include "visibility/fragments/planar_subdivision.h"
#include "visibility/fragments/side_provenance.h"
#include "visibility/predicate/triangle_pair.h"

/* Work per piece of a face, in the units of progress.h. */
enum { PIECE_WORK = 32 };

/* ---- Sides and fragments of a face --------------------------------------- */

/* A side of a face's outline: the point where it starts, and its edge. */
struct outline_side {
  uint32_t point, edge;
};

/* The outline of an entirely visible face, which is its fragment. */
struct face_outline {
  uint32_t face, count;
  struct outline_side
      side[4]; /* the first starts at the least point in (x, y) */
};

/* The state of uniting and labelling, face by face. */
struct face_work {
  struct fragments *fragments;
  struct map *map;
  uint32_t face;
  ARRAY(uint32_t) own;                /* the face's triangles that have area */
  ARRAY(uint32_t) seen;               /* those with visible pieces, ascending */
  ARRAY(struct face_outline) outline; /* by face */
  struct side_provenance provenance;
  side_lines lines;        /* of the sides stored */
  struct line_index sides; /* of all other faces and all triangles near them */
  geom_pieces piece;
  struct geom_region region;
};

/* Finds the triangles of the face that have area; the triangles of a face are
 * consecutive in the sheet. */
static bool find_own_triangles(struct face_work *work, uint32_t triangle) {
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

static bool store_union_loop(struct face_work *work,
                             const struct geom_region_loop *loop) {
  const struct geom_region_side *side = work->region.side.item + loop->side;
  struct map_loop stored = {(uint32_t)work->map->corner.count, loop->count, 0};
  for (uint32_t k = 0; k < loop->count; k++) {
    struct map_corner corner;
    int64_t x, y;
    geom_corner_round(&side[k].corner, MAP_CORNER_BITS, &x, &y);
    corner.x = (double)x / MAP_CORNER_SCALE;
    corner.y = (double)y / MAP_CORNER_SCALE;
    if (!side_provenance_find(&work->provenance, side[k].line, &side[k].corner,
                              &side[(k + 1) % loop->count].corner, &corner.side,
                              &corner.id) ||
        !side_lines_add(&work->lines, &corner, side[k].line) ||
        !ARRAY_PUSH(&work->map->corner, corner))
      return false;
    work->fragments->counts.side[corner.side]++;
  }
  return ARRAY_PUSH(&work->map->loop, stored);
}

static bool store_region(struct face_work *work) {
  struct map *map = work->map;
  for (size_t l = 0; l < work->region.loop.count;) {
    struct map_fragment fragment = {work->face, (uint32_t)map->loop.count, 0};
    do {
      if (!store_union_loop(work, &work->region.loop.item[l++]))
        return false;
      fragment.loops++;
    } while (l < work->region.loop.count && work->region.loop.item[l].hole);
    if (!ARRAY_PUSH(&map->fragment, fragment))
      return false;
  }
  return true;
}

/* ---- Entirely visible faces ---------------------------------------------- */

/* Appends the sides of a triangle except `skip`, starting with the one after
 * it.  Returns how many. */
static uint32_t append_sides(const struct sheet_triangle *t, int skip,
                             struct outline_side *side) {
  for (int k = 1; k < 3; k++)
    side[k - 1] = (struct outline_side){t->point[(skip + k) % 3],
                                        t->side[(skip + k) % 3]};
  return 2;
}

/* Lists the sides of a face that is one triangle, or two that share a
 * diagonal.  Returns the number of sides; 0 for any other face. */
static uint32_t list_face_sides(const struct face_work *work,
                                struct outline_side side[4]) {
  const struct sheet_triangle *all = work->fragments->sheet->triangle.item,
                              *a = &all[work->own.item[0]], *b;
  if (work->own.count == 1) {
    side[0] = (struct outline_side){a->point[0], a->side[0]};
    return 1 + append_sides(a, 0, side + 1);
  }
  if (work->own.count != 2)
    return 0;
  b = &all[work->own.item[1]];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      if (a->side[i] == SHEET_NONE && b->side[j] == SHEET_NONE &&
          a->point[i] == b->point[geom_next_corner(j)] &&
          a->point[geom_next_corner(i)] == b->point[j])
        return append_sides(a, i, side) + append_sides(b, j, side + 2);
  return 0;
}

/* Sets `outline` to that of a face that is one or two triangles, entirely
 * visible, if its outer sides are all edges and it turns at each corner.  Such
 * a face is stored without the arithmetic of regions.  Returns whether it is
 * one. */
static bool find_outline(const struct face_work *work,
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
  for (uint32_t k = 0; k < n; k++) {
    if (geom_orient2d(p[k], p[(k + 1) % n], p[(k + 2) % n]) == 0)
      return false;
    outline->side[k] = side[(first + k) % n];
  }
  outline->face = work->face;
  outline->count = n;
  return n > 0;
}

static bool store_outline(struct face_work *work,
                          const struct face_outline *outline) {
  struct map *map = work->map;
  struct map_fragment fragment = {outline->face, (uint32_t)map->loop.count, 1};
  struct map_loop loop = {(uint32_t)map->corner.count, outline->count, 0};
  work->fragments->counts.outlines++;
  for (uint32_t k = 0; k < outline->count; k++) {
    const struct outline_side *side = &outline->side[k];
    struct geom_point p = work->fragments->sheet->point.item[side->point];
    struct map_corner corner = {p.x, p.y, MAP_SIDE_EDGE, side->edge};
    if (!side_lines_add(&work->lines, &corner, NULL) ||
        !ARRAY_PUSH(&map->corner, corner))
      return false;
  }
  return ARRAY_PUSH(&map->loop, loop) && ARRAY_PUSH(&map->fragment, fragment);
}

/* Returns how many of the pieces, from the first on, are of one face. */
static size_t count_pieces(const struct fragment_piece *piece, size_t count) {
  size_t n = 1;
  while (n < count && piece[n].face == piece->face)
    n++;
  return n;
}

/* Finds which triangles of the face are visible, for labelling its sides. */
static bool find_visible_triangles(struct face_work *work,
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

static bool unite_face(struct face_work *work,
                       const struct fragment_piece *piece, size_t count) {
  struct fragments *f = work->fragments;
  work->face = piece->face;
  work->piece.count = 0;
  for (size_t i = 0; i < count; i++) {
    struct geom_convex whole;
    if (piece[i].piece == NULL &&
        !triangle_as_convex(f->sheet, piece[i].triangle, &whole, &f->scratch))
      return false;
    if (!ARRAY_PUSH(&work->piece,
                    piece[i].piece != NULL ? *piece[i].piece : whole))
      return false;
  }
  f->counts.united++;
  f->counts.pieces += count;
  if (!find_visible_triangles(work, piece, count) ||
      !geom_region_unite(&work->region, work->piece.item, count) ||
      !store_region(work))
    return false;
  arena_reset(&f->scratch);
  return true;
}

static int compare_faces(const void *a, const void *b, void *user) {
  const struct fragment_piece *p = a, *q = b;
  (void)user;
  return (p->face > q->face) - (p->face < q->face);
}

/* ---- The index of sides -------------------------------------------------- */

/* Adds a triangle and all triangles of the grid cells that its box overlaps.
 * done  a byte per cell: its triangles have been added */
static bool add_nearby(struct fragments *f, uint32_t triangle, uint8_t *done) {
  const struct triangle_grid *grid = f->grid;
  struct cell_range r =
      triangle_grid_cells(grid, box2_of_triangle(f->sheet, triangle));
  if (triangle_grid_query_first(&f->query, triangle) &&
      !ARRAY_PUSH(&f->query.found, triangle))
    return false;
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++) {
      size_t cell = triangle_grid_index(grid, x, y);
      if (done[cell])
        continue;
      done[cell] = 1;
      for (uint32_t i = grid->start[cell]; i < grid->start[cell + 1]; i++)
        if (triangle_grid_query_first(&f->query, grid->item[i]) &&
            !ARRAY_PUSH(&f->query.found, grid->item[i]))
          return false;
    }
  return true;
}

/* Finds the outlines, and indexes the sides of all other faces and of the
 * triangles near them. */
static bool index_sides(struct face_work *work) {
  struct fragments *f = work->fragments;
  const struct fragment_piece *piece = f->piece.item;
  uint8_t *cell_done = mem_calloc(triangle_grid_cell_count(f->grid), 1);
  bool ok = cell_done != NULL;
  triangle_grid_query_start(f->grid, &f->query);
  for (size_t i = 0, n, polls = 0; ok && i < f->piece.count; i += n) {
    struct face_outline outline;
    n = count_pieces(&piece[i], f->piece.count - i);
    work->face = piece[i].face;
    ok = poll_at(polls++) && find_own_triangles(work, piece[i].triangle);
    if (ok && find_outline(work, &piece[i], n, &outline))
      ok = ARRAY_PUSH(&work->outline, outline);
    else
      for (size_t k = 0; ok && k < n; k++)
        ok = add_nearby(f, piece[i + k].triangle, cell_done);
  }
  mem_free(cell_done);
  return ok && line_index_init(&work->sides, f->sheet, f->query.found.item,
                               f->query.found.count);
}

static void report_counts(const struct fragments *fragments) {
  const struct fragments_counts *c = &fragments->counts;
  struct report *report = fragments->report;
  static const char *const side[] = {"sides_of_edges", "sides_of_occluders",
                                     "sides_of_intersections",
                                     "sides_of_clipping"};
  report_count(report, "fragments", "triangles_whole", c->whole);
  report_count(report, "fragments", "triangles_cut", c->cut);
  report_count(report, "fragments", "contact_pairs", c->contact_pairs);
  report_count(report, "fragments", "contact_filter_failures",
               c->contact_exact);
  report_count(report, "fragments", "contacts", c->contacts);
  report_count(report, "fragments", "faces_by_outline", c->outlines);
  report_count(report, "fragments", "faces_united", c->united);
  report_count(report, "fragments", "pieces_united", c->pieces);
  for (int k = 0; k <= MAP_SIDE_CLIP; k++)
    report_count(report, "fragments", side[k], c->side[k]);
}

bool fragments_finish(struct fragments *fragments, struct map *map) {
  struct face_work work = {.fragments = fragments,
                           .map = map,
                           .provenance = {.sheet = fragments->sheet,
                                          .grid = fragments->grid,
                                          .query = &fragments->query,
                                          .sides = &work.sides}};
  const struct fragment_piece *piece = fragments->piece.item;
  size_t n = fragments->piece.count;
  bool ok = sort_stable(fragments->piece.item, n, sizeof *piece, compare_faces,
                        NULL) &&
            index_sides(&work);
  for (size_t i = 0, k = 0, count; ok && i < n; i += count) {
    count = count_pieces(&piece[i], n - i);
    bool whole =
        k < work.outline.count && work.outline.item[k].face == piece[i].face;
    ok = progress_step(fragments->progress, PIECE_WORK * count) &&
         (whole ? store_outline(&work, &work.outline.item[k])
                : unite_face(&work, &piece[i], count));
    k += whole;
  }
  ok = ok && planar_subdivision_store(&work.lines, fragments->sheet, map);
  ARRAY_FREE(&work.lines);
  ARRAY_FREE(&work.own);
  ARRAY_FREE(&work.seen);
  ARRAY_FREE(&work.outline);
  ARRAY_FREE(&work.piece);
  side_provenance_fini(&work.provenance);
  line_index_fini(&work.sides);
  geom_region_fini(&work.region);
  report_counts(fragments);
  return ok;
}
