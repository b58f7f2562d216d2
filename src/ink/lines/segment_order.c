/* segment_order.c - sorts the segments by their nodes, and lists the ends at
 * each node.
 *
 * Both are counting sorts in two steps, so that threads work beside each other
 * and what they count fits in a cache.  Segments are first distributed by
 * ranges of first nodes, in equal parts of the segments, those of a part after
 * those of earlier ones: within a range they keep their order, for any number
 * of parts.  The ends of each range of nodes are listed by one thread. */
#include "base/parallel.h"
#include "ink/lines/segment_graph.h"

#include <string.h>

#include "base/sort.h"

/* ---- Sorting ------------------------------------------------------------- */

/* Ranges of nodes, at most; their lists are taken by threads. */
enum { BINS_MAX = 512, PART_SEGMENTS_MIN = 2 * PARALLEL_ITEMS };

/* Segments by bins: bin b has the first nodes from b << shift on.
 * start  of the bins in `to`: of each part, where its next segment goes */
struct segment_sort {
  struct graph_segment *from, *to;
  size_t count, bins, part; /* segments of a part */
  int shift;
  uint32_t (*start)[BINS_MAX];
  uint32_t *end;  /* of each bin in `to` */
  uint32_t *next; /* of each worker: of the nodes of a bin */
};

static size_t bin_of(const struct segment_sort *sort, size_t segment) {
  return sort->from[segment].node[0] >> sort->shift;
}

static bool count_segments_of_part(void *user, struct parallel_range range) {
  const struct segment_sort *sort = user;
  uint32_t *count = sort->start[range.begin / sort->part];
  for (size_t i = range.begin; i < range.end; i++) {
    if (!poll_at(i))
      return false;
    count[bin_of(sort, i)]++;
  }
  return true;
}

static bool distribute_part(void *user, struct parallel_range range) {
  const struct segment_sort *sort = user;
  uint32_t *next = sort->start[range.begin / sort->part];
  for (size_t i = range.begin; i < range.end; i++) {
    if (!poll_at(i))
      return false;
    sort->to[next[bin_of(sort, i)]++] = sort->from[i];
  }
  return true;
}

static int compare_second(const void *first, const void *second, void *user) {
  const struct graph_segment *a = first, *b = second;
  (void)user;
  return (a->node[1] > b->node[1]) - (a->node[1] < b->node[1]);
}

/* Sorts segments with a common first node by the second: by insertion, or where
 * a fan makes them many, by merging. */
static bool sort_run(struct graph_segment *segment, size_t count) {
  enum { INSERTION_SORT_MAX = 16 };
  if (count > INSERTION_SORT_MAX)
    return sort_stable(segment, count, sizeof *segment, compare_second, NULL);
  for (size_t i = 1; i < count; i++) {
    struct graph_segment moving = segment[i];
    size_t hole = i;
    for (; hole > 0 && segment[hole - 1].node[1] > moving.node[1]; hole--)
      segment[hole] = segment[hole - 1];
    segment[hole] = moving;
  }
  return true;
}

/* Sorts the segments of a bin from `to` into their old place. */
static bool sort_bin(const struct segment_sort *sort, size_t bin,
                     uint32_t *next) {
  size_t begin = bin > 0 ? sort->end[bin - 1] : 0, end = sort->end[bin];
  uint32_t first = (uint32_t)(bin << sort->shift);
  size_t nodes = (size_t)1 << sort->shift;
  memset(next, 0, (nodes + 1) * sizeof *next);
  for (size_t i = begin; i < end; i++)
    next[sort->to[i].node[0] - first + 1]++;
  next[0] = (uint32_t)begin;
  for (size_t n = 0; n < nodes; n++)
    next[n + 1] += next[n];
  for (size_t i = begin; i < end; i++)
    sort->from[next[sort->to[i].node[0] - first]++] = sort->to[i];
  /* next[n] is now the end of the run of node n. */
  for (size_t n = 0, from = begin; n < nodes; from = next[n++])
    if (!sort_run(sort->from + from, next[n] - from))
      return false;
  return true;
}

static bool sort_bins_of_range(void *user, struct parallel_range range) {
  const struct segment_sort *sort = user;
  size_t nodes = ((size_t)1 << sort->shift) + 1;
  uint32_t *next = sort->next + (size_t)range.worker * nodes;
  for (size_t b = range.begin; b < range.end; b++)
    if (!sort_bin(sort, b, next))
      return false;
  return true;
}

/* Turns the counts of the parts into where their segments go. */
static void place_bins(struct segment_sort *sort, size_t parts) {
  uint32_t sum = 0;
  for (size_t b = 0; b < sort->bins; b++) {
    for (size_t k = 0; k < parts; k++) {
      uint32_t here = sort->start[k][b];
      sort->start[k][b] = sum;
      sum += here;
    }
    sort->end[b] = sum;
  }
}

static bool sort_by_bins(struct segment_sort *sort) {
  int workers = parallel_workers(sort->count, PART_SEGMENTS_MIN);
  size_t parts = (size_t)workers, nodes = ((size_t)1 << sort->shift) + 1;
  sort->part = (sort->count + parts - 1) / parts;
  sort->start = mem_calloc(parts, sizeof *sort->start);
  sort->end = mem_alloc(sort->bins, sizeof *sort->end);
  sort->next = mem_alloc(parts * nodes, sizeof *sort->next);
  bool ok = sort->start != NULL && sort->end != NULL && sort->next != NULL &&
            parallel_ranges(workers, sort->count, sort->part,
                            count_segments_of_part, sort);
  if (ok)
    place_bins(sort, parts);
  ok = ok &&
       parallel_ranges(workers, sort->count, sort->part, distribute_part,
                       sort) &&
       parallel_ranges(workers, sort->bins, 1, sort_bins_of_range, sort);
  mem_free(sort->start);
  mem_free(sort->end);
  mem_free(sort->next);
  return ok;
}

bool segment_graph_sort_segments(struct segment_graph *graph) {
  struct segment_sort sort = {.from = graph->segment.item,
                              .count = graph->segment.count};
  if (sort.count < 2)
    return true;
  while ((graph->node.count - 1) >> sort.shift >= BINS_MAX)
    sort.shift++;
  sort.bins = ((graph->node.count - 1) >> sort.shift) + 1;
  sort.to = mem_alloc(sort.count, sizeof *sort.to);
  bool ok = sort.to != NULL && sort_by_bins(&sort);
  mem_free(sort.to);
  return ok;
}

/* ---- Merging ------------------------------------------------------------- */

static bool is_after(const struct graph_segment *a,
                     const struct graph_segment *b) {
  return a->node[0] > b->node[0] ||
         (a->node[0] == b->node[0] && a->node[1] > b->node[1]);
}

/* Of the first `end` sorted segments the first one after another, or `end`: by
 * steps from there that double, and halving the last. */
static size_t find_first_after(const struct graph_segment *item, size_t end,
                               const struct graph_segment *other) {
  size_t past = end, step = 1, first;
  for (; step <= past && is_after(&item[past - step], other); step *= 2)
    past -= step;
  size_t low = step <= past ? past - step + 1 : 0;
  LOWER_BOUND(first, low, past, !is_after(&item[first], other));
  return first;
}

/* Between two of those that are added, what is there already moves in one
 * piece. */
bool graph_segments_merge(struct graph_segments *to,
                          const struct graph_segments *from) {
  size_t end = to->count, k = from->count;
  if (!ARRAY_RESERVE(to, k))
    return false;
  to->count += k;
  /* From the end, so that what is still to be moved is not overwritten. */
  for (; k > 0; k--) {
    const struct graph_segment *added = &from->item[k - 1];
    size_t later = find_first_after(to->item, end, added);
    memmove(&to->item[later + k], &to->item[later],
            (end - later) * sizeof *to->item);
    to->item[later + k - 1] = *added;
    end = later;
  }
  return true;
}

bool graph_segments_take(struct graph_segments *from, const uint8_t *flag,
                         struct graph_segments *taken) {
  struct graph_segment *item = from->item;
  size_t kept = 0, end;
  for (size_t i = 0; i < from->count; i = end + 1) {
    const uint8_t *next = memchr(flag + i, 1, from->count - i);
    end = next != NULL ? (size_t)(next - flag) : from->count;
    if (kept != i)
      memmove(&item[kept], &item[i], (end - i) * sizeof *item);
    kept += end - i;
    if (end < from->count && taken != NULL && !ARRAY_PUSH(taken, item[end]))
      return false;
  }
  from->count = kept;
  return true;
}

/* ---- Ends ---------------------------------------------------------------- */

/* The lists of a range of nodes have `total` ends; first of them are those of
 * earlier ranges. */
struct end_part {
  uint32_t total, first;
};

struct end_lists {
  struct segment_graph *graph;
  size_t part; /* nodes of a part */
  struct end_part *parts;
};

/* How many segments have a first node before this one, and so all that end at
 * earlier ones. */
static size_t segments_before(const struct segment_graph *graph, size_t node) {
  const struct graph_segment *s = graph->segment.item;
  size_t i;
  LOWER_BOUND(i, 0, graph->segment.count, s[i].node[0] < node);
  return i;
}

static bool count_ends_of_part(void *user, struct parallel_range range) {
  const struct end_lists *lists = user;
  const struct segment_graph *graph = lists->graph;
  uint32_t *start = graph->ends.start, begin = (uint32_t)range.begin;
  uint32_t nodes = (uint32_t)(range.end - range.begin), total = 0;
  size_t count = segments_before(graph, range.end);
  for (size_t i = 0; i < count; i++) {
    const uint32_t *node = graph->segment.item[i].node;
    if (!poll_at(i))
      return false;
    for (int k = 0; k < 2; k++)
      if (node[k] - begin < nodes)
        start[node[k]]++;
  }
  for (size_t n = range.begin; n < range.end; n++) {
    total += start[n];
    start[n] = total;
  }
  lists->parts[range.begin / lists->part].total = total;
  return true;
}

/* Stores the ends from the last to the first, so that lists ascend. */
static bool list_ends_of_part(void *user, struct parallel_range range) {
  const struct end_lists *lists = user;
  const struct segment_graph *graph = lists->graph;
  uint32_t *start = graph->ends.start, begin = (uint32_t)range.begin;
  uint32_t nodes = (uint32_t)(range.end - range.begin);
  uint32_t *item = graph->ends.item + lists->parts[begin / lists->part].first;
  for (size_t i = segments_before(graph, range.end); i-- > 0;) {
    const uint32_t *node = graph->segment.item[i].node;
    if (!poll_at(i))
      return false;
    for (uint32_t k = 2; k-- > 0;)
      if (node[k] - begin < nodes)
        item[--start[node[k]]] = (uint32_t)(2 * i) + k;
  }
  for (size_t n = range.begin; n < range.end; n++)
    start[n] += lists->parts[begin / lists->part].first;
  return true;
}

static bool list_ends(struct segment_graph *graph, struct end_part *part,
                      int workers) {
  size_t nodes = graph->node.count, parts = (size_t)workers;
  struct end_lists lists = {graph, (nodes + parts - 1) / parts, part};
  graph->ends.start = mem_calloc(nodes + 1, sizeof *graph->ends.start);
  graph->ends.item =
      mem_alloc(2 * graph->segment.count, sizeof *graph->ends.item);
  if (graph->ends.start == NULL || graph->ends.item == NULL)
    return false;
  if (nodes == 0)
    return true;
  if (!parallel_ranges(workers, nodes, lists.part, count_ends_of_part, &lists))
    return false;
  for (size_t k = 1; k < parts; k++)
    part[k].first = part[k - 1].first + part[k - 1].total;
  graph->ends.start[nodes] = (uint32_t)(2 * graph->segment.count);
  return parallel_ranges(workers, nodes, lists.part, list_ends_of_part, &lists);
}

recto_status segment_graph_index_ends(struct segment_graph *graph,
                                      recto_error *error) {
  int workers = parallel_workers(graph->node.count, PARALLEL_ITEMS);
  struct end_part *part = mem_calloc((size_t)workers, sizeof *part);
  number_lists_fini(&graph->ends);
  bool ok = part != NULL && list_ends(graph, part, workers);
  mem_free(part);
  return ok ? RECTO_OK : error_memory(error);
}
