/* cover.h - what nearer triangles leave of one triangle. */
#ifndef VISIBILITY_COVER_H
#define VISIBILITY_COVER_H

#include "visibility/contact.h"
#include "visibility/fragments.h"

struct cover {
  const struct sheet *sheet;
  uint32_t triangle; /* the one at hand */
  struct triangle_plane plane;
  struct page_box box;
  geom_pieces left, scratch; /* what is left of it, in disjoint pieces */
  bool whole;                /* nothing was taken yet */
  /* Counts for --stats: pairs whose boxes meet; of these, depth had to be
   * asked; of these, the planes cross. */
  uint64_t pairs, overlapping, crossings;
  struct arena arena;
};

void cover_init(struct cover *cover, const struct sheet *sheet);
void cover_fini(struct cover *cover);

/* Starts anew with a triangle that is not flat.
 * part  a part of it to start with; NULL: all of it */
USE_RESULT bool cover_start(struct cover *cover, uint32_t triangle,
                            const struct geom_convex *part);

/* Takes away where triangle g, not flat, is nearer. */
USE_RESULT bool cover_take_nearer(struct cover *cover, uint32_t g);

/* Takes away the convex region left of `count` lines; they are copied. */
USE_RESULT bool cover_take(struct cover *cover, const struct geom_line *line,
                           const struct geom_line *back, int count);

/* Keeps only what is left of `count` lines; they are copied. */
USE_RESULT bool cover_keep(struct cover *cover, const struct geom_line *line,
                           const struct geom_line *back, int count);

static inline bool cover_is_empty(const struct cover *cover) {
  return cover->left.count == 0;
}

/* Hands what is left to the fragments. */
USE_RESULT bool cover_file(struct cover *cover, struct fragments *fragments);

/* Adds the counts. */
void cover_report(const struct cover *cover, struct report *report);

#endif
