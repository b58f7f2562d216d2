/* pens_warn_unused.c - a word about pens and weights that have nothing to draw,
 * whatever is seen.
 *
 * It is told, not refused: scripts name the same pens for every drawing. */
#include <stdarg.h>
#include <stdio.h>

#include "ink/pens.h"

PRINTF_LIKE(2, 3)
static void warn(const recto_options *options, const char *format, ...) {
  char text[128];
  va_list list;
  va_start(list, format);
  vsnprintf(text, sizeof text, format, list);
  va_end(list);
  options->warning(options->user, "", 0, text);
}

bool pens_is_drawn(const recto_options *options, unsigned place) {
  return options->edges >> place & 1;
}

/* Whether anything that is asked for can be on the pen.  Of groups whose lines
 * are all on other pens by their classes, none is; that is let pass. */
static bool is_busy(const struct pens *pens, const recto_options *options,
                    uint32_t pen) {
  bool hatched = options->fill == RECTO_FILL_HATCH;
  bool busy =
      (pens->of_hidden == pen && options->hidden != RECTO_HIDDEN_NONE) ||
      (pens->of_hidden == PENS_NONE && pen == pens->count &&
       options->hidden == RECTO_HIDDEN_LAYER) ||
      (pens->of_hatch == pen && hatched);
  for (unsigned i = 0; i < RECTO_EDGE_CLASS_COUNT; i++)
    busy = busy || (pens->of_class[i] == pen && pens_is_drawn(options, i));
  bool has_lines = options->edges != RECTO_EDGES_NONE || hatched;
  for (size_t g = 0; has_lines && !busy && g < pens->group_count; g++)
    busy = pens->of_group[g] == pen;
  return busy;
}

/* What was said of widths and colours for nothing, in one line. */
static void tell_of_looks(const struct pens *pens,
                          const recto_options *options) {
  uint32_t first = PENS_NONE;
  unsigned others = 0;
  for (uint32_t pen = 0; pen < PENS_MOST; pen++) {
    const struct pens_own *own = &pens->own[pen];
    if ((own->width_mm == 0 && own->colour == PENS_NONE) ||
        is_busy(pens, options, pen))
      continue;
    others += first != PENS_NONE;
    first = first == PENS_NONE ? pen : first;
  }
  if (first != PENS_NONE && others == 0)
    warn(options, "pen %u has a width or a colour but nothing to draw",
         first + 1);
  else if (first != PENS_NONE)
    warn(options,
         "pen %u and %u more have a width or a colour but nothing to draw",
         first + 1, others);
}

void pens_warn_unused(const struct pens *pens, const recto_options *options) {
  if (!options->warning)
    return;
  if (pens->of_hidden != PENS_NONE && options->hidden == RECTO_HIDDEN_NONE)
    warn(options, "pen %u is for hidden lines, which are not asked for",
         pens->of_hidden + 1);
  if (pens->of_hatch != PENS_NONE && options->fill != RECTO_FILL_HATCH)
    warn(options, "pen %u is for hatching, which is not asked for",
         pens->of_hatch + 1);
  for (unsigned i = 0; i < RECTO_EDGE_CLASS_COUNT; i++)
    if (pens->of_class[i] != PENS_NONE && !pens_is_drawn(options, i))
      warn(options, "pen %u is for %s lines, which are not asked for",
           pens->of_class[i] + 1,
           recto_edge_class_name((recto_edge_class)(1u << i)));
  for (unsigned i = 0; i < RECTO_EDGE_CLASS_COUNT; i++)
    if (pens->weighed >> i & 1 && !pens_is_drawn(options, i))
      warn(options, "a weight is for %s lines, which are not asked for",
           recto_edge_class_name((recto_edge_class)(1u << i)));
  tell_of_looks(pens, options);
}
