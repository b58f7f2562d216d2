/* model.h - the models of the bench, and one run of a program over them. */
#ifndef BENCH_MODEL_H
#define BENCH_MODEL_H

#include <limits.h>

#include "bench/table.h"
#include "scene/scene.h"

struct model {
  const char *name;
  char path[PATH_MAX];
  double triangles, bytes;
  double eye[3], middle[3];
};

/* Reads FOLDER/NAME.obj to learn its size, into a new scene; false where it
 * is not there. */
bool model_open(struct model *model, struct scene *scene, const char *folder,
                const char *name);

/* Makes the model four times as fine, by Loop's rule, and writes it into the
 * folder; false where it cannot be written. */
bool model_refine(struct model *model, struct scene *scene, const char *folder,
                  const char *name);

/* The stages of a run, in their order: names for a table. */
enum { MODEL_STAGES = 7 };
extern const char *const model_stage_name[MODEL_STAGES];

/* What is drawn unless all edges are. */
extern const char model_features[];

struct model_job {
  const char *recto;  /* the program */
  const char *folder; /* for what it writes */
  const char *method, *edges, *threads;
  unsigned limit_s;
};

/* Draws the model once.
 * stage  CPU seconds of each stage */
void model_draw(struct run *run, double stage[MODEL_STAGES],
                const struct model *model, const struct model_job *job);

/* Fills a depth buffer with it once. */
void model_raster(struct run *run, const struct model *model,
                  const char *zraster, unsigned limit_s);

#endif
