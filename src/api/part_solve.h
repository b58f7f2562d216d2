/* part_solve.h - a part of a drawing, once its faces are known. */
#ifndef API_PART_SOLVE_H
#define API_PART_SOLVE_H

#include "api/part_tones.h"
#include "parts/part.h"
#include "scene/topology/topology.h"

/* Zero-initialised is empty. */
struct part_solve {
  const recto_options *options;
  double weld;      /* the most that welding could join */
  struct part part; /* what all have in common, and the window, are set */
  struct part_scene scene; /* the faces and polylines of the window */
  struct part_tones tones;
  struct topology topology;
  struct sheet sheet;
  struct map map;
};

/* Solves the scene, if there is anything in it, and collects the part.
 * Errors  those of recto_scene_write_part */
USE_RESULT recto_status part_solve_run(struct part_solve *work,
                                       recto_error *error);

/* Writes the part, unless that would replace one of so many files, which it
 * was made of.
 * what    these are, for messages
 * Errors  RECTO_ERROR_ARGUMENT, RECTO_ERROR_IO, RECTO_ERROR_MEMORY */
USE_RESULT recto_status part_solve_save(struct part_solve *work,
                                        const char *path,
                                        const struct file_identity *file,
                                        size_t files, const char *what,
                                        recto_error *error);

/* Whether a file is the whole part of this number, from 0, of any drawing,
 * whose id is then *id. */
bool part_solve_find(const char *path, uint32_t index, uint64_t *id);

void part_solve_fini(struct part_solve *work);

#endif
