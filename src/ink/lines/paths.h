/* paths.h - polylines on the page grid, between chaining and the drawing. */
#ifndef INK_LINES_PATHS_H
#define INK_LINES_PATHS_H

#include "ink/lines/segment_graph.h"

/* A closed path's last point joins its first, which is not repeated; it has
 * three points at least.  A path has two points at least. */
struct ink_path {
  uint32_t point, count;
  uint32_t edge; /* sheet edge of its first segment */
  bool hidden, closed;
};

struct ink_paths {
  ARRAY(struct ink_point) point; /* path after path, without gaps */
  ARRAY(struct ink_path) path;
  uint8_t *
      approximate; /* one a point, see segment_graph.h; NULL: none, or no longer known */
};

void paths_fini(struct ink_paths *paths);

/* Joins the segments of a net, which is indexed, end to end.
 * A node with two ends of one bond joins them.  Where more meet, those of one
 * class and group go first, and among them the pair that runs on straightest,
 * then the next.
 * An open path starts at its lower end in (x, y); a closed one at the point
 * farthest from its lowest, which is a corner, so that no straight run is cut
 * by the start.  Paths come by the sheet edge of their first segment, visible
 * before hidden ones; but for this order, that of the edges does not matter.
 * paths            zero-initialised
 * path_of_segment  one a segment, set to the path that it is in; or NULL
 * Guarantees  every segment is in exactly one path. */
USE_RESULT recto_status paths_chain(struct ink_paths *paths,
                                    uint32_t *path_of_segment,
                                    const struct segment_graph *graph,
                                    recto_error *error);

/* Drops points within TOLERANCE_COLLINEAR_UNITS (loose ones: within half of
 * `unit` grid units, if that is more) of the straight line that is left when
 * they are gone, and on the way along it.  Ends stay. */
void paths_straighten(struct ink_paths *paths, double unit);

/* Douglas-Peucker: drops points so that no part of a line moves by more than
 * `tolerance` grid units; ends stay, closed paths keep three points.
 * Cost  near linear: paths are treated in runs of bounded length. */
USE_RESULT recto_status paths_simplify(struct ink_paths *paths,
                                       double tolerance, recto_error *error);

double paths_length(const struct ink_paths *paths, const struct ink_path *path);

#endif
