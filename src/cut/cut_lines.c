/* cut_lines.c - joins the lines of each plane to curves, and repairs those that
 * are not closed. */
#include "cut/cut_lines.h"

#include <math.h>

#include "base/number_lists.h"
#include "base/sort.h"
#include "base/union_find.h"

struct curve_finder {
  struct cut_line *line;
  size_t lines;
  const struct cut_points *points;
  uint32_t *curve;  /* of each point of the cut: a set of union_find.h */
  int32_t *balance; /* of each: lines that end there less those that begin */
  uint8_t *bad;     /* of each that represents a curve: enum curve_fault */
  struct number_lists at; /* of bad curves: the lines at each point */
  uint32_t *degree;       /* lines that are left */
  uint8_t *walked;        /* of each line */
};

enum curve_fault { CURVE_SOUND, CURVE_UNBALANCED, CURVE_OPEN, CURVE_HOPELESS };

static uint32_t cut_point_index(const struct curve_finder *c, uint32_t point) {
  return point - c->points->first;
}

static uint32_t curve_of(const struct curve_finder *c,
                         const struct cut_line *line) {
  return union_find_root(c->curve, cut_point_index(c, line->from));
}

/* ---- Groups -------------------------------------------------------------- */

static double length_of(const struct curve_finder *c,
                        const struct cut_line *line) {
  const int64_t *a = cut_point_of(c->points, line->from)->at;
  const int64_t *b = cut_point_of(c->points, line->to)->at;
  double x = (double)(b[0] - a[0]), y = (double)(b[1] - a[1]);
  return hypot(hypot(x, y), (double)(b[2] - a[2]));
}

/* Gives all lines of a curve the group of most of its length; of several, the
 * first. */
static bool choose_groups(struct curve_finder *c) {
  struct sort_key *key = mem_alloc(c->lines, sizeof *key);
  uint32_t *group = mem_alloc(c->points->point.count, sizeof *group);
  bool ok = key != NULL && group != NULL;
  for (size_t i = 0; ok && i < c->lines; i++)
    key[i] = (struct sort_key){(uint64_t)curve_of(c, &c->line[i]) << 32 |
                                   c->line[i].group,
                               (uint32_t)i};
  ok = ok && sort_keys_alone(key, c->lines);
  double most = -1;
  for (size_t i = 0, next; ok && i < c->lines; i = next) {
    double sum = 0;
    uint32_t curve = (uint32_t)(key[i].key >> 32);
    for (next = i; next < c->lines && key[next].key == key[i].key; next++)
      sum += length_of(c, &c->line[key[next].value]);
    if (i == 0 || (uint32_t)(key[i - 1].key >> 32) != curve || sum > most) {
      most = sum;
      group[curve] = (uint32_t)key[i].key;
    }
  }
  for (size_t i = 0; ok && i < c->lines; i++)
    c->line[i].group = group[curve_of(c, &c->line[i])];
  mem_free(key);
  mem_free(group);
  return ok;
}

/* ---- Repair -------------------------------------------------------------- */

static bool is_on_bad_curve(const struct curve_finder *c,
                            const struct cut_line *line) {
  return c->bad[curve_of(c, line)] != CURVE_SOUND;
}

/* Opens all but one of the lines of bad curves between the same two points in a
 * plane. */
static bool drop_duplicate_lines(struct curve_finder *c) {
  ARRAY(struct sort_key) key = {0};
  for (size_t i = 0; i < c->lines; i++) {
    const struct cut_line *line = &c->line[i];
    const struct sort_key own = {sort_pair_key(line->from, line->to),
                                 (uint32_t)i};
    if (is_on_bad_curve(c, line) && !ARRAY_PUSH(&key, own)) {
      ARRAY_FREE(&key);
      return false;
    }
  }
  bool ok = sort_keys_alone(key.item, key.count);
  unsigned planes = 0; /* of the lines before between the same points */
  for (size_t i = 0; ok && i < key.count; i++) {
    struct cut_line *line = &c->line[key.item[i].value];
    if (i > 0 && key.item[i].key != key.item[i - 1].key)
      planes = 0;
    line->open = (planes >> line->plane & 1) != 0;
    planes |= 1u << line->plane;
  }
  ARRAY_FREE(&key);
  return ok;
}

/* Puts the lines of bad curves into the lists of their ends. */
static void put_bad_lines(struct curve_finder *c) {
  for (uint32_t i = (uint32_t)c->lines; i-- > 0;) {
    const struct cut_line *line = &c->line[i];
    for (int k = 0; k < 2 && is_on_bad_curve(c, line) && !line->open; k++)
      number_lists_put(&c->at,
                       cut_point_index(c, k == 0 ? line->from : line->to), i);
  }
}

/* Lists the lines of bad curves by their ends. */
static bool list_bad_lines(struct curve_finder *c) {
  size_t points = c->points->point.count;
  c->degree = mem_calloc(points, sizeof *c->degree);
  c->walked = mem_calloc(c->lines, sizeof *c->walked);
  if (c->degree == NULL || c->walked == NULL ||
      !number_lists_init(&c->at, points))
    return false;
  put_bad_lines(c);
  if (!number_lists_allocate(&c->at, points))
    return false;
  put_bad_lines(c);
  for (size_t p = 0; p < points; p++)
    c->degree[p] = c->at.start[p + 1] - c->at.start[p];
  return true;
}

/* A line at a point that is neither open nor walked; NULL: there is none. */
static struct cut_line *find_line_at(struct curve_finder *c, uint32_t point,
                                     uint32_t *number) {
  for (; c->at.start[point] < c->at.start[point + 1]; c->at.start[point]++) {
    *number = c->at.item[c->at.start[point]];
    if (!c->line[*number].open && !c->walked[*number])
      return &c->line[*number];
  }
  return NULL;
}

static uint32_t other_line_end(const struct curve_finder *c,
                               const struct cut_line *line, uint32_t point) {
  uint32_t from = cut_point_index(c, line->from);
  return from == point ? cut_point_index(c, line->to) : from;
}

/* Opens lines from a point with a single line on. */
static void strip_from(struct curve_finder *c, uint32_t point) {
  while (c->degree[point] == 1) {
    uint32_t number = 0, start = c->at.start[point];
    struct cut_line *line = find_line_at(c, point, &number);
    c->at.start[point] = start;
    if (line == NULL)
      return;
    line->open = true;
    c->bad[curve_of(c, line)] = CURVE_OPEN;
    c->degree[point]--;
    point = other_line_end(c, line, point);
    c->degree[point]--;
  }
}

/* Walks from a point along lines that are left until it is back, and turns all
 * of them the way that most of their length runs. */
static void turn_trail(struct curve_finder *c, uint32_t point,
                       uint32_t *trail) {
  size_t count = 0;
  double along = 0;
  uint32_t number = 0;
  for (struct cut_line *line;
       (line = find_line_at(c, point, &number)) != NULL;) {
    bool forward = cut_point_index(c, line->from) == point;
    c->walked[number] = forward ? 1 : 2;
    along += forward ? length_of(c, line) : -length_of(c, line);
    trail[count++] = number;
    point = other_line_end(c, line, point);
  }
  for (size_t i = 0; i < count; i++) {
    struct cut_line *line = &c->line[trail[i]];
    if ((c->walked[trail[i]] == 1) == (along >= 0))
      continue;
    uint32_t from = line->from;
    line->from = line->to;
    line->to = from;
  }
}

static bool repair_curves(struct curve_finder *c) {
  uint32_t points = (uint32_t)c->points->point.count;
  uint32_t *trail = mem_alloc(c->lines, sizeof *trail);
  bool ok = trail != NULL && drop_duplicate_lines(c) && list_bad_lines(c);
  for (uint32_t p = 0; ok && p < points; p++)
    strip_from(c, p);
  for (uint32_t p = 0; ok && p < points; p++)
    if (c->degree[p] % 2 != 0)
      c->bad[union_find_root(c->curve, p)] = CURVE_HOPELESS;
  for (size_t i = 0; ok && i < c->lines; i++)
    if (c->bad[curve_of(c, &c->line[i])] == CURVE_HOPELESS)
      c->line[i].open = true;
  for (uint32_t p = 0; ok && p < points; p++)
    while (c->at.start[p] < c->at.start[p + 1]) {
      uint32_t number;
      if (find_line_at(c, p, &number) != NULL)
        turn_trail(c, p, trail);
    }
  mem_free(trail);
  return ok;
}

/* ---- Curves -------------------------------------------------------------- */

/* Joins the lines; returns whether each curve is balanced. */
static bool join_cut_lines(struct curve_finder *c) {
  bool balanced = true;
  for (size_t i = 0; i < c->lines; i++) {
    uint32_t from = cut_point_index(c, c->line[i].from);
    uint32_t to = cut_point_index(c, c->line[i].to);
    union_find_join(c->curve, from, to);
    c->balance[from]--;
    c->balance[to]++;
  }
  for (uint32_t p = 0; p < c->points->point.count; p++)
    if (c->balance[p] != 0) {
      c->bad[union_find_root(c->curve, p)] = CURVE_UNBALANCED;
      balanced = false;
    }
  return balanced;
}

bool cut_lines_close(struct cut_lines *lines, const struct cut_points *points,
                     size_t *open, uint32_t *open_at) {
  size_t count = points->point.count;
  struct curve_finder c = {.line = lines->line.item,
                           .lines = lines->line.count,
                           .points = points,
                           .curve = union_find_create(count),
                           .balance = mem_calloc(count, sizeof *c.balance),
                           .bad = mem_calloc(count, sizeof *c.bad)};
  bool ok = c.curve != NULL && c.balance != NULL && c.bad != NULL &&
            (join_cut_lines(&c) || repair_curves(&c)) && choose_groups(&c);
  for (uint32_t p = 0; ok && p < count; p++)
    if (c.bad[p] >= CURVE_OPEN) {
      *open += 1;
      *open_at = *open_at == SCENE_NONE ? points->first + p : *open_at;
    }
  mem_free(c.curve);
  mem_free(c.balance);
  mem_free(c.bad);
  number_lists_fini(&c.at);
  mem_free(c.degree);
  mem_free(c.walked);
  return ok;
}
