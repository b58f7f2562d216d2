/* render_multiview.h - draws several views of a scene on one page. */
#ifndef API_RENDER_MULTIVIEW_H
#define API_RENDER_MULTIVIEW_H

#include "api/handle.h"

/* Draws the views of a sheet, from one preparation.
 * options  valid, their scale settled
 * Errors   as of recto_scene_render; *drawing is NULL then */
USE_RESULT recto_status render_multiview(recto_drawing **drawing,
                                         const recto_scene *scene,
                                         const recto_options *options,
                                         recto_error *error);

#endif
