/* merge_order.c - the k-way merge of lists of parts. */
#include "parts/merge_order.h"

#include <string.h>

bool merge_order_init(struct merge_order *order, const struct part *part,
                      size_t parts) {
  *order = (struct merge_order){
      .part = part,
      .count = mem_calloc(parts, sizeof *order->count),
      .heap = mem_alloc(parts, sizeof *order->heap),
      .parts = parts,
  };
  return order->count != NULL && order->heap != NULL;
}

void merge_order_fini(struct merge_order *order) {
  mem_free(order->count);
  mem_free(order->heap);
  *order = (struct merge_order){.part = NULL};
}

static inline bool is_before(const struct merge_head *a,
                             const struct merge_head *b) {
  return a->key != b->key ? a->key < b->key : a->at.part < b->at.part;
}

/* Moves the head at a place down to where none below it is before it. */
static void sift_down(struct merge_order *order, size_t i) {
  struct merge_head *heap = order->heap;
  const struct merge_head head = heap[i];
  for (size_t child = 2 * i + 1; child < order->heads; child = 2 * i + 1) {
    if (child + 1 < order->heads && is_before(&heap[child + 1], &heap[child]))
      child++;
    if (!is_before(&heap[child], &head))
      break;
    heap[i] = heap[child];
    i = child;
  }
  heap[i] = head;
}

/* Whether the first head has stayed the first, as it mostly does: what follows
 * one another in a model lies in one window. */
static inline bool is_still_first(const struct merge_order *order) {
  const struct merge_head *heap = order->heap;
  return (order->heads < 2 || is_before(&heap[0], &heap[1])) &&
         (order->heads < 3 || is_before(&heap[0], &heap[2]));
}

void merge_order_begin(struct merge_order *order, size_t list,
                       merge_key *key_of) {
  order->key_of = key_of;
  order->heads = 0;
  for (uint32_t p = 0; p < order->parts; p++) {
    memcpy(&order->count[p], (const char *)&order->part[p] + list,
           sizeof *order->count);
    if (order->count[p] > 0)
      order->heap[order->heads++] =
          (struct merge_head){key_of(&order->part[p], 0), {p, 0}};
  }
  for (size_t i = order->heads / 2; i > 0; i--)
    sift_down(order, i - 1);
}

bool merge_order_next(struct merge_order *order, struct origin *at) {
  struct merge_head *first = &order->heap[0];
  if (order->heads == 0)
    return false;
  *at = first->at;
  if (first->at.index + 1u < order->count[first->at.part]) {
    first->at.index++;
    first->key = order->key_of(&order->part[first->at.part], first->at.index);
    if (is_still_first(order))
      return true;
  } else {
    *first = order->heap[--order->heads];
  }
  sift_down(order, 0);
  return true;
}

size_t merge_order_count(const struct merge_order *order) {
  size_t count = 0;
  for (size_t i = 0; i < order->heads; i++)
    count += order->count[order->heap[i].at.part];
  return count;
}
