/* test_zbuffer.c - the two z-buffers, pixel by pixel against rational
 * arithmetic, against each other, and as visible maps. */
#include "exact_fixture/pixels.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/near.h"
#include "visibility/scanline_zbuffer/scanline_zbuffer.h"
#include "visibility/zbuffer/zbuffer.h"

enum { FINE = 2048 }; /* lines where the answer should be nearly exact */

static const struct solver *const both[] = {&solver_zbuffer,
                                            &solver_scanline_zbuffer};

/* ---- Frames -------------------------------------------------------------- */

static const struct solver_request plain = {.threads = 1};

/* Both frames of a sheet: the triangle seen in each pixel. */
struct frames {
  struct raster whole;
  uint32_t *scanned; /* what the scan-line z-buffer saw, as a raster has it */
  size_t pixels;
};

static void scan_frame(struct frames *frames, const struct sheet *sheet,
                       const struct facets *facets, int lines, int bits) {
  struct raster one;
  struct scanline scanline;
  size_t columns = (size_t)frames->whole.grid.columns;
  assert_int_equal(raster_init(&one, sheet, lines, bits, false, NULL),
                   RECTO_OK);
  assert_true(scanline_init(&scanline, &one, facets, &plain));
  for (int32_t line = lines; line-- > 0;) {
    raster_clear_line(&one, line);
    assert_true(scanline_enter(&scanline, line));
    scanline_draw(&scanline);
    scanline_step(&scanline);
    memcpy(frames->scanned + (size_t)line * columns, one.seen,
           columns * sizeof *one.seen);
  }
  assert_int_equal(scanline.active.count, 0);
  scanline_fini(&scanline);
  raster_fini(&one);
}

static void draw_frames(struct frames *frames, const struct sheet *sheet,
                        int lines, int bits) {
  struct facets facets;
  int64_t covered = 0;
  assert_true(facets_init(&facets, sheet));
  assert_int_equal(raster_init(&frames->whole, sheet, lines, bits, true, NULL),
                   RECTO_OK);
  assert_int_equal(
      zbuffer_draw(&frames->whole, &facets, &plain, NULL, &covered, NULL),
      RECTO_OK);
  frames->pixels = (size_t)lines * (size_t)frames->whole.grid.columns;
  frames->scanned = mem_alloc(frames->pixels, sizeof *frames->scanned);
  scan_frame(frames, sheet, &facets, lines, bits);
  facets_fini(&facets);
}

static void free_frames(struct frames *frames) {
  raster_fini(&frames->whole);
  mem_free(frames->scanned);
}

static int face_at(const struct sheet *sheet, const uint32_t *frame,
                   size_t pixel) {
  return frame[pixel] == 0
             ? -1
             : (int)sheet->triangle.item[raster_facet(frame[pixel])].face;
}

/* Draws a scene at a number of lines by both and holds each pixel against
 * the judge. */
static void assert_frames_are_judged(const struct pixels_scene *scene,
                                     int lines) {
  struct sheet sheet;
  struct frames frames;
  pixels_sheet(&sheet, scene);
  draw_frames(&frames, &sheet, lines, 0);
  assert_int_equal(frames.pixels, lines * lines);
  for (int y = 0; y < lines; y++)
    for (int x = 0; x < lines; x++) {
      size_t pixel = (size_t)(y * lines + x);
      int want = pixels_seen(scene, lines, x, y, NULL);
      int got = face_at(&sheet, frames.whole.seen, pixel);
      if (got != want || frames.scanned[pixel] != frames.whole.seen[pixel])
        fail_msg("%d lines, pixel %d %d: face %d, not %d", lines, x, y, got,
                 want);
    }
  free_frames(&frames);
  exact_sheet_fini(&sheet);
}

static void assert_worked_frame(const struct pixels_scene *scene,
                                int (*frame)(int, int), int exact_ties) {
  int ties = 0;
  for (int y = 0; y < 32; y++)
    for (int x = 0; x < 32; x++) {
      struct pixels_scene turned = *scene;
      int seen = pixels_seen(scene, 32, x, y, NULL);
      assert_int_equal(seen, frame(x, y));
      for (int f = 0; f < scene->count; f++)
        turned.face[f] = scene->face[scene->count - 1 - f];
      turned.count = scene->count;
      if (seen >= 0)
        ties += scene->count - 1 - pixels_seen(&turned, 32, x, y, NULL) != seen;
    }
  assert_int_equal(ties, exact_ties);
  assert_frames_are_judged(scene, 32);
}

static void pierced_rectangle_is_right_in_every_pixel(void **state) {
  (void)state;
  assert_worked_frame(&pixels_pierced_rectangle,
                      pixels_frame_of_pierced_rectangle, 3);
}

static void two_rectangles_are_right_in_every_pixel(void **state) {
  (void)state;
  assert_worked_frame(&pixels_two_rectangles, pixels_frame_of_two_rectangles,
                      5);
}

static void random_scenes_are_right_in_every_pixel(void **state) {
  static const int lines[] = {1, 7, 32, 45, 64, 100};
  (void)state;
  for (uint64_t seed = 0; seed < 120; seed++) {
    struct pixels_scene scene;
    pixels_random_scene(&scene, seed);
    assert_frames_are_judged(&scene, lines[seed % 6]);
  }
}

/* With integer depths the only oracle is the other z-buffer. */
static void scan_line_agrees_at_every_depth(void **state) {
  static const int bits[] = {1, 8, 16, 24, 32};
  (void)state;
  for (uint64_t seed = 200; seed < 260; seed++) {
    struct pixels_scene scene;
    struct sheet sheet;
    struct frames frames;
    pixels_random_scene(&scene, seed);
    pixels_sheet(&sheet, &scene);
    draw_frames(&frames, &sheet, 40 + (int)seed % 50, bits[seed % 5]);
    assert_memory_equal(frames.scanned, frames.whole.seen,
                        frames.pixels * sizeof *frames.scanned);
    free_frames(&frames);
    exact_sheet_fini(&sheet);
  }
}

/* Triangles in one plane whose slopes are thirds, which doubles cannot hold:
 * all ties, and the first that covers a pixel is seen. */
static void ties_of_rounded_depths_keep_the_earlier_face(void **state) {
  uint64_t seed = 77;
  (void)state;
  for (int round = 0; round < 30; round++) {
    struct pixels_scene scene = {PIXELS_FACES, {{0}}};
    for (int f = 0; f < PIXELS_FACES;) {
      int(*c)[3] = scene.face[f].corner;
      scene.face[f].count = 3;
      for (int k = 0; k < 3; k++) {
        c[k][1] = exact_random_below(&seed, 33);
        c[k][0] = (3 * exact_random_below(&seed, 11) + c[k][1]) % 33;
        c[k][2] = (c[k][0] + 2 * c[k][1]) / 3;
      }
      f += (c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) !=
           (c[1][1] - c[0][1]) * (c[2][0] - c[0][0]);
    }
    assert_frames_are_judged(&scene, 31 + round);
  }
}

/* ---- Worked numbers ------------------------------------------------------ */

struct listed {
  double x_left, dx_left, dy_left, x_right, dx_right, dy_right, z_left, dz_x,
      dz_y;
};

static void assert_pair(const struct active_edge_pair *pair,
                        struct listed want) {
  assert_near(pair->edges.left.x, want.x_left);
  assert_near(pair->edges.left.dx, want.dx_left);
  assert_near(pair->edges.left.dy, want.dy_left);
  assert_near(pair->edges.right.x, want.x_right);
  assert_near(pair->edges.right.dx, want.dx_right);
  assert_near(pair->edges.right.dy, want.dy_right);
  assert_near(pair->z_left / PIXELS_UNIT, want.z_left);
  assert_near(pair->dz_x / PIXELS_UNIT, want.dz_x);
  assert_near(pair->dz_y / PIXELS_UNIT, want.dz_y);
}

static void active_pairs_are_as_listed(void **state) {
  struct sheet sheet;
  struct facets facets;
  struct raster raster;
  struct scanline scanline;
  (void)state;
  pixels_sheet(&sheet, &pixels_pierced_rectangle);
  assert_true(facets_init(&facets, &sheet));
  assert_int_equal(raster_init(&raster, &sheet, 32, 0, false, NULL), RECTO_OK);
  assert_true(scanline_init(&scanline, &raster, &facets, &plain));
  for (int32_t line = 31; line >= 0; line--) {
    const struct active_edge_pair *pair;
    raster_clear_line(&raster, line);
    assert_true(scanline_enter(&scanline, line));
    pair = scanline.active.item;
    /* The rectangle is one polygon of four corners, from line 24 to 5; the
     * triangle's lines are 24 to 10. */
    assert_int_equal(scanline.active.count, line > 24 || line < 5 ? 0
                                            : line < 10           ? 1
                                                                  : 2);
    if (line == 24) {
      assert_pair(&pair[0], (struct listed){10, 0, 19, 25, 0, 19, 10, 0, 0});
      assert_pair(&pair[1], (struct listed){24.5, -1, 9, 25 + 1 / 6., 1 / 3.,
                                            14, 5.5, 0.75, 0.25});
    }
    if (line == 15) {
      assert_pair(&pair[0], (struct listed){10, 0, 10, 25, 0, 10, 10, 0, 0});
      assert_pair(&pair[1], (struct listed){15.5, -1, 0, 28 + 1 / 6., 1 / 3., 5,
                                            14.5, 0.75, 0.25});
    }
    if (line == 14)
      assert_pair(&pair[1],
                  (struct listed){16.5, 3, 4, 28.5, 1 / 3., 4, 14, 0.75, 0.25});
    scanline_draw(&scanline);
    scanline_step(&scanline);
  }
  scanline_fini(&scanline);
  raster_fini(&raster);
  facets_fini(&facets);
  exact_sheet_fini(&sheet);
}

static void depths_of_line_15_fall_by_three_quarters(void **state) {
  static const double depth[] = {14.5, 13.75, 13, 12.25, 11.5, 10.75, 10};
  struct sheet sheet;
  struct facets facets;
  struct raster raster;
  struct active_edge_pair pair;
  (void)state;
  pixels_sheet(&sheet, &pixels_pierced_rectangle);
  assert_true(facets_init(&facets, &sheet));
  assert_int_equal(raster_init(&raster, &sheet, 32, 0, true, NULL), RECTO_OK);
  assert_true(active_edge_pair_start(&pair, &raster, &facets, 2));
  do
    active_edge_pair_draw(&pair, &raster);
  while (active_edge_pair_next(&pair, &raster));
  for (int i = 0; i < 7; i++)
    assert_near(raster.depth[15 * 32 + 15 + i] / PIXELS_UNIT, depth[i]);
  assert_near(raster.depth[15 * 32 + 20] / PIXELS_UNIT, 43 / 4.);
  assert_near(raster_depth(&raster, 2, 20, 15) / PIXELS_UNIT, 43 / 4.);
  assert_int_equal(raster.seen[15 * 32 + 14], 0);
  raster_fini(&raster);
  facets_fini(&facets);
  exact_sheet_fini(&sheet);
}

/* ---- Depth --------------------------------------------------------------- */

/* Two sheets over the page's middle at depth z and z + gap. */
static void near_sheets(struct sheet *sheet, int64_t z, int64_t gap) {
  static const int square[][3] = {
      {-10, -10, 4}, {10, -10, 4}, {10, 10, 4}, {-10, 10, 4}};
  exact_sheet_init(sheet);
  sheet->camera.page_mm[0] = sheet->camera.page_mm[1] = PIXELS_SIDE;
  exact_add_face(sheet, square, 4, PIXELS_UNIT);
  for (size_t p = 0; p < 4; p++) {
    struct geom_point nearer = sheet->point.item[p];
    sheet->point.item[p].z = z;
    nearer.z = z + gap;
    assert_true(ARRAY_PUSH(&sheet->point, nearer));
  }
  for (size_t t = 0; t < 2; t++) {
    struct sheet_triangle copy = sheet->triangle.item[t];
    struct sheet_sides none = {{SHEET_NONE, SHEET_NONE, SHEET_NONE}};
    for (int k = 0; k < 3; k++)
      copy.point[k] += 4;
    copy.face = 1;
    assert_true(ARRAY_PUSH(&sheet->triangle, copy));
    assert_true(ARRAY_PUSH(&sheet->sides, none));
  }
  sheet->triangle_flags = mem_resize(sheet->triangle_flags, 4, 1);
  memset(sheet->triangle_flags, 0, 4);
}

static int face_in_the_middle(int64_t z, int64_t gap, int bits) {
  struct sheet sheet;
  struct frames frames;
  int face;
  near_sheets(&sheet, z, gap);
  draw_frames(&frames, &sheet, 16, bits);
  face = face_at(&sheet, frames.whole.seen, 8 * 16 + 8);
  for (size_t y = 4; y < 12; y++)
    for (size_t x = 4; x < 12; x++)
      assert_int_equal(face_at(&sheet, frames.whole.seen, y * 16 + x), face);
  free_frames(&frames);
  exact_sheet_fini(&sheet);
  return face;
}

/* B bits distinguish sheets by 2^(40 - B) units and no less. */
static void integer_depths_fight_where_their_bits_say(void **state) {
  static const int bits[] = {16, 24, 32};
  (void)state;
  for (int i = 0; i < 3; i++) {
    int64_t level = INT64_C(1) << (SHEET_Z_BITS - bits[i]);
    /* Well within a level: 2^B - 1 of them share a range of 2^40. */
    int64_t z = (INT64_C(1) << 38) + level / 2;
    assert_int_equal(face_in_the_middle(z, 2 * level, bits[i]), 1);
    assert_int_equal(face_in_the_middle(z, level / 2, bits[i]), 0);
    assert_int_equal(face_in_the_middle(z, -2 * level, bits[i]), 0);
  }
}

static void float64_distinguishes_single_units(void **state) {
  (void)state;
  assert_int_equal(face_in_the_middle(INT64_C(1) << 39, 1, 0), 1);
  assert_int_equal(face_in_the_middle(INT64_C(1) << 39, 0, 0), 0);
  assert_int_equal(face_in_the_middle(INT64_C(1) << 39, -1, 0), 0);
}

enum { COARSE = 64 }; /* lines over a page of 1024 mm: 2^24 units a pixel */

static int32_t centre(int pixel) {
  return (2 * pixel + 1 - COARSE) * (1 << 23);
}

/* A needle from a few units about a pixel's centre to the page's border, as
 * deep at one corner as the range allows and 0 at the others: its depth
 * changes by 2^38 within a unit. */
static void add_needle(struct sheet *sheet, int x, int y, uint64_t *seed) {
  int32_t cx = centre(x), cy = centre(y);
  struct geom_point p[3] = {{cx - 3 - exact_random_below(seed, 4),
                             cy - 1 - exact_random_below(seed, 3), 0},
                            {cx + 2 + exact_random_below(seed, 5),
                             cy - exact_random_below(seed, 3), SHEET_Z_MAX},
                            {cx + exact_random_below(seed, 3) - 1,
                             (1 << 29) - 1, exact_random_below(seed, 1000)}};
  exact_add_triangle(sheet, p, 0);
}

/* A level triangle about the same centre. */
static void add_level(struct sheet *sheet, int x, int y, int64_t z) {
  int32_t cx = centre(x), cy = centre(y);
  const struct geom_point p[3] = {
      {cx - 5000, cy - 5000, z}, {cx + 5000, cy - 5000, z}, {cx, cy + 9000, z}};
  exact_add_triangle(sheet, p, 1);
}

/* floor of the first triangle's depth at a pixel's centre, and whether that
 * is its depth exactly. */
static int64_t floor_depth(const struct sheet *sheet, int x, int y,
                           bool *exact) {
  const uint32_t *p = sheet->triangle.item[0].point;
  struct geom_plane plane =
      geom_plane_of(sheet->point.item[p[0]], sheet->point.item[p[1]],
                    sheet->point.item[p[2]]);
  int128 num =
      plane.nx * (centre(x) - plane.a.x) + plane.ny * (centre(y) - plane.a.y);
  int128 fall = num / plane.nz;
  if (fall * plane.nz < num)
    fall++;
  *exact = fall * plane.nz == num;
  return (int64_t)(plane.a.z - fall);
}

/* Faces so steep that doubles cannot bound their depth are still sampled at
 * the centre: against a level face a unit above and below the truth. */
static void steep_faces_are_decided_at_the_centre(void **state) {
  uint64_t seed = 99;
  (void)state;
  for (int round = 0; round < 200; round++) {
    int x = 3 + exact_random_below(&seed, COARSE - 6),
        y = 3 + exact_random_below(&seed, 40);
    struct sheet sheet;
    struct frames frames;
    bool exact;
    int64_t z;
    exact_sheet_init(&sheet);
    sheet.camera.page_mm[0] = sheet.camera.page_mm[1] = 1024;
    add_needle(&sheet, x, y, &seed);
    z = floor_depth(&sheet, x, y, &exact);
    add_level(&sheet, x, y, z + round % 2);
    draw_frames(&frames, &sheet, COARSE, 0);
    assert_int_equal(
        face_at(&sheet, frames.whole.seen, (size_t)(y * COARSE + x)),
        round % 2 == 1);
    assert_memory_equal(frames.scanned, frames.whole.seen,
                        frames.pixels * sizeof *frames.scanned);
    free_frames(&frames);
    exact_sheet_fini(&sheet);
  }
}

/* A needle that starts at the very centre, just as deep there as a face whose
 * depth in doubles is rounded, or a unit nearer: c = (p0 + p1 + 2 p2) / 4. */
static void steep_faces_meet_others_exactly(void **state) {
  uint64_t seed = 97;
  (void)state;
  for (int round = 0; round < 400; round++) {
    int x = 3 + exact_random_below(&seed, COARSE - 6),
        y = 3 + exact_random_below(&seed, 40);
    int32_t cx = centre(x), cy = centre(y), half = 1 << 21;
    int32_t ax = exact_random_below(&seed, half / 2),
            ay = exact_random_below(&seed, half);
    int64_t z = INT64_C(1) << 39,
            a = exact_random_below(&seed, 1 << 30) * INT64_C(99),
            b = exact_random_below(&seed, 1 << 30) * INT64_C(101);
    const struct geom_point slope[3] = {
        {cx - half, cy - half - ay, z + a},
        {cx + half - 2 * ax, cy - half + ay, z - a - 2 * b},
        {cx + ax, cy + half, z + b}};
    const struct geom_point needle[3] = {{cx, cy, z + round % 2},
                                         {cx + 9, cy + 3, SHEET_Z_MAX},
                                         {cx + 1, (1 << 29) - 1, 0}};
    struct sheet sheet;
    struct frames frames;
    exact_sheet_init(&sheet);
    sheet.camera.page_mm[0] = sheet.camera.page_mm[1] = 1024;
    exact_add_triangle(&sheet, slope, 0);
    exact_add_triangle(&sheet, needle, 1);
    draw_frames(&frames, &sheet, COARSE, 0);
    assert_int_equal(
        face_at(&sheet, frames.whole.seen, (size_t)(y * COARSE + x)),
        round % 2);
    free_frames(&frames);
    exact_sheet_fini(&sheet);
  }
}

/* In integer levels a steep face stays within its own depths, also where
 * these are the ends of the range. */
static void steep_faces_keep_within_their_depths(void **state) {
  uint64_t seed = 98;
  (void)state;
  for (int round = 0; round < 400; round++) {
    int x = 3 + exact_random_below(&seed, COARSE - 6),
        y = 3 + exact_random_below(&seed, 40);
    int32_t cx = centre(x), cy = centre(y);
    int64_t low = round % 2 == 0 ? 0 : SHEET_Z_MAX, high = SHEET_Z_MAX - low;
    const struct geom_point needle[3] = {
        {cx, cy, low},
        {cx + 1 + exact_random_below(&seed, 4),
         cy + 3 + exact_random_below(&seed, 4), high},
        {cx + 1, (1 << 29) - exact_random_below(&seed, 1000), low}};
    struct sheet sheet;
    struct frames frames;
    exact_sheet_init(&sheet);
    sheet.camera.page_mm[0] = sheet.camera.page_mm[1] = 1024;
    exact_add_triangle(&sheet, needle, 0);
    draw_frames(&frames, &sheet, COARSE, 32);
    assert_int_equal(frames.whole.seen[y * COARSE + x], raster_seen(0));
    if (low == 0)
      assert_in_range(frames.whole.level[y * COARSE + x], 1, 1 << 16);
    else
      assert_in_range(frames.whole.level[y * COARSE + x],
                      UINT32_MAX - (1 << 16), UINT32_MAX);
    free_frames(&frames);
    exact_sheet_fini(&sheet);
  }
}

static void needles_cover_the_pixels_whose_centres_they_hold(void **state) {
  struct pixels_scene scene = {
      2,
      {{4, {{0, 0, 3}, {32, 0, 3}, {32, 32, 3}, {0, 32, 3}}},
       {3, {{0, 0, 9}, {32, 31, 1}, {32, 32, 9}}}}};
  (void)state;
  for (int lines = 16; lines <= 256; lines *= 2)
    assert_frames_are_judged(&scene, lines);
}

/* ---- Back faces ---------------------------------------------------------- */

static void removed_backs_leave_what_is_behind(void **state) {
  /* A back face before a front face. */
  const struct pixels_scene scene = {
      2,
      {{4, {{4, 4, 9}, {4, 20, 9}, {20, 20, 9}, {20, 4, 9}}},
       {4, {{2, 2, 3}, {30, 2, 3}, {30, 30, 3}, {2, 30, 3}}}}};
  (void)state;
  for (int s = 0; s < 2; s++)
    for (int remove = 0; remove < 2; remove++) {
      const struct solver_request request = {.fragments = true,
                                             .threads = 1,
                                             .resolution = 32,
                                             .remove_backs = remove == 1};
      struct sheet sheet;
      struct map map;
      pixels_sheet(&sheet, &scene);
      map_init(&map);
      assert_int_equal(both[s]->solve(&sheet, &request, &map, NULL, NULL),
                       RECTO_OK);
      assert_int_equal(map.fragment.item[0].face, remove);
      map_fini(&map);
      exact_sheet_fini(&sheet);
    }
}

/* ---- Maps ---------------------------------------------------------------- */

static void solve_scene(const struct solver *solver,
                        const struct pixels_scene *scene, int lines, int bits,
                        struct sheet *sheet, struct map *map) {
  const struct solver_request request = {.edges = true,
                                         .fragments = true,
                                         .threads = 1,
                                         .resolution = lines,
                                         .depth_bits = bits};
  pixels_sheet(sheet, scene);
  map_init(map);
  assert_int_equal(solver->solve(sheet, &request, map, NULL, NULL), RECTO_OK);
}

/* In square scene units. */
static double face_area(const struct map *map, uint32_t face) {
  double area = 0;
  for (size_t f = 0; f < map->fragment.count; f++) {
    const struct map_loop *loop = &map->loop.item[map->fragment.item[f].loop];
    const struct map_corner *c = &map->corner.item[loop->corner];
    if (map->fragment.item[f].face != face)
      continue;
    for (uint32_t k = 0; k < loop->count; k++) {
      const struct map_corner *next = &c[(k + 1) % loop->count];
      area += (c[k].x * next->y - next->x * c[k].y) / 2;
    }
  }
  return area / PIXELS_UNIT / PIXELS_UNIT;
}

static void fragments_cover_the_pixels_seen(void **state) {
  (void)state;
  for (uint64_t seed = 300; seed < 320; seed++) {
    struct pixels_scene scene;
    struct sheet sheet;
    struct map map;
    int pixels[PIXELS_FACES] = {0};
    pixels_random_scene(&scene, seed);
    solve_scene(both[seed % 2], &scene, 32, 0, &sheet, &map);
    for (int i = 0; i < 32 * 32; i++) {
      int seen = pixels_seen(&scene, 32, i % 32, i / 32, NULL);
      if (seen >= 0)
        pixels[seen]++;
    }
    for (int f = 0; f < scene.count; f++)
      assert_near(face_area(&map, (uint32_t)f), pixels[f]);
    map_fini(&map);
    exact_sheet_fini(&sheet);
  }
}

static void fragments_are_loops_in_canonical_order(void **state) {
  struct sheet sheet;
  struct map map;
  (void)state;
  solve_scene(&solver_zbuffer, &pixels_two_rectangles, 64, 0, &sheet, &map);
  assert_true(map.fragment.count > 3);
  for (size_t f = 0; f < map.fragment.count; f++) {
    const struct map_loop *loop = &map.loop.item[map.fragment.item[f].loop];
    const struct map_corner *c = &map.corner.item[loop->corner];
    assert_int_equal(loop->count, 4);
    assert_true(f == 0 ||
                map.fragment.item[f - 1].face <= map.fragment.item[f].face);
    assert_true(c[0].x == c[3].x && c[0].y < c[3].y);
    assert_true(c[0].y == c[1].y && c[0].x < c[1].x);
    for (int k = 0; k < 4; k++) {
      assert_int_equal(c[k].side, MAP_SIDE_CLIP);
      assert_true(c[k].x * 256 == floor(c[k].x * 256));
    }
  }
  map_fini(&map);
  exact_sheet_fini(&sheet);
}

static void scan_line_draws_the_same_map(void **state) {
  static const int bits[] = {0, 16, 24};
  (void)state;
  for (uint64_t seed = 400; seed < 440; seed++) {
    struct pixels_scene scene;
    struct sheet sheet[2];
    struct map map[2];
    pixels_random_scene(&scene, seed);
    for (int s = 0; s < 2; s++)
      solve_scene(both[s], &scene, 32 << (seed % 4), bits[seed % 3], &sheet[s],
                  &map[s]);
    exact_assert_same_map(&map[0], &map[1], "scan line");
    for (int s = 0; s < 2; s++) {
      map_fini(&map[s]);
      exact_sheet_fini(&sheet[s]);
    }
  }
}

/* ---- Strokes ------------------------------------------------------------- */

/* The visible part of an edge between two parameters, 0 to 1. */
static double visible_share(const struct map *map, uint32_t edge, double from,
                            double to) {
  double share = 0;
  if (map->edge_state[edge] != MAP_MIXED)
    return map->edge_state[edge] == MAP_VISIBLE ? to - from : 0;
  for (size_t m = 0; m < map->mixed.count; m++) {
    const struct map_mixed *mixed = &map->mixed.item[m];
    if (mixed->edge != edge)
      continue;
    for (uint32_t i = 0; i < mixed->count; i++) {
      const struct map_interval *part =
          &map->interval.item[mixed->interval + i];
      double t0 = fmax(from, ratio_to_double(part->t0));
      double t1 = fmin(to, ratio_to_double(part->t1));
      share += fmax(0, t1 - t0);
    }
  }
  return share;
}

/* What is drawn wrong of an edge that is visible in [t0, t1] and [t2, t3]. */
static double wrong_share(const struct map *map, uint32_t edge, double t0,
                          double t1, double t2, double t3) {
  double right =
      visible_share(map, edge, t0, t1) + visible_share(map, edge, t2, t3);
  return t1 - t0 + t3 - t2 - right + (visible_share(map, edge, 0, 1) - right);
}

/* The triangle's sides come after the rectangle's four: from (15, 15) to (25,
 * 25) it is seen up to the middle, from (25, 25) to (30, 10) all along, from
 * (30, 10) to (15, 15) for a third and again after the middle. */
static double wrong_strokes(int lines) {
  struct sheet sheet;
  struct map map;
  double wrong = 0;
  solve_scene(&solver_zbuffer, &pixels_pierced_rectangle, lines, 0, &sheet,
              &map);
  assert_int_equal(map.edge_count, 7);
  for (uint32_t e = 0; e < 7; e++) {
    const struct sheet_edge *edge = &sheet.edge.item[e];
    struct geom_point p = sheet.point.item[edge->point[0]];
    struct geom_point q = sheet.point.item[edge->point[1]];
    int low = p.y < q.y ? p.y : q.y;
    int high = p.y < q.y ? q.y : p.y;
    if (e < 4 || low + high == 3 * PIXELS_UNIT)
      assert_true(visible_share(&map, e, 0, 1) > 0.9);
    else if (low == -PIXELS_UNIT) /* 15 to 25 */
      wrong += p.y == low ? wrong_share(&map, e, 0, 0.5, 1, 1)
                          : wrong_share(&map, e, 0.5, 1, 1, 1);
    else if (high == -PIXELS_UNIT) /* 10 to 15 */
      wrong += p.y == low ? wrong_share(&map, e, 0, 1 / 3., 0.5, 1)
                          : wrong_share(&map, e, 0, 0.5, 2 / 3., 1);
  }
  map_fini(&map);
  exact_sheet_fini(&sheet);
  return wrong;
}

static void wrong_ink_falls_with_the_lines(void **state) {
  (void)state;
  assert_true(wrong_strokes(64) < 0.4);
  assert_true(wrong_strokes(512) < 0.05);
  assert_true(wrong_strokes(4096) < 0.0063);
}

static void wrong_area_falls_with_the_lines(void **state) {
  static const int lines[] = {33, 257, 2049};
  static const double bound[] = {16, 2, 0.25};
  (void)state;
  for (int i = 0; i < 3; i++) {
    struct sheet sheet;
    struct map map;
    solve_scene(&solver_scanline_zbuffer, &pixels_pierced_rectangle, lines[i],
                0, &sheet, &map);
    assert_true(fabs(face_area(&map, 0) - 275) < bound[i]);
    assert_true(fabs(face_area(&map, 1) - 175 / 3.) < bound[i]);
    map_fini(&map);
    exact_sheet_fini(&sheet);
  }
}

/* Edges on a face and edges that two faces share are seen whole, those behind
 * a face are not seen, wires are judged like edges. */
static void edges_are_seen_where_they_touch_and_not_behind(void **state) {
  const struct pixels_scene scene = {
      4,
      {{4, {{2, 2, 1}, {30, 2, 5}, {30, 30, 5}, {2, 30, 1}}},
       {3, {{8, 8, 20}, {22, 8, 20}, {15, 22, 20}}},
       {3, {{10, 10, 0}, {20, 10, 0}, {15, 18, 0}}},
       {3, {{2, 4, 1}, {9, 6, 2}, {2, 6, 1}}}}};
  struct sheet sheet;
  struct map map;
  (void)state;
  pixels_sheet(&sheet, &scene);
  for (size_t e = 10; e < 13; e++) { /* face 3 as wires on face 0 */
    sheet.edge.item[e].edge_class = RECTO_EDGE_WIRE;
    sheet.edge.item[e].triangle[0] = SHEET_NONE;
  }
  sheet.triangle.count--;
  map_init(&map);
  const struct solver_request request = {
      .edges = true, .threads = 1, .resolution = FINE};
  assert_int_equal(solver_zbuffer.solve(&sheet, &request, &map, NULL, NULL),
                   RECTO_OK);
  assert_int_equal(map.edge_count, 13);
  for (uint32_t e = 0; e < 13; e++)
    assert_int_equal(map.edge_state[e],
                     e >= 7 && e < 10 ? MAP_HIDDEN : MAP_VISIBLE);
  assert_null(map.fragment.item);
  map_fini(&map);
  exact_sheet_fini(&sheet);
}

static void outlines_and_points_are_not_followed(void **state) {
  struct sheet sheet;
  struct map map;
  const struct solver_request request = {
      .edges = true, .threads = 1, .resolution = 32};
  (void)state;
  pixels_sheet(&sheet, &pixels_pierced_rectangle);
  sheet.edge.item[1].edge_class = 0;
  sheet.edge.item[2].point[1] = sheet.edge.item[2].point[0];
  map_init(&map);
  assert_int_equal(solver_zbuffer.solve(&sheet, &request, &map, NULL, NULL),
                   RECTO_OK);
  assert_int_equal(map.edge_state[0], MAP_VISIBLE);
  assert_int_equal(map.edge_state[1], MAP_HIDDEN);
  assert_int_equal(map.edge_state[2], MAP_HIDDEN);
  map_fini(&map);
  exact_sheet_fini(&sheet);
}

/* A dome of triangles, steeper and steeper towards its rim: near the rim the
 * centres of pixels see facets further in, which are nearer. */
static void outline_that_curves_away_has_no_gaps(void **state) {
  enum { RINGS = 12, AROUND = 24 };
  struct sheet sheet;
  int at[RINGS + 1][AROUND][3];
  (void)state;
  exact_sheet_init(&sheet);
  sheet.camera.page_mm[0] = sheet.camera.page_mm[1] = PIXELS_SIDE;
  for (int r = 0; r <= RINGS; r++)
    for (int a = 0; a < AROUND; a++) {
      double up = acos(-1) / 2 * r / RINGS, round = 2 * acos(-1) * a / AROUND;
      at[r][a][0] = (int)(14 * PIXELS_UNIT * cos(up) * cos(round));
      at[r][a][1] = (int)(14 * PIXELS_UNIT * cos(up) * sin(round));
      at[r][a][2] = (int)(14 * PIXELS_UNIT * sin(up));
    }
  for (int r = 0; r < RINGS; r++)
    for (int a = 0; a < AROUND; a++) {
      int next = (a + 1) % AROUND, corner[4][3];
      memcpy(corner[0], at[r][a], sizeof corner[0]);
      memcpy(corner[1], at[r][next], sizeof corner[0]);
      memcpy(corner[2], at[r + 1][next], sizeof corner[0]);
      memcpy(corner[3], at[r + 1][a], sizeof corner[0]);
      exact_add_face(&sheet, (const int(*)[3])corner, 3, 1);
      memcpy(corner[1], corner[0], sizeof corner[0]);
      if (r + 1 < RINGS)
        exact_add_face(&sheet, (const int(*)[3]) & corner[1], 3, 1);
    }
  for (int lines = 16; lines <= 1024; lines *= 2) {
    const struct solver_request request = {
        .edges = true, .threads = 1, .resolution = lines};
    struct map map;
    map_init(&map);
    assert_int_equal(solver_zbuffer.solve(&sheet, &request, &map, NULL, NULL),
                     RECTO_OK);
    for (size_t e = 0; e < sheet.edge.count; e++)
      if (sheet.edge.item[e].edge_class == RECTO_EDGE_BORDER)
        assert_int_equal(map.edge_state[e], MAP_VISIBLE);
    map_fini(&map);
  }
  exact_sheet_fini(&sheet);
}

/* The edges turned round in number: each keeps what is seen of it. */
static void order_of_the_edges_does_not_matter(void **state) {
  const struct solver_request request = {
      .edges = true, .threads = 1, .resolution = 100};
  (void)state;
  for (uint64_t seed = 500; seed < 520; seed++) {
    struct pixels_scene scene;
    struct sheet sheet;
    struct map map[2];
    size_t count;
    pixels_random_scene(&scene, seed);
    pixels_sheet(&sheet, &scene);
    count = sheet.edge.count;
    for (int turn = 0; turn < 2; turn++) {
      map_init(&map[turn]);
      assert_int_equal(
          solver_zbuffer.solve(&sheet, &request, &map[turn], NULL, NULL),
          RECTO_OK);
      for (size_t e = 0; e < count / 2; e++) {
        struct sheet_edge swap = sheet.edge.item[e];
        sheet.edge.item[e] = sheet.edge.item[count - 1 - e];
        sheet.edge.item[count - 1 - e] = swap;
      }
    }
    for (size_t e = 0; e < count; e++) {
      uint32_t there = (uint32_t)e, here = (uint32_t)(count - 1 - e);
      assert_int_equal(map[0].edge_state[e], map[1].edge_state[here]);
      for (int part = 0; part < 8; part++)
        assert_true(
            visible_share(&map[0], there, part / 8., part / 8. + 0.125) ==
            visible_share(&map[1], here, part / 8., part / 8. + 0.125));
    }
    map_fini(&map[0]);
    map_fini(&map[1]);
    exact_sheet_fini(&sheet);
  }
}

static void intersections_are_drawn_on_request(void **state) {
  struct sheet sheet;
  struct map map;
  const struct solver_request request = {
      .edges = true, .intersections = true, .threads = 1, .resolution = 512};
  double length = 0;
  (void)state;
  pixels_sheet(&sheet, &pixels_pierced_rectangle);
  map_init(&map);
  assert_int_equal(
      solver_scanline_zbuffer.solve(&sheet, &request, &map, NULL, NULL),
      RECTO_OK);
  assert_true(map.edge_count > 7);
  for (uint32_t e = 7; e < map.edge_count; e++) {
    const struct sheet_edge *edge = &sheet.edge.item[e];
    struct geom_point p = sheet.point.item[edge->point[0]];
    struct geom_point q = sheet.point.item[edge->point[1]];
    assert_int_equal(edge->edge_class, RECTO_EDGE_INTERSECTION);
    length += visible_share(&map, e, 0, 1) * hypot(p.x - q.x, p.y - q.y) /
              PIXELS_UNIT;
  }
  /* From (20, 20) to (45/2, 25/2), seen all along. */
  assert_true(fabs(length - hypot(2.5, 7.5)) < 0.01);
  map_fini(&map);
  exact_sheet_fini(&sheet);
}

/* ---- Conversation -------------------------------------------------------- */

/* Between two lines of a folded frame that share memory lie as many as
 * required; a frame with fewer lines stays as it is. */
static void a_folded_frame_uses_lines_again(void **state) {
  struct sheet sheet;
  struct raster raster;
  (void)state;
  pixels_sheet(&sheet, &pixels_pierced_rectangle);
  assert_int_equal(raster_init(&raster, &sheet, 100, 0, true, NULL), RECTO_OK);
  raster_make_ring(&raster, 101);
  assert_int_equal(raster_row(&raster, 99), 99 * (size_t)raster.grid.columns);
  raster_make_ring(&raster, 17);
  for (int32_t line = 0; line < 68; line++) {
    assert_int_equal(raster_row(&raster, line + 32), raster_row(&raster, line));
    for (int32_t other = 1; other < 17; other++)
      assert_int_not_equal(raster_row(&raster, line + other),
                           raster_row(&raster, line));
  }
  raster_fini(&raster);
  exact_sheet_fini(&sheet);
}

static void scan_line_holds_one_line(void **state) {
  struct sheet sheet;
  (void)state;
  pixels_sheet(&sheet, &pixels_pierced_rectangle);
  for (int lines = 64; lines <= 4096; lines *= 8) {
    struct raster raster;
    assert_int_equal(raster_init(&raster, &sheet, lines, 0, false, NULL),
                     RECTO_OK);
    assert_int_equal(raster.kept, 1);
    for (int line = 0; line < lines; line += 7)
      assert_int_equal(raster_row(&raster, line), 0);
    raster_fini(&raster);
  }
  exact_sheet_fini(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(pierced_rectangle_is_right_in_every_pixel),
      cmocka_unit_test(two_rectangles_are_right_in_every_pixel),
      cmocka_unit_test(random_scenes_are_right_in_every_pixel),
      cmocka_unit_test(scan_line_agrees_at_every_depth),
      cmocka_unit_test(ties_of_rounded_depths_keep_the_earlier_face),
      cmocka_unit_test(active_pairs_are_as_listed),
      cmocka_unit_test(depths_of_line_15_fall_by_three_quarters),
      cmocka_unit_test(integer_depths_fight_where_their_bits_say),
      cmocka_unit_test(float64_distinguishes_single_units),
      cmocka_unit_test(steep_faces_are_decided_at_the_centre),
      cmocka_unit_test(steep_faces_meet_others_exactly),
      cmocka_unit_test(steep_faces_keep_within_their_depths),
      cmocka_unit_test(needles_cover_the_pixels_whose_centres_they_hold),
      cmocka_unit_test(removed_backs_leave_what_is_behind),
      cmocka_unit_test(fragments_cover_the_pixels_seen),
      cmocka_unit_test(fragments_are_loops_in_canonical_order),
      cmocka_unit_test(scan_line_draws_the_same_map),
      cmocka_unit_test(wrong_ink_falls_with_the_lines),
      cmocka_unit_test(wrong_area_falls_with_the_lines),
      cmocka_unit_test(edges_are_seen_where_they_touch_and_not_behind),
      cmocka_unit_test(outlines_and_points_are_not_followed),
      cmocka_unit_test(outline_that_curves_away_has_no_gaps),
      cmocka_unit_test(order_of_the_edges_does_not_matter),
      cmocka_unit_test(intersections_are_drawn_on_request),
      cmocka_unit_test(a_folded_frame_uses_lines_again),
      cmocka_unit_test(scan_line_holds_one_line),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
