/* turns.h - a scene seen again by a camera that moved a little: how much the
 * lengths of its edges and the areas of its faces change, and how much of that
 * is owed to edges and faces whose topology changed. */
#ifndef TESTS_MEASURE_TURNS_H
#define TESTS_MEASURE_TURNS_H

#include "tests/measure/trial.h"
#include "tests/scenes/random.h"
#include "tests/scenes/scenes.h"

/* What is done to the camera: turned about its eye, shifted with its target,
 * its field of view scaled. */
enum turn_kind { TURN_ANGLE, TURN_SHIFT, TURN_SCALE, TURN_KINDS };

enum { TURN_SCENES = 8 };

/* The eight scenes: their names, and the functions that fill them. */
extern const struct scenes_entry turn_scenes[TURN_SCENES];

/* Fills a scene and sets a camera in perspective, the scene's own where it has
 * one, on a page of 100 mm, to which it does not adapt. */
void turn_scene(struct scene *scene, recto_options *options, int index);

/* A copy of the options with the camera moved at random: by an angle in
 * radians, or as a share of the distance to the target, or of the view. */
void turn_camera(recto_options *moved, const recto_options *options,
                 enum turn_kind kind, double by, struct random *random);

struct turn_change {
  double length, area; /* sums of changes, as shares of all there was */
  /* Those of edges and faces whose topology is as it was: as many visible
   * intervals with the same ends of the edge; as many fragments, loops and
   * corners, along the same edges. */
  double same_length, same_area;
  unsigned edges, faces; /* of which it is not */
  char named[2048]; /* each, and what became of it, as far as there is room */
};

/* Compares two maps of one scene, solved with edges and fragments.  False when
 * memory ran out. */
USE_RESULT bool turn_compare(struct turn_change *change,
                             const struct trial *before,
                             const struct trial *after);

#endif
