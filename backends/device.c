/* device.c - the table of pen plotters, and the placement of a page on one.
 *
 * Areas and units are those of the manufacturers.  HP's manual of the 7475A
 * states that its default scaling frame P1 P2 is centred on the paper: the
 * centres in the table are the centres of those frames.  For the 7550A the
 * centre of its hard-clip area is taken.  The area of the DXY is the whole
 * sheet.
 *
 * Speeds are nominal.  The default speed with the pen down and the maximum with
 * the pen up serve the estimate of --stats; the maximum with the pen down
 * limits any requested speed.  Those of the generic device are the speeds of a
 * slow hobby machine, and the upper limit of HPGL itself. */
#include "backends/device.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/tolerance.h"

static const struct device_paper hp7475a[] = {
    {"A", 279.4, 215.9, 0, 0, 10365, 7962, 5250, 4196},  /* A */
    {"A4", 297, 210, 0, 0, 11040, 7721, 5603, 4121},     /* A4 */
    {"B", 431.8, 279.4, 0, 0, 16640, 10365, 8122, 5259}, /* B */
    {"A3", 420, 297, 0, 0, 16158, 11040, 7770, 5602},    /* A3 */
};

static const struct device_paper hp7550a[] = {
    {"A4", 297, 210, 0, 0, 10870, 7600, 5435, 3800},  /* A4 */
    {"A3", 420, 297, 0, 0, 15970, 10870, 7985, 5435}, /* A3 */
};

static const struct device_paper dxy[] = {
    {"A4", 297, 210, 0, 0, 11880, 8400, 5940, 4200},  /* A4 */
    {"A3", 420, 297, 0, 0, 16800, 11880, 8400, 5940}, /* A3 */
};

#define PAPERS(table) table, sizeof(table) / sizeof *(table)

static const struct device devices[] = {
    {"generic", 0.025, 0, false, NULL, 0, 10, 20, 127},
    {"drum", 0.025, 8, true, NULL, 0, 40, 60, 60},
    {"hp7475a", 0.02488, 6, false, PAPERS(hp7475a), 38.1, 50.8, 38.1},
    {"hp7550a", 0.02488, 8, false, PAPERS(hp7550a), 50, 80, 80},
    {"dxy", 0.025, 8, false, PAPERS(dxy), 20, 42, 42},
};

const struct device *device_by_name(const char *name) {
  for (size_t i = 0; i < sizeof devices / sizeof *devices; i++)
    if (name == NULL || strcmp(devices[i].name, name) == 0)
      return &devices[i];
  return NULL;
}

const char *device_name(size_t index) {
  return index < sizeof devices / sizeof *devices ? devices[index].name : NULL;
}

void device_list(char text[DEVICE_LIST_SIZE]) {
  size_t length = 0;
  for (size_t i = 0; device_name(i) != NULL && length < DEVICE_LIST_SIZE; i++)
    length += (size_t)snprintf(text + length, DEVICE_LIST_SIZE - length, "%s%s",
                               i > 0 ? " " : "", device_name(i));
}

static double area_of(const struct device_paper *paper) {
  return paper->width_mm * paper->height_mm;
}

/* Whether the paper holds a page of these sides. */
static bool holds_page(const struct device_paper *paper, double long_mm,
                       double short_mm) {
  return paper->width_mm + TOLERANCE_PAPER_MM >= long_mm &&
         paper->height_mm + TOLERANCE_PAPER_MM >= short_mm;
}

/* The smallest paper that holds a page of these sides, or the largest if none
 * does. */
static const struct device_paper *
choose_paper(const struct device *device, double long_mm, double short_mm) {
  const struct device_paper *best = NULL, *largest = device->paper;
  for (size_t i = 0; i < device->papers; i++) {
    const struct device_paper *paper = &device->paper[i];
    if (area_of(paper) > area_of(largest))
      largest = paper;
    if (holds_page(paper, long_mm, short_mm) &&
        (best == NULL || area_of(paper) < area_of(best)))
      best = paper;
  }
  return best != NULL ? best : largest;
}

/* Places a page on a device without papers: the page itself is the area. */
static void place_without_paper(const struct device *device, double width_mm,
                                double height_mm,
                                struct device_placement *placement) {
  double width = width_mm / device->unit_mm;
  double height = height_mm / device->unit_mm;
  placement->turned = false;
  placement->origin_x = device->centred ? -width / 2 : 0;
  placement->origin_y = device->centred ? -height / 2 : 0;
  placement->x0 = (int32_t)lround(placement->origin_x);
  placement->y0 = (int32_t)lround(placement->origin_y);
  placement->x1 = (int32_t)lround(placement->origin_x + width);
  placement->y1 = (int32_t)lround(placement->origin_y + height);
}

/* Where a side of the page of this length begins along an axis of the device,
 * whose area is low to high.  All in units. */
static double place_side(double length, int32_t low, int32_t high,
                         double centre) {
  return length <= high - low ? low : centre - length / 2;
}

void device_place(const struct device *device, double width_mm,
                  double height_mm, struct device_placement *placement) {
  *placement = (struct device_placement){
      .unit_mm = device->unit_mm, .width_mm = width_mm, .height_mm = height_mm};
  if (device->paper == NULL) {
    place_without_paper(device, width_mm, height_mm, placement);
    return;
  }
  double along = fmax(width_mm, height_mm), across = fmin(width_mm, height_mm);
  const struct device_paper *paper = choose_paper(device, along, across);
  placement->paper = paper;
  placement->too_large = !holds_page(paper, along, across);
  placement->between = !placement->too_large &&
                       paper != choose_paper(device, 0, 0) &&
                       (along < paper->width_mm - TOLERANCE_PAPER_MM ||
                        across < paper->height_mm - TOLERANCE_PAPER_MM);
  placement->turned = height_mm > width_mm;
  placement->origin_x = place_side(along / device->unit_mm, paper->x0,
                                   paper->x1, paper->centre_x);
  placement->origin_y = place_side(across / device->unit_mm, paper->y0,
                                   paper->y1, paper->centre_y);
  placement->x0 = paper->x0;
  placement->y0 = paper->y0;
  placement->x1 = paper->x1;
  placement->y1 = paper->y1;
}

double device_margin_mm(const struct device_placement *placement) {
  const struct device_placement *p = placement;
  double far_x =
      p->origin_x + (p->turned ? p->height_mm : p->width_mm) / p->unit_mm;
  double far_y =
      p->origin_y + (p->turned ? p->width_mm : p->height_mm) / p->unit_mm;
  double low = fmax(p->x0 - p->origin_x, p->y0 - p->origin_y);
  double high = fmax(far_x - p->x1, far_y - p->y1);
  return p->paper != NULL ? fmax(0, fmax(low, high)) * p->unit_mm : 0;
}

double device_velocity(const struct device *device, double requested_cm_s) {
  return requested_cm_s > 0 ? fmin(requested_cm_s, device->max_cm_s)
                            : device->down_cm_s;
}

void device_point(const struct device_placement *placement, double x_mm,
                  double y_mm, double *x, double *y) {
  double along = placement->turned ? placement->height_mm - y_mm : x_mm;
  double across = placement->turned ? x_mm : y_mm;
  *x = placement->origin_x + along / placement->unit_mm;
  *y = placement->origin_y + across / placement->unit_mm;
}
