/* raster.h - a plain depth buffer, to compare visible fragments with. */
#ifndef TESTS_JUDGE_RASTER_H
#define TESTS_JUDGE_RASTER_H

#include "judge/judge.h"

/* n x n pixels over a square page, the first row at the bottom; each holds
 * the face seen at its middle, SCENE_NONE where there is none. */
struct judge_raster {
  uint32_t *face;
  unsigned n;
  double page_mm;
};

void judge_raster_init(struct judge_raster *raster, unsigned n, double page_mm);
void judge_raster_fini(struct judge_raster *raster);

/* Draws all faces of the scene, the nearest at each pixel by doubles; where
 * depths are equal, the earlier face. */
void judge_raster_scene(struct judge_raster *raster, const struct scene *scene,
                        const struct judge_camera *camera);

/* Fills a region of loops, even-odd, with a face. */
void judge_raster_region(struct judge_raster *raster,
                         const struct judge_point2 *page_point,
                         const uint32_t *count, uint32_t loops, uint32_t face);

/* How many pixels differ whose eight neighbours in `b` are all of one face:
 * those near an outline may fall to either side. */
size_t judge_raster_differ(const struct judge_raster *a,
                           const struct judge_raster *b);

#endif
