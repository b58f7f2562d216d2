/* writer_svg.c - writes SVG at true scale, with one top-level group per layer.
 *
 * Each stroke is one path.  Only elements that the drivers of plotters support
 * are used.  Equal drawings give equal bytes: there is no date, version or file
 * path, the order of attributes is fixed, and numbers are rounded once, to the
 * requested number of decimals, and written without exponents or trailing
 * zeros.  The y axis of SVG points down; the page's y is reversed in the
 * numbers, not by a transform. */
#include <string.h>

#include "backends/svg_batch.h"
#include "backends/svg_text.h"

/* ---- Text ---------------------------------------------------------------- */

/* Lengths that are not coordinates have at least three decimals, whatever the
 * precision: a pen width of 0.3 mm must not become 0. */
static void write_length(const struct svg *svg, double mm) {
  int decimals = svg->options->precision;
  stream_number(svg->out, mm, decimals > 3 ? decimals : 3);
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
static bool write_seams(struct svg *svg, struct svg_batch *batch,
                        uint32_t layer) {
  const struct drawing *drawing = svg->drawing;
  bool open = false;
  svg_batch_begin(batch, svg, SVG_SEAM, layer);
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
    if (!svg_batch_write(batch, i))
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
  bool named = svg->ids.id != NULL && group < drawing->group_name.count &&
               svg->ids.id[group] != NULL;
  if (!named)
    group = DRAWING_NONE;
  if (open->group == group)
    return;
  close_nesting(svg, open);
  open->group = group;
  if (!named)
    return;
  stream_text(svg->out, "<g");
  write_layer_id(svg, open->layer, svg->ids.id[group]);
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
static bool write_contents(struct svg *svg, struct svg_batch *batch,
                           uint32_t index) {
  const struct drawing *drawing = svg->drawing;
  double layer_mm = drawing->layer.item[index].width_mm;
  struct svg_nesting open = {.layer = index, .group = DRAWING_NONE};
  bool ok = write_seams(svg, batch, index);
  svg_batch_begin(batch, svg, SVG_FILL, index);
  for (uint32_t i = 0; i < drawing->fill.count && ok; i++)
    if (drawing->fill.item[i].layer == index) {
      if (!writer_goes_on(drawing, svg->out, i))
        break;
      open_group(svg, &open, drawing->fill.item[i].group);
      open_class(svg, &open, "fill", layer_mm);
      ok = svg_batch_write(batch, i);
    }
  svg_batch_begin(batch, svg, SVG_STROKE, index);
  for (size_t i = 0; i < drawing->stroke.count && ok; i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    if (stroke->layer != index)
      continue;
    if (!writer_goes_on(drawing, svg->out, drawing->fill.count + i))
      break;
    open_group(svg, &open, stroke->group);
    open_class(svg, &open, stroke->hidden ? "hidden" : svg_class_name(stroke),
               drawing_width_mm(drawing, stroke));
    ok = svg_batch_write(batch, (uint32_t)i);
  }
  close_nesting(svg, &open);
  return ok;
}

static bool write_layer(struct svg *svg, struct svg_batch *batch,
                        uint32_t index) {
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
  if (!write_contents(svg, batch, index))
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
  bool ok =
      !drawing->by_groups || svg_ids_init(&svg.ids, drawing->group_name.item,
                                          drawing->group_name.count);
  struct svg_batch batch = {0};
  write_head(&svg);
  for (uint32_t i = 0; i < drawing->layer.count && ok; i++)
    ok = write_layer(&svg, &batch, i);
  stream_text(stream, "</svg>\n");
  svg_batch_fini(&batch);
  ARRAY_FREE(&svg.point);
  ARRAY_FREE(&svg.chords.point);
  svg_ids_fini(&svg.ids);
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
