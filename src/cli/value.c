/* value.c - the values of options, from text: the same in every locale. */
#include "cli/value.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "recto.h"

/* Reads a finite decimal number at `text`; returns where it stopped, or NULL.
 * The program's locale is always C. */
static const char *parse_number(const char *text, double *number) {
  const char *digits = text + (*text == '+' || *text == '-');
  char *stop;
  bool is_hexadecimal = digits[0] == '0' && (digits[1] | 0x20) == 'x';
  if (strspn(digits, "0123456789.") == 0 || is_hexadecimal)
    return NULL;
  *number = strtod(text, &stop);
  return stop != text && isfinite(*number) ? stop : NULL;
}

bool value_number(const char *text, double *number) {
  double read;
  const char *stop = parse_number(text, &read);
  if (stop == NULL || *stop != '\0')
    return false;
  *number = read;
  return true;
}

bool value_int(const char *text, int *number) {
  double read;
  bool is_whole = text[strspn(text, "+-0123456789")] == '\0';
  if (!is_whole || !value_number(text, &read) || read < INT_MIN ||
      read > INT_MAX)
    return false;
  *number = (int)read;
  return true;
}

bool value_range(const char *text, char between, int *first, int *last) {
  char start[16];
  const char *sign = strchr(text, between);
  size_t length = sign != NULL ? (size_t)(sign - text) : strlen(text);
  int a, b;
  if (length >= sizeof start)
    return false;
  memcpy(start, text, length);
  start[length] = '\0';
  if (!value_int(start, &a) || !value_int(sign != NULL ? sign + 1 : start, &b))
    return false;
  *first = a;
  *last = b;
  return true;
}

/* ---- Lengths ------------------------------------------------------------- */

/* Reads a number and its unit, which is stored in millimetres, `usual_mm` where
 * there is none; returns where it stopped, or NULL. */
static const char *read_length(const char *text, double usual_mm,
                               double *number, double *unit_mm) {
  static const struct {
    const char *name;
    double mm;
  } unit[] = {{"mm", 1}, {"cm", 10}, {"in", 25.4}, {"pt", 25.4 / 72}};
  text = parse_number(text, number);
  *unit_mm = usual_mm;
  for (size_t i = 0; text != NULL && i < sizeof unit / sizeof unit[0]; i++)
    if (strncmp(text, unit[i].name, 2) == 0) {
      *unit_mm = unit[i].mm;
      return text + 2;
    }
  return text;
}

bool value_length(const char *text, double *mm) {
  double number, unit_mm;
  const char *stop = read_length(text, 1, &number, &unit_mm);
  if (stop == NULL || *stop != '\0' || !isfinite(number * unit_mm))
    return false;
  *mm = number * unit_mm;
  return true;
}

bool value_tolerance(const char *text, double *mm, double *share) {
  double number;
  const char *stop = parse_number(text, &number);
  bool is_share = stop != NULL && strcmp(stop, "%") == 0;
  if (!is_share && !value_length(text, &number))
    return false;
  if (number < 0 || (is_share && number > 100))
    return false;
  *mm = is_share ? 0 : number;
  *share = is_share ? number / 100 : 0;
  return true;
}

bool value_unit(const char *text, double *mm) {
  static const struct {
    double mm;
    const char *names;
  } unit[] = {
      /* The last two are the micro sign and the letter mu. */
      {0.001, "um micron microns micrometre micrometres micrometer micrometers "
              "\302\265m \316\274m"},
      {1, "mm millimetre millimetres millimeter millimeters"},
      {10, "cm centimetre centimetres centimeter centimeters"},
      {1000, "m metre metres meter meters"},
      {25.4, "in inch inches"},
      {304.8, "ft foot feet"}};
  char lower[32];
  size_t length = strlen(text);
  int index;
  if (length >= sizeof lower)
    return false;
  for (size_t i = 0; i <= length; i++)
    lower[i] =
        (char)(text[i] >= 'A' && text[i] <= 'Z' ? text[i] | 0x20 : text[i]);
  for (size_t i = 0; i < sizeof unit / sizeof unit[0]; i++)
    if (value_word(lower, unit[i].names, &index)) {
      *mm = unit[i].mm;
      return true;
    }
  return false;
}

/* ---- Vectors ------------------------------------------------------------- */

static bool read_numbers(const char *text, double *read, int count) {
  for (int i = 0; i < count; i++) {
    text = parse_number(text, &read[i]);
    if (text == NULL || *text != (i + 1 < count ? ',' : '\0'))
      return false;
    text++;
  }
  return true;
}

bool value_vector(const char *text, double vector[3]) {
  double read[3];
  if (!read_numbers(text, read, 3))
    return false;
  memcpy(vector, read, sizeof read);
  return true;
}

bool value_axis(const char *text, double vector[3]) {
  static const char axes[] = "xyz";
  double sign = *text == '-' ? -1 : 1;
  text += *text == '-' || *text == '+';
  const char *axis = *text != '\0' ? strchr(axes, *text | 0x20) : NULL;
  if (axis == NULL || *axis == '\0' || text[1] != '\0')
    return false;
  for (int i = 0; i < 3; i++)
    vector[i] = axis - axes == i ? sign : 0;
  return true;
}

bool value_plane(const char *text, double normal[3], double *offset) {
  double read[4];
  if (text[0] >= 'x' && text[0] <= 'z' &&
      (text[1] == '=' || text[1] == '>' || text[1] == '<')) {
    double sign = text[1] == '<' ? -1 : 1;
    if (!read_numbers(text + 2, read, 1))
      return false;
    for (int i = 0; i < 3; i++)
      normal[i] = text[0] == 'x' + i ? sign : 0;
    *offset = sign * read[0];
    return true;
  }
  if (!read_numbers(text, read, 4) ||
      (read[0] == 0 && read[1] == 0 && read[2] == 0))
    return false;
  memcpy(normal, read, 3 * sizeof *normal);
  *offset = read[3];
  return true;
}

/* ---- Pages --------------------------------------------------------------- */

bool value_page(const char *text, double *width_mm, double *height_mm,
                bool *is_named) {
  const char *name;
  double size_mm[2], unit_mm[2];
  for (size_t i = 0;
       (name = recto_page_name(i, &size_mm[0], &size_mm[1])) != NULL; i++)
    if (strcasecmp(text, name) == 0) {
      *width_mm = size_mm[0];
      *height_mm = size_mm[1];
      *is_named = true;
      return true;
    }
  const char *cross = read_length(text, 0, &size_mm[0], &unit_mm[0]);
  if (cross == NULL || *cross != 'x')
    return false;
  const char *stop = read_length(cross + 1, 1, &size_mm[1], &unit_mm[1]);
  if (stop == NULL || *stop != '\0' || !(size_mm[0] > 0 && size_mm[1] > 0))
    return false;
  *width_mm = size_mm[0] * (unit_mm[0] > 0 ? unit_mm[0] : unit_mm[1]);
  *height_mm = size_mm[1] * unit_mm[1];
  *is_named = false;
  return true;
}

bool value_scale(const char *text, double *scale) {
  double page, scene = 1;
  const char *stop = parse_number(text, &page);
  if (stop != NULL && *stop == ':')
    stop = parse_number(stop + 1, &scene);
  if (stop == NULL || *stop != '\0' || !(page > 0 && scene > 0) ||
      !isfinite(page / scene) || !(page / scene > 0))
    return false;
  *scale = page / scene;
  return true;
}

/* ---- Words --------------------------------------------------------------- */

static unsigned find_class(const char *text, size_t length) {
  for (unsigned i = 0; i < RECTO_EDGE_CLASS_COUNT; i++) {
    const char *name = recto_edge_class_name((recto_edge_class)(1u << i));
    if (strlen(name) == length && memcmp(name, text, length) == 0)
      return 1u << i;
  }
  return 0;
}

unsigned value_edge_class(const char *name) {
  return find_class(name, strlen(name));
}

bool value_edges(const char *text, unsigned *edges) {
  /* A list that begins by leaving out leaves out of the default. */
  unsigned mask = *text == '-' ? RECTO_EDGES_DEFAULT : RECTO_EDGES_NONE;
  unsigned named = 0;
  const char *begin = text;
  if (strcmp(text, "none") != 0)
    for (;;) {
      bool without = *text == '-';
      bool may_be_all = text == begin && !without;
      text += without;
      size_t length = strcspn(text, ",");
      bool all = may_be_all && length == 3 && memcmp(text, "all", 3) == 0;
      unsigned found = all ? RECTO_EDGES_ALL : find_class(text, length);
      if (found == 0 || (named & found) != 0)
        return false;
      named |= all ? 0 : found;
      mask = without ? mask & ~found : mask | found;
      text += length;
      if (*text == '\0')
        break;
      text++;
    }
  *edges = mask;
  return true;
}

bool value_word(const char *text, const char *words, int *index) {
  size_t length = strlen(text);
  for (int i = 0; *words != '\0'; i++) {
    size_t here = strcspn(words, " ");
    if (here == length && memcmp(words, text, length) == 0) {
      *index = i;
      return true;
    }
    words += here;
    words += strspn(words, " ");
  }
  return false;
}

bool value_name(const char *text, const char *(*name)(size_t index),
                int *index) {
  for (int i = 0; name((size_t)i) != NULL; i++)
    if (strcmp(text, name((size_t)i)) == 0) {
      *index = i;
      return true;
    }
  return false;
}
