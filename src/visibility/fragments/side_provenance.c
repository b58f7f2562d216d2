/* side_provenance.c - labels each side of a fragment with what it is part
 * of. */
#include "visibility/fragments/side_provenance.h"

#include <math.h>

#include "visibility/predicate/plane_filter.h"

/* A segment of a fragment's boundary, low before high in (x, y). */
struct boundary_segment {
  const struct geom_line *line;
  const struct geom_corner *low, *high;
};

static struct box2 segment_box(const struct boundary_segment *s) {
  return (struct box2){(int32_t)floor(fmin(s->low->x, s->high->x)) - 1,
                       (int32_t)floor(fmin(s->low->y, s->high->y)) - 1,
                       (int32_t)ceil(fmax(s->low->x, s->high->x)) + 1,
                       (int32_t)ceil(fmax(s->low->y, s->high->y)) + 1};
}

/* Returns whether side a-b of a triangle and the segment overlap in more than a
 * point; then `from` and `to` receive the ends of the overlap. */
static bool overlaps_segment(struct geom_point a, struct geom_point b,
                             const struct boundary_segment *s,
                             struct geom_corner *from, struct geom_corner *to) {
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

/* As overlaps_segment, for side k of a triangle. */
static bool overlaps_side(const struct sheet *sheet, uint32_t triangle,
                          uint32_t k, const struct boundary_segment *s,
                          struct geom_corner *from, struct geom_corner *to) {
  const uint32_t *point = sheet->triangle.item[triangle].point;
  return overlaps_segment(sheet->point.item[point[k]],
                          sheet->point.item[point[geom_next_corner((int)k)]], s,
                          from, to);
}

/* The lowest edge of a triangle that overlaps the segment; SHEET_NONE. */
static uint32_t edge_along(const struct sheet *sheet, uint32_t triangle,
                           const struct boundary_segment *s) {
  const uint32_t *side = sheet_triangle_sides(sheet, triangle);
  uint32_t best = SHEET_NONE;
  struct geom_corner from, to;
  for (uint32_t k = 0; k < 3; k++)
    if (side[k] < best && overlaps_side(sheet, triangle, k, s, &from, &to))
      best = side[k];
  return best;
}

/* Returns whether the triangle has area immediately to the left of the segment
 * somewhere from `from` to `to`. */
static bool is_beside(const struct sheet *sheet, uint32_t triangle,
                      const struct boundary_segment *s,
                      const struct geom_corner *from,
                      const struct geom_corner *to) {
  const uint32_t *point = sheet->triangle.item[triangle].point;
  int left = 0, right = 0;
  for (int k = 0; k < 3; k++) {
    struct geom_point a = sheet->point.item[point[k]],
                      b = sheet->point.item[point[geom_next_corner(k)]];
    struct geom_corner corner = geom_corner_at(a);
    struct geom_line side;
    int at_from, at_to, at_corner = geom_line_side(s->line, &corner);
    left += at_corner > 0;
    right += at_corner < 0;
    geom_line_through(&side, a, b);
    at_from = geom_line_side(&side, from);
    at_to = geom_line_side(&side, to);
    if (at_from <= 0 && at_to <= 0 && at_from + at_to < 0)
      return false;
  }
  /* The line passes through the triangle, or along a side of it. */
  return left > 0 && (right > 0 || left == 1);
}

/* Returns whether the triangle has a corner to the right of the segment. */
static bool has_corner_right_of(const struct sheet *sheet, uint32_t triangle,
                                const struct boundary_segment *s) {
  const uint32_t *point = sheet->triangle.item[triangle].point;
  for (int k = 0; k < 3; k++) {
    struct geom_corner corner = geom_corner_at(sheet->point.item[point[k]]);
    if (geom_line_side(s->line, &corner) < 0)
      return true;
  }
  return false;
}

/* Decides is_nearer by the floating-point filter.  Returns false where it
 * fails: where the triangles may touch, or be at the same depth at an end. */
static bool filtered_is_nearer(const struct sheet *sheet, uint32_t f,
                               uint32_t g, const struct geom_corner *from,
                               const struct geom_corner *to, bool *nearer) {
  struct plane_filter sf = plane_filter_of(sheet, f),
                      sg = plane_filter_of(sheet, g);
  int at_from = plane_filter_compare(&sf, &sg, from->x, from->y),
      at_to = plane_filter_compare(&sf, &sg, to->x, to->y);
  if (at_from == 0 || at_to == 0)
    return false;
  *nearer = at_from > 0 || at_to > 0;
  return !triangles_may_touch(sheet, &sf, f, &sg, g);
}

/* Returns whether g is nearer than f somewhere from `from` to `to`; if the two
 * are at the same depth all along, whether g extends to the right of the
 * segment and is nearer there.  Exact. */
static bool is_nearer(const struct sheet *sheet, uint32_t f, uint32_t g,
                      const struct boundary_segment *s,
                      const struct geom_corner *from,
                      const struct geom_corner *to) {
  bool nearer;
  if (filtered_is_nearer(sheet, f, g, from, to, &nearer))
    return nearer;
  if (triangles_touch(sheet, f, g))
    return g < f;
  struct triangle_plane tf = triangle_plane_of(sheet, f),
                        tg = triangle_plane_of(sheet, g);
  struct geom_line line;
  int parallel = geom_line_between(&line, &tg.plane, &tf.plane);
  if (parallel == GEOM_SAME_PLANE)
    return g < f;
  if (parallel != 0)
    return parallel > 0;
  int at_from = geom_line_side(&line, from), at_to = geom_line_side(&line, to);
  if (at_from != 0 || at_to != 0)
    return at_from > 0 || at_to > 0;
  return geom_line_along(&line, s->line) < 0 &&
         has_corner_right_of(sheet, g, s);
}

/* Are the planes of f and g certainly not at one depth at an end of the
 * segment? */
static bool filtered_is_apart(const struct sheet *sheet, uint32_t f, uint32_t g,
                              const struct boundary_segment *s) {
  struct plane_filter sf = plane_filter_without_contact(sheet, f),
                      sg = plane_filter_without_contact(sheet, g);
  return plane_filter_compare(&sf, &sg, s->low->x, s->low->y) != 0 ||
         plane_filter_compare(&sf, &sg, s->high->x, s->high->y) != 0;
}

/* Returns whether the planes of f and g intersect along the segment. */
static bool crosses_along(const struct sheet *sheet, uint32_t f, uint32_t g,
                          const struct boundary_segment *s) {
  if (filtered_is_apart(sheet, f, g, s))
    return false;
  struct triangle_plane tf = triangle_plane_of(sheet, f),
                        tg = triangle_plane_of(sheet, g);
  struct geom_line line, reversed;
  if (triangle_depth_order(&tf, f, &tg, g, &line, &reversed) != NEARER_ON_LEFT)
    return false;
  return geom_line_side(&line, s->low) == 0 &&
         geom_line_side(&line, s->high) == 0;
}

/* A query: a segment of a face's boundary, the face's triangles that may be
 * beside it, and the triangles and sides that may overlap it. */
struct provenance_query {
  const struct sheet *sheet;
  struct boundary_segment segment;
  struct box2 box;
  uint32_t face;
  const uint32_t *own, *found, *side;
  size_t own_count, found_count, side_count;
};

/* Returns whether g is nearer than one of the face's triangles beside the
 * segment. */
static bool is_nearer_than_own(const struct provenance_query *q, uint32_t g,
                               const struct geom_corner *from,
                               const struct geom_corner *to) {
  for (size_t i = 0; i < q->own_count; i++)
    if (is_beside(q->sheet, q->own[i], &q->segment, from, to) &&
        is_nearer(q->sheet, q->own[i], g, &q->segment, from, to))
      return true;
  return false;
}

/* Returns whether the plane of one of the face's triangles intersects that of g
 * along the segment. */
static bool own_crosses_along(const struct provenance_query *q, uint32_t g) {
  for (size_t i = 0; i < q->own_count; i++)
    if (crosses_along(q->sheet, q->own[i], g, &q->segment))
      return true;
  return false;
}

/* Returns whether g is a triangle of another face, not edge-on, whose box
 * overlaps the segment. */
static bool may_bound_segment(const struct provenance_query *q, uint32_t g) {
  return q->sheet->triangle.item[g].face != q->face &&
         !sheet_is_edge_on(q->sheet, g) &&
         !box2_disjoint(q->box, box2_of_triangle(q->sheet, g));
}

/* The lowest edge that overlaps the segment among the sides found: among those
 * of the face itself, or among those of nearer faces. */
static uint32_t edge_found(const struct provenance_query *q, bool own) {
  uint32_t id = SHEET_NONE;
  struct geom_corner from, to;
  for (size_t i = 0; i < q->side_count; i++) {
    uint32_t g = q->side[i] / 3, k = q->side[i] % 3;
    uint32_t edge = sheet_triangle_sides(q->sheet, g)[k];
    if (edge < id && (q->sheet->triangle.item[g].face == q->face) == own &&
        overlaps_side(q->sheet, g, k, &q->segment, &from, &to) &&
        (own || is_nearer_than_own(q, g, &from, &to)))
      id = edge;
  }
  return id;
}

/* The lowest face below a number that intersects the face's plane along the
 * segment; that number if none does. */
static uint32_t crossing_face(const struct provenance_query *q, uint32_t past) {
  uint32_t face = past;
  for (size_t i = 0; i < q->found_count; i++) {
    uint32_t g = q->found[i], other = q->sheet->triangle.item[g].face;
    if (other < face && may_bound_segment(q, g) && own_crosses_along(q, g))
      face = other;
  }
  return face;
}

/* A label of a segment. */
struct side_label {
  uint8_t side; /* enum map_side */
  uint32_t id;
};

static bool is_better_label(struct side_label a, struct side_label b) {
  return a.side < b.side || (a.side == b.side && a.id < b.id);
}

/* The label that other faces give the segment, or any that is not better than
 * `best`. */
static struct side_label label_by_others(const struct provenance_query *q,
                                         struct side_label best) {
  struct side_label label = {MAP_SIDE_OCCLUDER, SHEET_NONE};
  if (best.side >= MAP_SIDE_OCCLUDER)
    label.id = edge_found(q, false);
  if (label.id != SHEET_NONE || best.side < MAP_SIDE_INTERSECTION)
    return label;
  label.side = MAP_SIDE_INTERSECTION;
  label.id = crossing_face(q, best.side == MAP_SIDE_INTERSECTION ? best.id
                                                                 : SHEET_NONE);
  if (label.id == SHEET_NONE)
    label.side = MAP_SIDE_CLIP;
  return label;
}

/* Returns whether f is a later triangle in contact with one of the face's
 * own. */
static bool touches_own(const struct provenance_query *q, uint32_t f) {
  if (!may_bound_segment(q, f))
    return false;
  for (size_t i = 0; i < q->own_count; i++)
    if (q->own[i] < f && triangles_touch(q->sheet, q->own[i], f))
      return true;
  return false;
}

/* The label that later triangles in contact with the face give the segment:
 * their visible pieces were passed on to the face (fragments.h) together with
 * the boundaries of these pieces. */
static struct side_label label_by_contacts(const struct provenance_query *q) {
  struct side_label best = {MAP_SIDE_CLIP, SHEET_NONE};
  for (size_t i = 0; i < q->found_count; i++) {
    struct provenance_query other = *q;
    uint32_t f = q->found[i];
    struct side_label label = {MAP_SIDE_EDGE, SHEET_NONE};
    if (!touches_own(q, f))
      continue;
    other.own = &f;
    other.own_count = 1;
    other.face = q->sheet->triangle.item[f].face;
    label.id = edge_along(q->sheet, f, &q->segment);
    if (label.id == SHEET_NONE)
      label = label_by_others(&other, best);
    if (is_better_label(label, best))
      best = label;
  }
  return best;
}

/* ---- Candidates near a segment ------------------------------------------- */

void side_provenance_fini(struct side_provenance *provenance) {
  ARRAY_FREE(&provenance->found);
  ARRAY_FREE(&provenance->nearby);
  ARRAY_FREE(&provenance->beside);
}

/* Binary search in an ascending list. */
static bool is_in_ascending(const uint32_t *item, size_t count,
                            uint32_t wanted) {
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

/* Reduces the face's triangles to those near the segment. */
static bool keep_own_nearby(struct side_provenance *provenance,
                            struct provenance_query *q) {
  provenance->nearby.count = 0;
  for (size_t i = 0; i < q->found_count; i++)
    if (is_in_ascending(provenance->own, provenance->own_count, q->found[i]) &&
        !ARRAY_PUSH(&provenance->nearby, q->found[i]))
      return false;
  q->own = provenance->nearby.item;
  q->own_count = provenance->nearby.count;
  return true;
}

/* Reduces the face's triangles to those that have area to the left of the
 * segment. */
static bool keep_own_beside(struct side_provenance *provenance,
                            struct provenance_query *q) {
  size_t kept = 0;
  if (!ARRAY_RESERVE(&provenance->beside, q->own_count))
    return false;
  for (size_t i = 0; i < q->own_count; i++)
    if (is_beside(q->sheet, q->own[i], &q->segment, q->segment.low,
                  q->segment.high))
      provenance->beside.item[kept++] = q->own[i];
  q->own = provenance->beside.item;
  q->own_count = kept;
  return true;
}

bool side_provenance_find(struct side_provenance *provenance,
                          const struct geom_line *line,
                          const struct geom_corner *p,
                          const struct geom_corner *q, uint8_t *side,
                          uint32_t *id) {
  bool forward = geom_corner_compare(p, q) < 0;
  struct provenance_query query = {
      .sheet = provenance->sheet,
      .segment = {line, forward ? p : q, forward ? q : p},
      .face = provenance->sheet->triangle.item[provenance->own[0]].face};
  provenance->found.count = 0;
  if (!line_index_find(provenance->sides, line, query.segment.low,
                       query.segment.high, &provenance->found))
    return false;
  query.side = provenance->found.item;
  query.side_count = provenance->found.count;
  *side = MAP_SIDE_EDGE;
  *id = edge_found(&query, true);
  if (*id != SHEET_NONE)
    return true;
  query.box = segment_box(&query.segment);
  if (!triangle_grid_find(provenance->grid, query.box, provenance->query))
    return false;
  query.found = provenance->query->found.item;
  query.found_count = provenance->query->found.count;
  if (!keep_own_nearby(provenance, &query))
    return false;
  *side = MAP_SIDE_OCCLUDER;
  *id = edge_found(&query, false);
  if (*id != SHEET_NONE)
    return true;
  if (!keep_own_beside(provenance, &query))
    return false;
  *side = MAP_SIDE_INTERSECTION;
  *id = crossing_face(&query, SHEET_NONE);
  if (*id != SHEET_NONE)
    return true;
  struct side_label label = label_by_contacts(&query);
  *side = label.side;
  *id = label.id;
  return true;
}
