/* weak_creases.c - finds the creases that end free and are nowhere sharp, or
 * turn back.
 *
 * A rounded part of a mesh bends by about the crease angle at many edges, some
 * of which exceed it: lines that start and end anywhere.  What joins edges is
 * the mesh: it does not matter what of them is seen, nor that some of them are
 * silhouettes in this view.  Where such a line follows the diagonals of warped
 * quadrilaterals it runs to and fro: it must be sharper to count. */
#include "ink/lines/paths.h"

#include <math.h>

#include "base/poll.h"
#include "ink/lines/crease_lines.h"
#include "scene/angle.h"

/* A line turns back where it turns by more than 120 degrees. */
#define TURNED_BACK_COSINE (-0.5)

/* A line that turns back more often than once in so many edges is a zigzag. */
enum { TURN_EDGES = 8 };

/* What is known of a line of joined creases. */
struct crease_line {
  uint32_t edges, turns; /* so many turn back where just two edges meet */
  bool is_sharp;         /* an edge bends by more than the requested angle */
  bool is_very_sharp;    /* by more than the angle for zigzags */
};

/* The first two endpoints that edges of a line join to one. */
struct line_neighbours {
  uint32_t end[2], count;
};

/* Whether a listed edge is of a line, and neighbours are listed at its ends. */
static bool joins_vertices(const struct crease_lines *creases, size_t i,
                           double crease) {
  const struct sheet *sheet = creases->sheet;
  const struct sheet_edge *edge = &sheet->edge.item[creases->edge[i]];
  return crease_is_joined(edge, creases->cosine[i], crease) &&
         edge->point[0] < sheet->vertex_count &&
         edge->point[1] < sheet->vertex_count;
}

static void add_neighbour(struct line_neighbours *of, uint32_t end) {
  if (of->count < 2)
    of->end[of->count] = end;
  of->count += of->count < 3;
}

/* Whether a line that passes three points turns back at the middle one. */
static bool turns_back(struct view_point a, struct view_point b,
                       struct view_point c) {
  const double p[3] = {b.x - a.x, b.y - a.y, b.d - a.d};
  const double q[3] = {c.x - b.x, c.y - b.y, c.d - b.d};
  double dot = 0, square[2] = {0, 0};
  for (int i = 0; i < 3; i++) {
    dot += p[i] * q[i];
    square[0] += p[i] * p[i];
    square[1] += q[i] * q[i];
  }
  return dot < TURNED_BACK_COSINE * sqrt(square[0] * square[1]);
}

/* Finds out how the edges of the lines bend, and lists the neighbours of their
 * endpoints on the mesh.
 * next  one an endpoint, zero-initialised */
static void look_at_edges(const struct crease_lines *creases,
                          const struct crease_angles *angles,
                          struct crease_line *lines,
                          struct line_neighbours *next) {
  const struct sheet *sheet = creases->sheet;
  double crease = angle_of_degrees(angles->crease_deg).cosine;
  double start = angle_of_degrees(angles->start_deg).cosine;
  double very = angle_of_degrees(angles->zigzag_deg).cosine;
  for (size_t i = 0; i < creases->count; i++) {
    const struct sheet_edge *edge = &sheet->edge.item[creases->edge[i]];
    const uint32_t *end = &creases->end[2 * i];
    double cosine = creases->cosine[i];
    (void)poll_at(i);
    struct crease_line *of = &lines[creases->number[end[0]]];
    of->is_sharp = of->is_sharp || cosine < start;
    of->is_very_sharp = of->is_very_sharp || cosine < very;
    of->edges += crease_is_joined(edge, cosine, crease);
    if (joins_vertices(creases, i, crease)) {
      add_neighbour(&next[end[0]], end[1]);
      add_neighbour(&next[end[1]], end[0]);
    }
  }
}

/* Counts where lines turn back. */
static void look_at_points(const struct crease_lines *creases,
                           double crease_deg, struct crease_line *lines,
                           struct line_neighbours *next) {
  const struct view_point *place = creases->place;
  double crease = angle_of_degrees(crease_deg).cosine;
  for (size_t i = 0; i < creases->count; i++)
    for (int k = 0; k < 2 && joins_vertices(creases, i, crease); k++) {
      uint32_t e = creases->end[2 * i + (size_t)k];
      if (next[e].count == 2 &&
          turns_back(place[next[e].end[0]], place[e], place[next[e].end[1]]))
        lines[creases->number[e]].turns++;
      next[e].count = 0; /* not again from the other edge */
    }
}

static bool is_weak_line(const struct crease_line *line) {
  bool is_zigzag = (uint64_t)TURN_EDGES * line->turns > line->edges;
  return !line->is_sharp || (!line->is_very_sharp && is_zigzag);
}

bool paths_find_weak(struct ink_paths *paths, const struct segment_graph *graph,
                     struct crease_lines *creases,
                     const struct crease_angles *angles) {
  const struct sheet *sheet = creases->sheet;
  size_t candidates = 0;
  if (angles->start_deg == 0 || sheet->scene == NULL)
    return true;
  for (size_t i = 0; i < paths->path.count; i++) {
    struct ink_path *path = &paths->path.item[i];
    path->is_weak = path->is_free && path->classes == RECTO_EDGE_CREASE;
    candidates += path->is_weak;
  }
  if (candidates == 0)
    return true;
  if (!crease_lines_join(creases, angles->crease_deg) ||
      !crease_lines_place_ends(creases))
    return false;
  struct crease_line *lines =
      mem_calloc(creases->line_count + 1, sizeof *lines);
  struct line_neighbours *next = mem_calloc(creases->end_count, sizeof *next);
  bool ok = lines != NULL && next != NULL;
  if (ok) {
    look_at_edges(creases, angles, lines, next);
    look_at_points(creases, angles->crease_deg, lines, next);
  }
  for (size_t i = 0; ok && i < paths->path.count; i++) {
    struct ink_path *path = &paths->path.item[i];
    for (int k = 0; k < 2 && path->is_weak; k++) {
      uint32_t edge = graph->segment.item[path->end[k] >> 1].edge;
      uint32_t point = sheet->edge.item[edge].point[0];
      path->is_weak =
          is_weak_line(&lines[crease_line_of_point(creases, point)]);
    }
  }
  mem_free(lines);
  mem_free(next);
  return ok;
}
