/* value.c - the values of options, from text: the same in every locale. */
#include "cli/value.h"

#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/length.h"
#include "base/number.h"
#include "recto.h"

/* Reads a finite number at `text`; returns where it stopped, or NULL. */
static const char *read_number(const char *text, const char *end,
                               double *number) {
  const char *stop = number_parse_double(text, end, number);
  return stop != NULL && isfinite(*number) ? stop : NULL;
}

bool value_number(const char *text, double *number) {
  const char *end = text + strlen(text);
  double read;
  if (read_number(text, end, &read) != end)
    return false;
  *number = read;
  return true;
}

bool value_int(const char *text, int *number) {
  const char *end = text + strlen(text);
  int64_t read;
  if (number_parse_int(text, end, &read) != end || read < INT_MIN ||
      read > INT_MAX)
    return false;
  *number = (int)read;
  return true;
}

/* ---- Lengths ------------------------------------------------------------- */

bool value_length(const char *text, double *mm) {
  const char *end = text + strlen(text);
  double number;
  const char *stop = read_number(text, end, &number);
  double unit = stop != NULL ? length_unit_mm(stop, end) : 0;
  if (!(unit > 0) || !isfinite(number * unit))
    return false;
  *mm = number * unit;
  return true;
}

bool value_tolerance(const char *text, double *mm, double *share) {
  const char *end = text + strlen(text);
  double number;
  const char *stop = read_number(text, end, &number);
  bool is_share = stop != NULL && strcmp(stop, "%") == 0;
  if (!is_share && !value_length(text, &number))
    return false;
  if (number < 0 || (is_share && number > 100))
    return false;
  *mm = is_share ? 0 : number;
  *share = is_share ? number / 100 : 0;
  return true;
}

/* ---- Vectors ------------------------------------------------------------- */

bool value_vector(const char *text, double vector[3]) {
  const char *end = text + strlen(text);
  double read[3];
  for (int i = 0; i < 3; i++) {
    if (i > 0 && (text == end || *text++ != ','))
      return false;
    text = read_number(text, end, &read[i]);
    if (text == NULL)
      return false;
  }
  if (text != end)
    return false;
  memcpy(vector, read, sizeof read);
  return true;
}

/* ---- Pages --------------------------------------------------------------- */

static bool same_word(const char *a, const char *b) {
  for (; *a != '\0' && *b != '\0'; a++, b++) {
    int upper = *a >= 'a' && *a <= 'z' ? *a - 'a' + 'A' : *a;
    if (upper != *b)
      return false;
  }
  return *a == *b;
}

static bool find_page(const char *text, double *width_mm, double *height_mm) {
  double width, height;
  const char *name;
  for (size_t i = 0; (name = recto_page_name(i, &width, &height)) != NULL; i++)
    if (same_word(text, name)) {
      *width_mm = width;
      *height_mm = height;
      return true;
    }
  return false;
}

bool value_page(const char *text, double *width_mm, double *height_mm) {
  if (find_page(text, width_mm, height_mm))
    return true;
  const char *end = text + strlen(text);
  const char *cross = strchr(text, 'x');
  double width, height;
  if (cross == NULL)
    return false;
  const char *first = read_number(text, cross, &width);
  const char *second = read_number(cross + 1, end, &height);
  if (first == NULL || second == NULL)
    return false;
  double unit = length_unit_mm(second, end);
  double first_unit = first == cross ? unit : length_unit_mm(first, cross);
  if (!(width > 0 && height > 0 && unit > 0 && first_unit > 0))
    return false;
  *width_mm = width * first_unit;
  *height_mm = height * unit;
  return true;
}

bool value_scale(const char *text, double *scale) {
  const char *end = text + strlen(text);
  double page, scene = 1;
  const char *stop = read_number(text, end, &page);
  if (stop != NULL && stop != end && *stop == ':')
    stop = read_number(stop + 1, end, &scene);
  if (stop != end || !(page > 0 && scene > 0) || !isfinite(page / scene) ||
      !(page / scene > 0))
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
  unsigned mask = RECTO_EDGES_NONE;
  if (strcmp(text, "none") != 0)
    for (;;) {
      size_t length = strcspn(text, ",");
      bool all = length == 3 && memcmp(text, "all", 3) == 0;
      unsigned found = all ? RECTO_EDGES_ALL : find_class(text, length);
      if (found == 0)
        return false;
      mask |= found;
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
