/* writer.h - the interface of all output formats.
 *
 * A writer receives a drawing in millimetres and a stream, which keeps its
 * first error; it uses nothing else of the library.  README.md in this folder
 * says how to add one. */
#ifndef BACKENDS_WRITER_H
#define BACKENDS_WRITER_H

#include "base/poll.h"
#include "base/stream.h"
#include "drawing/drawing.h"

struct writer_options {
  int precision;            /* decimals of a millimetre in text formats */
  bool polyline;            /* SVG: <polyline> instead of <path> */
  recto_warning_fn warning; /* NULL: no warnings */
  void *user;               /* passed to `warning` */
  double dpi;               /* PNG: pixels per inch; 0: 150 */
  bool tight; /* all but HPGL: the page is the bounding box of the ink */
  const char *device; /* HPGL: a device's name (device.h); NULL: "generic" */
  const char *title, *description; /* NULL: the drawing's; "": none */
  const char *id_prefix;           /* SVG: of all ids; NULL: none */
  recto_background background;
  uint32_t background_colour; /* 0xRRGGBB, with RECTO_BACKGROUND_COLOUR */
  double velocity; /* HPGL: speed with the pen down, cm/s; 0: the plotter's
                         default */
};

struct writer {
  const char *name;       /* such as "svg" */
  const char *extensions; /* of files, separated by spaces */
  const char *compressed; /* extensions of files compressed by gzip; NULL: the
                             format has none */
  /* The step, in mm, to which the format rounds the points of strokes. */
  double (*unit_mm)(const struct writer_options *options);
  /* The least margin of a page, in mm, inside which everything can be drawn;
   * NULL stands for 0. */
  double (*margin_mm)(const struct writer_options *options, double width_mm,
                      double height_mm);
  /* The width of seams, in mm, that closes the hairlines which viewers of the
   * format show between fills; NULL stands for 0, a format without fills. */
  double (*seam_mm)(const struct writer_options *options);
  bool by_pens; /* a format for plotters: all lines of a pen have one width, and
                   travel with the pen up costs time */
  /* Each pen has a layer, which programs for plotters read: the order of
   * strokes counts where a plotter is meant. */
  bool has_layers;
  /* Writes the drawing.  Write errors are not returned, but kept by the
   * stream. */
  recto_status (*write)(const struct drawing *drawing,
                        const struct writer_options *options,
                        struct stream *stream, recto_error *error);
};

/* The width of seams, in mm, for a page shown on a screen: 1.5 pixels, which is
 * what closes a hairline, where there are 96 an inch. */
double writer_screen_seam_mm(const struct writer_options *options);

extern const struct writer writer_svg, writer_hpgl;
#ifdef HAVE_CAIRO
extern const struct writer writer_pdf, writer_eps, writer_ps, writer_png;
#endif

/* The title and the description of a drawing; "" where there is none. */
static inline const char *writer_title(const struct drawing *drawing,
                                       const struct writer_options *options) {
  const char *title = options->title != NULL ? options->title : drawing->title;
  return title != NULL ? title : "";
}
static inline const char *
writer_description(const struct drawing *drawing,
                   const struct writer_options *options) {
  const char *text = options->description != NULL ? options->description
                                                  : drawing->description;
  return text != NULL ? text : "";
}

/* Whether to write the next one of the drawing's fills and then its strokes:
 * not after an error of the stream, nor once the caller has cancelled.
 * done  how many were before it, for progress */
static inline bool writer_goes_on(const struct drawing *drawing,
                                  const struct stream *stream, size_t done) {
  size_t all = drawing->fill.count + drawing->stroke.count;
  poll_set_share((double)done / (double)all);
  return stream_status(stream) == RECTO_OK;
}

/* The writer with that name or extension, and the writer for the extension of
 * that path; NULL if there is none.  Case is ignored. */
const struct writer *writer_by_name(const char *name);
const struct writer *writer_by_path(const char *path);
/* Whether the name, or the extension of the path, denotes a compressed file. */
bool writer_name_is_compressed(const char *name);
bool writer_path_is_compressed(const char *path);
/* All writers, terminated by NULL. */
const struct writer *const *writers(void);

#endif
