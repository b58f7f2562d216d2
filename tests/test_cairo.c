/* test_cairo.c - the guarantees of the PDF, EPS, PS and PNG writers. */
#include <errno.h>
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmocka.h>

#include <cairo.h>

#include "backends/writer.h"
#include "tests/drawing_fixture.h"

/* ---- A drawing and its file ---------------------------------------------- */

struct fixture {
  struct drawing drawing;
  struct writer_options options;
  struct stream *stream;
  const char *bytes;
  size_t count;
  cairo_surface_t *picture;
};

static void begin(struct fixture *f, double width_mm, double height_mm) {
  *f = (struct fixture){0};
  drawing_fixture_page(&f->drawing, width_mm, height_mm);
}

static void write_as(struct fixture *f, const struct writer *writer) {
  recto_error error;
  stream_discard(f->stream);
  assert_int_equal(stream_open_memory(&f->stream, &error), RECTO_OK);
  assert_int_equal(writer->write(&f->drawing, &f->options, f->stream, &error),
                   RECTO_OK);
  f->bytes = stream_memory(f->stream, &f->count);
}

static void end(struct fixture *f) {
  cairo_surface_destroy(f->picture);
  stream_discard(f->stream);
  drawing_fini(&f->drawing);
}

static bool has(const struct fixture *f, const char *text) {
  size_t length = strlen(text);
  for (size_t i = 0; i + length <= f->count; i++)
    if (memcmp(f->bytes + i, text, length) == 0)
      return true;
  return false;
}

struct source {
  const struct fixture *fixture;
  size_t offset;
};

static cairo_status_t feed(void *closure, unsigned char *bytes,
                           unsigned count) {
  struct source *source = closure;
  if (source->offset + count > source->fixture->count)
    return CAIRO_STATUS_READ_ERROR;
  memcpy(bytes, source->fixture->bytes + source->offset, count);
  source->offset += count;
  return CAIRO_STATUS_SUCCESS;
}

/* Writes a PNG, and reads it. */
static void paint(struct fixture *f) {
  struct source source = {f, 0};
  write_as(f, &writer_png);
  cairo_surface_destroy(f->picture);
  f->picture = cairo_image_surface_create_from_png_stream(feed, &source);
  assert_int_equal(cairo_surface_status(f->picture), CAIRO_STATUS_SUCCESS);
}

/* The colour, 0xRRGGBB, of the pixel that holds a place on the page.  With 254
 * dots an inch, a pixel is a tenth of a millimetre. */
static uint32_t colour_at(const struct fixture *f, double x_mm, double y_mm) {
  int x = (int)floor(x_mm * 10), y = (int)floor(y_mm * 10);
  int height = cairo_image_surface_get_height(f->picture);
  assert_in_range(x, 0, cairo_image_surface_get_width(f->picture) - 1);
  assert_in_range(y, 0, height - 1);
  const unsigned char *data = cairo_image_surface_get_data(f->picture);
  uint32_t pixel;
  size_t stride = (size_t)cairo_image_surface_get_stride(f->picture);
  memcpy(&pixel, data + (size_t)(height - 1 - y) * stride + 4 * (size_t)x, 4);
  return pixel & 0xffffff;
}

static uint32_t be32(const char *bytes) {
  const unsigned char *b = (const unsigned char *)bytes;
  return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 |
         b[3];
}

/* ---- Pages --------------------------------------------------------------- */

static void a_pdf_bears_a_fixed_date(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 210, 297);
  write_as(&f, &writer_pdf);
  assert_true(has(&f, "%PDF-1.5"));
  assert_true(has(&f, "20000101000000"));
  end(&f);
}

static void postscript_bears_no_date(void **state) {
  (void)state;
  const struct writer *writer[] = {&writer_ps, &writer_eps};
  for (int i = 0; i < 2; i++) {
    struct fixture f;
    begin(&f, 210, 297);
    write_as(&f, writer[i]);
    assert_memory_equal(f.bytes, "%!PS-Adobe-3.0", 14);
    assert_true(has(&f, "\n%%EndComments\n"));
    assert_true(has(&f, "\n%%EOF\n"));
    assert_false(has(&f, "%%CreationDate"));
    end(&f);
  }
}

static void an_eps_file_says_the_page_is_its_box(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 210, 297);
  drawing_fixture_line(&f.drawing, drawing_fixture_layer(&f.drawing, 1, 0.3, 0),
                       50, 50, 60, 60);
  write_as(&f, &writer_eps);
  assert_true(has(&f, "\n%%BoundingBox: 0 0 596 842\n"
                      "%%HiResBoundingBox: 0 0 595.276 841.89\n"));
  end(&f);
}

/* 10 mm and a pen of 2 mm are 12 mm by 2 mm: 34.016 by 5.669 points. */
/* 215.9 mm are 612 points, rounding or not. */
static void whole_points_are_not_rounded_up(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 215.9, 76.2);
  write_as(&f, &writer_eps);
  assert_true(has(&f, "\n%%BoundingBox: 0 0 612 216\n"));
  write_as(&f, &writer_ps);
  assert_true(has(&f, " 612 216 0 () ()\n"));
  end(&f);
}

static void tight_leaves_the_box_of_the_ink(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 210, 297);
  drawing_fixture_line(&f.drawing, drawing_fixture_layer(&f.drawing, 1, 2, 0),
                       50, 50, 60, 50);
  f.options.tight = true;
  write_as(&f, &writer_eps);
  assert_true(has(&f, "\n%%HiResBoundingBox: 0 0 34.016 5.669\n"));
  write_as(&f, &writer_pdf);
  assert_true(has(&f, "/MediaBox [ 0 0 34.015"));
  f.options.dpi = 254;
  paint(&f);
  assert_in_range(cairo_image_surface_get_width(f.picture), 120, 121);
  assert_in_range(cairo_image_surface_get_height(f.picture), 20, 21);
  assert_int_equal(colour_at(&f, 6, 0.3), 0);
  assert_int_equal(colour_at(&f, 6, 1.7), 0);
  assert_int_equal(colour_at(&f, 0.3, 1), 0);
  assert_int_equal(colour_at(&f, 11.7, 1), 0);
  end(&f);
}

static void tight_counts_the_weight_of_lines(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 210, 297);
  drawing_fixture_line(&f.drawing, drawing_fixture_layer(&f.drawing, 1, 1, 0),
                       50, 50, 60, 50);
  f.drawing.stroke.item[0].edge_class = RECTO_EDGE_SILHOUETTE;
  f.drawing.weight[0] = 2;
  f.options.tight = true;
  write_as(&f, &writer_eps);
  assert_true(has(&f, "\n%%HiResBoundingBox: 0 0 34.016 5.669\n"));
  end(&f);
}

static void tight_counts_fills_and_their_seams(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 210, 297);
  uint32_t layer = drawing_fixture_layer(&f.drawing, 1, 0.3, 0);
  drawing_fixture_fill(&f.drawing, layer, 0,
                       (double[]){50, 60, 60, 60, 60, 65, 50, 65}, 4);
  f.drawing.seam_mm = 2;
  f.options.tight = true;
  write_as(&f, &writer_eps);
  assert_true(has(&f, "\n%%HiResBoundingBox: 0 0 34.016 19.843\n"));
  end(&f);
}

static void without_ink_tight_is_the_page(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 210, 297);
  f.options.tight = true;
  write_as(&f, &writer_eps);
  assert_true(has(&f, "\n%%HiResBoundingBox: 0 0 595.276 841.89\n"));
  end(&f);
}

static void a_png_has_as_many_pixels_as_its_page_needs(void **state) {
  (void)state;
  static const struct {
    double width_mm, height_mm, dpi;
    int width, height;
    uint32_t per_metre;
  } page[] = {{210, 297, 0, 1240, 1754, 5906},
              {210, 297, 300, 2480, 3508, 11811},
              {100, 50, 254, 1000, 500, 10000},
              {0.01, 0.01, 10, 1, 1, 394}};
  for (int i = 0; i < 4; i++) {
    struct fixture f;
    begin(&f, page[i].width_mm, page[i].height_mm);
    f.options.dpi = page[i].dpi;
    paint(&f);
    assert_int_equal(cairo_image_surface_get_width(f.picture), page[i].width);
    assert_int_equal(cairo_image_surface_get_height(f.picture), page[i].height);
    /* The chunk after the first contains the resolution. */
    assert_memory_equal(f.bytes + 33, "\0\0\0\11pHYs", 8);
    assert_int_equal(be32(f.bytes + 41), page[i].per_metre);
    assert_int_equal(be32(f.bytes + 45), page[i].per_metre);
    assert_int_equal(f.bytes[49], 1);
    end(&f);
  }
}

/* The checksum of 10,000 pixels a metre, by another program. */
static void the_resolution_has_its_right_checksum(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 10, 10);
  f.options.dpi = 254;
  paint(&f);
  assert_int_equal(be32(f.bytes + 50), 0x94695119);
  end(&f);
}

static void a_resolution_that_makes_no_sense_is_refused(void **state) {
  (void)state;
  static const struct {
    double dpi;
    recto_status status;
  } wrong[] = {{-1, RECTO_ERROR_ARGUMENT},       {NAN, RECTO_ERROR_ARGUMENT},
               {INFINITY, RECTO_ERROR_ARGUMENT}, {1e9, RECTO_ERROR_LIMIT},
               {3000, RECTO_ERROR_LIMIT},        {2500, RECTO_ERROR_LIMIT}};
  struct fixture f;
  begin(&f, 210, 297);
  for (int i = 0; i < 6; i++) {
    recto_error error;
    f.options.dpi = wrong[i].dpi;
    assert_int_equal(stream_open_memory(&f.stream, &error), RECTO_OK);
    assert_int_equal(writer_png.write(&f.drawing, &f.options, f.stream, &error),
                     wrong[i].status);
    assert_int_equal(error.code, wrong[i].status);
    stream_discard(f.stream);
    f.stream = NULL;
  }
  end(&f);
}

/* ---- Ink ----------------------------------------------------------------- */

static void ink_is_where_it_belongs(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 100, 50);
  uint32_t layer = drawing_fixture_layer(&f.drawing, 1, 1, 0x204060);
  drawing_fixture_line(&f.drawing, layer, 10, 40, 30, 40);
  f.options.dpi = 254;
  paint(&f);
  assert_int_equal(colour_at(&f, 20, 40.3), 0x204060);
  assert_int_equal(colour_at(&f, 20, 39.7), 0x204060);
  assert_int_equal(colour_at(&f, 20, 40.7), 0xffffff);
  assert_int_equal(colour_at(&f, 20, 39.3), 0xffffff);
  assert_int_equal(colour_at(&f, 20, 10), 0xffffff);
  assert_int_equal(colour_at(&f, 80, 40), 0xffffff);
  end(&f);
}

static void caps_and_joins_are_round(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 100, 50);
  uint32_t layer = drawing_fixture_layer(&f.drawing, 1, 10, 0);
  drawing_fixture_stroke(&f.drawing, layer, (double[]){20, 40, 20, 20, 50, 20},
                         3, false);
  drawing_fixture_stroke(&f.drawing, layer, (double[]){80, 20, 80, 20}, 2,
                         false);
  f.options.dpi = 254;
  paint(&f);
  /* Past the end, but not in the corners of a square cap. */
  assert_int_equal(colour_at(&f, 54, 20), 0);
  assert_int_equal(colour_at(&f, 54.5, 24.5), 0xffffff);
  /* At the bend, but not in its outer corner. */
  assert_int_equal(colour_at(&f, 17, 17), 0);
  assert_int_equal(colour_at(&f, 15.5, 15.5), 0xffffff);
  /* A stroke without length is a dot. */
  assert_int_equal(colour_at(&f, 80, 24), 0);
  assert_int_equal(colour_at(&f, 84.5, 24.5), 0xffffff);
  end(&f);
}

static void only_a_closed_stroke_closes(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 100, 50);
  uint32_t layer = drawing_fixture_layer(&f.drawing, 1, 1, 0);
  static const double xy[] = {10, 10, 40, 10, 40, 40, 10, 40};
  double shifted[8];
  for (int i = 0; i < 8; i++)
    shifted[i] = xy[i] + (i % 2 == 0 ? 45 : 0);
  drawing_fixture_stroke(&f.drawing, layer, xy, 4, true);
  drawing_fixture_stroke(&f.drawing, layer, shifted, 4, false);
  f.options.dpi = 254;
  paint(&f);
  assert_int_equal(colour_at(&f, 10, 25), 0);
  assert_int_equal(colour_at(&f, 55, 25), 0xffffff);
  assert_int_equal(colour_at(&f, 85, 25), 0);
  end(&f);
}

static void holes_stay_white_and_strokes_lie_on_fills(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 100, 50);
  uint32_t layer = drawing_fixture_layer(&f.drawing, 1, 1, 0x0000ff);
  drawing_fixture_line(&f.drawing, layer, 5, 15, 45, 15);
  drawing_fixture_fill(&f.drawing, layer, 0xff8000,
                       (double[]){10, 10, 40, 10, 40, 40, 10, 40}, 4);
  /* Of the same winding as the outline: the even-odd rule makes the hole. */
  drawing_fixture_loop(&f.drawing, (double[]){20, 20, 30, 20, 30, 30, 20, 30},
                       4);
  f.options.dpi = 254;
  paint(&f);
  assert_int_equal(colour_at(&f, 12, 12), 0xff8000);
  assert_int_equal(colour_at(&f, 25, 25), 0xffffff);
  assert_int_equal(colour_at(&f, 25, 15), 0x0000ff);
  end(&f);
}

static void a_later_layer_covers_an_earlier_one(void **state) {
  (void)state;
  struct fixture f;
  begin(&f, 100, 50);
  uint32_t first = drawing_fixture_layer(&f.drawing, 1, 1, 0xff0000);
  uint32_t second = drawing_fixture_layer(&f.drawing, 2, 1, 0x00ff00);
  drawing_fixture_line(&f.drawing, second, 20, 10, 20, 40);
  drawing_fixture_line(&f.drawing, first, 10, 20, 40, 20);
  f.options.dpi = 254;
  paint(&f);
  assert_int_equal(colour_at(&f, 20, 20), 0x00ff00);
  assert_int_equal(colour_at(&f, 30, 20), 0xff0000);
  end(&f);
}

/* Two triangles make a square: does the background come through? */
static bool shows_a_seam(double seam_mm) {
  struct fixture f;
  bool seam = false;
  begin(&f, 100, 50);
  uint32_t below = drawing_fixture_layer(&f.drawing, 1, 1, 0);
  uint32_t layer = drawing_fixture_layer(&f.drawing, 2, 1, 0);
  drawing_fixture_fill(&f.drawing, below, 0,
                       (double[]){10, 10, 41, 10, 41, 43, 10, 43}, 4);
  drawing_fixture_fill(&f.drawing, layer, 0xffffff,
                       (double[]){10, 10, 41, 10, 41, 43}, 3);
  drawing_fixture_fill(&f.drawing, layer, 0xffffff,
                       (double[]){10, 10, 41, 43, 10, 43}, 3);
  f.drawing.seam_mm = seam_mm;
  f.options.dpi = 254;
  paint(&f);
  for (int x = 120; x < 390; x++)
    for (int y = 120; y < 410; y++)
      seam =
          seam || colour_at(&f, x / 10.0 + 0.05, y / 10.0 + 0.05) != 0xffffff;
  end(&f);
  return seam;
}

static void a_seam_closes_the_hairline(void **state) {
  (void)state;
  assert_true(shows_a_seam(0));
  assert_false(shows_a_seam(0.2));
}

/* Neither the fill drawn first nor the last reaches over the other. */
static void a_seam_paints_nothing_over(void **state) {
  struct fixture f;
  (void)state;
  begin(&f, 100, 50);
  uint32_t layer = drawing_fixture_layer(&f.drawing, 1, 1, 0);
  drawing_fixture_fill(&f.drawing, layer, 0xff0000,
                       (double[]){10, 10, 20, 10, 20, 40, 10, 40}, 4);
  drawing_fixture_fill(&f.drawing, layer, 0x00ff00,
                       (double[]){20, 10, 30, 10, 30, 40, 20, 40}, 4);
  f.drawing.seam_mm = 2;
  f.options.dpi = 254;
  paint(&f);
  assert_int_equal(colour_at(&f, 19.85, 25.05), 0xff0000);
  assert_int_equal(colour_at(&f, 20.15, 25.05), 0x00ff00);
  assert_int_equal(colour_at(&f, 30.85, 25.05), 0x00ff00);
  end(&f);
}

/* ---- Files --------------------------------------------------------------- */

static const struct writer *const formats[] = {&writer_pdf, &writer_eps,
                                               &writer_ps, &writer_png};

static void the_same_drawing_gives_the_same_bytes(void **state) {
  (void)state;
  for (size_t i = 0; i < 4; i++) {
    struct fixture f, g;
    begin(&f, 1, 1);
    begin(&g, 1, 1);
    assert_true(drawing_fixture_named(&f.drawing, "stars"));
    assert_true(drawing_fixture_named(&g.drawing, "stars"));
    write_as(&f, formats[i]);
    write_as(&g, formats[i]);
    assert_int_equal(f.count, g.count);
    assert_memory_equal(f.bytes, g.bytes, f.count);
    end(&f);
    end(&g);
  }
}

/* Strokes that no compression makes small. */
static void make_large(struct drawing *drawing) {
  uint32_t layer = drawing_fixture_layer(drawing, 1, 0.1, 0);
  uint32_t random = 1;
  for (int i = 0; i < 4500; i++) {
    double xy[6];
    for (int k = 0; k < 6; k++) {
      random = random * 1664525u + 1013904223u;
      xy[k] = 5 + (random >> 12) / 10000.0;
    }
    drawing_fixture_stroke(drawing, layer, xy, 3, false);
  }
}

static void a_full_disk_leaves_no_file(void **state) {
  (void)state;
  static const char path[] = "test_cairo.tmp";
  struct fixture f;
  begin(&f, 120, 120);
  make_large(&f.drawing);
  for (size_t i = 0; i < 4; i++) {
    /* The first write fails, the second, none. */
    for (unsigned long n = 1; n <= 100; n = n == 2 ? 100 : n + 1) {
      recto_error error = {.code = RECTO_OK};
      struct stream *stream;
      assert_int_equal(stream_open(&stream, path, &error), RECTO_OK);
      stream_fail_after(n);
      assert_int_equal(
          formats[i]->write(&f.drawing, &f.options, stream, &error), RECTO_OK);
      recto_status status = stream_finish(stream, &error);
      stream_fail_after(0);
      assert_int_equal(status, n < 100 ? RECTO_ERROR_IO : RECTO_OK);
      if (n < 100)
        assert_non_null(strstr(error.text, "cannot write"));
      assert_int_equal(access(path, F_OK), n < 100 ? -1 : 0);
    }
    assert_int_equal(unlink(path), 0);
  }
  end(&f);
}

/* cairo fails first where it keeps a page of PS in a file of its own. */
static void a_file_too_large_is_reported_by_its_name(void **state) {
  (void)state;
  static const char path[] = "test_cairo_large.tmp";
  struct fixture f;
  begin(&f, 120, 120);
  make_large(&f.drawing);
  signal(SIGXFSZ, SIG_IGN);
  for (size_t i = 0; i < 4; i++) {
    recto_error error = {.code = RECTO_OK};
    struct stream *stream;
    struct rlimit before, small;
    assert_int_equal(stream_open(&stream, path, &error), RECTO_OK);
    getrlimit(RLIMIT_FSIZE, &before);
    small = before;
    small.rlim_cur = 4096;
    setrlimit(RLIMIT_FSIZE, &small);
    recto_status written =
        formats[i]->write(&f.drawing, &f.options, stream, &error);
    recto_status status = stream_finish(stream, &error);
    setrlimit(RLIMIT_FSIZE, &before);
    assert_int_equal(written, RECTO_OK);
    assert_int_equal(status, RECTO_ERROR_IO);
    assert_string_equal(error.file, path);
    assert_non_null(strstr(error.text, strerror(EFBIG)));
    assert_int_equal(access(path, F_OK), -1);
  }
  signal(SIGXFSZ, SIG_DFL);
  end(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_pdf_bears_a_fixed_date),
      cmocka_unit_test(postscript_bears_no_date),
      cmocka_unit_test(an_eps_file_says_the_page_is_its_box),
      cmocka_unit_test(whole_points_are_not_rounded_up),
      cmocka_unit_test(tight_leaves_the_box_of_the_ink),
      cmocka_unit_test(tight_counts_the_weight_of_lines),
      cmocka_unit_test(tight_counts_fills_and_their_seams),
      cmocka_unit_test(without_ink_tight_is_the_page),
      cmocka_unit_test(a_png_has_as_many_pixels_as_its_page_needs),
      cmocka_unit_test(the_resolution_has_its_right_checksum),
      cmocka_unit_test(a_resolution_that_makes_no_sense_is_refused),
      cmocka_unit_test(ink_is_where_it_belongs),
      cmocka_unit_test(caps_and_joins_are_round),
      cmocka_unit_test(only_a_closed_stroke_closes),
      cmocka_unit_test(holes_stay_white_and_strokes_lie_on_fills),
      cmocka_unit_test(a_later_layer_covers_an_earlier_one),
      cmocka_unit_test(a_seam_closes_the_hairline),
      cmocka_unit_test(a_seam_paints_nothing_over),
      cmocka_unit_test(the_same_drawing_gives_the_same_bytes),
      cmocka_unit_test(a_full_disk_leaves_no_file),
      cmocka_unit_test(a_file_too_large_is_reported_by_its_name),
  };
  return cmocka_run_group_tests_name("cairo", tests, NULL, NULL);
}
