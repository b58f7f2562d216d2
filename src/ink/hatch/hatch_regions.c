/* hatch_regions.c - unites fragments that no drawn line separates into regions
 * that are hatched as one (disjoint sets, base/sets.h). */
#include "ink/hatch/hatch_regions.h"

#include "base/sets.h"
#include "base/sort.h"
#include "ink/hatch/shared_sides.h"

struct region_joining {
  const struct map *map;
  uint32_t *root; /* of each fragment */
};

/* The edge of its own face that the side starting at a corner is a piece of, or
 * SHEET_NONE. */
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

/* Joins fragments beside a mesh edge that is not drawn, if one pen hatches
 * both.
 * first_beside  of each sheet edge: the first fragment found beside it;
 *               SHEET_NONE when called */
static void join_at_edges(const struct hatch_regions *regions,
                          const struct scene *scene, const struct map *map,
                          const struct pens *pens, uint32_t *first_beside) {
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
        if (first_beside[edge] == SHEET_NONE)
          first_beside[edge] = f;
        uint32_t other = map->fragment.item[first_beside[edge]].face;
        if (pens_of_hatch(pens, scene->face_group.item[other]) == pen)
          sets_join(regions->root, first_beside[edge], f);
      }
    }
  }
}

/* Joins the fragments of two sides that have a stretch in common, if they are
 * of one face. */
static void join_pair(void *user, struct shared_side *forward,
                      struct shared_side *reversed) {
  const struct region_joining *joining = user;
  const struct map_fragment *fragment = joining->map->fragment.item;
  if (fragment[forward->item].face == fragment[reversed->item].face)
    sets_join(joining->root, forward->item, reversed->item);
}

/* Joins fragments of one face that are separated only by a horizontal split of
 * a scan-line method.  False when memory ran out. */
static bool join_at_splits(const struct hatch_regions *regions,
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
        ok = shared_sides_add_split(
            &all, &corner[i], &corner[i + 1 < loop->count ? i + 1 : 0], f);
    }
  }
  ok = ok && shared_sides_match(&all, join_pair, &joining);
  ARRAY_FREE(&all);
  return ok;
}

/* Lists the fragments by region.  False when memory ran out. */
static bool list_by_region(struct hatch_regions *regions) {
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
  uint32_t *first_beside = mem_alloc(edges, sizeof *first_beside);
  regions->root = sets_create(regions->count);
  regions->fragment = mem_alloc(regions->count, sizeof *regions->fragment);
  bool ok = first_beside && regions->root && regions->fragment;
  for (size_t e = 0; ok && e < edges; e++)
    first_beside[e] = SHEET_NONE;
  if (ok && !options->ids) {
    join_at_edges(regions, scene, map, pens, first_beside);
    ok = join_at_splits(regions, map);
  }
  ok = ok && list_by_region(regions);
  mem_free(first_beside);
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
