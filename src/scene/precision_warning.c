/* precision_warning.c - looks at every n-th point of a file. */
#include "scene/precision_warning.h"

#include <math.h>

#define COARSE_SHARE (1 / 1000.0)
enum { WARNING_SAMPLES = 1000 };

/* What the coordinates of a file are like. */
struct coordinate_survey {
  double low[3], high[3];
  double rounding; /* of the numbers that are rounded most, scene units */
  bool single;     /* all fit in single precision */
  bool fractions;  /* one is no integer */
};

static void survey_point(struct coordinate_survey *survey,
                         const struct scene_point *point, double relative) {
  const double at[3] = {point->x, point->y, point->z};
  for (int k = 0; k < 3; k++) {
    survey->low[k] = fmin(survey->low[k], at[k]);
    survey->high[k] = fmax(survey->high[k], at[k]);
    survey->rounding = fmax(survey->rounding, relative * fabs(at[k]));
    survey->single = survey->single && (double)(float)at[k] == at[k];
    survey->fractions = survey->fractions || at[k] != floor(at[k]);
  }
}

/* Surveys the points from `first` on; those of no stated precision are rounded
 * to a share of themselves. */
static struct coordinate_survey survey_points(const struct scene *scene,
                                              size_t first, double share) {
  struct coordinate_survey survey = {.low = {INFINITY, INFINITY, INFINITY},
                                     .high = {-INFINITY, -INFINITY, -INFINITY},
                                     .single = true};
  const struct precision unstated = {0, share};
  size_t step = (scene->point.count - first) / WARNING_SAMPLES + 1;
  for (size_t i = first; i < scene->point.count; i += step)
    survey_point(&survey, &scene->point.item[i],
                 scene_point_precision(scene, (uint32_t)i, unstated).relative);
  return survey;
}

void precision_warn(const struct scene *scene, size_t first, const char *path,
                    const struct diagnostics *diagnostics) {
  struct coordinate_survey survey =
      survey_points(scene, first, PRECISION_SINGLE);
  if (!survey.single || !survey.fractions)
    survey = survey_points(scene, first, 0);
  double size = 0;
  for (int k = 0; k < 3; k++)
    size = fmax(size, survey.high[k] - survey.low[k]);
  if (size > 0 && survey.rounding > COARSE_SHARE * size)
    diagnostics_warn(diagnostics, path,
                     "the model is %.3g in size and so far from the origin "
                     "that its numbers are rounded by up to %.2g: nearer to "
                     "the origin, or with more digits, it keeps its shape",
                     size, survey.rounding);
}
