/* judge_input.h - a scene and a camera as the judge is to see them. */
#ifndef API_JUDGE_INPUT_H
#define API_JUDGE_INPUT_H

#include "judge/judge.h"
#include "view/camera.h"

/* The scene with its points counted from one of its own, so that a far origin
 * costs the judge's doubles no digits. */
struct judge_input {
  struct scene scene; /* all but its points are lent */
  struct scene_point origin;
  const struct scene_point *given; /* the points as they were, lent */
};

/* The scene has a face or a polyline.  Returns false when memory ran out. */
USE_RESULT bool judge_input_init(struct judge_input *input,
                                 const struct scene *scene);
void judge_input_fini(struct judge_input *input);

struct judge_camera judge_input_camera(const struct judge_input *input,
                                       const struct camera *camera,
                                       const recto_options *options);

/* The judge's own, with contact, crease and classes as the drawing's. */
struct judge_options judge_input_options(const struct judge_input *input,
                                         const struct camera *camera,
                                         const recto_options *options);

#endif
