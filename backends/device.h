/* device.h - the known pen plotters, and the placement of a page on one.
 *
 * A unit is the length of one step of the plotter's coordinates. */
#ifndef BACKENDS_DEVICE_H
#define BACKENDS_DEVICE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A paper size as it lies on the device, with its long side along x. */
struct device_paper {
  const char *name;
  double width_mm, height_mm;
  int32_t x0, y0, x1, y1;    /* hard-clip area in units, ends included */
  double centre_x, centre_y; /* the paper's centre, in units */
};

struct device {
  const char *name;
  double unit_mm;
  unsigned pens; /* in the carousel; 0: any number */
  bool centred;  /* for a device without papers: whether the origin is the
                    page's centre, or else its lower left corner */
  /* The paper sizes; NULL: a page of any size is its own paper. */
  const struct device_paper *paper;
  size_t papers;
  double down_cm_s, up_cm_s; /* default speeds with the pen down and up */
  double max_cm_s;           /* maximum speed with the pen down */
};

/* The time to lower and raise the pen once, in seconds: an estimate for all
 * devices, since the manufacturers state none. */
#define DEVICE_LIFT_S 0.2

/* A page on a device.  The point x, y of the page, in mm, has the position
 *   origin + (x, y) / unit                  if the page is not turned
 *   origin + (page height - y, x) / unit    if it is. */
struct device_placement {
  const struct device_paper *paper; /* NULL: the page itself */
  bool too_large;                   /* no paper holds the page */
  bool between; /* the page is smaller than the paper, which is not the smallest
                   one: probably a paper size missing in the table */
  double unit_mm;
  double origin_x, origin_y;  /* units */
  double width_mm, height_mm; /* of the page */
  bool turned;
  int32_t x0, y0, x1, y1; /* the area to clip to, in units, ends included */
};

/* The device of that name, of NULL the generic one; NULL if there is none. */
const struct device *device_by_name(const char *name);

/* The name of the device at `index`, or NULL past the last. */
const char *device_name(size_t index);

/* Writes the names of all devices to `text`, separated by spaces, for
 * messages. */
enum { DEVICE_LIST_SIZE = 128 };
void device_list(char text[DEVICE_LIST_SIZE]);

/* Places a page on the device: on the smallest paper that holds it, or if there
 * is none on the largest.  A page higher than wide is turned by 90 degrees,
 * with its left side down, since papers lie with their long side along x.  In
 * each of x and y, a page that fits into the hard-clip area begins where the
 * area begins, and any other page is centred on the paper.  So a page of the
 * size of the paper coincides with it. */
void device_place(const struct device *device, double width_mm,
                  double height_mm, struct device_placement *placement);

/* The least margin of the page, in mm, inside which the device reaches every
 * point.  0 for a device without papers. */
double device_margin_mm(const struct device_placement *placement);

/* The speed with the pen down, in cm/s, for a requested one: at most the
 * device's maximum, or its default if the request is 0. */
double device_velocity(const struct device *device, double requested_cm_s);

/* Converts a point of the page, in mm, to device units, not rounded. */
void device_point(const struct device_placement *placement, double x_mm,
                  double y_mm, double *x, double *y);

#endif
