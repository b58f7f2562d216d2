/* pens.c - assigns lines to pens, and weights to classes, by the options. */
#include "ink/pens.h"

#include <math.h>
#include <string.h>

#include "ink/dash_pattern.h"

/* ISO 128: wide lines are twice as wide as narrow ones. */
#define WIDE_WEIGHT 2.0
#define SECTION_WEIGHT 3.0

/* In pen widths: shorter creases that end free are no line to the eye. */
#define SHORTEST_CREASE_PENS 10

/* In crease angles: creases that end free are no line of the object unless they
 * bend by more somewhere; a chamfer's 45 degrees are not exceeded, but lines
 * of chamfers do not end free. */
#define CREASE_START 1.5

/* The same where they run to and fro: twice, as each of two bends by the crease
 * angle there. */
#define ZIGZAG_START 2.0

/* In shortest creases: a triangle of these. */
#define CYCLE_CREASES 3

/* So many are as long as the shortest isolated silhouette, and the shortest
 * isolated contour of a smooth surface. */
#define ISOLATED_CREASES 2
#define ISOLATED_CONTOUR_CREASES 0.5

/* The index of the bit of a class. */
static unsigned class_index(unsigned edge_class) {
  unsigned index = 0;
  while (index + 1 < RECTO_EDGE_CLASS_COUNT && edge_class >> (index + 1))
    index++;
  return index;
}

bool pens_is_name_of(const char *name, const char *group) {
  size_t length = strlen(name);
  for (const char *at = group; at != NULL;
       at = strchr(at, '/') != NULL ? strchr(at, '/') + 1 : NULL)
    if (strncmp(at, name, length) == 0 &&
        (at[length] == '\0' || at[length] == '/'))
      return true;
  return false;
}

/* Assigns the groups to the pens in turn. */
static bool assign_groups(struct pens *pens, const struct scene *scene,
                          const recto_options *options) {
  uint32_t count = options->ink.pens > 1 ? (uint32_t)options->ink.pens : 1;
  pens->group_count = scene->group.count;
  pens->of_group = mem_alloc(pens->group_count, sizeof *pens->of_group);
  if (pens->of_group == NULL)
    return false;
  for (size_t g = 0; g < pens->group_count; g++)
    pens->of_group[g] = (uint32_t)g % count;
  pens->count = count < pens->group_count ? count : (uint32_t)pens->group_count;
  pens->count = pens->count > 0 ? pens->count : 1;
  pens->several = count > 1;
  return true;
}

static recto_status add_use(struct pens *pens, const struct scene *scene,
                            const recto_pen_use *use, recto_error *error) {
  uint32_t pen = (uint32_t)use->pen - 1;
  bool found = use->lines != RECTO_LINES_OF_GROUP;
  if (use->lines == RECTO_LINES_HIDDEN)
    pens->of_hidden = pen;
  else if (use->lines == RECTO_LINES_HATCH)
    pens->of_hatch = pen;
  else
    pens->several = true;
  if (use->lines == RECTO_LINES_OF_CLASS)
    pens->of_class[class_index(use->edge_class)] = pen;
  for (size_t g = 0;
       use->lines == RECTO_LINES_OF_GROUP && g < pens->group_count; g++)
    if (pens_is_name_of(use->group, scene->group.item[g].name)) {
      pens->of_group[g] = pen;
      found = true;
    }
  if (pen + 1 > pens->count)
    pens->count = pen + 1;
  return found
             ? RECTO_OK
             : error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                         "pen %d is for \"%.80s\", which is neither a class of "
                         "lines nor a group of the model",
                         use->pen, use->group);
}

static void set_weights(struct pens *pens, const recto_options *options) {
  for (int i = 0; i < RECTO_EDGE_CLASS_COUNT; i++)
    pens->weight[i] = 1;
  if (!options->ink.has_weights && !pens->several)
    pens->weight[class_index(RECTO_EDGE_SILHOUETTE)] =
        pens->weight[class_index(RECTO_EDGE_BORDER)] = WIDE_WEIGHT;
  if (!options->ink.has_weights && !pens->several)
    pens->weight[class_index(RECTO_EDGE_SECTION)] = SECTION_WEIGHT;
  for (size_t i = 0; options->ink.has_weights && i < options->ink.weight_count;
       i++)
    pens->weight[class_index(options->ink.weight[i].edge_class)] =
        options->ink.weight[i].weight;
}

/* Fills end at smooth contours; at those of the mesh they end in any case.
 * Hatching has no seams. */
static double seam_under_lines(const recto_options *options) {
  bool filled = options->ink.fill == RECTO_FILL_PAINT ||
                options->ink.fill == RECTO_FILL_SHADE;
  return filled && options->ink.contours == RECTO_CONTOURS_SMOOTH
             ? fmax(options->ink.seam_mm, 0)
             : 0;
}

recto_status pens_init(struct pens *pens, const struct scene *scene,
                       const recto_options *options, recto_error *error) {
  *pens = (struct pens){.of_hidden = PENS_NONE,
                        .of_hatch = PENS_NONE,
                        .own = options->ink.pen,
                        .own_count = options->ink.pen_count,
                        .width_mm = options->ink.pen_mm,
                        .shortest_mm = options->ink.min_stroke_mm,
                        .seam_mm = seam_under_lines(options),
                        .dashed = dash_pattern_classes(options),
                        .exact = options->ink.exact};
  for (int i = 0; i < RECTO_EDGE_CLASS_COUNT; i++)
    pens->of_class[i] = PENS_NONE;
  if (!assign_groups(pens, scene, options))
    return error_memory(error);
  recto_status status = RECTO_OK;
  for (size_t i = 0; status == RECTO_OK && i < options->ink.pen_use_count; i++)
    status = add_use(pens, scene, &options->ink.pen_use[i], error);
  set_weights(pens, options);
  return status;
}

void pens_fini(struct pens *pens) { mem_free(pens->of_group); }

/* ---- Queries ------------------------------------------------------------- */

uint32_t pens_of_line(const struct pens *pens, unsigned edge_class,
                      uint32_t group) {
  uint32_t pen = pens->of_class[class_index(edge_class)];
  return pen != PENS_NONE ? pen : pens_of_group(pens, group);
}

uint32_t pens_of_hidden(const struct pens *pens, const recto_options *options,
                        unsigned edge_class, uint32_t group) {
  if (pens->of_hidden != PENS_NONE)
    return pens->of_hidden;
  return options->ink.hidden == RECTO_HIDDEN_LAYER
             ? pens->count
             : pens_of_line(pens, edge_class, group);
}

uint32_t pens_of_hatch(const struct pens *pens, uint32_t group) {
  return pens->of_hatch != PENS_NONE ? pens->of_hatch
                                     : pens_of_group(pens, group);
}

double pens_width_mm(const struct pens *pens, uint32_t pen) {
  double own = pen < pens->own_count ? pens->own[pen].width_mm : 0;
  return own > 0 ? own : pens->width_mm;
}

double pens_ink_reach_mm(const struct pens *pens, uint32_t pen,
                         unsigned edge_class) {
  double half = pens_width_mm(pens, pen) / 2;
  double beside = pens_weight(pens, edge_class) * half - pens->seam_mm / 2;
  return pens->seam_mm > 0 && beside > half / 8 ? fmin(half, beside) : half;
}

double pens_shortest_hatch_mm(const struct pens *pens, uint32_t pen) {
  return pens->shortest_mm < 0 ? pens_width_mm(pens, pen) / 2
                               : pens->shortest_mm;
}

double pens_shortest_line_mm(const struct pens *pens, uint32_t pen) {
  return fmin(pens_shortest_hatch_mm(pens, pen), pens_width_mm(pens, pen) / 2);
}

/* So many crease angles; 0 where all creases are drawn. */
static double start_deg(const recto_options *options, double angles) {
  bool exact = options->ink.exact || options->ink.min_stroke_mm == 0;
  return exact ? 0 : fmin(angles * options->mesh.crease_deg, 180);
}

double pens_crease_start_deg(const recto_options *options) {
  return options->mesh.crease_start_deg > 0 ? 0
                                            : start_deg(options, CREASE_START);
}

/* That the caller said where creases start says nothing about their shape,
 * unless all of them do. */
double pens_zigzag_start_deg(const recto_options *options) {
  double start = options->mesh.crease_start_deg;
  return start > 0 && start <= options->mesh.crease_deg
             ? 0
             : start_deg(options, ZIGZAG_START);
}

double pens_short_cycle_mm(const struct pens *pens, uint32_t pen) {
  return CYCLE_CREASES * pens_shortest_crease_mm(pens, pen);
}

double pens_shortest_isolated_mm(const struct pens *pens, uint32_t pen) {
  return ISOLATED_CREASES * pens_shortest_crease_mm(pens, pen);
}

double pens_shortest_contour_mm(const struct pens *pens, uint32_t pen) {
  return ISOLATED_CONTOUR_CREASES * pens_shortest_crease_mm(pens, pen);
}

double pens_shortest_crease_mm(const struct pens *pens, uint32_t pen) {
  return pens->exact ? 0
         : pens->shortest_mm < 0
             ? SHORTEST_CREASE_PENS * pens_width_mm(pens, pen)
             : pens->shortest_mm;
}

double pens_weight(const struct pens *pens, unsigned edge_class) {
  return pens->weight[class_index(edge_class)];
}

unsigned pens_weight_id(const struct pens *pens, unsigned edge_class) {
  unsigned first = 0, index = class_index(edge_class);
  if (pens->dashed & 1u << index)
    return index;
  while (pens->weight[first] != pens->weight[index] ||
         pens->dashed & 1u << first)
    first++;
  return first;
}
