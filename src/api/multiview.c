/* multiview.c - arranges the views of a sheet on its page. */
#include "api/multiview.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "api/sized.h"
#include "base/tolerance.h"
#include "drawing/text.h"
#include "view/camera_extent.h"
#include "view/preferred_scale.h"

/* The least distance between views, as a share of the shorter side of the page
 * inside its margins. */
#define SHARE_OF_GAP (1.0 / 12)

/* What text takes of the page above or below it, in its own height. */
#define TITLE_BAND 2.5
#define NAME_BAND 2.5

/* ---- The views that are requested ---------------------------------------- */

/* The cells of aligned views in third-angle projection.  In first-angle
 * projection what is beside the front view is on its other side; the view from
 * the back is the last of the row in both. */
static const struct {
  const char *name;
  int column, row;
} cells[] = {{"front", 0, 0}, {"left", -1, 0},   {"right", 1, 0},
             {"top", 0, 1},   {"bottom", 0, -1}, {"back", 2, 0}};

/* The least and the greatest column and row of any view. */
enum { LEAST_CELL = -1, CELLS = MULTIVIEW_MAX + 2 };

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

/* The direction of that name, and the literal; NULL: there is none. */
static const char *find_named_direction(const char *name, double *azimuth_deg,
                                        double *elevation_deg) {
  const char *known;
  for (size_t i = 0;
       (known = recto_view_name(i, azimuth_deg, elevation_deg)) != NULL; i++)
    if (strcmp(known, name) == 0)
      return known;
  return NULL;
}

/* Whether the view is along an axis. */
static bool is_aligned(const char *name) {
  for (size_t i = 0; i < sizeof cells / sizeof cells[0]; i++)
    if (name != NULL && strcmp(cells[i].name, name) == 0)
      return true;
  return false;
}

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
      find_named_direction(view->name, NULL, NULL) == NULL)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "there is no view \"%.60s\"", view->name);
  if (!(view->scale >= 0 && view->scale <= DBL_MAX) ||
      (unsigned)view->hidden > RECTO_HIDDEN_LAYER)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "the view %s has a field that is out of range",
                     name_of_view(view));
  if (is_aligned(view->name) && view->scale != 0 && view->scale != 1)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "the view %s is aligned with others and has their scale",
                     view->name);
  return RECTO_OK;
}

static bool has_title(const recto_options *options) {
  return options->output.title != NULL && *options->output.title != '\0';
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
  return status == RECTO_OK && has_title(options)
             ? text_check(options->output.title, "the title", error)
             : status;
}

/* ---- The grid ------------------------------------------------------------ */

static void place_in_grid(struct multiview *views, recto_arrangement how) {
  int side = how == RECTO_ARRANGEMENT_FIRST ? -1 : 1, others = 0;
  for (size_t i = 0; i < views->count; i++) {
    struct multiview_view *view = &views->view[i];
    view->is_aligned = is_aligned(view->asked->name);
    if (!view->is_aligned) {
      view->column = ++others;
      view->row = side;
    }
    for (size_t c = 0; c < sizeof cells / sizeof cells[0]; c++)
      if (strcmp(cells[c].name, view->name) == 0) {
        view->column = cells[c].column == 2 ? 2 : side * cells[c].column;
        view->row = side * cells[c].row;
      }
  }
}

/* A column or a row of the grid; lengths in units of the prepared scene, of
 * boxes at the sheet's scale. */
struct track {
  bool is_used;
  double low, high; /* of the aligned views, about their targets */
  double width;     /* of these, or of the widest other view */
  double begin_mm;
};

/* The columns are axis 0, the rows axis 1. */
struct grid {
  struct track track[2][CELLS];
  int used[2];
  double sum[2]; /* of the widths */
};

static int find_track(const struct multiview_view *view, int axis) {
  return (axis == 0 ? view->column : view->row) - LEAST_CELL;
}

static double relative_scale(const struct multiview_view *view) {
  return view->asked->scale > 0 ? view->asked->scale : 1;
}

static void measure_grid(struct grid *grid, const struct multiview *views) {
  *grid = (struct grid){.used = {0, 0}};
  for (int axis = 0; axis < 2; axis++)
    for (size_t i = 0; i < views->count; i++) {
      const struct multiview_view *view = &views->view[i];
      struct track *track = &grid->track[axis][find_track(view, axis)];
      double low = view->box.low[axis], high = view->box.high[axis];
      grid->used[axis] += !track->is_used;
      track->is_used = true;
      if (view->is_aligned) {
        track->low = fmin(track->low, low);
        track->high = fmax(track->high, high);
      } else {
        track->width = fmax(track->width, relative_scale(view) * (high - low));
      }
    }
  for (int axis = 0; axis < 2; axis++)
    for (int t = 0; t < CELLS; t++) {
      struct track *track = &grid->track[axis][t];
      track->width = fmax(track->width, track->high - track->low);
      grid->sum[axis] += track->width;
    }
}

/* ---- The scale ----------------------------------------------------------- */

/* The room of a page inside its margins. */
struct room {
  double mm[2];      /* without the title's */
  double gap_mm;     /* at least between views */
  double band_mm[2]; /* of each column, and of each row: for names */
};

static struct room room_of(const struct multiview *views,
                           const double page_mm[2]) {
  struct room room = {
      {page_mm[0] - 2 * views->margin_mm, page_mm[1] - 2 * views->margin_mm},
      0,
      {0, NAME_BAND * views->name_mm}};
  room.gap_mm = fmin(room.mm[0], room.mm[1]) * SHARE_OF_GAP;
  room.mm[1] -= TITLE_BAND * views->title_mm;
  return room;
}

/* What the least gaps and the names leave. */
static double free_room(const struct grid *grid, const struct room *room,
                        int axis) {
  return room->mm[axis] - (grid->used[axis] - 1) * room->gap_mm -
         grid->used[axis] * room->band_mm[axis];
}

/* Heights of letters that ISO 3098 has, to 20 mm: the largest that is not above
 * a share of the page's shorter side, or one of the next lower. */
static double choose_text_height(const double page_mm[2], int lower) {
  static const double height[] = {1.8, 2.5, 3.5, 5, 7, 10, 14, 20};
  int i = sizeof height / sizeof height[0] - 1;
  while (i > 0 && height[i] > fmin(page_mm[0], page_mm[1]) / 40)
    i--;
  return height[i > lower ? i - lower : 0];
}

/* The largest scale, mm a unit of the prepared scene, at which the views fit;
 * 0: there is none.  A width that is rounding error only is
 * ignored; where both are, the scene's size is used. */
static double scale_to_fit_room(const struct grid *grid,
                                const struct room *room, double size) {
  double scale = INFINITY, least = INFINITY;
  for (int axis = 0; axis < 2; axis++) {
    double free_mm = free_room(grid, room, axis);
    least = fmin(least, free_mm);
    if (grid->sum[axis] > size * TOLERANCE_EXTENT_SHARE)
      scale = fmin(scale, free_mm / grid->sum[axis]);
  }
  return !(least > 0)       ? 0
         : scale < INFINITY ? scale
                            : least / (size > 0 ? size : 1);
}

/* Chooses the page's orientation and the scale, both as far as the options
 * leave them open. */
static recto_status choose_sheet_scale(struct multiview *views,
                                       const struct grid *grid,
                                       const recto_options *scaled, double size,
                                       double *scale, recto_error *error) {
  const double turned[2] = {views->page_mm[1], views->page_mm[0]};
  struct room room = room_of(views, views->page_mm);
  struct room other = room_of(views, turned);
  double most = scale_to_fit_room(grid, &room, size);
  double most_turned = scale_to_fit_room(grid, &other, size);
  double wanted =
      scaled->camera.fit == RECTO_FIT_SCALE ? scaled->camera.scale : INFINITY;
  if (scaled->page.may_turn && most < wanted && most_turned > most) {
    memcpy(views->page_mm, turned, sizeof turned);
    room = other;
    most = most_turned;
  }
  views->gap_mm = room.gap_mm;
  if (!(most > 0))
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "the page has no room for %zu views: inside its margins "
                     "it is %.4g x %.4g mm",
                     views->count, room.mm[0], room.mm[1]);
  *scale =
      scaled->camera.fit == RECTO_FIT_PREFERRED
          ? preferred_scale(most / scaled->camera.scale) * scaled->camera.scale
          : fmin(most, wanted);
  if (wanted < INFINITY && wanted > most * (1 + TOLERANCE_EXTENT_SHARE))
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "the views do not fit: at this scale they are %.4g x %.4g "
                     "mm, and the page has %.4g x %.4g mm for them; the "
                     "largest scale is %.4g times as large",
                     wanted * grid->sum[0], wanted * grid->sum[1],
                     free_room(grid, &room, 0), free_room(grid, &room, 1),
                     most / wanted);
  return RECTO_OK;
}

/* ---- Places -------------------------------------------------------------- */

/* Divides what is left of the page evenly, as far as both axes have it. */
static void choose_gap(struct multiview *views, const struct grid *grid,
                       double scale) {
  struct room room = room_of(views, views->page_mm);
  double even = INFINITY;
  for (int axis = 0; axis < 2; axis++) {
    double left = room.mm[axis] - grid->used[axis] * room.band_mm[axis] -
                  grid->sum[axis] * scale;
    if (grid->used[axis] > 1)
      even = fmin(even, left / (grid->used[axis] + 1));
  }
  if (even < INFINITY)
    views->gap_mm = fmax(views->gap_mm, even);
}

static void place_tracks(struct multiview *views, struct grid *grid,
                         double scale) {
  struct room room = room_of(views, views->page_mm);
  for (int axis = 0; axis < 2; axis++) {
    double all = grid->sum[axis] * scale +
                 (grid->used[axis] - 1) * views->gap_mm +
                 grid->used[axis] * room.band_mm[axis];
    double at =
        views->page_mm[axis] - views->margin_mm - (room.mm[axis] + all) / 2;
    for (int t = 0; t < CELLS; t++) {
      struct track *track = &grid->track[axis][t];
      if (!track->is_used)
        continue;
      track->begin_mm = at + room.band_mm[axis];
      at = track->begin_mm + track->width * scale + views->gap_mm;
    }
  }
}

static void place_view(struct multiview_view *view, const struct grid *grid,
                       double scale) {
  for (int axis = 0; axis < 2; axis++) {
    const struct track *track = &grid->track[axis][find_track(view, axis)];
    double own = view->is_aligned ? scale : scale * relative_scale(view);
    double low = view->is_aligned ? track->low : view->box.low[axis];
    double high = view->is_aligned ? track->high : view->box.high[axis];
    view->centre_mm[axis] = track->begin_mm +
                            (track->width * scale - (high - low) * own) / 2 -
                            low * own;
    view->low_mm[axis] = view->centre_mm[axis] + view->box.low[axis] * own;
    view->high_mm[axis] = view->centre_mm[axis] + view->box.high[axis] * own;
  }
}

static double limit_scale(double scale) {
  return fmin(fmax(scale, DBL_MIN), DBL_MAX);
}

static void place_views(struct multiview *views, struct grid *grid,
                        double scale, int exponent) {
  choose_gap(views, grid, scale);
  place_tracks(views, grid, scale);
  views->scale = limit_scale(ldexp(scale, -exponent));
  for (size_t i = 0; i < views->count; i++) {
    struct multiview_view *view = &views->view[i];
    place_view(view, grid, scale);
    view->scale = view->is_aligned
                      ? views->scale
                      : limit_scale(views->scale * relative_scale(view));
  }
}

/* ---- Details ------------------------------------------------------------- */

/* A rectangle of the page. */
struct page_box {
  double low[2], high[2];
};

static bool boxes_overlap(const struct page_box *a, const struct page_box *b) {
  return a->low[0] < b->high[0] && b->low[0] < a->high[0] &&
         a->low[1] < b->high[1] && b->low[1] < a->high[1];
}

/* A circle with the letters below it. */
static struct page_box box_of_detail(const struct multiview *views, double x,
                                     double y, double radius) {
  return (struct page_box){
      {x - radius, y - radius - NAME_BAND * views->letter_mm},
      {x + radius, y + radius}};
}

/* A view with its name. */
static struct page_box box_of_view(const struct multiview *views, size_t i) {
  const struct multiview_view *view = &views->view[i];
  double name = NAME_BAND * views->name_mm;
  return (struct page_box){{view->low_mm[0], view->low_mm[1] - name},
                           {view->high_mm[0], view->high_mm[1]}};
}

/* Whether a detail at this place lies on the page, beside all views, all marks
 * and the details before it. */
static bool has_room(const struct multiview *views, size_t detail, double x,
                     double y) {
  const struct page_box own =
      box_of_detail(views, x, y, views->detail[detail].radius_mm);
  double foot = views->margin_mm + TITLE_BAND * views->title_mm;
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
    const struct page_box mark = box_of_detail(
        views, other->asked->x_mm, other->asked->y_mm, other->asked->radius_mm);
    const struct page_box large = box_of_detail(
        views, other->centre_mm[0], other->centre_mm[1], other->radius_mm);
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
      double far = hypot(x - detail->asked->x_mm, y - detail->asked->y_mm);
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
  const recto_detail *asked = detail->asked;
  const char *letter = detail->name + strlen("detail-");
  bool on_page = true;
  const double at[2] = {asked->x_mm, asked->y_mm};
  for (int axis = 0; axis < 2; axis++)
    on_page = on_page && at[axis] - asked->radius_mm >= 0 &&
              at[axis] + asked->radius_mm <= views->page_mm[axis];
  if (!on_page)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "the detail %s, of %.4g mm about %.6g,%.6g, is not on the "
                     "page of %.4g x %.4g mm",
                     letter, asked->radius_mm, asked->x_mm, asked->y_mm,
                     views->page_mm[0], views->page_mm[1]);
  detail->view = find_view_of_detail(views, asked);
  if (detail->view == views->count)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "the detail %s, of %.4g mm about %.6g,%.6g, shows nothing "
                     "of any view",
                     letter, asked->radius_mm, asked->x_mm, asked->y_mm);
  detail->radius_mm = asked->radius_mm * asked->scale;
  detail->scale = limit_scale(views->view[detail->view].scale * asked->scale);
  if (!find_room(views, index))
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "the detail %s, of %.4g mm, has no room beside the views: "
                     "a larger page or a smaller scale of the views makes some",
                     letter, detail->radius_mm);
  return RECTO_OK;
}

static recto_status place_details(struct multiview *views,
                                  const recto_options *options,
                                  recto_error *error) {
  static const char *const name[RECTO_DETAIL_MAX] = {
      "detail-A", "detail-B", "detail-C", "detail-D",
      "detail-E", "detail-F", "detail-G", "detail-H"};
  recto_status status = RECTO_OK;
  views->details = options->sheet.detail_count;
  for (size_t i = 0; i < views->details; i++) {
    views->detail[i].asked = &options->sheet.detail[i];
    views->detail[i].name = name[i];
  }
  for (size_t i = 0; i < views->details && status == RECTO_OK; i++)
    status = place_detail(views, i, error);
  return status;
}

/* ---- The whole ----------------------------------------------------------- */

static void collect_views(struct multiview *views,
                          const recto_options *options) {
  const recto_sheet_view *asked = find_requested_views(options, &views->count);
  for (size_t i = 0; i < views->count; i++) {
    struct multiview_view *view = &views->view[i];
    view->asked = &asked[i];
    view->azimuth_deg = options->camera.azimuth_deg;
    view->elevation_deg = options->camera.elevation_deg;
    view->name = asked[i].name == NULL
                     ? "view"
                     : find_named_direction(asked[i].name, &view->azimuth_deg,
                                            &view->elevation_deg);
  }
}

static void turn_camera(recto_options *options,
                        const struct multiview_view *view) {
  options->camera.azimuth_deg = view->azimuth_deg;
  options->camera.elevation_deg = view->elevation_deg;
  options->camera.has_target = false;
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

recto_status multiview_arrange(struct multiview *views,
                               const struct preparation *prepared,
                               const recto_options *options,
                               recto_error *error) {
  recto_options scaled = *options;
  struct camera camera;
  struct grid grid;
  double scale = 0;
  *views = (struct multiview){.count = 0};
  collect_views(views, options);
  recto_status status = rescale_options(&prepared->rescaled, &scaled, error);
  for (size_t i = 0; i < views->count && status == RECTO_OK; i++) {
    struct multiview_view *view = &views->view[i];
    turn_camera(&scaled, view);
    status =
        camera_extent(&view->box, &camera, prepared->scene, &scaled, error);
  }
  if (status != RECTO_OK)
    return status;
  memcpy(views->page_mm, camera.page_mm, sizeof views->page_mm);
  views->margin_mm = camera.margin_mm;
  if (has_title(options)) {
    views->title = options->output.title;
    views->title_mm = choose_text_height(views->page_mm, 0);
  }
  views->letter_mm = choose_text_height(views->page_mm, 1);
  if (options->sheet.names)
    views->name_mm = views->letter_mm;
  place_in_grid(views, options->sheet.arrangement);
  measure_grid(&grid, views);
  status =
      choose_sheet_scale(views, &grid, &scaled, camera.size, &scale, error);
  if (status == RECTO_OK)
    place_views(views, &grid, scale, prepared->rescaled.exponent);
  if (status == RECTO_OK)
    status = check_title_width(views, error);
  return status == RECTO_OK ? place_details(views, options, error) : status;
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
  if (view->asked->has_hidden)
    of_view->ink.hidden = view->asked->hidden;
  for (int axis = 0; axis < 2; axis++) {
    double at = view->centre_mm[axis];
    if (detail != NULL) {
      double shown = axis == 0 ? detail->asked->x_mm : detail->asked->y_mm;
      at = detail->centre_mm[axis] + (at - shown) * detail->asked->scale;
    }
    shift_mm[axis] = at - views->page_mm[axis] / 2;
  }
}
