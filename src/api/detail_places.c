/* detail_places.c - finds places for the details of a sheet. */
#include "api/detail_places.h"

#include <math.h>

#include "api/multiview_grid.h"
#include "api/multiview_labels.h"

/* What is left free on each side of the circle about what a detail shows, for
 * its letter, in that one's height. */
#define MARK_CLEAR 1.5

/* ---- Boxes --------------------------------------------------------------- */

/* A rectangle of the page. */
struct page_box {
  double low[2], high[2];
};

static bool boxes_overlap(const struct page_box *a, const struct page_box *b) {
  return a->low[0] < b->high[0] && b->low[0] < a->high[0] &&
         a->low[1] < b->high[1] && b->low[1] < a->high[1];
}

/* The larger circle of a detail at this place, with the label below it. */
static struct page_box box_of_detail(const struct multiview *views,
                                     const struct multiview_detail *detail,
                                     double x, double y) {
  double radius = detail->radius_mm, half = fmax(radius, detail->label_mm / 2);
  return (struct page_box){
      {x - half, y - radius - MULTIVIEW_NAME_BAND * views->letter_mm},
      {x + half, y + radius}};
}

/* The circle about what a detail shows, with room for the letter beside it. */
static struct page_box box_of_mark(const struct multiview *views,
                                   const recto_detail *request) {
  double half = request->radius_mm + MARK_CLEAR * views->letter_mm;
  return (struct page_box){{request->x_mm - half, request->y_mm - half},
                           {request->x_mm + half, request->y_mm + half}};
}

/* A view with its name. */
static struct page_box box_of_view(const struct multiview *views, size_t i) {
  const struct multiview_view *view = &views->view[i];
  double name = MULTIVIEW_NAME_BAND * views->name_mm;
  double middle = (view->low_mm[0] + view->high_mm[0]) / 2;
  double half = view->label_mm / 2;
  return (struct page_box){
      {fmin(view->low_mm[0], middle - half), view->low_mm[1] - name},
      {fmax(view->high_mm[0], middle + half), view->high_mm[1]}};
}

/* Whether a detail at this place lies on the page, beside all views, all marks
 * and the details before it. */
static bool has_room(const struct multiview *views, size_t detail, double x,
                     double y) {
  const struct page_box own =
      box_of_detail(views, &views->detail[detail], x, y);
  double foot = views->margin_mm + MULTIVIEW_TITLE_BAND * views->title_mm;
  if (own.low[0] < views->margin_mm || own.low[1] < foot ||
      own.high[0] > views->page_mm[0] - views->margin_mm ||
      own.high[1] > views->page_mm[1] - views->margin_mm)
    return false;
  double clear = views->letter_mm;
  const struct page_box wide = {{own.low[0] - clear, own.low[1] - clear},
                                {own.high[0] + clear, own.high[1] + clear}};
  for (size_t i = 0; i < views->count; i++) {
    const struct page_box other = box_of_view(views, i);
    if (boxes_overlap(&wide, &other))
      return false;
  }
  for (size_t i = 0; i < views->details; i++) {
    const struct multiview_detail *other = &views->detail[i];
    const struct page_box mark = box_of_mark(views, other->request);
    const struct page_box large =
        box_of_detail(views, other, other->centre_mm[0], other->centre_mm[1]);
    if (boxes_overlap(&wide, &mark) ||
        (i < detail && boxes_overlap(&wide, &large)))
      return false;
  }
  return true;
}

/* Finds the nearest place that has room, of a lattice on the page. */
static bool find_room(struct multiview *views, size_t index) {
  enum { STEPS = 200, STEPS_MAX = 2000 }; /* of the shorter, the longer side */
  struct multiview_detail *detail = &views->detail[index];
  double step = fmax(fmin(views->page_mm[0], views->page_mm[1]) / STEPS,
                     fmax(views->page_mm[0], views->page_mm[1]) / STEPS_MAX);
  double nearest = INFINITY;
  for (double y = 0; y <= views->page_mm[1]; y += step)
    for (double x = 0; x <= views->page_mm[0]; x += step) {
      double far = hypot(x - detail->request->x_mm, y - detail->request->y_mm);
      if (far >= nearest || !has_room(views, index, x, y))
        continue;
      nearest = far;
      detail->centre_mm[0] = x;
      detail->centre_mm[1] = y;
    }
  return nearest < INFINITY;
}

/* The view whose box the circle meets; `count`: none. */
static size_t find_view_of_detail(const struct multiview *views,
                                  const recto_detail *detail) {
  double x = detail->x_mm, y = detail->y_mm, r = detail->radius_mm;
  size_t found = views->count;
  double least = r;
  for (size_t i = 0; i < views->count; i++) {
    const struct multiview_view *view = &views->view[i];
    double dx = fmax(fmax(view->low_mm[0] - x, x - view->high_mm[0]), 0);
    double dy = fmax(fmax(view->low_mm[1] - y, y - view->high_mm[1]), 0);
    if (hypot(dx, dy) < least) {
      least = hypot(dx, dy);
      found = i;
    }
  }
  return found;
}

static recto_status place_detail(struct multiview *views, size_t index,
                                 recto_error *error) {
  struct multiview_detail *detail = &views->detail[index];
  const recto_detail *request = detail->request;
  const char *letter = multiview_labels_letter(detail);
  bool on_page = true;
  const double at[2] = {request->x_mm, request->y_mm};
  for (int axis = 0; axis < 2; axis++)
    on_page = on_page && at[axis] - request->radius_mm >= 0 &&
              at[axis] + request->radius_mm <= views->page_mm[axis];
  if (!on_page)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "the detail %s, of %.4g mm about %.6g,%.6g, is not on the "
                     "page of %.4g x %.4g mm",
                     letter, request->radius_mm, request->x_mm, request->y_mm,
                     views->page_mm[0], views->page_mm[1]);
  detail->view = find_view_of_detail(views, request);
  if (detail->view == views->count)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "the detail %s, of %.4g mm about %.6g,%.6g, shows nothing "
                     "of any view",
                     letter, request->radius_mm, request->x_mm, request->y_mm);
  detail->radius_mm = request->radius_mm * request->scale;
  detail->scale = multiview_grid_limit_scale(views->view[detail->view].scale *
                                             request->scale);
  multiview_labels_of_detail(views, detail);
  if (!find_room(views, index))
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "the detail %s, of %.4g mm, has no room beside the views: "
                     "a larger page or a smaller scale of the views makes some",
                     letter, detail->radius_mm);
  return RECTO_OK;
}

recto_status detail_places_find(struct multiview *views,
                                const recto_options *options,
                                recto_error *error) {
  static const char *const name[RECTO_DETAIL_MAX] = {
      "detail-A", "detail-B", "detail-C", "detail-D",
      "detail-E", "detail-F", "detail-G", "detail-H"};
  recto_status status = RECTO_OK;
  views->details = options->sheet.detail_count;
  for (size_t i = 0; i < views->details; i++) {
    views->detail[i].request = &options->sheet.detail[i];
    views->detail[i].name = name[i];
  }
  for (size_t i = 0; i < views->details && status == RECTO_OK; i++)
    status = place_detail(views, i, error);
  return status;
}
