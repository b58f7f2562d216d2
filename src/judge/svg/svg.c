/* svg.c - reads the stroked lines of an SVG file, in mm of its page.
 *
 * Groups, transforms, styles and a viewBox are interpreted; shapes become their
 * outlines.  What would need a full renderer is an error: references (use), and
 * an svg element within another.  Style sheets are not interpreted: where there
 * is one, an element without a stroke or fill of its own counts as drawn.
 */
#include "judge/svg/svg.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "judge/svg/svg_path.h"
#include "judge/svg/svg_scan.h"

/* A curve across the page takes hundreds of line segments but a dozen bytes of
 * the file.  So that memory grows in proportion to the file's size, the number
 * of segments is limited to PIECES plus PIECES_BY_BYTE for each byte, several
 * times what drawings have. */
enum { PIECES = 1 << 20, PIECES_BY_BYTE = 4 };

enum paint { PAINT_UNSAID, PAINT_NONE, PAINT_SOME };

/* The properties that an element's children inherit. */
struct svg_style {
  struct svg_matrix to_page; /* mm, y up */
  enum paint stroke, fill;
  bool dashed, hidden; /* a hidden line: by its dashes; by its class or, without
                          one, by the name of its layer */
  bool filling;        /* hatching, or the overlap of fills */
  bool unseen;         /* not displayed, or a definition */
};

struct svg_reader {
  struct judge_drawing *drawing;
  ARRAY(struct svg_style) open; /* of the elements that are open */
  bool sheet;                   /* there is a style sheet */
  bool root;                    /* the svg element was read */
  bool out_of_memory;
  size_t pieces; /* segments of curves that may still be stored */
};

/* ---- Style --------------------------------------------------------------- */

static void apply_paint(const struct svg_tag *tag, const char *name,
                        enum paint *paint) {
  struct svg_text value;
  if (svg_property(tag, name, &value) && !svg_is(value, "inherit"))
    *paint = svg_is(value, "none") || svg_is(value, "transparent") ? PAINT_NONE
                                                                   : PAINT_SOME;
}

static bool is_definition(const struct svg_tag *tag) {
  static const char *const name[] = {
      "defs",     "clipPath", "mask",  "marker", "pattern", "symbol",
      "metadata", "style",    "title", "desc",   "text",    "foreignObject"};
  for (size_t i = 0; i < sizeof name / sizeof name[0]; i++)
    if (svg_is(tag->name, name[i]))
      return true;
  return false;
}

/* Whether a layer's label is "hidden", or a pen's number and "hidden".  Nothing
 * else counts, as labels may contain names of the user's groups. */
static bool is_layer_of_hidden(struct svg_text label) {
  while (label.at < label.end && *label.at >= '0' && *label.at <= '9')
    label.at++;
  return svg_is(svg_trim(label), "hidden");
}

/* Interprets the classes of recto's own files, which take precedence over the
 * layer's label. */
static void apply_class(struct svg_text list, struct svg_style *style) {
  struct svg_text word;
  while (svg_next_word(&list, &word)) {
    if (svg_is(word, "hidden"))
      style->hidden = true;
    else if (svg_is(word, "hatch") || svg_is(word, "seam") ||
             svg_is(word, "text"))
      style->filling = true;
    for (int i = 0; i < RECTO_EDGE_CLASS_COUNT; i++)
      if (svg_is(word, recto_edge_class_name((recto_edge_class)(1u << i))))
        style->hidden = false;
  }
}

/* Applies an element's attributes to the inherited style.  Returns NULL, or a
 * description of the error. */
static const char *apply_style(const struct svg_tag *tag,
                               struct svg_style *style) {
  struct svg_text value;
  struct svg_matrix matrix;
  apply_paint(tag, "stroke", &style->stroke);
  apply_paint(tag, "fill", &style->fill);
  if (svg_property(tag, "stroke-dasharray", &value))
    style->dashed = !svg_is(value, "none") && value.at < value.end;
  if (svg_attribute(tag, "inkscape:label", &value) && is_layer_of_hidden(value))
    style->hidden = true;
  if (svg_attribute(tag, "class", &value))
    apply_class(value, style);
  if ((svg_property(tag, "display", &value) && svg_is(value, "none")) ||
      (svg_property(tag, "visibility", &value) && svg_is(value, "hidden")) ||
      is_definition(tag))
    style->unseen = true;
  if (!svg_attribute(tag, "transform", &value))
    return NULL;
  if (!svg_transform(value, &matrix))
    return "a transform that makes no sense";
  style->to_page = svg_product(&style->to_page, &matrix);
  return NULL;
}

static bool is_ink(const struct svg_reader *reader,
                   const struct svg_style *style) {
  if (style->unseen || style->filling)
    return false;
  return style->stroke == PAINT_SOME ||
         (style->stroke == PAINT_UNSAID && style->fill == PAINT_UNSAID &&
          reader->sheet);
}

/* ---- The root ------------------------------------------------------------ */

/* Sets the matrix that fits the viewBox into the page, scaled evenly and
 * centred, which is the default of SVG, or stretched; flips y. */
static const char *fit_view(const struct svg_tag *tag,
                            struct judge_drawing *drawing,
                            struct svg_matrix *to_page) {
  double width = drawing->width_mm, height = drawing->height_mm;
  struct svg_text box, aspect;
  const double px = 25.4 / 96;
  double v[4] = {0, 0, width / px, height / px};
  if (svg_attribute(tag, "viewBox", &box))
    for (int i = 0; i < 4; i++)
      if (!svg_number(&box, &v[i]))
        return "a viewBox that is not four numbers";
  if (!(v[2] > 0 && v[3] > 0))
    return "a viewBox without area";
  double sx = width / v[2], sy = height / v[3];
  bool stretch = svg_attribute(tag, "preserveAspectRatio", &aspect) &&
                 svg_is(svg_trim(aspect), "none");
  if (!stretch)
    sx = sy = fmin(sx, sy);
  double x = (width - sx * v[2]) / 2 - sx * v[0];
  double y = (height - sy * v[3]) / 2 - sy * v[1];
  *to_page = (struct svg_matrix){sx, 0, 0, -sy, x, height - y};
  drawing->left_mm = -x;
  drawing->top_mm = -y;
  return NULL;
}

static const char *read_root(struct svg_reader *reader,
                             const struct svg_tag *tag,
                             struct svg_style *style) {
  struct svg_text width, height;
  struct judge_drawing *drawing = reader->drawing;
  if (reader->root)
    return "a svg within the svg";
  if (!svg_attribute(tag, "width", &width) ||
      !svg_attribute(tag, "height", &height) ||
      !svg_length_mm(width, &drawing->width_mm) ||
      !svg_length_mm(height, &drawing->height_mm))
    return "a page without a width and a height";
  reader->root = true;
  return fit_view(tag, drawing, &style->to_page);
}

/* ---- Shapes -------------------------------------------------------------- */

/* A numeric attribute; 0 where it is missing. */
static double numeric_attribute(const struct svg_tag *tag, const char *name) {
  struct svg_text value;
  double number = 0;
  if (svg_attribute(tag, name, &value))
    (void)svg_number(&value, &number);
  return number;
}

static const char *draw_points(struct svg_pen *pen, const struct svg_tag *tag,
                               bool closed) {
  struct svg_text data;
  double x, y;
  if (!svg_attribute(tag, "points", &data))
    return "a polyline without points";
  bool first = true;
  for (svg_skip_spaces(&data); data.at < data.end && pen->fault == NULL;
       svg_skip_spaces(&data)) {
    if (!svg_number(&data, &x) || !svg_number(&data, &y))
      return "a polyline with a broken number";
    if (first)
      svg_pen_move(pen, x, y);
    else
      svg_pen_line(pen, x, y);
    first = false;
  }
  if (closed && !first)
    svg_pen_close(pen);
  return NULL;
}

static void draw_rectangle(struct svg_pen *pen, const struct svg_tag *tag) {
  double x = numeric_attribute(tag, "x"), y = numeric_attribute(tag, "y");
  double width = numeric_attribute(tag, "width"),
         height = numeric_attribute(tag, "height");
  svg_pen_move(pen, x, y);
  svg_pen_line(pen, x + width, y);
  svg_pen_line(pen, x + width, y + height);
  svg_pen_line(pen, x, y + height);
  svg_pen_close(pen);
}

static void draw_ellipse(struct svg_pen *pen, const struct svg_tag *tag,
                         double rx, double ry) {
  double x = numeric_attribute(tag, "cx"), y = numeric_attribute(tag, "cy");
  svg_pen_move(pen, x + rx, y);
  svg_pen_arc(pen, rx, ry, 0, false, true, (struct judge_point2){x - rx, y});
  svg_pen_arc(pen, rx, ry, 0, false, true, (struct judge_point2){x + rx, y});
}

static const char *draw_element(struct svg_pen *pen,
                                const struct svg_tag *tag) {
  struct svg_text data;
  if (svg_is(tag->name, "path"))
    return svg_attribute(tag, "d", &data) ? svg_path(pen, data)
                                          : "a path without data";
  if (svg_is(tag->name, "polyline") || svg_is(tag->name, "polygon"))
    return draw_points(pen, tag, svg_is(tag->name, "polygon"));
  if (svg_is(tag->name, "line")) {
    svg_pen_move(pen, numeric_attribute(tag, "x1"),
                 numeric_attribute(tag, "y1"));
    svg_pen_line(pen, numeric_attribute(tag, "x2"),
                 numeric_attribute(tag, "y2"));
  } else if (svg_is(tag->name, "rect")) {
    draw_rectangle(pen, tag);
  } else if (svg_is(tag->name, "circle")) {
    draw_ellipse(pen, tag, numeric_attribute(tag, "r"),
                 numeric_attribute(tag, "r"));
  } else if (svg_is(tag->name, "ellipse")) {
    draw_ellipse(pen, tag, numeric_attribute(tag, "rx"),
                 numeric_attribute(tag, "ry"));
  }
  return NULL;
}

/* ---- Elements ------------------------------------------------------------ */

static const char *open_element(struct svg_reader *reader,
                                const struct svg_tag *tag) {
  size_t depth = reader->open.count;
  struct svg_style style = {.to_page = {1, 0, 0, 1, 0, 0}};
  if (depth > 0)
    style = reader->open.item[depth - 1];
  bool is_root = svg_is(tag->name, "svg");
  if (!is_root && !reader->root)
    return "something before the svg";
  const char *fault = is_root ? read_root(reader, tag, &style) : NULL;
  if (fault == NULL)
    fault = apply_style(tag, &style);
  reader->sheet = reader->sheet || svg_is(tag->name, "style");
  if (fault != NULL)
    return fault;
  if (svg_is(tag->name, "use") && !style.unseen)
    return "a reference (use), which is not followed";
  if (is_ink(reader, &style)) {
    struct svg_pen pen = {.drawing = reader->drawing,
                          .to_page = style.to_page,
                          .pieces = &reader->pieces,
                          .role = style.hidden || style.dashed ? JUDGE_HIDDEN
                                                               : JUDGE_INK};
    fault = draw_element(&pen, tag);
    fault = fault != NULL ? fault : pen.fault;
    reader->out_of_memory = reader->out_of_memory || pen.out_of_memory;
  }
  if (tag->kind == SVG_TAG_OPEN && !ARRAY_PUSH(&reader->open, style))
    reader->out_of_memory = true;
  return fault;
}

const char JUDGE_NO_MEMORY[] = "memory ran out";

static const char *read_tags(struct svg_reader *reader, struct svg_text file) {
  const char *fault = NULL;
  struct svg_tag tag;
  bool broken;
  for (size_t n = 0; fault == NULL && !reader->out_of_memory &&
                     svg_next_tag(&file, &tag, &broken);
       n++) {
    if (!poll_at(n))
      return JUDGE_NO_MEMORY;
    if (tag.kind != SVG_TAG_CLOSE)
      fault = open_element(reader, &tag);
    else if (reader->open.count == 0)
      fault = "an end without its beginning";
    else
      reader->open.count--;
  }
  if (fault != NULL || reader->out_of_memory)
    return fault != NULL ? fault : JUDGE_NO_MEMORY;
  if (broken || reader->open.count > 0)
    return "the file stops in the middle";
  return reader->root ? NULL : "no svg in it";
}

const char *judge_read_svg(struct judge_drawing *drawing, const char *text,
                           size_t length) {
  struct svg_reader reader = {.drawing = drawing,
                              .pieces = PIECES + PIECES_BY_BYTE * length};
  memset(drawing, 0, sizeof *drawing);
  const char *fault =
      read_tags(&reader, (struct svg_text){text, text + length});
  ARRAY_FREE(&reader.open);
  return fault;
}
