/* open_paths.h - follows the paths between ends that are joined to no other, by
 * all threads. */
#ifndef INK_LINES_OPEN_PATHS_H
#define INK_LINES_OPEN_PATHS_H

#include <stdatomic.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "ink/lines/segment_graph.h"

/* A walk from an open end to the other one, or to where the walk from there has
 * come. */
struct open_walk {
  uint32_t open;   /* the end at which it begins */
  uint32_t worker; /* in whose array its ends are, from `first` on */
  uint32_t first;
  uint32_t count; /* of segments; may be 0 */
  uint32_t next;  /* the end of a segment that is the other walk's;
                     SEGMENT_GRAPH_NONE: the path ends */
};

/* A path as its walks: all of `walk`, which begins at the lower open end, then
 * `other` reversed.  Each end is the one at which its segment is entered, but
 * the last. */
struct open_path {
  const struct open_walk *walk;
  const struct open_walk *other; /* NULL: there is none */
  uint32_t count;                /* of ends: one more than of segments */
};

struct open_ends {
  ARRAY(uint32_t) end;
  char apart[PARALLEL_APART];
};

struct open_paths {
  ARRAY(struct open_walk) walk; /* by open ends, ascending */
  ARRAY(struct open_path) path; /* by the lower of their open ends, ascending */
  struct open_ends *worker;     /* one a worker */
  int workers;
};

/* Follows all open paths of `count` segments.
 * paths  zero-initialised; to be freed with open_paths_fini in any case
 * mate   of each end the one that it is joined to, or SEGMENT_GRAPH_NONE; those
 *        of open paths are lost
 * used   one a segment, 0: set to 1 for those of open paths
 * Returns false when memory ran out. */
USE_RESULT bool open_paths_follow(struct open_paths *paths, uint32_t *mate,
                                  atomic_uchar *used, size_t count);

/* Stores the ends of a path. */
void open_paths_store(const struct open_paths *paths,
                      const struct open_path *path, uint32_t *end);

void open_paths_fini(struct open_paths *paths);

#endif
