/* intersection.c - where two triangles pierce each other. */
#include "visibility/intersection/intersection.h"

#include "base/sort.h"
#include "visibility/predicate/occlusion.h"
#include "visibility/intersection/candidate_pairs.h"
#include "visibility/intersection/intersection_segment.h"
#include "visibility/progress.h"
#include "visibility/intersection/edge_crossing.h"

/* Of a pair in exact numbers, in units of a pulse. */
enum { PAIR_WORK = 16 };

struct intersection_search {
  const struct sheet *sheet;
  struct progress progress;
  struct intersection_segments segment;
  struct edge_crossings crossings;
  struct occluder occluder; /* of triangle `prepared` */
  uint32_t prepared;
  struct {
    uint64_t met;       /* pairs in one list, overlapping in depth */
    uint64_t pairs;     /* that doubles could not tell apart */
    uint64_t straddle;  /* of these, each reaches the other's plane */
    uint64_t crossings; /* crossings along an edge */
  } counts;
};

static bool straddles(struct side_count s) {
  return s.behind > 0 && s.before > 0;
}

/* Triangle f, prepared; it often is the one of the last pair too. */
static const struct occluder *prepare(struct intersection_search *pierce,
                                      uint32_t f) {
  if (pierce->prepared != f)
    occluder_init(&pierce->occluder, pierce->sheet, f);
  pierce->prepared = f;
  return &pierce->occluder;
}

/* Asks two triangles, flat ones too. */
static bool query_pair(void *user, uint32_t f, uint32_t g) {
  struct intersection_search *pierce = user;
  const struct sheet *sheet = pierce->sheet;
  const struct occluder *hf;
  struct geom_point p[3];
  struct occluder hg;
  struct side_count sf, sg;
  struct intersection_segment segment;
  if (sheet->triangle.item[f].face == sheet->triangle.item[g].face)
    return true;
  pierce->counts.pairs++;
  if (!progress_step(&pierce->progress, PAIR_WORK))
    return false;
  hf = prepare(pierce, f);
  for (int k = 0; k < 3; k++)
    p[k] = sheet->point.item[sheet->triangle.item[g].point[k]];
  sg = side_count_of(hf, p);
  if (!straddles(sg) && !ends_there(sg))
    return true;
  occluder_init(&hg, sheet, g);
  sf = side_count_of(&hg, hf->p);
  if (!straddles(sf) && !ends_there(sf))
    return true;
  pierce->counts.straddle++;
  if (ends_there(sf))
    return edge_crossings_note(&pierce->crossings, sheet, f, sf, g, sg);
  if (ends_there(sg))
    return edge_crossings_note(&pierce->crossings, sheet, g, sg, f, sf);
  if (intersection_segment_find(sheet, f, g, hf, &hg, &segment) &&
      !ARRAY_PUSH(&pierce->segment.list, segment))
    return false;
  return edge_crossings_note_slanted(&pierce->crossings, sheet, f, g, &hg) &&
         edge_crossings_note_slanted(&pierce->crossings, sheet, g, f, hf);
}

/* ---- Edges of the sheet -------------------------------------------------- */

static int compare_segments(const void *a, const void *b, void *user) {
  const struct intersection_segment *s = a, *t = b;
  (void)user;
  for (int k = 0; k < 2; k++)
    if (s->triangle[k] != t->triangle[k])
      return s->triangle[k] < t->triangle[k] ? -1 : 1;
  return 0;
}

static int compare_places(const struct intersection_segment *s,
                          const struct intersection_segment *t) {
  bool turn_s = geom_compare_points(s->end[0], s->end[1]) > 0,
       turn_t = geom_compare_points(t->end[0], t->end[1]) > 0;
  int order = geom_compare_points(s->end[turn_s], t->end[turn_t]);
  return order != 0 ? order
                    : geom_compare_points(s->end[!turn_s], t->end[!turn_t]);
}

static int compare_by_place(const void *a, const void *b, void *user) {
  int order = compare_places(a, b);
  return order != 0 ? order : compare_segments(a, b, user);
}

/* Where several pairs have one line in common it is one edge, of the first of
 * them, and in order of the triangles: so lists and cells of the grid, in which
 * pairs were met, leave no trace. */
static bool settle_segments(struct intersection_segments *segments) {
  struct intersection_segment *item = segments->list.item;
  size_t n = segments->list.count, kept = 0;
  if (!sort_stable(item, n, sizeof *item, compare_by_place, NULL))
    return false;
  for (size_t i = 0; i < n; i++)
    if (kept == 0 || compare_places(&item[kept - 1], &item[i]) != 0)
      item[kept++] = item[i];
  segments->list.count = kept;
  return sort_stable(item, kept, sizeof *item, compare_segments, NULL);
}

struct open_end {
  struct geom_point point;
  uint32_t segment, end;
};

static int compare_ends(const void *a, const void *b, void *user) {
  (void)user;
  return geom_compare_points(((const struct open_end *)a)->point,
                             ((const struct open_end *)b)->point);
}

/* Gives each end its point in the sheet, the same one for the same place. */
static bool add_points(struct sheet *sheet,
                       const struct intersection_search *pierce,
                       struct sheet_edge *edge) {
  size_t n = 2 * pierce->segment.list.count;
  struct open_end *end = mem_alloc(n, sizeof *end);
  bool ok = false;
  if (end == NULL)
    return false;
  for (size_t i = 0; i < n; i++)
    end[i] = (struct open_end){pierce->segment.list.item[i / 2].end[i % 2],
                               (uint32_t)(i / 2), (uint32_t)(i % 2)};
  if (!sort_stable(end, n, sizeof *end, compare_ends, NULL))
    goto end;
  for (size_t i = 0; i < n; i++) {
    if ((i == 0 || compare_ends(&end[i - 1], &end[i], NULL) != 0) &&
        !ARRAY_PUSH(&sheet->point, end[i].point))
      goto end;
    edge[end[i].segment].point[end[i].end] = (uint32_t)(sheet->point.count - 1);
  }
  ok = true;
end:
  mem_free(end);
  return ok;
}

/* Adds the segments to the sheet as drawable edges; ends at the same place become one point. */
static bool add_edges(struct sheet *sheet, struct intersection_search *pierce) {
  size_t n;
  struct sheet_edge *edge;
  if (pierce->segment.list.count == 0)
    return true;
  if (!settle_segments(&pierce->segment))
    return false;
  n = pierce->segment.list.count;
  if (!ARRAY_RESERVE(&sheet->edge, n))
    return false;
  edge = sheet->edge.item + sheet->edge.count;
  for (size_t i = 0; i < n; i++) {
    const struct intersection_segment *s = &pierce->segment.list.item[i];
    edge[i] = (struct sheet_edge){
        .triangle = {s->triangle[0], s->triangle[1]},
        .source = SHEET_NONE,
        .group = sheet->face_group[sheet->triangle.item[s->triangle[0]].face],
        .edge_class = RECTO_EDGE_INTERSECTION};
  }
  if (!add_points(sheet, pierce, edge))
    return false;
  sheet->edge.count += n;
  return true;
}

recto_status intersection_find_all(struct sheet *sheet,
                                   const struct triangle_grid *grid,
                                   const uint8_t *cells,
                                   const struct solver_request *request,
                                   struct report *report, recto_error *error) {
  struct intersection_search pierce = {.sheet = sheet,
                                       .progress =
                                           progress_of(request, "piercing"),
                                       .prepared = SHEET_NONE};
  bool ok = candidate_pairs(sheet, grid, cells, query_pair, &pierce,
                            &pierce.progress, &pierce.counts.met) &&
            edge_crossings_join(&pierce.crossings, sheet, &pierce.segment,
                                &pierce.counts.crossings) &&
            add_edges(sheet, &pierce);
  report_int(report, "pierce", "pairs_met", (int64_t)pierce.counts.met);
  report_int(report, "pierce", "pairs", (int64_t)pierce.counts.pairs);
  report_int(report, "pierce", "straddling", (int64_t)pierce.counts.straddle);
  report_int(report, "pierce", "along_edges", (int64_t)pierce.counts.crossings);
  report_int(report, "pierce", "segments", (int64_t)pierce.segment.list.count);
  ARRAY_FREE(&pierce.segment.list);
  edge_crossings_fini(&pierce.crossings);
  return ok ? RECTO_OK : progress_error(&pierce.progress, error);
}
