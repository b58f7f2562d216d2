/* test_hpgl.c - what the HPGL writer promises to a plotter. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "backends/device.h"
#include "backends/writer.h"
#include "tests/hpgl_reader.h"
#include "tests/maker.h"
#include "tests/scenes/random.h"

/* ---- A drawing, and what comes back of it -------------------------------- */

struct fixture {
  struct drawing drawing;
  struct writer_options options;
  struct stream *stream;
  const char *text;
  struct hpgl back;
  int warnings;
  char warning[200]; /* the last */
};

static void take_warning(void *user, const char *file, unsigned long line,
                         const char *text) {
  struct fixture *fixture = user;
  assert_string_equal(file, "");
  assert_int_equal(line, 0);
  fixture->warnings++;
  snprintf(fixture->warning, sizeof fixture->warning, "%s", text);
}

static void begin(struct fixture *f, double width_mm, double height_mm) {
  *f = (struct fixture){.options = {.warning = take_warning, .user = f}};
  maker_page(&f->drawing, width_mm, height_mm);
}

/* Writes the drawing and reads it back. */
static void plot(struct fixture *f) {
  recto_error error;
  size_t count;
  assert_int_equal(stream_open_memory(&f->stream, &error), RECTO_OK);
  assert_int_equal(
      writer_hpgl.write(&f->drawing, &f->options, f->stream, &error), RECTO_OK);
  f->text = stream_memory(f->stream, &count);
  hpgl_read(&f->back, f->text, count);
  assert_string_equal(f->back.fault, "");
}

static void end(struct fixture *f) {
  hpgl_free(&f->back);
  stream_discard(f->stream);
  drawing_fini(&f->drawing);
}

static void assert_refused(struct fixture *f, const char *text) {
  recto_error error;
  struct stream *stream;
  assert_int_equal(stream_open_memory(&stream, &error), RECTO_OK);
  assert_int_equal(writer_hpgl.write(&f->drawing, &f->options, stream, &error),
                   RECTO_ERROR_ARGUMENT);
  assert_non_null(strstr(error.text, text));
  stream_discard(stream);
}

static void assert_point(const struct fixture *f, size_t stroke, size_t index,
                         int x, int y) {
  assert_in_range(stroke, 0, f->back.stroke.count - 1);
  assert_in_range(index, 0, f->back.stroke.item[stroke].count - 1);
  const struct hpgl_point *point =
      &f->back.point.item[f->back.stroke.item[stroke].point + index];
  assert_int_equal(point->x, x);
  assert_int_equal(point->y, y);
}

/* ---- The dialect --------------------------------------------------------- */

static void a_plot_is_written_in_the_common_dialect(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 100, 100);
  uint32_t first = maker_layer(&f.drawing, 1, 0.3, 0);
  uint32_t second = maker_layer(&f.drawing, 2, 0.3, 0);
  maker_line(&f.drawing, first, 1, 2, 3, 4);
  maker_box(&f.drawing, second, 10, 10, 20, 20);
  f.options.velocity = 12;
  plot(&f);
  assert_string_equal(f.text, "IN;\nDF;\nVS12;\nSP1;\nPU40,80;\nPD120,160;\n"
                              "PU;\nSP2;\nPU400,400;\n"
                              "PD800,400,800,800,400,800,400,400;\n"
                              "PU;\nSP0;\nIN;\n");
  assert_int_equal(f.warnings, 0);
  end(&f);
}

static void an_empty_drawing_takes_no_pen(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 100, 100);
  maker_layer(&f.drawing, 1, 0.3, 0);
  plot(&f);
  assert_string_equal(f.text, "IN;\nDF;\nPU;\nSP0;\nIN;\n");
  end(&f);
}

static void long_strokes_are_cut_into_commands_of_100_points(void **state) {
  (void)state;
  struct fixture f;
  double xy[2 * 1001];
  begin(&f, 100, 100);
  for (int i = 0; i <= 1000; i++) {
    xy[2 * i] = i * 0.1;
    xy[2 * i + 1] = 10 + i % 2;
  }
  maker_stroke(&f.drawing, maker_layer(&f.drawing, 1, 0.3, 0), xy, 1001, false);
  plot(&f);
  assert_int_equal(f.back.longest, 100);
  assert_int_equal(f.back.stroke.count, 1);
  assert_int_equal(f.back.stroke.item[0].count, 1001);
  end(&f);
}

static void points_that_repeat_and_strokes_that_vanish_go(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 100, 100);
  uint32_t layer = maker_layer(&f.drawing, 1, 0.3, 0);
  maker_line(&f.drawing, layer, 5, 5, 5.001, 5.001);
  maker_stroke(&f.drawing, layer, (double[]){7, 7, 7, 7}, 2, true);
  maker_stroke(&f.drawing, layer, (double[]){7, 7}, 1, false);
  maker_stroke(&f.drawing, layer,
               (double[]){1, 1, 1.001, 1, 2, 2, 2, 2, 2.002, 2.003}, 5, false);
  plot(&f);
  assert_int_equal(f.back.stroke.count, 1);
  assert_int_equal(f.back.stroke.item[0].count, 2);
  assert_point(&f, 0, 0, 40, 40);
  assert_point(&f, 0, 1, 80, 80);
  assert_int_equal(f.warnings, 0);
  end(&f);
}

/* ---- Pens ---------------------------------------------------------------- */

static void pens_change_only_where_they_must(void **state) {
  (void)state;
  struct fixture f;
  static const unsigned pens[] = {1, 1, 3, 2, 2, 1};
  begin(&f, 100, 100);
  for (size_t i = 0; i < 6; i++) {
    uint32_t layer = maker_layer(&f.drawing, pens[i], 0.3, 0);
    if (pens[i] != 3)
      maker_line(&f.drawing, layer, 10, 10, 20, 20);
  }
  plot(&f);
  assert_int_equal(f.back.pen.count, 3);
  assert_int_equal(f.back.pen.item[0], 1);
  assert_int_equal(f.back.pen.item[1], 2);
  assert_int_equal(f.back.pen.item[2], 1);
  end(&f);
}

static void layers_come_in_their_order_whatever_the_strokes(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 100, 100);
  uint32_t first = maker_layer(&f.drawing, 1, 0.3, 0);
  uint32_t second = maker_layer(&f.drawing, 2, 0.3, 0);
  maker_line(&f.drawing, second, 1, 1, 2, 2);
  maker_line(&f.drawing, first, 3, 3, 4, 4);
  maker_line(&f.drawing, second, 5, 5, 6, 6);
  plot(&f);
  assert_int_equal(f.back.stroke.count, 3);
  assert_int_equal(f.back.stroke.item[0].pen, 1);
  assert_int_equal(f.back.stroke.item[1].pen, 2);
  assert_point(&f, 1, 0, 40, 40);
  assert_point(&f, 2, 0, 200, 200);
  end(&f);
}

static void pens_past_the_carousel_are_dealt_anew_with_a_word(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 297, 210);
  f.options.device = "hp7475a";
  for (unsigned pen = 6; pen <= 8; pen++)
    maker_line(&f.drawing, maker_layer(&f.drawing, pen, 0.3, 0), 50, 50, 60,
               60);
  plot(&f);
  assert_int_equal(f.back.pen.item[0], 6);
  assert_int_equal(f.back.pen.item[1], 1);
  assert_int_equal(f.back.pen.item[2], 2);
  assert_int_equal(f.warnings, 1);
  assert_non_null(strstr(f.warning, "2 layers"));
  end(&f);
}

static void fills_are_left_out_with_a_word(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 100, 100);
  uint32_t layer = maker_layer(&f.drawing, 1, 0.3, 0);
  maker_fill(&f.drawing, layer, 0xff0000, (double[]){1, 1, 9, 1, 9, 9}, 3);
  plot(&f);
  assert_int_equal(f.back.stroke.count, 0);
  assert_int_equal(f.warnings, 1);
  assert_non_null(strstr(f.warning, "1 fill "));
  end(&f);
}

/* ---- Options ------------------------------------------------------------- */

static void an_unknown_device_is_refused_with_the_known_ones(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 100, 100);
  f.options.device = "hp9999";
  assert_refused(&f, "hp9999");
  for (size_t i = 0; device_name(i); i++)
    assert_refused(&f, device_name(i));
  end(&f);
}

static void a_speed_that_makes_no_sense_is_refused(void **state) {
  (void)state;
  static const double speed[] = {-1, 0.5, 128, NAN, INFINITY};
  struct fixture f;
  begin(&f, 100, 100);
  for (size_t i = 0; i < 5; i++) {
    f.options.velocity = speed[i];
    assert_refused(&f, "cm/s");
  }
  end(&f);
}

static void nobody_needs_to_listen_to_warnings(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 100, 100);
  f.options.warning = NULL;
  maker_line(&f.drawing, maker_layer(&f.drawing, 1, 0.3, 0), 50, 50, 200, 50);
  plot(&f);
  assert_point(&f, 0, 1, 4000, 2000);
  end(&f);
}

/* ---- Devices ------------------------------------------------------------- */

static void a_length_is_true_on_every_device(void **state) {
  (void)state;
  for (size_t i = 0; device_name(i); i++) {
    struct fixture f;
    begin(&f, 297, 210);
    f.options.device = device_name(i);
    uint32_t layer = maker_layer(&f.drawing, 1, 0.3, 0);
    maker_line(&f.drawing, layer, 60, 60, 160, 60);
    maker_line(&f.drawing, layer, 60, 60, 60, 160);
    plot(&f);
    double unit = strncmp(device_name(i), "hp", 2) == 0 ? 0.02488 : 0.025;
    const struct hpgl_point *point = f.back.point.item;
    assert_int_equal(f.back.stroke.count, 2);
    assert_in_range(point[1].x - point[0].x, (uintmax_t)(100 / unit),
                    (uintmax_t)(100 / unit) + 1);
    assert_int_equal(point[1].y, point[0].y);
    assert_in_range(point[3].y - point[2].y, (uintmax_t)(100 / unit),
                    (uintmax_t)(100 / unit) + 1);
    assert_int_equal(point[3].x, point[2].x);
    end(&f);
  }
}

/* The middle of the page is the middle of HP's frame P1 P2. */
static void the_hp7475a_draws_the_middle_in_the_middle(void **state) {
  (void)state;
  static const struct {
    double width_mm, height_mm;
    int x, y;
  } paper[] = {{297, 210, 5603, 4121},
               {210, 297, 5603, 4121},
               {420, 297, 7770, 5602},
               {8.5 * 25.4, 11 * 25.4, 5250, 4196},
               {17 * 25.4, 11 * 25.4, 8122, 5259}};
  for (size_t i = 0; i < 5; i++) {
    struct fixture f;
    begin(&f, paper[i].width_mm, paper[i].height_mm);
    f.options.device = "hp7475a";
    maker_line(&f.drawing, maker_layer(&f.drawing, 1, 0.3, 0),
               paper[i].width_mm / 2, paper[i].height_mm / 2, 50, 50);
    plot(&f);
    assert_point(&f, 0, 0, paper[i].x, paper[i].y);
    end(&f);
  }
}

/* Up on the page is left on the plotter, right is up. */
static void a_portrait_page_is_turned_on_its_left_side(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 210, 297);
  f.options.device = "dxy";
  uint32_t layer = maker_layer(&f.drawing, 1, 0.3, 0);
  maker_stroke(&f.drawing, layer, (double[]){0, 297, 0, 0, 210, 0}, 3, false);
  plot(&f);
  assert_point(&f, 0, 0, 0, 0);
  assert_point(&f, 0, 1, 11880, 0);
  assert_point(&f, 0, 2, 11880, 8400);
  assert_int_equal(f.warnings, 0);
  end(&f);
}

static void the_smallest_paper_that_holds_the_page_is_taken(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 300, 200);
  f.options.device = "dxy";
  uint32_t layer = maker_layer(&f.drawing, 1, 0.3, 0);
  maker_line(&f.drawing, layer, 0, 0, 300, 200);
  plot(&f);
  assert_point(&f, 0, 0, 0, 0);
  assert_point(&f, 0, 1, 12000, 8000);
  assert_int_equal(f.warnings, 0);
  end(&f);
}

static void a_page_that_no_paper_holds_is_clipped_on_the_largest(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 1189, 841);
  f.options.device = "dxy";
  uint32_t layer = maker_layer(&f.drawing, 1, 0.3, 0);
  maker_line(&f.drawing, layer, 0, 100, 1189, 100);
  plot(&f);
  assert_point(&f, 0, 1, 16800, 4000);
  assert_int_equal(f.warnings, 1);
  end(&f);
}

static void a_drum_has_its_origin_in_the_middle(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 600, 400);
  f.options.device = "drum";
  maker_line(&f.drawing, maker_layer(&f.drawing, 1, 0.3, 0), 0, 0, 600, 400);
  plot(&f);
  assert_point(&f, 0, 0, -12000, -8000);
  assert_point(&f, 0, 1, 12000, 8000);
  end(&f);
}

/* ---- Clipping ------------------------------------------------------------ */

static void a_stroke_that_leaves_and_returns_is_two(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 100, 100);
  uint32_t layer = maker_layer(&f.drawing, 1, 0.3, 0);
  maker_stroke(&f.drawing, layer, (double[]){50, 10, 150, 10, 150, 30, 50, 30},
               4, false);
  maker_line(&f.drawing, layer, 110, 0, 110, 100);
  maker_line(&f.drawing, layer, 10, 10, 20, 20);
  plot(&f);
  assert_int_equal(f.back.stroke.count, 3);
  assert_point(&f, 0, 0, 2000, 400);
  assert_point(&f, 0, 1, 4000, 400);
  assert_point(&f, 1, 0, 4000, 1200);
  assert_point(&f, 1, 1, 2000, 1200);
  assert_int_equal(f.warnings, 1);
  assert_non_null(strstr(f.warning, "2 strokes clipped"));
  end(&f);
}

/* Wherever the loop begins: what is left of a box whose right side is outside
 * is one stroke of three lines. */
static void a_clipped_loop_is_not_cut_where_it_begins(void **state) {
  (void)state;
  static const double box[] = {50, 20, 120, 20, 120, 80, 50, 80};
  for (int turn = 0; turn < 4; turn++) {
    struct fixture f;
    double xy[8];
    begin(&f, 100, 100);
    for (int i = 0; i < 8; i++)
      xy[i] = box[(i + 2 * turn) % 8];
    maker_stroke(&f.drawing, maker_layer(&f.drawing, 1, 0.3, 0), xy, 4, true);
    plot(&f);
    assert_int_equal(f.back.stroke.count, 1);
    assert_int_equal(f.back.stroke.item[0].count, 4);
    assert_point(&f, 0, 1, 2000, 3200);
    assert_point(&f, 0, 2, 2000, 800);
    end(&f);
  }
}

static void a_line_across_the_whole_area_keeps_its_middle(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 100, 100);
  maker_line(&f.drawing, maker_layer(&f.drawing, 1, 0.3, 0), -100, -100, 200,
             200);
  plot(&f);
  assert_int_equal(f.back.stroke.count, 1);
  assert_point(&f, 0, 0, 0, 0);
  assert_point(&f, 0, 1, 4000, 4000);
  end(&f);
}

/* 100.01 mm are 4000.4 units: the edge rounds into the area. */
static void a_frame_around_the_page_is_all_there(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 100.01, 100.01);
  maker_box(&f.drawing, maker_layer(&f.drawing, 1, 0.3, 0), 0, 0, 100.01,
            100.01);
  plot(&f);
  assert_int_equal(f.warnings, 0);
  assert_int_equal(f.back.stroke.count, 1);
  assert_int_equal(f.back.stroke.item[0].count, 5);
  assert_point(&f, 0, 2, 4000, 4000);
  end(&f);
}

/* ---- Any drawing --------------------------------------------------------- */

/* Where the page's point ought to be, by the words of device.h. */
static void expect(const struct device_placement *place, double height_mm,
                   const struct drawing_point *point, double *x, double *y) {
  *x = place->origin_x +
       (place->turned ? height_mm - point->y : point->x) / place->unit_mm;
  *y = place->origin_y + (place->turned ? point->x : point->y) / place->unit_mm;
}

static double distance_to_line(double x, double y, const struct hpgl_point *a,
                               const struct hpgl_point *b) {
  double run_x = b->x - a->x, run_y = b->y - a->y;
  double square = run_x * run_x + run_y * run_y;
  double share = ((x - a->x) * run_x + (y - a->y) * run_y) / square;
  share = fmin(fmax(share, 0), 1);
  return hypot(a->x + share * run_x - x, a->y + share * run_y - y);
}

/* How far the point is from all ink, in units. */
static double distance_to_ink(const struct hpgl *hpgl, double x, double y) {
  double best = INFINITY;
  for (size_t i = 0; i < hpgl->stroke.count; i++) {
    const struct hpgl_point *p = hpgl->point.item + hpgl->stroke.item[i].point;
    for (uint32_t k = 1; k < hpgl->stroke.item[i].count; k++)
      best = fmin(best, distance_to_line(x, y, &p[k - 1], &p[k]));
  }
  return best;
}

static void make_random(struct fixture *f, struct random *random,
                        double overhang_mm) {
  double width = random_int(random, 40, 600);
  double height = random_int(random, 40, 600);
  begin(f, width, height);
  for (unsigned pen = 1; pen <= 3; pen++)
    maker_layer(&f->drawing, pen, 0.3, 0);
  int strokes = random_int(random, 1, 12);
  for (int i = 0; i < strokes; i++) {
    double xy[2 * 260];
    int count = random_int(random, 0, 9) == 0 ? 260 : random_int(random, 1, 9);
    for (int k = 0; k < count; k++) {
      xy[2 * k] = random_between(random, -overhang_mm, width + overhang_mm);
      xy[2 * k + 1] =
          random_between(random, -overhang_mm, height + overhang_mm);
    }
    maker_stroke(&f->drawing, random_below(random, 3), xy, (uint32_t)count,
                 random_below(random, 2));
  }
}

static void assert_inside(const struct hpgl *hpgl,
                          const struct device_placement *place) {
  for (size_t i = 0; i < hpgl->point.count; i++) {
    assert_true(hpgl->point.item[i].x >= place->x0);
    assert_true(hpgl->point.item[i].x <= place->x1);
    assert_true(hpgl->point.item[i].y >= place->y0);
    assert_true(hpgl->point.item[i].y <= place->y1);
  }
}

/* Places along every stroke, as far as they are in the area: all have ink. */
static void assert_covered(const struct fixture *f,
                           const struct device_placement *place) {
  for (size_t i = 0; i < f->drawing.stroke.count; i++) {
    const struct drawing_stroke *stroke = &f->drawing.stroke.item[i];
    const struct drawing_point *p = f->drawing.point.item + stroke->point;
    uint32_t lines = stroke->count - (stroke->closed ? 0 : 1);
    for (uint32_t k = 0; stroke->count > 1 && k < lines; k += 7) {
      double ax, ay, bx, by;
      expect(place, f->drawing.height_mm, &p[k], &ax, &ay);
      expect(place, f->drawing.height_mm, &p[(k + 1) % stroke->count], &bx,
             &by);
      for (int part = 0; part <= 5; part++) {
        double x = ax + (bx - ax) * part / 5, y = ay + (by - ay) * part / 5;
        if (x >= place->x0 && x <= place->x1 && y >= place->y0 &&
            y <= place->y1)
          assert_true(distance_to_ink(&f->back, x, y) <= 1);
      }
    }
  }
}

static void no_drawing_leaves_the_area_or_the_cap(void **state) {
  (void)state;
  struct random random = {7};
  size_t clipped = 0;
  for (int i = 0; i < 400; i++) {
    struct fixture f;
    struct device_placement place;
    make_random(&f, &random, i % 2 ? 300 : 3);
    f.options.device = device_name((size_t)i % 5);
    device_place(device_by_name(f.options.device), f.drawing.width_mm,
                 f.drawing.height_mm, &place);
    plot(&f);
    assert_inside(&f.back, &place);
    assert_in_range(f.back.longest, 0, 100);
    assert_covered(&f, &place);
    assert_in_range(f.warnings, 0, 1);
    clipped += (size_t)f.warnings;
    end(&f);
  }
  assert_in_range(clipped, 100, 399);
}

/* Within the page, what comes back is the drawing: the same strokes, in
 * order, every point within half a unit (a unit is asked for). */
static void every_stroke_comes_back_within_a_unit(void **state) {
  (void)state;
  struct random random = {11};
  for (int i = 0; i < 200; i++) {
    struct fixture f;
    size_t back = 0;
    make_random(&f, &random, 0);
    plot(&f);
    for (uint32_t layer = 0; layer < 3; layer++) {
      for (size_t s = 0; s < f.drawing.stroke.count; s++) {
        const struct drawing_stroke *stroke = &f.drawing.stroke.item[s];
        if (stroke->layer != layer || stroke->count < 2)
          continue;
        assert_true(back < f.back.stroke.count);
        const struct hpgl_stroke *found = &f.back.stroke.item[back++];
        assert_int_equal(found->pen, layer + 1);
        assert_int_equal(found->count, stroke->count + stroke->closed);
        for (uint32_t k = 0; k < found->count; k++) {
          const struct drawing_point *p =
              &f.drawing.point.item[stroke->point + k % stroke->count];
          const struct hpgl_point *q = &f.back.point.item[found->point + k];
          assert_true(fabs(p->x * 40 - q->x) <= 0.51);
          assert_true(fabs(p->y * 40 - q->y) <= 0.51);
        }
      }
    }
    assert_int_equal(back, f.back.stroke.count);
    assert_int_equal(f.warnings, 0);
    end(&f);
  }
}

static void the_same_drawing_gives_the_same_bytes(void **state) {
  (void)state;
  struct random first = {3}, second = {3};
  struct fixture f, g;
  make_random(&f, &first, 20);
  make_random(&g, &second, 20);
  plot(&f);
  plot(&g);
  assert_string_equal(f.text, g.text);
  end(&f);
  end(&g);
}

/* ---- A full disk --------------------------------------------------------- */

static void a_full_disk_leaves_no_plot(void **state) {
  (void)state;
  static const char path[] = "test_hpgl.tmp.hpgl";
  struct fixture f;
  double xy[2 * 20000];
  begin(&f, 297, 210);
  for (int i = 0; i < 20000; i++) {
    xy[2 * i] = 10 + 0.013 * i;
    xy[2 * i + 1] = 100 + i % 7;
  }
  maker_stroke(&f.drawing, maker_layer(&f.drawing, 1, 0.3, 0), xy, 20000,
               false);
  recto_status status = RECTO_ERROR_IO;
  unsigned long n = 0;
  while (status != RECTO_OK && ++n < 100) {
    recto_error error;
    struct stream *stream;
    assert_int_equal(stream_open(&stream, path, &error), RECTO_OK);
    stream_fail_after(n);
    assert_int_equal(writer_hpgl.write(&f.drawing, &f.options, stream, &error),
                     RECTO_OK);
    status = stream_finish(stream, &error);
    stream_fail_after(0);
    if (status != RECTO_OK) {
      assert_int_equal(status, RECTO_ERROR_IO);
      assert_int_not_equal(access(path, F_OK), 0);
    }
  }
  /* The drawing takes more than one write, and one that does not fail. */
  assert_in_range(n, 3, 99);
  assert_int_equal(access(path, F_OK), 0);
  unlink(path);
  end(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_plot_is_written_in_the_common_dialect),
      cmocka_unit_test(an_empty_drawing_takes_no_pen),
      cmocka_unit_test(long_strokes_are_cut_into_commands_of_100_points),
      cmocka_unit_test(points_that_repeat_and_strokes_that_vanish_go),
      cmocka_unit_test(pens_change_only_where_they_must),
      cmocka_unit_test(layers_come_in_their_order_whatever_the_strokes),
      cmocka_unit_test(pens_past_the_carousel_are_dealt_anew_with_a_word),
      cmocka_unit_test(fills_are_left_out_with_a_word),
      cmocka_unit_test(an_unknown_device_is_refused_with_the_known_ones),
      cmocka_unit_test(a_speed_that_makes_no_sense_is_refused),
      cmocka_unit_test(nobody_needs_to_listen_to_warnings),
      cmocka_unit_test(a_length_is_true_on_every_device),
      cmocka_unit_test(the_hp7475a_draws_the_middle_in_the_middle),
      cmocka_unit_test(a_portrait_page_is_turned_on_its_left_side),
      cmocka_unit_test(the_smallest_paper_that_holds_the_page_is_taken),
      cmocka_unit_test(a_page_that_no_paper_holds_is_clipped_on_the_largest),
      cmocka_unit_test(a_drum_has_its_origin_in_the_middle),
      cmocka_unit_test(a_stroke_that_leaves_and_returns_is_two),
      cmocka_unit_test(a_clipped_loop_is_not_cut_where_it_begins),
      cmocka_unit_test(a_line_across_the_whole_area_keeps_its_middle),
      cmocka_unit_test(a_frame_around_the_page_is_all_there),
      cmocka_unit_test(no_drawing_leaves_the_area_or_the_cap),
      cmocka_unit_test(every_stroke_comes_back_within_a_unit),
      cmocka_unit_test(the_same_drawing_gives_the_same_bytes),
      cmocka_unit_test(a_full_disk_leaves_no_plot),
  };
  return cmocka_run_group_tests_name("hpgl", tests, NULL, NULL);
}
