/* candidate_pairs.c - pairs of triangles that may pierce each other.
 *
 * Cell by cell, a sweep in depth, from the farthest triangle to the nearest,
 * finds every pair whose depths overlap (sweep and prune).  Boxes, shared
 * corners, filtered planes (plane_filter.h) and separating sides on the page
 * reject most of them.  A long list is split by a BSP before (bsp.h).
 */
#include "visibility/intersection/candidate_pairs.h"

#include "base/sort.h"
#include "visibility/index/bsp.h"
#include "visibility/predicate/plane_filter.h"

/* The shortest list for which a BSP is worth while. */
enum { BSP_LIST_MIN = 256 };

/* The shortest list of which the most frequent face or edge is looked for; the
 * latter in a sample of so many triangles. */
enum { FACE_LIST_MIN = 64 };

/* What the tests use of a triangle, computed once per list. */
struct swept_triangle {
  struct box2 box;
  int64_t low, high; /* depths of the farthest and the nearest corner */
  int x0, y0;        /* the cell of the box's lower left corner */
  uint32_t triangle;
  uint64_t right_copy; /* bsp.h */
  bool in_group;       /* it is not tested with others that are, too */
  bool has_plane;      /* `plane` has been computed */
  struct plane_filter plane;
};

static void make_swept_triangle(const struct pair_sweep *sweep,
                                uint32_t triangle, uint64_t right_copy,
                                struct swept_triangle *s) {
  const struct sheet *sheet = sweep->sheet;
  const struct triangle_grid *grid = sweep->grid;
  const uint32_t *p = sheet->triangle.item[triangle].point;
  s->box = box2_of_triangle(sheet, triangle);
  s->low = s->high = sheet->point.item[p[0]].z;
  for (int k = 1; k < 3; k++) {
    int64_t z = sheet->point.item[p[k]].z;
    if (z < s->low)
      s->low = z;
    if (z > s->high)
      s->high = z;
  }
  s->x0 = triangle_grid_cell(s->box.x0, grid->x0, grid->shift, grid->columns);
  s->y0 = triangle_grid_cell(s->box.y0, grid->y0, grid->shift, grid->rows);
  s->triangle = triangle;
  s->right_copy = right_copy;
  s->in_group = false;
  s->has_plane = false;
}

/* Are both triangles listed in a cell that is selected? */
static bool is_pair_selected(const struct pair_sweep *sweep, int x, int y) {
  const struct triangle_grid *grid = sweep->grid;
  size_t cell = triangle_grid_index(grid, x, y);
  if (sweep->cells != NULL && !sweep->cells[cell])
    return false;
  return grid->lists.start[cell] < grid->lists.start[cell + 1];
}

/* A pair may be listed together in several cells; it is tested only in the
 * first of them, mostly the one with the lower left corner of the boxes'
 * intersection.  Is that the current cell? */
static bool is_cell_of_pair(const struct pair_sweep *sweep,
                            const struct swept_triangle *f,
                            const struct swept_triangle *g) {
  const struct triangle_grid *grid = sweep->grid;
  int x0 = f->x0 > g->x0 ? f->x0 : g->x0, y0 = f->y0 > g->y0 ? f->y0 : g->y0;
  if (x0 == sweep->x && y0 == sweep->y)
    return true;
  if (is_pair_selected(sweep, x0, y0))
    return false;
  int x1 = triangle_grid_cell(box2_min(f->box.x1, g->box.x1), grid->x0,
                              grid->shift, grid->columns);
  for (int y = y0; y <= sweep->y; y++) {
    int end = y < sweep->y ? x1 : sweep->x - 1;
    for (int x = x0; x <= end; x++)
      if (is_pair_selected(sweep, x, y))
        return false;
  }
  return true;
}

/* How many corners two triangles share, and the index of the last of these in
 * each. */
struct shared_corners {
  int count, in_f, in_g;
};

static struct shared_corners list_shared_corners(const uint32_t f[3],
                                                 const uint32_t g[3]) {
  struct shared_corners shared = {0, 0, 0};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      if (f[i] == g[j])
        shared = (struct shared_corners){shared.count + 1, i, j};
  return shared;
}

/* The sector of a triangle at a corner: the vectors from there to the next
 * corner and to the one before. */
struct sector {
  int64_t x[2], y[2];
};

static struct sector sector_of(const struct sheet *sheet, const uint32_t p[3],
                               int corner) {
  struct geom_point v = sheet->point.item[p[corner]],
                    a = sheet->point.item[p[geom_next_corner(corner)]],
                    b = sheet->point.item[p[corner == 0 ? 2 : corner - 1]];
  return (struct sector){{(int64_t)a.x - v.x, (int64_t)b.x - v.x},
                         {(int64_t)a.y - v.y, (int64_t)b.y - v.y}};
}

/* Does a side of sector f separate it from g: is all of g strictly to the right
 * of its first side, or to the left of its last? */
static bool is_separated_by(const struct sector *f, const struct sector *g) {
  return (f->x[0] * g->y[0] < f->y[0] * g->x[0] &&
          f->x[0] * g->y[1] < f->y[0] * g->x[1]) ||
         (f->x[1] * g->y[0] > f->y[1] * g->x[0] &&
          f->x[1] * g->y[1] > f->y[1] * g->x[1]);
}

/* Do two counter-clockwise triangles that share a corner have no other point of
 * the page in common?  On a dense mesh nearly all such pairs have none. */
static bool are_disjoint_at_corner(const struct sheet *sheet,
                                   const uint32_t f[3], const uint32_t g[3],
                                   struct shared_corners shared) {
  struct sector a = sector_of(sheet, f, shared.in_f),
                b = sector_of(sheet, g, shared.in_g);
  return is_separated_by(&a, &b) || is_separated_by(&b, &a);
}

/* Is the side that triangle f shares with a triangle of corners q an edge of
 * the mesh? */
static bool is_mesh_edge(const struct sheet *sheet, uint32_t f,
                         const uint32_t q[3]) {
  const uint32_t *p = sheet->triangle.item[f].point;
  int other = 0; /* the corner of f that is not shared */
  while (p[other] == q[0] || p[other] == q[1] || p[other] == q[2])
    other++;
  return !sheet_is_inner_side(sheet, f, geom_next_corner(other));
}

/* Do two triangles share an edge of the mesh, a diagonal of one face, or a
 * corner and nothing more?  Then they do not pierce each other.  Where a side
 * that they share is a diagonal of one of two faces, these may cross in it. */
static bool are_neighbours(const struct sheet *sheet, uint32_t f, uint32_t g) {
  const uint32_t *p = sheet->triangle.item[f].point,
                 *q = sheet->triangle.item[g].point;
  struct shared_corners shared = list_shared_corners(p, q);
  switch (shared.count) {
  case 0:
    return false;
  case 1:
    return are_disjoint_at_corner(sheet, p, q, shared);
  case 2:
    return sheet->triangle.item[f].face == sheet->triangle.item[g].face ||
           (is_mesh_edge(sheet, f, q) && is_mesh_edge(sheet, g, p));
  default:
    return true;
  }
}

/* May f straddle the plane of g or end on it? */
static bool may_pierce(const struct sheet *sheet,
                       const struct swept_triangle *f,
                       struct swept_triangle *g) {
  if (!g->has_plane)
    g->plane = plane_filter_of(sheet, g->triangle);
  g->has_plane = true;
  return plane_filter_may_intersect(&g->plane,
                                    sheet_corners(sheet, f->triangle).p);
}

/* Is all of g to the right of a side of f on the page, by more than the
 * distance of lines that count as coincident? */
static bool is_outside_triangle(const struct sheet *sheet, uint32_t f,
                                uint32_t g) {
  struct geom_triangle p = sheet_corners(sheet, f), q = sheet_corners(sheet, g);
  for (int k = 0; k < 3; k++) {
    struct geom_point a = p.p[k], b = p.p[geom_next_corner(k)];
    int64_t dx = (int64_t)b.x - a.x, dy = (int64_t)b.y - a.y;
    int64_t near =
        BSP_PLANE_MARGIN * ((dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy));
    if (geom_orient2d(a, b, q.p[0]) < -near &&
        geom_orient2d(a, b, q.p[1]) < -near &&
        geom_orient2d(a, b, q.p[2]) < -near)
      return true;
  }
  return false;
}

/* Visits a pair whose depths overlap, unless a test rejects it. */
static bool visit_pair(const struct pair_sweep *sweep, struct swept_triangle *f,
                       struct swept_triangle *g) {
  if (box2_disjoint(f->box, g->box) || (f->right_copy & g->right_copy) != 0 ||
      !is_cell_of_pair(sweep, f, g) ||
      are_neighbours(sweep->sheet, f->triangle, g->triangle) ||
      !may_pierce(sweep->sheet, f, g) || !may_pierce(sweep->sheet, g, f) ||
      is_outside_triangle(sweep->sheet, f->triangle, g->triangle) ||
      is_outside_triangle(sweep->sheet, g->triangle, f->triangle))
    return true;
  return f->triangle < g->triangle
             ? sweep->visit(sweep->user, f->triangle, g->triangle)
             : sweep->visit(sweep->user, g->triangle, f->triangle);
}

/* Starts a list, with room for n triangles. */
static bool start_list(struct pair_sweep *sweep, size_t n) {
  sweep->swept.count = 0;
  return ARRAY_RESERVE(&sweep->swept, n) && ARRAY_RESERVE(&sweep->key, 2 * n);
}

static void add_to_list(struct pair_sweep *sweep, uint32_t triangle,
                        uint64_t right_copy) {
  size_t i = sweep->swept.count++;
  make_swept_triangle(sweep, triangle, right_copy, &sweep->swept.item[i]);
  sweep->key.item[i] =
      (struct sort_key){(uint64_t)sweep->swept.item[i].low, (uint32_t)i};
}

/* ---- Groups -------------------------------------------------------------- */

/* Triangles of a list that are not tested with each other: those of one face,
 * of which a polygon of many corners has very many, or those about one edge of
 * the mesh, which have nothing else in common. */
struct pair_group {
  uint32_t face;     /* SHEET_NONE: the edge counts */
  uint32_t point[2]; /* the edge's ends; SHEET_NONE: there is no group */
};

/* Does a triangle have an edge of the mesh between these points as a side? */
static bool has_mesh_edge(const struct sheet *sheet, uint32_t f,
                          const uint32_t point[2]) {
  const uint32_t *p = sheet->triangle.item[f].point;
  for (int k = 0; k < 3; k++) {
    uint32_t a = p[k], b = p[geom_next_corner(k)];
    if ((a == point[0] && b == point[1]) || (a == point[1] && b == point[0]))
      return !sheet_is_inner_side(sheet, f, k);
  }
  return false;
}

static bool is_in_group(const struct pair_sweep *sweep,
                        const struct pair_group *group, uint32_t f) {
  return group->face != SHEET_NONE
             ? sweep->sheet->triangle.item[f].face == group->face
             : group->point[0] != SHEET_NONE &&
                   has_mesh_edge(sweep->sheet, f, group->point);
}

/* The only face that may have more than half of the list's triangles, by the
 * majority vote of Boyer and Moore. */
static uint32_t majority_face(const struct pair_sweep *sweep) {
  uint32_t face = SHEET_NONE;
  size_t lead = 0;
  for (size_t i = 0; i < sweep->swept.count; i++) {
    uint32_t own =
        sweep->sheet->triangle.item[sweep->swept.item[i].triangle].face;
    if (lead == 0)
      face = own;
    lead = own == face ? lead + 1 : lead - 1;
  }
  return face;
}

/* Finds an edge that more than half of a sample of the list have, and the
 * list's middle triangle. */
static bool find_common_edge(const struct pair_sweep *sweep,
                             uint32_t point[2]) {
  const struct swept_triangle *swept = sweep->swept.item;
  size_t n = sweep->swept.count;
  const uint32_t *p = sweep->sheet->triangle.item[swept[n / 2].triangle].point;
  for (int k = 0; k < 3; k++) {
    size_t having = 0;
    point[0] = p[k];
    point[1] = p[geom_next_corner(k)];
    for (size_t i = 0; i < FACE_LIST_MIN; i++)
      having += has_mesh_edge(sweep->sheet,
                              swept[i * n / FACE_LIST_MIN].triangle, point);
    if (having > FACE_LIST_MIN / 2)
      return true;
  }
  return false;
}

static struct pair_group choose_group(const struct pair_sweep *sweep) {
  struct pair_group group = {SHEET_NONE, {SHEET_NONE, SHEET_NONE}};
  if (sweep->swept.count >= FACE_LIST_MIN &&
      !find_common_edge(sweep, group.point))
    group.face = majority_face(sweep);
  return group;
}

/* Marks the triangles of the group, and lists the keys of the others. */
static bool list_others(struct pair_sweep *sweep,
                        const struct pair_group *group) {
  sweep->other.count = 0;
  for (size_t i = 0; i < sweep->swept.count; i++) {
    struct swept_triangle *f = &sweep->swept.item[sweep->key.item[i].value];
    f->in_group = is_in_group(sweep, group, f->triangle);
    if (!f->in_group && !ARRAY_PUSH(&sweep->other, sweep->key.item[i]))
      return false;
  }
  return true;
}

/* ---- Sweeping ------------------------------------------------------------ */

/* Tests the pairs of the list, but not those of its group. */
static bool sweep_list(struct pair_sweep *sweep) {
  struct swept_triangle *swept = sweep->swept.item;
  struct sort_key *key = sweep->key.item;
  size_t n = sweep->swept.count, others = 0;
  struct pair_group group = choose_group(sweep);
  sort_keys(key, key + n, n);
  if (n >= FACE_LIST_MIN && !list_others(sweep, &group))
    return false;
  for (size_t i = 0; i < n; i++) {
    struct swept_triangle *f = &swept[key[i].value];
    const struct sort_key *g = f->in_group ? sweep->other.item : key;
    size_t end = f->in_group ? sweep->other.count : n;
    size_t first = f->in_group ? others : i + 1, j = first;
    others += !f->in_group;
    for (; j < end && g[j].key <= (uint64_t)f->high; j++)
      if (!visit_pair(sweep, f, &swept[g[j].value]))
        return false;
    sweep->met += j - first;
    if (!progress_step(sweep->progress, j - first + 1))
      return false;
  }
  return true;
}

/* Sweeps each leaf of the cell's tree. */
static bool sweep_bsp(struct pair_sweep *sweep) {
  const struct bsp *bsp = &sweep->bsp;
  for (size_t n = 0; n < bsp->node.count; n++) {
    const struct bsp_node *node = &bsp->node.item[n];
    if (node->child[0] != SHEET_NONE)
      continue;
    if (!start_list(sweep, node->count))
      return false;
    for (uint32_t i = node->from; i < node->from + node->count; i++)
      add_to_list(sweep, bsp->member.item[i].triangle,
                  bsp->member.item[i].right_copy);
    if (!sweep_list(sweep))
      return false;
  }
  return true;
}

static bool sweep_cell(struct pair_sweep *sweep, const uint32_t *item,
                       size_t n) {
  uint32_t root = SHEET_NONE;
  bsp_clear(&sweep->bsp);
  if (n >= BSP_LIST_MIN &&
      !bsp_add(&sweep->bsp, sweep->sheet, item, n, true, &root))
    return false;
  if (root != SHEET_NONE)
    return sweep_bsp(sweep);
  if (!start_list(sweep, n))
    return false;
  for (size_t i = 0; i < n; i++) {
    if (i + MEM_PREFETCH_AHEAD < n)
      sheet_prefetch_corners(sweep->sheet, item[i + MEM_PREFETCH_AHEAD]);
    add_to_list(sweep, item[i], 0);
  }
  return sweep_list(sweep);
}

bool pair_sweep_cells(struct pair_sweep *sweep, size_t begin, size_t end) {
  const struct triangle_grid *grid = sweep->grid;
  bool ok = true;
  for (size_t cell = begin; ok && cell < end; cell++) {
    size_t n = grid->lists.start[cell + 1] - grid->lists.start[cell];
    sweep->x = (int)(cell % (size_t)grid->columns);
    sweep->y = (int)(cell / (size_t)grid->columns);
    if (n > 1 && (sweep->cells == NULL || sweep->cells[cell]))
      ok = sweep_cell(sweep, grid->lists.item + grid->lists.start[cell], n);
  }
  return ok;
}

void pair_sweep_fini(struct pair_sweep *sweep) {
  ARRAY_FREE(&sweep->swept);
  ARRAY_FREE(&sweep->key);
  ARRAY_FREE(&sweep->other);
  bsp_fini(&sweep->bsp);
}
