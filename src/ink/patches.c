/* patches.c - fragments that no drawn line parts. */
#include "ink/patches.h"

#include "base/sets.h"
#include "base/sort.h"
#include "ink/cuts.h"

struct joining {
  const struct map *map;
  uint32_t *root; /* of each fragment */
};

/* The mesh edge that a side is a piece of; SHEET_NONE where there is none. */
static uint32_t own_edge(const struct patches *patches,
                         const struct map_corner *corner) {
  bool own =
      corner->side == MAP_SIDE_EDGE && corner->id < patches->sheet->edge.count;
  return own ? corner->id : SHEET_NONE;
}

bool patches_is_inked(const struct patches *patches,
                      const struct map_corner *corner) {
  switch (corner->side) {
  case MAP_SIDE_EDGE:
  case MAP_SIDE_OUTLINE:
    return corner->id < patches->sheet->edge.count &&
           patches->sheet->edge.item[corner->id].edge_class != 0;
  case MAP_SIDE_INTERSECTION:
    return patches->intersections;
  default:
    return false;
  }
}

/* seen  one a sheet edge: a fragment beside it, SHEET_NONE for not yet */
static void join_all(const struct patches *patches, const struct scene *scene,
                     const struct map *map, const struct pens *pens,
                     uint32_t *seen) {
  for (uint32_t f = 0; f < patches->count; f++) {
    const struct map_fragment *fragment = &map->fragment.item[f];
    uint32_t pen = pens_of_hatch(pens, scene->face_group.item[fragment->face]);
    for (uint32_t l = 0; l < fragment->loops; l++) {
      const struct map_loop *loop = &map->loop.item[fragment->loop + l];
      for (uint32_t i = 0; i < loop->count; i++) {
        const struct map_corner *corner = &map->corner.item[loop->corner + i];
        uint32_t edge = own_edge(patches, corner);
        if (edge == SHEET_NONE || patches_is_inked(patches, corner))
          continue;
        if (seen[edge] == SHEET_NONE)
          seen[edge] = f;
        uint32_t other = map->fragment.item[seen[edge]].face;
        if (pens_of_hatch(pens, scene->face_group.item[other]) == pen)
          sets_join(patches->root, seen[edge], f);
      }
    }
  }
}

static void join_at_cut(void *user, struct cut *ahead, struct cut *turned) {
  const struct joining *joining = user;
  const struct map_fragment *fragment = joining->map->fragment.item;
  if (fragment[ahead->item].face == fragment[turned->item].face)
    sets_join(joining->root, ahead->item, turned->item);
}

/* Joins fragments of one face that only a cut of the method parts. */
static bool join_at_cuts(const struct patches *patches, const struct map *map) {
  struct joining joining = {map, patches->root};
  cuts all = {0};
  bool ok = true;
  for (uint32_t f = 0; f < patches->count; f++) {
    const struct map_fragment *fragment = &map->fragment.item[f];
    for (uint32_t l = 0; l < fragment->loops; l++) {
      const struct map_loop *loop = &map->loop.item[fragment->loop + l];
      const struct map_corner *corner = map->corner.item + loop->corner;
      for (uint32_t i = 0; ok && i < loop->count; i++)
        ok = cuts_add_level(&all, &corner[i],
                            &corner[i + 1 < loop->count ? i + 1 : 0], f);
    }
  }
  ok = ok && cuts_meet(&all, join_at_cut, &joining);
  ARRAY_FREE(&all);
  return ok;
}

/* Lists the fragments by patch. */
static bool list(struct patches *patches) {
  struct sort_key *key = mem_alloc(patches->count, 2 * sizeof *key);
  if (key == NULL)
    return false;
  for (uint32_t f = 0; f < patches->count; f++) {
    patches->root[f] = sets_root(patches->root, f);
    key[f] = (struct sort_key){patches->root[f], f};
  }
  sort_keys(key, key + patches->count, patches->count);
  for (size_t i = 0; i < patches->count; i++)
    patches->fragment[i] = key[i].value;
  mem_free(key);
  return true;
}

bool patches_init(struct patches *patches, const struct sheet *sheet,
                  const struct scene *scene, const struct map *map,
                  const struct pens *pens, const recto_options *options) {
  size_t edges = options->ids ? 0 : sheet->edge.count;
  *patches = (struct patches){
      .sheet = sheet,
      .intersections = (options->edges & RECTO_EDGE_INTERSECTION) != 0,
      .count = map->fragment.count};
  uint32_t *seen = mem_alloc(edges, sizeof *seen);
  patches->root = sets_create(patches->count);
  patches->fragment = mem_alloc(patches->count, sizeof *patches->fragment);
  bool ok = seen && patches->root && patches->fragment;
  for (size_t e = 0; ok && e < edges; e++)
    seen[e] = SHEET_NONE;
  if (ok && !options->ids) {
    join_all(patches, scene, map, pens, seen);
    ok = join_at_cuts(patches, map);
  }
  ok = ok && list(patches);
  mem_free(seen);
  if (!ok)
    patches_fini(patches);
  return ok;
}

void patches_fini(struct patches *patches) {
  mem_free(patches->root);
  mem_free(patches->fragment);
  *patches = (struct patches){0};
}

size_t patches_end(const struct patches *patches, size_t begin) {
  uint32_t root = patches->root[patches->fragment[begin]];
  size_t end = begin + 1;
  while (end < patches->count && patches->root[patches->fragment[end]] == root)
    end++;
  return end;
}
