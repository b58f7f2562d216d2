/* pens.h - which pen draws what, how wide and in which colour, and how heavy
 * the classes of lines are: what the options' lists say.
 *
 * Of what is said about a line the first of these holds: that it is hidden or
 * hatching, its class, its group; else its group is dealt to a pen. */
#ifndef INK_PENS_H
#define INK_PENS_H

#include "drawing/drawing.h"
#include "scene/scene.h"

#define PENS_MOST 1000
#define PENS_NONE UINT32_MAX

struct pens_own {
  double width_mm; /* 0: that of all pens */
  uint32_t colour; /* 0xRRGGBB; PENS_NONE: the usual one */
};

struct pens {
  /* Pens count from 0 here; PENS_NONE where nothing is said. */
  uint32_t of_class[RECTO_EDGE_CLASS_COUNT]; /* by place of the bit */
  uint32_t of_hidden, of_hatch;
  uint32_t *of_group; /* one a group of the scene */
  size_t group_count;
  uint32_t count;       /* pens past the last that anything is on */
  bool several;         /* visible lines may be on more than one */
  struct pens_own *own; /* PENS_MOST + 1 of them */
  double weight[RECTO_EDGE_CLASS_COUNT]; /* pen widths, by place of the bit */
  unsigned weighed;             /* classes that the list gives a weight */
  double width_mm, shortest_mm; /* of the options */
};

/* Reads the lists.
 * Errors  RECTO_ERROR_ARGUMENT: a list that makes no sense or has two values
 *         for one name, a name that is neither a class nor a group's;
 *         RECTO_ERROR_MEMORY.  pens_fini it in any case. */
USE_RESULT recto_status pens_init(struct pens *pens, const struct scene *scene,
                                  const recto_options *options,
                                  recto_error *error);
void pens_fini(struct pens *pens);

/* Whether lines of the class at that place are asked for. */
bool pens_is_drawn(const recto_options *options, unsigned place);

/* Warns of what was said about pens that have nothing to draw by the options,
 * and about weights of lines that are not asked for. */
void pens_warn_unused(const struct pens *pens, const recto_options *options);

/* The pen of visible lines of a class, of hidden ones, of hatching, of fills.
 */
uint32_t pens_of_line(const struct pens *pens, unsigned edge_class,
                      uint32_t group);
uint32_t pens_of_hidden(const struct pens *pens, const recto_options *options,
                        unsigned edge_class, uint32_t group);
uint32_t pens_of_hatch(const struct pens *pens, uint32_t group);
static inline uint32_t pens_of_group(const struct pens *pens, uint32_t group) {
  return group < pens->group_count ? pens->of_group[group] : 0;
}

double pens_width_mm(const struct pens *pens, uint32_t pen);

/* Strokes of that pen are at least so long. */
double pens_shortest_mm(const struct pens *pens, uint32_t pen);

/* The place of a class's bit. */
unsigned pens_place(unsigned edge_class);

/* The same for visible lines of two classes where they may be one stroke: they
 * are as heavy. */
unsigned pens_weight_rank(const struct pens *pens, unsigned edge_class);

#endif
