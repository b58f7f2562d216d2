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

#include "backends/svg_text.h"
#include "backends/writer.h"
#include "base/number.h"

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
  char **group_id;                /* by groups: of each, or NULL */
};

/* ---- Text ---------------------------------------------------------------- */

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
  char text[2 * NUMBER_TEXT_SIZE];
  int decimals = svg->options->precision;
  size_t count = number_format_scaled(text, p.x, decimals);
  text[count++] = separator;
  count += number_format_scaled(text + count, p.y, decimals);
  stream_write(svg->out, text, count);
}

/* Writes a step from one point to another, after another number unless it is
 * the first one of its command; without a 0 before the decimal point. */
static void write_step(const struct svg *svg, struct svg_point from,
                       struct svg_point to, bool first) {
  const int64_t step[2] = {to.x - from.x, to.y - from.y};
  for (int k = 0; k < 2; k++) {
    char text[NUMBER_TEXT_SIZE];
    size_t count = number_format_scaled(text, step[k], svg->options->precision);
    size_t sign = text[0] == '-';
    if (!(first && k == 0) && sign == 0)
      stream_text(svg->out, " ");
    stream_write(svg->out, text, sign);
    if (count > sign + 1 && text[sign] == '0')
      sign++;
    stream_write(svg->out, text + sign, count - sign);
  }
}

/* Writes svg->point as path data; relative where others are curves, for a
 * smaller file. */
static void write_path_data(const struct svg *svg, bool closed) {
  bool relative = svg->drawing->control.count > 0;
  for (size_t i = 0; i < svg->point.count; i++) {
    const struct svg_point *p = &svg->point.item[i];
    if (i < 2 || !relative)
      stream_text(svg->out, i == 0 ? "M" : relative ? "l" : "L");
    if (i > 0 && relative)
      write_step(svg, p[-1], *p, i == 1);
    else
      write_point(svg, *p, ' ');
  }
  if (closed)
    stream_text(svg->out, "Z");
}

/* Writes a curve as path data, without straight pieces that rounding has
 * reduced to a point.  Its points are relative, which takes fewer bytes:
 * differences of rounded ones, so that they add up to these.  A command is not
 * repeated. */
static void write_curve_data(const struct svg *svg,
                             const struct drawing_curve *curve, bool closed) {
  const struct drawing_point *control =
      svg->drawing->control.item + curve->control;
  struct svg_point last = round_point(svg, control[0]);
  const char *command = "M";
  stream_text(svg->out, command);
  write_point(svg, last, ' ');
  for (uint32_t i = 0; i + 3 < curve->count; i += 3) {
    struct svg_point end = round_point(svg, control[i + 3]);
    bool straight = drawing_piece_is_straight(control + i);
    if (straight && end.x == last.x && end.y == last.y)
      continue;
    bool first = *command != (straight ? 'l' : 'c');
    command = straight ? "l" : "c";
    if (first)
      stream_text(svg->out, command);
    for (uint32_t k = straight ? 3 : 1; k <= 3; k++, first = false)
      write_step(svg, last, round_point(svg, control[i + k]), first);
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

static const char *class_name(const struct drawing_stroke *stroke) {
  return stroke->text ? "text"
         : stroke->edge_class == 0
             ? "hatch"
             : recto_edge_class_name((recto_edge_class)stroke->edge_class);
}

static void write_stroke_ids(const struct svg *svg,
                             const struct drawing_stroke *stroke,
                             uint32_t index) {
  struct drawing_source source = {stroke->face, stroke->edge};
  if (index < svg->drawing->stroke_source.count)
    source = svg->drawing->stroke_source.item[index];
  write_id(svg, " data-face=\"", source.face);
  write_id(svg, " data-edge=\"", source.edge);
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
    write_stroke_ids(svg, stroke, index);
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
static void open_fill(const struct svg *svg, uint32_t index, bool seam) {
  const struct drawing *drawing = svg->drawing;
  const struct drawing_fill *fill = &drawing->fill.item[index];
  struct stream *out = svg->out;
  stream_text(out, "<path");
  if (drawing->ids && !seam)
    write_id(svg, " data-face=\"",
             index < drawing->fill_source.count
                 ? drawing->fill_source.item[index].face
                 : fill->face);
  stream_text(out, seam ? " stroke=\"" : " fill=\"");
  svg_write_colour(out, fill->colour);
  stream_text(out, seam ? "\" d=\""
                        : "\" fill-rule=\"evenodd\" stroke=\"none\" d=\"");
}

/* Writes a fill, or its seam stroke, unless rounding has reduced all loops to
 * fewer than three points.  Returns false when memory ran out. */
static bool write_fill(struct svg *svg, uint32_t index, bool seam) {
  const struct drawing_fill *fill = &svg->drawing->fill.item[index];
  bool open = false;
  for (uint32_t i = 0; i < fill->loops; i++) {
    const struct drawing_loop *loop = &svg->drawing->loop.item[fill->loop + i];
    if (!round_points(svg, svg->drawing->point.item + loop->point, loop->count,
                      true))
      return false;
    if (svg->point.count < 3)
      continue;
    if (!open)
      open_fill(svg, index, seam);
    open = true;
    write_path_data(svg, true);
  }
  if (open)
    stream_text(svg->out, "\"/>\n");
  return true;
}

/* Writes the beginning of an element of a class, up to the end of the class's
 * name; with a prefix of ids the class also has a name with that, by which one
 * of several drawings is styled. */
static void write_class(const struct svg *svg, const char *element,
                        const char *name) {
  const char *prefix = svg->options->id_prefix;
  stream_text(svg->out, "<");
  stream_text(svg->out, element);
  stream_text(svg->out, " class=\"");
  stream_text(svg->out, name);
  if (prefix != NULL && *prefix != '\0') {
    stream_text(svg->out, " ");
    stream_text(svg->out, prefix);
    stream_text(svg->out, name);
  }
}

/* Writes the strokes that close the seams of a layer's fills.  They come before
 * all fills of the layer, so that they do not paint over any of them. */
static bool write_seams(struct svg *svg, uint32_t layer) {
  const struct drawing *drawing = svg->drawing;
  bool open = false;
  for (uint32_t i = 0; drawing->seam_mm > 0 && i < drawing->fill.count; i++) {
    if (drawing->fill.item[i].layer != layer)
      continue;
    if (stream_status(svg->out) != RECTO_OK)
      break;
    if (!open) {
      write_class(svg, "g", "seam");
      stream_text(svg->out, "\" stroke-width=\"");
      write_length(svg, drawing->seam_mm);
      stream_text(svg->out, "\">\n");
      open = true;
    }
    if (!write_fill(svg, i, true))
      return false;
  }
  if (open)
    stream_text(svg->out, "</g>\n");
  return true;
}

/* What is open within a layer: the group of the model, and in it a
 * class of strokes of one width, or fills.  Style sheets address both; a group
 * takes less space than an attribute of every line. */
struct svg_nesting {
  uint32_t layer;
  uint32_t group;   /* DRAWING_NONE: none is open */
  const char *name; /* the class; NULL: none is open */
  double width_mm;
};

static void close_class(const struct svg *svg, struct svg_nesting *open) {
  if (open->name != NULL)
    stream_text(svg->out, "</g>\n");
  open->name = NULL;
}

static void close_nesting(const struct svg *svg, struct svg_nesting *open) {
  close_class(svg, open);
  if (open->group != DRAWING_NONE)
    stream_text(svg->out, "</g>\n");
  open->group = DRAWING_NONE;
}

/* Writes id="PREFIXlayer1" and, of a group in it, id="PREFIXlayer1-group"; that
 * of a pen's hidden lines is hidden1, and the layer of fills is named so.  A
 * view's begin with its name: "front-layer1". */
static void write_layer_id(const struct svg *svg, uint32_t layer,
                           const char *group) {
  unsigned pen = svg->drawing->layer.item[layer].pen;
  const char *view = svg->drawing->layer.item[layer].view;
  bool hidden = svg->drawing->layer.item[layer].hidden;
  struct stream *out = svg->out;
  stream_text(out, " id=\"");
  if (svg->options->id_prefix != NULL)
    stream_text(out, svg->options->id_prefix);
  if (view != NULL) {
    stream_text(out, view);
    stream_text(out, "-");
  }
  stream_text(out, pen == 0 ? "fills" : hidden ? "hidden" : "layer");
  if (pen > 0)
    stream_int(out, pen);
  if (group != NULL) {
    stream_text(out, "-");
    stream_text(out, group);
  }
  stream_text(out, "\"");
}

/* Opens the model's group, if groups are elements and it has a name, unless it
 * is open. */
static void open_group(const struct svg *svg, struct svg_nesting *open,
                       uint32_t group) {
  const struct drawing *drawing = svg->drawing;
  bool named = svg->group_id != NULL && group < drawing->group_name.count &&
               svg->group_id[group] != NULL;
  if (!named)
    group = DRAWING_NONE;
  if (open->group == group)
    return;
  close_nesting(svg, open);
  open->group = group;
  if (!named)
    return;
  stream_text(svg->out, "<g");
  write_layer_id(svg, open->layer, svg->group_id[group]);
  stream_text(svg->out, " data-group=\"");
  svg_write_text(svg->out, drawing->group_name.item[group]);
  stream_text(svg->out, "\">\n");
}

/* Opens a group of that class and width unless it is open.  The width is
 * written only if it differs from the layer's. */
static void open_class(const struct svg *svg, struct svg_nesting *open,
                       const char *name, double width_mm) {
  if (open->name != NULL && strcmp(open->name, name) == 0 &&
      open->width_mm == width_mm)
    return;
  close_class(svg, open);
  write_class(svg, "g", name);
  if (width_mm != svg->drawing->layer.item[open->layer].width_mm) {
    stream_text(svg->out, "\" stroke-width=\"");
    write_length(svg, width_mm);
  }
  stream_text(svg->out, "\">\n");
  open->name = name;
  open->width_mm = width_mm;
}

/* Writes the fills of a layer, then its strokes. */
static bool write_contents(struct svg *svg, uint32_t index) {
  const struct drawing *drawing = svg->drawing;
  double layer_mm = drawing->layer.item[index].width_mm;
  struct svg_nesting open = {.layer = index, .group = DRAWING_NONE};
  bool ok = write_seams(svg, index);
  for (uint32_t i = 0; i < drawing->fill.count && ok; i++)
    if (drawing->fill.item[i].layer == index) {
      if (!writer_goes_on(drawing, svg->out, i))
        break;
      open_group(svg, &open, drawing->fill.item[i].group);
      open_class(svg, &open, "fill", layer_mm);
      ok = write_fill(svg, i, false);
    }
  for (size_t i = 0; i < drawing->stroke.count && ok; i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    if (stroke->layer != index)
      continue;
    if (!writer_goes_on(drawing, svg->out, drawing->fill.count + i))
      break;
    open_group(svg, &open, stroke->group);
    open_class(svg, &open, stroke->hidden ? "hidden" : class_name(stroke),
               drawing_width_mm(drawing, stroke));
    ok = write_stroke(svg, (uint32_t)i);
  }
  close_nesting(svg, &open);
  return ok;
}

static bool write_layer(struct svg *svg, uint32_t index) {
  const struct drawing_layer *layer = &svg->drawing->layer.item[index];
  struct stream *out = svg->out;
  stream_text(out, "<g");
  write_layer_id(svg, index, NULL);
  stream_text(out, " inkscape:groupmode=\"layer\" inkscape:label=\"");
  svg_write_text(out, layer->label);
  stream_text(out, "\" fill=\"none\" stroke=\"");
  svg_write_colour(out, layer->colour);
  stream_text(out, "\" stroke-width=\"");
  write_length(svg, layer->width_mm);
  stream_text(out, "\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n");
  if (!write_contents(svg, index))
    return false;
  stream_text(out, "</g>\n");
  return true;
}

/* Writes an element with text, unless there is none. */
static void write_element(const struct svg *svg, const char *name,
                          const char *text) {
  if (*text == '\0')
    return;
  stream_text(svg->out, "<");
  stream_text(svg->out, name);
  stream_text(svg->out, ">");
  svg_write_text(svg->out, text);
  stream_text(svg->out, "</");
  stream_text(svg->out, name);
  stream_text(svg->out, ">\n");
}

/* box  x, y, width, height */
static void write_background(const struct svg *svg, const double box[4]) {
  static const char *const side[] = {"x", "y", "width", "height"};
  write_class(svg, "rect", "background");
  stream_text(svg->out, "\" fill=\"");
  svg_write_colour(svg->out, svg->options->background_colour);
  for (int i = 0; i < 4; i++) {
    stream_text(svg->out, "\" ");
    stream_text(svg->out, side[i]);
    stream_text(svg->out, "=\"");
    write_length(svg, box[i]);
  }
  stream_text(svg->out, "\"/>\n");
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
  write_element(svg, "title", writer_title(svg->drawing, svg->options));
  write_element(svg, "desc", writer_description(svg->drawing, svg->options));
  if (svg->options->background == RECTO_BACKGROUND_COLOUR)
    write_background(svg, box);
}

static recto_status write_svg(const struct drawing *drawing,
                              const struct writer_options *options,
                              struct stream *stream, recto_error *error) {
  struct svg svg = {
      .drawing = drawing, .options = options, .out = stream, .scale = 1};
  for (int i = 0; i < options->precision; i++)
    svg.scale *= 10;
  if (drawing->by_groups)
    svg.group_id =
        svg_ids_make(drawing->group_name.item, drawing->group_name.count);
  bool ok = !drawing->by_groups || svg.group_id != NULL;
  write_head(&svg);
  for (uint32_t i = 0; i < drawing->layer.count && ok; i++)
    ok = write_layer(&svg, i);
  stream_text(stream, "</svg>\n");
  ARRAY_FREE(&svg.point);
  ARRAY_FREE(&svg.chords.point);
  svg_ids_free(svg.group_id, drawing->group_name.count);
  return ok ? RECTO_OK : error_memory(error);
}

static double svg_unit(const struct writer_options *options) {
  double unit = 1;
  for (int i = 0; i < options->precision; i++)
    unit /= 10;
  return unit;
}

const struct writer writer_svg = {.name = "svg",
                                  .extensions = "svg",
                                  .compressed = "svgz svg.gz",
                                  .unit_mm = svg_unit,
                                  .seam_mm = writer_screen_seam_mm,
                                  .has_layers = true,
                                  .write = write_svg};
