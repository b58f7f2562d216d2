/* verify.h - has the judge check a drawing that was just made. */
#ifndef API_VERIFY_H
#define API_VERIFY_H

#include "api/preparation.h"
#include "base/report.h"
#include "drawing/drawing.h"
#include "view/camera.h"
#include "visibility/map.h"

/* A drawing and what it was made from. */
struct verify {
  const struct scene *scene;
  int exponent; /* the user's coordinates are the scene's times 2^exponent */
  const struct camera *camera;
  const struct sheet *sheet; /* these two: to find the lines that were too short
                                to draw */
  const struct map *map;
  const struct drawing *drawing;
  const recto_options *options;
  const struct preparation *prepared; /* of a scene that was cut; else NULL */
};

enum { VERIFY_SUMMARY_SIZE = 160 };

/* Numbers of points: drawn and visible, not drawn and hidden, undecided. */
struct verify_counts {
  size_t visible, hidden, undecided;
};

/* Checks options->verify samples of the drawn lines, which must be visible, and
 * as many of the requested edges, which must be hidden where there is no line.
 * Undecided samples are counted and pass.
 * counts  set where nothing is wrong
 * Errors   RECTO_ERROR_VERIFY: the drawing is wrong; the text says where;
 *          RECTO_ERROR_MEMORY; RECTO_ERROR_CANCELLED. */
USE_RESULT recto_status verify_drawing(const struct verify *verify,
                                       struct report *report,
                                       struct verify_counts *counts,
                                       recto_error *error);

/* Writes the sentence of recto_drawing_verdict. */
void verify_summarise(char summary[VERIFY_SUMMARY_SIZE],
                      const struct verify_counts *counts);

#endif
