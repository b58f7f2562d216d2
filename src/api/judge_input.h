/* judge_input.h - converts a scene, a camera and options for the judge. */
#ifndef API_JUDGE_INPUT_H
#define API_JUDGE_INPUT_H

#include "api/preparation.h"
#include "judge/judge.h"
#include "view/camera.h"

/* The scene, translated so that one of its points is the origin: the judge's
 * doubles then lose no digits where the scene is far from its origin. */
struct judge_input {
  struct scene scene; /* all but its points is borrowed, not owned */
  struct scene_point origin;
  const struct scene_point *given; /* the original points, borrowed */
  struct judge_removed removed;    /* by judge_input_cut */
};

/* The scene has a face or a polyline.  Returns false when memory ran out. */
USE_RESULT bool judge_input_init(struct judge_input *input,
                                 const struct scene *scene);
void judge_input_fini(struct judge_input *input);

/* States what is cut off the scene, which is that before the cut. */
void judge_input_cut(struct judge_input *input,
                     const struct preparation *prepared);

struct judge_camera judge_input_camera(const struct judge_input *input,
                                       const struct camera *camera,
                                       const recto_options *options);

/* The judge's defaults, with the drawing's contact, crease angle and classes.
 */
struct judge_options judge_input_options(const struct judge_input *input,
                                         const struct camera *camera,
                                         const recto_options *options);

/* Leaves it open whether edges are creases at whose angles the marks of files
 * may decide. */
void judge_input_allow_marks(struct judge_options *made,
                             const recto_options *options);

#endif
