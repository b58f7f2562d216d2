/* fuzz.h - targets for fuzzing: what runs on an input of any bytes, and
 * what must hold afterwards. */
#ifndef TESTS_FUZZ_FUZZ_H
#define TESTS_FUZZ_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { FUZZ_FINDING_SIZE = 600 };

/* What was found wrong with an input: a sentence; "" where nothing was. */
struct fuzz_finding {
  char text[FUZZ_FINDING_SIZE];
};

struct fuzz_target {
  const char *name;
  /* Runs the input, `count` bytes.  A crash, a report of a sanitizer and an
   * endless loop are findings too, and are reported by what watches the
   * process. */
  void (*run)(const uint8_t *bytes, size_t count, struct fuzz_finding *finding);
  /* Prints the input in a form for people; NULL: it is a text or a file of a
   * known format as it is. */
  void (*print)(const uint8_t *bytes, size_t count, FILE *file);
};

extern const struct fuzz_target fuzz_target_cli;
extern const struct fuzz_target fuzz_target_mesh;
extern const struct fuzz_target fuzz_target_mtl;
extern const struct fuzz_target fuzz_target_obj;
extern const struct fuzz_target fuzz_target_options;
extern const struct fuzz_target fuzz_target_part;
extern const struct fuzz_target fuzz_target_plan;
extern const struct fuzz_target fuzz_target_ply;
extern const struct fuzz_target fuzz_target_scene;
extern const struct fuzz_target fuzz_target_stl;
extern const struct fuzz_target fuzz_target_svg;

/* All targets, ended by NULL. */
extern const struct fuzz_target *const fuzz_targets[];

/* The target of that name, or NULL. */
const struct fuzz_target *fuzz_find(const char *name);

/* Records a finding unless there is one already, or its text contains one of
 * the comma-separated words of the environment variable FUZZ_IGNORE. */
void fuzz_found(struct fuzz_finding *finding, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Prints words that the inputs of the target are made of, in the form of a
 * dictionary of libFuzzer. */
void fuzz_print_dictionary(const struct fuzz_target *target, FILE *file);

#endif
