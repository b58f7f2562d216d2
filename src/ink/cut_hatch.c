/* cut_hatch.c - chooses angles and pitches that tell neighbouring groups apart.
 *
 * Groups are given their hatching in the order of the scene, greedily: so it is
 * the same in all views. */
#include "ink/cut_hatch.h"

#include "base/memory.h"
#include "base/sort.h"

bool cut_hatch_is_drawn(const recto_options *options) {
  return (options->mesh.cut_count > 0 || options->camera.has_section) &&
         options->mesh.cut_fill != RECTO_CUT_FILL_NONE;
}

recto_status cut_hatch_check(const struct scene *scene,
                             const recto_options *options, recto_error *error) {
  for (size_t i = 0; i < options->mesh.cut_hatch_count; i++) {
    const char *name = options->mesh.cut_hatch[i].group;
    bool found = false;
    for (size_t g = 0; g < scene->group.count; g++)
      found = found || pens_is_name_of(name, scene->group.item[g].name);
    if (!found)
      return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                       "hatching of cut faces is for \"%.80s\", which is no "
                       "group of the model",
                       name);
  }
  return RECTO_OK;
}

/* ---- Styles -------------------------------------------------------------- */

/* ISO 128-50: 45 degrees; others where neighbours differ. */
static const double turns[] = {0, 90, -15, 75, 15, 105};
static const double pitches[] = {1, 0.6, 1.5, 0.8};
enum {
  TURNS = sizeof turns / sizeof turns[0],
  STYLES = TURNS * sizeof pitches / sizeof pitches[0]
};

static struct cut_hatch style_of(unsigned style, const recto_options *options) {
  return (struct cut_hatch){options->ink.hatch_angle_deg + turns[style % TURNS],
                            options->ink.hatch_pitch_mm *
                                pitches[style / TURNS]};
}

/* ---- Neighbours ---------------------------------------------------------- */

struct neighbours {
  ARRAY(struct sort_key) pair; /* key: a group; value: one beside it; sorted */
};

/* Finds the groups whose cut faces have a side in common. */
static bool find_neighbouring_cuts(struct neighbours *neighbours,
                                   const struct scene *scene) {
  ARRAY(struct sort_key) side = {0};
  bool ok = true;
  for (uint32_t f = scene->cut->first_face; ok && f < scene_face_count(scene);
       f++)
    for (uint32_t c = scene_face_start(scene, f);
         ok && c < scene_face_start(scene, f + 1); c++) {
      const struct sort_key own = {
          sort_pair_key(scene->corner.item[c],
                        scene->corner.item[scene_next_corner(scene, f, c)]),
          scene_face_group(scene, f)};
      ok = ARRAY_PUSH(&side, own);
    }
  ok = ok && sort_keys_alone(side.item, side.count);
  for (size_t i = 1; ok && i < side.count; i++) {
    uint32_t a = side.item[i - 1].value, b = side.item[i].value;
    if (side.item[i].key == side.item[i - 1].key && a != b)
      ok = ARRAY_PUSH(&neighbours->pair, ((struct sort_key){a, b})) &&
           ARRAY_PUSH(&neighbours->pair, ((struct sort_key){b, a}));
  }
  ARRAY_FREE(&side);
  return ok && sort_keys_unique(neighbours->pair.item, &neighbours->pair.count);
}

/* The styles that neighbours of a group have, a bit each.
 * style  of the groups before it */
static uint32_t styles_beside(const struct neighbours *neighbours,
                              uint32_t group, const uint8_t *style) {
  const struct sort_key *pair = neighbours->pair.item;
  uint32_t styles = 0;
  size_t i;
  LOWER_BOUND(i, 0, neighbours->pair.count, pair[i].key < group);
  for (; i < neighbours->pair.count && pair[i].key == group; i++)
    if (pair[i].value < group)
      styles |= UINT32_C(1) << style[pair[i].value];
  return styles;
}

/* The options' hatching of a group; NULL: there is none. */
static const recto_cut_hatch *find_requested(const struct scene *scene,
                                             uint32_t group,
                                             const recto_options *options) {
  const recto_cut_hatch *found = NULL;
  for (size_t i = 0; i < options->mesh.cut_hatch_count; i++)
    if (pens_is_name_of(options->mesh.cut_hatch[i].group,
                        scene->group.item[group].name))
      found = &options->mesh.cut_hatch[i];
  return found;
}

/* Chooses a style for each group with cut faces.
 * style  one a group */
static void choose_styles(const struct scene *scene,
                          const struct neighbours *neighbours, uint8_t *style,
                          struct cut_hatch *hatch,
                          const recto_options *options) {
  uint32_t first = 0;
  for (uint32_t g = 0; g < scene->group.count; g++) {
    uint32_t beside = styles_beside(neighbours, g, style), own = first;
    if (hatch[g].pitch_mm == 0)
      continue;
    for (int i = 0; i < STYLES && (beside >> own & 1); i++)
      own = (own + 1) % STYLES;
    style[g] = (uint8_t)own;
    hatch[g] = style_of(own, options);
    first = (first + 1) % TURNS;
  }
}

struct cut_hatch *cut_hatch_of_groups(const struct scene *scene,
                                      const struct pens *pens,
                                      const recto_options *options) {
  struct neighbours neighbours = {{0}};
  size_t groups = scene->group.count;
  struct cut_hatch *hatch = mem_calloc(groups, sizeof *hatch);
  uint8_t *style = mem_calloc(groups, sizeof *style);
  bool ok = hatch != NULL && style != NULL &&
            find_neighbouring_cuts(&neighbours, scene);
  for (uint32_t f = scene->cut->first_face; ok && f < scene_face_count(scene);
       f++)
    hatch[scene_face_group(scene, f)].pitch_mm = 1;
  if (ok)
    choose_styles(scene, &neighbours, style, hatch, options);
  for (uint32_t g = 0; ok && g < groups; g++) {
    const recto_cut_hatch *own = find_requested(scene, g, options);
    if (hatch[g].pitch_mm == 0)
      continue;
    if (own != NULL && own->pitch_mm > 0)
      hatch[g].pitch_mm = own->pitch_mm;
    if (own != NULL)
      hatch[g].angle_deg = own->angle_deg;
    /* Lines that overlap a little leave no paper between them. */
    if (options->mesh.cut_fill == RECTO_CUT_FILL_SOLID)
      hatch[g].pitch_mm = 0.9 * pens_width_mm(pens, pens_of_hatch(pens, g));
  }
  ARRAY_FREE(&neighbours.pair);
  mem_free(style);
  if (!ok)
    mem_free(hatch);
  return ok ? hatch : NULL;
}
