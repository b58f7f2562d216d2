/* hatch_regions.c - fragments that no drawn line parts. */
#include "ink/hatch/hatch_regions.h"

#include "base/sets.h"
#include "base/sort.h"
#include "ink/hatch/shared_sides.h"

struct region_joining {
  const struct map *map;
  uint32_t *root; /* of each fragment */
};

/* The mesh edge that a side is a piece of; SHEET_NONE where there is none. */
static uint32_t own_edge(const struct hatch_regions *regions,
                         const struct map_corner *corner) {
  bool own =
      corner->side == MAP_SIDE_EDGE && corner->id < regions->sheet->edge.count;
  return own ? corner->id : SHEET_NONE;
}

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

/* seen  one a sheet edge: a fragment beside it, SHEET_NONE for not yet */
static void join_all(const struct hatch_regions *regions,
                     const struct scene *scene, const struct map *map,
                     const struct pens *pens, uint32_t *seen) {
  for (uint32_t f = 0; f < regions->count; f++) {
    const struct map_fragment *fragment = &map->fragment.item[f];
    uint32_t pen = pens_of_hatch(pens, scene->face_group.item[fragment->face]);
    for (uint32_t l = 0; l < fragment->loops; l++) {
      const struct map_loop *loop = &map->loop.item[fragment->loop + l];
      for (uint32_t i = 0; i < loop->count; i++) {
        const struct map_corner *corner = &map->corner.item[loop->corner + i];
        uint32_t edge = own_edge(regions, corner);
        if (edge == SHEET_NONE || hatch_regions_side_is_inked(regions, corner))
          continue;
        if (seen[edge] == SHEET_NONE)
          seen[edge] = f;
        uint32_t other = map->fragment.item[seen[edge]].face;
        if (pens_of_hatch(pens, scene->face_group.item[other]) == pen)
          sets_join(regions->root, seen[edge], f);
      }
    }
  }
}

static void join_at_cut(void *user, struct shared_side *ahead,
                        struct shared_side *turned) {
  const struct region_joining *joining = user;
  const struct map_fragment *fragment = joining->map->fragment.item;
  if (fragment[ahead->item].face == fragment[turned->item].face)
    sets_join(joining->root, ahead->item, turned->item);
}

/* Joins fragments of one face that only a cut of the method parts. */
static bool join_at_cuts(const struct hatch_regions *regions,
                         const struct map *map) {
  struct region_joining joining = {map, regions->root};
  shared_sides all = {0};
  bool ok = true;
  for (uint32_t f = 0; f < regions->count; f++) {
    const struct map_fragment *fragment = &map->fragment.item[f];
    for (uint32_t l = 0; l < fragment->loops; l++) {
      const struct map_loop *loop = &map->loop.item[fragment->loop + l];
      const struct map_corner *corner = map->corner.item + loop->corner;
      for (uint32_t i = 0; ok && i < loop->count; i++)
        ok = shared_sides_add_level(
            &all, &corner[i], &corner[i + 1 < loop->count ? i + 1 : 0], f);
    }
  }
  ok = ok && shared_sides_match(&all, join_at_cut, &joining);
  ARRAY_FREE(&all);
  return ok;
}

/* Lists the fragments by patch. */
static bool list(struct hatch_regions *regions) {
  struct sort_key *key = mem_alloc(regions->count, 2 * sizeof *key);
  if (key == NULL)
    return false;
  for (uint32_t f = 0; f < regions->count; f++) {
    regions->root[f] = sets_root(regions->root, f);
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
  size_t edges = options->ids ? 0 : sheet->edge.count;
  *regions = (struct hatch_regions){
      .sheet = sheet,
      .intersections = (options->edges & RECTO_EDGE_INTERSECTION) != 0,
      .count = map->fragment.count};
  uint32_t *seen = mem_alloc(edges, sizeof *seen);
  regions->root = sets_create(regions->count);
  regions->fragment = mem_alloc(regions->count, sizeof *regions->fragment);
  bool ok = seen && regions->root && regions->fragment;
  for (size_t e = 0; ok && e < edges; e++)
    seen[e] = SHEET_NONE;
  if (ok && !options->ids) {
    join_all(regions, scene, map, pens, seen);
    ok = join_at_cuts(regions, map);
  }
  ok = ok && list(regions);
  mem_free(seen);
  if (!ok)
    hatch_regions_fini(regions);
  return ok;
}

void hatch_regions_fini(struct hatch_regions *regions) {
  mem_free(regions->root);
  mem_free(regions->fragment);
  *regions = (struct hatch_regions){0};
}

size_t hatch_regions_end(const struct hatch_regions *regions, size_t begin) {
  uint32_t root = regions->root[regions->fragment[begin]];
  size_t end = begin + 1;
  while (end < regions->count && regions->root[regions->fragment[end]] == root)
    end++;
  return end;
}
