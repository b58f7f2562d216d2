/* side_provenance.c - what a fragment's side is: a question of the sheet alone. */
#include "visibility/fragments/side_provenance.h"

#include <math.h>

#include "visibility/predicate/plane_filter.h"

/* A stretch of the boundary, low before high in (x, y). */
struct side_stretch {
  const struct geom_line *line;
  const struct geom_corner *low, *high;
};

static struct box2 box_of(const struct side_stretch *s) {
  return (struct box2){(int32_t)floor(fmin(s->low->x, s->high->x)) - 1,
                       (int32_t)floor(fmin(s->low->y, s->high->y)) - 1,
                       (int32_t)ceil(fmax(s->low->x, s->high->x)) + 1,
                       (int32_t)ceil(fmax(s->low->y, s->high->y)) + 1};
}

/* Do side a-b of a triangle and the stretch share more than a point?  Then
 * from and to are the ends of what they share. */
static bool runs_along(struct geom_point a, struct geom_point b,
                       const struct side_stretch *s, struct geom_corner *from,
                       struct geom_corner *to) {
  struct geom_corner ca = geom_corner_at(a), cb = geom_corner_at(b);
  if (a.x == b.x && a.y == b.y)
    return false;
  if (geom_line_side(s->line, &ca) != 0 || geom_line_side(s->line, &cb) != 0)
    return false;
  if (geom_corner_compare(&ca, &cb) > 0) {
    struct geom_corner swap = ca;
    ca = cb;
    cb = swap;
  }
  *from = geom_corner_compare(&ca, s->low) > 0 ? ca : *s->low;
  *to = geom_corner_compare(&cb, s->high) < 0 ? cb : *s->high;
  return geom_corner_compare(from, to) < 0;
}

/* Does side k of a triangle run along the stretch?  See runs_along. */
static bool side_runs_along(const struct sheet *sheet, uint32_t triangle,
                            uint32_t k, const struct side_stretch *s,
                            struct geom_corner *from, struct geom_corner *to) {
  const uint32_t *point = sheet->triangle.item[triangle].point;
  return runs_along(sheet->point.item[point[k]],
                    sheet->point.item[point[k == 2 ? 0 : k + 1]], s, from, to);
}

/* The lowest edge of a triangle along the stretch, if below `best`. */
static uint32_t edge_along(const struct sheet *sheet, uint32_t triangle,
                           const struct side_stretch *s, uint32_t best) {
  const uint32_t *side = sheet->triangle.item[triangle].side;
  struct geom_corner from, to;
  for (uint32_t k = 0; k < 3; k++)
    if (side[k] < best && side_runs_along(sheet, triangle, k, s, &from, &to))
      best = side[k];
  return best;
}

/* Has the triangle area beside the stretch, on its left, somewhere from `from`
 * to `to`? */
static bool is_beside(const struct sheet *sheet, uint32_t triangle,
                      const struct side_stretch *s,
                      const struct geom_corner *from,
                      const struct geom_corner *to) {
  const uint32_t *point = sheet->triangle.item[triangle].point;
  bool left = false;
  for (int k = 0; k < 3; k++) {
    struct geom_point a = sheet->point.item[point[k]],
                      b = sheet->point.item[point[k == 2 ? 0 : k + 1]];
    struct geom_corner corner = geom_corner_at(a);
    struct geom_line side;
    int at_from, at_to;
    left |= geom_line_side(s->line, &corner) > 0;
    geom_line_through(&side, a, b);
    at_from = geom_line_side(&side, from);
    at_to = geom_line_side(&side, to);
    if (at_from <= 0 && at_to <= 0 && at_from + at_to < 0)
      return false;
  }
  return left;
}

/* Has the triangle a corner on the right of the stretch? */
static bool is_beyond(const struct sheet *sheet, uint32_t triangle,
                      const struct side_stretch *s) {
  const uint32_t *point = sheet->triangle.item[triangle].point;
  for (int k = 0; k < 3; k++) {
    struct geom_corner corner = geom_corner_at(sheet->point.item[point[k]]);
    if (geom_line_side(s->line, &corner) < 0)
      return true;
  }
  return false;
}

/* Is_nearer, where doubles can tell: not where the two may touch, or meet at an
 * end. */
static bool tell_nearer(const struct sheet *sheet, uint32_t f, uint32_t g,
                        const struct geom_corner *from,
                        const struct geom_corner *to, bool *nearer) {
  struct plane_filter sf = plane_filter_of(sheet, f),
                      sg = plane_filter_of(sheet, g);
  int at_from = plane_filter_nearer(&sf, &sg, from->x, from->y),
      at_to = plane_filter_nearer(&sf, &sg, to->x, to->y);
  if (at_from == 0 || at_to == 0)
    return false;
  *nearer = at_from > 0 || at_to > 0;
  return !plane_filters_may_touch(sheet, &sf, f, &sg, g);
}

/* Is g nearer than f somewhere from `from` to `to`, or, where it stands on f
 * all along, beyond the stretch? */
static bool is_nearer(const struct sheet *sheet, uint32_t f, uint32_t g,
                      const struct side_stretch *s,
                      const struct geom_corner *from,
                      const struct geom_corner *to) {
  struct triangle_plane tf, tg;
  struct geom_line line;
  int parallel, at_from, at_to;
  bool nearer;
  if (tell_nearer(sheet, f, g, from, to, &nearer))
    return nearer;
  tf = triangle_plane_of(sheet, f);
  tg = triangle_plane_of(sheet, g);
  if (triangles_touch(sheet, f, g))
    return g < f;
  parallel = geom_line_between(&line, &tg.plane, &tf.plane);
  if (parallel == GEOM_SAME_PLANE)
    return g < f;
  if (parallel != 0)
    return parallel > 0;
  at_from = geom_line_side(&line, from);
  at_to = geom_line_side(&line, to);
  if (at_from != 0 || at_to != 0)
    return at_from > 0 || at_to > 0;
  return geom_line_along(&line, s->line) < 0 && is_beyond(sheet, g, s);
}

/* Do the planes of f and g cross along the stretch? */
static bool crosses_along(const struct sheet *sheet, uint32_t f, uint32_t g,
                          const struct side_stretch *s) {
  struct triangle_plane tf = triangle_plane_of(sheet, f),
                        tg = triangle_plane_of(sheet, g);
  struct geom_line line, back;
  if (triangle_depth_order(&tf, f, &tg, g, &line, &back) != NEARER_BEYOND)
    return false;
  return geom_line_side(&line, s->low) == 0 &&
         geom_line_side(&line, s->high) == 0;
}

/* What is asked about: a stretch of a face's boundary, the face's triangles
 * that may be beside it, and the triangles and sides that may lie along it. */
struct question {
  const struct sheet *sheet;
  struct side_stretch stretch;
  struct box2 box;
  uint32_t face;
  const uint32_t *own, *found, *side;
  size_t own_count, found_count, side_count;
};

/* The same of g and those of its own that are beside the stretch. */
static bool is_nearer_than_own(const struct question *q, uint32_t g,
                               const struct geom_corner *from,
                               const struct geom_corner *to) {
  for (size_t i = 0; i < q->own_count; i++)
    if (is_beside(q->sheet, q->own[i], &q->stretch, from, to) &&
        is_nearer(q->sheet, q->own[i], g, &q->stretch, from, to))
      return true;
  return false;
}

/* Does the plane of one of its own cross g's along the stretch? */
static bool own_crosses_along(const struct question *q, uint32_t g) {
  for (size_t i = 0; i < q->own_count; i++)
    if (crosses_along(q->sheet, q->own[i], g, &q->stretch))
      return true;
  return false;
}

static bool may_answer(const struct question *q, uint32_t g) {
  return q->sheet->triangle.item[g].face != q->face &&
         !(q->sheet->triangle_flags[g] & SHEET_FLAT) &&
         !box2_disjoint(q->box, box2_of_triangle(q->sheet, g));
}

static uint32_t own_edge(const struct question *q) {
  uint32_t id = SHEET_NONE;
  for (size_t i = 0; i < q->own_count; i++)
    id = edge_along(q->sheet, q->own[i], &q->stretch, id);
  return id;
}

/* The lowest edge along the stretch among the sides found: of the face's own,
 * or of those that are nearer. */
static uint32_t edge_found(const struct question *q, bool own) {
  uint32_t id = SHEET_NONE;
  struct geom_corner from, to;
  for (size_t i = 0; i < q->side_count; i++) {
    uint32_t g = q->side[i] / 3, k = q->side[i] % 3;
    const struct sheet_triangle *triangle = &q->sheet->triangle.item[g];
    if (triangle->side[k] < id && (triangle->face == q->face) == own &&
        side_runs_along(q->sheet, g, k, &q->stretch, &from, &to) &&
        (own || is_nearer_than_own(q, g, &from, &to)))
      id = triangle->side[k];
  }
  return id;
}

static uint32_t crossing_face(const struct question *q) {
  uint32_t face = SHEET_NONE;
  for (size_t i = 0; i < q->found_count; i++) {
    uint32_t g = q->found[i], other = q->sheet->triangle.item[g].face;
    if (other < face && may_answer(q, g) && own_crosses_along(q, g))
      face = other;
  }
  return face;
}

/* What other faces have along the stretch. */
static uint8_t query_others(const struct question *q, uint32_t *id) {
  *id = edge_found(q, false);
  if (*id != SHEET_NONE)
    return MAP_SIDE_OUTLINE;
  *id = crossing_face(q);
  return *id != SHEET_NONE ? MAP_SIDE_INTERSECTION : MAP_SIDE_CUT;
}

/* Is f a later triangle in contact with one of its own? */
static bool touches_own(const struct question *q, uint32_t f) {
  if (!may_answer(q, f))
    return false;
  for (size_t i = 0; i < q->own_count; i++)
    if (q->own[i] < f && triangles_touch(q->sheet, q->own[i], f))
      return true;
  return false;
}

/* What is seen of later triangles in contact with the face was given to it
 * (fragments.h), with the boundary it had. */
static uint8_t query_contacts(const struct question *q, uint32_t *id) {
  uint8_t best = MAP_SIDE_CUT;
  *id = SHEET_NONE;
  for (size_t i = 0; i < q->found_count; i++) {
    struct question other = *q;
    uint32_t f = q->found[i], other_id;
    uint8_t side = MAP_SIDE_OUTLINE;
    if (!touches_own(q, f))
      continue;
    other.own = &f;
    other.own_count = 1;
    other.face = q->sheet->triangle.item[f].face;
    other_id = own_edge(&other);
    if (other_id == SHEET_NONE)
      side = query_others(&other, &other_id);
    if (side < best || (side == best && other_id < *id)) {
      best = side;
      *id = other_id;
    }
  }
  return best;
}

/* ---- What may lie along a stretch ---------------------------------------- */

void side_provenance_fini(struct side_provenance *labels) {
  ARRAY_FREE(&labels->found);
  ARRAY_FREE(&labels->about);
  ARRAY_FREE(&labels->beside);
}

/* Finds the triangles about the stretch, where that was not done yet. */
static bool find_triangles(struct side_provenance *labels, struct question *q) {
  if (q->found != NULL)
    return true;
  if (!triangle_grid_find(labels->grid, q->box, labels->query))
    return false;
  if (labels->query->found.count == 0)
    return true;
  q->found = labels->query->found.item;
  q->found_count = labels->query->found.count;
  return true;
}

static bool find_sides(struct side_provenance *labels, struct question *q) {
  labels->found.count = 0;
  if (labels->sides != NULL) {
    if (!line_index_find(labels->sides, q->stretch.line, q->stretch.low,
                         q->stretch.high, &labels->found))
      return false;
  } else {
    if (!find_triangles(labels, q))
      return false;
    for (size_t i = 0; i < q->found_count; i++)
      for (uint32_t k = 0; k < 3 && may_answer(q, q->found[i]); k++)
        if (!ARRAY_PUSH(&labels->found, 3 * q->found[i] + k))
          return false;
  }
  q->side = labels->found.item;
  q->side_count = labels->found.count;
  return true;
}

static bool is_among(const uint32_t *item, size_t count, uint32_t wanted) {
  while (count > 0) {
    size_t half = count / 2;
    if (item[half] == wanted)
      return true;
    if (item[half] < wanted) {
      item += half + 1;
      count -= half + 1;
    } else {
      count = half;
    }
  }
  return false;
}

/* Of many own triangles leaves those about the stretch. */
static bool find_own_about(struct side_provenance *labels, struct question *q) {
  labels->about.count = 0;
  for (size_t i = 0; i < q->found_count; i++)
    if (is_among(labels->own, labels->own_count, q->found[i]) &&
        !ARRAY_PUSH(&labels->about, q->found[i]))
      return false;
  q->own = labels->about.item;
  q->own_count = labels->about.count;
  return true;
}

/* Leaves of its own those that have area beside the stretch. */
static bool keep_own_beside(struct side_provenance *labels,
                            struct question *q) {
  size_t kept = 0;
  if (!ARRAY_RESERVE(&labels->beside, q->own_count))
    return false;
  for (size_t i = 0; i < q->own_count; i++)
    if (is_beside(q->sheet, q->own[i], &q->stretch, q->stretch.low,
                  q->stretch.high))
      labels->beside.item[kept++] = q->own[i];
  q->own = labels->beside.item;
  q->own_count = kept;
  return true;
}

bool side_provenance_find(struct side_provenance *labels,
                          const struct geom_line *line,
                          const struct geom_corner *p,
                          const struct geom_corner *q, uint8_t *side,
                          uint32_t *id) {
  bool forward = geom_corner_compare(p, q) < 0,
       few = labels->own_count <= SIDE_PROVENANCE_FEW;
  struct question question = {
      .sheet = labels->sheet,
      .stretch = {line, forward ? p : q, forward ? q : p},
      .face = labels->sheet->triangle.item[labels->own[0]].face,
      .own = labels->own,
      .own_count = labels->own_count};
  *side = MAP_SIDE_EDGE;
  *id = few ? own_edge(&question) : SHEET_NONE;
  if (*id != SHEET_NONE)
    return true;
  question.box = box_of(&question.stretch);
  if (!find_sides(labels, &question))
    return false;
  if (!few) {
    *id = edge_found(&question, true);
    if (*id != SHEET_NONE)
      return true;
    if (!find_triangles(labels, &question) ||
        !find_own_about(labels, &question))
      return false;
  }
  *side = MAP_SIDE_OUTLINE;
  *id = edge_found(&question, false);
  if (*id != SHEET_NONE)
    return true;
  if (!find_triangles(labels, &question) || !keep_own_beside(labels, &question))
    return false;
  *side = MAP_SIDE_INTERSECTION;
  *id = crossing_face(&question);
  if (*id == SHEET_NONE)
    *side = query_contacts(&question, id);
  return true;
}
