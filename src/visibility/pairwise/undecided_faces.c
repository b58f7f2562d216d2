/* undecided_faces.c - the faces that tiles leave over.
 *
 * Why a face without a crossing is all of one kind.  Take a point inside it
 * that is covered from nearer by, and go from there to another, past no
 * vertex.  Cover can end only where a side of a nearer triangle is passed.  If
 * that is no contour, the triangle beyond it goes on at the same depth, so it
 * overlaps the face too; and as all that overlap it are before its plane or
 * behind it, strictly, this one is nearer as well.
 *   Lists leave out what is behind the horizon of a tile: but where the face is
 * nearer than that, so are they, and elsewhere it is covered by what made the
 * horizon, which is listed.
 *   What is hidden is not asked about: but where it ends cover, what is nearest
 * there covers too, is not hidden, and overlaps the face.
 */
#include "visibility/pairwise/undecided_faces.h"

#include <string.h>

#include "visibility/index/bsp.h"
#include "visibility/predicate/surrounder.h"

/* ---- Contours by tile ---------------------------------------------------- */

/* Counts the contours of wanted tiles, or with `filling` lists them. */
static void visit_contours(struct undecided_faces *undecided_faces,
                           const uint8_t *wanted, bool filling) {
  const struct sheet *sheet = undecided_faces->sheet;
  const struct triangle_grid *grid = &undecided_faces->lists->map->grid;
  for (size_t i = sheet->contour.count; i-- > 0;) {
    const uint32_t *point = sheet->contour.item[i].point;
    struct geom_point p = sheet->point.item[point[0]],
                      q = sheet->point.item[point[1]];
    struct cell_range r = triangle_grid_cells(grid, box2_of_segment(p, q));
    for (int y = r.y0; y <= r.y1; y++) {
      int x0, x1;
      triangle_grid_row(grid, p, q, r, y, &x0, &x1);
      for (int x = x0; x <= x1; x++) {
        size_t cell = (size_t)y * (size_t)grid->columns + (size_t)x;
        if (!wanted[cell])
          continue;
        if (filling)
          undecided_faces->contour[--undecided_faces->start[cell]] =
              (uint32_t)i;
        else
          undecided_faces->start[cell]++;
      }
    }
  }
}

bool undecided_faces_init(struct undecided_faces *undecided_faces,
                          const struct sheet *sheet,
                          const struct tile_candidates *lists,
                          const uint8_t *wanted, uint8_t *state) {
  size_t cells = triangle_grid_cell_count(&lists->map->grid);
  memset(undecided_faces, 0, sizeof *undecided_faces);
  undecided_faces->sheet = sheet;
  undecided_faces->lists = lists;
  undecided_faces->state = state;
  face_occluders_init(&undecided_faces->occluders, sheet);
  undecided_faces->start =
      mem_calloc(cells + 1, sizeof *undecided_faces->start);
  if (undecided_faces->start == NULL ||
      !triangle_grid_query_init(&undecided_faces->query, &lists->grid))
    return false;
  visit_contours(undecided_faces, wanted, false);
  for (size_t i = 0; i < cells; i++)
    undecided_faces->start[i + 1] += undecided_faces->start[i];
  undecided_faces->contour = mem_alloc(undecided_faces->start[cells],
                                       sizeof *undecided_faces->contour);
  if (undecided_faces->contour == NULL)
    return false;
  visit_contours(undecided_faces, wanted, true);
  return true;
}

void undecided_faces_fini(struct undecided_faces *undecided_faces) {
  mem_free(undecided_faces->start);
  mem_free(undecided_faces->contour);
  triangle_grid_query_fini(&undecided_faces->query);
  face_occluders_fini(&undecided_faces->occluders);
}

/* By depth buckets, so that what is near on the page stays near in memory. */
bool undecided_faces_sort(const struct undecided_faces *undecided_faces,
                          uint32_t *triangle, size_t count) {
  uint32_t start[TILE_BUCKETS] = {0}, sum = 0;
  uint32_t *copy = mem_alloc(count, sizeof *copy);
  if (copy == NULL)
    return false;
  for (size_t i = 0; i < count; i++) {
    copy[i] = triangle[i];
    start[tile_bucket(triangle_nearest_z(undecided_faces->sheet, copy[i]))]++;
  }
  for (int bucket = TILE_BUCKETS - 1; bucket >= 0; bucket--) {
    uint32_t here = start[bucket];
    start[bucket] = sum;
    sum += here;
  }
  for (size_t i = 0; i < count; i++) {
    int bucket =
        tile_bucket(triangle_nearest_z(undecided_faces->sheet, copy[i]));
    triangle[start[bucket]++] = copy[i];
  }
  mem_free(copy);
  return true;
}

/* May the segment have a point inside the triangle?  A no is certain. */
static bool may_enter(const struct geom_point f[3], struct geom_point p,
                      struct geom_point q) {
  int64_t a = geom_orient2d(p, q, f[0]), b = geom_orient2d(p, q, f[1]),
          c = geom_orient2d(p, q, f[2]);
  if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0))
    return false;
  for (int k = 0; k < 3; k++) {
    struct geom_point from = f[k], to = f[k == 2 ? 0 : k + 1];
    if (geom_orient2d(from, to, p) <= 0 && geom_orient2d(from, to, q) <= 0)
      return false;
  }
  return true;
}

/* May a contour that is not behind the triangle at hand cross it? */
static bool is_crossed(const struct undecided_faces *undecided_faces) {
  const struct sheet *sheet = undecided_faces->sheet;
  const struct triangle_grid *grid = &undecided_faces->lists->map->grid;
  const struct face_occluders *occluders = &undecided_faces->occluders;
  struct cell_range r = triangle_grid_cells(grid, occluders->box);
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++) {
      size_t cell = (size_t)y * (size_t)grid->columns + (size_t)x;
      for (uint32_t i = undecided_faces->start[cell];
           i < undecided_faces->start[cell + 1]; i++) {
        const uint32_t *point =
            sheet->contour.item[undecided_faces->contour[i]].point;
        struct geom_point p = sheet->point.item[point[0]],
                          q = sheet->point.item[point[1]];
        if ((p.z >= occluders->low || q.z >= occluders->low) &&
            may_enter(occluders->plane.p, p, q))
          return true;
      }
    }
  return false;
}

/* ---- Triangles about one ------------------------------------------------- */

/* What is hidden is no rival; only an earlier triangle may have to be given
 * what it touches. */
static bool add_found(struct undecided_faces *undecided_faces, uint32_t g) {
  return g == undecided_faces->occluders.triangle ||
         (g > undecided_faces->occluders.triangle &&
          undecided_faces->state[g] == MAP_HIDDEN) ||
         (undecided_faces->sheet->triangle_flags[g] & SHEET_FLAT) ||
         !triangle_grid_query_first(&undecided_faces->query, g) ||
         ARRAY_PUSH(&undecided_faces->query.found, g);
}

static bool find_in_bsp(struct undecided_faces *undecided_faces,
                        uint32_t root) {
  const struct bsp *bsp = undecided_faces->lists->grid.bsp;
  const struct bsp_query shape = {.kind = BSP_TRIANGLE,
                                  .triangle =
                                      undecided_faces->occluders.triangle,
                                  .sheet = undecided_faces->sheet,
                                  .box = undecided_faces->occluders.box};
  struct bsp_traversal walk = bsp_traversal_from(root);
  const struct bsp_node *node;
  while ((node = bsp_next(bsp, &walk, &shape)) != NULL)
    for (uint32_t i = node->from; i < node->from + node->count; i++)
      if (!add_found(undecided_faces, bsp->member.item[i].triangle))
        return false;
  return true;
}

/* Finds what may overlap the triangle at hand on the page, at any depth: what
 * is behind it may touch it. */
static bool find_about(struct undecided_faces *undecided_faces) {
  const struct tile_candidates *lists = undecided_faces->lists;
  const struct triangle_grid *grid = &lists->grid;
  const struct face_occluders *occluders = &undecided_faces->occluders;
  struct cell_range r = triangle_grid_cells(grid, occluders->box);
  struct kdop8 kdop = kdop8_of_point(occluders->plane.p[0]);
  kdop8_add(&kdop, occluders->plane.p[1]);
  kdop8_add(&kdop, occluders->plane.p[2]);
  triangle_grid_query_start(grid, &undecided_faces->query);
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++) {
      size_t cell = (size_t)y * (size_t)grid->columns + (size_t)x;
      uint32_t i = grid->start[cell], end = grid->start[cell + 1];
      struct kdop8_frame frame;
      uint64_t question;
      if (i == end)
        continue;
      if (triangle_grid_bsp(grid, cell) != SHEET_NONE) {
        if (!find_in_bsp(undecided_faces, triangle_grid_bsp(grid, cell)))
          return false;
        continue;
      }
      frame = tile_candidates_frame(lists, x, y);
      kdop.low = frame.z0;
      question = kdop8_query(&frame, &kdop);
      for (; i < end; i++)
        if (kdop8_overlaps(lists->word[i], question) &&
            !add_found(undecided_faces, grid->item[i]))
          return false;
    }
  return true;
}

/* ---- Solving ------------------------------------------------------------- */

/* Asks all that is about, or until one hides the triangle at hand. */
static bool query_about(struct undecided_faces *undecided_faces) {
  struct face_occluders *occluders = &undecided_faces->occluders;
  const uint32_t *about = undecided_faces->query.found.item;
  if (!progress_step(occluders->progress, undecided_faces->query.found.count))
    return false;
  for (size_t i = 0;
       i < undecided_faces->query.found.count && !occluders->covered; i++)
    if (undecided_faces->state[about[i]] != MAP_HIDDEN &&
        !face_occluders_test(occluders, about[i]))
      return false;
  return true;
}

static bool note_hidden(struct undecided_faces *undecided_faces,
                        uint32_t triangle) {
  undecided_faces->state[triangle] = MAP_HIDDEN;
  undecided_faces->counts.hidden++;
  return true;
}

bool undecided_faces_solve(struct undecided_faces *undecided_faces,
                           uint32_t triangle, struct fragments *fragments) {
  struct face_occluders *occluders = &undecided_faces->occluders;
  struct undecided_faces_counts *counts = &undecided_faces->counts;
  const uint32_t *about;
  size_t count;
  face_occluders_start(occluders, triangle);
  if (!find_about(undecided_faces) || !query_about(undecided_faces))
    return false;
  about = undecided_faces->query.found.item;
  count = undecided_faces->query.found.count;
  if (occluders->covered)
    return note_hidden(undecided_faces, triangle);
  if (occluders->occluder.count == 0) {
    counts->whole++;
    return fragments_add_with_candidates(fragments, triangle, NULL, 0, about,
                                         count);
  }
  if (!occluders->interpenetrating && !is_crossed(undecided_faces)) {
    counts->uncrossed++;
    return note_hidden(undecided_faces, triangle);
  }
  if (!face_occluders_subtract_all(occluders))
    return false;
  if (occluders->left.count == 0)
    return note_hidden(undecided_faces, triangle);
  if (occluders->whole) {
    counts->whole++;
    return fragments_add_with_candidates(fragments, triangle, NULL, 0, about,
                                         count);
  }
  counts->mixed++;
  return fragments_add_with_candidates(fragments, triangle,
                                       occluders->left.item,
                                       occluders->left.count, about, count);
}

void undecided_faces_report(const struct undecided_faces *undecided_faces,
                            struct report *report) {
  const struct undecided_faces_counts *counts = &undecided_faces->counts;
  report_int(report, "faces", "hidden", (int64_t)counts->hidden);
  report_int(report, "faces", "hidden_by_contours", (int64_t)counts->uncrossed);
  report_int(report, "faces", "whole", (int64_t)counts->whole);
  report_int(report, "faces", "mixed", (int64_t)counts->mixed);
  face_occluders_report(&undecided_faces->occluders.counts, report);
}
