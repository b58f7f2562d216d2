/* cut_sections.c - finds the cut faces in each plane.
 *
 * Where planes meet, what is cut ends at the line that they have in common, in
 * both of them.  There the lines of a section are joined by others along that
 * line, which close it: the sum of the lines that end on the way from infinity,
 * where nothing is, says how many.  Three planes have a point in common, the
 * tip, where that way turns. */
#include <math.h>
#include <stdlib.h>

#include "base/tolerance.h"
#include "base/union_find.h"
#include "cut/cut_phases.h"
#include "view/vector.h"

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

static int compare_made_places(const void *a, const void *b, void *user) {
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
  bool ok =
      sort_stable(order, count, sizeof *order, compare_made_places, cutter);
  for (size_t i = 0, first = 0; ok && i < count; i++) {
    if (i > 0 && compare_made_places(&order[first], &order[i], cutter) != 0)
      first = i;
    cutter->place[order[i]] = cutter->points.first + order[first];
    point[order[first]].on |= point[order[i]].on;
  }
  for (size_t i = 0; ok && i < count; i++)
    point[i].on = point[cutter->place[i] - cutter->points.first].on;
  mem_free(order);
  return ok;
}

/* ---- Loose ends ---------------------------------------------------------- */

/* Whether two points can be where an edge meets a plane that neighbouring faces
 * have in different pieces. */
static bool are_close(const struct cut_point *p, const struct cut_point *q) {
  for (int k = 0; k < 3; k++)
    if (llabs(p->at[k] - q->at[k]) > TOLERANCE_SECTION_UNITS)
      return false;
  return true;
}

/* A made point at which not as many lines end as begin. */
struct loose_end {
  double along; /* a direction in which no plane of a model is likely to lie */
  uint32_t point;
};

struct loose_ends {
  ARRAY(struct loose_end) list;
};

static const double loose_direction[3] = {0.8191725, 0.6710436, 0.5497005};

static int compare_loose_ends(const void *a, const void *b, void *user) {
  const struct loose_end *p = a, *q = b;
  (void)user;
  return (p->along > q->along) - (p->along < q->along);
}

static bool list_loose_ends(const struct cutter *cutter, const int32_t *balance,
                            struct loose_ends *loose) {
  for (uint32_t i = 0; i < cutter->points.point.count; i++) {
    const int64_t *at = cutter->points.point.item[i].at;
    double along = 0;
    for (int k = 0; k < 3; k++)
      along += loose_direction[k] * (double)at[k];
    if (balance[i] != 0 &&
        !ARRAY_PUSH(&loose->list, ((struct loose_end){along, i})))
      return false;
  }
  return sort_stable(loose->list.item, loose->list.count,
                     sizeof *loose->list.item, compare_loose_ends, NULL);
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
static bool match_loose_ends(const struct cutter *cutter, int32_t *balance,
                             uint32_t *end, uint32_t *set) {
  const struct cut_point *point = cutter->points.point.item;
  uint32_t first = cutter->points.first;
  struct loose_ends loose = {{0}};
  bool ok = list_loose_ends(cutter, balance, &loose);
  const struct loose_end *item = loose.list.item;
  for (size_t i = 0; ok && i < loose.list.count; i++)
    for (size_t k = i + 1;
         k < loose.list.count && balance[item[i].point] != 0 &&
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
  ARRAY_FREE(&loose.list);
  return ok;
}

static bool join_loose_ends(struct cutter *cutter) {
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
  ok = ok && match_loose_ends(cutter, balance, end, set);
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

/* ---- The tip ------------------------------------------------------------- */

/* Finds the point that three planes have in common.  Returns false when memory
 * ran out. */
static bool find_tip(struct cutter *cutter) {
  const struct cut_points *points = &cutter->points;
  double sum[3] = {0, 0, 0}, volume = 0;
  bool inside = true;
  cutter->has_tip = points->planes == 3;
  cutter->tip = SCENE_NONE;
  for (int k = 0; k < 3 && cutter->has_tip; k++) {
    double side[3];
    vector_cross(points->plane[(k + 1) % 3].normal,
                 points->plane[(k + 2) % 3].normal, side);
    volume = vector_dot(points->plane[k].normal, side);
    for (int i = 0; i < 3; i++)
      sum[i] += points->plane[k].offset * side[i];
  }
  for (int i = 0; i < 3 && cutter->has_tip; i++) {
    double place = (sum[i] / volume - points->origin[i]) / points->unit;
    cutter->tip_at[i] = place;
    cutter->has_tip = isfinite(place);
    inside = inside && place >= 0 && place <= (double)SECTION_COORDINATE_MAX;
  }
  if (!cutter->has_tip || !inside)
    return true;
  const int64_t at[3] = {(int64_t)rint(cutter->tip_at[0]),
                         (int64_t)rint(cutter->tip_at[1]),
                         (int64_t)rint(cutter->tip_at[2])};
  cutter->tip = cut_points_add(&cutter->points, at, 7);
  return cutter->tip != SCENE_NONE;
}

/* ---- Where planes meet --------------------------------------------------- */

/* A line of a label that ends or begins where planes meet. */
struct meeting {
  uint32_t label, point;
  int leg;      /* 0 or 1: the way before the tip or after it; without a tip the
                   other plane */
  double along; /* the way */
  int32_t flow; /* lines that end here, less those that begin */
};

struct meetings {
  ARRAY(struct meeting) list;
};

static int compare_meetings(const void *a, const void *b, void *user) {
  const struct meeting *p = a, *q = b;
  (void)user;
  if (p->leg != q->leg)
    return p->leg < q->leg ? -1 : 1;
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
static bool add_meeting(const struct cutter *cutter, unsigned plane,
                        uint32_t point, uint32_t label, int32_t flow,
                        struct meetings *meetings) {
  const struct cut_points *points = &cutter->points;
  const struct cut_point *made = cut_made_point(points, point);
  unsigned others = made->on & ~(1u << plane) & 7u;
  if (others == 0 || point == cutter->tip)
    return others == 0 ||
           ARRAY_PUSH(&meetings->list,
                      ((struct meeting){label, point, 0, INFINITY, flow}));
  unsigned other = 0;
  while (!(others >> other & 1))
    other++;
  const double at[3] = {(double)made->at[0], (double)made->at[1],
                        (double)made->at[2]};
  struct meeting meeting = {label, point, other != (plane + 1) % 3,
                            along_line(cutter, plane, other, at), flow};
  if (cutter->has_tip) {
    double tip = along_line(cutter, plane, other, cutter->tip_at);
    double away = fabs(meeting.along - tip);
    meeting.along = meeting.leg == 0 ? -away : away;
  }
  return ARRAY_PUSH(&meetings->list, meeting);
}

static bool is_closed_in(const struct cut_line *line, unsigned plane) {
  return line->plane == plane && !line->open;
}

static bool collect_meetings(const struct cutter *cutter, unsigned plane,
                             struct meetings *meetings) {
  for (size_t i = 0; i < cutter->lines.line.count; i++) {
    const struct cut_line *line = &cutter->lines.line.item[i];
    if (is_closed_in(line, plane) &&
        (!add_meeting(cutter, plane, cut_place(cutter, line->from), line->group,
                      -1, meetings) ||
         !add_meeting(cutter, plane, cut_place(cutter, line->to), line->group,
                      1, meetings)))
      return false;
  }
  return sort_stable(meetings->list.item, meetings->list.count,
                     sizeof *meetings->list.item, compare_meetings, NULL);
}

/* ---- Segments ------------------------------------------------------------ */

static uint32_t section_node_of(const struct cutter *cutter, unsigned plane,
                                uint32_t point) {
  struct section_axes axes = axes_of(&cutter->points.plane[plane]);
  const int64_t *at = cut_made_point(&cutter->points, point)->at;
  return section_node_at(&cutter->section[plane], at[axes.u], at[axes.v]);
}

static bool add_section_node(struct cutter *cutter, unsigned plane,
                             uint32_t point) {
  struct section_axes axes = axes_of(&cutter->points.plane[plane]);
  const int64_t *at = cut_made_point(&cutter->points, point)->at;
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
  bool ok =
      cutter->tip == SCENE_NONE || add_section_node(cutter, plane, cutter->tip);
  for (size_t i = 0; ok && i < cutter->lines.line.count; i++) {
    const struct cut_line *line = &cutter->lines.line.item[i];
    ok = !is_closed_in(line, plane) ||
         (add_section_node(cutter, plane, cut_place(cutter, line->from)) &&
          add_section_node(cutter, plane, cut_place(cutter, line->to)));
  }
  return ok && section_sort_nodes(&cutter->section[plane]);
}

/* How many lines of a label run along the line where planes meet. */
struct carry {
  uint32_t label;
  int32_t lines;
};

struct carries {
  ARRAY(struct carry) list; /* none of them 0 */
};

static bool add_to_carry(struct carries *carries, uint32_t label,
                         int32_t flow) {
  size_t i = 0;
  while (i < carries->list.count && carries->list.item[i].label != label)
    i++;
  if (i == carries->list.count)
    return ARRAY_PUSH(&carries->list, ((struct carry){label, flow}));
  carries->list.item[i].lines += flow;
  if (carries->list.item[i].lines == 0)
    carries->list.item[i] = carries->list.item[--carries->list.count];
  return true;
}

/* Adds the segments along the lines where planes meet: all labels have the same
 * ones, as points on such a line that are rounded are not quite on one. */
static bool close_section(struct cutter *cutter, unsigned plane) {
  struct meetings meetings = {{0}};
  struct carries carries = {{0}};
  bool ok = collect_meetings(cutter, plane, &meetings);
  for (size_t i = 0; ok && i + 1 < meetings.list.count; i++) {
    const struct meeting *at = &meetings.list.item[i], *next = at + 1;
    bool turns = at->leg != next->leg && cutter->tip != SCENE_NONE;
    ok = add_to_carry(&carries, at->label, at->flow);
    for (size_t c = 0; ok && c < carries.list.count; c++) {
      const struct carry *carry = &carries.list.item[c];
      ok = add_section_segment(cutter, plane, at->point,
                               turns ? cutter->tip : next->point, carry->label,
                               carry->lines) &&
           (!turns ||
            add_section_segment(cutter, plane, cutter->tip, next->point,
                                carry->label, carry->lines));
    }
  }
  ARRAY_FREE(&meetings.list);
  ARRAY_FREE(&carries.list);
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
  if (!find_tip(cutter) || !find_places(cutter) || !join_loose_ends(cutter))
    return error_memory(error);
  cutter->tip =
      cutter->tip != SCENE_NONE ? cut_place(cutter, cutter->tip) : SCENE_NONE;
  uint32_t labels = (uint32_t)cutter->scene->group.count;
  if (!cut_lines_close(&cutter->lines, &cutter->points, &cutter->cut->open,
                       &open_at) ||
      !cut_open_lines_past_tip(cutter, &open_at))
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
        &cutter->points, cut_made_point(&cutter->points, open_at)->at);
  return RECTO_OK;
}
