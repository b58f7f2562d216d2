/* layout_unclipped.c - makes the sheet's triangles of faces that need neither
 * triangulation nor clipping: one after the other, or in parallel.
 *
 * In parallel, each range of faces knows where its triangles stand once those
 * that have no area are counted.  An edge belongs to the range of its first
 * face: edges are in the order of these, so those of a range are consecutive.
 * Only that range records sides of the edge directly; others list them, and
 * they are recorded at the end. */
#include "view/layout_unclipped.h"

#include <stdatomic.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "base/sort.h"
#include "view/layout_clipping.h"

/* A side of an edge that belongs to an earlier range. */
struct deferred_side {
  uint32_t edge;
  bool forward;
  int8_t sign;
};

/* A range of faces. */
struct face_range {
  uint32_t first_edge; /* of those that belong to it */
  uint32_t kept;       /* faces with three corners; then, all before it */
  ARRAY(struct deferred_side) deferred;
  bool failed; /* memory ran out */
};

/* The welded corners of a triangular face.  Returns false where two are one.
 * corner  gets them
 * own     as the scene has them
 * weld    NULL: none is welded */
static inline bool find_welded_corners(uint32_t corner[3], const uint32_t *own,
                                       const uint32_t *weld) {
  for (int k = 0; k < 3; k++)
    corner[k] = weld != NULL ? weld[own[k]] : own[k];
  return corner[0] != corner[1] && corner[1] != corner[2] &&
         corner[2] != corner[0];
}

static bool has_corners(const struct layout *layout, uint32_t face) {
  uint32_t corner[3];
  return find_welded_corners(corner,
                             layout->scene->corner.item + 3 * (size_t)face,
                             layout->topology->weld);
}

/* Records the sides of a triangle, some of whose edges belong to an earlier
 * range. */
static void record_some_sides(struct face_range *range, uint8_t *sides,
                              const uint32_t edge[3], const uint32_t corner[3],
                              int sign) {
  for (int k = 0; k < 3; k++) {
    bool forward = corner[k] < corner[geom_next_corner(k)];
    struct deferred_side side = {edge[k], forward, (int8_t)sign};
    if (edge[k] >= range->first_edge)
      layout_record_side(&sides[edge[k]], forward, sign);
    else if (!ARRAY_PUSH(&range->deferred, side))
      range->failed = true;
  }
}

/* As layout_unclipped_faces, to an end of the arrays of triangles.
 * range  which the faces are of; NULL: all edges belong to them */
static inline uint32_t add_unclipped_faces(const struct layout *layout,
                                           struct layout_triangle_sink *to,
                                           struct face_range *range,
                                           uint32_t face, uint32_t end) {
  enum { AHEAD = 3 * MEM_PREFETCH_AHEAD };
  const struct scene *scene = layout->scene;
  const uint32_t *start = scene->face_start.item, *own = scene->corner.item;
  const uint32_t *weld = layout->topology->weld, *map = layout->point_map;
  const uint32_t *corner_edge = layout->topology->corner_edge;
  const uint32_t first_edge = range != NULL ? range->first_edge : 0;
  struct layout_triangle_sink sink = *to; /* in registers */
  uint8_t *sides = layout->sides;
  const size_t corners = scene->corner.count;
  for (; face < end && sink.remaining > 0; face++) {
    uint32_t c = start[face], corner[3];
    for (uint32_t k = c; k < c + 3 && k + 2 * AHEAD < corners; k++) {
      MEM_PREFETCH(&map[own[k + 2 * AHEAD]]);
      MEM_PREFETCH(&sink.point[map[own[k + AHEAD]]]);
    }
    if (start[face + 1] - c != 3 || !find_welded_corners(corner, own + c, weld))
      break;
    const uint32_t point[3] = {map[corner[0]], map[corner[1]], map[corner[2]]};
    if (point[0] == SHEET_NONE || point[1] == SHEET_NONE ||
        point[2] == SHEET_NONE)
      break;
    int sign =
        geom_sign64(layout_sink_triangle(&sink, face, point, corner_edge + c));
    const uint32_t *edge = corner_edge + c;
    if (edge[0] < first_edge || edge[1] < first_edge || edge[2] < first_edge) {
      record_some_sides(range, sides, edge, corner, sign);
      continue;
    }
    layout_record_side(&sides[edge[0]], corner[0] < corner[1], sign);
    layout_record_side(&sides[edge[1]], corner[1] < corner[2], sign);
    layout_record_side(&sides[edge[2]], corner[2] < corner[0], sign);
  }
  *to = sink;
  return face;
}

uint32_t layout_unclipped_faces(struct layout *layout, uint32_t face,
                                uint32_t end) {
  struct layout_triangle_sink sink = layout_sink_of(layout);
  face = add_unclipped_faces(layout, &sink, NULL, face, end);
  layout_sink_close(layout, &sink);
  return face;
}

/* ---- In parallel --------------------------------------------------------- */

struct face_ranges_work {
  struct layout *layout;
  struct face_range *range;
  atomic_bool found_other; /* a face is no such triangle */
};

/* Counts the faces of a range that keep three corners, and finds its edges. */
static bool count_kept_faces(void *user, struct parallel_range faces) {
  struct face_ranges_work *work = user;
  const struct topology *topology = work->layout->topology;
  struct face_range *range = &work->range[faces.begin / PARALLEL_ITEMS];
  size_t first;
  LOWER_BOUND(first, 0, topology->edge.count,
              topology->edge.item[first].first < faces.begin);
  range->first_edge = (uint32_t)first;
  range->kept = (uint32_t)(faces.end - faces.begin);
  for (size_t f = faces.begin; topology->weld != NULL && f < faces.end; f++)
    range->kept -= !has_corners(work->layout, (uint32_t)f);
  return true;
}

/* Makes `kept` of each range the number of all before it; returns the sum. */
static uint32_t assign_positions(struct face_range *range, size_t ranges) {
  uint32_t sum = 0;
  for (size_t i = 0; i < ranges; i++) {
    uint32_t kept = range[i].kept;
    range[i].kept = sum;
    sum += kept;
  }
  return sum;
}

/* Makes the triangles of a range. */
static bool make_range_triangles(void *user, struct parallel_range faces) {
  struct face_ranges_work *work = user;
  const struct layout *layout = work->layout;
  struct face_range *range = &work->range[faces.begin / PARALLEL_ITEMS];
  struct layout_triangle_sink sink = {
      layout->sheet->point.item,
      layout->sheet->triangle.item + range->kept,
      layout->flags.item + range->kept,
      faces.end - faces.begin,
  };
  uint32_t face = (uint32_t)faces.begin, end = (uint32_t)faces.end;
  while ((face = add_unclipped_faces(layout, &sink, range, face, end)) < end) {
    if (has_corners(layout, face)) {
      atomic_store(&work->found_other, true);
      return false;
    }
    face++;
  }
  return !range->failed;
}

static void record_deferred_sides(struct layout *layout,
                                  struct face_range *range) {
  for (size_t i = 0; i < range->deferred.count; i++) {
    const struct deferred_side *side = &range->deferred.item[i];
    layout_record_side(&layout->sides[side->edge], side->forward, side->sign);
  }
  ARRAY_FREE(&range->deferred);
}

bool layout_all_unclipped(struct layout *layout, bool *done) {
  size_t faces = scene_face_count(layout->scene);
  size_t ranges = parallel_range_count(faces, PARALLEL_ITEMS);
  *done = false;
  if (!layout->sheet->camera.all_on_page ||
      layout->scene->corner.count != 3 * faces)
    return true;
  int workers = parallel_workers(faces, PARALLEL_ITEMS);
  struct face_ranges_work work = {
      .layout = layout, .range = mem_calloc(ranges, sizeof *work.range)};
  bool ok =
      work.range != NULL &&
      parallel_ranges(workers, faces, PARALLEL_ITEMS, count_kept_faces, &work);
  uint32_t kept = ok ? assign_positions(work.range, ranges) : 0;
  ok = ok && parallel_ranges(workers, faces, PARALLEL_ITEMS,
                             make_range_triangles, &work);
  for (size_t i = 0; work.range != NULL && i < ranges; i++)
    record_deferred_sides(layout, &work.range[i]);
  mem_free(work.range);
  if (atomic_load(&work.found_other)) {
    memset(layout->sides, 0, layout->topology->edge.count);
    return true;
  }
  layout->sheet->triangle.count = layout->flags.count = kept;
  layout->sheet->empty += faces - kept;
  *done = ok;
  return ok;
}
