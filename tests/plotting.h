/* plotting.h - a drawing, its HPGL as written, and the strokes read back from
 * it. */
#ifndef TESTS_PLOTTING_H
#define TESTS_PLOTTING_H

#include "backends/writer.h"
#include "tests/drawing_fixture.h"
#include "tests/hpgl_reader.h"

struct plotting {
  struct drawing drawing;
  struct writer_options options; /* warnings are kept below */
  struct stream *stream;
  const char *text;
  struct hpgl back;
  int warnings;
  char warning[200]; /* the last */
};

/* Starts with an empty drawing on a page. */
void plotting_begin(struct plotting *plotting, double width_mm,
                    double height_mm);

/* Writes the drawing and reads it back; fails the test where that fails. */
void plotting_run(struct plotting *plotting);

void plotting_end(struct plotting *plotting);

/* Fails the test unless that point of a stroke that came back is there. */
void plotting_assert_point(const struct plotting *plotting, size_t stroke,
                           size_t index, int x, int y);

#endif
