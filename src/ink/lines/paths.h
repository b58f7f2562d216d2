/* paths.h - polylines on the page grid, between chaining and the drawing. */
#ifndef INK_LINES_PATHS_H
#define INK_LINES_PATHS_H

#include "base/parallel.h"
#include "ink/lines/segment_graph.h"

/* A polyline of at least two points.  The last point of a closed path is joined
 * to its first, which is not repeated; a closed path has at least three points.
 * */
struct ink_path {
  uint32_t point, count;
  uint32_t edge;   /* sheet edge of its first segment */
  uint32_t end[2]; /* its ends in the segment graph, if it is open */
  uint8_t classes; /* all classes of its segments */
  bool hidden, closed;
  bool is_free, is_weak; /* see paths_find_free_ends, paths_find_weak */
  bool is_covered;       /* see paths_find_covered */
  bool is_continued[2];  /* at its ends, see paths_find_continued */
};

struct ink_paths {
  ARRAY(struct ink_point) point; /* path after path, without gaps */
  ARRAY(struct ink_path) path;
  uint8_t *approximate; /* one a point, see segment_graph.h; NULL: none, or no
                      longer known */
};

/* Paths that a thread takes at once: one has a hundred points on a dense
 * mesh. */
enum { PATHS_IN_RANGE = PARALLEL_RANGE(64) };

void paths_fini(struct ink_paths *paths);

/* Joins the segments of an indexed graph end to end.
 * A node with two ends of equal pen key joins them.  Where more ends meet,
 * pairs of one class and group are preferred, and among them the straightest
 * pair, then the next.
 * An open path starts at its lower end in (x, y).  A closed one starts at the
 * point farthest from its lowest point, which is a corner, so that the start
 * does not split a straight run.  Paths are sorted by the sheet edge of their
 * first segment, visible before hidden; the order of the edges has no other
 * effect.
 * paths            zero-initialised
 * path_of_segment  one a segment, set to the path that it is in; or NULL
 * Guarantees  every segment is in exactly one path. */
USE_RESULT recto_status paths_chain(struct ink_paths *paths,
                                    uint32_t *path_of_segment,
                                    const struct segment_graph *graph,
                                    recto_error *error);

/* Sets is_free of the paths that consist of creases and group borders alone and
 * of which an end is free: the line ends there in the model, at a vertex where
 * no other edge is to be drawn, visible or not, and on the page no other line
 * ends there.
 * graph        the one that was chained
 * dropped      one a sheet edge: it is not to be drawn; NULL: all are
 * output_step  see segment_graph_drop_output_overlaps
 * Returns false when memory ran out.  Cost: linear in the edges and paths. */
USE_RESULT bool paths_find_free_ends(struct ink_paths *paths,
                                     const struct segment_graph *graph,
                                     const struct sheet *sheet,
                                     const uint8_t *dropped,
                                     double output_step);

/* Sets is_weak of the paths of creases that are free, where no edge that is
 * joined to them at points of the mesh by creases, drawn as such or as
 * silhouettes, bends by more than the angle; another angle where these edges
 * are a zigzag: more than one in eight of them turns back, by more than 120
 * degrees, at a point where just two meet.
 * Returns false when memory ran out.  Cost: linear in the edges and paths. */
USE_RESULT bool paths_find_weak(struct ink_paths *paths,
                                const struct segment_graph *graph,
                                struct crease_lines *creases,
                                const struct crease_angles *angles);

/* Sets is_weak of the paths of creases that are free and shorter than
 * pens_short_cycle_mm, if more than half of their length are reversing legs,
 * and short ones beside these: a leg is what lies between two turns by more
 * than 45 degrees on the page, short if it is shorter than
 * pens_shortest_crease_mm, and reversing if the turns are to opposite sides,
 * too.
 * Cost  linear in the points */
void paths_find_zigzags(struct ink_paths *paths, const struct sheet *sheet,
                        const struct pens *pens,
                        const struct crease_angles *angles);

/* Sets is_continued of the ends of hidden open paths at which a visible line
 * goes on in about their direction (stroke_turns_sharply): it passes behind
 * something there.
 * Cost  linear in the hidden paths and the ends at their nodes */
void paths_find_continued(struct ink_paths *paths,
                          const struct segment_graph *graph);

/* Removes points within TOLERANCE_COLLINEAR_UNITS of the straight line that
 * remains without them, if they are in order along it.  For approximate points
 * the tolerance is half of `output_step` (grid units), if that is more.  Ends
 * stay. */
void paths_straighten(struct ink_paths *paths, double output_step);

/* Sets is_covered of the visible open paths of features (segment_graph.h) that
 * are shorter than pens_shortest_crease_mm and all of which is within half a
 * pen of longer ones of the same pen that are at least as wide.  Paths that are
 * dropped, as too short or as covered, cover nothing.
 * Returns false when memory ran out.  Cost: n log n. */
USE_RESULT bool paths_find_covered(struct ink_paths *paths,
                                   const struct sheet *sheet,
                                   const struct pens *pens);

/* Douglas-Peucker: removes points so that no part of a line moves by more than
 * `tolerance` grid units; ends stay, closed paths keep three points.
 * Cost  near linear: paths are split into runs of bounded length. */
USE_RESULT recto_status paths_simplify(struct ink_paths *paths,
                                       double tolerance, recto_error *error);

#endif
