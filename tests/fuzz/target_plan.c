/* target_plan.c - the plan of a drawing's parts, of any bytes: refused with a
 * reason, or its first parts are drawn.  Sums are made right first, as whoever
 * means harm would. */
#define _GNU_SOURCE
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "parts/byte_codec.h"
#include "parts/plan_bytes.h"
#include "recto.h"
#include "tests/fuzz/fuzz.h"

enum { END_SIZE = 24, PLACE_SIZE = 24, WELD_SIZE = 8, PARTS_AT = 8 };

static uint64_t get_number(const uint8_t *at, int size) {
  uint64_t value = 0;
  for (int i = 0; i < size; i++)
    value |= (uint64_t)at[i] << 8 * i;
  return value;
}

static void put_number(uint8_t *to, uint64_t value) {
  for (int i = 0; i < 8; i++)
    to[i] = (uint8_t)(value >> 8 * i);
}

static uint64_t sum_of(const uint8_t *bytes, size_t count) {
  struct plan_bytes sum = {.stream = NULL};
  plan_bytes_add(&sum, bytes, count / PLAN_BLOCK);
  return plan_bytes_sum(&sum);
}

/* Makes all sums right; returns how many parts the plan says there are. */
static unsigned make_plan_sums(uint8_t *bytes, size_t count) {
  if (count < END_SIZE + PARTS_AT + 4)
    return 1;
  uint8_t *end = bytes + count - END_SIZE;
  uint64_t size = get_number(end, 8);
  if (size > count - END_SIZE || size < PARTS_AT + 4)
    return 1;
  unsigned parts = (unsigned)get_number(end - size + PARTS_AT, 4);
  uint64_t own = (uint64_t)parts * PLACE_SIZE + WELD_SIZE;
  if (own <= size)
    for (uint8_t *place = end - own; place + WELD_SIZE < end;
         place += PLACE_SIZE) {
      uint64_t at = get_number(place, 8), length = get_number(place + 8, 8);
      if (at <= count && length <= count - at)
        put_number(place + 16, sum_of(bytes + at, (size_t)length));
    }
  put_number(end + 8, byte_codec_checksum(end - size, (size_t)size));
  return parts;
}

static void run(const uint8_t *bytes, size_t count,
                struct fuzz_finding *finding) {
  char path[40];
  uint8_t *own = malloc(count + 1);
  int file = memfd_create("plan", 0);
  if (own == NULL || file < 0)
    abort();
  if (count > 0)
    memcpy(own, bytes, count);
  unsigned parts = make_plan_sums(own, count);
  if (write(file, own, count) != (ssize_t)count)
    abort();
  snprintf(path, sizeof path, "/proc/self/fd/%d", file);
  for (unsigned number = 1; number <= 2 && number <= parts; number++) {
    recto_error error = {0};
    recto_status status =
        recto_plan_write_part(path, NULL, number, parts, "/dev/null", &error);
    if (status != RECTO_OK && error.text[0] == '\0')
      fuzz_found(finding, "refused without a reason");
  }
  close(file);
  free(own);
}

const struct fuzz_target fuzz_target_plan = {"plan", run, NULL};
