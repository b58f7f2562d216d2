/* test_failures_fills.c - no hairlines between fills. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <cairo.h>

#include "backends/writer.h"
#include "tests/scenes/pipeline.h"
#include "tests/scenes/solver_named.h"

#define DPI 127.0 /* five pixels a millimetre */
#define PIXEL_MM 0.2
/* Fills reach over their borders by half of it, a pixel's diagonal. */
#define SEAM_MM (3 * PIXEL_MM)

/* ---- White fragments on black -------------------------------------------- */

struct picture {
  cairo_surface_t *surface;
  const unsigned char *data;
  int width, height;
  size_t stride;
};

struct source {
  const char *bytes;
  size_t count, offset;
};

static cairo_status_t feed(void *closure, unsigned char *bytes,
                           unsigned count) {
  struct source *source = closure;
  if (source->offset + count > source->count)
    return CAIRO_STATUS_READ_ERROR;
  memcpy(bytes, source->bytes + source->offset, count);
  source->offset += count;
  return CAIRO_STATUS_SUCCESS;
}

/* The page as pixels. */
static void paint(struct picture *picture, const struct drawing *drawing) {
  const struct writer_options options = {.dpi = DPI};
  struct source source = {0};
  struct stream *stream = NULL;
  recto_error error;
  assert_int_equal(stream_open_memory(&stream, &error), RECTO_OK);
  assert_int_equal(writer_png.write(drawing, &options, stream, &error),
                   RECTO_OK);
  source.bytes = stream_memory(stream, &source.count);
  picture->surface = cairo_image_surface_create_from_png_stream(feed, &source);
  assert_int_equal(cairo_surface_status(picture->surface),
                   CAIRO_STATUS_SUCCESS);
  stream_discard(stream);
  picture->data = cairo_image_surface_get_data(picture->surface);
  picture->width = cairo_image_surface_get_width(picture->surface);
  picture->height = cairo_image_surface_get_height(picture->surface);
  picture->stride = (size_t)cairo_image_surface_get_stride(picture->surface);
}

static bool is_white(const struct picture *picture, int x, int y) {
  uint32_t pixel;
  memcpy(&pixel, picture->data + (size_t)y * picture->stride + 4 * (size_t)x,
         4);
  return (pixel & 0xffffff) == 0xffffff;
}

/* All fills white, and on a layer below them one of the whole page, black. */
static void blacken_page(struct drawing *drawing) {
  const double w = drawing->width_mm, h = drawing->height_mm;
  const struct drawing_point corner[] = {{0, 0}, {w, 0}, {w, h}, {0, h}};
  struct drawing_fill page = {.loop = (uint32_t)drawing->loop.count,
                              .loops = 1};
  struct drawing_loop loop = {(uint32_t)drawing->point.count, 4};
  assert_true(ARRAY_PUSH(&drawing->loop, loop));
  for (int i = 0; i < 4; i++)
    assert_true(ARRAY_PUSH(&drawing->point, corner[i]));
  assert_true(ARRAY_PUSH(&drawing->layer, drawing->layer.item[0]));
  for (size_t i = 0; i < drawing->fill.count; i++) {
    drawing->fill.item[i].colour = 0xffffff;
    drawing->fill.item[i].layer++;
  }
  assert_true(ARRAY_PUSH(&drawing->fill, page));
  memmove(drawing->fill.item + 1, drawing->fill.item,
          (drawing->fill.count - 1) * sizeof *drawing->fill.item);
  drawing->fill.item[0] = page;
}

/* ---- What is inside ------------------------------------------------------ */

static int compare_doubles(const void *a, const void *b) {
  double p = *(const double *)a, q = *(const double *)b;
  return (p > q) - (p < q);
}

/* Where a fill's outline crosses the row of pixels; returns how often. */
static size_t find_crossings(const struct drawing *drawing,
                             const struct drawing_fill *fill, double y,
                             double *crossing) {
  size_t count = 0;
  for (uint32_t l = 0; l < fill->loops; l++) {
    const struct drawing_loop *loop = &drawing->loop.item[fill->loop + l];
    const struct drawing_point *p = drawing->point.item + loop->point;
    for (uint32_t i = 0; i < loop->count; i++) {
      struct drawing_point a = p[i], b = p[(i + 1) % loop->count];
      if ((a.y <= y) != (b.y <= y))
        crossing[count++] = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
    }
  }
  qsort(crossing, count, sizeof *crossing, compare_doubles);
  return count;
}

/* Marks the pixels whose centre is in a fill. */
static uint8_t *find_inside(const struct drawing *drawing,
                            const struct picture *picture) {
  uint8_t *inside = calloc((size_t)picture->width * (size_t)picture->height, 1);
  double *crossing = malloc((drawing->point.count + 1) * sizeof *crossing);
  assert_non_null(inside);
  assert_non_null(crossing);
  for (int row = 0; row < picture->height; row++) {
    double y = drawing->height_mm - (row + 0.5) * PIXEL_MM;
    for (size_t f = 0; f < drawing->fill.count; f++) {
      size_t count =
          find_crossings(drawing, &drawing->fill.item[f], y, crossing);
      for (size_t i = 0; i + 1 < count; i += 2)
        for (int x = (int)ceil(crossing[i] / PIXEL_MM - 0.5);
             x < picture->width && (x + 0.5) * PIXEL_MM < crossing[i + 1]; x++)
          if (x >= 0)
            inside[row * picture->width + x] = 1;
    }
  }
  free(crossing);
  return inside;
}

/* Whether that pixel and the two around it on all sides are inside. */
static bool is_well_inside(const uint8_t *inside, const struct picture *picture,
                           int x, int y) {
  for (int v = y - 2; v <= y + 2; v++)
    for (int u = x - 2; u <= x + 2; u++)
      if (u < 0 || v < 0 || u >= picture->width || v >= picture->height ||
          !inside[v * picture->width + u])
        return false;
  return true;
}

/* How many pixels well inside are not white. */
static size_t count_dark(struct drawing *drawing, double seam_mm,
                         size_t *white) {
  struct picture picture;
  size_t dark = 0;
  drawing->seam_mm = seam_mm;
  paint(&picture, drawing);
  struct drawing fragments = *drawing; /* without the page */
  fragments.fill.item++;
  fragments.fill.count--;
  uint8_t *inside = find_inside(&fragments, &picture);
  for (int y = 0; y < picture.height; y++)
    for (int x = 0; x < picture.width; x++)
      if (is_well_inside(inside, &picture, x, y)) {
        if (is_white(&picture, x, y))
          ++*white;
        else
          dark++;
      }
  free(inside);
  cairo_surface_destroy(picture.surface);
  return dark;
}

/* ---- Claims -------------------------------------------------------------- */

static void no_seam_shows_between_fills(void **state) {
  size_t with = 0, without = 0, white = 0, scenes = 0;
  (void)state;
  for (const struct scenes_entry *e = scene_list; e->name; e++) {
    struct scene scene;
    recto_options options;
    struct pipeline p;
    pipeline_fill(&scene, &options, e);
    options.ink.fill = RECTO_FILL_SHADE;
    options.ink.edges = RECTO_EDGES_NONE;
    pipeline_run(&p, &scene, &options, solver_named("tiles"));
    if (p.status == RECTO_OK && p.drawing.fill.count > 0) {
      blacken_page(&p.drawing);
      size_t ignored = 0;
      without += count_dark(&p.drawing, 0, &ignored);
      size_t dark = count_dark(&p.drawing, SEAM_MM, &white);
      if (dark > 0)
        print_message("%s: %zu dark pixels\n", e->name, dark);
      with += dark;
      scenes++;
    }
    scene_fini(&scene);
    pipeline_fini(&p);
  }
  assert_int_equal(with, 0);
  assert_int_not_equal(without, 0); /* or this test sees nothing */
  assert_in_range(white, 100 * scenes, SIZE_MAX);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(no_seam_shows_between_fills),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
