/* circle_clip_fill.c - what of a fill lies in a circle.
 *
 * The loops are divided where they cross the circle, and the parts inside are
 * joined by those arcs of the circle that are inside the fill
 * [WeilerAtherton1977].  Between crossings in the order of their angles the
 * circle is in the fill and out of it by turns. */
#include "drawing/circle_clip_fill.h"

#include "base/sort.h"

/* ---- Segments ------------------------------------------------------------ */

bool circle_clip_segment(const struct drawing_circle *circle,
                         struct drawing_point a, struct drawing_point b,
                         double t[2]) {
  bool from = circle_contains(circle, a), to = circle_contains(circle, b);
  t[0] = 0;
  t[1] = 1;
  if (from && to)
    return true;
  double ux = b.x - a.x, uy = b.y - a.y;
  double vx = a.x - circle->x, vy = a.y - circle->y;
  double uu = ux * ux + uy * uy, uv = ux * vx + uy * vy;
  double root =
      uv * uv - uu * (vx * vx + vy * vy - circle->radius * circle->radius);
  if (!(uu > 0) || !(root > 0 || from || to))
    return false;
  root = sqrt(fmax(root, 0));
  double first = fmin(fmax((-uv - root) / uu, 0), 1);
  double last = fmin(fmax((-uv + root) / uu, 0), 1);
  if (!from)
    t[0] = first;
  if (!to)
    t[1] = last;
  return from || to || first < last;
}

/* ---- Fills --------------------------------------------------------------- */

/* Where the outline of a fill crosses the circle: one end of a part inside. */
struct crossing {
  double angle;
  uint32_t part;
  bool is_end; /* of the part; else its begin */
  bool used;
};

struct fill_clip {
  ARRAY(struct drawing_point) point;
  ARRAY(struct drawing_loop) part; /* open, but for those of `whole` */
  ARRAY(struct crossing) crossing; /* two a part, later by angle */
  ARRAY(uint32_t) place;           /* of the begin and of the end of part i, at
                                      2 i and 2 i + 1: the crossing there */
};

static void fini_fill_clip(struct fill_clip *f) {
  ARRAY_FREE(&f->point);
  ARRAY_FREE(&f->part);
  ARRAY_FREE(&f->crossing);
  ARRAY_FREE(&f->place);
}

static double angle_of(const struct drawing_circle *circle,
                       struct drawing_point p) {
  return atan2(p.y - circle->y, p.x - circle->x);
}

static int compare_angles(const void *first, const void *second, void *user) {
  const struct crossing *a = first, *b = second;
  (void)user;
  return (a->angle > b->angle) - (a->angle < b->angle);
}

/* Whether a point is in a fill: a ray to the right crosses its sides an odd
 * number of times. */
static bool is_in_fill(const struct drawing *drawing,
                       const struct drawing_fill *fill,
                       struct drawing_point p) {
  bool inside = false;
  for (uint32_t l = 0; l < fill->loops; l++) {
    const struct drawing_loop *loop = &drawing->loop.item[fill->loop + l];
    const struct drawing_point *point = drawing->point.item + loop->point;
    for (uint32_t i = 0, k = loop->count - 1; i < loop->count; k = i++)
      if ((point[i].y > p.y) != (point[k].y > p.y) &&
          p.x < (point[k].x - point[i].x) * (p.y - point[i].y) /
                        (point[k].y - point[i].y) +
                    point[i].x)
        inside = !inside;
  }
  return inside;
}

static bool add_clipped_loop(struct circle_clip *clip, uint32_t begin) {
  struct drawing_loop loop = {begin, (uint32_t)clip->to.point.count - begin};
  if (loop.count < 3) {
    clip->to.point.count = begin;
    return true;
  }
  return ARRAY_PUSH(&clip->to.loop, loop);
}

/* Begins a part where a side enters the circle. */
static bool begin_part_inside(struct fill_clip *f, struct drawing_point p) {
  const struct drawing_loop part = {(uint32_t)f->point.count, 0};
  return ARRAY_PUSH(&f->part, part) && ARRAY_PUSH(&f->point, p);
}

/* Ends it where one leaves. */
static void end_part_inside(struct fill_clip *f) {
  struct drawing_loop *part = &f->part.item[f->part.count - 1];
  part->count = (uint32_t)f->point.count - part->point;
}

/* Divides a loop that has a point outside. */
static bool divide_loop(struct fill_clip *f,
                        const struct drawing_circle *circle,
                        const struct drawing_point *point, uint32_t count,
                        uint32_t outside) {
  bool is_open = false, ok = true;
  for (uint32_t i = 0; ok && i < count; i++) {
    struct drawing_point a = point[(outside + i) % count];
    struct drawing_point b = point[(outside + i + 1) % count];
    double t[2];
    if (!circle_clip_segment(circle, a, b, t)) {
      if (is_open)
        end_part_inside(f);
      is_open = false;
      continue;
    }
    if (!is_open)
      ok = begin_part_inside(f, drawing_point_between(a, b, t[0]));
    ok = ok && ARRAY_PUSH(&f->point,
                          t[1] < 1 ? drawing_point_between(a, b, t[1]) : b);
    is_open = ok && t[1] >= 1;
    if (ok && !is_open)
      end_part_inside(f);
  }
  if (ok && is_open) /* it ends on the circle, as its first point is outside */
    end_part_inside(f);
  return ok;
}

/* Keeps the loops that are inside, and divides the others. */
static bool divide_fill(struct circle_clip *clip, struct fill_clip *f,
                        const struct drawing_circle *circle,
                        const struct drawing_fill *fill) {
  bool ok = true;
  for (uint32_t l = 0; ok && l < fill->loops; l++) {
    const struct drawing_loop *loop = &clip->from->loop.item[fill->loop + l];
    const struct drawing_point *point = clip->from->point.item + loop->point;
    uint32_t outside = 0, begin = (uint32_t)clip->to.point.count;
    while (outside < loop->count && circle_contains(circle, point[outside]))
      outside++;
    if (outside < loop->count) {
      ok = divide_loop(f, circle, point, loop->count, outside);
      continue;
    }
    for (uint32_t i = 0; ok && i < loop->count; i++)
      ok = ARRAY_PUSH(&clip->to.point, point[i]);
    ok = ok && add_clipped_loop(clip, begin);
  }
  return ok;
}

/* Sorts the ends of all parts by angle. */
static bool sort_crossings(struct fill_clip *f,
                           const struct drawing_circle *circle) {
  for (uint32_t i = 0; i < f->part.count; i++) {
    const struct drawing_loop *part = &f->part.item[i];
    const struct drawing_point *point = f->point.item + part->point;
    const struct crossing begin = {angle_of(circle, point[0]), i, false, false};
    const struct crossing end = {angle_of(circle, point[part->count - 1]), i,
                                 true, false};
    if (!ARRAY_PUSH(&f->crossing, begin) || !ARRAY_PUSH(&f->crossing, end) ||
        !ARRAY_PUSH(&f->place, 0) || !ARRAY_PUSH(&f->place, 0))
      return false;
  }
  if (!sort_stable(f->crossing.item, f->crossing.count,
                   sizeof *f->crossing.item, compare_angles, NULL))
    return false;
  for (uint32_t i = 0; i < f->crossing.count; i++) {
    const struct crossing *crossing = &f->crossing.item[i];
    f->place.item[2 * crossing->part + crossing->is_end] = i;
  }
  return true;
}

/* The angle at which the arc behind a crossing ends. */
static double next_angle(const struct fill_clip *f, size_t crossing) {
  size_t next = (crossing + 1) % f->crossing.count;
  return f->crossing.item[next].angle + (next <= crossing ? 2 * acos(-1.0) : 0);
}

/* Adds the points of a part, which is entered at one of its crossings. */
static bool add_part_inside(struct circle_clip *clip, const struct fill_clip *f,
                            const struct crossing *from) {
  const struct drawing_loop *part = &f->part.item[from->part];
  bool ok = true;
  for (uint32_t i = 0; ok && i < part->count; i++) {
    uint32_t k = from->is_end ? part->count - 1 - i : i;
    ok = ARRAY_PUSH(&clip->to.point, f->point.item[part->point + k]);
  }
  return ok;
}

/* Joins parts by the arcs behind the crossings 2 k + first.  At a crossing an
 * arc meets a part: so a walk along arcs and parts by turns closes. */
static bool join_parts_inside(struct circle_clip *clip, struct fill_clip *f,
                              const struct drawing_circle *circle,
                              size_t first) {
  size_t count = f->crossing.count;
  bool ok = true;
  for (size_t start = first; ok && start < count; start += 2) {
    uint32_t begin = (uint32_t)clip->to.point.count;
    size_t at = start;
    while (ok && !f->crossing.item[at].used) {
      /* Along the arc behind `at`, or against it where that is its end. */
      bool behind = at % 2 == first;
      size_t other = behind ? (at + 1) % count : (at + count - 1) % count;
      size_t low = behind ? at : other;
      f->crossing.item[at].used = f->crossing.item[other].used = true;
      size_t before = clip->to.point.count;
      ok = drawing_add_arc(&clip->to, circle, f->crossing.item[low].angle,
                           next_angle(f, low));
      for (size_t i = before, k = clip->to.point.count - 1;
           ok && !behind && i < k; i++, k--) {
        struct drawing_point swap = clip->to.point.item[i];
        clip->to.point.item[i] = clip->to.point.item[k];
        clip->to.point.item[k] = swap;
      }
      const struct crossing *enter = &f->crossing.item[other];
      ok = ok && add_part_inside(clip, f, enter);
      at = f->place.item[2 * enter->part + !enter->is_end];
    }
    ok = ok && add_clipped_loop(clip, begin);
  }
  return ok;
}

/* The arcs that are in the fill: those behind crossings 0, 2 ... or 1, 3 ... */
static size_t find_first_arc(const struct circle_clip *clip,
                             const struct fill_clip *f,
                             const struct drawing_circle *circle,
                             const struct drawing_fill *fill) {
  size_t widest = 0;
  double width = 0;
  for (size_t i = 0; i < f->crossing.count; i++)
    if (next_angle(f, i) - f->crossing.item[i].angle > width) {
      width = next_angle(f, i) - f->crossing.item[i].angle;
      widest = i;
    }
  double middle = f->crossing.item[widest].angle + width / 2;
  const struct drawing_point p = {circle->x + circle->radius * cos(middle),
                                  circle->y + circle->radius * sin(middle)};
  return is_in_fill(clip->from, fill, p) ? widest % 2 : (widest + 1) % 2;
}

bool circle_clip_add_fill(struct circle_clip *clip, size_t index) {
  struct drawing_fill fill = clip->from->fill.item[index];
  struct drawing_circle circle = clip->circle;
  struct fill_clip f = {.point = {NULL, 0, 0}};
  uint32_t first = (uint32_t)clip->to.loop.count;
  circle.radius -= clip->from->seam_mm / 2;
  if (!(circle.radius > 0))
    return true;
  bool ok =
      divide_fill(clip, &f, &circle, &fill) && sort_crossings(&f, &circle);
  const struct drawing_point rim = {circle.x + circle.radius, circle.y};
  if (ok && f.crossing.count > 0) {
    ok = join_parts_inside(clip, &f, &circle,
                           find_first_arc(clip, &f, &circle, &fill));
  } else if (ok && is_in_fill(clip->from, &fill, rim)) {
    uint32_t begin = (uint32_t)clip->to.point.count;
    ok = drawing_add_arc(&clip->to, &circle, 0, 2 * acos(-1.0));
    if (ok)
      clip->to.point.count--; /* the first one again */
    ok = ok && add_clipped_loop(clip, begin);
  }
  fini_fill_clip(&f);
  struct drawing_fill part = fill;
  part.loop = first;
  part.loops = (uint32_t)clip->to.loop.count - first;
  if (!ok || part.loops == 0)
    return ok;
  return ARRAY_PUSH(&clip->to.fill, part) &&
         (clip->from->fill_source.count == 0 ||
          ARRAY_PUSH(&clip->to.fill_source,
                     clip->from->fill_source.item[index]));
}
