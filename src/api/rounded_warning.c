/* rounded_warning.c - warns of parts whose edges are rounded, of which lines
 * show little. */
#include "api/rounded_warning.h"

#include <math.h>

#include "base/parallel.h"
#include "base/poll.h"
#include "geom/vector.h"
#include "ink/planar_regions.h"
#include "scene/edges/crease_marks.h"
#include "scene/edges/edge_classes.h"
#include "scene/newell_normal.h"
#include "scene/topology/topology.h"

/* So many times larger than the mean is a large face; facets of a curved
 * surface are about as large as each other. */
#define LARGE_FACE 4.0

/* Flats with rounded edges that are such a share of all faces are what the part
 * is made of. */
#define LARGE_SHARE 0.25

/* Whether outlines are longer than all other visible lines. */
static bool is_mostly_outlines(const struct drawing *drawing) {
  double outlines = 0, others = 0;
  for (size_t i = 0; i < drawing->stroke.count && poll_at(i); i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    if (!stroke->hidden)
      *(stroke->edge_class == RECTO_EDGE_SILHOUETTE ? &outlines : &others) +=
          drawing_stroke_mm(drawing, stroke);
  }
  return outlines > others;
}

struct rounded {
  const struct scene *scene;
  struct topology topology;
  struct planar_regions planar;
  double (*normal)[3]; /* of each face */
  uint8_t *class_mask; /* of each edge */
  bool *is_smooth;     /* of each region, at its root: it meets another at a
                          smooth edge */
};

static bool set_normals(struct rounded *r) {
  uint32_t faces = scene_face_count(r->scene);
  r->normal = mem_alloc(faces, sizeof *r->normal);
  for (uint32_t f = 0; r->normal != NULL && f < faces && poll_at(f); f++)
    newell_normal_of_face(r->scene, f, r->normal[f]);
  return r->normal != NULL;
}

/* Twice the area of a face, fast; 0 or infinite where squares of coordinates
 * are beyond the range of doubles. */
static double twice_area(const struct scene *scene, uint32_t face) {
  const uint32_t start[2] = {scene_face_start(scene, face),
                             scene_face_start(scene, face + 1)};
  const uint32_t *corner = scene->corner.item;
  const struct scene_point *point = scene->point.item;
  const struct scene_point *p = &point[corner[start[0]]];
  double sum[3] = {0, 0, 0}, cross[3];
  for (uint32_t c = start[0] + 1; c + 1 < start[1]; c++) {
    const struct scene_point *q = &point[corner[c]], *r = &point[corner[c + 1]];
    const double to_q[] = {q->x - p->x, q->y - p->y, q->z - p->z};
    const double to_r[] = {r->x - p->x, r->y - p->y, r->z - p->z};
    vector_cross(to_q, to_r, cross);
    for (int k = 0; k < 3; k++)
      sum[k] += cross[k];
  }
  return sqrt(vector_dot(sum, sum));
}

/* The areas of all faces, and their sums by range of faces. */
struct face_areas {
  const struct scene *scene;
  double *area, *sum;
};

static bool measure_faces(void *user, struct parallel_range range) {
  struct face_areas *of = user;
  double sum = 0;
  for (size_t f = range.begin; f < range.end; f++)
    sum += of->area[f] = twice_area(of->scene, (uint32_t)f);
  of->sum[range.begin / PARALLEL_ITEMS] = sum;
  return true;
}

/* Whether large faces are a large share of all. */
static bool has_large_faces(const struct face_areas *of) {
  uint32_t faces = scene_face_count(of->scene);
  size_t ranges = parallel_range_count(faces, PARALLEL_ITEMS);
  double all = 0, large = 0;
  for (size_t i = 0; i < ranges; i++)
    all += of->sum[i];
  double limit = LARGE_FACE * all / faces;
  for (uint32_t f = 0; f < faces && poll_at(f); f++)
    large += of->area[f] > limit ? of->area[f] : 0;
  return large > LARGE_SHARE * all;
}

/* Sets *found: whether there are such.  False when memory ran out or the caller
 * cancelled. */
static bool find_large_faces(const struct scene *scene, bool *found) {
  uint32_t faces = scene_face_count(scene);
  struct face_areas of = {
      .scene = scene,
      .area = mem_alloc(faces, sizeof *of.area),
      .sum = mem_alloc(parallel_range_count(faces, PARALLEL_ITEMS),
                       sizeof *of.sum)};
  bool ok = of.area != NULL && of.sum != NULL &&
            parallel_ranges(parallel_workers(faces, PARALLEL_ITEMS), faces,
                            PARALLEL_ITEMS, measure_faces, &of);
  *found = ok && has_large_faces(&of);
  mem_free(of.area);
  mem_free(of.sum);
  return ok;
}

/* The faces at edge e if it is smooth. */
static bool faces_at(const struct rounded *r, size_t e, uint32_t face[2]) {
  const struct topology_edge *edge = &r->topology.edge.item[e];
  face[0] = edge->first;
  face[1] = edge->second;
  return edge->uses == 2 && !edge->same_way && face[0] != face[1] &&
         (r->class_mask[e] & RECTO_EDGE_CREASE) == 0;
}

/* Finds the flats, and which of them meet others at smooth edges. */
static void find_flats(struct rounded *r) {
  uint32_t face[2];
  size_t edges = r->topology.edge.count;
  for (size_t e = 0; e < edges && poll_at(e); e++)
    if (faces_at(r, e, face))
      planar_regions_join(&r->planar, face[0], r->normal[face[0]], face[1],
                          r->normal[face[1]]);
  for (uint32_t f = 0; f < scene_face_count(r->scene) && poll_at(f); f++)
    planar_regions_measure(&r->planar, r->scene, f, r->normal[f]);
  for (size_t e = 0; e < edges && poll_at(e); e++)
    if (faces_at(r, e, face) &&
        planar_regions_compare(&r->planar, face[0], face[1]))
      for (int k = 0; k < 2; k++)
        r->is_smooth[planar_regions_root(&r->planar, face[k])] = true;
}

/* Whether flats that smooth edges surround are a large share of all faces. */
static bool has_rounded_flats(const struct rounded *r) {
  double flat = 0, all = 0;
  for (uint32_t f = 0; f < scene_face_count(r->scene) && poll_at(f); f++) {
    double area = vector_length(r->normal[f]);
    all += area;
    if (planar_regions_flat(&r->planar, f, 0) != NULL &&
        r->is_smooth[planar_regions_root(&r->planar, f)])
      flat += area;
  }
  return flat > LARGE_SHARE * all;
}

/* Prepares what find_flats needs; false when memory ran out. */
static bool prepare_flats(struct rounded *r, recto_crease_marks marks,
                          double crease_deg) {
  if (topology_init(&r->topology, r->scene, NULL) != RECTO_OK ||
      !planar_regions_init(&r->planar, r->scene))
    return false;
  r->class_mask = mem_alloc(r->topology.edge.count, 1);
  r->is_smooth = mem_calloc(scene_face_count(r->scene), sizeof *r->is_smooth);
  return r->class_mask != NULL && r->is_smooth != NULL &&
         crease_marks_find(&r->topology, r->scene, marks, crease_deg) &&
         topology_class_masks(&r->topology, r->scene, crease_deg,
                              r->class_mask);
}

/* Sets *found; false when memory ran out. */
static bool find_rounded_flats(const struct scene *scene,
                               const recto_mesh_options *options, bool *found) {
  struct rounded r = {.scene = scene};
  bool ok = find_large_faces(scene, found);
  if (ok && *found) {
    ok = set_normals(&r) &&
         prepare_flats(&r, options->crease_marks, options->crease_deg);
    if (ok)
      find_flats(&r);
    *found = ok && has_rounded_flats(&r);
  }
  topology_fini(&r.topology);
  planar_regions_fini(&r.planar);
  mem_free(r.normal);
  mem_free(r.class_mask);
  mem_free(r.is_smooth);
  return ok;
}

bool rounded_warn(const struct drawing *drawing, const struct scene *scene,
                  const struct face_sizes *sizes,
                  const recto_options *options) {
  const unsigned shown = RECTO_EDGE_CREASE | RECTO_EDGE_SILHOUETTE;
  bool found = false;
  if (options->warning == NULL || options->ink.fill != RECTO_FILL_NONE ||
      (options->ink.edges & shown) != shown ||
      (options->ink.edges & RECTO_EDGE_SMOOTH) != 0 || scene->cut != NULL ||
      !is_mostly_outlines(drawing) ||
      face_sizes_are_even(sizes, scene_face_count(scene), LARGE_FACE,
                          LARGE_SHARE))
    return true;
  if (!find_rounded_flats(scene, &options->mesh, &found))
    return false;
  if (found)
    options->warning(
        options->user, "", 0,
        "flat faces go over into rounded edges, where no line is drawn: "
        "--fill shade, or --fill hatch with --light, shows the form");
  return true;
}
