/* multiview.c - arranges the views of a sheet on its page. */
#include "api/multiview.h"

#include <math.h>
#include <string.h>

#include "api/contour_fit.h"
#include "api/detail_places.h"
#include "api/multiview_grid.h"
#include "drawing/text.h"

/* ---- The views that are requested ---------------------------------------- */

static const recto_sheet_view usual_first[] = {
    {.name = "front"}, {.name = "top"}, {.name = "left"}};
static const recto_sheet_view usual_third[] = {
    {.name = "front"}, {.name = "top"}, {.name = "right"}};

static const recto_sheet_view *
find_requested_views(const recto_options *options, size_t *count) {
  const recto_sheet_options *sheet = &options->sheet;
  *count = sheet->view_count > 0 ? sheet->view_count : 3;
  return sheet->view_count > 0                           ? sheet->view
         : sheet->arrangement == RECTO_ARRANGEMENT_THIRD ? usual_third
                                                         : usual_first;
}

const char *multiview_find_direction(const char *name, double *azimuth_deg,
                                     double *elevation_deg) {
  const char *known;
  for (size_t i = 0;
       (known = recto_view_name(i, azimuth_deg, elevation_deg)) != NULL; i++)
    if (strcmp(known, name) == 0)
      return known;
  return NULL;
}

/* ---- The whole ----------------------------------------------------------- */

/* The name of the direction in which the camera looks; NULL: it has none. */
static const char *find_camera_direction(const recto_camera_options *camera) {
  const char *known;
  double azimuth_deg, elevation_deg;
  for (size_t i = 0;
       (known = recto_view_name(i, &azimuth_deg, &elevation_deg)) != NULL; i++)
    if (azimuth_deg == camera->azimuth_deg &&
        elevation_deg == camera->elevation_deg)
      return known;
  return NULL;
}

/* A view without a name is "view", or where it is alone by its direction. */
static void collect_views(struct multiview *views,
                          const recto_options *options) {
  const recto_sheet_view *request =
      find_requested_views(options, &views->count);
  const char *direction =
      views->count == 1 ? find_camera_direction(&options->camera) : NULL;
  for (size_t i = 0; i < views->count; i++) {
    struct multiview_view *view = &views->view[i];
    view->request = &request[i];
    view->azimuth_deg = options->camera.azimuth_deg;
    view->elevation_deg = options->camera.elevation_deg;
    view->name =
        request[i].name != NULL
            ? multiview_find_direction(request[i].name, &view->azimuth_deg,
                                       &view->elevation_deg)
            : (direction != NULL ? direction : "view");
  }
}

static void turn_camera(recto_options *options,
                        const struct multiview_view *view) {
  options->camera.azimuth_deg = view->azimuth_deg;
  options->camera.elevation_deg = view->elevation_deg;
  options->camera.has_target = false;
}

/* Heights of letters that [ISO3098] has, to 20 mm: the largest that is not
 * above a share of the page's shorter side, or one of the next lower. */
static double choose_text_height(const double page_mm[2], int lower) {
  static const double height[] = {1.8, 2.5, 3.5, 5, 7, 10, 14, 20};
  int i = sizeof height / sizeof height[0] - 1;
  while (i > 0 && height[i] > fmin(page_mm[0], page_mm[1]) / 40)
    i--;
  return height[i > lower ? i - lower : 0];
}

static recto_status check_title_width(const struct multiview *views,
                                      recto_error *error) {
  double room_mm = views->page_mm[0] - 2 * views->margin_mm;
  if (views->title == NULL)
    return RECTO_OK;
  const struct text_line line = {views->title, views->title_mm};
  double width_mm = text_width_mm(&line);
  return width_mm <= room_mm
             ? RECTO_OK
             : error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                         "the title is %.4g mm wide, and the page has %.4g mm "
                         "inside its margins",
                         width_mm, room_mm);
}

/* Chooses the heights of all text. */
static void choose_text(struct multiview *views, const recto_options *options) {
  if (multiview_has_title(options)) {
    views->title = options->output.title;
    views->title_mm = choose_text_height(views->page_mm, 0);
  }
  views->letter_mm = choose_text_height(views->page_mm, 1);
  if (options->sheet.names)
    views->name_mm = views->letter_mm;
}

recto_status multiview_arrange(struct multiview *views,
                               const struct preparation *prepared,
                               const recto_options *options, double unit_mm,
                               recto_error *error) {
  recto_options scaled = *options;
  struct camera camera;
  *views = (struct multiview){
      .unit_mm = unit_mm, .with_scales = options->camera.fit != RECTO_FIT_PAGE};
  collect_views(views, options);
  recto_status status = rescale_options(&prepared->rescaled, &scaled, error);
  for (size_t i = 0; i < views->count && status == RECTO_OK; i++) {
    struct multiview_view *view = &views->view[i];
    turn_camera(&scaled, view);
    status = contour_fit_extent(&view->box, &camera, prepared, &scaled, error);
  }
  if (status != RECTO_OK)
    return status;
  memcpy(views->page_mm, camera.page_mm, sizeof views->page_mm);
  views->margin_mm = camera.margin_mm;
  choose_text(views, options);
  status = multiview_grid_arrange(views, &scaled, camera.size,
                                  prepared->rescaled.exponent, error);
  if (status == RECTO_OK)
    status = check_title_width(views, error);
  return status == RECTO_OK ? detail_places_find(views, options, error)
                            : status;
}

const char *multiview_name(const struct multiview *views, size_t index) {
  return index < views->count ? views->view[index].name
                              : views->detail[index - views->count].name;
}

void multiview_options(const struct multiview *views, size_t index,
                       const recto_options *options, recto_options *of_view,
                       double shift_mm[2]) {
  const struct multiview_detail *detail =
      index < views->count ? NULL : &views->detail[index - views->count];
  const struct multiview_view *view =
      &views->view[detail != NULL ? detail->view : index];
  *of_view = *options;
  of_view->sheet = (recto_sheet_options){.arrangement = 0};
  turn_camera(of_view, view);
  of_view->camera.fit = RECTO_FIT_SCALE;
  of_view->camera.scale = detail != NULL ? detail->scale : view->scale;
  of_view->page.width_mm = views->page_mm[0];
  of_view->page.height_mm = views->page_mm[1];
  of_view->page.margin_mm = views->margin_mm;
  of_view->page.may_turn = false;
  if (view->request->has_hidden)
    of_view->ink.hidden = view->request->hidden;
  for (int axis = 0; axis < 2; axis++) {
    double at = view->centre_mm[axis];
    if (detail != NULL) {
      double shown = axis == 0 ? detail->request->x_mm : detail->request->y_mm;
      at = detail->centre_mm[axis] + (at - shown) * detail->request->scale;
    }
    shift_mm[axis] = at - views->page_mm[axis] / 2;
  }
}
