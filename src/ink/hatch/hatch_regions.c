/* hatch_regions.c - unites fragments that no drawn line separates into regions
 * that are hatched as one (base/union_find.h). */
#include "ink/hatch/hatch_regions.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "base/union_find.h"

bool hatch_regions_side_is_inked(const struct hatch_regions *regions,
                                 const struct map_corner *corner) {
  switch (corner->side) {
  case MAP_SIDE_EDGE:
  case MAP_SIDE_OCCLUDER:
    return corner->id < regions->sheet->edge.count &&
           regions->sheet->edge.item[corner->id].edge_class != 0;
  case MAP_SIDE_INTERSECTION:
    return regions->intersections;
  default:
    return false;
  }
}

/* Whether two twins divide a cut face.  Surfaces that end on it from behind may
 * do so within contact, by lines that are not drawn; and so do bridges, which
 * may be part of a side along which a line is drawn elsewhere. */
static bool is_within_cut_face(const struct hatch_regions *regions,
                               const struct scene *scene, const struct map *map,
                               const struct map_half_edge *a,
                               const struct map_half_edge *b) {
  uint32_t face = map->fragment.item[a->fragment].face;
  uint32_t other = map->fragment.item[b->fragment].face;
  if (!scene_is_cut_face(scene, face) || !scene_is_cut_face(scene, other))
    return false;
  return face == other ||
         (scene_face_group(scene, face) == scene_face_group(scene, other) &&
          !(hatch_regions_side_is_inked(regions, &map->corner.item[a->side]) &&
            hatch_regions_side_is_inked(regions, &map->corner.item[b->side])));
}

/* Whether a side's edge is not drawn and lies between two faces. */
static bool is_undrawn_between(const struct hatch_regions *regions,
                               const struct map_corner *corner, uint32_t face,
                               uint32_t other) {
  const struct sheet *sheet = regions->sheet;
  if (corner->id >= sheet->edge.count ||
      hatch_regions_side_is_inked(regions, corner))
    return false;
  const uint32_t *of = sheet->edge.item[corner->id].triangle;
  if (of[0] == SHEET_NONE || of[1] == SHEET_NONE)
    return false;
  uint32_t one = sheet->triangle.item[of[0]].face;
  uint32_t two = sheet->triangle.item[of[1]].face;
  return (one == face && two == other) || (one == other && two == face);
}

/* Whether twins are beside one mesh edge that is not drawn.  A side of several
 * edges on one line has the number of one of them alone: another edge of it,
 * that of both faces, may be that of the other side. */
static bool are_at_undrawn_edge(const struct hatch_regions *regions,
                                const struct map_corner *p,
                                const struct map_corner *q, uint32_t face,
                                uint32_t other) {
  if (p->side != MAP_SIDE_EDGE || q->side != MAP_SIDE_EDGE)
    return false;
  return p->id == q->id ? !hatch_regions_side_is_inked(regions, p)
                        : is_undrawn_between(regions, p, face, other) ||
                              is_undrawn_between(regions, q, face, other);
}

/* Whether the fragments of two twins belong to one region: they are beside one
 * mesh edge that is not drawn, and one pen hatches both, or parts of one face
 * that a scan-line method has split. */
static bool is_within_region(const struct hatch_regions *regions,
                             const struct scene *scene, const struct map *map,
                             const struct pens *pens,
                             const struct map_half_edge *a,
                             const struct map_half_edge *b) {
  const struct map_corner *p = &map->corner.item[a->side];
  const struct map_corner *q = &map->corner.item[b->side];
  uint32_t face = map->fragment.item[a->fragment].face;
  uint32_t other = map->fragment.item[b->fragment].face;
  if (is_within_cut_face(regions, scene, map, a, b))
    return true;
  if (p->side == MAP_SIDE_CLIP && q->side == MAP_SIDE_CLIP)
    return face == other;
  return are_at_undrawn_edge(regions, p, q, face, other) &&
         scene_is_cut_face(scene, face) == scene_is_cut_face(scene, other) &&
         pens_of_hatch(pens, scene_face_group(scene, face)) ==
             pens_of_hatch(pens, scene_face_group(scene, other));
}

/* What threads read, and write: each pair of twins is decided, and marked, at
 * the lower of the two. */
struct region_sides {
  const struct hatch_regions *regions;
  const struct scene *scene;
  const struct map *map;
  const struct pens *pens;
};

static void set_crossable(const struct region_sides *sides, size_t h) {
  sides->regions->crossable[h] = 1;
  sides->regions->crossable[sides->map->half_edge.item[h].twin] = 1;
}

/* Marks the half-edges between fragments that are to be joined: no line is
 * drawn where two of them meet. */
static bool mark_joints(void *user, struct parallel_range range) {
  const struct region_sides *sides = user;
  const struct map_half_edge *half = sides->map->half_edge.item;
  for (size_t h = range.begin; h < range.end; h++)
    if (half[h].twin != SHEET_NONE && half[h].twin > h &&
        is_within_region(sides->regions, sides->scene, sides->map, sides->pens,
                         &half[h], &half[half[h].twin]))
      set_crossable(sides, h);
  return true;
}

/* Joins the fragments of regions. */
static bool join_fragments(const struct region_sides *sides) {
  const struct map_half_edge *half = sides->map->half_edge.item;
  size_t count = sides->map->half_edge.count;
  if (!parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                       PARALLEL_ITEMS, mark_joints, (void *)sides))
    return false;
  for (size_t h = 0; h < count; h++)
    if (sides->regions->crossable[h] && half[h].twin > h)
      union_find_join(sides->regions->root, half[h].fragment,
                      half[half[h].twin].fragment);
  return true;
}

/* Finds the other half-edges within the regions along which no line is drawn:
 * those of fragments that are joined elsewhere. */
static bool find_crossable(void *user, struct parallel_range range) {
  const struct region_sides *sides = user;
  const struct hatch_regions *regions = sides->regions;
  const struct map *map = sides->map;
  const struct map_half_edge *half = map->half_edge.item;
  for (size_t h = range.begin; h < range.end; h++) {
    if (half[h].twin == SHEET_NONE || half[h].twin < h || regions->crossable[h])
      continue;
    const struct map_half_edge *twin = &half[half[h].twin];
    if (regions->root[half[h].fragment] == regions->root[twin->fragment] &&
        (is_within_cut_face(regions, sides->scene, map, &half[h], twin) ||
         (!hatch_regions_side_is_inked(regions,
                                       &map->corner.item[half[h].side]) &&
          !hatch_regions_side_is_inked(regions,
                                       &map->corner.item[twin->side]))))
      set_crossable(sides, h);
  }
  return true;
}

/* Lists the fragments by region.  False when memory ran out. */
static bool list_by_region(struct hatch_regions *regions) {
  struct sort_key *key = mem_alloc(regions->count, 2 * sizeof *key);
  if (key == NULL)
    return false;
  for (uint32_t f = 0; f < regions->count; f++) {
    regions->root[f] = union_find_root(regions->root, f);
    key[f] = (struct sort_key){regions->root[f], f};
  }
  sort_keys(key, key + regions->count, regions->count);
  for (size_t i = 0; i < regions->count; i++)
    regions->fragment[i] = key[i].value;
  mem_free(key);
  return true;
}

bool hatch_regions_init(struct hatch_regions *regions,
                        const struct sheet *sheet, const struct scene *scene,
                        const struct map *map, const struct pens *pens,
                        const recto_options *options) {
  *regions = (struct hatch_regions){
      .sheet = sheet,
      .intersections = (options->ink.edges & RECTO_EDGE_INTERSECTION) != 0,
      .count = map->fragment.count};
  regions->root = union_find_create(regions->count);
  regions->fragment = mem_alloc(regions->count, sizeof *regions->fragment);
  regions->crossable = mem_calloc(map->half_edge.count, 1);
  const struct region_sides sides = {regions, scene, map, pens};
  size_t count = map->half_edge.count;
  bool ok = regions->root != NULL && regions->fragment != NULL &&
            regions->crossable != NULL &&
            (options->ink.ids || join_fragments(&sides)) &&
            list_by_region(regions) &&
            parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                            PARALLEL_ITEMS, find_crossable, (void *)&sides);
  if (!ok)
    hatch_regions_fini(regions);
  return ok;
}

void hatch_regions_fini(struct hatch_regions *regions) {
  mem_free(regions->root);
  mem_free(regions->fragment);
  mem_free(regions->crossable);
  *regions = (struct hatch_regions){0};
}

bool hatch_regions_begins(const struct hatch_regions *regions, size_t index) {
  return index == 0 || regions->root[regions->fragment[index]] !=
                           regions->root[regions->fragment[index - 1]];
}

size_t hatch_regions_end(const struct hatch_regions *regions, size_t begin) {
  uint32_t root = regions->root[regions->fragment[begin]];
  size_t end = begin + 1;
  while (end < regions->count && regions->root[regions->fragment[end]] == root)
    end++;
  return end;
}
