/* accuracy_methods.c - every method over its knob. */
#include "bench/accuracy.h"

enum {
  bits_lines = 1024,     /* where the bits of depth vary */
  subpixels_lines = 256, /* where the sub-pixels do */
  NEWELL_A = 1,
  NEWELL_AB,
  NEWELL_ABC,
  NEWELL_ABCD
};

#define LINES(name, by, n)                                                     \
  { name, "lines", #n, by, n, 0, 0, 0, false }
#define ALL_LINES(name, by)                                                    \
  LINES(name, by, 128), LINES(name, by, 256), LINES(name, by, 512),            \
      LINES(name, by, 1024), LINES(name, by, 2048), LINES(name, by, 4096)
#define BITS(name, by, n)                                                      \
  { name, "depth bits", #n, by, bits_lines, n, 0, 0, false }
#define ALL_BITS(name, by)                                                     \
  BITS(name, by, 8), BITS(name, by, 10), BITS(name, by, 12),                   \
      BITS(name, by, 16), BITS(name, by, 24)
#define SUBPIXELS(name, by, n)                                                 \
  { name, "subpixels", #n, by, subpixels_lines, 0, n, 0, false }
#define ALL_SUBPIXELS(name, by)                                                \
  SUBPIXELS(name, by, 1), SUBPIXELS(name, by, 2), SUBPIXELS(name, by, 4),      \
      SUBPIXELS(name, by, 8)
#define TESTS(value, n)                                                        \
  { "newell", "tests", value, &solver_newell, 0, 0, 0, n, false }
#define EXACT(name, by)                                                        \
  { name, "exact", "", by, 0, 0, 0, 0, true }

const struct accuracy_setting accuracy_settings[] = {
    EXACT("newell", &solver_newell),
    EXACT("watkins", &solver_watkins),
    EXACT("warnock", &solver_warnock),
    EXACT("tiles", &solver_tiles),
    EXACT("brute", &solver_brute),
    EXACT("auto", NULL),
    {"painter", "order", "given", &solver_painter_given, 0, 0, 0, 0, false},
    {"painter", "order", "centroid", &solver_painter, 0, 0, 0, 0, false},
    TESTS("A", NEWELL_A),
    TESTS("AB", NEWELL_AB),
    TESTS("ABC", NEWELL_ABC),
    TESTS("ABCD", NEWELL_ABCD),
    ALL_LINES("watkins", &solver_watkins),
    ALL_LINES("warnock", &solver_warnock),
    ALL_LINES("zbuffer", &solver_zbuffer),
    ALL_BITS("zbuffer", &solver_zbuffer),
    ALL_SUBPIXELS("zbuffer", &solver_zbuffer),
    ALL_LINES("scanline-zbuffer", &solver_scanline_zbuffer),
    ALL_BITS("scanline-zbuffer", &solver_scanline_zbuffer),
    ALL_SUBPIXELS("scanline-zbuffer", &solver_scanline_zbuffer),
    {0},
};
