/* layout_face_ranges.c - lays out ranges of faces that need neither
 * triangulation nor clipping.
 *
 * The orientation of each face is stored by its number; that of the faces of an
 * edge says on which sides of it they lie.  Each range knows where its
 * triangles stand once the faces that have no area are counted.  An edge
 * belongs to the range of its first face: edges are in the order of these, so
 * those of a range are consecutive.  Only that range links an edge to triangles
 * directly; others list their sides of it, which are done at the end, in the
 * order of the ranges. */
#include "view/layout_face_ranges.h"

#include <stdatomic.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "base/sort.h"
#include "view/layout_unclipped.h"

/* A side of an edge that belongs to an earlier range. */
struct range_side {
  uint32_t edge; /* of the sheet */
  uint32_t triangle;
};

struct face_range {
  uint32_t first_edge; /* of those that belong to it */
  uint32_t first;      /* its first triangle; before, how many it has */
  ARRAY(struct range_side) late;
};

struct face_ranges_work {
  struct layout *layout;
  atomic_bool found_other; /* a face is no such triangle */
};

static size_t count_ranges(const struct layout *layout) {
  return parallel_range_count(scene_face_count(layout->scene), PARALLEL_ITEMS);
}

static struct face_range *range_of(const struct layout *layout, size_t face) {
  return &layout->face_range[face / PARALLEL_ITEMS];
}

static bool has_corners(const struct layout *layout, size_t face) {
  uint32_t corner[3];
  return layout_welded_corners(corner, layout->scene->corner.item + 3 * face,
                               layout->topology->weld);
}

/* Counts the faces of a range that keep three corners, and finds its edges. */
static bool count_kept_faces(void *user, struct parallel_range faces) {
  const struct layout *layout = user;
  const struct topology *topology = layout->topology;
  struct face_range *range = range_of(layout, faces.begin);
  size_t first;
  LOWER_BOUND(first, 0, topology->edge.count,
              topology->edge.item[first].first < faces.begin);
  range->first_edge = (uint32_t)first;
  range->first = (uint32_t)(faces.end - faces.begin);
  for (size_t f = faces.begin; topology->weld != NULL && f < faces.end; f++)
    range->first -= !has_corners(layout, f);
  return true;
}

/* Makes `first` of each range the number of all triangles before it; returns
 * how many there are. */
static uint32_t assign_positions(struct face_range *range, size_t ranges) {
  uint32_t sum = 0;
  for (size_t i = 0; i < ranges; i++) {
    uint32_t kept = range[i].first;
    range[i].first = sum;
    sum += kept;
  }
  return sum;
}

/* What the loops over faces read, in registers: writing bytes may change
 * anything that is read through a pointer. */
struct face_loop {
  const uint32_t *corner, *weld, *map, *corner_edge; /* weld, map: or NULL */
  const struct geom_point *point;
  size_t corners;
};

static inline struct face_loop face_loop_of(const struct layout *layout) {
  return (struct face_loop){
      .corner = layout->scene->corner.item,
      .weld = layout->topology->weld,
      .map = layout->point_map,
      .corner_edge = layout->topology->corner_edge,
      .point = layout->sheet->point.item,
      .corners = layout->scene->corner.count,
  };
}

/* The welded corners of a face, and their sheet points.  Returns false where
 * two corners are one.  Loops are written out, as compilers leave them. */
static inline bool find_face_points(const struct face_loop *loop, size_t face,
                                    uint32_t corner[3], uint32_t point[3]) {
  const uint32_t *own = loop->corner + 3 * face, *map = loop->map;
  corner[0] = own[0], corner[1] = own[1], corner[2] = own[2];
  if (loop->weld != NULL && !layout_welded_corners(corner, own, loop->weld))
    return false;
  point[0] = map != NULL ? map[corner[0]] : corner[0];
  point[1] = map != NULL ? map[corner[1]] : corner[1];
  point[2] = map != NULL ? map[corner[2]] : corner[2];
  return true;
}

/* ---- Orientations ------------------------------------------------------- */

/* Fetches the points of faces that come later. */
MEM_PREFETCH_INLINE void prefetch_points(const struct face_loop *loop,
                                         size_t corner) {
  enum { AHEAD = 3 * MEM_PREFETCH_AHEAD };
  if (corner + 2 * AHEAD + 3 > loop->corners)
    return;
  const uint32_t *own = loop->corner + corner + AHEAD, *map = loop->map;
  if (map != NULL) {
    MEM_PREFETCH(&map[own[AHEAD]]);
    MEM_PREFETCH(&map[own[AHEAD + 1]]);
    MEM_PREFETCH(&map[own[AHEAD + 2]]);
  }
  MEM_PREFETCH(&loop->point[map != NULL ? map[own[0]] : own[0]]);
  MEM_PREFETCH(&loop->point[map != NULL ? map[own[1]] : own[1]]);
  MEM_PREFETCH(&loop->point[map != NULL ? map[own[2]] : own[2]]);
}

static bool find_orientations(void *user, struct parallel_range faces) {
  struct face_ranges_work *work = user;
  struct layout *layout = work->layout;
  const struct face_loop loop = face_loop_of(layout);
  uint8_t *flags = layout->flags.item;
  for (size_t f = faces.begin; f < faces.end; f++) {
    uint32_t corner[3], point[3];
    prefetch_points(&loop, 3 * f);
    flags[f] = LAYOUT_NO_TRIANGLE;
    if (!find_face_points(&loop, f, corner, point))
      continue;
    if (point[0] == SHEET_NONE || point[1] == SHEET_NONE ||
        point[2] == SHEET_NONE) {
      atomic_store(&work->found_other, true);
      return false;
    }
    flags[f] = layout_flags_of_area(geom_orient2d(
        loop.point[point[0]], loop.point[point[1]], loop.point[point[2]]));
  }
  return true;
}

bool layout_orient_all_faces(struct layout *layout) {
  size_t faces = scene_face_count(layout->scene);
  size_t ranges = count_ranges(layout);
  if (!layout->sheet->camera.all_on_page || faces == 0 ||
      layout->scene->corner.count != 3 * faces)
    return true;
  int workers = parallel_workers(faces, PARALLEL_ITEMS);
  struct face_ranges_work work = {.layout = layout};
  layout->face_range = mem_calloc(ranges, sizeof *layout->face_range);
  bool ok =
      layout->face_range != NULL && ARRAY_RESERVE(&layout->flags, faces) &&
      parallel_ranges(workers, faces, PARALLEL_ITEMS, count_kept_faces, layout);
  size_t kept = ok ? assign_positions(layout->face_range, ranges) : 0;
  ok = ok && parallel_ranges(workers, faces, PARALLEL_ITEMS, find_orientations,
                             &work);
  if (atomic_load(&work.found_other)) {
    layout_free_face_ranges(layout);
    return true;
  }
  layout->flags.count = kept;
  layout->sheet->empty += faces - kept;
  layout->leaves_out_sides = layout->topology->drop_sides && kept == faces;
  return ok;
}

/* Makes the flags of faces those of triangles. */
static void move_flags(struct layout *layout) {
  size_t faces = scene_face_count(layout->scene), kept = 0;
  uint8_t *flags = layout->flags.item;
  for (size_t f = 0; layout->flags.count < faces && f < faces; f++)
    if (flags[f] != LAYOUT_NO_TRIANGLE)
      flags[kept++] = flags[f];
}

/* ---- Triangles ----------------------------------------------------------- */

/* Notes at the edge of a side that a triangle has it, or that this is to be
 * done; returns false when memory ran out. */
static inline bool link_side(struct face_range *range, struct sheet_edge *edge,
                             bool is_own, uint32_t side, uint32_t triangle) {
  if (is_own) {
    layout_use_edge(&edge[side], triangle);
    return true;
  }
  struct range_side late = {side, triangle};
  return ARRAY_PUSH(&range->late, late);
}

static bool make_triangles_of_range(void *user, struct parallel_range faces) {
  struct layout *layout = user;
  const struct face_loop loop = face_loop_of(layout);
  const struct layout_edge_ids ids = layout->ids;
  struct face_range *range = range_of(layout, faces.begin);
  struct sheet_edge *edge = layout->sheet->edge.item;
  struct sheet_triangle *triangle = layout->sheet->triangle.item;
  struct sheet_sides *sides = layout->sheet->sides.item;
  const uint8_t *flags = layout->flags.item;
  uint32_t t = range->first;
  for (size_t f = faces.begin; f < faces.end; f++) {
    uint32_t corner[3], point[3], side[3];
    if (!find_face_points(&loop, f, corner, point))
      continue;
    for (int k = 0; k < 3; k++) {
      uint32_t e = loop.corner_edge[3 * f + (size_t)k];
      side[k] = layout_edge_id(&ids, e);
      if (side[k] != SHEET_NONE &&
          !link_side(range, edge, e >= range->first_edge, side[k], t))
        return false;
    }
    bool flip = flags[t] & SHEET_FLIPPED;
    triangle[t] = layout_oriented_triangle(point, (uint32_t)f, flip);
    sides[t] = layout_oriented_sides(side, flip);
    t++;
  }
  return true;
}

static void link_late_sides(struct layout *layout, struct face_range *range) {
  for (size_t i = 0; i < range->late.count; i++) {
    const struct range_side *late = &range->late.item[i];
    layout_use_edge(&layout->sheet->edge.item[late->edge], late->triangle);
  }
}

/* The same where each face is a triangle and its sides are left out. */
static bool make_bare_triangles_of_range(void *user,
                                         struct parallel_range faces) {
  const struct layout *layout = user;
  const struct face_loop loop = face_loop_of(layout);
  struct sheet_triangle *triangle = layout->sheet->triangle.item;
  const uint8_t *flags = layout->flags.item;
  for (size_t f = faces.begin; f < faces.end; f++) {
    uint32_t corner[3], point[3];
    if (find_face_points(&loop, f, corner, point)) /* always */
      triangle[f] = layout_oriented_triangle(point, (uint32_t)f,
                                             flags[f] & SHEET_FLIPPED);
  }
  return true;
}

bool layout_make_all_triangles(struct layout *layout) {
  struct sheet *sheet = layout->sheet;
  size_t faces = scene_face_count(layout->scene);
  bool bare = layout->leaves_out_sides;
  move_flags(layout);
  size_t count = layout->flags.count;
  if (!ARRAY_RESERVE(&sheet->triangle, count) ||
      (!bare && !ARRAY_RESERVE(&sheet->sides, count)) ||
      !parallel_ranges(
          parallel_workers(faces, PARALLEL_ITEMS), faces, PARALLEL_ITEMS,
          bare ? make_bare_triangles_of_range : make_triangles_of_range,
          layout))
    return false;
  sheet->triangle.count = count;
  sheet->sides.count = bare ? 0 : count;
  sheet->triangles_are_faces = count == faces;
  for (size_t i = 0; i < count_ranges(layout); i++)
    link_late_sides(layout, &layout->face_range[i]);
  return true;
}

void layout_free_face_ranges(struct layout *layout) {
  for (size_t i = 0; layout->face_range != NULL && i < count_ranges(layout);
       i++)
    ARRAY_FREE(&layout->face_range[i].late);
  mem_free(layout->face_range);
  layout->face_range = NULL;
}
