/* test_result_models.c - what drawings of whole models give as data holds
 * together, and agrees with a count of all faces in front.
 *
 * The models are those of examples/models and, where they are there, those of
 * RECTO_MODELS.  The count takes each face of the file as a plane polygon and
 * each point that is too close to a border to be sure of as undecided. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "recto.h"

/* A model as points and faces, and where they are on the page. */
struct model {
  double (*point)[3], (*page)[2], *depth;
  uint32_t *corner, *start; /* of face f: corner[start[f]] to [start[f + 1]] */
  double contact;           /* the largest tolerance of contact, scene units */
  double scale;             /* about so many mm for a scene unit */
  double eye; /* distance from the middle, scene units; 0: no perspective */
  size_t points, faces, corners;
  recto_scene *scene;
  recto_drawing *drawing;
};

static const char *const names[] = {"castle",  "gears",   "knot",
                                    "cow",     "fandisk", "spot",
                                    "suzanne", "teapot",  "stanford-bunny"};

/* ---- Models -------------------------------------------------------------- */

static FILE *open_model(const char *name, char path[1024]) {
  const char *source = getenv("srcdir"), *more = getenv("RECTO_MODELS");
  snprintf(path, 1024, "%s/examples/models/%s.obj", source ? source : ".",
           name);
  FILE *file = fopen(path, "r");
  if (file == NULL && more != NULL) {
    snprintf(path, 1024, "%s/%s.obj", more, name);
    file = fopen(path, "r");
  }
  return file;
}

static void read_face(struct model *m, const char *text) {
  for (char *end; (text = strchr(text, ' ')) != NULL; text = end) {
    long index = strtol(text, &end, 10);
    if (end == text)
      break;
    m->corner[m->corners++] =
        (uint32_t)(index > 0 ? index - 1 : (long)m->points + index);
  }
  m->start[++m->faces] = (uint32_t)m->corners;
}

static void read_geometry(struct model *m, FILE *file) {
  enum { MOST = 300000 };
  static char line[65536];
  m->point = malloc(MOST * sizeof *m->point);
  m->page = malloc(MOST * sizeof *m->page);
  m->depth = malloc(MOST * sizeof *m->depth);
  m->corner = malloc((size_t)MOST * 2 * sizeof *m->corner);
  m->start = calloc(MOST, sizeof *m->start);
  while (fgets(line, sizeof line, file) != NULL) {
    assert_true(m->points < MOST && m->faces + 1 < MOST);
    if (line[0] == 'v' && line[1] == ' ') {
      double *p = m->point[m->points++];
      assert_int_equal(sscanf(line + 2, "%lf %lf %lf", p, p + 1, p + 2), 3);
    } else if (line[0] == 'f') {
      read_face(m, line);
    }
  }
}

/* Sets an eye in no special direction from the middle of the scene. */
static void set_eye(struct model *m, recto_options *options) {
  const double away[3] = {0.53, 0.39, 0.76};
  double low[3], high[3];
  for (int k = 0; k < 3; k++) {
    low[k] = high[k] = m->point[0][k];
    for (size_t p = 0; p < m->points; p++) {
      low[k] = fmin(low[k], m->point[p][k]);
      high[k] = fmax(high[k], m->point[p][k]);
    }
    m->eye += 2 * (high[k] - low[k]);
  }
  options->camera.kind = RECTO_CAMERA_EYE;
  options->camera.has_target = true;
  options->camera.fov_deg = 30;
  for (int k = 0; k < 3; k++) {
    options->camera.target[k] = (low[k] + high[k]) / 2;
    options->camera.eye[k] = options->camera.target[k] + away[k] * m->eye;
  }
}

/* Where a point lies on the page, and a number that grows with its depth and is
 * linear on planes of the page: with perspective a reciprocal, which changes as
 * the depth does in the middle. */
static void project(const struct model *m, const double point[3],
                    double page[2], double *depth) {
  assert_true(recto_drawing_project(m->drawing, point, page, depth));
  if (m->eye > 0)
    *depth = -m->eye * m->eye / *depth;
}

/* Draws a model from no special direction, all lines at their full length. */
static bool draw_model(struct model *m, const char *name, bool perspective) {
  char path[1024];
  FILE *file = open_model(name, path);
  recto_options options;
  recto_error error = {0};
  *m = (struct model){0};
  if (file == NULL)
    return false;
  read_geometry(m, file);
  fclose(file);
  recto_options_init(&options);
  options.camera.azimuth_deg = 31.7;
  options.camera.elevation_deg = 23.3;
  if (perspective)
    set_eye(m, &options);
  options.results = RECTO_RESULTS_ALL;
  options.ink.min_stroke_mm = 0;
  options.ink.ids = true;
  assert_int_equal(recto_scene_create(&m->scene, &error), RECTO_OK);
  if (recto_scene_read(m->scene, path, NULL, &options, &error) != RECTO_OK ||
      recto_scene_render(m->scene, &options, &m->drawing, &error) != RECTO_OK)
    fail_msg("%s: %s", name, error.text);
  const char *contact = strstr(recto_drawing_stats(m->drawing), "contact_max");
  assert_non_null(contact);
  m->contact = strtod(strchr(contact, ':') + 1, NULL);
  for (size_t p = 0; p < m->points; p++)
    project(m, m->point[p], m->page[p], &m->depth[p]);
  for (size_t p = 1; p < m->points; p++) {
    const double *a = m->point[p - 1], *b = m->point[p];
    double mm = hypot(m->page[p][0] - m->page[p - 1][0],
                      m->page[p][1] - m->page[p - 1][1]);
    double length = hypot(hypot(b[0] - a[0], b[1] - a[1]), b[2] - a[2]);
    m->scale = fmax(m->scale, length > 0 ? mm / length : 0);
  }
  return true;
}

static void free_model(struct model *m) {
  recto_drawing_destroy(m->drawing);
  recto_scene_destroy(m->scene);
  free(m->point);
  free(m->page);
  free(m->depth);
  free(m->corner);
  free(m->start);
}

static void with_all_models(void (*check)(const struct model *model)) {
  for (size_t i = 0; i < 2 * sizeof names / sizeof names[0]; i++) {
    struct model model;
    bool perspective = i % 2;
    if (!draw_model(&model, names[i / 2], perspective))
      continue;
    print_message("%s%s\n", names[i / 2], perspective ? ", from an eye" : "");
    check(&model);
    free_model(&model);
  }
}

/* ---- Edges --------------------------------------------------------------- */

static double length_of_stroke(const recto_stroke *s) {
  double sum = 0;
  for (size_t k = 1; k < s->count + s->closed; k++) {
    const double *p = s->points + 2 * (k - 1),
                 *q = s->points + 2 * (k % s->count);
    sum += hypot(q[0] - p[0], q[1] - p[1]);
  }
  return sum;
}

/* Where lines coincide on the page they are drawn once; from no special
 * direction few do. */
static void check_ink(const struct model *m) {
  double visible = 0, drawn = 0;
  recto_edge edge;
  recto_stroke stroke;
  for (size_t i = 0; recto_drawing_edge(m->drawing, i, &edge); i++)
    for (size_t k = 0; k < edge.interval_count; k++) {
      const recto_interval *part = &edge.intervals[k];
      assert_true(part->t0 < part->t1);
      assert_true(part->t0 == (k > 0 ? part[-1].t1 : part->t0));
      if (part->hidden_by == 0)
        visible += hypot(part->to_mm[0] - part->from_mm[0],
                         part->to_mm[1] - part->from_mm[1]);
    }
  for (size_t i = 0; recto_drawing_stroke(m->drawing, i, &stroke); i++)
    drawn += length_of_stroke(&stroke);
  assert_true(visible > 1000);
  assert_true(fabs(visible - drawn) < 1e-6 * visible);
}

static void the_visible_parts_of_edges_are_the_ink(void **state) {
  (void)state;
  with_all_models(check_ink);
}

/* ---- Quantitative invisibility ------------------------------------------- */

/* Twice the area of a, b, p on the page. */
static double turn(const double a[2], const double b[2], const double p[2]) {
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

/* A plane on the page and in depth: depth = offset + slope . at */
struct plane {
  double slope[2], offset;
};

/* The face's plane; false where it is steep, or not plane. */
static bool find_plane(const struct model *m, size_t face,
                       struct plane *plane) {
  double n[3] = {0, 0, 0}, middle[3] = {0, 0, 0};
  uint32_t from = m->start[face], to = m->start[face + 1];
  for (uint32_t c = from; c < to; c++) {
    uint32_t p = m->corner[c], q = m->corner[c + 1 < to ? c + 1 : from];
    const double a[3] = {m->page[p][0], m->page[p][1], m->depth[p]};
    const double b[3] = {m->page[q][0], m->page[q][1], m->depth[q]};
    for (int k = 0; k < 3; k++) {
      int u = (k + 1) % 3, v = (k + 2) % 3;
      n[k] += (a[u] - b[u]) * (a[v] + b[v]);
      middle[k] += a[k] / (to - from);
    }
  }
  if (fabs(n[2]) < 1e-3 * (fabs(n[0]) + fabs(n[1])))
    return false;
  plane->slope[0] = -n[0] / n[2];
  plane->slope[1] = -n[1] / n[2];
  plane->offset =
      middle[2] - plane->slope[0] * middle[0] - plane->slope[1] * middle[1];
  for (uint32_t c = from; c < to; c++) {
    uint32_t p = m->corner[c];
    if (fabs(plane->offset + plane->slope[0] * m->page[p][0] +
             plane->slope[1] * m->page[p][1] - m->depth[p]) > m->contact)
      return false;
  }
  return true;
}

static size_t count_planes(const struct model *m) {
  size_t count = 0;
  struct plane plane;
  for (size_t f = 0; f < m->faces; f++)
    count += find_plane(m, f, &plane);
  return count;
}

/* Whether a point is in the box of the face. */
static bool is_in_box(const struct model *m, size_t face, const double at[2]) {
  double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
  for (uint32_t c = m->start[face]; c < m->start[face + 1]; c++)
    for (int k = 0; k < 2; k++) {
      low[k] = fmin(low[k], m->page[m->corner[c]][k] - 1e-4);
      high[k] = fmax(high[k], m->page[m->corner[c]][k] + 1e-4);
    }
  return low[0] <= at[0] && at[0] <= high[0] && low[1] <= at[1] &&
         at[1] <= high[1];
}

/* 1: the face is over the point; 0: it is not; -1: a side is too near. */
static int covers(const struct model *m, size_t face, const double at[2]) {
  bool inside = false;
  uint32_t from = m->start[face], to = m->start[face + 1];
  for (uint32_t c = from; c < to; c++) {
    const double *p = m->page[m->corner[c]],
                 *q = m->page[m->corner[c + 1 < to ? c + 1 : from]];
    double length = hypot(q[0] - p[0], q[1] - p[1]);
    double along =
        ((at[0] - p[0]) * (q[0] - p[0]) + (at[1] - p[1]) * (q[1] - p[1])) /
        length;
    if (length > 0 && fabs(turn(p, q, at)) < 1e-4 * length && along > -1e-4 &&
        along < length + 1e-4)
      return -1;
    if ((p[1] > at[1]) != (q[1] > at[1]) &&
        at[0] < p[0] + (q[0] - p[0]) * (at[1] - p[1]) / (q[1] - p[1]))
      inside = !inside;
  }
  return inside;
}

/* How many faces are in front of a point of an edge; -1: undecided. */
static int count_in_front(const struct model *m, const recto_edge *edge,
                          const double at[2], double depth) {
  int count = 0;
  for (size_t f = 0; f < m->faces; f++) {
    struct plane plane = {{0, 0}, 0};
    if (!is_in_box(m, f, at))
      continue;
    int over = covers(m, f, at);
    bool is_own = f == edge->faces[0] || f == edge->faces[1];
    bool is_plane = find_plane(m, f, &plane);
    if (!is_plane && (is_own || m->start[f + 1] - m->start[f] > 3))
      return -1; /* it may fold over the edge */
    if (over == 0 || is_own)
      continue;
    /* Contact is measured at right angles to the face. */
    double own = plane.offset + plane.slope[0] * at[0] + plane.slope[1] * at[1];
    double steep = hypot(plane.slope[0], plane.slope[1]) * m->scale;
    if (over < 0 || !is_plane ||
        fabs(own - depth) < 4 * m->contact * (1 + steep))
      return -1;
    count += own < depth;
  }
  return count;
}

static void point_along(const struct model *m, const recto_edge *edge, double t,
                        double at[3]) {
  const double *a = m->point[edge->points[0]], *b = m->point[edge->points[1]];
  for (int k = 0; k < 3; k++)
    at[k] = a[k] + t * (b[k] - a[k]);
}

/* The point at t of an edge is there on the page. */
static void check_place(const struct model *m, const recto_edge *edge, double t,
                        const double place[2]) {
  double at[3], page[2], depth;
  point_along(m, edge, t, at);
  project(m, at, page, &depth);
  assert_true(hypot(page[0] - place[0], page[1] - place[1]) < 1e-4);
}

static void check_invisibility(const struct model *m) {
  enum { SAMPLES = 400 };
  size_t count = recto_drawing_edge_count(m->drawing), step, decided = 0;
  size_t hidden = 0;
  recto_edge edge;
  step = count / SAMPLES + 1;
  for (size_t i = 0; i < count; i += step) {
    assert_true(recto_drawing_edge(m->drawing, i, &edge));
    if (edge.points[0] == RECTO_NONE)
      continue;
    for (size_t k = 0; k < edge.interval_count; k++) {
      const recto_interval *part = &edge.intervals[k];
      double at[3], page[2], depth;
      check_place(m, &edge, part->t0, part->from_mm);
      check_place(m, &edge, part->t1, part->to_mm);
      double t = (part->t0 + part->t1) / 2;
      point_along(m, &edge, t, at);
      project(m, at, page, &depth);
      int front = count_in_front(m, &edge, page, depth);
      if (front < 0)
        continue;
      decided++;
      hidden += front > 0;
      if (part->hidden_by != (uint32_t)front)
        fail_msg("edge %u-%u at %.6f: hidden by %u, counted %d", edge.points[0],
                 edge.points[1], t, part->hidden_by, front);
    }
  }
  print_message("  %zu points, %zu hidden\n", decided, hidden);
  /* Nearly all faces of suzanne are warped. */
  assert_true((decided >= 30 && hidden > 0) || count_planes(m) < m->faces / 2);
}

static void hidden_parts_have_so_many_faces_in_front(void **state) {
  (void)state;
  with_all_models(check_invisibility);
}

/* ---- Visible faces ------------------------------------------------------- */

static double area_of(const recto_half_edge *side, uint32_t count) {
  double sum = 0;
  for (uint32_t k = 0; k < count; k++) {
    const recto_half_edge *p = &side[k], *q = &side[(k + 1) % count];
    sum += (p->x_mm - side->x_mm) * (q->y_mm - side->y_mm) -
           (q->x_mm - side->x_mm) * (p->y_mm - side->y_mm);
  }
  return sum / 2;
}

/* Whether a point is in the polygon or on its border within rounding. */
static bool is_within(const recto_half_edge *side, uint32_t count, double x,
                      double y) {
  bool inside = false;
  for (uint32_t k = 0; k < count; k++) {
    const recto_half_edge *p = &side[k], *q = &side[(k + 1) % count];
    const double a[2] = {p->x_mm, p->y_mm}, b[2] = {q->x_mm, q->y_mm},
                 at[2] = {x, y};
    double length = hypot(b[0] - a[0], b[1] - a[1]);
    if (fabs(turn(a, b, at)) <= 1e-6 * length && fmin(a[0], b[0]) - 1e-6 <= x &&
        x <= fmax(a[0], b[0]) + 1e-6 && fmin(a[1], b[1]) - 1e-6 <= y &&
        y <= fmax(a[1], b[1]) + 1e-6)
      return true;
    if ((a[1] > y) != (b[1] > y) &&
        x < a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]))
      inside = !inside;
  }
  return inside;
}

static void check_fragments(const struct model *m) {
  size_t loops, sides, at = 0;
  const recto_loop *loop = recto_drawing_loops(m->drawing, &loops);
  const recto_half_edge *side = recto_drawing_half_edges(m->drawing, &sides);
  recto_fragment f;
  double area = 0;
  for (size_t i = 0; recto_drawing_fragment(m->drawing, i, &f); i++) {
    const recto_loop *outer = &loop[f.loop];
    double own = 0;
    for (uint32_t l = f.loop; l < f.loop + f.loop_count; l++) {
      const recto_half_edge *first = &side[loop[l].half_edge];
      assert_int_equal(loop[l].half_edge, at);
      assert_int_equal(loop[l].is_hole, l > f.loop);
      assert_int_equal(first->fragment, i);
      at += loop[l].count;
      own += area_of(first, loop[l].count);
      for (uint32_t k = 0; loop[l].is_hole && k < loop[l].count; k++)
        assert_true(is_within(&side[outer->half_edge], outer->count,
                              first[k].x_mm, first[k].y_mm));
    }
    assert_true(own > 0);
    area += own;
  }
  assert_int_equal(at, sides);
  assert_true(area > 10000);
}

static void fragments_have_an_area_and_holes_within(void **state) {
  (void)state;
  with_all_models(check_fragments);
}

static void check_twins(const struct model *m) {
  size_t loops, sides, twins = 0;
  const recto_loop *loop = recto_drawing_loops(m->drawing, &loops);
  const recto_half_edge *side = recto_drawing_half_edges(m->drawing, &sides);
  for (size_t l = 0; l < loops; l++)
    for (uint32_t k = 0; k < loop[l].count; k++) {
      uint32_t h = loop[l].half_edge + k, twin = side[h].twin;
      const recto_half_edge *end =
          &side[loop[l].half_edge + (k + 1) % loop[l].count];
      if (twin == RECTO_NONE)
        continue;
      twins++;
      assert_int_equal(side[twin].twin, h);
      assert_true(hypot(end->x_mm - side[twin].x_mm,
                        end->y_mm - side[twin].y_mm) < 1e-7);
    }
  assert_true(2 * twins > sides);
}

static void twins_are_symmetric_and_meet(void **state) {
  (void)state;
  with_all_models(check_twins);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_visible_parts_of_edges_are_the_ink),
      cmocka_unit_test(hidden_parts_have_so_many_faces_in_front),
      cmocka_unit_test(fragments_have_an_area_and_holes_within),
      cmocka_unit_test(twins_are_symmetric_and_meet),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
