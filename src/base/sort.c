/* sort.c - stable sorting: radix for integer keys, merging for the rest.
 *
 * Of many integer keys only the upper bits are sorted by radix, so many that
 * most keys differ in them; then the few items of each run that agree in these
 * are sorted: fewer passes touch memory that is in no cache. */
#include "base/sort.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"

enum {
  DIGIT_BITS = 11,
  DIGIT_COUNT = 1 << DIGIT_BITS,
  SPARE_BITS = 3, /* more than count the items, by which keys differ */
  RUN = 32,       /* items that insertion sorts as fast as merging */
  FEW = 1024,     /* below, merging is faster than clearing the histograms */
  DISTRIBUTED_ITEMS = 16 * POLL_ITEMS, /* between two polls */
  PART_COUNT = 4,          /* of the items of a pass, and threads, at most */
  PART_ITEMS_MIN = 1 << 14 /* for a thread to be worth while */
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

/* Merges sorted items [0, left) and [left, count) of `from` into `to`. */
static void merge_keys(const struct sort_key *from, struct sort_key *to,
                       size_t left, size_t count) {
  size_t a = 0, b = left;
  for (size_t i = 0; i < count; i++)
    to[i] = b == count || (a < left && from[a].key <= from[b].key) ? from[a++]
                                                                   : from[b++];
}

/* Sorts few items: short runs by insertion, which are then merged. */
static void sort_few_keys(struct sort_key *item, struct sort_key *scratch,
                          size_t count) {
  struct sort_key *from = item, *to = scratch;
  for (size_t i = 0; i < count; i += RUN)
    insert_keys(item + i, count - i < RUN ? count - i : RUN);
  for (size_t width = RUN; width < count; width *= 2) {
    for (size_t i = 0; i < count; i += 2 * width) {
      size_t rest = count - i;
      merge_keys(from + i, to + i, width < rest ? width : rest,
                 2 * width < rest ? 2 * width : rest);
    }
    struct sort_key *swap = from;
    from = to;
    to = swap;
  }
  if (from != item)
    memcpy(item, from, count * sizeof *item);
}

/* The digit that begins at bit `shift`. */
static size_t digit(uint64_t key, int shift) {
  return (size_t)(key >> shift) & (DIGIT_COUNT - 1);
}

/* A pass, which distributes the items by one digit, in equal parts.  Within a
 * digit the items of a part come after those of earlier parts, so that the
 * result does not depend on which threads do them. */
struct sort_pass {
  const struct sort_key *from;
  struct sort_key *to;
  size_t count;
  int shift, parts;
  bool counting; /* `start` gets the number of items of each digit */
  size_t (*start)[DIGIT_COUNT]; /* one a part */
  atomic_int next;              /* the first part that no thread has taken */
};

static size_t first_of_part(const struct sort_pass *pass, int part) {
  return pass->count / (size_t)pass->parts * (size_t)part +
         pass->count % (size_t)pass->parts * (size_t)part / (size_t)pass->parts;
}

static void do_part(const struct sort_pass *pass, int part) {
  const struct sort_key *from = pass->from;
  size_t *start = pass->start[part], end = first_of_part(pass, part + 1);
  size_t i = first_of_part(pass, part);
  if (pass->counting) {
    for (; i < end; i++)
      start[digit(from[i].key, pass->shift)]++;
    return;
  }
  for (; i < end; i++) {
    if ((i + 1) % DISTRIBUTED_ITEMS == 0)
      (void)poll_now();
    pass->to[start[digit(from[i].key, pass->shift)]++] = from[i];
  }
}

static void do_parts(void *user, bool is_caller) {
  struct sort_pass *pass = user;
  (void)is_caller;
  for (int k; (k = atomic_fetch_add(&pass->next, 1)) < pass->parts;)
    do_part(pass, k);
}

/* Counts the items of each digit, or moves them.  All is done even where the
 * caller cancelled, so that `to` has all items. */
static void run_pass(struct sort_pass *pass, bool counting) {
  pass->counting = counting;
  atomic_store(&pass->next, 0);
  parallel_run(pass->parts, do_parts, pass);
}

/* Distributes the items by one digit.
 * parts  of the items, done by as many threads at most */
static void distribute(const struct sort_key *from, struct sort_key *to,
                       size_t count, int shift, int parts) {
  size_t start[PART_COUNT][DIGIT_COUNT], sum = 0;
  struct sort_pass work = {.from = from,
                           .to = to,
                           .count = count,
                           .shift = shift,
                           .parts = parts,
                           .start = start};
  memset(start, 0, (size_t)parts * sizeof start[0]);
  run_pass(&work, true);
  for (int i = 0; i < DIGIT_COUNT; i++)
    for (int k = 0; k < parts; k++) {
      size_t here = start[k][i];
      start[k][i] = sum;
      sum += here;
    }
  run_pass(&work, false);
}

/* The first bit of the digits that are sorted by.
 * differing  the bits in which any two keys differ, at least one */
static int first_shift(size_t count, uint64_t differing) {
  int bits = SPARE_BITS, end = 64 - __builtin_clzll(differing);
  while (count >> (bits - SPARE_BITS))
    bits++;
  int shift = end - (bits + DIGIT_BITS - 1) / DIGIT_BITS * DIGIT_BITS;
  return shift > 0 ? shift : 0;
}

/* Sorts each run of items that agree from bit `shift` on. */
static void sort_runs(struct sort_key *item, struct sort_key *scratch,
                      size_t count, int shift) {
  size_t polled = 0;
  for (size_t i = 0, end; i < count; i = end) {
    if (i - polled >= POLL_ITEMS) {
      (void)poll_now();
      polled = i;
    }
    for (end = i + 1;
         end < count && (item[end].key ^ item[i].key) >> shift == 0;)
      end++;
    if (end - i > 1)
      sort_keys(item + i, scratch + i, end - i);
  }
}

void sort_keys(struct sort_key *item, struct sort_key *scratch, size_t count) {
  if (count < FEW) {
    sort_few_keys(item, scratch, count);
    return;
  }
  uint64_t differing = 0;
  for (size_t i = 1; i < count; i++)
    differing |= item[i].key ^ item[0].key;
  if (differing == 0)
    return;
  int workers =
      count < PART_ITEMS_MIN ? 1 : parallel_workers(count, PART_ITEMS_MIN);
  int first = first_shift(count, differing);
  struct sort_key *from = item, *to = scratch;
  for (int shift = first; shift < 64; shift += DIGIT_BITS) {
    if (digit(differing, shift) == 0)
      continue; /* no key differs */
    if (count > POLL_ITEMS)
      (void)poll_now();
    distribute(from, to, count, shift,
               workers < PART_COUNT ? workers : PART_COUNT);
    struct sort_key *swap = from;
    from = to;
    to = swap;
  }
  if (from != item)
    memcpy(item, from, count * sizeof *item);
  if (differing << (63 - first) << 1 != 0)
    sort_runs(item, scratch, count, first);
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
