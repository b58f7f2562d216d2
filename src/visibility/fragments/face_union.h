/* face_union.h - unites the visible pieces of a face into its fragments, and
 * labels their sides: phases 3 and 4 of fragments.h, in one thread. */
#ifndef VISIBILITY_FRAGMENTS_FACE_UNION_H
#define VISIBILITY_FRAGMENTS_FACE_UNION_H

#include "base/parallel.h"
#include "geom/region.h"
#include "visibility/fragments/fragments.h"
#include "visibility/fragments/planar_subdivision.h"
#include "visibility/fragments/side_provenance.h"

/* A side of a face's outline: the point where it starts, and its edge. */
struct outline_side {
  uint32_t point, edge;
};

/* The outline of an entirely visible face, which is its fragment. */
struct face_outline {
  uint32_t count;
  struct outline_side
      side[4]; /* the first starts at the least point in (x, y) */
};

/* Fragments of consecutive faces, with indices of their own. */
struct union_output {
  ARRAY(struct map_fragment) fragment;
  ARRAY(struct map_loop) loop;
  ARRAY(struct map_corner) corner;
  side_lines lines; /* of the sides stored */
};

/* The state of uniting and labelling, face by face; one a thread. */
struct face_union {
  const struct fragments *fragments;
  struct union_output *output; /* where the current face is stored */
  uint32_t face;
  ARRAY(uint32_t) own;  /* the face's triangles that have area */
  ARRAY(uint32_t) seen; /* those with visible pieces, ascending */
  struct side_provenance provenance;
  struct triangle_grid_query query; /* made for the first face that needs it */
  geom_pieces piece;
  struct geom_region region;
  struct arena scratch;
  struct progress progress;
  struct fragments_counts counts;
  char apart[PARALLEL_APART];
};

/* sides  of all faces without an outline and all triangles near them; read by
 *        face_union_store */
void face_union_init(struct face_union *work, const struct fragments *fragments,
                     const struct line_index *sides);
void face_union_fini(struct face_union *work);

/* Finds whether a face is one or two triangles, entirely visible, whose outer
 * sides are all edges, and that turns at each corner: its outline is then its
 * one fragment, stored without the arithmetic of regions.
 * piece  all those of the face
 * Returns false when memory ran out. */
USE_RESULT bool face_union_has_outline(struct face_union *work,
                                       const struct fragment_piece *piece,
                                       size_t count, uint8_t *has_outline);

/* Stores the fragments of a face.
 * piece        all those of the face
 * has_outline  by face_union_has_outline
 * Returns false when memory ran out. */
USE_RESULT bool face_union_store(struct face_union *work,
                                 const struct fragment_piece *piece,
                                 size_t count, bool has_outline,
                                 struct union_output *output);

#endif
