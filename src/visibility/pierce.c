/* pierce.c - where two triangles pierce each other. */
#include "visibility/pierce.h"

#include "base/sort.h"
#include "base/tolerance.h"
#include "visibility/hide.h"
#include "visibility/pierce_pairs.h"

struct pierce_segment {
  uint32_t triangle[2]; /* the lower first */
  struct geom_point end[2];
};

struct seam_side {
  uint32_t i, j;     /* ends of an edge, i < j; or i: a triangle, j: none */
  uint32_t triangle; /* the one that ends there, or that triangle */
};

/* One triangle that ends on another's plane, or two that end on each
 * other's: half of a crossing, or a quarter. */
struct seam {
  struct seam_side side[2]; /* the lower first */
  int signs;                /* bits: SEAM_BEHIND << 2 k, SEAM_BEFORE << 2 k */
};

enum { SEAM_BEHIND = 1, SEAM_BEFORE = 2 };

enum { ASK_EVERY = 1 << 18 }; /* pairs met between two calls of progress */

struct pierce {
  const struct sheet *sheet;
  const struct solver_request *request; /* NULL: nobody is asked */
  uint64_t asked;                       /* pairs met when it was asked last */
  bool cancelled;
  ARRAY(struct pierce_segment) segment;
  ARRAY(struct seam) seam;
  struct hider hider; /* of triangle `prepared` */
  uint32_t prepared;
  struct {
    uint64_t met;      /* pairs in one list, overlapping in depth */
    uint64_t pairs;    /* that doubles could not tell apart */
    uint64_t straddle; /* of these, each reaches the other's plane */
    uint64_t seams;    /* crossings along an edge */
  } counts;
};

/* How a triangle's corners lie to a plane, beyond contact or touching it. */
struct stance {
  int behind, before; /* how many corners */
  int apart;          /* the last corner that does not touch */
};

static struct stance stance_of(const struct hider *plane,
                               const struct geom_point p[3]) {
  struct stance stance = {0, 0, 0};
  for (int k = 0; k < 3; k++) {
    int side = hider_side(plane, p[k]);
    stance.behind += side < 0;
    stance.before += side > 0;
    if (side != 0) stance.apart = k;
  }
  return stance;
}

static bool straddles(struct stance s) { return s.behind > 0 && s.before > 0; }

/* Two corners touch the plane: the triangle ends there, along a side. */
static bool ends_there(struct stance s) { return s.behind + s.before == 1; }

/* The sign of the volume of a, b, c, d. */
static int volume_sign(struct geom_point a, struct geom_point b,
                       struct geom_point c, struct geom_point d) {
  struct geom_plane plane = geom_plane_of(a, b, c);
  return geom_sign128(geom_plane_value(&plane, d));
}

static bool line_meets(struct geom_point a, struct geom_point b,
                       const struct geom_point p[3]) {
  bool left = false, right = false;
  for (int k = 0; k < 3; k++) {
    int side = volume_sign(a, b, p[k], p[k == 2 ? 0 : k + 1]);
    left |= side > 0;
    right |= side < 0;
  }
  return !(left && right);
}

static int compare_points(struct geom_point a, struct geom_point b) {
  if (a.x != b.x) return a.x < b.x ? -1 : 1;
  if (a.y != b.y) return a.y < b.y ? -1 : 1;
  return (a.z > b.z) - (a.z < b.z);
}

/* The ends found so far along the common line, the least and the greatest. */
struct ends {
  int count;
  struct geom_point low, high;
};

static void add_end(struct ends *ends, struct geom_point p) {
  if (ends->count == 0 || compare_points(p, ends->low) < 0) ends->low = p;
  if (ends->count == 0 || compare_points(p, ends->high) > 0) ends->high = p;
  ends->count++;
}

/* Where edges of triangle f go through triangle g. */
static void find_ends(const struct sheet *sheet, uint32_t f,
                      const struct hider *hg, struct ends *ends) {
  const uint32_t *point = sheet->triangle.item[f].point;
  for (int k = 0; k < 3; k++) {
    uint32_t i = point[k], j = point[k == 2 ? 0 : k + 1];
    struct geom_point a, b;
    int128 va, vb;
    struct ratio t;
    if (i > j) { /* one direction, whichever triangle asks */
      uint32_t swap = i;
      i = j;
      j = swap;
    }
    a = sheet->point.item[i];
    b = sheet->point.item[j];
    va = geom_plane_value(&hg->plane, a);
    vb = geom_plane_value(&hg->plane, b);
    if ((va > 0 && vb > 0) || (va < 0 && vb < 0) || va == vb) continue;
    if (!line_meets(a, b, hg->p)) continue;
    t = va > vb ? (struct ratio){va, va - vb} : (struct ratio){-va, vb - va};
    add_end(ends,
            (struct geom_point){(int32_t)ratio_lerp(t, a.x, b.x),
                                (int32_t)ratio_lerp(t, a.y, b.y),
                                ratio_lerp(t, a.z, b.z)});
  }
}

static int shared_corners(const struct geom_point f[3],
                          const struct geom_point g[3]) {
  int shared = 0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) shared += geom_same_point(f[i], g[j]);
  return shared;
}

/* Triangles f and g straddle each other's planes: the segment they share. */
static bool find_segment(const struct sheet *sheet, uint32_t f, uint32_t g,
                         const struct hider *hf, const struct hider *hg,
                         struct pierce_segment *segment) {
  struct ends ends = {0};
  if (shared_corners(hf->p, hg->p) > 1) return false;
  find_ends(sheet, f, hg, &ends);
  find_ends(sheet, g, hf, &ends);
  if (ends.count < 2 ||
      (ends.low.x == ends.high.x && ends.low.y == ends.high.y))
    return false;
  *segment = (struct pierce_segment){{f < g ? f : g, f < g ? g : f},
                                     {ends.low, ends.high}};
  return true;
}

/* ---- Crossing along an edge -------------------------------------------------- */

static struct seam_side seam_edge(const struct sheet *sheet, uint32_t triangle,
                                  struct stance stance) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  uint32_t i = p[(stance.apart + 1) % 3], j = p[(stance.apart + 2) % 3];
  return (struct seam_side){i < j ? i : j, i < j ? j : i, triangle};
}

static int seam_sign(struct stance stance) {
  return stance.behind > 0 ? SEAM_BEHIND : SEAM_BEFORE;
}

static int compare_seam_sides(struct seam_side a, struct seam_side b) {
  if (a.j != b.j) return a.j < b.j ? -1 : 1;
  return (a.i > b.i) - (a.i < b.i);
}

/* Triangle f ends on the plane of g, which straddles f's or ends on it. */
static bool add_seam(struct pierce *pierce, uint32_t f, struct stance sf,
                     uint32_t g, struct stance sg) {
  struct seam seam = {{seam_edge(pierce->sheet, f, sf), {g, SHEET_NONE, g}},
                      seam_sign(sf)};
  if (ends_there(sg)) {
    seam.side[1] = seam_edge(pierce->sheet, g, sg);
    seam.signs |= seam_sign(sg) << 2;
  }
  if (compare_seam_sides(seam.side[0], seam.side[1]) > 0) {
    struct seam_side swap = seam.side[0];
    seam.side[0] = seam.side[1];
    seam.side[1] = swap;
    seam.signs = (seam.signs >> 2) | ((seam.signs & 3) << 2);
  }
  return ARRAY_PUSH(&pierce->seam, seam);
}

static int compare_seams(const void *a, const void *b, void *user) {
  const struct seam *s = a, *t = b;
  int order = compare_seam_sides(s->side[0], t->side[0]);
  (void)user;
  return order != 0 ? order : compare_seam_sides(s->side[1], t->side[1]);
}

/* The part of edge i-j that triangle g covers on the page. */
static bool clip_to_triangle(const struct sheet *sheet, struct seam_side edge,
                             uint32_t g, struct geom_point end[2]) {
  const uint32_t *t = sheet->triangle.item[g].point;
  const struct geom_point corner[3] = {sheet->point.item[t[0]],
                                       sheet->point.item[t[1]],
                                       sheet->point.item[t[2]]},
                          p = sheet->point.item[edge.i],
                          q = sheet->point.item[edge.j];
  struct hidden_part part;
  if ((sheet->triangle_flags[g] & SHEET_FLAT) ||
      !hide_by_outline(corner, p, q, &part))
    return false;
  for (int k = 0; k < 2; k++) {
    struct ratio t_k = k == 0 ? part.from : part.to;
    end[k] = (struct geom_point){(int32_t)ratio_lerp(t_k, p.x, q.x),
                                 (int32_t)ratio_lerp(t_k, p.y, q.y),
                                 ratio_lerp(t_k, p.z, q.z)};
  }
  return true;
}

/* Does p lie on the line through a and b on the page, but for rounding? */
static bool is_near_line(struct geom_point a, struct geom_point b,
                         struct geom_point p) {
  const int128 near = TOLERANCE_COINCIDENT_UNITS;
  int64_t x = (int64_t)b.x - a.x, y = (int64_t)b.y - a.y,
          off = geom_orient2d(a, b, p);
  return (int128)off * off <= near * near * ((int128)x * x + (int128)y * y);
}

/* What two edges share: the middle two of their ends, where these lie on both.
 * Edges of faces that are all but in one plane touch each other's planes
 * wherever they run. */
static bool clip_to_edge(const struct sheet *sheet, struct seam_side e,
                         struct seam_side f, struct geom_point end[2]) {
  struct geom_point a = sheet->point.item[e.i], b = sheet->point.item[e.j],
                    c = sheet->point.item[f.i], d = sheet->point.item[f.j], s;
  if (compare_points(a, b) > 0) {
    s = a;
    a = b;
    b = s;
  }
  if (compare_points(c, d) > 0) {
    s = c;
    c = d;
    d = s;
  }
  end[0] = compare_points(a, c) > 0 ? a : c;
  end[1] = compare_points(b, d) < 0 ? b : d;
  for (int k = 0; k < 2; k++)
    if (!is_near_line(a, b, end[k]) || !is_near_line(c, d, end[k]))
      return false;
  return compare_points(end[0], end[1]) < 0;
}

/* Where triangles end on a plane from both sides, they cross it there. */
static bool join_seams(struct pierce *pierce) {
  size_t n = pierce->seam.count;
  struct seam *seam = pierce->seam.item;
  if (!sort_stable(seam, n, sizeof *seam, compare_seams, NULL)) return false;
  for (size_t i = 0, j; i < n; i = j) {
    struct seam all = seam[i];
    struct pierce_segment segment;
    bool edge_0 = all.side[0].j != SHEET_NONE,
         edge_1 = all.side[1].j != SHEET_NONE;
    int needed = (edge_0 ? 3 : 0) | (edge_1 ? 12 : 0);
    for (j = i + 1; j < n && compare_seams(&seam[i], &seam[j], NULL) == 0; j++)
      for (int k = 0; k < 2; k++) {
        all.signs |= seam[j].signs;
        if (seam[j].side[k].triangle < all.side[k].triangle)
          all.side[k].triangle = seam[j].side[k].triangle;
      }
    if ((all.signs & needed) != needed) continue;
    if (!(edge_0 && edge_1
              ? clip_to_edge(pierce->sheet, all.side[0], all.side[1],
                             segment.end)
              : clip_to_triangle(pierce->sheet, all.side[edge_0 ? 0 : 1],
                                 all.side[edge_0 ? 1 : 0].triangle,
                                 segment.end)) ||
        (segment.end[0].x == segment.end[1].x &&
         segment.end[0].y == segment.end[1].y))
      continue;
    segment.triangle[0] = all.side[0].triangle < all.side[1].triangle
                              ? all.side[0].triangle
                              : all.side[1].triangle;
    segment.triangle[1] = all.side[0].triangle < all.side[1].triangle
                              ? all.side[1].triangle
                              : all.side[0].triangle;
    pierce->counts.seams++;
    if (!ARRAY_PUSH(&pierce->segment, segment)) return false;
  }
  return true;
}

/* Triangle f, prepared; it often is the one of the last pair too. */
static const struct hider *prepare(struct pierce *pierce, uint32_t f) {
  if (pierce->prepared != f) hider_init(&pierce->hider, pierce->sheet, f);
  pierce->prepared = f;
  return &pierce->hider;
}

/* Asks two triangles, flat ones too. */
static bool ask_pair(void *user, uint32_t f, uint32_t g) {
  struct pierce *pierce = user;
  const struct sheet *sheet = pierce->sheet;
  const struct hider *hf;
  struct geom_point p[3];
  struct hider hg;
  struct stance sf, sg;
  struct pierce_segment segment;
  if (sheet->triangle.item[f].face == sheet->triangle.item[g].face)
    return true;
  pierce->counts.pairs++;
  hf = prepare(pierce, f);
  for (int k = 0; k < 3; k++)
    p[k] = sheet->point.item[sheet->triangle.item[g].point[k]];
  sg = stance_of(hf, p);
  if (!straddles(sg) && !ends_there(sg)) return true;
  hider_init(&hg, sheet, g);
  sf = stance_of(&hg, hf->p);
  if (!straddles(sf) && !ends_there(sf)) return true;
  pierce->counts.straddle++;
  if (ends_there(sf)) return add_seam(pierce, f, sf, g, sg);
  if (ends_there(sg)) return add_seam(pierce, g, sg, f, sf);
  return !find_segment(sheet, f, g, hf, &hg, &segment) ||
         ARRAY_PUSH(&pierce->segment, segment);
}

/* Asks now and then whether to go on. */
static bool go_on(void *user) {
  struct pierce *pierce = user;
  const struct solver_request *request = pierce->request;
  if (request == NULL || request->progress == NULL ||
      pierce->counts.met - pierce->asked < ASK_EVERY)
    return true;
  pierce->asked = pierce->counts.met;
  pierce->cancelled = !request->progress(request->user, 0, "piercing");
  return !pierce->cancelled;
}

/* ---- Edges of the sheet ---------------------------------------------------- */

static int compare_segments(const void *a, const void *b, void *user) {
  const struct pierce_segment *s = a, *t = b;
  (void)user;
  for (int k = 0; k < 2; k++)
    if (s->triangle[k] != t->triangle[k])
      return s->triangle[k] < t->triangle[k] ? -1 : 1;
  return 0;
}

struct loose_end {
  struct geom_point point;
  uint32_t segment, end;
};

static int compare_ends(const void *a, const void *b, void *user) {
  (void)user;
  return compare_points(((const struct loose_end *)a)->point,
                        ((const struct loose_end *)b)->point);
}

/* Gives each end its point in the sheet, the same one for the same place. */
static bool add_points(struct sheet *sheet, const struct pierce *pierce,
                       struct sheet_edge *edge) {
  size_t n = 2 * pierce->segment.count;
  struct loose_end *end = mem_alloc(n, sizeof *end);
  bool done = false;
  if (end == NULL) return false;
  for (size_t i = 0; i < n; i++)
    end[i] = (struct loose_end){pierce->segment.item[i / 2].end[i % 2],
                                (uint32_t)(i / 2), (uint32_t)(i % 2)};
  if (!sort_stable(end, n, sizeof *end, compare_ends, NULL)) goto end;
  for (size_t i = 0; i < n; i++) {
    if ((i == 0 || compare_ends(&end[i - 1], &end[i], NULL) != 0) &&
        !ARRAY_PUSH(&sheet->point, end[i].point))
      goto end;
    edge[end[i].segment].point[end[i].end] =
        (uint32_t)(sheet->point.count - 1);
  }
  done = true;
end:
  mem_free(end);
  return done;
}

/* Adds the segments to the sheet as drawable edges, ordered by their
 * triangles; ends at the same place become one point. */
static bool add_edges(struct sheet *sheet, struct pierce *pierce) {
  size_t n = pierce->segment.count;
  struct sheet_edge *edge;
  if (n == 0) return true;
  if (!sort_stable(pierce->segment.item, n, sizeof *pierce->segment.item,
                   compare_segments, NULL) ||
      !ARRAY_RESERVE(&sheet->edge, n))
    return false;
  edge = sheet->edge.item + sheet->edge.count;
  for (size_t i = 0; i < n; i++) {
    const struct pierce_segment *s = &pierce->segment.item[i];
    edge[i] = (struct sheet_edge){
        .triangle = {s->triangle[0], s->triangle[1]},
        .source = SHEET_NONE,
        .group = sheet->face_group[
            sheet->triangle.item[s->triangle[0]].face],
        .edge_class = RECTO_EDGE_INTERSECTION};
  }
  if (!add_points(sheet, pierce, edge)) return false;
  sheet->edge.count += n;
  return true;
}

recto_status pierce_all(struct sheet *sheet, const struct pagegrid *grid,
                        const uint8_t *cells,
                        const struct solver_request *request,
                        struct report *report, recto_error *error) {
  struct pierce pierce = {
      .sheet = sheet, .request = request, .prepared = SHEET_NONE};
  bool done = pierce_pairs(sheet, grid, cells, ask_pair, go_on, &pierce,
                           &pierce.counts.met) &&
              join_seams(&pierce) && add_edges(sheet, &pierce);
  report_int(report, "pierce", "pairs_met", (int64_t)pierce.counts.met);
  report_int(report, "pierce", "pairs", (int64_t)pierce.counts.pairs);
  report_int(report, "pierce", "straddling", (int64_t)pierce.counts.straddle);
  report_int(report, "pierce", "along_edges", (int64_t)pierce.counts.seams);
  report_int(report, "pierce", "segments", (int64_t)pierce.segment.count);
  ARRAY_FREE(&pierce.segment);
  ARRAY_FREE(&pierce.seam);
  if (pierce.cancelled)
    return error_set(error, RECTO_ERROR_CANCELLED, NULL, 0, "cancelled");
  return done ? RECTO_OK : error_memory(error);
}
