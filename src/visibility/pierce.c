/* pierce.c - where two triangles pierce each other. */
#include "visibility/pierce.h"

#include <math.h>

#include "base/sort.h"

/* Are corners on both sides of the plane, beyond contact? */
static bool straddles(const struct hider *plane, const struct geom_point p[3]) {
  bool behind = false, before = false;
  for (int k = 0; k < 3; k++) {
    int side = hider_side(plane, p[k]);
    behind |= side < 0;
    before |= side > 0;
  }
  return behind && before;
}

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

bool pierce_pair(const struct sheet *sheet, const struct hider *hf, uint32_t f,
                 uint32_t g, struct pierce_segment *segment,
                 struct pierce_counts *counts) {
  struct ends ends = {0};
  struct geom_point p[3];
  struct hider hg;
  if (sheet->triangle.item[f].face == sheet->triangle.item[g].face)
    return false;
  counts->pairs++;
  for (int k = 0; k < 3; k++)
    p[k] = sheet->point.item[sheet->triangle.item[g].point[k]];
  if (!straddles(hf, p)) return false;
  hider_init(&hg, sheet, g);
  if (!straddles(&hg, hf->p)) return false;
  counts->straddle++;
  if (shared_corners(hf->p, p) > 1) return false;
  find_ends(sheet, f, &hg, &ends);
  find_ends(sheet, g, hf, &ends);
  if (ends.count < 2 ||
      (ends.low.x == ends.high.x && ends.low.y == ends.high.y))
    return false;
  counts->segments++;
  *segment = (struct pierce_segment){{f < g ? f : g, f < g ? g : f},
                                     {ends.low, ends.high}};
  return true;
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
static bool add_points(struct sheet *sheet, const pierce_segments *segments,
                       struct sheet_edge *edge) {
  size_t n = 2 * segments->count;
  struct loose_end *end = mem_alloc(n, sizeof *end);
  bool done = false;
  if (end == NULL) return false;
  for (size_t i = 0; i < n; i++)
    end[i] = (struct loose_end){segments->item[i / 2].end[i % 2],
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

bool pierce_add_edges(struct sheet *sheet, pierce_segments *segments) {
  size_t n = segments->count;
  struct sheet_edge *edge;
  if (n == 0) return true;
  if (!sort_stable(segments->item, n, sizeof *segments->item, compare_segments,
                   NULL) ||
      !ARRAY_RESERVE(&sheet->edge, n))
    return false;
  edge = sheet->edge.item + sheet->edge.count;
  for (size_t i = 0; i < n; i++) {
    const struct pierce_segment *s = &segments->item[i];
    edge[i] = (struct sheet_edge){
        .triangle = {s->triangle[0], s->triangle[1]},
        .source = SHEET_NONE,
        .group = sheet->face_group[
            sheet->triangle.item[s->triangle[0]].face],
        .edge_class = RECTO_EDGE_INTERSECTION};
  }
  if (!add_points(sheet, segments, edge)) return false;
  sheet->edge.count += n;
  return true;
}

/* ---- All pairs -------------------------------------------------------------- */

/* What is asked first of a triangle, gathered once a cell. */
struct summary {
  struct page_box box;
  int64_t low, high; /* depths */
  uint32_t triangle;
};

static struct summary summarise(const struct sheet *sheet, uint32_t triangle) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  struct summary s = {page_box_of_triangle(sheet, triangle),
                      sheet->point.item[p[0]].z, sheet->point.item[p[0]].z,
                      triangle};
  for (int k = 1; k < 3; k++) {
    int64_t z = sheet->point.item[p[k]].z;
    if (z < s.low) s.low = z;
    if (z > s.high) s.high = z;
  }
  return s;
}

/* A pair stands in several cells; it is asked in the one where the lower left
 * corner of what their boxes share is. */
static bool is_cell_of_pair(const struct pagegrid *grid, int x, int y,
                            const struct summary *f, const struct summary *g) {
  int32_t px = page_most(f->box.x0, g->box.x0),
          py = page_most(f->box.y0, g->box.y0);
  return pagegrid_cell(px, grid->x0, grid->shift, grid->columns) == x &&
         pagegrid_cell(py, grid->y0, grid->shift, grid->rows) == y;
}

static bool share_an_edge(const struct sheet_triangle *f,
                          const struct sheet_triangle *g) {
  int shared = 0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) shared += f->point[i] == g->point[j];
  return shared > 1;
}

/* The plane of a triangle in doubles, with bounds for their errors. */
struct rough_plane {
  struct geom_point a;
  double nx, ny, nz, ex, ey, ez;
};

static struct rough_plane rough_plane_of(const struct sheet *sheet,
                                         uint32_t triangle) {
  const uint32_t *t = sheet->triangle.item[triangle].point;
  struct geom_point a = sheet->point.item[t[0]], b = sheet->point.item[t[1]],
                    c = sheet->point.item[t[2]];
  double ux = (double)b.x - a.x, uy = (double)b.y - a.y,
         uz = (double)(b.z - a.z), vx = (double)c.x - a.x,
         vy = (double)c.y - a.y, vz = (double)(c.z - a.z);
  return (struct rough_plane){a,
                              uy * vz - uz * vy,
                              uz * vx - ux * vz,
                              ux * vy - uy * vx,
                              fabs(uy * vz) + fabs(uz * vy),
                              fabs(uz * vx) + fabs(ux * vz),
                              fabs(ux * vy) + fabs(uy * vx)};
}

/* Do all corners of a triangle lie on one side of the plane, for certain?
 * Two roundings of the products, one of the difference, three more in the
 * value: 16 times the unit is room enough. */
static bool on_one_side(const struct sheet *sheet,
                        const struct rough_plane *plane, uint32_t triangle) {
  const uint32_t *t = sheet->triangle.item[triangle].point;
  int sum = 0;
  for (int k = 0; k < 3; k++) {
    struct geom_point p = sheet->point.item[t[k]];
    double x = (double)p.x - plane->a.x, y = (double)p.y - plane->a.y,
           z = (double)(p.z - plane->a.z);
    double value = plane->nx * x + plane->ny * y + plane->nz * z;
    double bound = 16 * 0x1p-53 *
                   (plane->ex * fabs(x) + plane->ey * fabs(y) +
                    plane->ez * fabs(z));
    sum += (value > bound) - (value < -bound);
  }
  return sum == 3 || sum == -3;
}

/* The pairs of summary[0] with the `count` - 1 behind it. */
static bool pierce_first(const struct sheet *sheet, const struct pagegrid *grid,
                         int x, int y, const struct summary *summary,
                         size_t count, pierce_segments *segments,
                         struct pierce_counts *counts) {
  const struct summary *f = summary;
  struct rough_plane plane = rough_plane_of(sheet, f->triangle);
  struct hider hider;
  bool prepared = false;
  for (size_t i = 1; i < count; i++) {
    const struct summary *g = &summary[i];
    struct pierce_segment segment;
    if (page_boxes_apart(f->box, g->box) || g->high < f->low ||
        f->high < g->low || on_one_side(sheet, &plane, g->triangle) ||
        share_an_edge(&sheet->triangle.item[f->triangle],
                      &sheet->triangle.item[g->triangle]) ||
        !is_cell_of_pair(grid, x, y, f, g))
      continue;
    if (!prepared) hider_init(&hider, sheet, f->triangle);
    prepared = true;
    if (pierce_pair(sheet, &hider, f->triangle, g->triangle, &segment,
                    counts) &&
        !ARRAY_PUSH(segments, segment))
      return false;
  }
  return true;
}

static bool pierce_cells(const struct sheet *sheet, const struct pagegrid *grid,
                         pierce_segments *segments,
                         struct pierce_counts *counts) {
  ARRAY(struct summary) summary = {0};
  bool done = true;
  for (int y = 0; y < grid->rows && done; y++)
    for (int x = 0; x < grid->columns && done; x++) {
      size_t cell = (size_t)y * (size_t)grid->columns + (size_t)x;
      size_t n = grid->start[cell + 1] - grid->start[cell];
      summary.count = 0;
      if (n < 2) continue;
      if (!ARRAY_RESERVE(&summary, n)) {
        done = false;
        break;
      }
      for (size_t i = 0; i < n; i++)
        summary.item[i] =
            summarise(sheet, grid->item[grid->start[cell] + i]);
      for (size_t i = 0; i + 1 < n && done; i++)
        done = pierce_first(sheet, grid, x, y, &summary.item[i], n - i,
                            segments, counts);
    }
  ARRAY_FREE(&summary);
  return done;
}

recto_status pierce_all(struct sheet *sheet, const struct pagegrid *grid,
                        struct report *report, recto_error *error) {
  pierce_segments segments = {0};
  struct pierce_counts counts = {0};
  bool done = pierce_cells(sheet, grid, &segments, &counts) &&
              pierce_add_edges(sheet, &segments);
  report_int(report, "pierce", "pairs", (int64_t)counts.pairs);
  report_int(report, "pierce", "straddling", (int64_t)counts.straddle);
  report_int(report, "pierce", "segments", (int64_t)counts.segments);
  ARRAY_FREE(&segments);
  return done ? RECTO_OK : error_memory(error);
}
