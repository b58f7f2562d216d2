/* obj_drawing.h - OBJ text as the library draws it: the SVG, and numbers of its
 * statistics. */
#ifndef TESTS_OBJ_DRAWING_H
#define TESTS_OBJ_DRAWING_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "recto.h"
#include "tests/svg_text.h"

/* The scene of a text. */
static inline recto_scene *obj_drawing_scene(const char *text, size_t length,
                                             const recto_options *options) {
  recto_scene *scene;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(
      recto_scene_read_memory(scene, text, length, "obj", NULL, options, NULL),
      RECTO_OK);
  return scene;
}

/* The whole number of that name in a drawing's statistics, which have it. */
static inline long obj_drawing_number(const recto_drawing *drawing,
                                      const char *name) {
  char key[64];
  size_t length = (size_t)snprintf(key, sizeof key, "\"%s\":", name);
  const char *at = strstr(recto_drawing_stats(drawing), key);
  assert_non_null(at);
  return strtol(at + length, NULL, 10);
}

/* The SVG of a text, which is the caller's to free.
 * name    of a number of the statistics, which *number gets; or NULL */
static inline char *obj_drawing_svg(const char *text, size_t length,
                                    const recto_options *options,
                                    const char *name, long *number) {
  recto_scene *scene = obj_drawing_scene(text, length, options);
  recto_drawing *drawing;
  assert_int_equal(recto_scene_render(scene, options, &drawing, NULL),
                   RECTO_OK);
  if (name != NULL)
    *number = obj_drawing_number(drawing, name);
  char *svg = svg_text_of(drawing, options);
  assert_non_null(svg);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
  return svg;
}

#endif
