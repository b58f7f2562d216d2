/* test_api_results.c - what a drawing gives as data agrees with what was drawn.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/box_mesh.h"

/* A box of 2 x 3 x 4 scene units about the point (10, 20, 30), the lid a group
 * of its own, and a polyline from it upwards. */
static const double points[] = {
    9,  18.5, 28, 11, 18.5, 28, 11, 21.5, 28, 9,  21.5, 28, 9,  18.5, 32,
    11, 18.5, 32, 11, 21.5, 32, 9,  21.5, 32, 10, 21.5, 30, 10, 25,   30};
static recto_scene *make_box(void) {
  const recto_mesh mesh = box_mesh(points, 10);
  const uint32_t mast[] = {8, 9};
  recto_scene *scene = box_scene(&mesh);
  assert_int_equal(recto_scene_add_polyline(scene, mast, 2, NULL), RECTO_OK);
  return scene;
}

static recto_drawing *draw(const recto_options *options) {
  recto_scene *scene = make_box();
  recto_drawing *drawing;
  recto_error error = {0};
  if (recto_scene_render(scene, options, &drawing, &error) != RECTO_OK)
    fail_msg("%s", error.text);
  recto_scene_destroy(scene);
  return drawing;
}

/* ---- The page, layers and groups ----------------------------------------- */

static void the_page_has_the_size_of_the_options(void **state) {
  (void)state;
  recto_options options;
  recto_options_init(&options);
  options.page.width_mm = 123;
  options.page.height_mm = 45;
  recto_drawing *drawing = draw(&options);
  double size[2];
  recto_drawing_page(drawing, size);
  assert_true(size[0] == 123 && size[1] == 45);
  recto_drawing_destroy(drawing);
  recto_drawing_page(NULL, size);
  assert_true(size[0] == 0 && size[1] == 0);
}

static void layers_have_their_pen_label_colour_and_width(void **state) {
  (void)state;
  const recto_pen_use use = {.lines = RECTO_LINES_HIDDEN, .pen = 2};
  const recto_pen pen[] = {
      {.width_mm = 0.5},
      {.width_mm = 0.25, .has_colour = true, .colour = 0xcc0044}};
  recto_options options;
  recto_options_init(&options);
  options.ink.hidden = RECTO_HIDDEN_LAYER;
  options.ink.pen_use = &use;
  options.ink.pen_use_count = 1;
  options.ink.pen = pen;
  options.ink.pen_count = 2;
  recto_drawing *drawing = draw(&options);
  recto_layer layer;
  assert_int_equal(recto_drawing_layer_count(drawing), 2);
  /* The hidden lines lie below. */
  assert_true(recto_drawing_layer(drawing, 0, &layer));
  assert_int_equal(layer.pen, 2);
  assert_true(layer.width_mm == 0.25 && layer.colour == 0xcc0044);
  assert_true(recto_drawing_layer(drawing, 1, &layer));
  assert_int_equal(layer.pen, 1);
  assert_true(layer.width_mm == 0.5 && layer.colour == 0);
  assert_true(strncmp(layer.label, "1 ", 2) == 0);
  assert_false(recto_drawing_layer(drawing, 2, &layer));
  assert_int_equal(layer.pen, 0);
  assert_string_equal(layer.label, "");
  recto_drawing_destroy(drawing);
}

static void groups_have_the_names_of_the_scene(void **state) {
  (void)state;
  recto_drawing *drawing = draw(NULL);
  assert_int_equal(recto_drawing_group_count(drawing), 2);
  assert_string_equal(recto_drawing_group_name(drawing, 0), "box");
  assert_string_equal(recto_drawing_group_name(drawing, 1), "lid");
  assert_null(recto_drawing_group_name(drawing, 2));
  recto_drawing_destroy(drawing);
}

/* Only names that a face has count, in the order of the faces, but for those
 * that were given by a call. */
static void groups_count_from_the_first_that_has_a_face(void **state) {
  (void)state;
  static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\no none\no late\n"
                            "o first\nf 1 2 3\no late\nf 1 3 2\no end\n";
  static const char *const name[] = {"first", "late", "given", "box", "lid"};
  const recto_mesh mesh = box_mesh(points, 10);
  recto_scene *scene;
  recto_drawing *drawing;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_read_memory(scene, obj, sizeof obj - 1, "obj",
                                           NULL, NULL, NULL),
                   RECTO_OK);
  assert_int_equal(recto_scene_add_group(scene, "given", NULL), RECTO_OK);
  assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
  assert_int_equal(recto_scene_render(scene, NULL, &drawing, NULL), RECTO_OK);
  assert_int_equal(recto_drawing_group_count(drawing), 5);
  for (size_t i = 0; i < 5; i++)
    assert_string_equal(recto_drawing_group_name(drawing, i), name[i]);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

/* ---- Strokes ------------------------------------------------------------- */

/* With a stroke for each edge: three of the box's twelve edges are hidden; the
 * polyline stands on its top. */
static void strokes_have_their_class_source_and_width(void **state) {
  (void)state;
  recto_options options;
  recto_options_init(&options);
  options.ink.ids = true;
  options.ink.hidden = RECTO_HIDDEN_LAYER;
  recto_drawing *drawing = draw(&options);
  size_t count[RECTO_EDGE_CLASS_COUNT] = {0}, hidden = 0, lid = 0;
  for (size_t i = 0; i < recto_drawing_stroke_count(drawing); i++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, i, &stroke));
    for (int k = 0; k < RECTO_EDGE_CLASS_COUNT; k++)
      count[k] += !stroke.hidden && (int)stroke.edge_class == 1 << k;
    hidden += stroke.hidden;
    lid += stroke.group == 1;
    bool is_outline = stroke.edge_class == RECTO_EDGE_SILHOUETTE;
    assert_true(stroke.width_mm == (is_outline && !stroke.hidden ? 0.6 : 0.3));
    assert_true(stroke.layer < recto_drawing_layer_count(drawing));
    assert_true(stroke.group < recto_drawing_group_count(drawing));
    if (stroke.edge_class == RECTO_EDGE_WIRE)
      assert_true(stroke.face == RECTO_NONE);
    else
      assert_true(stroke.face < 6);
  }
  assert_int_equal(count[0], 6); /* silhouettes */
  assert_int_equal(count[2], 3); /* creases, or where the groups meet */
  assert_int_equal(count[5], 1); /* the polyline */
  assert_int_equal(hidden, 3);
  assert_true(lid >= 1);
  recto_drawing_destroy(drawing);
}

static void an_older_caller_gets_the_fields_that_it_knows(void **state) {
  (void)state;
  recto_drawing *drawing = draw(NULL);
  recto_stroke whole, part;
  memset(&part, 0x55, sizeof part);
  assert_true(recto_drawing_stroke(drawing, 0, &whole));
  assert_true(recto_drawing_stroke_sized(drawing, 0, &part,
                                         offsetof(recto_stroke, width_mm)));
  assert_ptr_equal(part.points, whole.points);
  assert_int_equal(part.count, whole.count);
  unsigned char *rest = (unsigned char *)&part.width_mm;
  for (size_t i = 0; i < sizeof part - offsetof(recto_stroke, width_mm); i++)
    assert_int_equal(rest[i], 0x55);
  /* And a newer one zeros for those that this library does not know. */
  struct newer {
    recto_stroke stroke;
    uint64_t more;
  } newer = {.more = 1};
  assert_true(
      recto_drawing_stroke_sized(drawing, 0, &newer.stroke, sizeof newer));
  assert_int_equal(newer.stroke.count, whole.count);
  assert_int_equal(newer.more, 0);
  recto_drawing_destroy(drawing);
}

/* ---- The projection ------------------------------------------------------ */

/* The least distance of a page point to the ends of strokes. */
static double distance_to_ends(const recto_drawing *drawing,
                               const double at[2]) {
  double least = INFINITY;
  for (size_t i = 0; i < recto_drawing_stroke_count(drawing); i++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, i, &stroke));
    for (size_t k = 0; k < stroke.count; k++)
      least = fmin(least, hypot(stroke.points[2 * k] - at[0],
                                stroke.points[2 * k + 1] - at[1]));
  }
  return least;
}

static void corners_are_projected_to_ends_of_strokes(void **state) {
  (void)state;
  for (int scale = -600; scale <= 600; scale += 600)
    for (int perspective = 0; perspective < 2; perspective++) {
      recto_options options;
      recto_options_init(&options);
      options.ink.hidden = RECTO_HIDDEN_LAYER;
      options.camera.fov_deg = perspective ? 40 : 0;
      recto_scene *scene;
      recto_drawing *drawing;
      assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
      double scaled[24];
      for (int i = 0; i < 24; i++)
        scaled[i] = ldexp(points[i], scale);
      const recto_mesh mesh = {.points = scaled,
                               .point_count = 8,
                               .corners = box_faces[0],
                               .corner_count = 24,
                               .face_size = 4};
      assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
      assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                       RECTO_OK);
      for (int i = 0; i < 8; i++) {
        double page[2];
        assert_true(recto_drawing_project(drawing, scaled + 3 * i, page, NULL));
        assert_true(distance_to_ends(drawing, page) < 1e-5);
      }
      recto_drawing_destroy(drawing);
      recto_scene_destroy(scene);
    }
}

static void depth_is_measured_from_the_eye_along_the_view(void **state) {
  (void)state;
  recto_options options;
  recto_options_init(&options);
  options.camera.kind = RECTO_CAMERA_EYE;
  options.camera.eye[0] = 10, options.camera.eye[1] = 20,
  options.camera.eye[2] = 50;
  options.camera.target[0] = 10, options.camera.target[1] = 20,
  options.camera.target[2] = 30;
  options.camera.has_target = true;
  options.camera.fov_deg = 30;
  recto_drawing *drawing = draw(&options);
  double page[2], depth, size[2];
  const double at[3] = {10.5, 20, 32}, behind[3] = {10, 20, 51};
  assert_true(recto_drawing_project(drawing, at, page, &depth));
  assert_true(fabs(depth - 18) < 1e-12);
  recto_drawing_page(drawing, size);
  assert_true(page[0] > size[0] / 2);
  assert_false(recto_drawing_project(drawing, behind, page, &depth));
  assert_true(fabs(depth + 1) < 1e-12);
  assert_false(recto_drawing_project(NULL, at, page, NULL));
  recto_drawing_destroy(drawing);
}

/* ---- Edges --------------------------------------------------------------- */

static void init_with_edges(recto_options *options, unsigned results) {
  recto_options_init(options);
  options->results = results;
  options->ink.edges = RECTO_EDGES_ALL;
  options->ink.min_stroke_mm = 0;
}

static void edges_are_kept_on_request_alone(void **state) {
  (void)state;
  recto_drawing *drawing = draw(NULL);
  recto_edge edge;
  assert_int_equal(recto_drawing_edge_count(drawing), 0);
  assert_false(recto_drawing_edge(drawing, 0, &edge));
  assert_int_equal(edge.interval_count, 0);
  recto_drawing_destroy(drawing);
}

/* Edge by edge: its points are corners of its faces that follow each other. */
static bool is_side(const uint32_t point[2], uint32_t face) {
  for (uint32_t k = 0; k < 4; k++) {
    uint32_t a = box_faces[face][k], b = box_faces[face][(k + 1) % 4];
    if ((a == point[0] && b == point[1]) || (a == point[1] && b == point[0]))
      return true;
  }
  return false;
}

static void edges_have_their_points_and_faces(void **state) {
  (void)state;
  recto_options options;
  init_with_edges(&options, RECTO_RESULT_EDGES);
  recto_drawing *drawing = draw(&options);
  assert_int_equal(recto_drawing_edge_count(drawing), 13);
  size_t wires = 0;
  for (size_t i = 0; i < 13; i++) {
    recto_edge edge;
    assert_true(recto_drawing_edge(drawing, i, &edge));
    if (edge.edge_class == RECTO_EDGE_WIRE) {
      assert_true(edge.points[0] == 8 && edge.points[1] == 9);
      assert_true(edge.faces[0] == RECTO_NONE && edge.faces[1] == RECTO_NONE);
      wires++;
      continue;
    }
    assert_true(edge.faces[0] < 6 && edge.faces[1] < 6);
    assert_true(is_side(edge.points, edge.faces[0]));
    assert_true(is_side(edge.points, edge.faces[1]));
    assert_true(edge.group < 2);
  }
  assert_int_equal(wires, 1);
  recto_drawing_destroy(drawing);
}

/* The parts of an edge follow each other from end to end, and lie where their
 * parameters say. */
static void check_parts(const recto_drawing *drawing, const recto_edge *edge) {
  const double *a = points + 3 * (size_t)edge->points[0];
  const double *b = points + 3 * (size_t)edge->points[1];
  for (size_t i = 0; i < edge->interval_count; i++) {
    const recto_interval *part = &edge->intervals[i];
    double at[3], mm[2];
    assert_true(part->t0 == (i == 0 ? 0 : edge->intervals[i - 1].t1));
    assert_true(part->t0 < part->t1);
    for (int k = 0; k < 3; k++)
      at[k] = a[k] + part->t1 * (b[k] - a[k]);
    assert_true(recto_drawing_project(drawing, at, mm, NULL));
    assert_true(hypot(mm[0] - part->to_mm[0], mm[1] - part->to_mm[1]) < 1e-5);
  }
  if (edge->interval_count > 0)
    assert_true(edge->intervals[edge->interval_count - 1].t1 > 1 - 1e-6);
}

static void visible_parts_of_edges_are_what_is_drawn(void **state) {
  (void)state;
  for (int view = 0; view < 20; view++) {
    recto_options options;
    init_with_edges(&options, RECTO_RESULT_EDGES);
    options.camera.azimuth_deg = 17 * view + 1;
    options.camera.elevation_deg = 3 * view - 27.5;
    options.camera.fov_deg = view % 2 ? 50 : 0;
    recto_drawing *drawing = draw(&options);
    double length = 0, drawn = 0;
    for (size_t i = 0; i < recto_drawing_edge_count(drawing); i++) {
      recto_edge edge;
      assert_true(recto_drawing_edge(drawing, i, &edge));
      check_parts(drawing, &edge);
      for (size_t k = 0; k < edge.interval_count; k++) {
        const recto_interval *p = &edge.intervals[k];
        assert_true(p->hidden_by == 0 || p->hidden_by == RECTO_NONE);
        if (p->hidden_by == 0)
          length +=
              hypot(p->to_mm[0] - p->from_mm[0], p->to_mm[1] - p->from_mm[1]);
      }
    }
    for (size_t i = 0; i < recto_drawing_stroke_count(drawing); i++) {
      recto_stroke stroke;
      assert_true(recto_drawing_stroke(drawing, i, &stroke));
      for (size_t k = 0; k + 1 < stroke.count + stroke.closed; k++) {
        const double *p = stroke.points + 2 * k;
        const double *q = stroke.points + 2 * ((k + 1) % stroke.count);
        drawn += hypot(q[0] - p[0], q[1] - p[1]);
      }
    }
    assert_true(length > 100 && fabs(length - drawn) < 1e-4);
    recto_drawing_destroy(drawing);
  }
}

/* Three upright squares one behind the other, each larger than the one before
 * it, and a polyline behind them all, from the left to the right. */
static void hidden_parts_are_counted_where_requested(void **state) {
  (void)state;
  static const double point[] = {-1, -1, 2,  1,  -1, 2,  1,  1, 2, -1, 1,
                                 2,  -2, -2, 1,  2,  -2, 1,  2, 2, 1,  -2,
                                 2,  1,  -3, -3, 0,  3,  -3, 0, 3, 3,  0,
                                 -3, 3,  0,  -4, 0,  -1, 4,  0, -1};
  static const uint32_t corner[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  static const uint32_t line[] = {12, 13};
  static const uint32_t expected[] = {0, 1, 2, 3, 2, 1, 0};
  const recto_mesh mesh = {.points = point,
                           .point_count = 14,
                           .corners = corner,
                           .corner_count = 12,
                           .face_size = 4};
  recto_options options;
  recto_scene *scene;
  recto_drawing *drawing;
  init_with_edges(&options, RECTO_RESULT_INVISIBILITY);
  options.camera.azimuth_deg = options.camera.elevation_deg = 0;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
  assert_int_equal(recto_scene_add_polyline(scene, line, 2, NULL), RECTO_OK);
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_OK);
  recto_edge edge;
  assert_int_equal(recto_drawing_edge_count(drawing), 13);
  assert_true(recto_drawing_edge(drawing, 12, &edge));
  assert_int_equal(edge.edge_class, RECTO_EDGE_WIRE);
  assert_int_equal(edge.interval_count, 7);
  for (size_t i = 0; i < 7; i++) {
    assert_int_equal(edge.intervals[i].hidden_by, expected[i]);
    double t1 = i < 6 ? (double)(i + 1 + (i > 2)) / 8 : 1;
    assert_true(fabs(edge.intervals[i].t1 - t1) < 1e-6);
  }
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

/* ---- Visible faces ------------------------------------------------------- */

/* Twice the area of a loop, in square mm. */
static double area_of(const recto_half_edge *half, const recto_loop *loop) {
  double area = 0;
  for (uint32_t k = 0; k < loop->count; k++) {
    const recto_half_edge *p = &half[loop->half_edge + k];
    const recto_half_edge *q =
        &half[loop->half_edge + (k + 1 < loop->count ? k + 1 : 0)];
    area += p->x_mm * q->y_mm - q->x_mm * p->y_mm;
  }
  return area;
}

/* The half-edge after one, in its loop. */
static uint32_t next_of(const recto_drawing *drawing, uint32_t half_edge) {
  size_t count;
  const recto_loop *loop = recto_drawing_loops(drawing, &count);
  for (size_t i = 0; i < count; i++)
    if (half_edge - loop[i].half_edge < loop[i].count)
      return loop[i].half_edge +
             (half_edge - loop[i].half_edge + 1) % loop[i].count;
  fail_msg("half-edge %u is in no loop", half_edge);
  return 0;
}

/* A frame before a wall: the wall is seen around it and through it. */
static recto_drawing *draw_frame(unsigned results) {
  static const double point[] = {
      -9, -9, 0, 9, -9, 0, 9, 9, 0, -9, 9, 0, /* the wall */
      -4, -4, 2, 4, -4, 2, 4, 4, 2, -4, 4, 2, /* the frame, outside */
      -2, -2, 2, 2, -2, 2, 2, 2, 2, -2, 2, 2 /* and inside */};
  static const uint32_t corner[] = {0,  1, 2, 3, 4,  5,  9, 8, 5, 6,
                                    10, 9, 6, 7, 11, 10, 7, 4, 8, 11};
  const recto_mesh mesh = {.points = point,
                           .point_count = 12,
                           .corners = corner,
                           .corner_count = 20,
                           .face_size = 4};
  recto_options options;
  recto_scene *scene;
  recto_drawing *drawing;
  init_with_edges(&options, results);
  options.camera.azimuth_deg = options.camera.elevation_deg = 0;
  options.camera.fit = RECTO_FIT_SCALE;
  options.ink.edges = RECTO_EDGES_DEFAULT;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_OK);
  recto_scene_destroy(scene);
  return drawing;
}

static void fragments_have_outlines_and_holes(void **state) {
  (void)state;
  recto_drawing *drawing = draw_frame(RECTO_RESULT_FACES);
  size_t loops, half_edges;
  const recto_loop *loop = recto_drawing_loops(drawing, &loops);
  const recto_half_edge *half = recto_drawing_half_edges(drawing, &half_edges);
  /* The wall around the frame and within it, and the frame's four parts. */
  assert_int_equal(recto_drawing_fragment_count(drawing), 6);
  assert_int_equal(loops, 7);
  double wall = 0, frame = 0;
  size_t holes = 0;
  for (size_t i = 0; i < 6; i++) {
    recto_fragment fragment;
    assert_true(recto_drawing_fragment(drawing, i, &fragment));
    assert_false(fragment.is_back);
    assert_true(fragment.brightness > 0 && fragment.brightness <= 1);
    for (uint32_t k = 0; k < fragment.loop_count; k++) {
      const recto_loop *l = &loop[fragment.loop + k];
      double area = area_of(half, l) / 2;
      assert_true(l->is_hole == (k > 0) && (area < 0) == l->is_hole);
      for (uint32_t h = 0; h < l->count; h++)
        assert_int_equal(half[l->half_edge + h].fragment, i);
      holes += l->is_hole;
      *(fragment.face == 0 ? &wall : &frame) += area;
    }
  }
  assert_int_equal(holes, 1);
  assert_true(fabs(wall - (324 - 48)) < 1e-6 && fabs(frame - 48) < 1e-6);
  recto_fragment none;
  assert_false(recto_drawing_fragment(drawing, 6, &none));
  assert_int_equal(none.face, RECTO_NONE);
  recto_drawing_destroy(drawing);
}

static void twins_run_along_each_other(void **state) {
  (void)state;
  recto_drawing *drawing = draw_frame(RECTO_RESULT_FACES);
  size_t count, outer = 0;
  const recto_half_edge *half = recto_drawing_half_edges(drawing, &count);
  for (uint32_t i = 0; i < count; i++) {
    if (half[i].twin == RECTO_NONE) {
      outer++;
      continue;
    }
    const recto_half_edge *twin = &half[half[i].twin];
    const recto_half_edge *end = &half[next_of(drawing, i)];
    assert_int_equal(twin->twin, i);
    assert_true(twin->fragment != half[i].fragment);
    assert_true(twin->x_mm == end->x_mm && twin->y_mm == end->y_mm);
  }
  assert_int_equal(outer, 4); /* the wall's own border */
  recto_drawing_destroy(drawing);
}

static void sides_have_their_class(void **state) {
  (void)state;
  recto_drawing *drawing = draw_frame(RECTO_RESULT_FACES);
  size_t count, of_side[4] = {0}, smooth = 0;
  const recto_half_edge *half = recto_drawing_half_edges(drawing, &count);
  for (size_t i = 0; i < count; i++) {
    of_side[half[i].side]++;
    smooth += half[i].edge_class == RECTO_EDGE_SMOOTH;
    assert_true(half[i].edge_class == RECTO_EDGE_BORDER ||
                (half[i].edge_class == RECTO_EDGE_SMOOTH &&
                 half[i].side == RECTO_SIDE_EDGE));
  }
  assert_int_equal(of_side[RECTO_SIDE_EDGE], 4 + 4 * 4);
  assert_int_equal(of_side[RECTO_SIDE_OCCLUDER], 8);
  assert_int_equal(smooth, 8); /* four seams, from both sides; not requested */
  assert_int_equal(of_side[RECTO_SIDE_INTERSECTION], 0);
  assert_int_equal(of_side[RECTO_SIDE_CLIP], 0);
  recto_drawing_destroy(drawing);
}

static void no_fragments_are_kept_without_request(void **state) {
  (void)state;
  size_t count = 9;
  recto_drawing *drawing = draw_frame(RECTO_RESULT_EDGES);
  assert_int_equal(recto_drawing_fragment_count(drawing), 0);
  assert_null(recto_drawing_loops(drawing, &count));
  assert_int_equal(count, 0);
  assert_null(recto_drawing_half_edges(NULL, NULL));
  recto_drawing_destroy(drawing);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_page_has_the_size_of_the_options),
      cmocka_unit_test(layers_have_their_pen_label_colour_and_width),
      cmocka_unit_test(groups_have_the_names_of_the_scene),
      cmocka_unit_test(groups_count_from_the_first_that_has_a_face),
      cmocka_unit_test(strokes_have_their_class_source_and_width),
      cmocka_unit_test(an_older_caller_gets_the_fields_that_it_knows),
      cmocka_unit_test(corners_are_projected_to_ends_of_strokes),
      cmocka_unit_test(depth_is_measured_from_the_eye_along_the_view),
      cmocka_unit_test(edges_are_kept_on_request_alone),
      cmocka_unit_test(edges_have_their_points_and_faces),
      cmocka_unit_test(visible_parts_of_edges_are_what_is_drawn),
      cmocka_unit_test(hidden_parts_are_counted_where_requested),
      cmocka_unit_test(fragments_have_outlines_and_holes),
      cmocka_unit_test(twins_run_along_each_other),
      cmocka_unit_test(sides_have_their_class),
      cmocka_unit_test(no_fragments_are_kept_without_request),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
