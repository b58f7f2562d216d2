/* fill.c - one fill for each visible fragment, painted or shaded. */
#include "ink/fill.h"

#include "ink/layers.h"
#include "ink/light.h"
#include "view/vector.h"

/* Muted, so that lines stay the picture, and apart in hue or in lightness. */
static const uint32_t palette[] = {
    0x9db4c8, 0xe0c29a, 0xa9c4a0, 0xd3a39c, 0xb9aecb, 0xd9d3a4,
    0x8fb5b0, 0xc4a586, 0xc7d4de, 0xe3b8a0, 0x96a68a, 0xcfb3c3,
};

uint32_t fill_colour(const struct scene *scene, uint32_t group) {
  if (group < scene->group.count && scene->group.item[group].has_colour)
    return scene->group.item[group].colour;
  return palette[group % (sizeof palette / sizeof palette[0])];
}

/* ---- Shade ----------------------------------------------------------------
 */

static uint32_t grey_of(const struct scene *scene, uint32_t face,
                        const struct camera *camera, const double light[3]) {
  double normal[3];
  light_face_normal(scene, face, normal);
  if (light_is_turned_away(scene, face, camera, normal))
    for (int k = 0; k < 3; k++)
      normal[k] = -normal[k];
  (void)vector_normalise(normal);
  uint32_t level = (uint32_t)(255 * light_brightness(normal, light) + 0.5);
  return level << 16 | level << 8 | level;
}

/* ---- Fills ----------------------------------------------------------------
 */

static bool add_loops(struct drawing *drawing, const struct sheet *sheet,
                      const struct map *map,
                      const struct map_fragment *fragment) {
  for (uint32_t l = 0; l < fragment->loops; l++) {
    const struct map_loop *loop = &map->loop.item[fragment->loop + l];
    struct drawing_loop made = {(uint32_t)drawing->point.count, loop->count};
    if (!ARRAY_RESERVE(&drawing->point, loop->count) ||
        !ARRAY_PUSH(&drawing->loop, made))
      return false;
    for (uint32_t i = 0; i < loop->count; i++) {
      const struct map_corner *c = &map->corner.item[loop->corner + i];
      drawing->point.item[drawing->point.count++] = (struct drawing_point){
          sheet_x_mm(sheet, c->x), sheet_y_mm(sheet, c->y)};
    }
  }
  return true;
}

bool fill_add(struct drawing *drawing, const struct sheet *sheet,
              const struct scene *scene, const struct map *map,
              const recto_options *options) {
  double light[3];
  light_direction(&sheet->camera, options, light);
  for (size_t i = 0; i < map->fragment.count; i++) {
    const struct map_fragment *fragment = &map->fragment.item[i];
    uint32_t group = scene->face_group.item[fragment->face];
    struct drawing_fill fill = {.loop = (uint32_t)drawing->loop.count,
                                .loops = fragment->loops,
                                .layer = layers_pen_of_group(options, group),
                                .face = fragment->face,
                                .group = group};
    fill.colour = options->fill == RECTO_FILL_SHADE
                      ? grey_of(scene, fragment->face, &sheet->camera, light)
                      : fill_colour(scene, group);
    if (!add_loops(drawing, sheet, map, fragment) ||
        !ARRAY_PUSH(&drawing->fill, fill))
      return false;
  }
  return true;
}
