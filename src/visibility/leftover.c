/* leftover.c - the faces that tiles leave over.
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
#include "visibility/leftover.h"

#include <string.h>

#include "visibility/crowd.h"
#include "visibility/surround.h"

/* ---- Contours by tile ---------------------------------------------------- */

/* Counts the contours of wanted tiles, or with `filling` lists them. */
static void visit_contours(struct leftover *leftover, const uint8_t *wanted,
                           bool filling) {
  const struct sheet *sheet = leftover->sheet;
  const struct pagegrid *grid = &leftover->lists->map->grid;
  for (size_t i = sheet->contour.count; i-- > 0;) {
    const uint32_t *point = sheet->contour.item[i].point;
    struct geom_point p = sheet->point.item[point[0]],
                      q = sheet->point.item[point[1]];
    struct cell_range r = pagegrid_cells(grid, page_box_of_segment(p, q));
    for (int y = r.y0; y <= r.y1; y++) {
      int x0, x1;
      pagegrid_row(grid, p, q, r, y, &x0, &x1);
      for (int x = x0; x <= x1; x++) {
        size_t cell = (size_t)y * (size_t)grid->columns + (size_t)x;
        if (!wanted[cell])
          continue;
        if (filling)
          leftover->contour[--leftover->start[cell]] = (uint32_t)i;
        else
          leftover->start[cell]++;
      }
    }
  }
}

bool leftover_init(struct leftover *leftover, const struct sheet *sheet,
                   const struct tilelist *lists, const uint8_t *wanted,
                   uint8_t *state) {
  size_t cells = pagegrid_cell_count(&lists->map->grid);
  memset(leftover, 0, sizeof *leftover);
  leftover->sheet = sheet;
  leftover->lists = lists;
  leftover->state = state;
  rivals_init(&leftover->rivals, sheet);
  leftover->start = mem_calloc(cells + 1, sizeof *leftover->start);
  if (leftover->start == NULL ||
      !pagegrid_query_init(&leftover->query, &lists->grid))
    return false;
  visit_contours(leftover, wanted, false);
  for (size_t i = 0; i < cells; i++)
    leftover->start[i + 1] += leftover->start[i];
  leftover->contour =
      mem_alloc(leftover->start[cells], sizeof *leftover->contour);
  if (leftover->contour == NULL)
    return false;
  visit_contours(leftover, wanted, true);
  return true;
}

void leftover_fini(struct leftover *leftover) {
  mem_free(leftover->start);
  mem_free(leftover->contour);
  pagegrid_query_fini(&leftover->query);
  rivals_fini(&leftover->rivals);
}

/* By depth buckets, so that what is near on the page stays near in memory. */
bool leftover_sort(const struct leftover *leftover, uint32_t *triangle,
                   size_t count) {
  uint32_t start[TILE_BUCKETS] = {0}, sum = 0;
  uint32_t *copy = mem_alloc(count, sizeof *copy);
  if (copy == NULL)
    return false;
  for (size_t i = 0; i < count; i++) {
    copy[i] = triangle[i];
    start[tile_bucket(triangle_nearest(leftover->sheet, copy[i]))]++;
  }
  for (int bucket = TILE_BUCKETS - 1; bucket >= 0; bucket--) {
    uint32_t here = start[bucket];
    start[bucket] = sum;
    sum += here;
  }
  for (size_t i = 0; i < count; i++) {
    int bucket = tile_bucket(triangle_nearest(leftover->sheet, copy[i]));
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
static bool is_crossed(const struct leftover *leftover) {
  const struct sheet *sheet = leftover->sheet;
  const struct pagegrid *grid = &leftover->lists->map->grid;
  const struct rivals *rivals = &leftover->rivals;
  struct cell_range r = pagegrid_cells(grid, rivals->box);
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++) {
      size_t cell = (size_t)y * (size_t)grid->columns + (size_t)x;
      for (uint32_t i = leftover->start[cell]; i < leftover->start[cell + 1];
           i++) {
        const uint32_t *point = sheet->contour.item[leftover->contour[i]].point;
        struct geom_point p = sheet->point.item[point[0]],
                          q = sheet->point.item[point[1]];
        if ((p.z >= rivals->low || q.z >= rivals->low) &&
            may_enter(rivals->plane.p, p, q))
          return true;
      }
    }
  return false;
}

/* ---- Triangles about one ------------------------------------------------- */

/* What is hidden is no rival; only an earlier triangle may have to be given
 * what it touches. */
static bool add_found(struct leftover *leftover, uint32_t g) {
  return g == leftover->rivals.triangle ||
         (g > leftover->rivals.triangle && leftover->state[g] == MAP_HIDDEN) ||
         (leftover->sheet->triangle_flags[g] & SHEET_FLAT) ||
         !pagegrid_query_first(&leftover->query, g) ||
         ARRAY_PUSH(&leftover->query.found, g);
}

static bool find_in_crowd(struct leftover *leftover, uint32_t root) {
  const struct crowd *crowd = leftover->lists->grid.crowd;
  const struct crowd_shape shape = {.kind = CROWD_TRIANGLE,
                                    .triangle = leftover->rivals.triangle,
                                    .sheet = leftover->sheet,
                                    .box = leftover->rivals.box};
  struct crowd_walk walk = crowd_walk_from(root);
  const struct crowd_node *node;
  while ((node = crowd_next(crowd, &walk, &shape)) != NULL)
    for (uint32_t i = node->from; i < node->from + node->count; i++)
      if (!add_found(leftover, crowd->member.item[i].triangle))
        return false;
  return true;
}

/* Finds what may overlap the triangle at hand on the page, at any depth: what
 * is behind it may touch it. */
static bool find_about(struct leftover *leftover) {
  const struct tilelist *lists = leftover->lists;
  const struct pagegrid *grid = &lists->grid;
  const struct rivals *rivals = &leftover->rivals;
  struct cell_range r = pagegrid_cells(grid, rivals->box);
  struct octagon octagon = octagon_of_point(rivals->plane.p[0]);
  octagon_add(&octagon, rivals->plane.p[1]);
  octagon_add(&octagon, rivals->plane.p[2]);
  pagegrid_query_start(grid, &leftover->query);
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++) {
      size_t cell = (size_t)y * (size_t)grid->columns + (size_t)x;
      uint32_t i = grid->start[cell], end = grid->start[cell + 1];
      struct octagon_frame frame;
      uint64_t question;
      if (i == end)
        continue;
      if (pagegrid_crowd(grid, cell) != SHEET_NONE) {
        if (!find_in_crowd(leftover, pagegrid_crowd(grid, cell)))
          return false;
        continue;
      }
      frame = tilelist_frame(lists, x, y);
      octagon.low = frame.z0;
      question = octagon_question(&frame, &octagon);
      for (; i < end; i++)
        if (octagon_meets(lists->word[i], question) &&
            !add_found(leftover, grid->item[i]))
          return false;
    }
  return true;
}

/* ---- Solving ------------------------------------------------------------- */

/* Asks all that is about, or until one hides the triangle at hand. */
static bool ask_about(struct leftover *leftover) {
  struct rivals *rivals = &leftover->rivals;
  const uint32_t *about = leftover->query.found.item;
  if (!pulse_beat(rivals->pulse, leftover->query.found.count))
    return false;
  for (size_t i = 0; i < leftover->query.found.count && !rivals->covered; i++)
    if (leftover->state[about[i]] != MAP_HIDDEN &&
        !rivals_ask(rivals, about[i]))
      return false;
  return true;
}

static bool note_hidden(struct leftover *leftover, uint32_t triangle) {
  leftover->state[triangle] = MAP_HIDDEN;
  leftover->counts.hidden++;
  return true;
}

bool leftover_solve(struct leftover *leftover, uint32_t triangle,
                    struct fragments *fragments) {
  struct rivals *rivals = &leftover->rivals;
  struct leftover_counts *counts = &leftover->counts;
  const uint32_t *about;
  size_t count;
  rivals_start(rivals, triangle);
  if (!find_about(leftover) || !ask_about(leftover))
    return false;
  about = leftover->query.found.item;
  count = leftover->query.found.count;
  if (rivals->covered)
    return note_hidden(leftover, triangle);
  if (rivals->rival.count == 0) {
    counts->whole++;
    return fragments_add_among(fragments, triangle, NULL, 0, about, count);
  }
  if (!rivals->mingled && !is_crossed(leftover)) {
    counts->uncrossed++;
    return note_hidden(leftover, triangle);
  }
  if (!rivals_take_all(rivals))
    return false;
  if (rivals->left.count == 0)
    return note_hidden(leftover, triangle);
  if (rivals->whole) {
    counts->whole++;
    return fragments_add_among(fragments, triangle, NULL, 0, about, count);
  }
  counts->mixed++;
  return fragments_add_among(fragments, triangle, rivals->left.item,
                             rivals->left.count, about, count);
}

void leftover_report(const struct leftover *leftover, struct report *report) {
  const struct leftover_counts *counts = &leftover->counts;
  report_int(report, "faces", "hidden", (int64_t)counts->hidden);
  report_int(report, "faces", "hidden_by_contours", (int64_t)counts->uncrossed);
  report_int(report, "faces", "whole", (int64_t)counts->whole);
  report_int(report, "faces", "mixed", (int64_t)counts->mixed);
  rivals_report(&leftover->rivals.counts, report);
}
