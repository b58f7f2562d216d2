/* pens_warn_unused.c - warns about pens, weights and dashes that have nothing
 * to draw.
 *
 * Whatever is visible, they would draw nothing.  It is no error, because
 * scripts give the same pens for every drawing; weights of classes that a model
 * does not have are a style as good as any, and not warned about. */
#include <stdarg.h>
#include <stdio.h>

#include "base/poll.h"
#include "ink/pens.h"

PRINTF_LIKE(2, 3)
static void warn_of_pen(const recto_options *options, const char *format, ...) {
  char text[128];
  va_list list;
  va_start(list, format);
  vsnprintf(text, sizeof text, format, list);
  va_end(list);
  options->warning(options->user, "", 0, text);
}

bool pens_is_drawn(const recto_options *options, unsigned place) {
  return options->ink.edges >> place & 1;
}

/* Whether the pen may draw anything that is requested.  A pen of groups whose
 * lines are all on other pens by class counts as used. */
static bool is_used(const struct pens *pens, const recto_options *options,
                    uint32_t pen) {
  bool hatched = options->ink.fill == RECTO_FILL_HATCH;
  bool used =
      (pens->of_hidden == pen && options->ink.hidden != RECTO_HIDDEN_NONE) ||
      (pens->of_hidden == PENS_NONE && pen == pens->count &&
       options->ink.hidden == RECTO_HIDDEN_LAYER) ||
      (pens->of_hatch == pen && hatched);
  for (unsigned i = 0; i < RECTO_EDGE_CLASS_COUNT; i++)
    used = used || (pens->of_class[i] == pen && pens_is_drawn(options, i));
  bool has_lines = options->ink.edges != RECTO_EDGES_NONE || hatched;
  for (size_t g = 0; has_lines && !used && g < pens->group_count; g++)
    used = pens->of_group[g] == pen;
  return used;
}

/* Warns in one line about unused widths and colours. */
static void warn_unused_looks(const struct pens *pens,
                              const recto_options *options) {
  uint32_t first = PENS_NONE;
  unsigned others = 0;
  for (uint32_t pen = 0; pen < pens->own_count; pen++) {
    const recto_pen *own = &pens->own[pen];
    if ((own->width_mm == 0 && !own->has_colour) || is_used(pens, options, pen))
      continue;
    others += first != PENS_NONE;
    first = first == PENS_NONE ? pen : first;
  }
  if (first != PENS_NONE && others == 0)
    warn_of_pen(options, "pen %u has a width or a colour but nothing to draw",
                first + 1);
  else if (first != PENS_NONE)
    warn_of_pen(
        options,
        "pen %u and %u more have a width or a colour but nothing to draw",
        first + 1, others);
}

static void warn_unused_dashes(const recto_options *options) {
  for (size_t i = 0; i < options->ink.dash_count; i++) {
    const recto_dash *dash = &options->ink.dash[i];
    bool of_hidden = dash->lines == RECTO_LINES_HIDDEN;
    if (of_hidden ? options->ink.hidden == RECTO_HIDDEN_NONE
                  : (options->ink.edges & dash->edge_class) == 0)
      warn_of_pen(options, "dashes are for %s lines, which are not requested",
                  of_hidden ? "hidden"
                            : recto_edge_class_name(dash->edge_class));
  }
}

/* Pens that groups are assigned to in turn, of which there are not as many. */
static void warn_idle_pens(const struct pens *pens,
                           const recto_options *options) {
  size_t groups = pens->group_count;
  if (options->ink.pens > 1 && (size_t)options->ink.pens > groups &&
      groups > 0 && options->ink.pen_use_count == 0)
    warn_of_pen(options,
                groups == 1 ? "%d pens for the groups of a model that has %zu: "
                              "pen 1 draws all"
                            : "%d pens for the groups of a model that has %zu: "
                              "the others draw nothing",
                options->ink.pens, groups);
}

void pens_warn_unused(const struct pens *pens, const recto_options *options) {
  if (!options->warning)
    return;
  warn_idle_pens(pens, options);
  warn_unused_dashes(options);
  if (pens->of_hidden != PENS_NONE && options->ink.hidden == RECTO_HIDDEN_NONE)
    warn_of_pen(options, "pen %u is for hidden lines, which are not requested",
                pens->of_hidden + 1);
  if (pens->of_hatch != PENS_NONE && options->ink.fill != RECTO_FILL_HATCH)
    warn_of_pen(options, "pen %u is for hatching, which is not requested",
                pens->of_hatch + 1);
  for (unsigned i = 0; i < RECTO_EDGE_CLASS_COUNT; i++)
    if (pens->of_class[i] != PENS_NONE && !pens_is_drawn(options, i))
      warn_of_pen(options, "pen %u is for %s lines, which are not requested",
                  pens->of_class[i] + 1,
                  recto_edge_class_name((recto_edge_class)(1u << i)));
  for (size_t i = 0; i < options->ink.weight_count; i++)
    if ((options->ink.edges & options->ink.weight[i].edge_class) == 0)
      warn_of_pen(options, "a weight is for %s lines, which are not requested",
                  recto_edge_class_name(options->ink.weight[i].edge_class));
  warn_unused_looks(pens, options);
}

void pens_warn_absent(const struct sheet *sheet, const recto_options *options) {
  unsigned present = 0;
  if (options->ink.dash_count == 0 && options->ink.pen_use_count == 0)
    return;
  for (size_t e = 0; e < sheet->edge.count && poll_at(e); e++)
    present |= sheet->edge.item[e].edge_class;
  unsigned absent = options->ink.edges & ~present;
  if (options->warning == NULL || present == 0 || absent == 0)
    return;
  for (size_t i = 0; i < options->ink.dash_count; i++) {
    const recto_dash *dash = &options->ink.dash[i];
    if (dash->lines == RECTO_LINES_OF_CLASS && (absent & dash->edge_class) != 0)
      warn_of_pen(options, "dashes are for %s lines, of which there are none",
                  recto_edge_class_name(dash->edge_class));
  }
  for (size_t i = 0; i < options->ink.pen_use_count; i++) {
    const recto_pen_use *use = &options->ink.pen_use[i];
    if (use->lines == RECTO_LINES_OF_CLASS && (absent & use->edge_class) != 0)
      warn_of_pen(options, "pen %d is for %s lines, of which there are none",
                  use->pen, recto_edge_class_name(use->edge_class));
  }
}
