/* bvh.h - a bounding volume hierarchy of the triangles of one long list: which
 * of them may hide a part of an edge.
 *
 * A node bounds its triangles by
 *   - their extents in six directions of the page, as a 12-DOP: four fixed ones
 *     and two along which many triangles of the list have a side;
 *   - sectors about the corners that all of them share;
 *   - the depth of the nearest corner;
 *   - a plane that none of them is in front of (upper_plane.h).
 * The first two exclude what lies beside the edge, the others what is behind
 * it.  The triangles of a node are near each other in space: they are sorted
 * along a Z-order curve, and each node has one half of those of its parent.
 *
 * Unlike a BSP, each triangle is in one leaf alone, and the cost of a query
 * follows what may hide the edge even where all triangles overlap on the page,
 * share a vertex or an edge, or are almost the same.
 *
 * Source  bounding volume hierarchies: [Rubin1980]; k-DOPs: [Klosowski1998];
 *         Z order: [Morton1966].
 */
#ifndef VISIBILITY_INDEX_BVH_H
#define VISIBILITY_INDEX_BVH_H

#include "view/sheet.h"
#include "visibility/index/common_corners.h"
#include "visibility/predicate/depth_plane.h"

enum {
  BVH_DIRECTIONS = 6, /* of the extents */
  BVH_LEVELS = 32     /* more than the depth of any tree */
};

struct bvh_node {
  int64_t least[BVH_DIRECTIONS], most[BVH_DIRECTIONS];
  int64_t nearest; /* -1: there is no triangle that may hide something */
  double contact;  /* depth: no triangle hides what is behind it by less */
  struct depth_plane upper;
  struct page_sector sector[2];
  int sectors; /* number of them */
};

/* A complete binary tree: the children of node k are 2 k and 2 k + 1, the root
 * is node 1, and leaf i is node leaves + i. */
struct bvh {
  int64_t x[BVH_DIRECTIONS], y[BVH_DIRECTIONS]; /* the extent of a point in
                                                   direction k: x px + y py */
  size_t leaves, count;
  struct bvh_node *node;
};

/* Zero-initialised is empty. */
void bvh_fini(struct bvh *bvh);

/* Builds the tree of a list, which is reordered: each leaf is a range of it.
 * Triangles seen edge-on hide nothing and do not count.
 * Returns false when memory ran out.
 * Cost  O(count log count) */
USE_RESULT bool bvh_init(struct bvh *bvh, const struct sheet *sheet,
                         uint32_t *triangle, size_t count);

/* The edge of a query, or the part of it that is left. */
struct bvh_query {
  int64_t least[BVH_DIRECTIONS], most[BVH_DIRECTIONS];
  int64_t low;              /* no point of the part is farther */
  struct geom_point p, q;   /* the ends of the whole edge */
  struct geom_point end[2]; /* those of the part, off by up to `off` */
  int64_t off;
  double from, to; /* the part, in the edge's parameter */
  bool whole;      /* the part is the whole edge */
};

/* Sets the query to the part of an edge.
 * end  the part's ends, rounded where they are not those of the edge */
void bvh_query_set(struct bvh_query *query, const struct bvh *bvh,
                   struct geom_segment edge, const struct geom_point end[2],
                   double from, double to);

/* A traversal of the leaves that may hide something of the part, from near to
 * far; the query may be set anew, for a shorter part, between two leaves. */
struct bvh_traversal {
  uint32_t stack[BVH_LEVELS + 1];
  int depth;
};

static inline struct bvh_traversal bvh_traversal_start(void) {
  return (struct bvh_traversal){{1}, 1};
}

/* Finds the next leaf, a range of the list; false at the end. */
bool bvh_next(const struct bvh *bvh, struct bvh_traversal *traversal,
              const struct bvh_query *query, size_t *from, size_t *to);

#endif
