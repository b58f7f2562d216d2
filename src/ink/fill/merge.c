/* merge.c - merges neighbouring visible fragments of one colour to one fill.
 *
 * Phases
 *   1 remove the half-edges between fragments of one colour along smooth edges,
 *     and unite the sets of the two fragments (union-find)
 *   2 join the remaining half-edges of each set end to end to the outline of a
 *     fill
 * Invariant
 *   As many half-edges end at a point as start there, since they are removed in
 *   pairs of twins.  So the remaining ones can be joined to closed loops.
 *   Fills are filled even-odd, so the choice of the loops does not affect what
 *   is filled. */
#include "ink/fill/merge.h"

#include "base/parallel.h"
#include "base/poll.h"
#include "base/sort.h"
#include "base/union_find.h"
#include "ink/fill/outline.h"
#include "scene/edges/edge_classes.h"

struct merge {
  struct drawing *drawing;
  const struct sheet *sheet;
  const struct scene *scene;
  const struct map *map;
  const struct drawing_fill *prototype; /* one a fragment, without loops */
  double crease_cosine;
  bool smooth;      /* fragments were fitted to smooth contours */
  uint32_t *root;   /* of each fragment: its parent in the union-find forest */
  uint8_t *merged;  /* of each fragment: it has removed half-edges */
  uint8_t *removed; /* of each half-edge */
  struct outline outline; /* of the current fill */
  struct ink_paths loops; /* of the current fill */
};

/* ---- 1. Removal of half-edges -------------------------------------------- */

/* Whether a sheet edge is smooth.  An edge without a class, since its class is
 * not drawn, is classified here. */
static bool is_edge_smooth(const struct merge *merge, uint32_t id) {
  const struct sheet_edge *edge = &merge->sheet->edge.item[id];
  if (edge->edge_class != 0)
    return edge->edge_class == RECTO_EDGE_SMOOTH;
  const struct topology *topology = merge->sheet->topology;
  return topology != NULL && edge->source < topology->edge.count &&
         (topology_class_mask_by_cosine(topology, merge->scene, edge->source,
                                        merge->crease_cosine) &
          ~(unsigned)RECTO_EDGE_SMOOTH) == 0;
}

/* Whether two twins are pieces of one smooth edge of both their faces, and the
 * fragments have one colour. */
static bool is_within_fill(const struct merge *merge,
                           const struct map_half_edge *a,
                           const struct map_half_edge *b) {
  const struct map_corner *p = &merge->map->corner.item[a->side];
  const struct map_corner *q = &merge->map->corner.item[b->side];
  return p->side == MAP_SIDE_EDGE && q->side == MAP_SIDE_EDGE &&
         p->id == q->id && p->id < merge->sheet->edge.count &&
         merge->prototype[a->fragment].colour ==
             merge->prototype[b->fragment].colour &&
         is_edge_smooth(merge, p->id);
}

/* Marks the half-edges of a range that lie within a fill; of two twins the
 * first. */
static bool mark_half_edges(void *user, struct parallel_range range) {
  const struct merge *merge = user;
  const struct map_half_edge *half = merge->map->half_edge.item;
  for (size_t h = range.begin; h < range.end; h++) {
    uint32_t twin = half[h].twin;
    merge->removed[h] = twin != SHEET_NONE && twin > h &&
                        is_within_fill(merge, &half[h], &half[twin]);
  }
  return true;
}

/* Returns false when the caller cancelled. */
static bool remove_half_edges(struct merge *merge) {
  const struct map_half_edge *half = merge->map->half_edge.item;
  size_t count = merge->map->half_edge.count;
  if (!parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                       PARALLEL_ITEMS, mark_half_edges, merge))
    return false;
  for (uint32_t h = 0; h < count; h++) {
    uint32_t twin = half[h].twin;
    (void)poll_at(h);
    if (!merge->removed[h] || twin < h)
      continue;
    merge->removed[twin] = 1;
    merge->merged[half[h].fragment] = merge->merged[half[twin].fragment] = 1;
    union_find_join(merge->root, half[h].fragment, half[twin].fragment);
  }
  return true;
}

/* ---- 2. Fills ------------------------------------------------------------ */

static struct outline_point half_edge_origin(const struct map *map,
                                             uint32_t half) {
  const struct map_corner *c =
      &map->corner.item[map->half_edge.item[half].origin];
  return (struct outline_point){c->x, c->y};
}

/* Adds what remains of a loop of the map to the outline; of one that is not
 * merged all of it to the loops.  Where a side merely has another neighbour
 * there is no point. */
static bool add_outline_half_edges(struct merge *merge,
                                   const struct map_loop *loop, bool merged) {
  const struct map *map = merge->map;
  const struct map_half_edge *half = map->half_edge.item;
  uint32_t h = loop->half_edge, side = SHEET_NONE;
  if (!merged && !outline_begin_loop(&merge->loops))
    return false;
  do {
    bool goes_on = half[h].side == side && !merge->removed[h];
    struct outline_segment segment = {
        half_edge_origin(map, h), half_edge_origin(map, half[h].next), false};
    side = merge->removed[h] ? SHEET_NONE : half[h].side;
    if (!merged) {
      if (!goes_on && !outline_add_point(&merge->loops, segment.from))
        return false;
    } else if (goes_on) {
      merge->outline.segment.item[merge->outline.segment.count - 1].to =
          segment.to;
    } else if (!merge->removed[h] &&
               !ARRAY_PUSH(&merge->outline.segment, segment)) {
      return false;
    }
    h = half[h].next;
  } while (h != loop->half_edge);
  return true;
}

static bool add_loop(struct merge *merge, const struct ink_point *point,
                     uint32_t count) {
  struct drawing *drawing = merge->drawing;
  struct drawing_loop loop = {(uint32_t)drawing->point.count, count};
  if (!ARRAY_PUSH(&drawing->loop, loop) ||
      !ARRAY_RESERVE(&drawing->point, count))
    return false;
  for (uint32_t i = 0; i < count; i++)
    drawing->point.item[drawing->point.count++] =
        (struct drawing_point){sheet_x_mm(merge->sheet, point[i].x),
                               sheet_y_mm(merge->sheet, point[i].y)};
  return true;
}

/* Adds the fill of a set of fragments, with the colour and ids of the first.
 * Points within straight lines are removed.  If all loops are too thin to have
 * an area, no fill is added. */
static bool add_fill(struct merge *merge, const struct sort_key *fragment,
                     size_t count) {
  const struct map *map = merge->map;
  struct drawing *drawing = merge->drawing;
  struct drawing_fill fill = merge->prototype[fragment->value];
  struct ink_paths *paths = &merge->loops;
  bool merged = merge->merged[fragment->value];
  fill.loop = (uint32_t)drawing->loop.count;
  paths->path.count = paths->point.count = merge->outline.segment.count = 0;
  for (size_t i = 0; i < count; i++) {
    const struct map_fragment *f = &map->fragment.item[fragment[i].value];
    for (uint32_t l = 0; l < f->loops; l++)
      if (!add_outline_half_edges(merge, &map->loop.item[f->loop + l], merged))
        return false;
  }
  if (merged && !outline_trace(&merge->outline, paths))
    return false;
  if (merge->smooth)
    outline_remove_spikes(paths);
  paths_straighten(paths, 0);
  for (size_t i = 0; i < paths->path.count; i++) {
    const struct ink_path *path = &paths->path.item[i];
    if (path->closed &&
        !add_loop(merge, paths->point.item + path->point, path->count))
      return false;
  }
  fill.loops = (uint32_t)drawing->loop.count - fill.loop;
  return fill.loops == 0 || ARRAY_PUSH(&drawing->fill, fill);
}

static bool add_merged_fills(struct merge *merge) {
  size_t count = merge->map->fragment.count;
  struct sort_key *fragment = mem_alloc(count, 2 * sizeof *fragment);
  bool ok = fragment != NULL;
  for (uint32_t i = 0; ok && i < count; i++)
    fragment[i] = (struct sort_key){union_find_root(merge->root, i), i};
  if (ok)
    sort_keys(fragment, fragment + count, count);
  for (size_t i = 0, j, n = 0; ok && i < count; i = j, n++) {
    for (j = i + 1; j < count && fragment[j].key == fragment[i].key;)
      j++;
    ok = poll_at(n) && add_fill(merge, &fragment[i], j - i);
  }
  mem_free(fragment);
  return ok;
}

bool merge_fills(struct drawing *drawing, const struct sheet *sheet,
                 const struct scene *scene, const struct map *map,
                 const struct drawing_fill *prototype,
                 const recto_options *options) {
  struct merge merge = {
      .drawing = drawing,
      .sheet = sheet,
      .scene = scene,
      .map = map,
      .prototype = prototype,
      .crease_cosine = topology_crease_cosine(options->mesh.crease_deg),
      .smooth = options->ink.contours == RECTO_CONTOURS_SMOOTH,
      .root = union_find_create(map->fragment.count),
      .merged = mem_calloc(map->fragment.count, sizeof *merge.merged),
      .removed = mem_calloc(map->half_edge.count, sizeof *merge.removed)};
  bool ok = merge.root != NULL && merge.merged != NULL && merge.removed != NULL;
  ok = ok && (options->ink.ids || remove_half_edges(&merge)) &&
       add_merged_fills(&merge);
  mem_free(merge.root);
  mem_free(merge.merged);
  mem_free(merge.removed);
  ARRAY_FREE(&merge.outline.segment);
  paths_fini(&merge.loops);
  return ok;
}
