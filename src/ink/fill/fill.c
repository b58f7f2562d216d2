/* fill.c - makes fills of the visible fragments, painted or shaded. */
#include "ink/fill/fill.h"

#include "base/parallel.h"
#include "ink/fill/merge.h"
#include "ink/shading.h"

static uint32_t grey_of(double brightness) {
  uint32_t level = (uint32_t)(255 * brightness + 0.5);
  return level << 16 | level << 8 | level;
}

/* What the threads read, and write. */
struct fill_colours {
  const struct sheet *sheet;
  const struct scene *scene;
  const struct map *map;
  const recto_options *options;
  struct drawing_fill *prototype; /* one a fragment */
};

static uint32_t colour_of_fill(const struct fill_colours *colours,
                               uint32_t face) {
  if (colours->options->ink.fill != RECTO_FILL_SHADE)
    return face_colour_of(colours->scene, face);
  return grey_of(face_shading_of(colours->scene, face, &colours->sheet->camera,
                                 colours->options)
                     .brightness);
}

/* Makes the fills of a range of fragments: colour, face and group, but no
 * loops. */
static bool colour_range(void *user, struct parallel_range range) {
  const struct fill_colours *colours = user;
  for (size_t i = range.begin; i < range.end; i++) {
    uint32_t face = colours->map->fragment.item[i].face;
    colours->prototype[i] =
        (struct drawing_fill){.colour = colour_of_fill(colours, face),
                              .face = face,
                              .group = scene_face_group(colours->scene, face)};
  }
  return true;
}

bool fill_add(struct drawing *drawing, const struct sheet *sheet,
              const struct scene *scene, const struct map *map,
              const recto_options *options) {
  size_t count = map->fragment.count;
  struct fill_colours colours = {
      .sheet = sheet,
      .scene = scene,
      .map = map,
      .options = options,
      .prototype = mem_alloc(count, sizeof *colours.prototype)};
  bool ok = colours.prototype != NULL &&
            parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                            PARALLEL_ITEMS, colour_range, &colours) &&
            merge_fills(drawing, sheet, scene, map, colours.prototype, options);
  mem_free(colours.prototype);
  return ok;
}
