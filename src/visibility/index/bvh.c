/* bvh.c - a bounding volume hierarchy of the triangles of one long list.
 *
 * Why no occluder is missed.  A triangle hides points of an edge strictly
 * inside its projection, where the edge is behind its plane by more than the
 * contact tolerance (occlusion.h).
 *   - Where the extents of the part of the edge and of the triangle do not
 *     meet, no point of the part is inside the projection.
 *   - Where no point of the triangle is in front of the upper plane, and no
 *     point of the edge is behind that plane by more than the tolerance, none
 *     is behind the triangle by more.
 *   - Where the ends of a part of the edge are not behind the plane, or nearer
 *     than all corners of the triangle, all points of the part are in front of
 *     the triangle.
 *   - Of an edge that starts on a corner of the triangle, the end or the place
 *     where it leaves the projection decides for all of it.  Where the part is
 *     the whole edge, that place is bounded as every other.  Otherwise a point
 *     of the part is in front of the triangle; so is all of the edge, since the
 *     difference is linear and 0 at the corner.
 */
#include "visibility/index/bvh.h"

#include <math.h>

#include "base/sort.h"
#include "visibility/index/upper_plane.h"
#include "visibility/predicate/contact.h"

enum {
  LEAF_MAX = 8, /* triangles of a leaf */
  FIXED = 4,    /* directions that do not depend on the list */
  SAMPLE = 32,  /* triangles by which the others are chosen */
  AXIS_BITS = 20
};

/* Two sides have one direction where their sine is below this. */
#define PARALLEL 0x1p-10

/* More than the relative error of a few operations in double. */
#define ROUNDING 0x1p-40

void bvh_fini(struct bvh *bvh) {
  mem_free(bvh->node);
  bvh->node = NULL;
}

static inline size_t leaf_start(const struct bvh *bvh, size_t leaf) {
  return bvh->count * leaf / bvh->leaves;
}

/* ---- Directions ---------------------------------------------------------- */

/* A direction of the page. */
struct side {
  int64_t x, y;
};

static bool sides_are_parallel(struct side a, struct side b) {
  double cross = fabs((double)a.x * (double)b.y - (double)a.y * (double)b.x);
  return cross <= PARALLEL * hypot((double)a.x, (double)a.y) *
                      hypot((double)b.x, (double)b.y);
}

/* Draws the sides of a sample of the list; returns their number. */
static int draw_sides(const struct sheet *sheet, const uint32_t *triangle,
                      size_t count, struct side side[3 * SAMPLE]) {
  int n = 0;
  for (size_t i = 0; i < SAMPLE; i++) {
    struct geom_triangle at =
        sheet_corners(sheet, triangle[i * count / SAMPLE]);
    for (int k = 0; k < 3; k++) {
      struct geom_point a = at.p[k], b = at.p[geom_next_corner(k)];
      struct side s = {(int64_t)b.x - a.x, (int64_t)b.y - a.y};
      if (s.x != 0 || s.y != 0)
        side[n++] = s;
    }
  }
  return n;
}

/* Chooses the direction of the side that most others are parallel to, and
 * removes these; returns how many they are. */
static int take_direction(struct side *side, int *n, struct side *direction) {
  int best = 0, most = 0, kept = 0;
  for (int i = 0; i < *n; i++) {
    int parallel = 0;
    for (int j = 0; j < *n; j++)
      parallel += sides_are_parallel(side[i], side[j]);
    if (parallel > most) {
      most = parallel;
      best = i;
    }
  }
  if (most == 0)
    return 0;
  *direction = side[best];
  for (int j = 0; j < *n; j++)
    if (!sides_are_parallel(*direction, side[j]))
      side[kept++] = side[j];
  *n = kept;
  return most;
}

static void choose_directions(struct bvh *bvh, const struct sheet *sheet,
                              const uint32_t *triangle, size_t count) {
  const struct side fixed[FIXED] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
  struct side side[3 * SAMPLE];
  int n = draw_sides(sheet, triangle, count, side);
  for (int k = 0; k < BVH_DIRECTIONS; k++) {
    struct side along = fixed[k % FIXED];
    if (k >= FIXED)
      (void)take_direction(side, &n, &along);
    bvh->x[k] = -along.y;
    bvh->y[k] = along.x;
  }
}

static inline int64_t extent_of(const struct bvh *bvh, int k,
                                struct geom_point p) {
  return bvh->x[k] * p.x + bvh->y[k] * p.y;
}

/* ---- Order --------------------------------------------------------------- */

/* Moves the low bits to every third bit. */
static uint64_t spread_to_thirds(uint64_t bits) {
  bits = (bits | bits << 32) & UINT64_C(0x001f00000000ffff);
  bits = (bits | bits << 16) & UINT64_C(0x001f0000ff0000ff);
  bits = (bits | bits << 8) & UINT64_C(0x100f00f00f00f00f);
  bits = (bits | bits << 4) & UINT64_C(0x10c30c30c30c30c3);
  return (bits | bits << 2) & UINT64_C(0x1249249249249249);
}

/* The sums of the corners' coordinates: three times the centroid. */
struct centroid {
  int64_t at[3];
};

static struct centroid centroid_of(const struct sheet *sheet,
                                   uint32_t triangle) {
  struct geom_triangle c = sheet_corners(sheet, triangle);
  return (struct centroid){{(int64_t)c.p[0].x + c.p[1].x + c.p[2].x,
                            (int64_t)c.p[0].y + c.p[1].y + c.p[2].y,
                            c.p[0].z + c.p[1].z + c.p[2].z}};
}

/* Sorts the list along a Z-order curve through the centroids. */
static bool sort_by_place(const struct sheet *sheet, uint32_t *triangle,
                          size_t count) {
  struct sort_key *key = mem_alloc(count, sizeof *key);
  struct centroid least = centroid_of(sheet, triangle[0]), most = least;
  int shift[3];
  if (key == NULL)
    return false;
  for (size_t i = 1; i < count; i++) {
    struct centroid c = centroid_of(sheet, triangle[i]);
    for (int k = 0; k < 3; k++) {
      least.at[k] = c.at[k] < least.at[k] ? c.at[k] : least.at[k];
      most.at[k] = c.at[k] > most.at[k] ? c.at[k] : most.at[k];
    }
  }
  for (int k = 0; k < 3; k++)
    for (shift[k] = 0; (most.at[k] - least.at[k]) >> shift[k] >> AXIS_BITS;)
      shift[k]++;
  for (size_t i = 0; i < count; i++) {
    struct centroid c = centroid_of(sheet, triangle[i]);
    key[i] = (struct sort_key){0, triangle[i]};
    for (int k = 0; k < 3; k++)
      key[i].key |=
          spread_to_thirds((uint64_t)(c.at[k] - least.at[k]) >> shift[k]) << k;
  }
  bool ok = sort_keys_alone(key, count);
  for (size_t i = 0; ok && i < count; i++)
    triangle[i] = key[i].value;
  mem_free(key);
  return ok;
}

/* ---- Bounds -------------------------------------------------------------- */

static struct bvh_node empty_bvh_node(void) {
  struct bvh_node node = {.nearest = -1, .contact = INFINITY};
  for (int k = 0; k < BVH_DIRECTIONS; k++) {
    node.least[k] = INT64_MAX;
    node.most[k] = INT64_MIN;
  }
  return node;
}

static void extend_node(struct bvh_node *node, const struct bvh_node *other) {
  for (int k = 0; k < BVH_DIRECTIONS; k++) {
    if (other->least[k] < node->least[k])
      node->least[k] = other->least[k];
    if (other->most[k] > node->most[k])
      node->most[k] = other->most[k];
  }
  if (other->nearest > node->nearest)
    node->nearest = other->nearest;
  node->contact = fmin(node->contact, other->contact);
}

static void extend_by_point(struct bvh_node *node, const struct bvh *bvh,
                            struct geom_point p) {
  struct bvh_node at = {.nearest = p.z, .contact = INFINITY};
  for (int k = 0; k < BVH_DIRECTIONS; k++)
    at.least[k] = at.most[k] = extent_of(bvh, k, p);
  extend_node(node, &at);
}

/* The least contact tolerance of a triangle, as a depth: that of the page grid
 * (occlusion.h), less what rounding may add. */
static double contact_depth(const struct sheet *sheet, uint32_t triangle) {
  struct geom_plane plane = sheet_plane(sheet, triangle);
  return contact_grid_units(sheet) * (1 - ROUNDING) *
         (1 +
          (fabs((double)plane.nx) + fabs((double)plane.ny)) / (double)plane.nz);
}

static void bound_leaf(struct bvh *bvh, const struct sheet *sheet,
                       const uint32_t *triangle, size_t leaf) {
  struct bvh_node *node = &bvh->node[bvh->leaves + leaf];
  *node = empty_bvh_node();
  for (size_t i = leaf_start(bvh, leaf); i < leaf_start(bvh, leaf + 1); i++) {
    struct geom_triangle corners = sheet_corners(sheet, triangle[i]);
    if (sheet_is_edge_on(sheet, triangle[i]))
      continue;
    for (int k = 0; k < 3; k++)
      extend_by_point(node, bvh, corners.p[k]);
    node->contact = fmin(node->contact, contact_depth(sheet, triangle[i]));
  }
}

/* The bounds of a node that depend on all of its triangles together. */
static void bound_node(struct bvh_node *node, const struct sheet *sheet,
                       const uint32_t *triangle, size_t count) {
  struct common_corners common = common_corners_of(sheet, triangle, count);
  node->upper = upper_plane_of(sheet, triangle, count, &common);
  node->sectors = 0;
  for (int k = 0; k < common.count && k < 2; k++)
    node->sectors += page_sector_of(sheet, triangle, count, common.p[k],
                                    &node->sector[node->sectors]);
}

bool bvh_init(struct bvh *bvh, const struct sheet *sheet, uint32_t *triangle,
              size_t count) {
  bvh->count = count;
  bvh->leaves = 1;
  while (bvh->leaves * LEAF_MAX < count)
    bvh->leaves *= 2;
  bvh->node = mem_alloc(2 * bvh->leaves, sizeof *bvh->node);
  if (bvh->node == NULL || !sort_by_place(sheet, triangle, count))
    return false;
  choose_directions(bvh, sheet, triangle, count);
  for (size_t leaf = 0; leaf < bvh->leaves; leaf++)
    bound_leaf(bvh, sheet, triangle, leaf);
  for (size_t k = bvh->leaves - 1; k > 0; k--) {
    bvh->node[k] = bvh->node[2 * k];
    extend_node(&bvh->node[k], &bvh->node[2 * k + 1]);
  }
  for (size_t span = bvh->leaves, level = 1; level <= bvh->leaves;
       level *= 2, span /= 2)
    for (size_t i = 0; i < level; i++) {
      size_t from = leaf_start(bvh, i * span),
             to = leaf_start(bvh, (i + 1) * span);
      bound_node(&bvh->node[level + i], sheet, triangle + from, to - from);
    }
  return true;
}

/* ---- Queries ------------------------------------------------------------- */

void bvh_query_set(struct bvh_query *query, const struct bvh *bvh,
                   struct geom_segment edge, const struct geom_point end[2],
                   double from, double to) {
  bool whole = from <= 0 && to >= 1;
  for (int k = 0; k < BVH_DIRECTIONS; k++) {
    int64_t a = extent_of(bvh, k, end[0]), b = extent_of(bvh, k, end[1]);
    int64_t x = bvh->x[k], y = bvh->y[k];
    /* Rounding moved the ends by less than a unit in x and in y.  Otherwise, an
     * edge that only an end of touches the bounds is outside of them. */
    int64_t off = whole ? -(a != b) : (x < 0 ? -x : x) + (y < 0 ? -y : y);
    query->least[k] = (a < b ? a : b) - off;
    query->most[k] = (a < b ? b : a) + off;
  }
  query->low = (end[0].z < end[1].z ? end[0].z : end[1].z) - !whole;
  query->end[0] = end[0];
  query->end[1] = end[1];
  query->off = !whole;
  query->p = edge.p;
  query->q = edge.q;
  query->from = from;
  query->to = to;
  query->whole = whole;
}

/* How far a point is in front of a plane, and the error bound of that. */
struct depth_above {
  double depth, off;
};

static inline struct depth_above depth_above(const struct depth_plane *plane,
                                             struct geom_point p) {
  double depth = (double)p.z - depth_plane_at(plane, p.x, p.y);
  return (struct depth_above){depth, depth_plane_error(plane, p.x, p.y) +
                                         FILTER_ERROR * fabs(depth)};
}

/* Is no point of the part behind the node's upper plane by more than it may
 * be? */
static inline bool part_is_in_front(const struct bvh_node *node,
                                    const struct bvh_query *query) {
  struct depth_above p = depth_above(&node->upper, query->p),
                     q = depth_above(&node->upper, query->q);
  double off = p.off + q.off - (query->whole ? node->contact : 0);
  return p.depth + query->from * (q.depth - p.depth) >= off &&
         p.depth + query->to * (q.depth - p.depth) >= off;
}

/* May a triangle of the node hide a point of the part? */
static inline bool may_hide(const struct bvh_node *node,
                            const struct bvh_query *query) {
  if (query->low > node->nearest)
    return false;
  for (int k = 0; k < BVH_DIRECTIONS; k++)
    if (query->least[k] > node->most[k] || query->most[k] < node->least[k])
      return false;
  for (int k = 0; k < node->sectors; k++)
    if (page_sector_excludes(&node->sector[k], query->end, query->off))
      return false;
  return !part_is_in_front(node, query);
}

bool bvh_next(const struct bvh *bvh, struct bvh_traversal *traversal,
              const struct bvh_query *query, size_t *from, size_t *to) {
  while (traversal->depth > 0) {
    uint32_t k = traversal->stack[--traversal->depth];
    if (!may_hide(&bvh->node[k], query))
      continue;
    if (k >= bvh->leaves) {
      *from = leaf_start(bvh, k - bvh->leaves);
      *to = leaf_start(bvh, k - bvh->leaves + 1);
      return true;
    }
    bool swap = bvh->node[2 * k].nearest < bvh->node[2 * k + 1].nearest;
    traversal->stack[traversal->depth++] = 2 * k + !swap;
    traversal->stack[traversal->depth++] = 2 * k + swap;
  }
  return false;
}
