/* plotting.c - see plotting.h. */
#include "tests/plotting.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

static void take_warning(void *user, const char *file, unsigned long line,
                         const char *text) {
  struct plotting *plotting = user;
  assert_string_equal(file, "");
  assert_int_equal(line, 0);
  plotting->warnings++;
  snprintf(plotting->warning, sizeof plotting->warning, "%s", text);
}

void plotting_begin(struct plotting *f, double width_mm, double height_mm) {
  *f = (struct plotting){.options = {.warning = take_warning, .user = f}};
  drawing_fixture_page(&f->drawing, width_mm, height_mm);
}

/* Writes the drawing and reads it back. */
void plotting_run(struct plotting *f) {
  recto_error error;
  size_t count;
  assert_int_equal(stream_open_memory(&f->stream, &error), RECTO_OK);
  assert_int_equal(
      writer_hpgl.write(&f->drawing, &f->options, f->stream, &error), RECTO_OK);
  f->text = stream_memory(f->stream, &count);
  hpgl_read(&f->back, f->text, count);
  assert_string_equal(f->back.fault, "");
}

void plotting_end(struct plotting *f) {
  hpgl_free(&f->back);
  stream_discard(f->stream);
  drawing_fini(&f->drawing);
}

void plotting_assert_point(const struct plotting *f, size_t stroke,
                           size_t index, int x, int y) {
  assert_in_range(stroke, 0, f->back.stroke.count - 1);
  assert_in_range(index, 0, f->back.stroke.item[stroke].count - 1);
  const struct hpgl_point *point =
      &f->back.point.item[f->back.stroke.item[stroke].point + index];
  assert_int_equal(point->x, x);
  assert_int_equal(point->y, y);
}
