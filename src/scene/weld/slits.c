/* slits.c - follows pairs of borders along each other.
 *
 * Phases
 *   shared  where borders are many, whether there is a point at which two faces
 *           have some; in a soup of separate triangles there is none.
 *   ends    of all borders, sorted by their points.
 *   follow  two borders from each point where the one lies on the other: the
 *           one that ends first is continued, and its end noted on the other,
 *           until both end at one point, or nothing goes on.
 * Limits  at a point with more borders than ENDS_MAX no slit begins or goes on,
 *         and where two borders could continue one, none does. */
#include "scene/weld/slits.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "base/sort.h"
#include "geom/vector.h"
#include "scene/exact.h"
#include "scene/weld/thin_faces.h"

/* Of fewer borders than one for so many points the ends are sorted at once. */
enum { ENDS_MAX = 16, FEW_BORDERS = 16 };

struct slit_search {
  const struct scene *scene;
  const struct topology *topology;
  struct precision unstated;
  struct sort_key *end; /* of borders: by point, the edge as the value */
  size_t ends;
  uint64_t *closed;    /* a bit an edge: it is of a slit that was found */
  ARRAY(uint32_t) way; /* the edges of the slit that is followed */
  bool out_of_memory;
  slit_points *found;
};

/* The last border of a way along a slit. */
struct slit_side {
  uint32_t edge;
  uint32_t from, to; /* its ends, in the direction of the way */
};

/* ---- The ends of borders ------------------------------------------------- */

/* Whether several faces have borders at a point. */
static bool has_shared_point(struct slit_search *search) {
  const struct topology *topology = search->topology;
  size_t points = search->scene->point.count;
  uint32_t *face = mem_alloc(points, sizeof *face);
  search->out_of_memory = face == NULL;
  if (face == NULL)
    return false;
  memset(face, 0xff, points * sizeof *face);
  bool shared = false;
  for (uint32_t e = topology_next_border(topology, 0);
       !shared && e < topology->edge.count;
       e = topology_next_border(topology, e + 1)) {
    const struct topology_edge *edge = &topology->edge.item[e];
    for (int k = 0; k < 2; k++) {
      uint32_t *own = &face[edge->point[k]];
      shared = shared || (*own != SCENE_NONE && *own != edge->first);
      *own = edge->first;
    }
  }
  mem_free(face);
  return shared;
}

static bool sort_border_ends(struct slit_search *search) {
  const struct topology *topology = search->topology;
  search->end = mem_alloc(2 * topology->borders, sizeof *search->end);
  if (search->end == NULL)
    return false;
  for (uint32_t e = topology_next_border(topology, 0); e < topology->edge.count;
       e = topology_next_border(topology, e + 1))
    for (int k = 0; k < 2; k++)
      search->end[search->ends++] =
          (struct sort_key){topology->edge.item[e].point[k], e};
  return sort_keys_alone(search->end, search->ends);
}

/* The first end at a point.
 * count  gets how many there are; 0: too many to look at */
static const struct sort_key *border_ends_at(const struct slit_search *search,
                                             uint32_t point, size_t *count) {
  size_t i, n = 0;
  LOWER_BOUND(i, 0, search->ends, search->end[i].key < point);
  while (i + n < search->ends && search->end[i + n].key == point)
    n++;
  *count = n <= ENDS_MAX ? n : 0;
  return search->end + i;
}

static uint32_t far_end(const struct slit_search *search, uint32_t edge,
                        uint32_t point) {
  const uint32_t *end = search->topology->edge.item[edge].point;
  return end[0] == point ? end[1] : end[0];
}

static bool is_closed(const struct slit_search *search, uint32_t edge) {
  return search->closed[edge / 64] >> edge % 64 & 1;
}

/* ---- Following a slit ---------------------------------------------------- */

/* Whether a point lies on the line between two others, and not at its ends. */
static bool lies_between(const struct slit_search *search, uint32_t a,
                         uint32_t b, uint32_t between) {
  const struct scene_point *point = search->scene->point.item;
  const struct scene_point *p = &point[a], *q = &point[b], *r = &point[between];
  const double side[3] = {q->x - p->x, q->y - p->y, q->z - p->z};
  const double to[3] = {r->x - p->x, r->y - p->y, r->z - p->z};
  double along = vector_dot(side, to), square = vector_dot(side, side);
  if (!(along > 0 && along < square))
    return false;
  if (exact_are_collinear(p, q, r))
    return true;
  double cross[3], length = sqrt(square);
  vector_cross(side, to, cross);
  return vector_length(cross) <= length * thin_faces_length(search->scene,
                                                            between, length,
                                                            search->unstated);
}

/* Notes that a point lies on a side of a face; false where that has it as a
 * corner, or memory ran out. */
static bool note_point(struct slit_search *search, const struct slit_side *side,
                       uint32_t point) {
  const struct scene *scene = search->scene;
  const uint32_t *weld = search->topology->weld;
  uint32_t face = search->topology->edge.item[side->edge].first;
  struct slit_point found = {.corner = SCENE_NONE, .point = point};
  for (uint32_t c = scene_face_start(scene, face);
       c < scene_face_start(scene, face + 1); c++) {
    uint32_t p = scene->corner.item[c];
    uint32_t q = scene->corner.item[scene_next_corner(scene, face, c)];
    p = weld != NULL ? weld[p] : p;
    q = weld != NULL ? weld[q] : q;
    if (p == point)
      return false;
    uint32_t place = (uint32_t)search->found->count;
    if (p == side->from && q == side->to)
      found.corner = c, found.place = place;
    if (p == side->to && q == side->from)
      found.corner = c, found.place = UINT32_MAX - place;
  }
  if (found.corner == SCENE_NONE)
    return false;
  search->out_of_memory = !ARRAY_PUSH(search->found, found);
  return !search->out_of_memory;
}

/* Continues a side from its end by the only border that goes along the way to
 * `target`; false where there is none, or several. */
static bool continue_side(const struct slit_search *search,
                          struct slit_side *side, uint32_t target) {
  size_t count;
  const struct sort_key *end = border_ends_at(search, side->to, &count);
  uint32_t found = SCENE_NONE;
  for (size_t i = 0; i < count; i++) {
    uint32_t edge = end[i].value, to = far_end(search, edge, side->to);
    if (edge == side->edge || is_closed(search, edge) ||
        (to != target && !lies_between(search, side->to, target, to) &&
         !lies_between(search, side->to, to, target)))
      continue;
    if (found != SCENE_NONE)
      return false;
    found = edge;
  }
  if (found == SCENE_NONE)
    return false;
  *side = (struct slit_side){found, side->to, far_end(search, found, side->to)};
  return true;
}

/* Follows two borders along each other; returns whether they meet. */
static bool follow_slit(struct slit_search *search, struct slit_side side[2]) {
  while (side[0].to != side[1].to) {
    if (search->way.count > search->ends) /* it goes round and round */
      return false;
    int behind =
        lies_between(search, side[0].from, side[0].to, side[1].to) ? 1 : 0;
    struct slit_side *first = &side[behind], *ahead = &side[1 - behind];
    if (behind == 0 && !lies_between(search, ahead->from, ahead->to, first->to))
      return false;
    if (!note_point(search, ahead, first->to) ||
        !continue_side(search, first, ahead->to))
      return false;
    search->out_of_memory = !ARRAY_PUSH(&search->way, first->edge);
    if (search->out_of_memory)
      return false;
  }
  return true;
}

/* Looks for a slit that two borders begin at a point. */
static void try_borders(struct slit_search *search, uint32_t point, uint32_t a,
                        uint32_t b) {
  struct slit_side side[2] = {{a, point, far_end(search, a, point)},
                              {b, point, far_end(search, b, point)}};
  size_t before = search->found->count;
  search->way.count = 0;
  if (follow_slit(search, side)) {
    search->closed[a / 64] |= UINT64_C(1) << a % 64;
    search->closed[b / 64] |= UINT64_C(1) << b % 64;
    for (size_t i = 0; i < search->way.count; i++)
      search->closed[search->way.item[i] / 64] |= UINT64_C(1)
                                                  << search->way.item[i] % 64;
  } else {
    search->found->count = before;
  }
}

/* ---- All of it ----------------------------------------------------------- */

/* Tries each two borders that end at one point. */
static bool try_all(struct slit_search *search) {
  for (size_t i = 0, past; i < search->ends; i = past) {
    uint32_t point = (uint32_t)search->end[i].key;
    for (past = i + 1; past < search->ends && search->end[past].key == point;)
      past++;
    for (size_t a = i; past - i <= ENDS_MAX && a < past; a++)
      for (size_t b = a + 1; b < past; b++)
        if (!is_closed(search, search->end[a].value) &&
            !is_closed(search, search->end[b].value))
          try_borders(search, point, search->end[a].value,
                      search->end[b].value);
    if (search->out_of_memory || !poll_at(i))
      return false;
  }
  return true;
}

static int compare_slit_points(const void *a, const void *b, void *user) {
  const struct slit_point *p = a, *q = b;
  (void)user;
  return p->corner != q->corner ? compare_numbers(p->corner, q->corner)
                                : compare_numbers(p->place, q->place);
}

bool slits_find(const struct scene *scene, const struct topology *topology,
                struct precision unstated, slit_points *found) {
  struct slit_search search = {.scene = scene,
                               .topology = topology,
                               .unstated = unstated,
                               .found = found};
  bool many = topology->borders > scene->point.count / FEW_BORDERS;
  if (topology->borders == 0 || (many && !has_shared_point(&search)))
    return !search.out_of_memory;
  search.closed =
      mem_calloc(topology->edge.count / 64 + 1, sizeof *search.closed);
  bool ok = search.closed != NULL && sort_border_ends(&search) &&
            try_all(&search) &&
            sort_stable(found->item, found->count, sizeof *found->item,
                        compare_slit_points, NULL);
  mem_free(search.closed);
  mem_free(search.end);
  ARRAY_FREE(&search.way);
  return ok;
}
