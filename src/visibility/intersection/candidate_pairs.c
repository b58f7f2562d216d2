/* candidate_pairs.c - pairs of triangles that may pierce each other.
 *
 * Cell by cell, a sweep in depth, from the farthest triangle to the nearest,
 * finds every pair whose depths overlap (sweep and prune).  Boxes, shared
 * corners, filtered planes (plane_filter.h) and separating sides on the page
 * reject most of them.  A long list is split by a BSP before (bsp.h), and swept
 * along another direction where that leaves fewer pairs (sweep_direction.h).
 */
#include "visibility/intersection/candidate_pairs.h"

#include <string.h>

#include "base/sort.h"
#include "visibility/index/bsp.h"
#include "visibility/intersection/sweep_direction.h"
#include "visibility/intersection/swept_triangle.h"

/* The shortest list for which a BSP is worth while. */
enum { BSP_LIST_MIN = 256 };

/* The shortest list of which the most frequent face or edge is looked for; the
 * latter in a sample of so many triangles, from all over the list, unless none
 * of the first few has it. */
enum { FACE_LIST_MIN = 64, FIRST_SAMPLES = 12, SAMPLE_STEP = 37 };

/* Makes the box of a triangle that has its corners, and finds the cell of its
 * lower left corner: nothing is outside of the grid. */
static inline void make_box(const struct pair_sweep *sweep,
                            struct swept_triangle *s, struct swept_box *box) {
  const struct geom_point *p = s->corners.p;
  point_lanes a = point_lanes_of(&p[0]), b = point_lanes_of(&p[1]),
              c = point_lanes_of(&p[2]),
              low = point_lanes_min(point_lanes_min(a, b), c),
              high = point_lanes_max(point_lanes_max(a, b), c),
              cell = (low - sweep->first) >> sweep->grid->shift;
  s->box = (struct box2){low[0], low[1], high[0], high[1]};
  s->x0 = cell[0];
  s->y0 = cell[1];
  *box = swept_box_of(low, high, (cell < sweep->cell) & sweep->selected);
}

/* Makes what is used of a triangle, and its box; returns the depth of its
 * farthest corner.
 * right_copy  of bsp.h; 0 where the list is that of a cell */
static inline int64_t make_swept_triangle(const struct pair_sweep *sweep,
                                          uint32_t triangle,
                                          uint64_t right_copy,
                                          struct swept_triangle *s,
                                          struct swept_box *box) {
  const struct sheet *sheet = sweep->sheet;
  const uint32_t *own = sheet->triangle.item[triangle].point;
  const int32_t p = (int32_t)own[0], q = (int32_t)own[1], r = (int32_t)own[2];
  int64_t low;
  s->point[0] = (swept_numbers){p, q, r};
  s->point[1] = (swept_numbers){q, r, p};
  s->point[2] = (swept_numbers){r, p, q};
  s->corners = sheet_corners(sheet, triangle);
  make_box(sweep, s, box);
  geom_depth_range(s->corners.p, &low, &s->high);
  for (int k = 0; k < 3; k++)
    s->side[k] =
        vector_between(s->corners.p[k], s->corners.p[geom_next_corner(k)]);
  s->triangle = triangle;
  s->right_copy = right_copy;
  s->in_group = false;
  s->has_inner_sides = (sheet->triangle_flags[triangle] & 7 * SHEET_INNER) != 0;
  s->has_coarse_plane = false;
  s->has_plane = false;
  return low;
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

/* The corners of f by the coarse plane of g. */
static inline struct coarse_counts
counts_by_plane(const struct pair_sweep *sweep, const struct swept_triangle *f,
                struct swept_triangle *g) {
  if (!g->has_coarse_plane)
    g->coarse_plane = coarse_plane_of(&sweep->all, g->corners.p);
  g->has_coarse_plane = true;
  return coarse_plane_counts(&g->coarse_plane, f->corners.p);
}

/* May f straddle the plane of g or end on it? */
static bool may_pierce(const struct sheet *sheet,
                       const struct swept_triangle *f,
                       struct swept_triangle *g) {
  if (!g->has_plane)
    g->plane = plane_filter_of(sheet, g->triangle);
  g->has_plane = true;
  return plane_filter_may_intersect(&g->plane, f->corners.p);
}

/* Is all of g to the right of a side of f on the page, by more than the
 * distance of lines that count as coincident? */
static bool is_outside_triangle(const struct geom_point p[3],
                                const struct geom_point q[3]) {
  for (int k = 0; k < 3; k++) {
    struct geom_point a = p[k], b = p[geom_next_corner(k)];
    int64_t dx = (int64_t)b.x - a.x, dy = (int64_t)b.y - a.y;
    int64_t near =
        BSP_PLANE_MARGIN * ((dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy));
    if (geom_orient2d(a, b, q[0]) < -near &&
        geom_orient2d(a, b, q[1]) < -near && geom_orient2d(a, b, q[2]) < -near)
      return true;
  }
  return false;
}

/* Visits a pair whose depths and boxes overlap, unless a test rejects it. */
static inline bool visit_pair(const struct pair_sweep *sweep,
                              struct swept_triangle *f,
                              struct swept_triangle *g) {
  if ((f->right_copy & g->right_copy) != 0 || !is_cell_of_pair(sweep, f, g) ||
      are_neighbours(sweep->sheet, f, g))
    return true;
  struct coarse_counts of_f = counts_by_plane(sweep, f, g);
  if (!coarse_counts_may_intersect(of_f))
    return true;
  struct coarse_counts of_g = counts_by_plane(sweep, g, f);
  if (!coarse_counts_may_intersect(of_g))
    return true;
  bool straddle = coarse_counts_straddle(of_f) && coarse_counts_straddle(of_g);
  if ((!straddle &&
       (!may_pierce(sweep->sheet, f, g) || !may_pierce(sweep->sheet, g, f))) ||
      is_outside_triangle(f->corners.p, g->corners.p) ||
      is_outside_triangle(g->corners.p, f->corners.p))
    return true;
  return f->triangle < g->triangle ? sweep->visit(sweep->user, f, g, straddle)
                                   : sweep->visit(sweep->user, g, f, straddle);
}

/* ---- Lists --------------------------------------------------------------- */

/* Starts a list, with room for n triangles. */
static bool start_list(struct pair_sweep *sweep, size_t n) {
  sweep->swept.count = 0;
  bool left = sweep->x > 0 && is_pair_selected(sweep, sweep->x - 1, sweep->y),
       below = sweep->y > 0 && is_pair_selected(sweep, sweep->x, sweep->y - 1);
  sweep->first = (point_lanes){sweep->grid->x0, sweep->grid->y0};
  sweep->cell = (point_lanes){sweep->x, sweep->y};
  sweep->selected = (point_lanes){-left, -below};
  return ARRAY_RESERVE(&sweep->swept, n) && ARRAY_RESERVE(&sweep->box, n) &&
         ARRAY_RESERVE(&sweep->key, 2 * n) && ARRAY_RESERVE(&sweep->met_now, n);
}

/* Adds a triangle, with its key: the depth of its farthest corner. */
static inline void add_to_list(struct pair_sweep *sweep, uint32_t triangle,
                               uint64_t right_copy) {
  size_t i = sweep->swept.count++;
  int64_t low = make_swept_triangle(sweep, triangle, right_copy,
                                    &sweep->swept.item[i], &sweep->box.item[i]);
  sweep->key.item[i] = (struct sort_key){(uint64_t)low, (uint32_t)i};
}

/* Triangle i of the list in the order of its keys. */
static inline struct swept_triangle *
swept_of_key(const struct pair_sweep *sweep, size_t i) {
  return &sweep->swept.item[sweep->key.item[i].value];
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
        sweep->sheet->triangle.item[swept_of_key(sweep, i)->triangle].face;
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
  size_t n = sweep->swept.count;
  const uint32_t *p =
      sweep->sheet->triangle.item[swept_of_key(sweep, n / 2)->triangle].point;
  for (int k = 0; k < 3; k++) {
    size_t having = 0;
    point[0] = p[k];
    point[1] = p[geom_next_corner(k)];
    for (size_t i = 0; i < FACE_LIST_MIN && (having > 0 || i < FIRST_SAMPLES);
         i++)
      having +=
          has_mesh_edge(sweep->sheet,
                        swept_of_key(sweep, i * SAMPLE_STEP % FACE_LIST_MIN *
                                                n / FACE_LIST_MIN)
                            ->triangle,
                        point);
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
    struct swept_triangle *f = swept_of_key(sweep, i);
    f->in_group = is_in_group(sweep, group, f->triangle);
    if (!f->in_group && !ARRAY_PUSH(&sweep->other, sweep->key.item[i]))
      return false;
  }
  return true;
}

/* ---- Sweeping ------------------------------------------------------------ */

/* Tests triangle f with those of the keys from `first` on whose ranges overlap
 * that of f.  What boxes reject is left out without a jump for each, as half of
 * all are.
 * Returns false as pair_sweep_cells does. */
static bool sweep_triangle(struct pair_sweep *sweep, uint32_t f,
                           const struct sort_key *g, size_t first, size_t end) {
  struct swept_triangle *swept = sweep->swept.item;
  const struct swept_box *box = sweep->box.item, own = box[f];
  uint32_t *met = sweep->met_now.item;
  size_t j = first, count = 0;
  for (; j < end && g[j].key <= (uint64_t)swept[f].high; j++) {
    met[count] = g[j].value;
    count += swept_boxes_meet(&own, &box[g[j].value]);
  }
  for (size_t i = 0; i < count; i++)
    if ((!sweep->is_along_normal ||
         swept_depths_overlap(&swept[f], &swept[met[i]])) &&
        !visit_pair(sweep, &swept[f], &swept[met[i]]))
      return false;
  sweep->met += j - first;
  return progress_step(sweep->progress, j - first + 1);
}

/* Tests the pairs of the list, but not those of its group. */
static bool sweep_list(struct pair_sweep *sweep) {
  size_t n = sweep->swept.count, others = 0;
  sort_keys(sweep->key.item, sweep->key.item + n, n);
  if (!sweep_direction_choose(sweep))
    return false;
  struct pair_group group = choose_group(sweep);
  if (n >= FACE_LIST_MIN && !list_others(sweep, &group))
    return false;
  for (size_t i = 0; i < n; i++) {
    uint32_t f = sweep->key.item[i].value;
    bool in_group = sweep->swept.item[f].in_group;
    bool ok = in_group ? sweep_triangle(sweep, f, sweep->other.item, others,
                                        sweep->other.count)
                       : sweep_triangle(sweep, f, sweep->key.item, i + 1, n);
    others += !in_group;
    if (!ok)
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

/* Fetches the triangle that an entry of a list stands for and, of an entry that
 * comes sooner, the corners.
 * entry  in the lists of all cells */
MEM_PREFETCH_INLINE void prefetch_entry(const struct pair_sweep *sweep,
                                        size_t entry) {
  const struct number_lists *lists = &sweep->grid->lists;
  size_t cells = triangle_grid_cell_count(sweep->grid);
  if (entry + MEM_PREFETCH_AHEAD >= lists->start[cells])
    return;
  MEM_PREFETCH(
      &sweep->sheet->triangle.item[lists->item[entry + MEM_PREFETCH_AHEAD]]);
  sheet_prefetch_corners(sweep->sheet, lists->item[entry]);
}

/* Sweeps the list of a cell, and fetches what that of the next cell has.  It is
 * read from its end, as lists of tiles are ordered from near to far, and
 * insertion is fast where few entries are out of order. */
static bool sweep_cell(struct pair_sweep *sweep, size_t cell) {
  const struct number_lists *lists = &sweep->grid->lists;
  size_t from = lists->start[cell], end = lists->start[cell + 1];
  uint32_t root = SHEET_NONE;
  bsp_clear(&sweep->bsp);
  if (end - from >= BSP_LIST_MIN &&
      !bsp_add(&sweep->bsp, sweep->sheet, lists->item + from, end - from, true,
               &root))
    return false;
  if (root != SHEET_NONE)
    return sweep_bsp(sweep);
  if (!start_list(sweep, end - from))
    return false;
  for (size_t i = end; i > from; i--) {
    prefetch_entry(sweep, end + (end - i));
    add_to_list(sweep, lists->item[i - 1], 0);
  }
  return sweep_list(sweep);
}

bool pair_sweep_cells(struct pair_sweep *sweep, size_t begin, size_t end) {
  const struct triangle_grid *grid = sweep->grid;
  bool ok = true;
  sweep->all = occlusion_tolerance_bound_all(sweep->sheet);
  for (size_t cell = begin; ok && cell < end; cell++) {
    sweep->x = (int)(cell % (size_t)grid->columns);
    sweep->y = (int)(cell / (size_t)grid->columns);
    if (grid->lists.start[cell + 1] - grid->lists.start[cell] > 1 &&
        (sweep->cells == NULL || sweep->cells[cell]))
      ok = sweep_cell(sweep, cell);
  }
  return ok;
}

void pair_sweep_fini(struct pair_sweep *sweep) {
  ARRAY_FREE(&sweep->swept);
  ARRAY_FREE(&sweep->box);
  ARRAY_FREE(&sweep->met_now);
  ARRAY_FREE(&sweep->key);
  ARRAY_FREE(&sweep->other);
  ARRAY_FREE(&sweep->along);
  ARRAY_FREE(&sweep->high);
  bsp_fini(&sweep->bsp);
}
