/* render.h - draws a view of a scene. */
#ifndef API_RENDER_H
#define API_RENDER_H

#include "api/handle.h"

struct render_request {
  const recto_scene *scene;
  const recto_options *options;       /* valid, their scale settled; no sheet */
  const struct preparation *prepared; /* taken where it serves; NULL: none */
  double shift_mm[2]; /* of the drawing from where the options place it */
  bool may_be_empty;  /* there is no warning of that */
  bool others_hide;   /* other views have hidden lines, for which pens are */
};

/* Draws a view.
 * Errors  as of recto_scene_render; *drawing is NULL then */
USE_RESULT recto_status render_view(recto_drawing **drawing,
                                    const struct render_request *request,
                                    recto_error *error);

#endif
