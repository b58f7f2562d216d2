/* svg_scan.c - tags, attributes, numbers and transforms of an SVG file. */
#include "judge/svg/svg_scan.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* ---- Words --------------------------------------------------------------- */

static bool is_xml_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool svg_is(struct svg_text text, const char *word) {
  size_t length = strlen(word);
  return (size_t)(text.end - text.at) == length &&
         memcmp(text.at, word, length) == 0;
}

/* Where the word begins in the text, or NULL. */
static const char *find(struct svg_text text, const char *word) {
  size_t length = strlen(word);
  for (; (size_t)(text.end - text.at) >= length; text.at++)
    if (memcmp(text.at, word, length) == 0)
      return text.at;
  return NULL;
}

struct svg_text svg_trim(struct svg_text text) {
  while (text.at < text.end && is_xml_space(*text.at))
    text.at++;
  while (text.end > text.at && is_xml_space(text.end[-1]))
    text.end--;
  return text;
}

bool svg_next_word(struct svg_text *list, struct svg_text *word) {
  *list = svg_trim(*list);
  word->at = list->at;
  while (list->at < list->end && !is_xml_space(*list->at))
    list->at++;
  word->end = list->at;
  return word->at < word->end;
}

void svg_skip_spaces(struct svg_text *text) {
  while (text->at < text->end && (is_xml_space(*text->at) || *text->at == ','))
    text->at++;
}

/* ---- Tags ---------------------------------------------------------------- */

/* Passes over a comment, a declaration or the like that begins at `file`;
 * false where it does not end. */
static bool skip_markup(struct svg_text *file) {
  static const char *const around[][2] = {
      {"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}};
  for (size_t i = 0; i < sizeof around / sizeof around[0]; i++) {
    size_t length = strlen(around[i][0]);
    if ((size_t)(file->end - file->at) < length ||
        memcmp(file->at, around[i][0], length) != 0)
      continue;
    const char *stop = find(*file, around[i][1]);
    file->at = stop != NULL ? stop + strlen(around[i][1]) : file->end;
    return stop != NULL;
  }
  /* A declaration may hold others, in brackets. */
  int depth = 0;
  for (; file->at < file->end; file->at++) {
    depth += *file->at == '[';
    depth -= *file->at == ']';
    if (*file->at == '>' && depth <= 0) {
      file->at++;
      return true;
    }
  }
  return false;
}

/* The end of a tag: the first > that is not in quotes; NULL. */
static const char *find_end(struct svg_text text) {
  char quote = '\0';
  for (; text.at < text.end; text.at++) {
    char c = *text.at;
    if (quote != '\0')
      quote = c == quote ? '\0' : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '>')
      return text.at;
  }
  return NULL;
}

static struct svg_tag tag_of(struct svg_text text) {
  struct svg_tag tag = {.kind = SVG_TAG_OPEN};
  if (text.at < text.end && *text.at == '/') {
    tag.kind = SVG_TAG_CLOSE;
    text.at++;
  } else if (text.end > text.at && text.end[-1] == '/') {
    tag.kind = SVG_TAG_WHOLE;
    text.end--;
  }
  static const char prefix[] = "svg:";
  size_t length = sizeof prefix - 1;
  if ((size_t)(text.end - text.at) > length &&
      memcmp(text.at, prefix, length) == 0)
    text.at += length;
  tag.name.at = text.at;
  while (text.at < text.end && !is_xml_space(*text.at))
    text.at++;
  tag.name.end = text.at;
  tag.rest = text;
  return tag;
}

bool svg_next_tag(struct svg_text *file, struct svg_tag *tag, bool *broken) {
  *broken = false;
  for (;;) {
    const char *open = memchr(file->at, '<', (size_t)(file->end - file->at));
    if (open == NULL)
      return false;
    file->at = open;
    bool other = open + 1 < file->end && (open[1] == '!' || open[1] == '?');
    if (!other)
      break;
    *broken = !skip_markup(file);
    if (*broken)
      return false;
  }
  struct svg_text inside = {file->at + 1, find_end(*file)};
  *broken = inside.end == NULL;
  if (*broken)
    return false;
  *tag = tag_of(inside);
  file->at = inside.end + 1;
  return true;
}

/* ---- Attributes ---------------------------------------------------------- */

/* Reads name="value" or name='value'; false where there is none. */
static bool next_attribute(struct svg_text *rest, struct svg_text *name,
                           struct svg_text *value) {
  *rest = svg_trim(*rest);
  name->at = rest->at;
  while (rest->at < rest->end && *rest->at != '=' && !is_xml_space(*rest->at))
    rest->at++;
  name->end = rest->at;
  *rest = svg_trim(*rest);
  if (rest->at == rest->end || *rest->at != '=')
    return false;
  rest->at++;
  *rest = svg_trim(*rest);
  if (rest->at == rest->end || (*rest->at != '"' && *rest->at != '\''))
    return false;
  value->at = rest->at + 1;
  value->end = memchr(value->at, *rest->at, (size_t)(rest->end - value->at));
  if (value->end == NULL)
    return false;
  rest->at = value->end + 1;
  return true;
}

bool svg_attribute(const struct svg_tag *tag, const char *name,
                   struct svg_text *value) {
  struct svg_text rest = tag->rest, found;
  while (next_attribute(&rest, &found, value))
    if (svg_is(found, name))
      return true;
  return false;
}

/* The property of a style: "name: value; name: value". */
static bool find_in_style(struct svg_text style, const char *name,
                          struct svg_text *value) {
  while (style.at < style.end) {
    const char *stop = memchr(style.at, ';', (size_t)(style.end - style.at));
    struct svg_text entry = {style.at, stop != NULL ? stop : style.end};
    const char *colon = memchr(entry.at, ':', (size_t)(entry.end - entry.at));
    style.at = stop != NULL ? stop + 1 : style.end;
    if (colon == NULL ||
        !svg_is(svg_trim((struct svg_text){entry.at, colon}), name))
      continue;
    *value = svg_trim((struct svg_text){colon + 1, entry.end});
    return true;
  }
  return false;
}

bool svg_property(const struct svg_tag *tag, const char *name,
                  struct svg_text *value) {
  struct svg_text style;
  if (svg_attribute(tag, "style", &style) && find_in_style(style, name, value))
    return true;
  if (!svg_attribute(tag, name, value))
    return false;
  *value = svg_trim(*value);
  return true;
}

/* ---- Numbers ------------------------------------------------------------- */

/* Digits, of which the first 18 count, and how many others there were. */
struct digits {
  uint64_t sum;
  int count, dropped;
};

static const char *gather(const char *at, const char *end, struct digits *d) {
  enum { MOST = 18 };
  for (; at < end && is_digit(*at); at++, d->count++) {
    if (d->count - d->dropped < MOST)
      d->sum = 10 * d->sum + (uint64_t)(*at - '0');
    else
      d->dropped++;
  }
  return at;
}

static double scale_by_ten(double value, int exponent) {
  enum { EXACT = 22 }; /* 10^22 is the last power that is a double */
  double power = 1;
  if (exponent < -EXACT || exponent > EXACT)
    return value * pow(10, exponent);
  for (int i = 0; i < exponent || i < -exponent; i++)
    power *= 10;
  return exponent < 0 ? value / power : value * power;
}

/* Reads e[+-]digits; where there are none, `at` stays. */
static const char *scan_exponent(const char *at, const char *end,
                                 int *exponent) {
  enum { LARGEST = 400 };
  const char *stop = at;
  if (stop == end || (*stop != 'e' && *stop != 'E'))
    return at;
  stop++;
  bool minus = stop < end && *stop == '-';
  stop += stop < end && (*stop == '-' || *stop == '+');
  struct digits d = {0, 0, 0};
  const char *after = gather(stop, end, &d);
  if (after == stop)
    return at;
  int size = d.sum < LARGEST && d.dropped == 0 ? (int)d.sum : LARGEST;
  *exponent = minus ? -size : size;
  return after;
}

bool svg_number(struct svg_text *text, double *value) {
  svg_skip_spaces(text);
  const char *at = text->at;
  bool minus = at < text->end && *at == '-';
  at += at < text->end && (*at == '-' || *at == '+');
  struct digits d = {0, 0, 0};
  at = gather(at, text->end, &d);
  int whole = d.count, exponent = 0;
  if (at < text->end && *at == '.')
    at = gather(at + 1, text->end, &d);
  if (d.count == 0)
    return false;
  text->at = scan_exponent(at, text->end, &exponent);
  double size =
      scale_by_ten((double)d.sum, exponent + d.dropped - (d.count - whole));
  *value = minus ? -size : size;
  return isfinite(size);
}

bool svg_length_mm(struct svg_text text, double *mm) {
  static const struct {
    const char *name;
    double mm;
  } unit[] = {{"", 25.4 / 96}, {"px", 25.4 / 96}, {"mm", 1},       {"cm", 10},
              {"in", 25.4},    {"pt", 25.4 / 72}, {"pc", 25.4 / 6}};
  double number;
  text = svg_trim(text);
  if (!svg_number(&text, &number) || !(number > 0))
    return false;
  for (size_t i = 0; i < sizeof unit / sizeof unit[0]; i++)
    if (svg_is(text, unit[i].name)) {
      *mm = number * unit[i].mm;
      return isfinite(*mm);
    }
  return false;
}

/* ---- Transforms ---------------------------------------------------------- */

struct judge_point2 svg_apply(const struct svg_matrix *m, double x, double y) {
  return (struct judge_point2){m->a * x + m->c * y + m->e,
                               m->b * x + m->d * y + m->f};
}

struct svg_matrix svg_product(const struct svg_matrix *m,
                              const struct svg_matrix *n) {
  return (struct svg_matrix){
      m->a * n->a + m->c * n->b,        m->b * n->a + m->d * n->b,
      m->a * n->c + m->c * n->d,        m->b * n->c + m->d * n->d,
      m->a * n->e + m->c * n->f + m->e, m->b * n->e + m->d * n->f + m->f};
}

static struct svg_matrix rotation(double deg, double x, double y) {
  double angle = deg / 180 * acos(-1), c = cos(angle), s = sin(angle);
  return (struct svg_matrix){c, s, -s, c, x - c * x + s * y, y - s * x - c * y};
}

/* The transform of that name with `count` numbers. */
static bool transform_of(struct svg_text name, const double *v, int count,
                         struct svg_matrix *m) {
  const double degree = acos(-1) / 180;
  if (svg_is(name, "matrix") && count == 6)
    *m = (struct svg_matrix){v[0], v[1], v[2], v[3], v[4], v[5]};
  else if (svg_is(name, "translate") && (count == 1 || count == 2))
    *m = (struct svg_matrix){1, 0, 0, 1, v[0], count == 2 ? v[1] : 0};
  else if (svg_is(name, "scale") && (count == 1 || count == 2))
    *m = (struct svg_matrix){v[0], 0, 0, v[count - 1], 0, 0};
  else if (svg_is(name, "rotate") && (count == 1 || count == 3))
    *m = rotation(v[0], count == 3 ? v[1] : 0, count == 3 ? v[2] : 0);
  else if (svg_is(name, "skewX") && count == 1)
    *m = (struct svg_matrix){1, 0, tan(v[0] * degree), 1, 0, 0};
  else if (svg_is(name, "skewY") && count == 1)
    *m = (struct svg_matrix){1, tan(v[0] * degree), 0, 1, 0, 0};
  else
    return false;
  return true;
}

bool svg_transform(struct svg_text text, struct svg_matrix *matrix) {
  *matrix = (struct svg_matrix){1, 0, 0, 1, 0, 0};
  for (svg_skip_spaces(&text); text.at < text.end; svg_skip_spaces(&text)) {
    struct svg_text name = {text.at, text.at};
    while (name.end < text.end && *name.end != '(')
      name.end++;
    if (name.end == text.end)
      return false;
    text.at = name.end + 1;
    double value[6];
    int count = 0;
    while (count < 6 && svg_number(&text, &value[count]))
      count++;
    svg_skip_spaces(&text);
    struct svg_matrix one;
    if (text.at == text.end || *text.at++ != ')' ||
        !transform_of(svg_trim(name), value, count, &one))
      return false;
    *matrix = svg_product(matrix, &one);
  }
  return true;
}
