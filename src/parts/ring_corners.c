/* ring_corners.c - corners by their positions, with a table of bits before
 * that, as nearly no point is at one. */
#include "parts/ring_corners.h"

#include "base/hash.h"

bool ring_corners_add(struct ring_corners *ring, uint32_t point,
                      uint32_t window) {
  return ARRAY_PUSH(&ring->at, ((struct sort_key){point, window}));
}

/* Points at one position lie at one place of the page. */
static size_t bit_of_place(const struct ring_corners *ring, size_t point) {
  const int32_t *at = ring->place[point].at;
  uint64_t hash = ((uint64_t)(uint32_t)at[0] << 32 | (uint32_t)at[1]);
  return (size_t)(hash * HASH_GOLDEN >> 24) & ring->mask;
}

static bool list_positions(struct ring_corners *ring, size_t points) {
  uint8_t *is_in = mem_calloc(points, 1);
  for (size_t i = 0; is_in != NULL && i < ring->at.count; i++)
    is_in[ring->at.item[i].key] = 1;
  bool ok =
      is_in != NULL && place_set_init(&ring->set, ring->point, is_in, points);
  mem_free(is_in);
  for (size_t i = 0; ok && i < ring->at.count; i++)
    ring->at.item[i].key =
        place_set_find(&ring->set, &ring->point[ring->at.item[i].key]);
  return ok && sort_keys_unique(ring->at.item, &ring->at.count);
}

bool ring_corners_close(struct ring_corners *ring, size_t points) {
  enum { WORD = 64 };
  size_t words = 1;
  if (ring->at.count == 0)
    return true;
  if (!list_positions(ring, points))
    return false;
  while (words < ring->at.count)
    words *= 2;
  ring->maybe = mem_calloc(words, sizeof *ring->maybe);
  ring->mask = words * WORD - 1;
  for (size_t i = 0; ring->maybe != NULL && i < ring->at.count; i++) {
    size_t bit = bit_of_place(ring, (size_t)ring->at.item[i].key);
    ring->maybe[bit / WORD] |= UINT64_C(1) << bit % WORD;
  }
  return ring->maybe != NULL;
}

bool ring_corners_has(const struct ring_corners *ring, uint32_t point) {
  if (ring->maybe == NULL)
    return false;
  size_t bit = bit_of_place(ring, point);
  return (ring->maybe[bit / 64] >> bit % 64 & 1) != 0 &&
         place_set_has(&ring->set, &ring->point[point]);
}

size_t ring_corners_at(const struct ring_corners *ring, uint32_t point,
                       size_t *past) {
  uint64_t first = place_set_find(&ring->set, &ring->point[point]);
  const struct sort_key *at = ring->at.item;
  size_t begin = 0;
  LOWER_BOUND(begin, 0, ring->at.count, at[begin].key < first);
  *past = begin;
  while (*past < ring->at.count && at[*past].key == first)
    ++*past;
  return begin;
}

void ring_corners_fini(struct ring_corners *ring) {
  ARRAY_FREE(&ring->at);
  place_set_fini(&ring->set);
  mem_free(ring->maybe);
  ring->maybe = NULL;
}
