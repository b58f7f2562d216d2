/* preparation.h - what of a scene does not depend on the camera: its points in
 * a range that is safe to compute with, its welded faces, their edges, and the
 * classes that these have in every view. */
#ifndef API_PREPARATION_H
#define API_PREPARATION_H

#include "cut/cut.h"
#include "scene/weld/weld_near.h"
#include "view/extent.h"
#include "view/rescale.h"

/* Zero-initialised is empty. */
struct preparation {
  struct rescaled rescaled;
  struct welded welded;
  bool is_suspicious;        /* of a scene that is cut: welded_is_suspicious */
  size_t edges;              /* before it was cut */
  struct cut cut;            /* empty where no plane cuts */
  const struct scene *scene; /* what is drawn: one of the two */
  struct topology topology;  /* of that scene */
  bool is_all_used;          /* all points of it, which are the user's */
  bool has_section; /* its only plane is that of a section of one view */
  double target[3]; /* then: what that view looks at, in rescaled units */
  /* The options that it depends on. */
  recto_plane plane[RECTO_CUT_MAX];
  size_t planes;
  double weld;
  int coordinate_bits;
  recto_crease_marks crease_marks;
  bool keeps_doubled; /* faces that are listed twice, as of weld_request */
  double crease_deg;  /* where marks of creases depend on it */
};

/* What a scene is prepared for. */
enum preparation_use {
  PREPARATION_FOR_LINES, /* of one view, which needs no sides of faces, unless
                            marks, cuts or clipping do */
  PREPARATION_FOR_VIEW,
  PREPARATION_FOR_VIEWS /* several: the classes of edges are kept too */
};

/* Prepares a scene, which is to live as long and not to change.
 * Errors   RECTO_ERROR_MEMORY; preparation_fini it in any case */
USE_RESULT recto_status preparation_init(struct preparation *preparation,
                                         const struct scene *scene,
                                         const recto_options *options,
                                         enum preparation_use use,
                                         recto_error *error);
/* The planes of the options' cut, in the units of the prepared scene. */
void preparation_planes(const struct preparation *preparation,
                        struct cut_plane plane[RECTO_CUT_MAX]);
void preparation_fini(struct preparation *preparation);

/* Sets lengths and points of a view's options in the units of the prepared
 * scene; of a section, which is cut, the point that the view looks at is left.
 * Errors  RECTO_ERROR_ARGUMENT, as of rescale_options */
USE_RESULT recto_status
preparation_rescale(const struct preparation *preparation,
                    recto_options *options, recto_error *error);

/* Aims the camera at a prepared scene.
 * used    one a point, as of used.h; NULL: not known
 * beyond  where else there are lines, as of known_points; NULL: nowhere
 * Errors  as of camera_aim; RECTO_ERROR_LIMIT also where a cut leaves less than
 *         its precision */
USE_RESULT recto_status preparation_aim(struct camera *camera,
                                        const struct preparation *preparation,
                                        const uint8_t *used,
                                        const struct extent *beyond,
                                        const recto_options *options,
                                        recto_error *error);

/* Whether a preparation serves for these options. */
bool preparation_is_valid_for(const struct preparation *preparation,
                              const recto_options *options);

#endif
