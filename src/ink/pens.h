/* pens.h - which pen draws what, with which width and colour, and the weights
 * of the classes of lines.
 *
 * The pen of a line is the first of these that is given: the one for hidden
 * lines or for hatching, the one of its class, the one of its group.  Otherwise
 * groups are assigned to the pens in turn. */
#ifndef INK_PENS_H
#define INK_PENS_H

#include "drawing/drawing.h"
#include "scene/scene.h"
#include "view/sheet.h"

#define PENS_NONE UINT32_MAX

struct pens {
  /* Pens are numbered from 0; PENS_NONE where none is given. */
  uint32_t of_class[RECTO_EDGE_CLASS_COUNT]; /* by the index of the bit */
  uint32_t of_hidden, of_hatch;
  uint32_t *of_group; /* one a group of the scene */
  size_t group_count;
  uint32_t count;       /* one more than the highest pen in use */
  bool several;         /* visible lines may be on more than one pen */
  const recto_pen *own; /* of the first own_count pens; lent by the options */
  size_t own_count;
  double weight[RECTO_EDGE_CLASS_COUNT]; /* in pen widths, by the index of
                                            the bit */
  unsigned dashed;                       /* classes drawn as dashes, a mask */
  double width_mm, shortest_mm;          /* from the options */
  double seam_mm; /* of fills whose outline lines must cover; 0: none */
  bool exact;
};

/* Call pens_fini whatever the status.
 * options  in range (options_copy_valid), valid until pens_fini
 * Errors   RECTO_ERROR_ARGUMENT: a pen is for a group that the scene does not
 *          have; RECTO_ERROR_MEMORY. */
USE_RESULT recto_status pens_init(struct pens *pens, const struct scene *scene,
                                  const recto_options *options,
                                  recto_error *error);
void pens_fini(struct pens *pens);

/* Whether a name means a group: its whole name, or one of the parts between
 * slashes, which join object, group and material. */
bool pens_is_name_of(const char *name, const char *group);

/* Whether lines of the class with that bit index are requested. */
bool pens_is_drawn(const recto_options *options, unsigned place);

/* Warns about pens with nothing to draw under these options, and about weights
 * of classes that are not requested. */
void pens_warn_unused(const struct pens *pens, const recto_options *options);

/* Warns about pens and dashes of classes of which a view has no line, visible
 * or not; not where it has no lines at all.
 * sheet  with the lines in which faces pierce each other */
void pens_warn_absent(const struct sheet *sheet, const recto_options *options);

/* The pen of visible lines of a class, of hidden lines, of hatching, of fills.
 * */
uint32_t pens_of_line(const struct pens *pens, unsigned edge_class,
                      uint32_t group);
uint32_t pens_of_hidden(const struct pens *pens, const recto_options *options,
                        unsigned edge_class, uint32_t group);
uint32_t pens_of_hatch(const struct pens *pens, uint32_t group);
static inline uint32_t pens_of_group(const struct pens *pens, uint32_t group) {
  return group < pens->group_count ? pens->of_group[group] : 0;
}

double pens_width_mm(const struct pens *pens, uint32_t pen);

/* How far from a line of the pen and class, at most, a shorter one lies in its
 * ink: half a pen, and no more than is left of the line beside a seam, so that
 * it covers outlines of fills there; half a pen where next to nothing is. */
double pens_ink_reach_mm(const struct pens *pens, uint32_t pen,
                         unsigned edge_class);

/* The lengths below which strokes of the pen are dropped: any line, at most
 * half the pen; chains of creases with a free end; lines of hatching. */
double pens_shortest_line_mm(const struct pens *pens, uint32_t pen);
double pens_shortest_crease_mm(const struct pens *pens, uint32_t pen);
double pens_shortest_hatch_mm(const struct pens *pens, uint32_t pen);

/* The angle at which faces must meet somewhere along creases that end free, for
 * them to be drawn; 0: none. */
double pens_crease_start_deg(const recto_options *options);

/* The same where they are a zigzag. */
double pens_zigzag_start_deg(const recto_options *options);

/* A cycle of creases is short if it is no longer. */
double pens_short_cycle_mm(const struct pens *pens, uint32_t pen);

/* Silhouettes within the picture that touch nothing are drawn if they are as
 * long. */
double pens_shortest_isolated_mm(const struct pens *pens, uint32_t pen);

/* Contours of a smooth surface that touch nothing, which may end in cusps, are
 * drawn if they are as long. */
double pens_shortest_contour_mm(const struct pens *pens, uint32_t pen);

/* The width of visible lines of a class, in pen widths. */
double pens_weight(const struct pens *pens, unsigned edge_class);

/* Equal for two classes of visible lines with equal weights and without dashes,
 * which may be joined into one stroke. */
unsigned pens_weight_id(const struct pens *pens, unsigned edge_class);

#endif
