/* sidelabel.c - what a fragment's side is: a question of the sheet alone. */
#include "visibility/sidelabel.h"

#include <math.h>

/* A stretch of the boundary, low before high in (x, y). */
struct stretch {
  const struct geom_line *line;
  const struct geom_corner *low, *high;
};

static struct page_box box_of(const struct stretch *s) {
  return (struct page_box){(int32_t)floor(fmin(s->low->x, s->high->x)) - 1,
                           (int32_t)floor(fmin(s->low->y, s->high->y)) - 1,
                           (int32_t)ceil(fmax(s->low->x, s->high->x)) + 1,
                           (int32_t)ceil(fmax(s->low->y, s->high->y)) + 1};
}

/* Do side a-b of a triangle and the stretch share more than a point?  Then
 * from and to are the ends of what they share. */
static bool runs_along(struct geom_point a, struct geom_point b,
                       const struct stretch *s, struct geom_corner *from,
                       struct geom_corner *to) {
  struct geom_corner ca = geom_corner_at(a), cb = geom_corner_at(b);
  if (a.x == b.x && a.y == b.y) return false;
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

/* The lowest edge of a triangle along the stretch, if below `best`. */
static uint32_t edge_along(const struct sheet *sheet, uint32_t triangle,
                           const struct stretch *s, uint32_t best,
                           struct geom_corner *from, struct geom_corner *to) {
  const struct sheet_triangle *t = &sheet->triangle.item[triangle];
  for (int k = 0; k < 3; k++)
    if (t->side[k] < best &&
        runs_along(sheet->point.item[t->point[k]],
                   sheet->point.item[t->point[k == 2 ? 0 : k + 1]], s, from,
                   to))
      best = t->side[k];
  return best;
}

/* Has the triangle area beside the stretch, on its left, somewhere from `from`
 * to `to`? */
static bool is_beside(const struct sheet *sheet, uint32_t triangle,
                      const struct stretch *s, const struct geom_corner *from,
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
    if (at_from <= 0 && at_to <= 0 && at_from + at_to < 0) return false;
  }
  return left;
}

/* Has the triangle a corner on the right of the stretch? */
static bool is_beyond(const struct sheet *sheet, uint32_t triangle,
                      const struct stretch *s) {
  const uint32_t *point = sheet->triangle.item[triangle].point;
  for (int k = 0; k < 3; k++) {
    struct geom_corner corner = geom_corner_at(sheet->point.item[point[k]]);
    if (geom_line_side(s->line, &corner) < 0) return true;
  }
  return false;
}

/* Is g nearer than f somewhere from `from` to `to`, or, where it stands on f
 * all along, beyond the stretch? */
static bool is_nearer(const struct sheet *sheet, uint32_t f, uint32_t g,
                      const struct stretch *s, const struct geom_corner *from,
                      const struct geom_corner *to) {
  struct triangle_plane tf = triangle_plane_of(sheet, f),
                        tg = triangle_plane_of(sheet, g);
  struct geom_line line;
  int parallel, at_from, at_to;
  if (triangles_touch(sheet, f, g)) return g < f;
  parallel = geom_line_between(&line, &tg.plane, &tf.plane);
  if (parallel == GEOM_SAME_PLANE) return g < f;
  if (parallel != 0) return parallel > 0;
  at_from = geom_line_side(&line, from);
  at_to = geom_line_side(&line, to);
  if (at_from != 0 || at_to != 0) return at_from > 0 || at_to > 0;
  return geom_line_along(&line, s->line) < 0 && is_beyond(sheet, g, s);
}

/* Do the planes of f and g cross along the stretch? */
static bool crosses_along(const struct sheet *sheet, uint32_t f, uint32_t g,
                          const struct stretch *s) {
  struct triangle_plane tf = triangle_plane_of(sheet, f),
                        tg = triangle_plane_of(sheet, g);
  struct geom_line line, back;
  if (triangle_nearness(&tf, f, &tg, g, &line, &back) != NEARER_BEYOND)
    return false;
  return geom_line_side(&line, s->low) == 0 &&
         geom_line_side(&line, s->high) == 0;
}

/* The same of g and those of `own` that are beside the stretch. */
static bool is_nearer_than_own(const struct sheet *sheet, const uint32_t *own,
                               size_t count, uint32_t g,
                               const struct stretch *s,
                               const struct geom_corner *from,
                               const struct geom_corner *to) {
  for (size_t i = 0; i < count; i++)
    if (is_beside(sheet, own[i], s, from, to) &&
        is_nearer(sheet, own[i], g, s, from, to))
      return true;
  return false;
}

/* Does the plane of one of `own` cross g's along the stretch? */
static bool own_crosses_along(const struct sheet *sheet, const uint32_t *own,
                              size_t count, uint32_t g,
                              const struct stretch *s) {
  for (size_t i = 0; i < count; i++)
    if (crosses_along(sheet, own[i], g, s)) return true;
  return false;
}

static bool is_candidate(const struct sheet *sheet, uint32_t g, uint32_t face,
                         struct page_box box) {
  return sheet->triangle.item[g].face != face &&
         !(sheet->triangle_flags[g] & SHEET_FLAT) &&
         !page_boxes_apart(box, page_box_of_triangle(sheet, g));
}

/* What is asked about: a stretch of a face's boundary, the face's triangles,
 * and the triangles that may lie along it. */
struct question {
  const struct sheet *sheet;
  struct stretch stretch;
  struct page_box box;
  const uint32_t *own, *found;
  size_t own_count, found_count;
};

static bool may_answer(const struct question *q, uint32_t g) {
  return is_candidate(q->sheet, g, q->sheet->triangle.item[q->own[0]].face,
                      q->box);
}

static uint32_t own_edge(const struct question *q) {
  uint32_t id = SHEET_NONE;
  struct geom_corner from, to;
  for (size_t i = 0; i < q->own_count; i++)
    id = edge_along(q->sheet, q->own[i], &q->stretch, id, &from, &to);
  return id;
}

static uint32_t nearer_edge(const struct question *q) {
  uint32_t id = SHEET_NONE;
  struct geom_corner from, to;
  for (size_t i = 0; i < q->found_count; i++) {
    uint32_t g = q->found[i], edge;
    if (!may_answer(q, g)) continue;
    edge = edge_along(q->sheet, g, &q->stretch, id, &from, &to);
    if (edge < id && is_nearer_than_own(q->sheet, q->own, q->own_count, g,
                                        &q->stretch, &from, &to))
      id = edge;
  }
  return id;
}

static uint32_t crossing_face(const struct question *q) {
  uint32_t face = SHEET_NONE;
  for (size_t i = 0; i < q->found_count; i++) {
    uint32_t g = q->found[i], other = q->sheet->triangle.item[g].face;
    if (other < face && may_answer(q, g) &&
        own_crosses_along(q->sheet, q->own, q->own_count, g, &q->stretch))
      face = other;
  }
  return face;
}

/* What other faces have along the stretch. */
static uint8_t ask_others(const struct question *q, uint32_t *id) {
  *id = nearer_edge(q);
  if (*id != SHEET_NONE) return MAP_SIDE_OUTLINE;
  *id = crossing_face(q);
  return *id != SHEET_NONE ? MAP_SIDE_INTERSECTION : MAP_SIDE_CUT;
}

/* What is seen of later triangles in contact with the face was given to it
 * (fragments.h), with the boundary it had. */
static uint8_t ask_contacts(const struct question *q, uint32_t *id) {
  uint8_t best = MAP_SIDE_CUT;
  *id = SHEET_NONE;
  for (size_t i = 0; i < q->found_count; i++) {
    struct question other = *q;
    uint32_t f = q->found[i], other_id;
    uint8_t side = MAP_SIDE_OUTLINE;
    bool touches = false;
    for (size_t k = 0; k < q->own_count && !touches; k++)
      touches = q->own[k] < f && may_answer(q, f) &&
                triangles_touch(q->sheet, q->own[k], f);
    if (!touches) continue;
    other.own = &f;
    other.own_count = 1;
    other_id = own_edge(&other);
    if (other_id == SHEET_NONE) side = ask_others(&other, &other_id);
    if (side < best || (side == best && other_id < *id)) {
      best = side;
      *id = other_id;
    }
  }
  return best;
}

bool side_label(const struct sheet *sheet, const struct pagegrid *grid,
                struct pagegrid_query *query, const uint32_t *own,
                size_t count, const struct geom_line *line,
                const struct geom_corner *p, const struct geom_corner *q,
                uint8_t *side, uint32_t *id) {
  bool forward = geom_corner_compare(p, q) < 0;
  struct question question = {sheet,
                              {line, forward ? p : q, forward ? q : p},
                              .own = own,
                              .own_count = count};
  question.box = box_of(&question.stretch);
  *side = MAP_SIDE_EDGE;
  *id = own_edge(&question);
  if (*id != SHEET_NONE) return true;
  if (!pagegrid_find(grid, question.box, query)) return false;
  question.found = query->found.item;
  question.found_count = query->found.count;
  *side = ask_others(&question, id);
  if (*side == MAP_SIDE_CUT) *side = ask_contacts(&question, id);
  return true;
}
