/* fill.c - makes fills of the visible fragments, painted or shaded. */
#include "ink/fill/fill.h"

#include "base/poll.h"
#include "ink/fill/light.h"
#include "ink/fill/merge.h"
#include "ink/ink.h"
#include "view/vector.h"

/* Colours of low saturation, so that the lines dominate the picture; any two
 * differ in hue or in lightness. */
static const uint32_t palette[] = {
    0x9db4c8, 0xe0c29a, 0xa9c4a0, 0xd3a39c, 0xb9aecb, 0xd9d3a4,
    0x8fb5b0, 0xc4a586, 0xc7d4de, 0xe3b8a0, 0x96a68a, 0xcfb3c3,
};

uint32_t fill_colour(const struct scene *scene, uint32_t group) {
  if (group < scene->group.count && scene->group.item[group].has_colour)
    return scene->group.item[group].colour;
  return palette[group % (sizeof palette / sizeof palette[0])];
}

/* ---- Shade --------------------------------------------------------------- */

/* The brightness of a face by its angle to the light.  The normal is turned
 * towards the viewer first, so both sides of a face are shaded alike. */
static double shade(const struct scene *scene, uint32_t face,
                    const struct camera *camera, const double light[3],
                    bool *is_back) {
  double normal[3];
  light_face_normal(scene, face, normal);
  *is_back = light_is_turned_away(scene, face, camera, normal);
  for (int k = 0; k < 3 && *is_back; k++)
    normal[k] = -normal[k];
  (void)vector_normalise(normal);
  return light_brightness(normal, light);
}

static uint32_t grey_of(double brightness) {
  uint32_t level = (uint32_t)(255 * brightness + 0.5);
  return level << 16 | level << 8 | level;
}

struct ink_look ink_look_of(const struct scene *scene, uint32_t face,
                            const struct camera *camera,
                            const recto_options *options) {
  struct ink_look look = {.colour =
                              fill_colour(scene, scene->face_group.item[face])};
  double light[3];
  light_direction(camera, options, light);
  look.brightness = shade(scene, face, camera, light, &look.is_back);
  return look;
}

/* ---- Fills --------------------------------------------------------------- */

/* The fill of a fragment of this face: colour, face and group, but no loops. */
static struct drawing_fill fill_without_loops(const struct sheet *sheet,
                                              const struct scene *scene,
                                              uint32_t face,
                                              const double light[3],
                                              const recto_options *options) {
  uint32_t group = scene->face_group.item[face];
  bool is_back;
  return (struct drawing_fill){
      .colour =
          options->ink.fill == RECTO_FILL_SHADE
              ? grey_of(shade(scene, face, &sheet->camera, light, &is_back))
              : fill_colour(scene, group),
      .face = face,
      .group = group};
}

bool fill_add(struct drawing *drawing, const struct sheet *sheet,
              const struct scene *scene, const struct map *map,
              const recto_options *options) {
  struct drawing_fill *prototype =
      mem_alloc(map->fragment.count, sizeof *prototype);
  double light[3];
  if (prototype == NULL)
    return false;
  light_direction(&sheet->camera, options, light);
  bool ok = true;
  for (size_t i = 0; ok && i < map->fragment.count; i++) {
    prototype[i] = fill_without_loops(sheet, scene, map->fragment.item[i].face,
                                      light, options);
    ok = poll_at(i);
  }
  ok = ok && merge_fills(drawing, sheet, scene, map, prototype, options);
  mem_free(prototype);
  return ok;
}
