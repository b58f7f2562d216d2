/* verify.h - asks the judge about a drawing that was just made. */
#ifndef API_VERIFY_H
#define API_VERIFY_H

#include "drawing/drawing.h"
#include "judge/judge.h"
#include "view/camera.h"
#include "visibility/map.h"

/* A drawing and what it was made of. */
struct verify {
  const struct scene *scene;
  int exponent; /* the user's coordinates are the scene's times 2^exponent */
  const struct camera *camera;
  const struct sheet *sheet; /* for the lines that are too short to draw, */
  const struct map *map;     /* and the step of its depths */
  const struct drawing *drawing;
  const recto_options *options;
  bool (*progress)(void *user, double share); /* NULL: nobody is asked */
  void *user;
};

enum { VERIFY_SUMMARY_SIZE = 160 };

/* Asks about options->verify points of the drawn lines, which must be visible,
 * and as many of the edges asked for, which where they have no line must be
 * hidden.  Points too close to call are counted and pass.
 * summary  one sentence, where all is well
 * Errors   RECTO_ERROR_VERIFY: the drawing is wrong, and where;
 *          RECTO_ERROR_MEMORY; RECTO_ERROR_CANCELLED. */
USE_RESULT recto_status verify_drawing(const struct verify *verify,
                                       struct report *report,
                                       char summary[VERIFY_SUMMARY_SIZE],
                                       recto_error *error);

#endif
