/* random.h - random numbers that are the same on every machine (splitmix64). */
#ifndef TESTS_SCENES_RANDOM_H
#define TESTS_SCENES_RANDOM_H

#include <stdint.h>

struct random {
  uint64_t state; /* any value is a seed */
};

/* The next 64 random bits. */
static inline uint64_t random_next(struct random *random) {
  uint64_t z = random->state += UINT64_C(0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return z ^ (z >> 31);
}

/* A number in [0, count), count > 0.  The bias of the remainder is below
 * count / 2^32, which no test can see. */
static inline uint32_t random_below(struct random *random, uint32_t count) {
  return (uint32_t)((random_next(random) >> 32) % count);
}

/* A whole number in [low, high]. */
static inline int random_int(struct random *random, int low, int high) {
  return low + (int)random_below(random, (uint32_t)(high - low + 1));
}

/* A double in [0, 1), a multiple of 2^-53. */
static inline double random_unit(struct random *random) {
  return (double)(random_next(random) >> 11) * 0x1p-53;
}

/* A double in [low, high). */
static inline double random_between(struct random *random, double low,
                                    double high) {
  return low + (high - low) * random_unit(random);
}

#endif
