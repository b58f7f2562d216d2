/* layout_polygon_ranges.c - lays out ranges of faces, of which some need
 * triangulation but none clipping.
 *
 * Each range is laid out as a sheet of its own, with the points of all.  Its
 * triangles begin where they would if no face lost any; they are moved together
 * at the end.  An edge belongs to the range of its first face (edges are in the
 * order of these); others list on which sides of it their faces lie. */
#include "view/layout_polygon_ranges.h"

#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "view/layout_unclipped.h"

/* Faces that a thread takes at once. */
enum { FACES_IN_RANGE = PARALLEL_RANGE(1 << 12) };

struct polygon_range {
  struct layout layout;
  struct sheet sheet;
};

struct polygon_ranges {
  const struct layout *layout; /* of all */
  struct polygon_range *range;
};

/* How many triangles there may be of the faces before this one. */
static size_t most_before(const struct layout *layout, size_t face) {
  return scene_face_start(layout->scene, (uint32_t)face) - 2 * face;
}

/* The first topology edge that no face before this one has. */
static uint32_t first_edge_of(const struct layout *layout, size_t face) {
  const struct topology *topology = layout->topology;
  size_t first;
  LOWER_BOUND(first, 0, topology->edge.count,
              topology->edge.item[first].first < face);
  return (uint32_t)first;
}

/* Lets a range be empty, with the room that it has among the arrays of all. */
static void begin_range(const struct layout *all, struct polygon_range *range,
                        struct parallel_range faces) {
  struct layout *own = &range->layout;
  struct sheet *sheet = &range->sheet;
  size_t begin = most_before(all, faces.begin),
         room = most_before(all, faces.end) - begin;
  *sheet = (struct sheet){.point = all->sheet->point,
                          .scene = all->sheet->scene,
                          .camera = all->sheet->camera,
                          .z_scale = all->sheet->z_scale,
                          .units_per_view = all->sheet->units_per_view};
  *own = (struct layout){.sheet = sheet,
                         .scene = all->scene,
                         .topology = all->topology,
                         .options = all->options,
                         .all_edges = all->all_edges,
                         .projection = all->projection,
                         .point_map = all->point_map,
                         .outcode = all->outcode,
                         .sides = all->sides,
                         .first_edge = first_edge_of(all, faces.begin)};
  sheet->triangle.item = all->sheet->triangle.item + begin;
  sheet->sides.item = all->sheet->sides.item + begin;
  own->flags.item = all->flags.item + begin;
  sheet->triangle.capacity = sheet->sides.capacity = own->flags.capacity = room;
}

static bool add_faces_of_range(void *user, struct parallel_range faces) {
  struct polygon_ranges *work = user;
  struct polygon_range *range = &work->range[faces.begin / FACES_IN_RANGE];
  struct layout *own = &range->layout;
  uint32_t end = (uint32_t)faces.end;
  begin_range(work->layout, range, faces);
  recto_error error;
  own->error = &error;
  /* Three for each triangle at most: a polygon that touches itself may have
   * diagonals that are sides of it, too. */
  bool ok = ARRAY_RESERVE(&own->late, 3 * range->sheet.triangle.capacity);
  for (uint32_t face = (uint32_t)faces.begin; ok && face < end; face++) {
    face = layout_unclipped_faces(own, face, end);
    ok = face == end || layout_face(own, face) == RECTO_OK;
  }
  own->error = NULL;
  if (own->late.count == 0)
    ARRAY_FREE(&own->late); /* most room was not needed */
  else
    ARRAY_TRIM(&own->late);
  layout_free_face(own);
  ARRAY_FREE(&own->clipped);
  return ok;
}

/* ---- Joining ------------------------------------------------------------- */

/* Moves the triangles of a range to the end of all that are before it.  Its
 * sides refer to folds by their number in the range. */
static void move_triangles(struct layout *all, const struct layout *own) {
  struct sheet *sheet = all->sheet;
  size_t end = sheet->triangle.count, count = own->flags.count;
  uint32_t named = (uint32_t)all->topology->edge.count,
           folds = (uint32_t)all->fold.count;
  memmove(sheet->triangle.item + end, own->sheet->triangle.item,
          count * sizeof *sheet->triangle.item);
  memmove(sheet->sides.item + end, own->sheet->sides.item,
          count * sizeof *sheet->sides.item);
  memmove(all->flags.item + end, own->flags.item, count);
  sheet->triangle.count = sheet->sides.count = all->flags.count = end + count;
  for (size_t t = end; folds > 0 && own->fold.count > 0 && t < end + count; t++)
    for (int k = 0; k < 3; k++) {
      uint32_t *side = &sheet->sides.item[t].edge[k];
      if (*side >= named && *side != SHEET_NONE)
        *side += folds;
    }
}

/* Returns false when memory ran out. */
static bool join_polygon_range(struct layout *all,
                               const struct polygon_range *range) {
  const struct layout *own = &range->layout;
  const struct sheet *from = &range->sheet;
  struct sheet *to = all->sheet;
  move_triangles(all, own);
  for (size_t i = 0; i < own->late.count; i++)
    layout_unite_sides(&all->sides[own->late.item[i].edge],
                       own->late.item[i].sides);
  to->warped += from->warped;
  to->empty += from->empty;
  bool ok = true;
  for (size_t i = 0; ok && i < own->fold.count; i++)
    ok = ARRAY_PUSH(&all->fold, own->fold.item[i]);
  for (size_t i = 0; ok && i < from->contour.count; i++)
    ok = ARRAY_PUSH(&to->contour, from->contour.item[i]);
  for (size_t i = 0; ok && i < from->face_error.count; i++)
    ok = ARRAY_PUSH(&to->face_error, from->face_error.item[i]);
  return ok;
}

static void free_ranges(struct polygon_range *range, size_t count) {
  for (size_t i = 0; range != NULL && i < count; i++) {
    ARRAY_FREE(&range[i].layout.late);
    ARRAY_FREE(&range[i].layout.fold);
    ARRAY_FREE(&range[i].sheet.contour);
    ARRAY_FREE(&range[i].sheet.face_error);
  }
  mem_free(range);
}

recto_status layout_polygon_ranges(struct layout *layout) {
  size_t faces = scene_face_count(layout->scene),
         count = parallel_range_count(faces, FACES_IN_RANGE);
  struct polygon_ranges work = {.layout = layout,
                                .range = mem_calloc(count, sizeof *work.range)};
  bool ok = work.range != NULL &&
            parallel_ranges(parallel_workers(faces, FACES_IN_RANGE), faces,
                            FACES_IN_RANGE, add_faces_of_range, &work);
  for (size_t i = 0; ok && i < count; i++)
    ok = join_polygon_range(layout, &work.range[i]);
  free_ranges(work.range, count);
  return ok ? RECTO_OK : error_memory(layout->error);
}
