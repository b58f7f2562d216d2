/* sort.c - stable sorting: radix for integer keys, merging for the rest. */
#include "base/sort.h"

#include <stdbool.h>
#include <string.h>

#include "base/memory.h"
#include "base/poll.h"

enum {
  DIGIT_BITS = 11,
  DIGIT_COUNT = 1 << DIGIT_BITS,
  PASS_COUNT = (64 + DIGIT_BITS - 1) / DIGIT_BITS,
  FEW = 64, /* below, insertion beats clearing the histograms */
  DISTRIBUTED_ITEMS = 16 * POLL_ITEMS /* between two polls */
};

static void insert_keys(struct sort_key *item, size_t count) {
  for (size_t i = 1; i < count; i++) {
    struct sort_key moving = item[i];
    size_t hole = i;
    for (; hole > 0 && item[hole - 1].key > moving.key; hole--)
      item[hole] = item[hole - 1];
    item[hole] = moving;
  }
}

static size_t digit(uint64_t key, int pass) {
  return (size_t)(key >> (pass * DIGIT_BITS)) & (DIGIT_COUNT - 1);
}

/* Distributes the items by one digit; `start` has the count of each digit. */
static void distribute(const struct sort_key *from, struct sort_key *to,
                       size_t count, int pass, size_t start[DIGIT_COUNT]) {
  size_t sum = 0;
  for (int i = 0; i < DIGIT_COUNT; i++) {
    size_t here = start[i];
    start[i] = sum;
    sum += here;
  }
  for (size_t i = 0; i < count; i++) {
    if ((i + 1) % DISTRIBUTED_ITEMS == 0)
      (void)poll_now();
    to[start[digit(from[i].key, pass)]++] = from[i];
  }
}

void sort_keys(struct sort_key *item, struct sort_key *scratch, size_t count) {
  if (count < FEW) {
    insert_keys(item, count);
    return;
  }
  /* One pass finds the bits in which any two keys differ; digits in which none
   * do need no pass. */
  uint64_t differing = 0;
  for (size_t i = 1; i < count; i++)
    differing |= item[i].key ^ item[0].key;
  struct sort_key *from = item, *to = scratch;
  for (int pass = 0; pass < PASS_COUNT; pass++) {
    if (digit(differing, pass) == 0)
      continue;
    if (count > POLL_ITEMS)
      (void)poll_now();
    size_t start[DIGIT_COUNT] = {0};
    for (size_t i = 0; i < count; i++)
      start[digit(from[i].key, pass)]++;
    distribute(from, to, count, pass, start);
    struct sort_key *swap = from;
    from = to;
    to = swap;
  }
  if (from != item)
    memcpy(item, from, count * sizeof *item);
}

bool sort_keys_alone(struct sort_key *item, size_t count) {
  struct sort_key *scratch = mem_alloc(count, sizeof *scratch);
  if (scratch == NULL)
    return false;
  sort_keys(item, scratch, count);
  mem_free(scratch);
  return true;
}

bool sort_keys_unique(struct sort_key *item, size_t *count) {
  size_t kept = 0;
  if (!sort_keys_alone(item, *count))
    return false;
  for (size_t i = 0; i < *count; i++)
    if (kept == 0 || item[i].key != item[kept - 1].key ||
        item[i].value != item[kept - 1].value)
      item[kept++] = item[i];
  *count = kept;
  return true;
}

/* ---- Merge sort ---------------------------------------------------------- */

struct sort_order {
  size_t size;
  int (*compare)(const void *, const void *, void *);
  void *user;
};

/* Merges [0, left) and [left, count) of `from` into `to`; of equal items the
 * left one comes first. */
static void merge(const struct sort_order *order, const char *from, char *to,
                  size_t left, size_t count) {
  size_t size = order->size;
  const char *a = from, *a_end = from + left * size;
  const char *b = a_end, *b_end = from + count * size;
  if (b == b_end || order->compare(a_end - size, b, order->user) <= 0) {
    memcpy(to, from, count * size);
    return;
  }
  for (size_t n = 1; a < a_end && b < b_end; n++) {
    (void)poll_at(n);
    if (order->compare(a, b, order->user) <= 0) {
      memcpy(to, a, size);
      a += size;
    } else {
      memcpy(to, b, size);
      b += size;
    }
    to += size;
  }
  memcpy(to, a, (size_t)(a_end - a));
  memcpy(to + (a_end - a), b, (size_t)(b_end - b));
}

bool sort_stable(void *item, size_t count, size_t size,
                 int (*compare)(const void *, const void *, void *),
                 void *user) {
  if (count < 2)
    return true;
  char *scratch = mem_alloc(count, size);
  if (scratch == NULL)
    return false;
  struct sort_order order = {size, compare, user};
  char *from = item, *to = scratch;
  bool ok = true;
  for (size_t width = 1; ok && width < count; width *= 2) {
    for (size_t i = 0; ok && i < count; i += 2 * width) {
      ok = i == 0 || poll_at(i);
      size_t rest = count - i;
      size_t left = width < rest ? width : rest;
      size_t both = 2 * width < rest ? 2 * width : rest;
      merge(&order, from + i * size, to + i * size, left, both);
    }
    char *swap = from;
    from = to;
    to = swap;
  }
  if (from != (char *)item)
    memcpy(item, from, count * size);
  mem_free(scratch);
  return ok;
}

static int compare_ids(const void *a, const void *b, void *user) {
  uint32_t p = *(const uint32_t *)a, q = *(const uint32_t *)b;
  (void)user;
  return (p > q) - (p < q);
}

bool sort_ids(uint32_t *id, size_t count) {
  return sort_stable(id, count, sizeof *id, compare_ids, NULL);
}
