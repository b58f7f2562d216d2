/* dash.c - reads patterns of dashes from text. */
#include <string.h>

#include "base/number.h"
#include "ink/dash_pattern.h"
#include "recto.h"

/* Reads a length at `text`, in millimetres or in pen widths; returns where it
 * stopped, or NULL. */
static const char *read_dash_length(const char *text, double *length,
                                    bool *in_pens) {
  static const struct {
    const char *name;
    double mm; /* 0: pen widths */
  } unit[] = {{"mm", 1},         {"cm", 10},  {"in", 25.4},
              {"pt", 25.4 / 72}, {"pens", 0}, {"pen", 0}};
  text = number_parse_double(text, text + strlen(text), length);
  *in_pens = false;
  for (size_t i = 0; text != NULL && i < sizeof unit / sizeof *unit; i++) {
    size_t size = strlen(unit[i].name);
    if (strncmp(text, unit[i].name, size) != 0)
      continue;
    *in_pens = unit[i].mm == 0;
    *length *= *in_pens ? 1 : unit[i].mm;
    return text + size;
  }
  return text;
}

const char *recto_dash_name(size_t index) { return dash_pattern_name(index); }

bool recto_dash_parse(const char *text, recto_dash *dash) {
  recto_dash read;
  bool in_pens;
  if (text == NULL || dash == NULL)
    return false;
  if (dash_pattern_named(text, dash))
    return true;
  read = *dash;
  memset(read.length, 0, sizeof read.length);
  for (read.count = 0; read.count < RECTO_DASH_MAX; text++) {
    double *length = &read.length[read.count];
    text = read_dash_length(text, length, &in_pens);
    if (text == NULL ||
        !(*length >= RECTO_FINEST_MM && *length <= RECTO_DASH_LONGEST) ||
        (read.count > 0 && in_pens != read.in_pens))
      return false;
    read.in_pens = in_pens;
    read.count++;
    if (*text != ':')
      break;
  }
  if (*text != '\0')
    return false;
  /* An odd number is given twice, as in SVG. */
  int given = read.count;
  if (given % 2 != 0 && 2 * given > RECTO_DASH_MAX)
    return false;
  for (int i = 0; given % 2 != 0 && i < given; i++)
    read.length[read.count++] = read.length[i];
  *dash = read;
  return true;
}
