/* duplicate_triangles.c - finds triangles of which others are exact duplicates.
 *
 * Phases
 *   1 triangles whose corners have the same coordinates form a class, which is
 *     named by its first triangle
 *   2 edges whose ends have the same coordinates, and at which triangles of the
 *     same classes meet, form an edge class, which is named by a number
 *   3 triangles of one class whose sides are of the same edge classes are
 *     duplicates
 * Hashes only bring together what may be equal; coordinates are compared.
 */
#include "visibility/index/duplicate_triangles.h"

#include <string.h>

#include "base/sort.h"

enum {
  REPRESENTATIVES = 2, /* of each class of duplicates */
  DUPLICATES_MIN = 4   /* one in so many triangles is a duplicate: many are */
};

/* ---- 1 Classes ----------------------------------------------------------- */

static uint64_t mix(uint64_t hash, uint64_t value) {
  hash = (hash ^ value) * UINT64_C(0x9e3779b97f4a7c15);
  return hash ^ (hash >> 29);
}

static const struct geom_point *triangle_corner(const struct sheet *sheet,
                                                uint32_t triangle, int k) {
  return &sheet->point.item[sheet->triangle.item[triangle].point[k]];
}

static uint64_t hash_of(const struct sheet *sheet, uint32_t triangle) {
  uint64_t hash = 0;
  for (int k = 0; k < 3; k++) {
    const struct geom_point *p = triangle_corner(sheet, triangle, k);
    hash = mix(hash, (uint64_t)p->x);
    hash = mix(hash, (uint64_t)p->y);
    hash = mix(hash, (uint64_t)p->z);
  }
  return hash;
}

static int compare_triangle_points(const void *a, const void *b, void *user) {
  const struct sheet *sheet = user;
  const struct sort_key *s = a, *t = b;
  for (int k = 0; k < 3; k++) {
    int order = geom_compare_points(*triangle_corner(sheet, s->value, k),
                                    *triangle_corner(sheet, t->value, k));
    if (order != 0)
      return order;
  }
  return 0;
}

/* The triangles, sorted so that those with the same coordinates are adjacent,
 * and in order of their indices; the caller frees it.  NULL when memory ran
 * out.
 * triangle  `n` of them, ascending; NULL: the first n of the sheet */
static struct sort_key *sort_by_coordinates(const struct sheet *sheet,
                                            const uint32_t *triangle,
                                            size_t n) {
  struct sort_key *key = mem_alloc(2 * n, sizeof *key);
  bool ok = key != NULL;
  if (!ok)
    return NULL;
  for (size_t i = 0; i < n; i++) {
    uint32_t t = triangle != NULL ? triangle[i] : (uint32_t)i;
    key[i] = (struct sort_key){hash_of(sheet, t), t};
  }
  sort_keys(key, key + n, n);
  for (size_t i = 0, past; ok && i < n; i = past) {
    for (past = i + 1; past < n && key[past].key == key[i].key;)
      past++;
    ok = sort_stable(&key[i], past - i, sizeof *key, compare_triangle_points,
                     (void *)(uintptr_t)sheet);
  }
  if (ok)
    return key;
  mem_free(key);
  return NULL;
}

/* Do two triangles have the same coordinates? */
static bool have_same_coordinates(const struct sheet *sheet,
                                  const struct sort_key *a,
                                  const struct sort_key *b) {
  return a->key == b->key &&
         compare_triangle_points(a, b, (void *)(uintptr_t)sheet) == 0;
}

bool duplicate_triangles_are_many(const struct sheet *sheet,
                                  const uint32_t *triangle, size_t count,
                                  bool *many) {
  struct sort_key *key = sort_by_coordinates(sheet, triangle, count);
  size_t duplicates = 0;
  if (key == NULL)
    return false;
  for (size_t i = 1; i < count; i++)
    duplicates += have_same_coordinates(sheet, &key[i - 1], &key[i]);
  *many = duplicates > count / DUPLICATES_MIN;
  mem_free(key);
  return true;
}

struct duplicate_finder {
  const struct sheet *sheet;
  uint32_t *class;      /* per triangle */
  uint32_t *size;       /* of the class that a triangle names */
  uint8_t *marked;      /* per point, not 0: it may be a duplicate's corner */
  uint32_t *edge_class; /* per side, 3 * triangle + k; SHEET_NONE: not marked */
  uint8_t *left_out;    /* per triangle: the result */
};

static bool may_be_duplicate(const struct duplicate_finder *f,
                             uint32_t triangle) {
  return f->size[f->class[triangle]] > REPRESENTATIVES;
}

static bool find_classes(struct duplicate_finder *f) {
  size_t n = f->sheet->triangle.count;
  struct sort_key *key = sort_by_coordinates(f->sheet, NULL, n);
  if (key == NULL)
    return false;
  for (size_t i = 0; i < n; i++) {
    uint32_t t = key[i].value;
    bool same = i > 0 && have_same_coordinates(f->sheet, &key[i - 1], &key[i]);
    f->class[t] = same ? f->class[key[i - 1].value] : t;
    f->size[f->class[t]]++;
  }
  mem_free(key);
  for (uint32_t t = 0; t < n; t++)
    for (int k = 0; k < 3 && may_be_duplicate(f, t); k++)
      f->marked[f->sheet->triangle.item[t].point[k]] = 1;
  return true;
}

/* ---- 2 Edge classes ------------------------------------------------------ */

/* A side of a triangle, its ends ordered by coordinates, then by index. */
struct duplicate_side {
  uint32_t point[2], class, side; /* side: 3 * triangle + k */
};

/* An edge: sides[from .. from + count), sorted by their triangles' classes. */
struct duplicate_edge {
  size_t from, count;
};

struct duplicate_sides {
  const struct sheet *sheet;
  ARRAY(struct duplicate_side) side;
  ARRAY(struct duplicate_edge) edge;
};

static int compare_triangle_sides(const void *a, const void *b, void *user) {
  const struct duplicate_side *s = a, *t = b;
  int order = compare_numbers(s->point[0], t->point[0]);
  (void)user;
  if (order == 0)
    order = compare_numbers(s->point[1], t->point[1]);
  return order != 0 ? order : compare_numbers(s->class, t->class);
}

static int compare_edges(const void *a, const void *b, void *user) {
  const struct duplicate_sides *all = user;
  const struct geom_point *point = all->sheet->point.item;
  const struct duplicate_edge *e = a, *f = b;
  const struct duplicate_side *s = &all->side.item[e->from],
                              *t = &all->side.item[f->from];
  int order = 0;
  for (int k = 0; k < 2 && order == 0; k++)
    order = geom_compare_points(point[s->point[k]], point[t->point[k]]);
  if (order == 0 && e->count != f->count)
    return e->count < f->count ? -1 : 1;
  for (size_t i = 0; i < e->count && order == 0; i++)
    order = compare_numbers(s[i].class, t[i].class);
  return order;
}

static bool add_sides(struct duplicate_sides *all,
                      const struct duplicate_finder *f, uint32_t triangle) {
  const struct geom_point *point = f->sheet->point.item;
  const uint32_t *p = f->sheet->triangle.item[triangle].point;
  for (uint32_t k = 0; k < 3; k++) {
    uint32_t i = p[k], j = p[geom_next_corner((int)k)];
    int order = geom_compare_points(point[i], point[j]);
    bool swap = order > 0 || (order == 0 && i > j);
    struct duplicate_side side = {
        {swap ? j : i, swap ? i : j}, f->class[triangle], 3 * triangle + k};
    if (f->marked[i] && f->marked[j] && !ARRAY_PUSH(&all->side, side))
      return false;
  }
  return true;
}

/* Groups the sides, which are sorted, by the pair of points that they join. */
static bool group_sides(struct duplicate_sides *all) {
  const struct duplicate_side *side = all->side.item;
  for (size_t i = 0, past; i < all->side.count; i = past) {
    struct duplicate_edge edge = {i, 0};
    for (past = i; past < all->side.count &&
                   side[past].point[0] == side[i].point[0] &&
                   side[past].point[1] == side[i].point[1];)
      past++;
    edge.count = past - i;
    if (!ARRAY_PUSH(&all->edge, edge))
      return false;
  }
  return true;
}

static bool find_edge_classes(struct duplicate_finder *f) {
  struct duplicate_sides all = {.sheet = f->sheet};
  uint32_t edge_class = 0;
  bool ok = true;
  for (uint32_t t = 0; ok && t < f->sheet->triangle.count; t++)
    ok = add_sides(&all, f, t);
  ok = ok &&
       sort_stable(all.side.item, all.side.count, sizeof *all.side.item,
                   compare_triangle_sides, NULL) &&
       group_sides(&all) &&
       sort_stable(all.edge.item, all.edge.count, sizeof *all.edge.item,
                   compare_edges, &all);
  for (size_t e = 0; ok && e < all.edge.count; e++) {
    const struct duplicate_edge *edge = &all.edge.item[e];
    if (e > 0 && compare_edges(edge - 1, edge, &all) != 0)
      edge_class++;
    for (size_t i = 0; i < edge->count; i++)
      f->edge_class[all.side.item[edge->from + i].side] = edge_class;
  }
  ARRAY_FREE(&all.side);
  ARRAY_FREE(&all.edge);
  return ok;
}

/* ---- 3 Duplicates -------------------------------------------------------- */

static int compare_triangles(const void *a, const void *b, void *user) {
  const struct duplicate_finder *f = user;
  uint32_t s = *(const uint32_t *)a, t = *(const uint32_t *)b;
  int order = compare_numbers(f->class[s], f -> class[t]);
  for (uint32_t k = 0; k < 3 && order == 0; k++)
    order = compare_numbers(f->edge_class[3 * s + k], f->edge_class[3 * t + k]);
  return order;
}

/* Are the sheet's edges of the first triangle's sides no later than those of
 * its duplicate?  Labels name the first of coincident edges, so leaving out a
 * duplicate must not lose that one. */
static bool has_first_edges(const struct sheet *sheet, uint32_t first,
                            uint32_t duplicate) {
  const uint32_t *s = sheet_triangle_sides(sheet, first),
                 *t = sheet_triangle_sides(sheet, duplicate);
  return s[0] <= t[0] && s[1] <= t[1] && s[2] <= t[2];
}

/* Leaves out all of a class of duplicates but two representatives: the first,
 * and the next one that is of another face if there is one. */
static void leave_out(struct duplicate_finder *f, const uint32_t *duplicate,
                      size_t count) {
  const struct sheet_triangle *triangle = f->sheet->triangle.item;
  size_t other = 1;
  while (other < count &&
         triangle[duplicate[other]].face == triangle[duplicate[0]].face)
    other++;
  if (other == count)
    other = 1;
  for (size_t i = 1; i < count; i++)
    f->left_out[duplicate[i]] =
        i != other && has_first_edges(f->sheet, duplicate[0], duplicate[i]);
}

static bool find_duplicates(struct duplicate_finder *f) {
  ARRAY(uint32_t) duplicate = {0};
  bool ok = true;
  for (uint32_t t = 0; ok && t < f->sheet->triangle.count; t++)
    if (may_be_duplicate(f, t))
      ok = ARRAY_PUSH(&duplicate, t);
  ok = ok && sort_stable(duplicate.item, duplicate.count,
                         sizeof *duplicate.item, compare_triangles, f);
  for (size_t i = 0, past; ok && i < duplicate.count; i = past) {
    for (past = i + 1;
         past < duplicate.count &&
         compare_triangles(&duplicate.item[i], &duplicate.item[past], f) == 0;)
      past++;
    leave_out(f, &duplicate.item[i], past - i);
  }
  ARRAY_FREE(&duplicate);
  return ok;
}

bool duplicate_triangles_find(const struct sheet *sheet, uint8_t **left_out) {
  size_t n = sheet->triangle.count;
  struct sheet with_sides = *sheet;
  struct duplicate_finder f = {.sheet = &with_sides};
  bool has_sides = sheet->sides.count == n, ok = false;
  if (!has_sides)
    memset(&with_sides.sides, 0, sizeof with_sides.sides);
  f.class = mem_alloc(n, sizeof *f.class);
  f.size = mem_calloc(n, sizeof *f.size);
  f.marked = mem_calloc(sheet->point.count, sizeof *f.marked);
  f.edge_class = mem_alloc(3 * n, sizeof *f.edge_class);
  f.left_out = mem_calloc(n, sizeof *f.left_out);
  if (f.class != NULL && f.size != NULL && f.marked != NULL &&
      f.edge_class != NULL && f.left_out != NULL) {
    memset(f.edge_class, 0xff, 3 * n * sizeof *f.edge_class);
    ok = sheet_find_sides(&with_sides) && find_classes(&f) &&
         find_edge_classes(&f) && find_duplicates(&f);
  }
  if (!has_sides)
    ARRAY_FREE(&with_sides.sides);
  mem_free(f.class);
  mem_free(f.size);
  mem_free(f.marked);
  mem_free(f.edge_class);
  if (!ok)
    mem_free(f.left_out);
  *left_out = ok ? f.left_out : NULL;
  return ok;
}
