/* dash_pattern.c - which lines are drawn as which dashes, by the options.
 *
 * Line types    [ISO128] gives the lengths of their elements in line widths:
 *               gap 3, dot at most 0.5, dash 12, long dash 24.
 * Round ends    lengths are those of the pen's way.  Its round ends make a dash
 *               on paper a line width longer, and a gap as much shorter. */
#include "ink/dash_pattern.h"

#include <math.h>
#include <string.h>

static const struct line_type {
  const char *name;
  double pens[RECTO_DASH_MAX];
  int count;
} line_type[] = {
    {"solid", {0}, 0},                       /* 01 continuous */
    {"hidden", {12, 3}, 2},                  /* 02 dashed */
    {"chain", {24, 3, 0.5, 3}, 4},           /* 04 long-dashed dotted */
    {"phantom", {24, 3, 0.5, 3, 0.5, 3}, 6}, /* 05 ... double-dotted */
};
#define LINE_TYPES (sizeof line_type / sizeof line_type[0])

const char *dash_pattern_name(size_t index) {
  return index < LINE_TYPES ? line_type[index].name : NULL;
}

bool dash_pattern_named(const char *name, recto_dash *dash) {
  for (size_t i = 0; i < LINE_TYPES; i++)
    if (strcmp(name, line_type[i].name) == 0) {
      memcpy(dash->length, line_type[i].pens, sizeof dash->length);
      dash->count = line_type[i].count;
      dash->in_pens = true;
      return true;
    }
  return false;
}

/* The last dash of the options for hidden lines or for a class; NULL: none. */
static const recto_dash *find_dash(const recto_options *options,
                                   unsigned edge_class, bool hidden) {
  for (size_t i = options->ink.dash_count; i > 0; i--) {
    const recto_dash *dash = &options->ink.dash[i - 1];
    if (hidden ? dash->lines == RECTO_LINES_HIDDEN
               : dash->lines == RECTO_LINES_OF_CLASS &&
                     dash->edge_class == edge_class)
      return dash;
  }
  return NULL;
}

struct dash_pattern dash_pattern_of(const recto_options *options,
                                    const struct drawing *drawing,
                                    const struct drawing_stroke *stroke) {
  struct dash_pattern pattern = {.count = 0};
  recto_dash usual = {.count = 0};
  const recto_dash *dash =
      find_dash(options, stroke->edge_class, stroke->hidden);
  if (dash == NULL && stroke->hidden &&
      options->ink.hidden == RECTO_HIDDEN_DASHED &&
      dash_pattern_named("hidden", &usual))
    dash = &usual;
  if (dash == NULL)
    return pattern;
  double unit = dash->in_pens ? drawing_width_mm(drawing, stroke) : 1;
  pattern.count = dash->count;
  for (int i = 0; i < dash->count; i++)
    pattern.mm[i] = fmax(dash->length[i] * unit, RECTO_FINEST_MM);
  return pattern;
}

unsigned dash_pattern_classes(const recto_options *options) {
  unsigned classes = 0;
  for (unsigned edge_class = 1; edge_class <= RECTO_EDGES_ALL;
       edge_class <<= 1) {
    const recto_dash *dash = find_dash(options, edge_class, false);
    if (dash != NULL && dash->count > 0)
      classes |= edge_class;
  }
  return classes;
}
