/* merge_order.h - goes through ascending lists of all parts as one ascending
 * list: a k-way merge, by a heap of the lists' next items. */
#ifndef PARTS_MERGE_ORDER_H
#define PARTS_MERGE_ORDER_H

#include "parts/part.h"

/* What an item of the merged list came from. */
struct origin {
  uint32_t part, index;
};

/* The key of an item of a part's list. */
typedef uint64_t merge_key(const struct part *part, uint32_t index);

/* The next item of a part's list. */
struct merge_head {
  uint64_t key;
  struct origin at;
};

struct merge_order {
  const struct part *part;
  merge_key *key_of;
  size_t *count;           /* how many items each part has */
  struct merge_head *heap; /* the least first */
  size_t heads, parts;
};

/* The number of items that a list of a part has: its count, a size_t, lies at
 * this offset. */
#define MERGE_LIST(list) offsetof(struct part, list.count)

/* Makes room for so many parts.  Returns false when memory ran out; end with
 * merge_order_fini either way. */
USE_RESULT bool merge_order_init(struct merge_order *order,
                                 const struct part *part, size_t parts);
void merge_order_fini(struct merge_order *order);

/* Begins with a list: MERGE_LIST, its items have ascending keys. */
void merge_order_begin(struct merge_order *order, size_t list,
                       merge_key *key_of);

/* Takes the next item, the one of the first part where several have the same
 * key.  Returns false at the end. */
bool merge_order_next(struct merge_order *order, struct origin *at);

/* How many items all lists have that were not taken, where they have just
 * begun. */
size_t merge_order_count(const struct merge_order *order);

#endif
