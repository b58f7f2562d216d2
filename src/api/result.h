/* result.h - what a drawing keeps of its making for the caller. */
#ifndef API_RESULT_H
#define API_RESULT_H

#include "api/handle.h"
#include "visibility/map.h"

/* Sets how points of the scene are projected to the drawing. */
void drawing_store_projection(recto_drawing *drawing,
                              const struct camera *camera,
                              const struct rescaled *rescaled);

/* What the results of a drawing are made from. */
struct result_sources {
  const struct sheet *sheet;
  const struct map *map;
  const struct topology *topology;
  const struct scene *scene; /* welded, and cut */
  int exponent; /* the user's coordinates are the scene's times 2^exponent */
  const recto_options *options; /* scaled as the scene */
  double crease_deg;
  bool with_counts; /* the map has the numbers of faces */
};

/* Stores the edges of the sheet with their visible and hidden parts.
 * Errors  RECTO_ERROR_MEMORY */
USE_RESULT recto_status
drawing_store_edges(recto_drawing *drawing,
                    const struct result_sources *sources, recto_error *error);

/* Stores the visible fragments and their half-edges.
 * Errors  RECTO_ERROR_MEMORY */
USE_RESULT recto_status
drawing_store_faces(recto_drawing *drawing,
                    const struct result_sources *sources, recto_error *error);

#endif
