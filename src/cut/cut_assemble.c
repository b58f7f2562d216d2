/* cut_assemble.c - makes the scene that a cut leaves: the faces that stay, with
 * corners where others were split beside them, the cut faces, and the polylines
 * that stay. */
#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "cut/cut_phases.h"

struct assembly {
  struct cutter *cutter;
  struct scene *scene;
  uint8_t *needed;             /* of each place: a line ends there, or a part */
  ARRAY(uint32_t) corner;      /* of the current piece of a polyline */
  ARRAY(uint32_t) face;        /* of each face that stays: the one it is of */
  ARRAY(uint32_t) wire;        /* of each polyline: likewise */
  ARRAY(struct sort_key) edge; /* the sides of cut faces, and open lines */
  ARRAY(struct sort_key) side; /* of the current face, or of all its parts */
  ARRAY(struct sort_key) inner; /* sides that parts of a face have in common:
                                   how many have them */
};

/* ---- Faces --------------------------------------------------------------- */

/* Where the corners of the current face begin. */
static uint32_t first_corner(const struct scene *scene) {
  return scene_face_start(scene, scene_face_count(scene));
}

static bool add_face_corner(struct assembly *a, uint32_t point) {
  struct scene *scene = a->scene;
  size_t count = scene->corner.count;
  point = cut_place(a->cutter, point);
  return (count > first_corner(scene) &&
          scene->corner.item[count - 1] == point) ||
         ARRAY_PUSH(&scene->corner, point);
}

/* Ends the current face, and drops it if its corners have become fewer than
 * three. */
static bool end_cut_face(struct assembly *a, uint32_t group) {
  struct scene *scene = a->scene;
  const uint32_t *corner = scene->corner.item;
  size_t first = first_corner(scene), count = scene->corner.count;
  while (count > first + 1 && corner[count - 1] == corner[first])
    count--;
  if (count < first + 3) {
    scene->corner.count = first;
    return true;
  }
  scene->corner.count = count;
  return scene_end_face(scene, group);
}

/* Finds the points of the cut that are corners of what is left.  The others lie
 * on sides of faces, where a plane meets them and nothing goes.  Returns false
 * when memory ran out. */
static bool find_needed(struct assembly *a) {
  const struct cutter *cutter = a->cutter;
  uint32_t first = cutter->points.first;
  a->needed = mem_calloc(cutter->points.point.count, sizeof *a->needed);
  if (a->needed == NULL)
    return false;
  for (uint32_t i = 0; i < cutter->points.point.count; i++)
    if (cutter->points.point.item[i].is_corner)
      a->needed[cut_place(cutter, first + i) - first] = 1;
  for (size_t i = 0; i < cutter->lines.line.count; i++) {
    const struct cut_line *line = &cutter->lines.line.item[i];
    a->needed[cut_place(cutter, line->from) - first] = 1;
    a->needed[cut_place(cutter, line->to) - first] = 1;
  }
  for (size_t p = 0; p < cutter->part.count; p++) {
    const struct cut_part *part = &cutter->part.item[p];
    const struct cut_corner *corner = cutter->corner.item + part->corner;
    for (uint32_t i = 0; i < part->count && !part->united; i++)
      if (corner[i].point >= first)
        a->needed[cut_place(cutter, corner[i].point) - first] = 1;
  }
  return true;
}

static bool is_needless(const struct assembly *a, uint32_t point) {
  uint32_t first = a->cutter->points.first;
  return point >= first && !a->needed[cut_place(a->cutter, point) - first];
}

static bool add_face_part(struct assembly *a, const struct cut_part *part) {
  const struct cut_corner *corner = a->cutter->corner.item + part->corner;
  size_t faces = a->scene->face_count;
  for (uint32_t i = 0; i < part->count; i++)
    if (!(part->united && is_needless(a, corner[i].point)) &&
        !add_face_corner(a, corner[i].point))
      return false;
  return end_cut_face(a, scene_face_group(a->cutter->scene, part->face)) &&
         (a->scene->face_count == faces || ARRAY_PUSH(&a->face, part->face));
}

static bool add_whole_cut_face(struct assembly *a, uint32_t face) {
  const struct scene *from = a->cutter->scene;
  struct scene *scene = a->scene;
  uint32_t past = scene_face_start(from, face + 1);
  size_t faces = scene->face_count;
  if (!ARRAY_RESERVE(&scene->corner, past - scene_face_start(from, face)))
    return false;
  for (uint32_t c = scene_face_start(from, face); c < past; c++)
    scene->corner.item[scene->corner.count++] =
        cut_weld(a->cutter, from->corner.item[c]);
  return end_cut_face(a, scene_face_group(from, face)) &&
         (scene->face_count == faces || ARRAY_PUSH(&a->face, face));
}

static bool add_face_sides(struct assembly *a, uint32_t face) {
  const struct scene *scene = a->scene;
  const uint32_t *corner = scene->corner.item;
  for (uint32_t c = scene_face_start(scene, face);
       c < scene_face_start(scene, face + 1); c++) {
    uint32_t from = corner[c], to = corner[scene_next_corner(scene, face, c)];
    const struct sort_key side = {sort_pair_key(from, to), from < to};
    if (!ARRAY_PUSH(&a->side, side))
      return false;
  }
  return true;
}

/* Adds the sides along which the faces from `first` on, parts of one face, meet
 * each other, with how many of them do. */
static bool add_inner_sides(struct assembly *a, uint32_t first) {
  a->side.count = 0;
  for (uint32_t face = first; face < scene_face_count(a->scene); face++)
    if (!add_face_sides(a, face))
      return false;
  if (!sort_keys_alone(a->side.item, a->side.count))
    return false;
  size_t past;
  for (size_t i = 0; i < a->side.count; i = past) {
    size_t ascending = 0;
    for (past = i;
         past < a->side.count && a->side.item[past].key == a->side.item[i].key;
         past++)
      ascending += a->side.item[past].value;
    const struct sort_key inner = {a->side.item[i].key, (uint32_t)(past - i)};
    if (2 * ascending == past - i && !ARRAY_PUSH(&a->inner, inner))
      return false;
  }
  return true;
}

/* Keeps of these sides those that no other face has. */
static bool keep_inner_sides(struct assembly *a) {
  struct sort_key *inner = a->inner.item;
  size_t count = 0;
  if (a->inner.count == 0)
    return true;
  if (!sort_keys_alone(inner, a->inner.count))
    return false;
  for (size_t i = 0; i < a->inner.count; i++)
    if (count > 0 && inner[count - 1].key == inner[i].key)
      inner[count - 1].value += inner[i].value;
    else
      inner[count++] = inner[i];
  for (uint32_t face = 0; face < scene_face_count(a->scene); face++) {
    a->side.count = 0;
    if (!poll_at(face) || !add_face_sides(a, face))
      return false;
    for (size_t i = 0; i < a->side.count; i++) {
      size_t at;
      LOWER_BOUND(at, 0, count, inner[at].key < a->side.item[i].key);
      if (at < count && inner[at].key == a->side.item[i].key)
        inner[at].value--;
    }
  }
  a->inner.count = 0;
  for (size_t i = 0; i < count; i++)
    if (inner[i].value == 0)
      inner[a->inner.count++] = inner[i];
  return true;
}

static bool add_cut_scene_faces(struct assembly *a) {
  const struct cutter *cutter = a->cutter;
  size_t next = 0;
  for (uint32_t face = 0; face < scene_face_count(cutter->scene); face++) {
    if (!poll_at(face))
      return false;
    if (cutter->fate[face] == CUT_STAYS && !add_whole_cut_face(a, face))
      return false;
    uint32_t first = scene_face_count(a->scene);
    for (; next < cutter->part.count && cutter->part.item[next].face == face;
         next++)
      if (!add_face_part(a, &cutter->part.item[next]))
        return false;
    if (scene_face_count(a->scene) > first + 1 && !add_inner_sides(a, first))
      return false;
  }
  return true;
}

/* ---- Cut faces ----------------------------------------------------------- */

static bool add_edge_key(struct assembly *a, uint32_t from, uint32_t to) {
  const struct sort_key key = {sort_pair_key(from, to), 0};
  return ARRAY_PUSH(&a->edge, key);
}

/* Adds the cut faces of a plane, and the lines along which it cuts. */
static bool add_section_faces(struct assembly *a, unsigned plane) {
  const struct cutter *cutter = a->cutter;
  const struct section *section = &cutter->section[plane];
  for (size_t l = 0; l < section->loop.count; l++) {
    const struct section_loop *loop = &section->loop.item[l];
    for (uint32_t i = 0; i < loop->count; i++)
      if (!add_face_corner(
              a, cut_node_point(cutter, plane,
                                section->corner.item[loop->corner + i])))
        return false;
    if (!end_cut_face(a, loop->label))
      return false;
  }
  for (size_t e = 0; e < section->boundaries; e++) {
    const struct section_edge *edge = &section->edge.item[e];
    if (!add_edge_key(a, cut_node_point(cutter, plane, edge->a),
                      cut_node_point(cutter, plane, edge->b)))
      return false;
  }
  for (size_t i = 0; i < cutter->lines.line.count; i++) {
    const struct cut_line *line = &cutter->lines.line.item[i];
    if (line->open && line->plane == plane &&
        !add_edge_key(a, cut_place(cutter, line->from),
                      cut_place(cutter, line->to)))
      return false;
  }
  return true;
}

/* ---- Polylines ----------------------------------------------------------- */

/* Where a side of a polyline comes beyond all planes and leaves that: the
 * planes, or CUT_NO_PLANE for its ends.  Returns false where it never does. */
static bool find_gap(const struct cut_points *points, uint32_t from,
                     uint32_t to, uint8_t plane[2]) {
  const struct scene_point *p = &points->scene->point.item[from];
  const struct scene_point *q = &points->scene->point.item[to];
  double t[2] = {0, 1};
  plane[0] = plane[1] = CUT_NO_PLANE;
  for (uint8_t k = 0; k < points->planes; k++) {
    const double *n = points->plane[k].normal;
    bool end = cut_is_beyond(points, to, k);
    if (end == cut_is_beyond(points, from, k)) {
      if (!end)
        return false;
      continue;
    }
    double above = n[0] * p->x + n[1] * p->y + n[2] * p->z;
    double change =
        n[0] * (q->x - p->x) + n[1] * (q->y - p->y) + n[2] * (q->z - p->z);
    double at = (points->plane[k].offset - above) / change;
    if (end ? at >= t[0] : at <= t[1]) {
      t[!end] = at;
      plane[!end] = k;
    }
  }
  return t[0] < t[1];
}

static bool add_wire_corner(struct assembly *a, uint32_t point) {
  size_t count = a->corner.count;
  point = cut_place(a->cutter, point);
  return (count > 0 && a->corner.item[count - 1] == point) ||
         ARRAY_PUSH(&a->corner, point);
}

/* Adds the current piece of a polyline, if it is one. */
static bool end_cut_wire(struct assembly *a, uint32_t wire) {
  struct scene *scene = a->scene;
  bool ok = true;
  for (size_t i = 0; ok && a->corner.count > 1 && i < a->corner.count; i++)
    ok = ARRAY_PUSH(&scene->wire_corner, a->corner.item[i]);
  if (ok && a->corner.count > 1)
    ok = ARRAY_PUSH(&scene->wire_start, (uint32_t)scene->wire_corner.count) &&
         ARRAY_PUSH(&scene->wire_group,
                    a->cutter->scene->wire_group.item[wire]) &&
         ARRAY_PUSH(&a->wire, wire);
  a->corner.count = 0;
  return ok;
}

static bool add_wire_pieces(struct assembly *a, uint32_t wire) {
  struct cutter *cutter = a->cutter;
  struct cut_points *points = &cutter->points;
  const struct scene *from = cutter->scene;
  uint32_t past = from->wire_start.item[wire + 1];
  a->corner.count = 0;
  for (uint32_t c = from->wire_start.item[wire]; c < past; c++) {
    uint32_t p = cut_weld(cutter, from->wire_corner.item[c]);
    unsigned all = (1u << points->planes) - 1;
    if (cut_beyond(points, p) != all && !add_wire_corner(a, p))
      return false;
    if (c + 1 == past)
      break;
    uint32_t q = cut_weld(cutter, from->wire_corner.item[c + 1]);
    bool from_kept = cut_beyond(points, p) != all,
         to_kept = cut_beyond(points, q) != all;
    uint8_t plane[2];
    if (!find_gap(points, p, q, plane)) {
      /* An end that is on the plane belongs to the piece before or after. */
      if (from_kept != to_kept && !add_wire_corner(a, from_kept ? q : p))
        return false;
      continue;
    }
    for (int k = 0; k < 2; k++) {
      uint32_t meet = plane[k] != CUT_NO_PLANE
                          ? cut_points_meet(points, p, q, plane[k])
                          : 0;
      if (meet == SCENE_NONE ||
          (plane[k] != CUT_NO_PLANE && !add_wire_corner(a, meet)) ||
          (k == 0 && !end_cut_wire(a, wire)))
        return false;
    }
  }
  return end_cut_wire(a, wire);
}

static bool add_cut_wires(struct assembly *a) {
  uint32_t count = scene_wire_count(a->cutter->scene);
  bool ok = count == 0 || ARRAY_PUSH(&a->scene->wire_start, 0);
  for (uint32_t w = 0; ok && w < count; w++)
    ok = poll_at(w) && add_wire_pieces(a, w);
  a->cutter->anything_goes =
      a->cutter->anything_goes ||
      a->scene->wire_corner.count != a->cutter->scene->wire_corner.count;
  return ok;
}

/* ---- Points -------------------------------------------------------------- */

static bool add_cut_points(struct assembly *a, uint8_t *planes) {
  const struct cut_points *points = &a->cutter->points;
  struct scene *scene = a->scene;
  size_t count = points->first, made = points->point.count;
  if (!ARRAY_RESERVE(&scene->point, count + made))
    return false;
  if (count > 0)
    memcpy(scene->point.item, points->scene->point.item,
           count * sizeof *scene->point.item);
  for (size_t i = 0; i < made; i++) {
    scene->point.item[count + i] =
        cut_points_position(points, points->point.item[i].at);
    planes[i] = points->point.item[i].on;
  }
  scene->point.count = count + made;
  return true;
}

static struct precision coarser_precision(struct precision a,
                                          struct precision b) {
  return (struct precision){fmax(a.absolute, b.absolute),
                            fmax(a.relative, b.relative)};
}

/* Points that were made are rounded as those of the scene are, or as the grid
 * is. */
static bool add_precisions(struct assembly *a, struct precision unstated) {
  const struct scene *from = a->cutter->scene;
  double unit = a->cutter->points.unit;
  struct precision most = {unit, 0};
  size_t count = from->precision.count;
  bool all_stated = count > 0 && from->precision.item[0].first_point == 0;
  for (size_t i = 0; i < count; i++) {
    const struct precision_range *range = &from->precision.item[i];
    if (!ARRAY_PUSH(&a->scene->precision, *range))
      return false;
    all_stated &= range->stated;
    if (range->stated)
      most = coarser_precision(most, range->precision);
  }
  if (!all_stated)
    most = coarser_precision(most, unstated);
  if (count == 1 && from->precision.item[0].stated &&
      from->precision.item[0].precision.absolute >= unit)
    return true;
  const struct precision_range range = {a->cutter->points.first, true, most};
  return ARRAY_PUSH(&a->scene->precision, range);
}

/* ---- The scene ----------------------------------------------------------- */

/* The keys, ascending; NULL when memory ran out. */
static uint64_t *sorted_keys(struct sort_key *item, size_t count) {
  uint64_t *key = mem_alloc(count, sizeof *key);
  bool ok = key != NULL && sort_keys_alone(item, count);
  for (size_t i = 0; ok && i < count; i++)
    key[i] = item[i].key;
  if (ok)
    return key;
  mem_free(key);
  return NULL;
}

/* Hands the lists that describe the cut over to it. */
static bool describe_cut(struct assembly *a, uint8_t *planes) {
  struct cut *cut = a->cutter->cut;
  cut->made.first_point = a->cutter->points.first;
  cut->made.planes = planes;
  cut->made.edge = sorted_keys(a->edge.item, a->edge.count);
  cut->made.edges = a->edge.count;
  cut->made.inner = sorted_keys(a->inner.item, a->inner.count);
  cut->made.inners = a->inner.count;
  cut->made.face = a->face.item;
  cut->made.wire = a->wire.item;
  cut->scene.cut = &cut->made;
  return cut->made.edge != NULL && cut->made.inner != NULL;
}

recto_status cut_assemble(struct cutter *cutter, struct precision unstated,
                          recto_error *error) {
  struct cut *cut = cutter->cut;
  struct assembly a = {.cutter = cutter, .scene = &cut->scene};
  bool ok = find_needed(&a) && add_cut_scene_faces(&a);
  cut->made.first_face = scene_face_count(&cut->scene);
  for (unsigned k = 0; ok && k < cutter->points.planes; k++)
    ok = add_section_faces(&a, k);
  ok = ok && keep_inner_sides(&a);
  ok = ok && add_cut_wires(&a);
  uint8_t *planes = mem_alloc(cutter->points.point.count, sizeof *planes);
  ok = ok && planes != NULL && add_cut_points(&a, planes) &&
       add_precisions(&a, unstated);
  ok = describe_cut(&a, planes) && ok;
  mem_free(a.needed);
  ARRAY_FREE(&a.corner);
  ARRAY_FREE(&a.edge);
  ARRAY_FREE(&a.side);
  ARRAY_FREE(&a.inner);
  if (!ok)
    return error_memory(error);
  if (scene_face_count(&cut->scene) == 0 && scene_wire_count(&cut->scene) == 0)
    return error_set(error, RECTO_ERROR_EMPTY, NULL, 0,
                     "the cut leaves nothing: all of the model is beyond the "
                     "plane");
  return RECTO_OK;
}
