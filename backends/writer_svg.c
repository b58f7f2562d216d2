/* writer_svg.c - writes SVG at true scale, with one top-level group per layer.
 *
 * Each stroke is one path.  Only elements that the drivers of plotters support
 * are used.  Equal drawings give equal bytes: there is no date, version or file
 * path, the order of attributes is fixed, and numbers are rounded once, to the
 * requested number of decimals, and written without exponents or trailing
 * zeros.  The y axis of SVG points down; the page's y is reversed in the
 * numbers, not by a transform. */
#include <math.h>
#include <string.h>

#include "backends/writer.h"

/* A point rounded to the last decimal that is written, y down. */
struct svg_point {
  int64_t x, y;
};

struct svg {
  const struct drawing *drawing;
  const struct writer_options *options;
  struct stream *out;
  double scale;                   /* 10 to the power of the precision */
  ARRAY(struct svg_point) point;  /* of the current stroke or loop */
  struct drawing_polyline chords; /* of the current stroke's curve */
};

/* ---- Text ---------------------------------------------------------------- */

/* The length of the well-formed UTF-8 sequence at `text` if it is a character
 * that XML 1.0 allows, else 0. */
static size_t measure_character(const unsigned char *text) {
  static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  size_t length = text[0] < 0x80             ? 1
                  : (text[0] & 0xe0) == 0xc0 ? 2
                  : (text[0] & 0xf0) == 0xe0 ? 3
                  : (text[0] & 0xf8) == 0xf0 ? 4
                                             : 0;
  if (length == 0)
    return 0;
  uint32_t code = length == 1 ? text[0] : text[0] & (0x7fu >> length);
  for (size_t i = 1; i < length; i++) {
    if ((text[i] & 0xc0) != 0x80)
      return 0;
    code = code << 6 | (text[i] & 0x3fu);
  }
  bool allowed = code == '\t' || code == '\n' || code == '\r' ||
                 (code >= 0x20 && code < 0xd800) ||
                 (code >= 0xe000 && code < 0xfffe) ||
                 (code >= 0x10000 && code < 0x110000);
  return allowed && code >= least[length] ? length : 0;
}

/* Writes `text` as the value of an attribute.  Bytes that are not part of a
 * character of XML, as in a name that is not UTF-8, are replaced by U+FFFD. */
static void write_escaped(struct stream *out, const char *text) {
  const unsigned char *at = (const unsigned char *)text;
  while (*at != '\0') {
    size_t length = measure_character(at);
    switch (*at) {
    case '&':
      stream_text(out, "&amp;");
      break;
    case '<':
      stream_text(out, "&lt;");
      break;
    case '>':
      stream_text(out, "&gt;");
      break;
    case '"':
      stream_text(out, "&quot;");
      break;
    case '\t':
      stream_text(out, "&#9;");
      break;
    case '\n':
      stream_text(out, "&#10;");
      break;
    case '\r':
      stream_text(out, "&#13;");
      break;
    default:
      if (length > 0)
        stream_write(out, at, length);
      else
        stream_text(out, "\xef\xbf\xbd");
    }
    at += length > 0 ? length : 1;
  }
}

static void write_colour(struct stream *out, uint32_t colour) {
  static const char digit[] = "0123456789abcdef";
  char text[8] = "#";
  for (int i = 0; i < 6; i++)
    text[1 + i] = digit[colour >> (20 - 4 * i) & 0xf];
  stream_write(out, text, 7);
}

/* Lengths that are not coordinates have at least three decimals, whatever the
 * precision: a pen width of 0.3 mm must not become 0. */
static void write_length(const struct svg *svg, double mm) {
  int decimals = svg->options->precision;
  stream_number(svg->out, mm, decimals > 3 ? decimals : 3);
}

/* ---- Geometry ------------------------------------------------------------ */

static struct svg_point round_point(const struct svg *svg,
                                    struct drawing_point p) {
  return (struct svg_point){
      llround(p.x * svg->scale),
      llround((svg->drawing->height_mm - p.y) * svg->scale)};
}

/* Rounds points to svg->point, without those that repeat the previous one, and
 * if `closed`, without those at the end that repeat the first.  Returns false
 * when memory ran out. */
static bool round_points(struct svg *svg, const struct drawing_point *from,
                         uint32_t count, bool closed) {
  svg->point.count = 0;
  for (uint32_t i = 0; i < count; i++) {
    struct svg_point p = round_point(svg, from[i]);
    const struct svg_point *last = ARRAY_AT(&svg->point, svg->point.count);
    if (svg->point.count > 0 && last[-1].x == p.x && last[-1].y == p.y)
      continue;
    if (!ARRAY_PUSH(&svg->point, p))
      return false;
  }
  while (closed && svg->point.count > 1 &&
         svg->point.item[svg->point.count - 1].x == svg->point.item[0].x &&
         svg->point.item[svg->point.count - 1].y == svg->point.item[0].y)
    svg->point.count--;
  return true;
}

static void write_point(const struct svg *svg, struct svg_point p,
                        char separator) {
  stream_number(svg->out, (double)p.x / svg->scale, svg->options->precision);
  stream_write(svg->out, &separator, 1);
  stream_number(svg->out, (double)p.y / svg->scale, svg->options->precision);
}

/* Writes svg->point as path data. */
static void write_path_data(const struct svg *svg, bool closed) {
  for (size_t i = 0; i < svg->point.count; i++) {
    stream_text(svg->out, i == 0 ? "M" : "L");
    write_point(svg, svg->point.item[i], ' ');
  }
  if (closed)
    stream_text(svg->out, "Z");
}

/* Writes a curve as path data, without straight pieces that rounding has
 * reduced to a point. */
static void write_curve_data(const struct svg *svg,
                             const struct drawing_curve *curve, bool closed) {
  const struct drawing_point *control =
      svg->drawing->control.item + curve->control;
  struct svg_point last = round_point(svg, control[0]);
  stream_text(svg->out, "M");
  write_point(svg, last, ' ');
  for (uint32_t i = 0; i + 3 < curve->count; i += 3) {
    struct svg_point end = round_point(svg, control[i + 3]);
    bool straight = drawing_piece_is_straight(control + i);
    if (straight && end.x == last.x && end.y == last.y)
      continue;
    stream_text(svg->out, straight ? "L" : "C");
    for (uint32_t k = straight ? 3 : 1; k <= 3; k++) {
      write_point(svg, round_point(svg, control[i + k]), ' ');
      if (k < 3)
        stream_text(svg->out, " ");
    }
    last = end;
  }
  if (closed)
    stream_text(svg->out, "Z");
}

/* Writes svg->point as the points of a polyline or polygon. */
static void write_point_list(const struct svg *svg) {
  for (size_t i = 0; i < svg->point.count; i++) {
    if (i > 0)
      stream_text(svg->out, " ");
    write_point(svg, svg->point.item[i], ',');
  }
}

/* ---- Elements ------------------------------------------------------------ */

static void write_id(const struct svg *svg, const char *name, uint32_t id) {
  if (id == DRAWING_NONE)
    return;
  stream_text(svg->out, name);
  stream_int(svg->out, id);
  stream_text(svg->out, "\"");
}

static void write_group_name(const struct svg *svg, uint32_t group) {
  if (group >= svg->drawing->group_name.count ||
      svg->drawing->group_name.item[group] == NULL)
    return;
  stream_text(svg->out, " data-group=\"");
  write_escaped(svg->out, svg->drawing->group_name.item[group]);
  stream_text(svg->out, "\"");
}

static const char *class_name(const struct drawing_stroke *stroke) {
  return stroke->edge_class == 0
             ? "hatch"
             : recto_edge_class_name((recto_edge_class)stroke->edge_class);
}

static void write_stroke_ids(const struct svg *svg,
                             const struct drawing_stroke *stroke) {
  write_id(svg, " data-face=\"", stroke->face);
  write_id(svg, " data-edge=\"", stroke->edge);
  write_group_name(svg, stroke->group);
  stream_text(svg->out, " data-class=\"");
  stream_text(svg->out, class_name(stroke));
  stream_text(svg->out, "\"");
}

/* Rounds the points of a stroke to svg->point: if elements have no curves,
 * those of a polyline within half a step of its curve. */
static bool round_stroke(struct svg *svg, const struct drawing_stroke *stroke,
                         const struct drawing_curve *curve) {
  const struct drawing *drawing = svg->drawing;
  if (curve == NULL || !svg->options->polyline)
    return round_points(svg, drawing->point.item + stroke->point, stroke->count,
                        stroke->closed);
  return drawing_flatten(drawing, stroke, curve, 0.5 / svg->scale,
                         &svg->chords) &&
         round_points(svg, svg->chords.point.item,
                      (uint32_t)svg->chords.point.count, stroke->closed);
}

/* Writes a stroke, unless rounding has reduced it to one point.  Returns false
 * when memory ran out. */
static bool write_stroke(struct svg *svg, uint32_t index) {
  const struct drawing_stroke *stroke = &svg->drawing->stroke.item[index];
  const struct drawing_curve *curve = drawing_curve_of(svg->drawing, index);
  if (!round_stroke(svg, stroke, curve))
    return false;
  if (svg->point.count < 2)
    return true;
  /* A loop of two points is a line, and written as one. */
  bool closed = stroke->closed && svg->point.count > 2;
  bool polyline = svg->options->polyline;
  stream_text(svg->out, !polyline ? "<path"
                        : closed  ? "<polygon"
                                  : "<polyline");
  if (svg->drawing->ids)
    write_stroke_ids(svg, stroke);
  stream_text(svg->out, polyline ? " points=\"" : " d=\"");
  if (polyline)
    write_point_list(svg);
  else if (curve != NULL)
    write_curve_data(svg, curve, closed);
  else
    write_path_data(svg, closed);
  stream_text(svg->out, "\"/>\n");
  return true;
}

/* Begins the element of a fill, or of the stroke along its outline that closes
 * seams.  The latter inherits everything but its colour from its group. */
static void open_fill(const struct svg *svg, const struct drawing_fill *fill,
                      bool seam) {
  struct stream *out = svg->out;
  stream_text(out, "<path");
  if (svg->drawing->ids && !seam) {
    write_id(svg, " data-face=\"", fill->face);
    write_group_name(svg, fill->group);
  }
  stream_text(out, seam ? " stroke=\"" : " fill=\"");
  write_colour(out, fill->colour);
  stream_text(out, seam ? "\" d=\""
                        : "\" fill-rule=\"evenodd\" stroke=\"none\" d=\"");
}

/* Writes a fill, or its seam stroke, unless rounding has reduced all loops to
 * fewer than three points.  Returns false when memory ran out. */
static bool write_fill(struct svg *svg, const struct drawing_fill *fill,
                       bool seam) {
  bool open = false;
  for (uint32_t i = 0; i < fill->loops; i++) {
    const struct drawing_loop *loop = &svg->drawing->loop.item[fill->loop + i];
    if (!round_points(svg, svg->drawing->point.item + loop->point, loop->count,
                      true))
      return false;
    if (svg->point.count < 3)
      continue;
    if (!open)
      open_fill(svg, fill, seam);
    open = true;
    write_path_data(svg, true);
  }
  if (open)
    stream_text(svg->out, "\"/>\n");
  return true;
}

/* Writes the strokes that close the seams of a layer's fills.  They come before
 * all fills of the layer, so that they do not paint over any of them. */
static bool write_seams(struct svg *svg, uint32_t layer) {
  const struct drawing *drawing = svg->drawing;
  bool open = false;
  for (size_t i = 0; drawing->seam_mm > 0 && i < drawing->fill.count; i++) {
    if (drawing->fill.item[i].layer != layer)
      continue;
    if (stream_status(svg->out) != RECTO_OK)
      break;
    if (!open) {
      stream_text(svg->out, "<g class=\"seam\" stroke-width=\"");
      write_length(svg, drawing->seam_mm);
      stream_text(svg->out, "\">\n");
      open = true;
    }
    if (!write_fill(svg, &drawing->fill.item[i], true))
      return false;
  }
  if (open)
    stream_text(svg->out, "</g>\n");
  return true;
}

/* The current group within a layer: strokes of one class and width, or fills.
 * It lets style sheets address the class; a group takes less space than an
 * attribute of every line. */
struct svg_stroke_style {
  const char *name; /* the class; NULL: no group is open */
  double width_mm;
};

static void close_style(const struct svg *svg, struct svg_stroke_style *style) {
  if (style->name != NULL)
    stream_text(svg->out, "</g>\n");
  style->name = NULL;
}

/* Opens a group of that class and width unless it is open.  The width is
 * written only if it differs from the layer's. */
static void open_style(const struct svg *svg, struct svg_stroke_style *style,
                       const char *name, double width_mm, double layer_mm) {
  if (style->name != NULL && strcmp(style->name, name) == 0 &&
      style->width_mm == width_mm)
    return;
  close_style(svg, style);
  stream_text(svg->out, "<g class=\"");
  stream_text(svg->out, name);
  if (width_mm != layer_mm) {
    stream_text(svg->out, "\" stroke-width=\"");
    write_length(svg, width_mm);
  }
  stream_text(svg->out, "\">\n");
  *style = (struct svg_stroke_style){name, width_mm};
}

/* Writes the fills of a layer, then its strokes. */
static bool write_contents(struct svg *svg, uint32_t index) {
  const struct drawing *drawing = svg->drawing;
  double width_mm = drawing->layer.item[index].width_mm;
  struct svg_stroke_style style = {NULL, 0};
  bool ok = write_seams(svg, index);
  for (size_t i = 0; i < drawing->fill.count && ok; i++)
    if (drawing->fill.item[i].layer == index) {
      if (!writer_goes_on(drawing, svg->out, i))
        break;
      open_style(svg, &style, "fill", width_mm, width_mm);
      ok = write_fill(svg, &drawing->fill.item[i], false);
    }
  for (size_t i = 0; i < drawing->stroke.count && ok; i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    if (stroke->layer != index)
      continue;
    if (!writer_goes_on(drawing, svg->out, drawing->fill.count + i))
      break;
    open_style(svg, &style, stroke->hidden ? "hidden" : class_name(stroke),
               drawing_width_mm(drawing, stroke), width_mm);
    ok = write_stroke(svg, (uint32_t)i);
  }
  close_style(svg, &style);
  return ok;
}

static bool write_layer(struct svg *svg, uint32_t index) {
  const struct drawing_layer *layer = &svg->drawing->layer.item[index];
  struct stream *out = svg->out;
  stream_text(out, layer->pen > 0 ? "<g id=\"layer" : "<g id=\"fills");
  if (layer->pen > 0)
    stream_int(out, layer->pen);
  stream_text(out, "\" inkscape:groupmode=\"layer\" inkscape:label=\"");
  write_escaped(out, layer->label);
  stream_text(out, "\" fill=\"none\" stroke=\"");
  write_colour(out, layer->colour);
  stream_text(out, "\" stroke-width=\"");
  write_length(svg, layer->width_mm);
  stream_text(out, "\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n");
  if (!write_contents(svg, index))
    return false;
  stream_text(out, "</g>\n");
  return true;
}

/* Lengths of the page, which has its origin at the upper left corner also where
 * only the box of the ink is shown: the coordinates are the same then. */
static void write_head(const struct svg *svg) {
  struct stream *out = svg->out;
  struct drawing_window window =
      drawing_window(svg->drawing, svg->options->tight);
  const double box[] = {window.x0, svg->drawing->height_mm - window.y1,
                        window.x1 - window.x0, window.y1 - window.y0};
  stream_text(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                   "<svg xmlns=\"http://www.w3.org/2000/svg\" "
                   "xmlns:inkscape=\"http://www.inkscape.org/namespaces/"
                   "inkscape\" width=\"");
  write_length(svg, box[2]);
  stream_text(out, "mm\" height=\"");
  write_length(svg, box[3]);
  stream_text(out, "mm\" viewBox=\"");
  for (int i = 0; i < 4; i++) {
    stream_text(out, i > 0 ? " " : "");
    write_length(svg, box[i]);
  }
  stream_text(out, "\">\n");
}

static recto_status write_svg(const struct drawing *drawing,
                              const struct writer_options *options,
                              struct stream *stream, recto_error *error) {
  struct svg svg = {
      .drawing = drawing, .options = options, .out = stream, .scale = 1};
  for (int i = 0; i < options->precision; i++)
    svg.scale *= 10;
  bool ok = true;
  write_head(&svg);
  for (uint32_t i = 0; i < drawing->layer.count && ok; i++)
    ok = write_layer(&svg, i);
  stream_text(stream, "</svg>\n");
  ARRAY_FREE(&svg.point);
  ARRAY_FREE(&svg.chords.point);
  return ok ? RECTO_OK : error_memory(error);
}

static double svg_unit(const struct writer_options *options) {
  double unit = 1;
  for (int i = 0; i < options->precision; i++)
    unit /= 10;
  return unit;
}

static double svg_seam(const struct writer_options *options) {
  (void)options;
  return WRITER_SCREEN_SEAM_MM;
}

const struct writer writer_svg = {.name = "svg",
                                  .extensions = "svg",
                                  .compressed = "svgz svg.gz",
                                  .unit_mm = svg_unit,
                                  .seam_mm = svg_seam,
                                  .has_layers = true,
                                  .write = write_svg};
