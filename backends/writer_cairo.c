/* writer_cairo.c - writes PDF, EPS, PS and PNG by cairo, at true scale.
 *
 * cairo draws in points or pixels with y down; a matrix maps the page's
 * millimetres with y up to them.  In PDF, EPS and PS strokes are written as
 * paths, not as images.  cairo passes its bytes to a stream through a sink,
 * which also makes three changes for which cairo has no option: it removes the
 * creation date of PS, replaces the bounding box of EPS by the page, and adds
 * the resolution to PNG.  cairo rounds the points of paths to 1/256 of a point
 * (1.4 um). */
#include <errno.h>
#include <math.h>
#include <string.h>

#include <cairo-pdf.h>
#include <cairo-ps.h>
#include <cairo.h>

#include "backends/writer.h"
#include "base/utf8.h"

#define MM_PER_INCH 25.4
#define POINTS_PER_INCH 72.0
/* Sides of pages are rounded to a multiple of a point divided by this, a third
 * of a nanometre, so that a rounding error does not make a page a whole point
 * larger. */
#define PAGE_STEPS_PER_POINT 0x1p20
#define DEFAULT_DPI 150.0
/* The largest image: the limit of a side is cairo's, that of the area is one
 * gigabyte of memory. */
#define MAX_PIXELS_A_SIDE 32767.0
#define MAX_PIXELS 268435456.0
/* The creation date is fixed, so that equal drawings give equal files. */
#define FIXED_DATE "2000-01-01T00:00:00Z"

/* ---- From cairo to the stream -------------------------------------------- */

struct sink {
  struct stream *stream;
  bool in_header; /* PS: before the end of the header comments */
  bool is_eps;
  double width_pt, height_pt; /* of the page */
  double foot_pt;  /* distance of the page's lower edge from cairo's origin */
  char line[256];  /* PS: the part of the current header line received */
  size_t length;   /* of it */
  uint64_t offset; /* PNG: bytes received so far */
  uint32_t per_metre; /* PNG: pixels per metre */
};

/* The stream's status as one of cairo, which ends at an error.  Polls, since
 * cairo compresses between two parts of its output. */
static cairo_status_t sink_status(const struct sink *sink) {
  return stream_status(sink->stream) == RECTO_OK && poll_now()
             ? CAIRO_STATUS_SUCCESS
             : CAIRO_STATUS_WRITE_ERROR;
}

static cairo_status_t pass_bytes(void *closure, const unsigned char *bytes,
                                 unsigned count) {
  struct sink *sink = closure;
  stream_write(sink->stream, bytes, count);
  return sink_status(sink);
}

static bool data_starts_with(const struct sink *sink, const char *word) {
  size_t length = strlen(word);
  return sink->length >= length && memcmp(sink->line, word, length) == 0;
}

/* Writes the bounding box of the page, in place of cairo's, which is that of
 * the ink: first in whole points, rounded up, then the exact one. */
static void write_box(const struct sink *sink) {
  struct stream *stream = sink->stream;
  stream_text(stream, "%%BoundingBox: 0 0 ");
  stream_int(stream, (int64_t)ceil(sink->width_pt));
  stream_text(stream, " ");
  stream_int(stream, (int64_t)ceil(sink->height_pt));
  stream_text(stream, "\n%%HiResBoundingBox: 0 0 ");
  stream_number(stream, sink->width_pt, 3);
  stream_text(stream, " ");
  stream_number(stream, sink->height_pt, 3);
  stream_text(stream, "\n");
}

/* Passes on one header line of a PS file, or a part of a long one, with the
 * creation date removed and the boxes of EPS replaced.  Only some versions of
 * cairo write an exact box. */
static void pass_line(struct sink *sink) {
  if (data_starts_with(sink, "%%EndComments"))
    sink->in_header = false;
  if (sink->is_eps && data_starts_with(sink, "%%BoundingBox:"))
    write_box(sink);
  else if (!(sink->is_eps && data_starts_with(sink, "%%HiResBoundingBox:")) &&
           !data_starts_with(sink, "%%CreationDate:"))
    stream_write(sink->stream, sink->line, sink->length);
  sink->length = 0;
}

/* Filters the header line by line; passes on everything after it unchanged. */
static cairo_status_t pass_ps(void *closure, const unsigned char *bytes,
                              unsigned count) {
  struct sink *sink = closure;
  unsigned i = 0;
  while (i < count && sink->in_header) {
    sink->line[sink->length++] = (char)bytes[i];
    if (bytes[i++] == '\n' || sink->length == sizeof sink->line)
      pass_line(sink);
  }
  return pass_bytes(sink, bytes + i, count - i);
}

/* Stores a number with the most significant byte first. */
static void store_be32(unsigned char *bytes, uint32_t value) {
  for (int i = 0; i < 4; i++)
    bytes[i] = (unsigned char)(value >> (24 - 8 * i));
}

/* The CRC-32 of PNG (that of ISO 3309), computed bit by bit without a table,
 * since it is used for 13 bytes only. */
static uint32_t checksum(const unsigned char *bytes, size_t count) {
  uint32_t crc = UINT32_MAX;
  for (size_t i = 0; i < count; i++) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; bit++)
      crc = crc >> 1 ^ (crc & 1 ? UINT32_C(0xedb88320) : 0);
  }
  return ~crc;
}

/* Writes the pHYs chunk with the number of pixels per metre: length, type,
 * density in x and in y, unit, CRC of everything but the length. */
static void write_resolution(const struct sink *sink) {
  unsigned char chunk[21] = {0, 0, 0, 9, 'p', 'H', 'Y', 's'};
  store_be32(chunk + 8, sink->per_metre);
  store_be32(chunk + 12, sink->per_metre);
  chunk[16] = 1;
  store_be32(chunk + 17, checksum(chunk + 4, 13));
  stream_write(sink->stream, chunk, sizeof chunk);
}

/* Inserts the pHYs chunk after the first chunk, which ends at byte 33 of every
 * PNG file. */
static cairo_status_t pass_png(void *closure, const unsigned char *bytes,
                               unsigned count) {
  enum { HEADER = 33 };
  struct sink *sink = closure;
  unsigned before = count;
  if (sink->offset < HEADER && sink->offset + count >= HEADER)
    before = HEADER - (unsigned)sink->offset;
  stream_write(sink->stream, bytes, before);
  if (sink->offset < HEADER && sink->offset + before == HEADER)
    write_resolution(sink);
  stream_write(sink->stream, bytes + before, count - before);
  sink->offset += count;
  return sink_status(sink);
}

/* ---- Drawing ------------------------------------------------------------- */

static void set_colour(cairo_t *cr, uint32_t colour) {
  cairo_set_source_rgb(cr, (colour >> 16 & 0xff) / 255.0,
                       (colour >> 8 & 0xff) / 255.0, (colour & 0xff) / 255.0);
}

/* Adds a polyline or polygon to cairo's current path. */
static void add_cairo_path(cairo_t *cr, const struct drawing_point *point,
                           uint32_t count, bool closed) {
  for (uint32_t i = 0; i < count; i++)
    cairo_line_to(cr, point[i].x, point[i].y);
  if (closed)
    cairo_close_path(cr);
  cairo_new_sub_path(cr);
}

static void add_cairo_curve(cairo_t *cr, const struct drawing_point *control,
                            uint32_t count, bool closed) {
  cairo_move_to(cr, control[0].x, control[0].y);
  for (uint32_t i = 0; i + 3 < count; i += 3) {
    const struct drawing_point *p = control + i;
    if (drawing_piece_is_straight(p))
      cairo_line_to(cr, p[3].x, p[3].y);
    else
      cairo_curve_to(cr, p[1].x, p[1].y, p[2].x, p[2].y, p[3].x, p[3].y);
  }
  if (closed)
    cairo_close_path(cr);
}

/* Draws a fill, or the stroke along its outline that closes seams. */
static void draw_fill(cairo_t *cr, const struct drawing *drawing,
                      const struct drawing_fill *fill, bool seam) {
  set_colour(cr, fill->colour);
  for (uint32_t i = 0; i < fill->loops; i++) {
    const struct drawing_loop *loop = &drawing->loop.item[fill->loop + i];
    add_cairo_path(cr, drawing->point.item + loop->point, loop->count, true);
  }
  if (seam)
    cairo_stroke(cr);
  else
    cairo_fill(cr);
}

/* A fill takes cairo as long as so many items of other loops. */
enum { FILL_ITEMS = 64 };

/* Draws the fills of a layer.  The strokes that close seams are drawn before
 * all of its fills, so that they do not paint over any of them. */
static void draw_fills(cairo_t *cr, const struct drawing *drawing,
                       uint32_t layer) {
  cairo_set_line_width(cr, drawing->seam_mm);
  for (int seam = drawing->seam_mm > 0; seam >= 0; seam--)
    for (size_t i = 0; i < drawing->fill.count && poll_at(FILL_ITEMS * i); i++)
      if (drawing->fill.item[i].layer == layer)
        draw_fill(cr, drawing, &drawing->fill.item[i], seam);
}

/* A stroke takes cairo as long as so many points of other strokes, and these
 * take it a millisecond. */
enum { STROKE_POINTS = 8, POLL_POINTS = 512 };

static void draw_layer(cairo_t *cr, const struct drawing *drawing,
                       uint32_t index) {
  const struct drawing_layer *layer = &drawing->layer.item[index];
  size_t points = 0; /* drawn since the last poll */
  draw_fills(cr, drawing, index);
  set_colour(cr, layer->colour);
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    if (stroke->layer != index)
      continue;
    points += STROKE_POINTS + stroke->count;
    if (points >= POLL_POINTS && !poll_now())
      return;
    points %= POLL_POINTS;
    cairo_set_line_width(cr, drawing_width_mm(drawing, stroke));
    const struct drawing_curve *curve = drawing_curve_of(drawing, i);
    if (curve != NULL)
      add_cairo_curve(cr, drawing->control.item + curve->control, curve->count,
                      stroke->closed);
    else
      add_cairo_path(cr, drawing->point.item + stroke->point, stroke->count,
                     stroke->closed);
    cairo_stroke(cr);
  }
}

/* Draws the window on the surface at `scale` surface units per millimetre, with
 * its lower left corner at (0, foot). */
static cairo_status_t draw_window(cairo_surface_t *surface,
                                  const struct drawing *drawing,
                                  const struct drawing_window *window,
                                  double scale, double foot,
                                  const struct writer_options *options) {
  cairo_t *cr = cairo_create(surface);
  cairo_matrix_t matrix;
  cairo_status_t status;
  if (options->background == RECTO_BACKGROUND_COLOUR) {
    set_colour(cr, options->background_colour);
    cairo_paint(cr);
  }
  cairo_matrix_init(&matrix, scale, 0, 0, -scale, -window->x0 * scale,
                    foot + window->y0 * scale);
  cairo_set_matrix(cr, &matrix);
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  cairo_set_fill_rule(cr, CAIRO_FILL_RULE_EVEN_ODD);
  for (uint32_t i = 0; i < drawing->layer.count; i++)
    draw_layer(cr, drawing, i);
  if (poll_is_cancelled()) { /* what was drawn is not laid out */
    cairo_set_operator(cr, CAIRO_OPERATOR_CLEAR);
    cairo_paint(cr);
  }
  cairo_show_page(cr);
  status = cairo_status(cr);
  cairo_destroy(cr);
  return status;
}

/* Converts cairo's status.  A failed write is not reported here but by
 * stream_finish, which has the path and the reason.  If the stream has no
 * error, the write that failed was one of cairo's to its temporary file, in
 * which it keeps PS until the page ends; it is then recorded in the stream.
 * fault  errno of such a write */
static recto_status convert_status(cairo_status_t status, int fault,
                                   struct stream *stream, recto_error *error) {
  if (poll_is_cancelled())
    return error_cancelled(error);
  if (stream_status(stream) == RECTO_OK && status == CAIRO_STATUS_WRITE_ERROR)
    stream_fault(stream, fault);
  if (stream_status(stream) != RECTO_OK || status == CAIRO_STATUS_SUCCESS)
    return RECTO_OK;
  if (status == CAIRO_STATUS_NO_MEMORY)
    return error_memory(error);
  return error_set(error, RECTO_ERROR_LIMIT, NULL, 0, "cairo reports: %s",
                   cairo_status_to_string(status));
}

/* ---- PDF, PS, EPS -------------------------------------------------------- */

typedef cairo_surface_t *open_surface(struct sink *sink);
/* Sets the title and the description, clean UTF-8, as far as there are any. */
typedef void caption_surface(cairo_surface_t *surface, const char *title,
                             const char *description);

static double mm_to_points(double length_mm) {
  double points = length_mm * (POINTS_PER_INCH / MM_PER_INCH);
  return round(points * PAGE_STEPS_PER_POINT) / PAGE_STEPS_PER_POINT;
}

static recto_status write_vector(const struct drawing *drawing,
                                 const struct writer_options *options,
                                 struct stream *stream, recto_error *error,
                                 open_surface *open, caption_surface *caption) {
  const double scale = POINTS_PER_INCH / MM_PER_INCH;
  struct drawing_window window = drawing_window(drawing, options->tight);
  struct sink sink = {.stream = stream,
                      .in_header = true,
                      .width_pt = mm_to_points(window.x1 - window.x0),
                      .height_pt = mm_to_points(window.y1 - window.y0)};
  sink.foot_pt = sink.height_pt;
  char *title = utf8_clean(writer_title(drawing, options));
  char *description = utf8_clean(writer_description(drawing, options));
  if (title == NULL || description == NULL) {
    mem_free(title);
    mem_free(description);
    return error_memory(error);
  }
  errno = 0;
  cairo_surface_t *surface = open(&sink);
  caption(surface, title, description);
  mem_free(title);
  mem_free(description);
  cairo_status_t status =
      draw_window(surface, drawing, &window, scale, sink.foot_pt, options);
  cairo_surface_finish(surface);
  int fault = errno;
  if (status == CAIRO_STATUS_SUCCESS)
    status = cairo_surface_status(surface);
  cairo_surface_destroy(surface);
  return convert_status(status, fault, stream, error);
}

/* LaTeX includes PDF up to version 1.5 without a warning. */
static cairo_surface_t *open_pdf(struct sink *sink) {
  cairo_surface_t *surface = cairo_pdf_surface_create_for_stream(
      pass_bytes, sink, sink->width_pt, sink->height_pt);
  cairo_pdf_surface_restrict_to_version(surface, CAIRO_PDF_VERSION_1_5);
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE,
                                 FIXED_DATE);
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATOR, "recto");
  return surface;
}

static void caption_pdf(cairo_surface_t *surface, const char *title,
                        const char *description) {
  if (*title != '\0')
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, title);
  if (*description != '\0')
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_SUBJECT,
                                   description);
}

/* A comment of PS has at most 255 characters of ASCII. */
static void caption_ps(cairo_surface_t *surface, const char *title,
                       const char *description) {
  char comment[200] = "%%Title: ";
  size_t length = strlen(comment);
  (void)description;
  if (*title == '\0')
    return;
  for (; *title != '\0' && length + 1 < sizeof comment; title++)
    if ((*title & 0xc0) != 0x80) /* one for each character */
      comment[length++] = *title >= ' ' && *title <= '~' ? *title : '?';
  comment[length] = '\0';
  cairo_ps_surface_dsc_comment(surface, comment);
}

/* In PS the origin is the lower left corner of the page, and cairo assumes that
 * the page's height above it is a whole number of points. */
static cairo_surface_t *open_ps(struct sink *sink) {
  sink->foot_pt = ceil(sink->height_pt);
  return cairo_ps_surface_create_for_stream(pass_ps, sink, ceil(sink->width_pt),
                                            sink->foot_pt);
}

static cairo_surface_t *open_eps(struct sink *sink) {
  cairo_surface_t *surface = open_ps(sink);
  cairo_ps_surface_set_eps(surface, 1);
  sink->is_eps = true;
  return surface;
}

static recto_status write_pdf(const struct drawing *drawing,
                              const struct writer_options *options,
                              struct stream *stream, recto_error *error) {
  return write_vector(drawing, options, stream, error, open_pdf, caption_pdf);
}

static recto_status write_ps(const struct drawing *drawing,
                             const struct writer_options *options,
                             struct stream *stream, recto_error *error) {
  return write_vector(drawing, options, stream, error, open_ps, caption_ps);
}

static recto_status write_eps(const struct drawing *drawing,
                              const struct writer_options *options,
                              struct stream *stream, recto_error *error) {
  return write_vector(drawing, options, stream, error, open_eps, caption_ps);
}

/* ---- PNG ----------------------------------------------------------------- */

/* The number of pixels of a length.  A page is rounded to whole pixels, as
 * other programs do; a tight window is rounded up, so that no ink is cut
 * off. */
static double pixels(double length_mm, double dpi, bool tight) {
  double exact = length_mm * dpi / MM_PER_INCH;
  return fmax(1, tight ? ceil(exact) : round(exact));
}

static recto_status write_png(const struct drawing *drawing,
                              const struct writer_options *options,
                              struct stream *stream, recto_error *error) {
  double dpi = options->dpi == 0 ? DEFAULT_DPI : options->dpi;
  if (!(dpi > 0 && dpi < INFINITY))
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "a resolution is more than 0 dots per inch");
  struct drawing_window window = drawing_window(drawing, options->tight);
  double width = pixels(window.x1 - window.x0, dpi, options->tight);
  double height = pixels(window.y1 - window.y0, dpi, options->tight);
  if (width > MAX_PIXELS_A_SIDE || height > MAX_PIXELS_A_SIDE ||
      width * height > MAX_PIXELS)
    return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                     "%.0f x %.0f pixels are more than the limits of %.0f "
                     "per side and %.0f in all",
                     width, height, MAX_PIXELS_A_SIDE, MAX_PIXELS);

  struct sink sink = {.stream = stream,
                      .per_metre = (uint32_t)lround(dpi / MM_PER_INCH * 1000)};
  struct writer_options how = *options;
  if (how.background == RECTO_BACKGROUND_AUTO) {
    how.background = RECTO_BACKGROUND_COLOUR;
    how.background_colour = 0xffffff;
  }
  cairo_surface_t *surface = cairo_image_surface_create(
      how.background == RECTO_BACKGROUND_NONE ? CAIRO_FORMAT_ARGB32
                                              : CAIRO_FORMAT_RGB24,
      (int)width, (int)height);
  cairo_status_t status =
      draw_window(surface, drawing, &window, dpi / MM_PER_INCH,
                  (window.y1 - window.y0) * dpi / MM_PER_INCH, &how);
  if (status == CAIRO_STATUS_SUCCESS && !poll_is_cancelled())
    status = cairo_surface_write_to_png_stream(surface, pass_png, &sink);
  cairo_surface_destroy(surface);
  return convert_status(status, 0, stream, error);
}

/* cairo rounds the points of paths to 1/256 of the surface's unit, which is a
 * point in PDF, EPS and PS, and a pixel in PNG. */
#define STEPS_PER_UNIT 256

static double find_point(const struct writer_options *options) {
  (void)options;
  return MM_PER_INCH / POINTS_PER_INCH / STEPS_PER_UNIT;
}

static double find_pixel(const struct writer_options *options) {
  double dpi = options->dpi == 0 ? DEFAULT_DPI : options->dpi;
  return dpi > 0 ? MM_PER_INCH / dpi / STEPS_PER_UNIT : 0;
}

/* Two pixels, whatever part of one the border between two fills cuts off. */
static double find_pixel_seam(const struct writer_options *options) {
  return 2 * STEPS_PER_UNIT * find_pixel(options);
}

const struct writer writer_pdf = {.name = "pdf",
                                  .extensions = "pdf",
                                  .unit_mm = find_point,
                                  .seam_mm = writer_screen_seam_mm,
                                  .write = write_pdf};
const struct writer writer_eps = {.name = "eps",
                                  .extensions = "eps",
                                  .unit_mm = find_point,
                                  .seam_mm = writer_screen_seam_mm,
                                  .write = write_eps};
const struct writer writer_ps = {.name = "ps",
                                 .extensions = "ps",
                                 .unit_mm = find_point,
                                 .seam_mm = writer_screen_seam_mm,
                                 .write = write_ps};
const struct writer writer_png = {.name = "png",
                                  .extensions = "png",
                                  .unit_mm = find_pixel,
                                  .seam_mm = find_pixel_seam,
                                  .write = write_png};
