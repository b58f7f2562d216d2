/* conversion.h - brings a model to the unit and the up axis of the scene.
 *
 * The first model of a scene says what is up in it.  The scene's unit is that
 * of the first model where it states one, else the millimetre, as soon as one
 * of them states a unit; a model that states none is in millimetres then.
 * While none does the coordinates stay as they are. */
#ifndef SCENE_READERS_CONVERSION_H
#define SCENE_READERS_CONVERSION_H

#include "scene/diagnostics.h"
#include "scene/scene.h"

/* What is known of a model's coordinates. */
struct model_coordinates {
  const char *path;  /* for messages */
  double up[3];      /* +Y or +Z */
  bool up_is_stated; /* by the model or its format; else it is likely */
  double unit_mm;    /* 0: it states none */
};

/* Scales and turns the points that were added since `before`, those of a model,
 * as scene->keeps_unit and scene->keeps_up allow, and warns of what the model
 * does not state.
 * Errors  RECTO_ERROR_LIMIT: a coordinate is too large in the scene's unit;
 *         RECTO_ERROR_MEMORY */
USE_RESULT recto_status conversion_apply(struct scene *scene,
                                         const struct scene_snapshot *before,
                                         const struct model_coordinates *model,
                                         struct diagnostics *diagnostics,
                                         recto_error *error);

#endif
