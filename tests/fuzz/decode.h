/* decode.h - a small scene and a command line from bytes of a fuzzer.
 *
 * Any bytes make a scene.  Every choice is a byte of its own, taken modulo the
 * number of what there is to choose from, the first for 0 and past the end; so
 * a changed byte changes one thing, and inputs can be cut anywhere. */
#ifndef TESTS_FUZZ_DECODE_H
#define TESTS_FUZZ_DECODE_H

#include <stddef.h>
#include <stdint.h>

enum {
  DECODE_OBJ_SIZE = 8192,
  DECODE_WORDS_SIZE = 2048,
  DECODE_MAX_WORDS = 64
};

struct decoded {
  char obj[DECODE_OBJ_SIZE]; /* a text */
  size_t obj_length;
  /* Arguments of the program, the last one NULL: "recto", options, "-o",
   * "out.svg", "model.obj".  getopt permutes them. */
  char *argv[DECODE_MAX_WORDS];
  int argc;
  char words[DECODE_WORDS_SIZE]; /* what argv points into */
  size_t words_length;
};

/* Phases
 *   options  a byte for each row of a table of alternatives
 *   camera   a kind and, as it needs, an eye and a target on the lattice
 *   points   their number, then three bytes each
 *   elements their number, then for each a byte of kind, corners and group, and
 *            a byte for each point that it is made of */
void decode_scene(struct decoded *decoded, const uint8_t *bytes, size_t count);

#endif
