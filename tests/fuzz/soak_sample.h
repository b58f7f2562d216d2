/* soak_sample.h - the random scenes of a soak: a model as OBJ text, and the
 * words of a command line. */
#ifndef TESTS_FUZZ_SOAK_SAMPLE_H
#define TESTS_FUZZ_SOAK_SAMPLE_H

#include <stddef.h>
#include <stdint.h>

enum {
  SAMPLE_TEXT_MAX = 1 << 22,
  SAMPLE_WORDS_MAX = 40,
  SAMPLE_WORD_SIZE = 200
};

struct sample {
  char kind[32];
  char obj[SAMPLE_TEXT_MAX];
  size_t length;
  char word[SAMPLE_WORDS_MAX][SAMPLE_WORD_SIZE];
  int words;
};

/* Says what is wrong and ends the process. */
_Noreturn void soak_fail(const char *what, const char *where);

void sample_add_word(struct sample *sample, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* The scene of a seed: one of a generator with random sizes, a random camera or
 * the generator's, or a sheet of views, and random options; one in four is one
 * of decode.h. */
void sample_make(struct sample *sample, uint64_t seed);

#endif
