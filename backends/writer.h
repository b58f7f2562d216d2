/* writer.h - the one interface of all file formats we write.
 *
 * To add a format: one file writer_NAME.c with one struct writer, and its
 * line in the table of writers.c.  A writer sees a drawing in millimetres and
 * a stream whose status is sticky; it asks nothing else of the house. */
#ifndef BACKENDS_WRITER_H
#define BACKENDS_WRITER_H

#include "base/stream.h"
#include "drawing/drawing.h"

struct writer_options {
  int precision;            /* decimals of a millimetre in text formats */
  bool polyline;            /* SVG: <polyline> instead of <path> */
  recto_warning_fn warning; /* NULL: silent */
  void *user;
  double dpi;         /* PNG: pixels per inch; 0: 150 */
  bool tight;         /* PDF, EPS, PS, PNG: the page is the ink's box */
  const char *device; /* HPGL: a name of device.h; NULL: "generic" */
  double velocity;    /* HPGL: pen speed, cm/s; 0: the plotter's own */
};

struct writer {
  const char *name;       /* "svg" */
  const char *extensions; /* "svg", space-separated */
  const char *compressed; /* extensions of such a file in the format of gzip;
                             NULL: none */
  /* The step in mm to which it rounds the points of strokes. */
  double (*unit_mm)(const struct writer_options *options);
  /* How far from the edges of a page all of it can be drawn; NULL: 0. */
  double (*margin_mm)(const struct writer_options *options, double width_mm,
                      double height_mm);
  bool by_pens; /* whose lines are all as wide, and whose way from line to line
                   takes time */
  recto_status (*write)(const struct drawing *drawing,
                        const struct writer_options *options,
                        struct stream *stream, recto_error *error);
};

extern const struct writer writer_svg, writer_hpgl;
#ifdef HAVE_CAIRO
extern const struct writer writer_pdf, writer_eps, writer_ps, writer_png;
#endif

/* The writer of that name, or NULL; by the path's extension, or NULL. */
const struct writer *writer_by_name(const char *name);
const struct writer *writer_by_path(const char *path);
/* Whether the name, or the path's extension, stands for a compressed file. */
bool writer_name_is_compressed(const char *name);
bool writer_path_is_compressed(const char *path);
/* The writers, ended by NULL. */
const struct writer *const *writers(void);

#endif
