/* svg_elements.c - writes strokes and fills as elements of SVG.
 *
 * Each stroke is one path.  Numbers are rounded once, to the requested number
 * of decimals, and written without exponents or trailing zeros.  The y axis of
 * SVG points down; the page's y is reversed in the numbers, not by a
 * transform. */
#include "backends/svg_elements.h"

#include <string.h>

#include "backends/svg_text.h"
#include "base/number.h"

/* ---- Geometry ------------------------------------------------------------ */

/* The nearest whole number, of two the one that is farther from 0, as llround
 * finds it: the difference from the truncated value is exact. */
static int64_t round_to_integer(double value) {
  int64_t whole = (int64_t)value;
  double rest = value - (double)whole;
  return whole + (rest >= 0.5) - (rest <= -0.5);
}

static struct svg_point round_point(const struct svg *svg,
                                    struct drawing_point p) {
  return (struct svg_point){
      round_to_integer(p.x * svg->scale),
      round_to_integer((svg->drawing->height_mm - p.y) * svg->scale)};
}

/* Rounds points to svg->point, without those that repeat the previous one, and
 * if `closed`, without those at the end that repeat the first.  Returns false
 * when memory ran out. */
static bool round_points(struct svg *svg, const struct drawing_point *from,
                         uint32_t count, bool closed) {
  svg->point.count = 0;
  if (!ARRAY_RESERVE(&svg->point, count))
    return false;
  struct svg_point *point = svg->point.item;
  size_t kept = 0;
  for (uint32_t i = 0; i < count; i++) {
    struct svg_point p = round_point(svg, from[i]);
    if (kept == 0 || point[kept - 1].x != p.x || point[kept - 1].y != p.y)
      point[kept++] = p;
  }
  while (closed && kept > 1 && point[kept - 1].x == point[0].x &&
         point[kept - 1].y == point[0].y)
    kept--;
  svg->point.count = kept;
  return true;
}

/* The points of a path are written many at once: a call of the stream takes
 * longer than the digits of a number.  A point takes its two numbers, and what
 * stands before, between and after them. */
enum { POINT_TEXT_SIZE = 2 * NUMBER_TEXT_SIZE + 4, POINTS_AT_ONCE = 64 };

/* Writes a point to `text`; returns how long it is. */
static size_t format_point(const struct svg *svg, char *text,
                           struct svg_point p, char separator) {
  int decimals = svg->options->precision;
  size_t count = number_format_scaled(text, p.x, decimals);
  text[count++] = separator;
  return count + number_format_scaled(text + count, p.y, decimals);
}

/* The number that was written last. */
enum last_number { NO_NUMBER, WHOLE_NUMBER, DECIMAL_NUMBER };

/* Writes a step from one point to another, without a 0 before the decimal
 * point.  A number that begins with its sign, or after a decimal one with its
 * point, needs no space before it.
 * last  what was written before it in its command */
static size_t format_step(const struct svg *svg, char *text,
                          struct svg_point from, struct svg_point to,
                          enum last_number *last) {
  const int64_t step[2] = {to.x - from.x, to.y - from.y};
  char *end = text;
  for (int k = 0; k < 2; k++) {
    char number[NUMBER_TEXT_SIZE];
    size_t count =
        number_format_scaled(number, step[k], svg->options->precision);
    size_t sign = number[0] == '-';
    size_t skip = sign + (count > sign + 1 && number[sign] == '0');
    bool apart = number[skip] == '.' && *last == DECIMAL_NUMBER;
    if (sign != 0)
      *end++ = '-';
    else if (*last != NO_NUMBER && !apart)
      *end++ = ' ';
    memcpy(end, number + skip, count - skip);
    end += count - skip;
    *last = memchr(number, '.', count) != NULL ? DECIMAL_NUMBER : WHOLE_NUMBER;
  }
  return (size_t)(end - text);
}

static void write_step(const struct svg *svg, struct svg_point from,
                       struct svg_point to, enum last_number *last) {
  char text[POINT_TEXT_SIZE];
  stream_write(svg->out, text, format_step(svg, text, from, to, last));
}

/* Writes svg->point as path data; relative where others are curves, for a
 * smaller file. */
static void write_path_data(const struct svg *svg, bool closed) {
  bool relative = svg->drawing->control.count > 0;
  enum last_number last = NO_NUMBER;
  char text[POINTS_AT_ONCE * POINT_TEXT_SIZE];
  size_t count = 0;
  for (size_t i = 0; i < svg->point.count; i++) {
    const struct svg_point *p = &svg->point.item[i];
    if (count > sizeof text - POINT_TEXT_SIZE) {
      stream_write(svg->out, text, count);
      count = 0;
    }
    if (i < 2 || !relative)
      text[count++] = i == 0 ? 'M' : relative ? 'l' : 'L';
    count += i > 0 && relative
                 ? format_step(svg, text + count, p[-1], *p, &last)
                 : format_point(svg, text + count, *p, ' ');
  }
  stream_write(svg->out, text, count);
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
  enum last_number number = NO_NUMBER;
  char start[POINT_TEXT_SIZE];
  stream_text(svg->out, command);
  stream_write(svg->out, start, format_point(svg, start, last, ' '));
  for (uint32_t i = 0; i + 3 < curve->count; i += 3) {
    struct svg_point end = round_point(svg, control[i + 3]);
    bool straight = drawing_piece_is_straight(control + i);
    if (straight && end.x == last.x && end.y == last.y)
      continue;
    if (*command != (straight ? 'l' : 'c')) {
      command = straight ? "l" : "c";
      number = NO_NUMBER;
      stream_text(svg->out, command);
    }
    for (uint32_t k = straight ? 3 : 1; k <= 3; k++)
      write_step(svg, last, round_point(svg, control[i + k]), &number);
    last = end;
  }
  if (closed)
    stream_text(svg->out, "Z");
}

/* Writes svg->point as the points of a polyline or polygon. */
static void write_point_list(const struct svg *svg) {
  char text[POINT_TEXT_SIZE];
  for (size_t i = 0; i < svg->point.count; i++) {
    size_t count = i > 0;
    text[0] = ' ';
    count += format_point(svg, text + count, svg->point.item[i], ',');
    stream_write(svg->out, text, count);
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

const char *svg_class_name(const struct drawing_stroke *stroke) {
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
  stream_text(svg->out, svg_class_name(stroke));
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

bool svg_write_stroke(struct svg *svg, uint32_t index) {
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

bool svg_write_fill(struct svg *svg, uint32_t index, bool seam) {
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
