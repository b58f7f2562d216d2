/* edge_copies.c - copies the edges of a part to the faces that repeat it.
 *
 * Why that is exact  Where no edge has begun at the points of a part before its
 * first face is numbered, and none at those of a copy, numbering would find in
 * both that a side is new, or which one of the part's own edges it is, by the
 * order of these points; and the copy's points have the same order.
 * Cost  of an assembly of like parts a third of looking up each side. */
#include "scene/topology/edge_copies.h"

#include <string.h>

#include "base/poll.h"

/* A search without success is followed by one after twice as many calls. */
enum { WAIT_MAX = 64 };

/* Numbers are added to by lanes. */
enum { LANES = 4 };
typedef uint32_t number_lanes __attribute__((vector_size(16)));

static bool have_no_edges(const uint32_t *head, uint32_t points) {
  uint32_t all = SCENE_NONE; /* the bits that are set in each */
  for (uint32_t i = 0; i < points; i++)
    all &= head[i];
  return all == SCENE_NONE;
}

/* Adds to numbers of edges, of which SCENE_NONE is none. */
static void copy_numbers(uint32_t *to, const uint32_t *from, size_t count,
                         uint32_t shift) {
  const number_lanes none = {SCENE_NONE, SCENE_NONE, SCENE_NONE, SCENE_NONE};
  size_t i = 0;
  for (; i + LANES <= count; i += LANES) {
    number_lanes number;
    memcpy(&number, from + i, sizeof number);
    number += (number_lanes)(number != none) & shift;
    memcpy(to + i, &number, sizeof number);
  }
  for (; i < count; i++)
    to[i] = from[i] == SCENE_NONE ? SCENE_NONE : from[i] + shift;
}

void corner_copy_make(uint32_t *corner_edge, const struct corner_copy *copy) {
  copy_numbers(corner_edge + copy->to, corner_edge + copy->from, copy->count,
               copy->shift);
}

/* What is added to an edge by adding so much to each of its numbers: nothing
 * overflows from one into another, as what they become is in range. */
static number_lanes shift_of_edge(uint32_t point, uint32_t first,
                                  uint32_t second) {
  const struct topology_edge edge = {.point = {point, point},
                                     .first = first & TOPOLOGY_FACE_BITS,
                                     .second = second & TOPOLOGY_FACE_BITS};
  number_lanes lanes;
  _Static_assert(sizeof lanes == sizeof edge, "a lane for each 32 bits");
  memcpy(&lanes, &edge, sizeof lanes);
  return lanes;
}

static void copy_edges(struct topology_edge *to,
                       const struct topology_edge *from, size_t count,
                       uint32_t point_shift, uint32_t face_shift) {
  const number_lanes shift_of_one = shift_of_edge(point_shift, face_shift, 0),
                     shift_of_two =
                         shift_of_edge(point_shift, face_shift, face_shift);
  for (size_t e = 0; e < count; e++) {
    number_lanes lanes;
    memcpy(&lanes, &from[e], sizeof lanes);
    lanes += from[e].uses == 1 ? shift_of_one : shift_of_two;
    memcpy(&to[e], &lanes, sizeof lanes);
  }
}

/* Copies the edges of the part to faces that repeat it, and lets their sides
 * refer to these; there is room for them.  Their lists are not made. */
static bool copy_to(const struct edge_copies *copies, struct edge_range *range,
                    uint32_t face, uint32_t shift) {
  const struct repeated_part *part = &copies->part;
  size_t at = range->edge.count;
  struct corner_copy corners = {.from = part->corner,
                                .to = scene_face_start(range->scene, face),
                                .count = part->corners,
                                .shift = (uint32_t)(at - copies->edge)};
  copy_edges(range->edge.item + at, range->edge.item + copies->edge,
             copies->edges, shift, face - part->face);
  range->edge.count += copies->edges;
  range->shared += copies->shared;
  if (range->corner_edge == NULL)
    return true;
  if (range->puts_corners_off)
    return ARRAY_PUSH(&range->corner_copy, corners);
  corner_copy_make(range->corner_edge, &corners);
  return true;
}

/* Makes the lists of the edges of copies. */
static void list_copies(struct edge_copies *copies, struct edge_range *range) {
  const struct repeated_part *part = &copies->part;
  size_t edges = copies->edges,
         at = range->edge.count - copies->shift.count * edges;
  for (size_t i = 0; i < copies->shift.count; i++, at += edges) {
    uint32_t edge_shift = (uint32_t)(at - copies->edge);
    copy_numbers(range->next + at, range->next + copies->edge, edges,
                 edge_shift);
    copy_numbers(range->head + (uint32_t)(part->point + copies->shift.item[i]),
                 range->head + part->point, part->points, edge_shift);
  }
  copies->shift.count = 0;
}

/* Whether there are no edges yet at the points of a copy, with these and no
 * lists of the copies before. */
static bool has_free_points(struct edge_copies *copies,
                            struct edge_range *range, uint32_t shift) {
  const struct repeated_part *part = &copies->part;
  size_t count = copies->shift.count;
  uint32_t last = count > 0 ? copies->shift.item[count - 1] : 0;
  if (shift < last || shift - last < part->points)
    list_copies(copies, range);
  return have_no_edges(range->head + (uint32_t)(part->point + shift),
                       part->points);
}

/* Copies the edges of the part, which was just numbered, as often as the next
 * faces repeat it.  Where no faces follow, nobody asks for their lists.  False
 * when memory ran out, or the caller cancelled. */
static bool copy_part(struct edge_copies *copies, struct edge_range *range,
                      uint32_t *face) {
  const struct repeated_part *part = &copies->part;
  uint32_t shift, sides = 0;
  for (; repeated_part_is_at(part, range->scene, *face, range->end_face,
                             &shift) &&
         has_free_points(copies, range, shift);
       *face += part->faces) {
    if (!edge_range_reserve(range, copies->edges) ||
        !ARRAY_PUSH(&copies->shift, shift) ||
        !copy_to(copies, range, *face, shift))
      return false;
    sides += part->corners;
    if (sides >= POLL_ITEMS && !poll_now())
      return false;
    sides = sides >= POLL_ITEMS ? 0 : sides;
  }
  if (*face < range->end_face || !edge_range_is_whole(range))
    list_copies(copies, range);
  copies->shift.count = 0;
  return true;
}

/* Looks for a part among the next faces. */
static void find_part(struct edge_copies *copies,
                      const struct edge_range *range, uint32_t face) {
  copies->part.faces = 0;
  if (copies->wait > 0) {
    copies->wait--;
    return;
  }
  struct repeated_part part;
  bool found = repeated_part_find(&part, range->scene, range->head, face,
                                  range->end_face);
  if (found && have_no_edges(range->head + part.point, part.points)) {
    copies->part = part;
    copies->next_wait = 0;
    return;
  }
  copies->wait = copies->next_wait;
  if (copies->next_wait < WAIT_MAX / 2)
    copies->next_wait = 2 * copies->next_wait + 1;
}

bool edge_copies_add(struct edge_copies *copies, struct edge_range *range,
                     uint32_t *face) {
  struct repeated_part *part = &copies->part;
  if (part->faces > 0 && *face == part->face + part->faces) {
    copies->edges = range->edge.count - copies->edge;
    copies->shared = range->shared - copies->shared;
    if (!copy_part(copies, range, face))
      return false;
    part->faces = 0;
  }
  if (part->faces == 0)
    find_part(copies, range, *face);
  if (part->faces > 0 && *face == part->face) {
    copies->edge = range->edge.count;
    copies->shared = range->shared;
    if (!have_no_edges(range->head + part->point, part->points))
      part->faces = 0;
  }
  copies->stop = part->faces == 0     ? range->end_face
                 : *face < part->face ? part->face
                                      : part->face + part->faces;
  return true;
}

void edge_copies_fini(struct edge_copies *copies) {
  ARRAY_FREE(&copies->shift);
}
