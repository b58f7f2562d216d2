/* crease_lines.c - joins creases to lines, and finds how sharp they are. */
#include "ink/lines/crease_lines.h"

#include <math.h>
#include <string.h>

#include "base/number_filter.h"
#include "base/parallel.h"
#include "base/poll.h"
#include "base/union_find.h"
#include "scene/angle.h"
#include "scene/edges/crease_marks.h"

static int mark_of_edge(const struct sheet *sheet,
                        const struct sheet_edge *edge) {
  return sheet->topology != NULL && sheet->topology->crease_mark != NULL &&
                 edge->source != SHEET_NONE
             ? sheet->topology->crease_mark[edge->source]
             : CREASE_MARK_NONE;
}

double crease_cosine(const struct sheet *sheet, const struct sheet_edge *edge,
                     struct large_face_normals *normals) {
  double n[2][3], dot = 0, square[2] = {0, 0};
  if ((edge->edge_class & (RECTO_EDGE_CREASE | RECTO_EDGE_SILHOUETTE)) == 0)
    return 1;
  switch (mark_of_edge(sheet, edge)) {
  case CREASE_MARK_HARD:
    return -1;
  case CREASE_MARK_SOFT:
    return 1;
  default:
    break;
  }
  for (int k = 0; k < 2; k++) {
    uint32_t face = edge->triangle[k];
    if (face == SHEET_NONE)
      return 1;
    if (!sheet->triangles_dropped)
      face = sheet->triangle.item[face].face;
    face_normal_by(normals, sheet->scene, face, n[k]);
  }
  for (int i = 0; i < 3; i++) {
    dot += n[0][i] * n[1][i];
    square[0] += n[0][i] * n[0][i];
    square[1] += n[1][i] * n[1][i];
  }
  double lengths = sqrt(square[0] * square[1]);
  return lengths > 0 ? dot / lengths : -1;
}

/* ---- Lines --------------------------------------------------------------- */

void crease_lines_fini(struct crease_lines *lines) {
  mem_free(lines->edge);
  mem_free(lines->cosine);
  mem_free((void *)lines->at);
  mem_free(lines->end);
  mem_free(lines->point);
  mem_free(lines->end_of_point);
  mem_free(lines->place);
  mem_free(lines->number);
  *lines = (struct crease_lines){.sheet = lines->sheet};
}

static size_t creases_of_range(const void *user, struct parallel_range range,
                               uint32_t *kept) {
  const struct sheet *sheet = user;
  size_t count = 0;
  for (size_t e = range.begin; e < range.end; e++) {
    kept[count] = (uint32_t)e;
    count += (sheet->edge.item[e].edge_class &
              (RECTO_EDGE_CREASE | RECTO_EDGE_SILHOUETTE)) != 0;
  }
  return count;
}

bool crease_lines_list(struct crease_lines *lines) {
  if (lines->edge == NULL)
    lines->edge = number_filter(lines->sheet->edge.count, creases_of_range,
                                lines->sheet, &lines->count);
  return lines->edge != NULL;
}

/* Edges that a thread takes at once, each of which looks at its faces. */
enum { MEASURED_EDGES = PARALLEL_RANGE(512) };

/* Fetches the corners of the faces of a listed edge that is looked at later,
 * and the points of those of one that is looked at sooner: they are anywhere in
 * memory. */
MEM_PREFETCH_INLINE void prefetch_faces(const struct crease_lines *lines,
                                        size_t i, size_t end) {
  enum { AHEAD = MEM_PREFETCH_AHEAD / 2 };
  const struct scene *scene = lines->sheet->scene;
  if (i + 2 * AHEAD >= end || !lines->sheet->triangles_dropped)
    return;
  const struct sheet_edge *edge = lines->sheet->edge.item;
  const uint32_t *far = edge[lines->edge[i + 2 * AHEAD]].triangle,
                 *near = edge[lines->edge[i + AHEAD]].triangle;
  for (int k = 0; k < 2; k++) {
    if (far[k] != SHEET_NONE)
      MEM_PREFETCH(&scene->corner.item[scene_face_start(scene, far[k])]);
    if (near[k] == SHEET_NONE)
      continue;
    const uint32_t *corner =
        &scene->corner.item[scene_face_start(scene, near[k])];
    for (int c = 0; c < 3; c++)
      MEM_PREFETCH(&scene->point.item[corner[c]]);
  }
}

static bool measure_edges_of_range(void *user, struct parallel_range range) {
  const struct crease_lines *lines = user;
  struct large_face_normals normals = large_face_normals_start();
  for (size_t i = range.begin; i < range.end; i++) {
    prefetch_faces(lines, i, range.end);
    lines->cosine[i] = crease_cosine(
        lines->sheet, &lines->sheet->edge.item[lines->edge[i]], &normals);
  }
  return true;
}

bool crease_lines_measure(struct crease_lines *lines) {
  if (lines->cosine != NULL)
    return true;
  if (!crease_lines_list(lines))
    return false;
  lines->cosine = mem_alloc(lines->count, sizeof *lines->cosine);
  return lines->cosine != NULL &&
         parallel_ranges(parallel_workers(lines->count, MEASURED_EDGES),
                         lines->count, MEASURED_EDGES, measure_edges_of_range,
                         lines);
}

struct end_count {
  const struct sheet *sheet;
  const uint8_t *dropped;
  atomic_uchar *at;
};

static inline unsigned count_at(const struct end_count *ends, uint32_t point) {
  return atomic_load_explicit(&ends->at[point], memory_order_relaxed);
}

/* Counts an edge: each sets the next bit. */
static void count_end(const struct end_count *ends, uint32_t point) {
  unsigned before = count_at(ends, point);
  if (before == 0 || before == CREASE_END_SHARED)
    return;
  before = atomic_fetch_or_explicit(&ends->at[point], CREASE_END_ALONE,
                                    memory_order_relaxed);
  if (before != CREASE_END)
    atomic_store_explicit(&ends->at[point], CREASE_END_SHARED,
                          memory_order_relaxed);
}

/* Most edges end at no point that is counted for. */
static bool count_edges_of_range(void *user, struct parallel_range range) {
  const struct end_count ends = *(const struct end_count *)user;
  for (size_t e = range.begin; e < range.end; e++) {
    const struct sheet_edge *edge = &ends.sheet->edge.item[e];
    if ((count_at(&ends, edge->point[0]) | count_at(&ends, edge->point[1])) ==
            0 ||
        edge->edge_class == 0 || (ends.dropped != NULL && ends.dropped[e]))
      continue;
    count_end(&ends, edge->point[0]);
    count_end(&ends, edge->point[1]);
  }
  return true;
}

bool crease_ends_count(const struct sheet *sheet, const uint8_t *dropped,
                       atomic_uchar *at) {
  size_t edges = sheet->edge.count;
  struct end_count ends = {sheet, dropped, at};
  return parallel_ranges(parallel_workers(edges, PARALLEL_ITEMS), edges,
                         PARALLEL_ITEMS, count_edges_of_range, &ends);
}

bool crease_lines_find_ends(struct crease_lines *lines) {
  const struct sheet *sheet = lines->sheet;
  if (lines->at != NULL)
    return true;
  if (!crease_lines_list(lines))
    return false;
  lines->at = mem_calloc(sheet->point.count, sizeof *lines->at);
  for (size_t i = 0; lines->at != NULL && i < lines->count; i++)
    for (int k = 0; k < 2; k++)
      lines->at[sheet->edge.item[lines->edge[i]].point[k]] = CREASE_END;
  return lines->at != NULL && crease_ends_count(sheet, NULL, lines->at);
}

/* Numbers the endpoints in the order of the edges. */
static void number_endpoints(struct crease_lines *lines) {
  const struct sheet_edge *edge = lines->sheet->edge.item;
  for (size_t i = 0; i < 2 * lines->count; i++)
    lines->end_of_point[edge[lines->edge[i / 2]].point[i % 2]] = SHEET_NONE;
  for (size_t i = 0; i < 2 * lines->count; i++) {
    uint32_t point = edge[lines->edge[i / 2]].point[i % 2];
    uint32_t *number = &lines->end_of_point[point];
    (void)poll_at(i);
    if (*number == SHEET_NONE) {
      *number = (uint32_t)lines->end_count;
      lines->point[lines->end_count++] = point;
    }
    lines->end[i] = *number;
  }
}

bool crease_lines_number_ends(struct crease_lines *lines) {
  size_t points = lines->sheet->point.count;
  if (lines->end != NULL)
    return true;
  if (!crease_lines_list(lines))
    return false;
  size_t ends = 2 * lines->count;
  lines->end = mem_alloc(ends, sizeof *lines->end);
  lines->point = mem_alloc(ends < points ? ends : points, sizeof *lines->point);
  lines->end_of_point = mem_alloc(points, sizeof *lines->end_of_point);
  if (lines->end == NULL || lines->point == NULL || lines->end_of_point == NULL)
    return false;
  number_endpoints(lines);
  return true;
}

/* Endpoints that a thread takes at once: the points of the sheet are anywhere
 * in memory. */
enum { PLACED_ENDS = PARALLEL_RANGE(1024) };

static bool place_ends_of_range(void *user, struct parallel_range range) {
  const struct crease_lines *lines = user;
  const struct projection projection = projection_of(&lines->sheet->camera);
  const struct geom_point *point = lines->sheet->point.item;
  for (size_t e = range.begin; e < range.end; e++)
    lines->place[e] = unproject_point(&projection, point[lines->point[e]]);
  return true;
}

bool crease_lines_place_ends(struct crease_lines *lines) {
  if (lines->place != NULL)
    return true;
  if (!crease_lines_number_ends(lines))
    return false;
  size_t ends = lines->end_count;
  lines->place = mem_alloc(ends, sizeof *lines->place);
  return lines->place != NULL &&
         parallel_ranges(parallel_workers(ends, PLACED_ENDS), ends, PLACED_ENDS,
                         place_ends_of_range, lines);
}

/* Joins the endpoints of the edges that are of lines.
 * line  a union-find of the endpoints */
static void join_endpoints(const struct crease_lines *lines, double crease_deg,
                           uint32_t *line) {
  double crease = angle_of_degrees(crease_deg).cosine;
  for (size_t i = 0; i < lines->count; i++) {
    const struct sheet_edge *edge = &lines->sheet->edge.item[lines->edge[i]];
    (void)poll_at(i);
    if (crease_is_joined(edge, lines->cosine[i], crease))
      union_find_join(line, lines->end[2 * i], lines->end[2 * i + 1]);
  }
}

/* Numbers the lines in the order of their first edges, which is that of their
 * first endpoints. */
static void number_crease_lines(struct crease_lines *lines, uint32_t *line) {
  for (uint32_t e = 0; e < lines->end_count; e++) {
    uint32_t root = union_find_root(line, e);
    lines->number[e] =
        root == e ? (uint32_t)++lines->line_count : lines->number[root];
  }
}

bool crease_lines_join(struct crease_lines *lines, double crease_deg) {
  if (lines->number != NULL)
    return true;
  if (!crease_lines_measure(lines) || !crease_lines_number_ends(lines))
    return false;
  uint32_t *line = union_find_create(lines->end_count);
  lines->number = mem_alloc(lines->end_count, sizeof *lines->number);
  bool ok = line != NULL && lines->number != NULL;
  if (ok) {
    join_endpoints(lines, crease_deg, line);
    number_crease_lines(lines, line);
  }
  mem_free(line);
  return ok;
}
