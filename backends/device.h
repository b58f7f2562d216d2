/* device.h - pen plotters: their unit, pens, papers and reach, and how a page
 * lies on them. */
#ifndef BACKENDS_DEVICE_H
#define BACKENDS_DEVICE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A sheet as it lies on the device, its long side along x. */
struct device_paper {
  const char *name;
  double width_mm, height_mm;
  int32_t x0, y0, x1, y1;    /* hard-clip area in units, ends included */
  double centre_x, centre_y; /* the sheet's centre, in units */
};

struct device {
  const char *name;
  double unit_mm;
  unsigned pens; /* in the carousel; 0: any number */
  bool centred;  /* without papers: the origin is the page's centre, else its
                    lower left corner */
  const struct device_paper *paper; /* NULL: takes every page as it is */
  size_t papers;
  double down_cm_s, up_cm_s; /* speeds, where the user names none */
  double most_cm_s;          /* with the pen down it is never faster */
};

/* From pen up to pen down and back: an estimate for all of them, as the makers
 * name none. */
#define DEVICE_LIFT_S 0.2

/* A page on a device.  A point x, y of the page, in mm, is at
 * origin + (x, y) / unit, or, where the page is turned,
 * origin + (page height - y, x) / unit. */
struct device_placement {
  const struct device_paper *paper; /* NULL: the page itself */
  bool too_large;                   /* for it and every other */
  bool between; /* smaller than it, but too large for the smallest: likely a
                   sheet that the table does not have */
  double unit_mm;
  double origin_x, origin_y;  /* units */
  double width_mm, height_mm; /* the page's */
  bool turned;
  int32_t x0, y0, x1, y1; /* never to be left; units, ends included */
};

/* The device of that name, or NULL. */
const struct device *device_by_name(const char *name);

/* The name at `index`, or NULL past the last. */
const char *device_name(size_t index);

/* The names of all, for messages. */
enum { DEVICE_LIST_SIZE = 128 };
void device_list(char text[DEVICE_LIST_SIZE]);

/* Lays a page on the device: on the smallest paper that holds it, or the
 * largest there is; a page higher than wide is turned by a quarter, left side
 * down, since papers lie with their long side along x.  In x and in y, a page
 * that fits into the hard-clip area begins where the area does; any other has
 * its middle on the paper's: a page as large as the paper is the paper. */
void device_place(const struct device *device, double width_mm,
                  double height_mm, struct device_placement *placement);

/* How far from its edges, in mm, all of the page is within reach. */
double device_margin_mm(const struct device_placement *placement);

/* The speed with the pen down, in cm/s, where that much is asked for; 0: none
 * is. */
double device_velocity(const struct device *device, double asked_cm_s);

/* Where a page point, in mm, is on the device, in units, not rounded. */
void device_point(const struct device_placement *placement, double x_mm,
                  double y_mm, double *x, double *y);

#endif
