/* asked.h - a scene and a camera as the judge is to see them. */
#ifndef API_ASKED_H
#define API_ASKED_H

#include "judge/judge.h"
#include "view/camera.h"

/* The scene with its points counted from one of its own, so that a far origin
 * costs the judge's doubles no digits. */
struct asked {
  struct scene scene; /* all but its points are lent */
  struct scene_point origin;
  const struct scene_point *given; /* the points as they were, lent */
};

/* The scene has a face or a polyline.  Returns false when memory ran out. */
USE_RESULT bool asked_init(struct asked *asked, const struct scene *scene);
void asked_fini(struct asked *asked);

struct judge_camera asked_camera(const struct asked *asked,
                                 const struct camera *camera,
                                 const recto_options *options);

/* The judge's own, with contact, crease and classes as the drawing's. */
struct judge_options asked_options(const struct asked *asked,
                                   const struct camera *camera,
                                   const recto_options *options);

#endif
