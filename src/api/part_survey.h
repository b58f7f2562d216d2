/* part_survey.h - what the parts of a drawing need of the whole model. */
#ifndef API_PART_SURVEY_H
#define API_PART_SURVEY_H

#include "api/handle.h"
#include "parts/part_scene.h"
#include "parts/side_marks.h"

/* Zero-initialised but for the model, the options, and common.parts it is to be
 * run. */
struct part_survey {
  const recto_scene *model;
  const recto_options *options;
  bool aims;         /* picks faces for the window `index` alone: */
  uint32_t index;    /*   from 0 */
  bool picks_all;    /* else, all faces; else none */
  struct scene read; /* of a model that is not held: its points and groups */
  struct diagnostics diagnostics;
  struct face_pick pick;
  struct camera camera;              /* aimed at the whole scene */
  struct part_window window;         /* of a part, and */
  struct part_scene_request request; /*   what it needs */
  double weld;                       /* the most that welding could join */
  struct side_marks marks;           /* of creases that count in the model */
  struct part_common common;
};

/* Looks at the model.
 * Errors  those of recto_scene_write_part, but for the solver's; end with
 *         part_survey_fini either way */
USE_RESULT recto_status part_survey_run(struct part_survey *survey,
                                        recto_error *error);

/* Makes the windows of all parts; NULL when memory ran out.
 * place  of each point of the model */
struct part_window *part_survey_windows(const struct part_survey *survey,
                                        const struct page_place *place);

/* How far beyond a window, in grid units, something may matter within it:
 * rounding, contact, which moves the ends of intersections, and corners with
 * which welding might join one within it. */
int64_t part_survey_margin(const struct part_survey *survey);

/* Whether all about the faces that a window owns is wanted. */
bool part_survey_owned(const recto_options *options);

/* Frees what is needed no more once the faces were taken. */
void part_survey_drop_model(struct part_survey *survey);
void part_survey_fini(struct part_survey *survey);

#endif
