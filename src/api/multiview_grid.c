/* multiview_grid.c - sums the extents of views by column and row. */
#include "api/multiview_grid.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "api/multiview_labels.h"
#include "base/tolerance.h"
#include "view/preferred_scale.h"

/* The least distance between views, as a share of the shorter side of the page
 * inside its margins. */
#define SHARE_OF_GAP (1.0 / 12)

/* ---- The grid ------------------------------------------------------------ */

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

bool multiview_grid_has_cell(const char *name) {
  for (size_t i = 0; i < sizeof cells / sizeof cells[0]; i++)
    if (name != NULL && strcmp(cells[i].name, name) == 0)
      return true;
  return false;
}

/* Whether any aligned view is in a column or row. */
static bool has_aligned(const struct multiview *views, int axis, int cell) {
  for (size_t i = 0; i < views->count; i++) {
    const struct multiview_view *view = &views->view[i];
    if (view->is_aligned && (axis == 0 ? view->column : view->row) == cell)
      return true;
  }
  return false;
}

/* The other views stand in the corner beside the views from above and from a
 * side, and where there is no such view, beside those on the other side. */
static void place_in_grid(struct multiview *views, recto_arrangement how) {
  int side = how == RECTO_ARRANGEMENT_FIRST ? -1 : 1, others = 0;
  for (size_t i = 0; i < views->count; i++) {
    struct multiview_view *view = &views->view[i];
    view->is_aligned = multiview_grid_has_cell(view->request->name);
    for (size_t c = 0; c < sizeof cells / sizeof cells[0]; c++)
      if (view->is_aligned && strcmp(cells[c].name, view->name) == 0) {
        view->column = cells[c].column == 2 ? 2 : side * cells[c].column;
        view->row = side * cells[c].row;
      }
  }
  int row = has_aligned(views, 1, -side) && !has_aligned(views, 1, side) ? -side
                                                                         : side;
  bool is_left = has_aligned(views, 0, -1) && !has_aligned(views, 0, 1);
  for (size_t i = 0; i < views->count; i++) {
    struct multiview_view *view = &views->view[i];
    if (view->is_aligned)
      continue;
    view->column = is_left && others == 0 ? -1 : others - is_left + 1;
    view->row = row;
    others++;
  }
}

/* A column or a row of the grid; lengths in units of the prepared scene, of
 * boxes at the sheet's scale. */
struct track {
  bool is_used;
  double low, high; /* of the aligned views, about their targets */
  double width;     /* of these, or of the widest other view */
  double label_mm;  /* of a column: the widest name */
  double mm;        /* the width on the page, at a scale */
  double begin_mm;
};

/* The columns are axis 0, the rows axis 1. */
struct grid {
  struct track track[2][CELLS];
  int used[2];
  double sum[2];       /* of the widths */
  double labels_mm[2]; /* of the names' widths */
  double mm[2];        /* of the widths on the page */
};

static int find_track(const struct multiview_view *view, int axis) {
  return (axis == 0 ? view->column : view->row) - LEAST_CELL;
}

static double relative_scale(const struct multiview_view *view) {
  return view->request->scale > 0 ? view->request->scale : 1;
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
      if (axis == 0)
        track->label_mm = fmax(track->label_mm, view->label_mm);
    }
  for (int axis = 0; axis < 2; axis++)
    for (int t = 0; t < CELLS; t++) {
      struct track *track = &grid->track[axis][t];
      track->width = fmax(track->width, track->high - track->low);
      grid->sum[axis] += track->width;
      grid->labels_mm[axis] += track->label_mm;
    }
}

/* The widths on the page at a scale: no column is narrower than its names. */
static void size_tracks(struct grid *grid, double scale) {
  for (int axis = 0; axis < 2; axis++) {
    grid->mm[axis] = 0;
    for (int t = 0; t < CELLS; t++) {
      struct track *track = &grid->track[axis][t];
      track->mm = fmax(track->width * scale, track->label_mm);
      grid->mm[axis] += track->mm;
    }
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
      {0, MULTIVIEW_NAME_BAND * views->name_mm}};
  room.gap_mm = fmin(room.mm[0], room.mm[1]) * SHARE_OF_GAP;
  room.mm[1] -= MULTIVIEW_TITLE_BAND * views->title_mm;
  return room;
}

/* What the least gaps and the names leave. */
static double free_room(const struct grid *grid, const struct room *room,
                        int axis) {
  return room->mm[axis] - (grid->used[axis] - 1) * room->gap_mm -
         grid->used[axis] * room->band_mm[axis];
}

/* The largest scale at which the columns, or the rows, fit.  Those that their
 * names widen leave less to the others, of which this may widen more. */
static double scale_to_fit_axis(const struct grid *grid, int axis,
                                double free_mm) {
  double scale = free_mm / grid->sum[axis], before = INFINITY;
  while (scale < before) {
    double by_scale = 0, by_name_mm = 0;
    for (int t = 0; t < CELLS; t++) {
      const struct track *track = &grid->track[axis][t];
      if (track->width * scale < track->label_mm)
        by_name_mm += track->label_mm;
      else
        by_scale += track->width;
    }
    before = scale;
    scale = by_scale > 0 ? fmin(scale, (free_mm - by_name_mm) / by_scale) : 0;
  }
  return fmax(scale, 0);
}

/* The largest scale, mm a unit of the prepared scene, at which the views fit;
 * 0: there is none.  A width that is rounding error only is
 * ignored; where both are, the scene's size is used. */
static double scale_to_fit_room(const struct grid *grid,
                                const struct room *room, double size) {
  double scale = INFINITY, least = INFINITY;
  for (int axis = 0; axis < 2; axis++) {
    double free_mm = free_room(grid, room, axis);
    least = fmin(least, free_mm - grid->labels_mm[axis]);
    if (grid->sum[axis] > size * TOLERANCE_EXTENT_SHARE)
      scale = fmin(scale, scale_to_fit_axis(grid, axis, free_mm));
  }
  return !(least > 0)       ? 0
         : scale < INFINITY ? scale
                            : least / (size > 0 ? size : 1);
}

/* Chooses the page's orientation and the scale, both as far as the options
 * leave them open. */
static recto_status choose_sheet_scale(struct multiview *views,
                                       struct grid *grid,
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
                     "the page of %.4g x %.4g mm has no room for %zu views "
                     "with what is between and about them%s",
                     views->page_mm[0], views->page_mm[1], views->count,
                     views->name_mm > 0 ? ", such as their names" : "");
  *scale = scaled->camera.fit == RECTO_FIT_PREFERRED
               ? preferred_scale_of(most, scaled->camera.scale)
               : fmin(most, wanted);
  if (wanted < INFINITY && wanted > most * (1 + TOLERANCE_EXTENT_SHARE)) {
    size_tracks(grid, wanted);
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "the views do not fit: at this scale they are %.4g x %.4g "
                     "mm, and the page has %.4g x %.4g mm for them; the "
                     "largest scale is %.4g times as large",
                     grid->mm[0], grid->mm[1], free_room(grid, &room, 0),
                     free_room(grid, &room, 1), most / wanted);
  }
  return RECTO_OK;
}

/* ---- Places -------------------------------------------------------------- */

/* Divides what is left of the page evenly, as far as both axes have it. */
static void choose_gap(struct multiview *views, const struct grid *grid) {
  struct room room = room_of(views, views->page_mm);
  double even = INFINITY;
  for (int axis = 0; axis < 2; axis++) {
    double left =
        room.mm[axis] - grid->used[axis] * room.band_mm[axis] - grid->mm[axis];
    if (grid->used[axis] > 1)
      even = fmin(even, left / (grid->used[axis] + 1));
  }
  if (even < INFINITY)
    views->gap_mm = fmax(views->gap_mm, even);
}

static void place_tracks(struct multiview *views, struct grid *grid) {
  struct room room = room_of(views, views->page_mm);
  for (int axis = 0; axis < 2; axis++) {
    double all = grid->mm[axis] + (grid->used[axis] - 1) * views->gap_mm +
                 grid->used[axis] * room.band_mm[axis];
    double at =
        views->page_mm[axis] - views->margin_mm - (room.mm[axis] + all) / 2;
    for (int t = 0; t < CELLS; t++) {
      struct track *track = &grid->track[axis][t];
      if (!track->is_used)
        continue;
      track->begin_mm = at + room.band_mm[axis];
      at = track->begin_mm + track->mm + views->gap_mm;
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
    view->centre_mm[axis] =
        track->begin_mm + (track->mm - (high - low) * own) / 2 - low * own;
    view->low_mm[axis] = view->centre_mm[axis] + view->box.low[axis] * own;
    view->high_mm[axis] = view->centre_mm[axis] + view->box.high[axis] * own;
  }
}

double multiview_grid_limit_scale(double scale) {
  return fmin(fmax(scale, DBL_MIN), DBL_MAX);
}

static void place_views(struct multiview *views, struct grid *grid,
                        double scale, int exponent) {
  size_tracks(grid, scale);
  choose_gap(views, grid);
  place_tracks(views, grid);
  views->scale = multiview_grid_limit_scale(ldexp(scale, -exponent));
  for (size_t i = 0; i < views->count; i++) {
    struct multiview_view *view = &views->view[i];
    place_view(view, grid, scale);
    view->scale =
        view->is_aligned
            ? views->scale
            : multiview_grid_limit_scale(views->scale * relative_scale(view));
  }
}

/* ---- The whole ----------------------------------------------------------- */

/* The names of views have scales, which are known once all is arranged: it is
 * done again while that widens a name. */
recto_status multiview_grid_arrange(struct multiview *views,
                                    const recto_options *scaled, double size,
                                    int exponent, recto_error *error) {
  enum { TIMES_MAX = 8 };
  struct grid grid;
  recto_status status = RECTO_OK;
  bool again = true;
  place_in_grid(views, scaled->sheet.arrangement);
  (void)multiview_labels_of_views(views);
  for (int i = 0; i < TIMES_MAX && again && status == RECTO_OK; i++) {
    double scale = 0;
    measure_grid(&grid, views);
    status = choose_sheet_scale(views, &grid, scaled, size, &scale, error);
    if (status != RECTO_OK)
      break;
    place_views(views, &grid, scale, exponent);
    again = multiview_labels_of_views(views);
  }
  return status;
}
