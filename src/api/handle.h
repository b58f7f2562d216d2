/* handle.h - the structures behind the opaque handles of recto.h. */
#ifndef API_HANDLE_H
#define API_HANDLE_H

#include "api/preparation.h"
#include "api/verify.h"
#include "drawing/drawing.h"
#include "scene/scene.h"

struct recto_scene {
  struct scene scene;
  unsigned long fault[SCENE_FAULT_COUNT]; /* of everything added so far */
  double read_cpu, read_wall;             /* seconds spent on reading files */
  char *path; /* of the only file that was read; NULL: none or several were */
  bool read_before;             /* a file was read */
  struct preparation *prepared; /* recto_scene_prepare; NULL: not prepared */
};

/* Forgets what was prepared, as the scene changes. */
void scene_forget_preparation(recto_scene *scene);

/* A drawable edge and its parts. */
struct result_edge {
  uint32_t point[2], face[2], group, number;
  recto_edge_class edge_class;
  uint32_t interval, count;
};

struct recto_drawing {
  struct drawing drawing;
  struct report *report; /* owned; NULL where memory ran out */
  double matrix[12];     /* 3 x 4, from scene units to homogeneous page mm */
  double depth[4];       /* 1 x 4, from scene units to the depth */
  char verdict[VERIFY_SUMMARY_SIZE]; /* "": not verified */
  ARRAY(struct result_edge) edge;    /* RECTO_RESULT_EDGES */
  ARRAY(recto_interval) interval;
  ARRAY(recto_fragment) fragment; /* RECTO_RESULT_FACES */
  ARRAY(recto_loop) loop;
  ARRAY(recto_half_edge) half_edge;
  ARRAY(struct file_identity) file; /* that the scene was read from */
};

/* Adds the faults of elements that were added to those of the scene. */
void scene_keep_faults(recto_scene *scene,
                       const struct diagnostics *diagnostics);

/* Sets how points of the scene are projected to the drawing. */
void drawing_keep_projection(recto_drawing *drawing,
                             const struct camera *camera,
                             const struct rescaled *rescaled);

/* The drawing's report as JSON; the report is locked by the caller. */
const char *drawing_json(const recto_drawing *drawing);

/* What the results of a drawing are made from. */
struct result_sources {
  const struct sheet *sheet;
  const struct map *map;
  const struct topology *topology;
  const struct scene *scene;       /* welded */
  const struct scene_point *point; /* of the scene, in the user's units */
  const recto_options *options;    /* scaled as the scene */
  double crease_deg;
  bool with_counts; /* the map has the numbers of faces */
};

/* Stores the edges of the sheet with their visible and hidden parts.
 * Errors  RECTO_ERROR_MEMORY */
USE_RESULT recto_status drawing_keep_edges(recto_drawing *drawing,
                                           const struct result_sources *sources,
                                           recto_error *error);

/* Stores the visible fragments and their half-edges.
 * Errors  RECTO_ERROR_MEMORY */
USE_RESULT recto_status drawing_keep_faces(recto_drawing *drawing,
                                           const struct result_sources *sources,
                                           recto_error *error);

/* Copies the options, or the defaults where they are NULL.
 * Errors  RECTO_ERROR_ARGUMENT: they were not initialised;
 *         RECTO_ERROR_UNSUPPORTED: they are of a later version */
USE_RESULT recto_status options_copy(recto_options *own,
                                     const recto_options *options,
                                     recto_error *error);

/* The same, and checks that each of them is finite and in range, and adapts
 * them to their output. */
USE_RESULT recto_status options_copy_valid(recto_options *own,
                                           const recto_options *options,
                                           recto_error *error);

/* Adapts options to their output's format, if any: sets the unit, and where the
 * format is for plotters replaces defaults: the margin by the one that the
 * plotter needs, the order by RECTO_ORDER_NEAR, and the weights by none.
 * Errors  RECTO_ERROR_UNSUPPORTED: there is no such format */
USE_RESULT recto_status options_adapt(recto_options *options,
                                      recto_error *error);

#endif
