/* zero_set.c - finds where the facing of a smooth surface changes sign. */
#include "visibility/zero_set/zero_set.h"

#include <string.h>

#include "base/parallel.h"
#include "base/poll.h"
#include "scene/triangulation/triangulate.h"
#include "view/clip.h"
#include "visibility/zero_set/zero_finder.h"

void zero_set_fini(struct zero_set *set) {
  ARRAY_FREE(&set->node);
  ARRAY_FREE(&set->segment);
  ARRAY_FREE(&set->border);
  ARRAY_FREE(&set->outline);
}

/* ---- Nodes and segments -------------------------------------------------- */

bool zero_finder_add_node(struct zero_finder *z, const double at[3],
                          const double flat[3], uint32_t front, uint32_t back,
                          uint32_t *node) {
  struct contour_node made = {.at = {at[0], at[1], at[2]},
                              .flat = {flat[0], flat[1], flat[2]},
                              .front = front,
                              .back = back,
                              .segment = {SHEET_NONE, SHEET_NONE},
                              .sheet_point = SHEET_NONE};
  *node = (uint32_t)z->set->node.count;
  return ARRAY_PUSH(&z->set->node, made);
}

/* Clips a segment.  Where the mesh is within the page's margins, a contour that
 * is curved beyond them is not clipped: its images are moved to the border, so
 * that its curve goes on.
 * Returns false where nothing is left. */
static bool clip_contour(const struct zero_finder *z, struct view_point end[2],
                         bool moved[2]) {
  unsigned outside = 0;
  for (int k = 0; k < 2; k++)
    outside |= clip_outcode(&z->projection, end[k]);
  if (z->mesh_is_inside)
    outside &= CLIP_NEAR_BIT;
  return outside == 0 || clip_segment(&z->projection, end, moved);
}

bool zero_finder_add_segment(struct zero_finder *z, struct contour_segment s) {
  double at[2][3];
  struct view_point end[2];
  bool moved[2] = {false, false};
  for (int k = 0; k < 2; k++) {
    memcpy(at[k], z->set->node.item[s.node[k]].at, sizeof at[k]);
    end[k] = zero_finder_view(z, at[k]);
  }
  if (!clip_contour(z, end, moved))
    return true;
  for (int k = 0; k < 2; k++)
    if (moved[k]) {
      const struct camera *camera = z->facing->camera;
      for (int i = 0; i < 3; i++)
        at[k][i] = camera->eye[i] + end[k].x * camera->right[i] +
                   end[k].y * camera->up[i] - end[k].d * camera->back[i];
      if (!zero_finder_add_node(z, at[k], at[k], SHEET_NONE, SHEET_NONE,
                                &s.node[k]))
        return false;
    }
  for (int k = 0; k < 2; k++) {
    struct contour_node *node = &z->set->node.item[s.node[k]];
    if (node->degree < 2)
      node->segment[node->degree] = (uint32_t)z->set->segment.count;
    if (node->degree++ == 0)
      node->page = project_point(&z->projection, end[k]);
  }
  return ARRAY_PUSH(&z->set->segment, s);
}

/* ---- Faces --------------------------------------------------------------- */

static bool cross_polygon(struct zero_finder *z, uint32_t face, uint32_t start,
                          uint32_t count) {
  struct triangulation *triangulation = &z->triangulation;
  z->corner.count = z->diagonal_node.count = 0;
  if (!ARRAY_RESERVE(&z->corner, count) ||
      !ARRAY_RESERVE(&z->diagonal_node, count))
    return false;
  for (uint32_t c = 0; c < count; c++) {
    z->corner.item[c] = facing_point(z->facing, start + c);
    z->diagonal_node.item[c][0] = z->diagonal_node.item[c][1] = 0;
  }
  if (!triangulate(triangulation, z->facing->scene->point.item, z->corner.item,
                   count))
    return false;
  for (size_t t = 0; t < triangulation->triangle.count; t++) {
    const struct triangulation_triangle *of = &triangulation->triangle.item[t];
    const uint32_t corner[3] = {start + of->corner[0], start + of->corner[1],
                                start + of->corner[2]};
    if (!zero_finder_cross_triangle(z, face, corner, of->side))
      return false;
  }
  return true;
}

/* Finds the segments across a face that is crossed. */
static bool cross_face(struct zero_finder *z, uint32_t face) {
  const struct facing *f = z->facing;
  uint32_t start = scene_face_start(f->scene, face);
  uint32_t count = scene_face_start(f->scene, face + 1) - start;
  if (count > 3)
    return cross_polygon(z, face, start, count);
  const uint32_t corner[3] = {start, start + 1, start + 2};
  const uint32_t side[3] = {0, 1, 2};
  uint32_t p = facing_point(f, start), q = facing_point(f, start + 1),
           r = facing_point(f, start + 2);
  return p == q || q == r || r == p ||
         zero_finder_cross_triangle(z, face, corner, side);
}

/* ---- The whole ----------------------------------------------------------- */

/* Whether an edge is neither a feature nor one at which faces fold over. */
static inline bool is_within_surface(const struct zero_finder *z, uint32_t e) {
  const struct facing *f = z->facing;
  const struct topology_edge *edge = &f->topology->edge.item[e];
  return (f->class_masks[e] & (RECTO_EDGE_CREASE | RECTO_EDGE_BORDER)) == 0 &&
         edge->uses == 2 && !edge->same_way &&
         f->face_sign[edge->first] == f->face_sign[edge->second] &&
         edge->first != edge->second &&
         (z->folded.is_folded == NULL ||
          !(z->folded.is_folded[edge->first] ||
            z->folded.is_folded[edge->second])) &&
         !(f->any_coarse && f->coarse[edge->point[0]]);
}

static bool cross_edge(void *user, uint32_t e) {
  struct zero_finder *z = user;
  const struct facing *f = z->facing;
  const struct topology_edge *edge = &f->topology->edge.item[e];
  if (is_within_surface(z, e))
    return true;
  if (!zero_finder_add_outline(z, e) || !zero_finder_add_border(z, e))
    return false;
  return edge->uses != 2 || edge->first == edge->second ||
         f->coarse[edge->point[0]] ||
         !(edge->same_way || facing_is_near(f, e)) || !facing_is_split(f, e) ||
         zero_finder_cross_crease(z, e);
}

/* Makes room for the nodes of edges, and for about as many segments as there
 * may be. */
static bool reserve_nodes(struct zero_finder *z) {
  const struct facing *f = z->facing;
  if (!ranked_set_init(&z->near_edge, f->topology->edge.count))
    return false;
  for (size_t i = 0; i < f->near_edge.count; i++)
    ranked_set_add(&z->near_edge, f->near_edge.item[i]);
  ranked_set_index(&z->near_edge);
  z->edge_node = mem_calloc(z->near_edge.count, sizeof *z->edge_node);
  return z->edge_node != NULL &&
         ARRAY_RESERVE(&z->set->node, 3 * f->mixed.count) &&
         ARRAY_RESERVE(&z->set->segment, 3 * f->mixed.count);
}

/* Adds the edges of folded faces to the odd ones, which are looked at. */
static void add_folded_edges(const struct zero_finder *z) {
  const struct facing *f = z->facing;
  uint32_t faces = z->folded.is_folded != NULL ? scene_face_count(f->scene) : 0;
  for (uint32_t face = 0; face < faces; face++)
    for (uint32_t c = scene_face_start(f->scene, face);
         z->folded.is_folded[face] && c < scene_face_start(f->scene, face + 1);
         c++)
      facing_add_odd_edge(f, f->topology->corner_edge[c]);
}

static bool cross_faces(struct zero_finder *z) {
  const struct facing *f = z->facing;
  add_folded_edges(z);
  for (size_t i = 0; i < f->mixed.count; i++)
    if (!poll_at(i) || !cross_face(z, f->mixed.item[i]))
      return false;
  return true;
}

static void free_finder(struct zero_finder *z) {
  curvature_noise_fini(&z->curvature);
  ranked_set_fini(&z->near_edge);
  mem_free(z->edge_node);
  mem_free(z->point_node);
  ARRAY_FREE(&z->diagonal_node);
  ARRAY_FREE(&z->corner);
  triangulation_fini(&z->triangulation);
}

recto_status zero_set_find(struct zero_set *set, const struct sheet *sheet,
                           const struct folded_faces *folded,
                           const struct facing *facing, recto_error *error) {
  struct zero_finder z = {.set = set,
                          .facing = facing,
                          .folded = *folded,
                          .projection = projection_of(facing->camera),
                          .mesh_is_inside = sheet->clipped_page == 0};
  bool ok = curvature_noise_find(&z.curvature, facing) && reserve_nodes(&z) &&
            cross_faces(&z) && facing_each_odd_edge(facing, cross_edge, &z);
  free_finder(&z);
  return ok ? RECTO_OK : error_memory(error);
}

/* ---- The extent ---------------------------------------------------------- */

/* The box of a face in the camera's axes: x, y, d. */
struct face_box {
  double low[3], high[3];
};

static struct view_point view_of_corner(const struct zero_finder *z,
                                        uint32_t corner) {
  double at[3];
  facing_position(z->facing, facing_point(z->facing, corner), at);
  return zero_finder_view(z, at);
}

/* The box of a face; its corners, which are on the mesh, are included in an
 * extent. */
static struct face_box face_view_box(const struct zero_finder *z, uint32_t face,
                                     struct extent *extent) {
  const struct facing *f = z->facing;
  struct face_box box = {{INFINITY, INFINITY, INFINITY},
                         {-INFINITY, -INFINITY, -INFINITY}};
  for (uint32_t c = scene_face_start(f->scene, face);
       c < scene_face_start(f->scene, face + 1); c++) {
    struct view_point v = view_of_corner(z, c);
    const double of[3] = {v.x, v.y, v.d};
    if (v.d >= f->camera->near_d)
      extent_grow(extent, f->camera, v);
    for (int k = 0; k < 3; k++) {
      box.low[k] = of[k] < box.low[k] ? of[k] : box.low[k];
      box.high[k] = of[k] > box.high[k] ? of[k] : box.high[k];
    }
  }
  return box;
}

/* Enlarges a face's box to that of its curved triangles: their Bezier points
 * are no farther from the flat ones than half the longest side, as those beside
 * corners are within a third of it of the corner, and the one in the middle is
 * a quarter of six such steps from the mean of the corners. */
static void enlarge_box(struct face_box *box) {
  double square = 0;
  for (int k = 0; k < 3; k++)
    square += (box->high[k] - box->low[k]) * (box->high[k] - box->low[k]);
  double most = sqrt(square) / 2;
  for (int k = 0; k < 3; k++) {
    box->low[k] -= most;
    box->high[k] += most;
  }
}

/* The extent of a box that is in front of the near plane. */
static struct extent extent_of_box(const struct camera *camera,
                                   const struct face_box *box) {
  struct extent extent = extent_empty();
  for (int k = 0; k < 4; k++) {
    const double *xy = k & 1 ? box->high : box->low;
    double d = k & 2 ? box->high[2] : box->low[2];
    extent_grow(&extent, camera, (struct view_point){xy[0], xy[1], d});
  }
  return extent;
}

static bool lies_within(const struct extent *extent, const struct extent *of) {
  for (int k = 0; k < 2; k++)
    if (!(of->low[k] >= extent->low[k] && of->high[k] <= extent->high[k]))
      return false;
  return true;
}

/* The boxes of the faces that are crossed. */
struct face_boxes {
  const struct zero_finder *finder;
  struct face_box *box;
  struct extent *extent; /* one a range: of corners */
};

enum { BOXES_IN_RANGE = PARALLEL_RANGE(256) };

static bool find_boxes_of_range(void *user, struct parallel_range range) {
  const struct face_boxes *boxes = user;
  const uint32_t *face = boxes->finder->facing->mixed.item;
  struct extent extent = extent_empty();
  for (size_t i = range.begin; i < range.end; i++)
    boxes->box[i] = face_view_box(boxes->finder, face[i], &extent);
  boxes->extent[range.begin / BOXES_IN_RANGE] = extent;
  return true;
}

/* Finds the boxes, and includes the corners of the faces. */
static bool find_boxes(const struct face_boxes *boxes, size_t n,
                       struct extent *extent) {
  bool ok =
      boxes->box != NULL && boxes->extent != NULL &&
      parallel_ranges(parallel_workers(n, BOXES_IN_RANGE), n, BOXES_IN_RANGE,
                      find_boxes_of_range, (void *)(uintptr_t)boxes);
  for (size_t r = 0; ok && r < parallel_range_count(n, BOXES_IN_RANGE); r++)
    extent_include(extent, &boxes->extent[r]);
  return ok;
}

/* Crosses those faces whose contours may not lie within the extent.
 * all  their boxes */
static bool cross_faces_beyond(struct zero_finder *z, struct face_box *all,
                               const struct extent *extent) {
  const struct facing *f = z->facing;
  for (size_t i = 0; i < f->mixed.count; i++) {
    if (!poll_at(i))
      return false;
    enlarge_box(&all[i]);
    struct extent most = extent_of_box(f->camera, &all[i]);
    if (!(all[i].low[2] >= f->camera->near_d && lies_within(extent, &most)) &&
        !cross_face(z, f->mixed.item[i]))
      return false;
  }
  return true;
}

recto_status zero_set_grow_extent(struct extent *extent,
                                  const struct facing *facing,
                                  recto_error *error) {
  struct zero_set set = {.node = {0}};
  struct zero_finder z = {.set = &set,
                          .facing = facing,
                          .projection = projection_of(facing->camera),
                          .mesh_is_inside = true};
  size_t n = facing->mixed.count;
  const struct face_boxes boxes = {
      &z, mem_alloc(n, sizeof *boxes.box),
      mem_alloc(parallel_range_count(n, BOXES_IN_RANGE), sizeof *boxes.extent)};
  bool ok = find_boxes(&boxes, n, extent) && reserve_nodes(&z) &&
            cross_faces_beyond(&z, boxes.box, extent);
  mem_free(boxes.box);
  mem_free(boxes.extent);
  for (size_t i = 0; ok && i < set.node.count; i++) {
    const struct contour_node *node = &set.node.item[i];
    if (node->degree > 0) /* it is not in front of the near plane */
      extent_grow(extent, facing->camera, zero_finder_view(&z, node->at));
  }
  free_finder(&z);
  zero_set_fini(&set);
  return ok ? RECTO_OK : error_memory(error);
}
