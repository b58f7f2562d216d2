/* fill.c - makes fills of the visible fragments, painted or shaded. */
#include "ink/fill/fill.h"

#include "base/poll.h"
#include "ink/fill/merge.h"
#include "ink/shading.h"

static uint32_t grey_of(double brightness) {
  uint32_t level = (uint32_t)(255 * brightness + 0.5);
  return level << 16 | level << 8 | level;
}

/* The fill of a fragment of this face: colour, face and group, but no loops. */
static struct drawing_fill fill_without_loops(const struct sheet *sheet,
                                              const struct scene *scene,
                                              uint32_t face,
                                              const recto_options *options) {
  struct face_shading shading =
      face_shading_of(scene, face, &sheet->camera, options);
  return (struct drawing_fill){.colour = options->ink.fill == RECTO_FILL_SHADE
                                             ? grey_of(shading.brightness)
                                             : shading.colour,
                               .face = face,
                               .group = scene->face_group.item[face]};
}

bool fill_add(struct drawing *drawing, const struct sheet *sheet,
              const struct scene *scene, const struct map *map,
              const recto_options *options) {
  struct drawing_fill *prototype =
      mem_alloc(map->fragment.count, sizeof *prototype);
  if (prototype == NULL)
    return false;
  bool ok = true;
  for (size_t i = 0; ok && i < map->fragment.count; i++) {
    prototype[i] =
        fill_without_loops(sheet, scene, map->fragment.item[i].face, options);
    ok = poll_at(i);
  }
  ok = ok && merge_fills(drawing, sheet, scene, map, prototype, options);
  mem_free(prototype);
  return ok;
}
