/* target_mesh.c - meshes in the caller's arrays, right and wrong ones, whole
 * and cut: an argument is refused and nothing was added, or results that are
 * consistent. */
#include <math.h>
#include <stdlib.h>

#include "recto.h"
#include "tests/fuzz/fuzz.h"

enum { POINTS_MAX = 12, FACES_MAX = 12, CORNERS_MAX = 6 };

struct source {
  const uint8_t *at, *end;
};

static unsigned next(struct source *source) {
  return source->at < source->end ? *source->at++ : 0;
}

/* A block of just this size, so that an access past its end is noticed. */
static void *allocate(size_t count, size_t size) {
  void *block = malloc(count > 0 ? count * size : 1);
  if (block == NULL)
    abort();
  return block;
}

/* Most are on a lattice, the others at the limits of what numbers are. */
static double next_coordinate(struct source *source) {
  static const double odd[] = {NAN,    INFINITY, 1e300,     -1e300,
                               1e-300, 5e-324,   1e38,      1e16,
                               0.1,    1 / 3.0,  1.0000001, 1e-7};
  unsigned byte = next(source);
  return byte < 240 ? 0.5 * (byte % 9) - 2
                    : odd[byte % (sizeof odd / sizeof odd[0])];
}

struct arrays {
  double *points;
  float *points_single;
  uint32_t *corners, *offsets, *groups;
};

/* Fills in a mesh.  Where it is wild any index and any number may be wrong,
 * other than what says how long the arrays are. */
static recto_mesh make_mesh(struct source *source, struct arrays *arrays) {
  static const char *const names[] = {"a", "b", "a"};
  unsigned flags = next(source), wild = flags / 64 == 0;
  recto_mesh mesh = {.point_count = next(source) % (POINTS_MAX + 1),
                     .face_count = next(source) % (FACES_MAX + 1),
                     .face_size = 3 + next(source) % (CORNERS_MAX - 2),
                     .group_names = names,
                     .group_count = 3};
  mesh.corner_count = mesh.face_count * mesh.face_size;
  if (wild)
    mesh.corner_count += next(source) % 3;
  if (mesh.point_count == 0 && !wild)
    mesh.corner_count = mesh.face_count = 0;
  arrays->points = allocate(3 * mesh.point_count, sizeof(double));
  arrays->points_single = allocate(3 * mesh.point_count, sizeof(float));
  arrays->corners = allocate(mesh.corner_count, sizeof(uint32_t));
  arrays->offsets = allocate(mesh.face_count, sizeof(uint32_t));
  arrays->groups = allocate(mesh.face_count, sizeof(uint32_t));
  for (size_t i = 0; i < 3 * mesh.point_count; i++) {
    arrays->points[i] = next_coordinate(source);
    arrays->points_single[i] =
        fabs(arrays->points[i]) < 1e38 ? (float)arrays->points[i] : 0;
  }
  for (size_t i = 0; i < mesh.corner_count; i++)
    arrays->corners[i] =
        (uint32_t)(next(source) % (mesh.point_count + (wild ? 1 : 0)));
  for (size_t f = 0; f < mesh.face_count; f++) {
    arrays->offsets[f] = wild && next(source) < 20
                             ? next(source) * 0x01010101U
                             : (uint32_t)f * mesh.face_size;
    arrays->groups[f] = next(source) % (wild ? 4 : 3);
  }
  mesh.corners = arrays->corners;
  if (flags & 1)
    mesh.points_single = arrays->points_single;
  else
    mesh.points = arrays->points;
  mesh.face_offsets = flags & 2 ? arrays->offsets : NULL;
  mesh.face_groups = flags & 4 ? arrays->groups : NULL;
  return mesh;
}

/* None, or a plane through or along a side of the mesh. */
static size_t make_cut(struct source *source, recto_plane *plane) {
  static const double normals[][3] = {{1, 0, 0}, {0, 1, 0},  {0, 0, -1},
                                      {1, 1, 0}, {1, -1, 1}, {-1, 0, 2}};
  unsigned byte = next(source);
  if (byte == 0)
    return 0;
  *plane = (recto_plane){.offset = 0.5 * (next(source) % 9) - 2};
  for (int axis = 0; axis < 3; axis++)
    plane->normal[axis] =
        normals[byte % (sizeof normals / sizeof normals[0])][axis];
  return 1;
}

static void check_edges(const recto_drawing *drawing, size_t points,
                        size_t faces, struct fuzz_finding *finding) {
  recto_edge edge;
  for (size_t i = 0; recto_drawing_edge(drawing, i, &edge); i++) {
    for (int k = 0; k < 2; k++)
      if ((edge.points[k] != RECTO_NONE && edge.points[k] >= points) ||
          (edge.faces[k] != RECTO_NONE && edge.faces[k] >= faces))
        fuzz_found(finding, "edge %zu: a point or a face that is not there", i);
    for (size_t k = 0; k < edge.interval_count; k++) {
      const recto_interval *part = &edge.intervals[k];
      if (!(part->t0 >= 0 && part->t0 < part->t1 && part->t1 <= 1) ||
          (k > 0 && part->t0 != part[-1].t1))
        fuzz_found(finding, "edge %zu: part %zu from %g to %g", i, k, part->t0,
                   part->t1);
    }
  }
}

/* To the step that the coordinates of each are rounded to. */
static bool is_same_place(const recto_half_edge *a, const recto_half_edge *b) {
  const double most_mm = 0x1.001p-28;
  return fabs(a->x_mm - b->x_mm) <= most_mm &&
         fabs(a->y_mm - b->y_mm) <= most_mm;
}

static void check_faces(const recto_drawing *drawing, size_t faces,
                        struct fuzz_finding *finding) {
  size_t loops, sides, fragments = recto_drawing_fragment_count(drawing);
  const recto_loop *loop = recto_drawing_loops(drawing, &loops);
  const recto_half_edge *side = recto_drawing_half_edges(drawing, &sides);
  recto_fragment fragment;
  for (size_t i = 0; recto_drawing_fragment(drawing, i, &fragment); i++)
    if ((fragment.face >= faces && fragment.face != RECTO_NONE) ||
        fragment.loop_count == 0 ||
        fragment.loop + (size_t)fragment.loop_count > loops)
      fuzz_found(finding, "fragment %zu: a face or loops that are not there",
                 i);
  for (size_t i = 0; i < loops; i++)
    for (uint32_t k = 0; k < loop[i].count; k++) {
      size_t h = loop[i].half_edge + (size_t)k;
      size_t end = k + 1 < loop[i].count ? h + 1 : loop[i].half_edge;
      if (h >= sides || side[h].fragment >= fragments) {
        fuzz_found(finding, "loop %zu: a half-edge that is not there", i);
        return;
      }
      const recto_half_edge *twin =
          side[h].twin < sides ? &side[side[h].twin] : NULL;
      if (twin == NULL ? side[h].twin != RECTO_NONE
                       : twin->twin != h || !is_same_place(twin, &side[end]))
        fuzz_found(finding, "half-edge %zu is not its twin's twin", h);
    }
}

static void draw(recto_scene *scene, const recto_options *options,
                 const recto_mesh *mesh, struct fuzz_finding *finding) {
  recto_error error;
  recto_drawing *drawing;
  recto_status status = recto_scene_render(scene, options, &drawing, &error);
  if (status == RECTO_ERROR_LIMIT || status == RECTO_ERROR_ARGUMENT ||
      status == RECTO_ERROR_EMPTY)
    return;
  if (status != RECTO_OK) {
    fuzz_found(finding, "rendering: %s: %s", recto_status_name(status),
               error.text);
    return;
  }
  check_edges(drawing, 2 * mesh->point_count, 2 * mesh->face_count, finding);
  check_faces(drawing, 2 * mesh->face_count, finding);
  recto_drawing_destroy(drawing);
}

/* What was refused has added nothing: a triangle is all that is drawn. */
static void draw_triangle(recto_scene *scene, struct fuzz_finding *finding) {
  static const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  static const uint32_t corners[] = {0, 1, 2};
  const recto_mesh mesh = {.points = points,
                           .point_count = 3,
                           .corners = corners,
                           .corner_count = 3};
  recto_options options;
  recto_drawing *drawing;
  recto_edge edge;
  recto_options_init(&options);
  options.solver.threads = 1;
  options.results = RECTO_RESULT_EDGES;
  if (recto_scene_add_mesh(scene, &mesh, NULL) != RECTO_OK ||
      recto_scene_render(scene, &options, &drawing, NULL) != RECTO_OK)
    abort();
  if (recto_drawing_edge_count(drawing) != 3 ||
      !recto_drawing_edge(drawing, 0, &edge) || edge.points[0] > 2 ||
      edge.faces[0] != 0)
    fuzz_found(finding, "a mesh that was refused left something behind");
  recto_drawing_destroy(drawing);
}

static void run(const uint8_t *bytes, size_t count,
                struct fuzz_finding *finding) {
  struct source source = {bytes, bytes + count};
  struct arrays arrays;
  recto_options options;
  recto_scene *scene;
  recto_error error = {0};
  recto_options_init(&options);
  options.solver.threads = 1;
  options.solver.method = (recto_method)(next(&source) % RECTO_METHOD_COUNT);
  options.solver.resolution = (int)(next(&source) % 40);
  options.results = next(&source) & RECTO_RESULTS_ALL;
  options.ink.edges = 1 + next(&source) % RECTO_EDGES_ALL;
  options.camera.azimuth_deg = 15 * (next(&source) % 24);
  options.camera.elevation_deg = 15 * (int)(next(&source) % 13) - 90;
  options.camera.fov_deg = next(&source) % 4 == 0 ? 60 : 0;
  recto_mesh mesh = make_mesh(&source, &arrays);
  recto_plane plane;
  options.mesh.cut = &plane;
  options.mesh.cut_count = make_cut(&source, &plane);
  if (recto_scene_create(&scene, NULL) != RECTO_OK)
    abort();
  recto_status status = recto_scene_add_mesh(scene, &mesh, &error);
  if (status == RECTO_OK) {
    draw(scene, &options, &mesh, finding);
    if (recto_scene_add_mesh(scene, &mesh, &error) != RECTO_OK)
      fuzz_found(finding, "a mesh is not accepted twice: %s", error.text);
    draw(scene, &options, &mesh, finding);
  } else if (status != RECTO_ERROR_ARGUMENT || error.text[0] == '\0') {
    fuzz_found(finding, "adding: %s: %s", recto_status_name(status),
               error.text);
  } else {
    draw_triangle(scene, finding);
  }
  recto_scene_destroy(scene);
  free(arrays.points);
  free(arrays.points_single);
  free(arrays.corners);
  free(arrays.offsets);
  free(arrays.groups);
}

const struct fuzz_target fuzz_target_mesh = {"mesh", run, NULL};
