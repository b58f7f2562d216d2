/* part_sources.h - what a part is taken from, once its scene is solved. */
#ifndef PARTS_PART_SOURCES_H
#define PARTS_PART_SOURCES_H

#include "parts/part_scene.h"

struct part_sources {
  const struct part_scene *scene;
  const struct topology *topology; /* of it */
  const struct sheet *sheet;
  const struct map *map;  /* with side lines, if it has fragments */
  const float *tone;      /* of each corner of the scene; NULL: it has none */
  const uint8_t *uniform; /* likewise, one a face */
};

#endif
