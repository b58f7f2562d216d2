/* cut_sections.c - finds the cut faces in each plane.
 *
 * Where planes meet, what is cut ends at the line that they have in common, in
 * both of them.  There the lines of a section are joined by others along that
 * common line, which close it: from infinity, where the winding number is 0, it
 * changes by each line that ends or begins.  Three planes have a common vertex;
 * there the way turns from one common line to the other. */
#include <math.h>
#include <stdlib.h>

#include "base/tolerance.h"
#include "base/union_find.h"
#include "cut/cut_phases.h"
#include "geom/vector.h"

/* The axes of a plane's section: u, v, and the one along which it is seen, in
 * the direction of the normal. */
struct section_axes {
  int u, v, w;
};

static struct section_axes axes_of(const struct cut_plane *plane) {
  const double *n = plane->normal;
  int w = 2;
  for (int k = 0; k < 2; k++)
    w = fabs(n[k]) > fabs(n[w]) ? k : w;
  struct section_axes axes = {(w + 1) % 3, (w + 2) % 3, w};
  if (n[w] < 0)
    axes = (struct section_axes){axes.v, axes.u, w};
  return axes;
}

/* ---- Places -------------------------------------------------------------- */

static int compare_positions_of_points(const void *a, const void *b,
                                       void *user) {
  const struct cutter *cutter = user;
  uint32_t p = *(const uint32_t *)a, q = *(const uint32_t *)b;
  const int64_t *at = cutter->points.point.item[p].at;
  const int64_t *other = cutter->points.point.item[q].at;
  for (int k = 0; k < 3; k++)
    if (at[k] != other[k])
      return at[k] < other[k] ? -1 : 1;
  return 0;
}

/* Gives points that are at one place a common representative, which is on all
 * planes that any of them is on. */
static bool find_places(struct cutter *cutter) {
  size_t count = cutter->points.point.count;
  struct cut_point *point = cutter->points.point.item;
  uint32_t *order = mem_alloc(count, sizeof *order);
  cutter->place = mem_alloc(count, sizeof *cutter->place);
  cutter->places = count;
  if (order == NULL || cutter->place == NULL) {
    mem_free(order);
    return false;
  }
  for (uint32_t i = 0; i < count; i++)
    order[i] = i;
  bool ok = sort_stable(order, count, sizeof *order,
                        compare_positions_of_points, cutter);
  for (size_t i = 0, first = 0; ok && i < count; i++) {
    if (i > 0 &&
        compare_positions_of_points(&order[first], &order[i], cutter) != 0)
      first = i;
    cutter->place[order[i]] = cutter->points.first + order[first];
    point[order[first]].on |= point[order[i]].on;
  }
  for (size_t i = 0; ok && i < count; i++)
    point[i].on = point[cutter->place[i] - cutter->points.first].on;
  mem_free(order);
  return ok;
}

/* ---- Unbalanced ends ----------------------------------------------------- */

/* Whether two points can be where an edge meets a plane that neighbouring faces
 * have in different pieces. */
static bool are_close(const struct cut_point *p, const struct cut_point *q) {
  for (int k = 0; k < 3; k++)
    if (llabs(p->at[k] - q->at[k]) > TOLERANCE_SECTION_UNITS)
      return false;
  return true;
}

/* A point of the cut at which not as many lines end as begin. */
struct unbalanced_end {
  double along; /* a direction in which no plane of a model is likely to lie */
  uint32_t point;
};

struct unbalanced_ends {
  ARRAY(struct unbalanced_end) list;
};

static const double sort_direction[3] = {0.8191725, 0.6710436, 0.5497005};

static int compare_unbalanced_ends(const void *a, const void *b, void *user) {
  const struct unbalanced_end *p = a, *q = b;
  (void)user;
  return (p->along > q->along) - (p->along < q->along);
}

static bool list_unbalanced_ends(const struct cutter *cutter,
                                 const int32_t *balance,
                                 struct unbalanced_ends *unbalanced) {
  for (uint32_t i = 0; i < cutter->points.point.count; i++) {
    const int64_t *at = cutter->points.point.item[i].at;
    double along = 0;
    for (int k = 0; k < 3; k++)
      along += sort_direction[k] * (double)at[k];
    if (balance[i] != 0 &&
        !ARRAY_PUSH(&unbalanced->list, ((struct unbalanced_end){along, i})))
      return false;
  }
  return sort_stable(unbalanced->list.item, unbalanced->list.count,
                     sizeof *unbalanced->list.item, compare_unbalanced_ends,
                     NULL);
}

/* Gives all places of a set of union_find.h one representative. */
static void join_places(struct cutter *cutter, uint32_t *set) {
  struct cut_point *point = cutter->points.point.item;
  size_t points = cutter->points.point.count;
  uint32_t first = cutter->points.first;
  for (size_t i = 0; i < points; i++) {
    uint32_t root = union_find_root(set, cutter->place[i] - first);
    cutter->place[i] = first + root;
    point[root].on |= point[i].on;
  }
  for (size_t i = 0; i < points; i++)
    point[i].on = point[cutter->place[i] - first].on;
}

/* Joins ends of lines that are within the tolerance of each other.
 * end  gets for each point that the cut made the one that takes its place */
static bool match_unbalanced_ends(const struct cutter *cutter, int32_t *balance,
                                  uint32_t *end, uint32_t *set) {
  const struct cut_point *point = cutter->points.point.item;
  uint32_t first = cutter->points.first;
  struct unbalanced_ends unbalanced = {{0}};
  bool ok = list_unbalanced_ends(cutter, balance, &unbalanced);
  const struct unbalanced_end *item = unbalanced.list.item;
  for (size_t i = 0; ok && i < unbalanced.list.count; i++)
    for (size_t k = i + 1;
         k < unbalanced.list.count && balance[item[i].point] != 0 &&
         item[k].along - item[i].along <= 3 * TOLERANCE_SECTION_UNITS;
         k++) {
      uint32_t p = item[i].point, q = item[k].point;
      if (balance[q] == 0 || (balance[p] > 0) == (balance[q] > 0) ||
          !are_close(&point[p], &point[q]))
        continue;
      balance[p] += balance[q];
      balance[q] = 0;
      end[q] = p;
      union_find_join(set, cutter->place[p] - first, cutter->place[q] - first);
    }
  ARRAY_FREE(&unbalanced.list);
  return ok;
}

static bool join_unbalanced_ends(struct cutter *cutter) {
  size_t points = cutter->points.point.count;
  uint32_t first = cutter->points.first;
  struct cut_line *line = cutter->lines.line.item;
  int32_t *balance = mem_calloc(points, sizeof *balance);
  uint32_t *end = mem_alloc(points, sizeof *end);
  uint32_t *set = union_find_create(points);
  bool ok = balance != NULL && end != NULL && set != NULL;
  for (size_t i = 0; ok && i < cutter->lines.line.count; i++) {
    balance[line[i].from - first]--;
    balance[line[i].to - first]++;
  }
  for (uint32_t i = 0; ok && i < points; i++)
    end[i] = i;
  ok = ok && match_unbalanced_ends(cutter, balance, end, set);
  for (size_t i = 0; ok && i < cutter->lines.line.count; i++) {
    line[i].from = first + end[line[i].from - first];
    line[i].to = first + end[line[i].to - first];
  }
  if (ok)
    join_places(cutter, set);
  mem_free(balance);
  mem_free(end);
  mem_free(set);
  return ok;
}

/* ---- The common vertex --------------------------------------------------- */

/* Finds the point that three planes have in common.  Returns false when memory
 * ran out. */
static bool find_common_vertex(struct cutter *cutter) {
  const struct cut_points *points = &cutter->points;
  double sum[3] = {0, 0, 0}, volume = 0;
  bool inside = true;
  cutter->has_common_vertex = points->planes == 3;
  cutter->common_vertex = SCENE_NONE;
  for (int k = 0; k < 3 && cutter->has_common_vertex; k++) {
    double side[3];
    vector_cross(points->plane[(k + 1) % 3].normal,
                 points->plane[(k + 2) % 3].normal, side);
    volume = vector_dot(points->plane[k].normal, side);
    for (int i = 0; i < 3; i++)
      sum[i] += points->plane[k].offset * side[i];
  }
  for (int i = 0; i < 3 && cutter->has_common_vertex; i++) {
    double place = (sum[i] / volume - points->origin[i]) / points->unit;
    cutter->common_vertex_at[i] = place;
    cutter->has_common_vertex = isfinite(place);
    inside = inside && place >= 0 && place <= (double)SECTION_COORDINATE_MAX;
  }
  if (!cutter->has_common_vertex || !inside)
    return true;
  const int64_t at[3] = {(int64_t)rint(cutter->common_vertex_at[0]),
                         (int64_t)rint(cutter->common_vertex_at[1]),
                         (int64_t)rint(cutter->common_vertex_at[2])};
  cutter->common_vertex = cut_points_add(&cutter->points, at, 7);
  return cutter->common_vertex != SCENE_NONE;
}

/* ---- Common lines -------------------------------------------------------- */

/* An end of a line of the section on a line that two planes have in common. */
struct common_line_event {
  uint32_t label, point;
  int line;     /* 0 or 1: the common line before the common vertex or after it;
                   without such a vertex that of the other plane */
  double along; /* the common line */
  int32_t winding; /* lines that end here, less those that begin */
};

struct common_line_events {
  ARRAY(struct common_line_event) list;
};

static int compare_common_line_events(const void *a, const void *b,
                                      void *user) {
  const struct common_line_event *p = a, *q = b;
  (void)user;
  if (p->line != q->line)
    return p->line < q->line ? -1 : 1;
  return p->along != q->along ? (p->along < q->along ? -1 : 1) : 0;
}

/* How far a point is along the line that two planes have in common. */
static double along_line(const struct cutter *cutter, unsigned plane,
                         unsigned other, const double at[3]) {
  const struct cut_points *points = &cutter->points;
  double line[3];
  vector_cross(points->plane[plane].normal, points->plane[other].normal, line);
  return vector_dot(line, at);
}

/* Adds an end of a line, where it is on another plane. */
static bool add_event(const struct cutter *cutter, unsigned plane,
                      uint32_t point, uint32_t label, int32_t winding,
                      struct common_line_events *events) {
  const struct cut_points *points = &cutter->points;
  const struct cut_point *cut_point = cut_point_of(points, point);
  unsigned others = cut_point->on & ~(1u << plane) & 7u;
  if (others == 0 || point == cutter->common_vertex)
    return others == 0 ||
           ARRAY_PUSH(&events->list, ((struct common_line_event){
                                         label, point, 0, INFINITY, winding}));
  unsigned other = 0;
  while (!(others >> other & 1))
    other++;
  const double at[3] = {(double)cut_point->at[0], (double)cut_point->at[1],
                        (double)cut_point->at[2]};
  struct common_line_event event = {label, point, other != (plane + 1) % 3,
                                    along_line(cutter, plane, other, at),
                                    winding};
  if (cutter->has_common_vertex) {
    double vertex = along_line(cutter, plane, other, cutter->common_vertex_at);
    double away = fabs(event.along - vertex);
    event.along = event.line == 0 ? -away : away;
  }
  return ARRAY_PUSH(&events->list, event);
}

static bool is_closed_in(const struct cut_line *line, unsigned plane) {
  return line->plane == plane && !line->open;
}

static bool collect_events(const struct cutter *cutter, unsigned plane,
                           struct common_line_events *events) {
  for (size_t i = 0; i < cutter->lines.line.count; i++) {
    const struct cut_line *line = &cutter->lines.line.item[i];
    if (is_closed_in(line, plane) &&
        (!add_event(cutter, plane, cut_place(cutter, line->from), line->group,
                    -1, events) ||
         !add_event(cutter, plane, cut_place(cutter, line->to), line->group, 1,
                    events)))
      return false;
  }
  return sort_stable(events->list.item, events->list.count,
                     sizeof *events->list.item, compare_common_line_events,
                     NULL);
}

/* ---- Segments ------------------------------------------------------------ */

static uint32_t section_node_of(const struct cutter *cutter, unsigned plane,
                                uint32_t point) {
  struct section_axes axes = axes_of(&cutter->points.plane[plane]);
  const int64_t *at = cut_point_of(&cutter->points, point)->at;
  return section_node_at(&cutter->section[plane], at[axes.u], at[axes.v]);
}

static bool add_section_node(struct cutter *cutter, unsigned plane,
                             uint32_t point) {
  struct section_axes axes = axes_of(&cutter->points.plane[plane]);
  const int64_t *at = cut_point_of(&cutter->points, point)->at;
  return ARRAY_PUSH(&cutter->section[plane].node,
                    ((struct section_node){at[axes.u], at[axes.v], point}));
}

static bool add_section_segment(struct cutter *cutter, unsigned plane,
                                uint32_t from, uint32_t to, uint32_t label,
                                int32_t weight) {
  const struct section_segment segment = {section_node_of(cutter, plane, from),
                                          section_node_of(cutter, plane, to),
                                          label, weight};
  return segment.from == segment.to ||
         ARRAY_PUSH(&cutter->section[plane].segment, segment);
}

static bool add_section_nodes(struct cutter *cutter, unsigned plane) {
  bool ok = cutter->common_vertex == SCENE_NONE ||
            add_section_node(cutter, plane, cutter->common_vertex);
  for (size_t i = 0; ok && i < cutter->lines.line.count; i++) {
    const struct cut_line *line = &cutter->lines.line.item[i];
    ok = !is_closed_in(line, plane) ||
         (add_section_node(cutter, plane, cut_place(cutter, line->from)) &&
          add_section_node(cutter, plane, cut_place(cutter, line->to)));
  }
  return ok && section_sort_nodes(&cutter->section[plane]);
}

/* The winding numbers along a common line, none of them 0. */
struct common_line_windings {
  ARRAY(struct section_winding) list;
};

static bool add_winding(struct common_line_windings *windings, uint32_t label,
                        int32_t winding) {
  size_t i = 0;
  while (i < windings->list.count && windings->list.item[i].label != label)
    i++;
  if (i == windings->list.count)
    return ARRAY_PUSH(&windings->list,
                      ((struct section_winding){label, winding}));
  windings->list.item[i].number += winding;
  if (windings->list.item[i].number == 0)
    windings->list.item[i] = windings->list.item[--windings->list.count];
  return true;
}

/* Adds the segments along common lines: all labels have the same
 * ones, as points on such a line that are rounded are not quite on one. */
static bool close_section(struct cutter *cutter, unsigned plane) {
  struct common_line_events events = {{0}};
  struct common_line_windings windings = {{0}};
  bool ok = collect_events(cutter, plane, &events);
  for (size_t i = 0; ok && i + 1 < events.list.count; i++) {
    const struct common_line_event *at = &events.list.item[i], *next = at + 1;
    bool turns = at->line != next->line && cutter->common_vertex != SCENE_NONE;
    ok = add_winding(&windings, at->label, at->winding);
    for (size_t c = 0; ok && c < windings.list.count; c++) {
      const struct section_winding *run = &windings.list.item[c];
      ok =
          add_section_segment(cutter, plane, at->point,
                              turns ? cutter->common_vertex : next->point,
                              run->label, run->number) &&
          (!turns || add_section_segment(cutter, plane, cutter->common_vertex,
                                         next->point, run->label, run->number));
    }
  }
  ARRAY_FREE(&events.list);
  ARRAY_FREE(&windings.list);
  return ok;
}

static bool add_section_segments(struct cutter *cutter, unsigned plane) {
  bool ok = true;
  for (size_t i = 0; ok && i < cutter->lines.line.count; i++) {
    const struct cut_line *line = &cutter->lines.line.item[i];
    ok = !is_closed_in(line, plane) ||
         add_section_segment(cutter, plane, cut_place(cutter, line->from),
                             cut_place(cutter, line->to), line->group, 1);
  }
  return ok && (cutter->points.planes == 1 || close_section(cutter, plane));
}

/* ---- Results ------------------------------------------------------------- */

/* Makes points of the nodes at crossings. */
static bool add_crossing_points(struct cutter *cutter, unsigned plane) {
  struct cut_points *points = &cutter->points;
  struct section_axes axes = axes_of(&points->plane[plane]);
  struct section *section = &cutter->section[plane];
  for (size_t n = 0; n < section->node.count; n++) {
    struct section_node *node = &section->node.item[n];
    if (node->point != SECTION_NONE)
      continue;
    int64_t at[3] = {0, 0, 0};
    at[axes.u] = node->u;
    at[axes.v] = node->v;
    struct scene_point p = cut_points_position(points, at);
    double position[3] = {p.x, p.y, p.z};
    position[axes.w] -= cut_points_height(points, at, plane) /
                        points->plane[plane].normal[axes.w];
    cut_points_round(points, position, at);
    at[axes.u] = node->u;
    at[axes.v] = node->v;
    node->point = cut_points_add(points, at, 1u << plane);
    if (node->point == SCENE_NONE)
      return false;
  }
  return true;
}

recto_status cut_sections(struct cutter *cutter, recto_error *error) {
  uint32_t open_at = SCENE_NONE;
  if (!find_common_vertex(cutter) || !find_places(cutter) ||
      !join_unbalanced_ends(cutter))
    return error_memory(error);
  if (cutter->common_vertex != SCENE_NONE)
    cutter->common_vertex = cut_place(cutter, cutter->common_vertex);
  uint32_t labels = (uint32_t)cutter->scene->group.count;
  if (!cut_lines_close(&cutter->lines, &cutter->points, &cutter->cut->open,
                       &open_at) ||
      !cut_open_lines_past_vertex(cutter, &open_at))
    return error_memory(error);
  for (unsigned k = 0; k < cutter->points.planes; k++) {
    if (!add_section_nodes(cutter, k) || !add_section_segments(cutter, k))
      return error_memory(error);
    recto_status status = section_solve(&cutter->section[k], labels, error);
    if (status != RECTO_OK)
      return status;
    if (!add_crossing_points(cutter, k))
      return error_memory(error);
  }
  if (open_at != SCENE_NONE)
    cutter->cut->open_at = cut_points_position(
        &cutter->points, cut_point_of(&cutter->points, open_at)->at);
  return RECTO_OK;
}
