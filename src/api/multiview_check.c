/* multiview_check.c - checks the options of sheets. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "api/multiview.h"
#include "api/multiview_grid.h"
#include "api/sized.h"
#include "drawing/text.h"

static const char *name_of_view(const recto_sheet_view *view) {
  return view->name != NULL ? view->name : "view";
}

static recto_status refuse_sheet(recto_error *error, const char *words) {
  return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0, "%s", words);
}

static recto_status check_sheet_view(const recto_sheet_view *view,
                                     recto_error *error) {
  if (view->reserved[0] != 0 || view->reserved[1] != 0)
    return sized_reject(error);
  if (view->name != NULL &&
      multiview_find_direction(view->name, NULL, NULL) == NULL)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "there is no view \"%.60s\"", view->name);
  if (!(view->scale >= 0 && view->scale <= DBL_MAX) ||
      (unsigned)view->hidden > RECTO_HIDDEN_LAYER)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "the view %s has a field that is out of range",
                     name_of_view(view));
  if (multiview_grid_has_cell(view->name) && view->scale != 0 &&
      view->scale != 1)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "the view %s is aligned with others and has their scale",
                     view->name);
  return RECTO_OK;
}

static recto_status check_details(const recto_sheet_options *sheet,
                                  recto_error *error) {
  if (sheet->detail_count > RECTO_DETAIL_MAX)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "%zu details are on the sheet, and %d are the most",
                     sheet->detail_count, RECTO_DETAIL_MAX);
  for (size_t i = 0; i < sheet->detail_count; i++) {
    const recto_detail *detail = &sheet->detail[i];
    if (detail->reserved[0] != 0 || detail->reserved[1] != 0)
      return sized_reject(error);
    if (!(fabs(detail->x_mm) <= DBL_MAX && fabs(detail->y_mm) <= DBL_MAX &&
          detail->radius_mm >= RECTO_FINEST_MM &&
          detail->radius_mm <= DBL_MAX && detail->scale > 0 &&
          detail->scale <= DBL_MAX))
      return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                       "the detail %c has a field that is out of range",
                       (char)('A' + (int)i));
  }
  return RECTO_OK;
}

static recto_status check_sheet_views(const recto_sheet_options *sheet,
                                      recto_error *error) {
  recto_status status = RECTO_OK;
  for (size_t i = 0; i < sheet->view_count && status == RECTO_OK; i++) {
    status = check_sheet_view(&sheet->view[i], error);
    for (size_t k = 0; k < i && status == RECTO_OK; k++)
      if (strcmp(name_of_view(&sheet->view[k]),
                 name_of_view(&sheet->view[i])) == 0)
        status = error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                           "the view %s is on the sheet twice",
                           name_of_view(&sheet->view[i]));
  }
  return status;
}

recto_status multiview_check(const recto_options *options, recto_error *error) {
  const recto_sheet_options *sheet = &options->sheet;
  const recto_camera_options *camera = &options->camera;
  for (size_t i = 0; i < sizeof sheet->reserved / sizeof sheet->reserved[0];
       i++)
    if (sheet->reserved[i] != 0)
      return sized_reject(error);
  if ((unsigned)sheet->arrangement > RECTO_ARRANGEMENT_THIRD)
    return refuse_sheet(error, "the arrangement of views is out of range");
  if (!multiview_is_requested(options))
    return sheet->view_count == 0 && sheet->detail_count == 0
               ? RECTO_OK
               : refuse_sheet(error, "the views of a sheet are to be arranged "
                                     "in first- or third-angle projection");
  if ((sheet->view_count > 0 && sheet->view == NULL) ||
      (sheet->detail_count > 0 && sheet->detail == NULL))
    return error_null(error, "a list of the options");
  if (camera->kind == RECTO_CAMERA_EYE || camera->fov_deg > 0)
    return refuse_sheet(error, "the views of a sheet are parallel projections, "
                               "without an eye or a field of view");
  if (camera->fit != RECTO_FIT_PAGE && camera->fit != RECTO_FIT_SCALE &&
      camera->fit != RECTO_FIT_PREFERRED)
    return refuse_sheet(error, "the views of a sheet fit its page, or have a "
                               "true scale");
  if (options->results != 0)
    return refuse_sheet(error, "edges and faces are results of one view, not "
                               "of a sheet");
  recto_status status = check_sheet_views(sheet, error);
  if (status == RECTO_OK)
    status = check_details(sheet, error);
  return status == RECTO_OK && multiview_has_title(options)
             ? text_check(options->output.title, "the title", error)
             : status;
}
