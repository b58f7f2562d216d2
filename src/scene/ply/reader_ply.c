/* reader_ply.c - PLY: vertices, faces, strips of triangles and edges, text or
 * binary in either order of bytes, with their colours.
 *
 * The header says what follows (ply_header.h); ply_parser.c takes one element
 * after another.  Elements and properties that are nothing to us are passed
 * over.  Faces may stand before the vertices: what comes before these is read
 * after them.
 *
 * Normals of vertices, where they are wanted, are those of the corners there;
 * where they differ, a place has several vertices.
 *
 * Colours, where they are wanted: of a face its own, else the mean of those of
 * its corners; they make groups (ply_colour.h) but no lines.
 *
 * Robustness: no number of elements is trusted: memory is allocated for no more
 * than the rest of the file can hold.  Elements that make no sense are skipped
 * with a warning; a file that ends before its last element is an error.
 */
#include "scene/scene.h"

#include <math.h>

#include "scene/corner_normals.h"
#include "scene/limit.h"
#include "scene/ply/ply_colour.h"
#include "scene/ply/ply_runs.h"
#include "scene/ply/ply_value.h"
#include "scene/read.h"

/* ---- What cannot be read ------------------------------------------------- */

static const char *name_of(enum ply_kind kind) {
  static const char *const name[] = {"vertex", "face", "tristrips", "edge",
                                     "other element"};
  return name[kind];
}

static recto_status fail_short(const struct ply_parser *p,
                               const struct ply_element *element, size_t done) {
  return error_set(p->error, RECTO_ERROR_FORMAT, p->path,
                   p->header.format == PLY_TEXT ? p->line : done + 1,
                   "PLY file cut short: it says %zu of element %s and has %zu",
                   element->count, name_of(element->kind), done);
}

/* Takes element `number`.  *good says whether there is one; what was passed
 * over has been reported. */
static recto_status take_element(struct ply_parser *p,
                                 const struct ply_element *element,
                                 size_t number, bool *good) {
  const char *start = p->at;
  enum ply_result taken = ply_read_element(p, element);
  *good = taken == PLY_READ;
  if (*good)
    return RECTO_OK;
  if (taken == PLY_NO_MEMORY)
    return error_memory(p->error);
  if (taken == PLY_CUT_SHORT)
    return fail_short(p, element, number);
  if (element->kind != PLY_UNKNOWN)
    diagnostics_fault(p->diagnostics, SCENE_FAULT_SYNTAX, p->last,
                      "%s that cannot be parsed, skipped",
                      name_of(element->kind));
  if (element->kind == PLY_FACE &&
      !ARRAY_PUSH(&p->scene->face_skipped, scene_face_count(p->scene)))
    return error_memory(p->error);
  return ply_check_text(p, start);
}

/* How many of the elements the rest of the file can hold: a value in a text
 * takes two bytes, but for the file's last. */
static size_t most_of(const struct ply_parser *p,
                      const struct ply_element *element) {
  size_t left = (size_t)(p->end - p->at);
  size_t most = p->header.format == PLY_TEXT
                    ? (left + 1) / (2 * element->property_count)
                    : left / element->size;
  return element->count < most ? element->count : most;
}

/* ---- Vertices ------------------------------------------------------------ */

/* Whether the vertex that was taken last has a position that can be used. */
static bool add_vertex(struct ply_parser *p, bool ok,
                       struct scene_point *point) {
  const double *value = p->value;
  bool finite = ok && isfinite(value[PLY_X]) && isfinite(value[PLY_Y]) &&
                isfinite(value[PLY_Z]);
  *point = (struct scene_point){0, 0, 0};
  if (finite)
    *point = (struct scene_point){value[PLY_X], value[PLY_Y], value[PLY_Z]};
  else if (ok)
    diagnostics_fault(p->diagnostics, SCENE_FAULT_NOT_FINITE, p->last,
                      "vertex that is not finite; its faces are skipped");
  return finite;
}

static bool has_normal(const struct ply_parser *p,
                       const struct ply_element *element) {
  return p->scene->needs_crease_marks && element->has[PLY_NX] &&
         element->has[PLY_NY] && element->has[PLY_NZ];
}

/* The normal of the vertex that was taken last; 0: none. */
static uint32_t normal_of_vertex(const struct ply_parser *p) {
  return corner_normal_encode(p->value[PLY_NX], p->value[PLY_NY],
                              p->value[PLY_NZ]);
}

static recto_status read_vertex(struct ply_parser *p,
                                const struct ply_element *element,
                                size_t number) {
  bool ok;
  struct scene_point point;
  recto_status status = take_element(p, element, number, &ok);
  if (status != RECTO_OK)
    return status;
  bool colour = p->scene->needs_colours && ply_has_colour(element);
  bool added = add_vertex(p, ok, &point);
  if ((!added &&
       !ARRAY_PUSH(&p->unusable.point, (uint32_t)p->scene->point.count)) ||
      (colour &&
       !ARRAY_PUSH(&p->vertex_colour, ok ? ply_colour_of(p, element) : 0)) ||
      (has_normal(p, element) &&
       !ARRAY_PUSH(&p->scene->point_normal, ok ? normal_of_vertex(p) : 0)) ||
      !ARRAY_PUSH(&p->scene->point, point))
    return error_memory(p->error);
  return RECTO_OK;
}

/* How precise the positions are: whole numbers are exact. */
static struct precision precision_of(const struct ply_parser *p,
                                     const struct ply_element *element) {
  if (p->header.format == PLY_TEXT)
    return precision_estimate(&p->sample);
  struct precision precision = {0, 0};
  for (size_t i = 0; i < element->property_count; i++) {
    const struct ply_property *property =
        &p->header.property.item[element->property + i];
    if (property->role <= PLY_Z && property->type == PLY_FLOAT32)
      precision.relative = PRECISION_SINGLE;
    else if (property->role <= PLY_Z && property->type == PLY_FLOAT64)
      precision.relative = fmax(precision.relative, PRECISION_DOUBLE);
  }
  return precision;
}

static recto_status read_vertices(struct ply_parser *p,
                                  const struct ply_element *element) {
  size_t most = most_of(p, element);
  if (p->header.format != PLY_TEXT && most < element->count)
    return fail_short(p, element, most);
  if (most > SCENE_LIMIT - p->first)
    return error_set(p->error, RECTO_ERROR_LIMIT, p->path, 0,
                     "the scene has more than 2^31 points");
  if (!ARRAY_RESERVE(&p->scene->point, most) ||
      (has_normal(p, element) && !corner_normals_begin_points(p->scene)))
    return error_memory(p->error);
  recto_status status = ply_read_plain_vertices(p, element);
  for (size_t i = p->scene->point.count - p->first;
       i < element->count && status == RECTO_OK; i++) {
    status = diagnostics_poll(p->diagnostics, p->at, p->error);
    if (status == RECTO_OK)
      status = read_vertex(p, element, i);
  }
  p->points = p->scene->point.count - p->first;
  unusable_replace(&p->unusable, p->scene, p->first);
  if (status == RECTO_OK && p->points > 0)
    status = scene_state_precision(p->scene, p->first, precision_of(p, element),
                                   p->error);
  return status;
}

/* ---- Faces --------------------------------------------------------------- */

/* Whether the points of the element that was taken last are there and can be
 * used; warns where not. */
static bool has_usable_corners(struct ply_parser *p, const uint32_t *corner,
                               size_t count, const char *what) {
  if (p->has_missing) {
    diagnostics_fault(p->diagnostics, SCENE_FAULT_INDEX, p->last,
                      "%s with index %lld where there are %zu points, skipped",
                      what, (long long)p->missing, p->points);
    return false;
  }
  if (unusable_has_any(&p->unusable, corner, count)) {
    diagnostics_fault(p->diagnostics, SCENE_FAULT_NOT_FINITE, p->last,
                      "%s with a point that cannot be used, skipped", what);
    return false;
  }
  return true;
}

/* Adds a face of these corners; its colour is that of the element, or the mean
 * of its corners'. */
static recto_status add_ply_face(struct ply_parser *p,
                                 const struct ply_element *element,
                                 const uint32_t *corner, size_t count) {
  uint32_t before = scene_face_count(p->scene);
  recto_status status = scene_add_face(p->scene, corner, count, p->last,
                                       p->diagnostics, p->error);
  if (status != RECTO_OK || !p->scene->needs_colours ||
      scene_face_count(p->scene) == before)
    return status;
  uint32_t colour = PLY_NO_COLOUR;
  if (ply_has_colour(element))
    colour = ply_colour_of(p, element);
  else if (p->vertex_colour.count > 0)
    colour = ply_mean_colour(p, corner, count);
  return ARRAY_PUSH(&p->face_colour, colour) ? RECTO_OK
                                             : error_memory(p->error);
}

static recto_status read_face(struct ply_parser *p,
                              const struct ply_element *element) {
  const uint32_t *corner = p->corner.item;
  if (!has_usable_corners(p, corner, p->corner.count, "face"))
    return scene_skip_face(p->scene, p->error);
  return add_ply_face(p, element, corner, p->corner.count);
}

/* Each corner of a strip makes a triangle with the two before it, which turn
 * the other way each time. */
static recto_status read_strip(struct ply_parser *p,
                               const struct ply_element *element) {
  const uint32_t *corner = p->corner.item;
  recto_status status = RECTO_OK;
  bool missing = p->has_missing;
  p->has_missing = false;
  for (size_t i = 0, start = 0; i < p->corner.count && status == RECTO_OK;
       i++) {
    if (corner[i] == SCENE_NONE)
      start = i + 1;
    if (i < start + 2)
      continue;
    bool odd = (i - start) % 2 != 0;
    uint32_t triangle[3] = {corner[i - 2 + odd], corner[i - 1 - odd],
                            corner[i]};
    /* Strips are joined by triangles without area, which are meant to be. */
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] &&
        triangle[0] != triangle[2] &&
        has_usable_corners(p, triangle, 3, "triangle of a strip"))
      status = add_ply_face(p, element, triangle, 3);
  }
  p->has_missing = missing;
  if (missing && status == RECTO_OK)
    (void)has_usable_corners(p, NULL, 0, "strip");
  return status;
}

static recto_status read_edge(struct ply_parser *p,
                              const struct ply_element *element) {
  if (element->has[PLY_VERTEX1] && element->has[PLY_VERTEX2]) {
    p->corner.count = 0;
    p->has_missing = false;
    for (int k = 0; k < 2; k++)
      if (!ply_push_corner(p, ply_whole(p->value[PLY_VERTEX1 + k]), PLY_EDGE))
        return error_memory(p->error);
  }
  if (!has_usable_corners(p, p->corner.item, p->corner.count, "edge"))
    return RECTO_OK;
  return scene_add_wire(p->scene, p->corner.item, p->corner.count, p->last,
                        p->diagnostics, p->error);
}

/* ---- Elements ------------------------------------------------------------ */

/* Reads the element that was taken last, where it is something to us. */
static recto_status read_other(struct ply_parser *p,
                               const struct ply_element *element) {
  if (element->kind == PLY_FACE)
    return read_face(p, element);
  if (element->kind == PLY_STRIP)
    return read_strip(p, element);
  return element->kind == PLY_EDGE ? read_edge(p, element) : RECTO_OK;
}

static recto_status read_others(struct ply_parser *p,
                                const struct ply_element *element) {
  recto_status status = RECTO_OK;
  for (size_t i = 0; i < element->count && status == RECTO_OK; i++) {
    bool good;
    size_t run = 0;
    status = diagnostics_poll(p->diagnostics, p->at, p->error);
    if (status == RECTO_OK && element->kind == PLY_FACE)
      status = ply_read_plain_faces(p, element, element->count - i, &run);
    i += run;
    if (status != RECTO_OK || i == element->count)
      break;
    status = take_element(p, element, i, &good);
    if (status == RECTO_OK && good)
      status = read_other(p, element);
  }
  return status;
}

/* Passes over elements that are nothing to us, or not yet. */
static recto_status skip_elements(struct ply_parser *p,
                                  const struct ply_element *element) {
  struct ply_element other = *element;
  if (element->property_count == 0)
    return RECTO_OK;
  if (p->header.format != PLY_TEXT && element->is_fixed) {
    size_t most = (size_t)(p->end - p->at) / element->size;
    if (most < element->count)
      return fail_short(p, element, most);
    p->at += element->size * element->count;
    return RECTO_OK;
  }
  other.kind = PLY_UNKNOWN;
  return read_others(p, &other);
}

static recto_status read_ply_items(struct ply_parser *p,
                                   const struct ply_element *element) {
  p->last = 0;
  if (element->property_count == 0)
    return RECTO_OK;
  if (element->kind == PLY_VERTEX)
    return read_vertices(p, element);
  if (element->kind == PLY_UNKNOWN)
    return skip_elements(p, element);
  size_t most = most_of(p, element);
  if (!scene_reserve_faces(p->scene, most, 0))
    return error_memory(p->error);
  return read_others(p, element);
}

/* Reads the elements up to the vertices only where they are faces or the like,
 * which need them: first passed over, then read. */
static recto_status read_elements(struct ply_parser *p) {
  const struct ply_header *header = &p->header;
  size_t vertex = 0;
  while (header->element.item[vertex].kind != PLY_VERTEX)
    vertex++;
  recto_status status = RECTO_OK;
  for (size_t i = 0; i < vertex && status == RECTO_OK; i++)
    status = skip_elements(p, &header->element.item[i]);
  for (size_t i = vertex; i < header->element.count && status == RECTO_OK; i++)
    status = read_ply_items(p, &header->element.item[i]);
  p->at = header->body;
  p->line = header->line;
  for (size_t i = 0; i < vertex && status == RECTO_OK; i++)
    status = read_ply_items(p, &header->element.item[i]);
  return status;
}

static recto_status read_ply(struct scene *scene, const char *bytes,
                             size_t count, const char *path, const char *format,
                             struct diagnostics *diagnostics,
                             recto_error *error) {
  (void)format;
  struct ply_parser p = {.scene = scene,
                         .end = bytes + count,
                         .path = path,
                         .diagnostics = diagnostics,
                         .error = error,
                         .first = scene->point.count};
  size_t first_face = scene_face_count(scene);
  recto_status status = ply_header_read(&p.header, bytes, count, path, error);
  p.at = p.header.body;
  p.line = p.header.line;
  if (status == RECTO_OK)
    status = scene_use_group(scene, NULL, 0, error);
  if (status == RECTO_OK)
    status = read_elements(&p);
  if (status == RECTO_OK && p.face_colour.count > 0)
    status = ply_colour_faces(&p, first_face);
  ply_header_fini(&p.header);
  ARRAY_FREE(&p.unusable.point);
  ARRAY_FREE(&p.corner);
  ARRAY_FREE(&p.vertex_colour);
  ARRAY_FREE(&p.face_colour);
  return status;
}

const struct reader reader_ply = {"ply", "ply", {0, 1, 0}, false, read_ply};
