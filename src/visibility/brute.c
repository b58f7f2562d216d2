/* brute.c - the oracle: every edge against every triangle, every triangle
 * against every other.  Short, obvious, and kept so: the other exact solvers
 * are held against it.
 *
 * Source  Appel 1967 asks the same questions edge by edge; [Appel1967].
 */
#include "visibility/cover.h"
#include "visibility/pierce.h"
#include "visibility/pulse.h"
#include "visibility/solver.h"
#include "visibility/strokes.h"

static bool is_flat(const struct sheet *sheet, size_t triangle) {
  return sheet->triangle_flags[triangle] & SHEET_FLAT;
}

static bool solve_strokes(const struct sheet *sheet, struct map *map,
                          struct hide_counts *counts, struct pulse *pulse) {
  size_t n = sheet->triangle.count;
  struct hider *hider = mem_alloc(n, sizeof *hider);
  struct strokes strokes = {0};
  bool ok = false;
  if (hider == NULL || !strokes_open_map(map, sheet->edge.count))
    goto end;
  for (size_t t = 0; t < n; t++)
    hider_init(&hider[t], sheet, (uint32_t)t);
  for (size_t e = 0; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    struct geom_point p = sheet->point.item[edge->point[0]],
                      q = sheet->point.item[edge->point[1]];
    if (edge->edge_class == 0 || (p.x == q.x && p.y == q.y))
      continue;
    if (!pulse_beat_at(pulse, n, e, sheet->edge.count))
      goto end;
    strokes_start(&strokes);
    for (size_t t = 0; t < n; t++) {
      struct hidden_part part;
      bool own = t == edge->triangle[0] || t == edge->triangle[1];
      if (!own && !is_flat(sheet, t) &&
          hide_edge(&hider[t], p, q, &part, counts) &&
          !strokes_hide(&strokes, part))
        goto end;
    }
    if (!strokes_file(&strokes, (uint32_t)e, map))
      goto end;
  }
  ok = true;
end:
  mem_free(hider);
  strokes_fini(&strokes);
  return ok;
}

static bool solve_fragments(const struct sheet *sheet,
                            const struct pagegrid *grid, bool areas,
                            struct map *map, struct report *report,
                            struct pulse *pulse) {
  size_t n = sheet->triangle.count;
  struct fragments fragments;
  struct cover cover;
  bool ok = false;
  cover_init(&cover, sheet);
  if (!fragments_init(&fragments, sheet, grid, true))
    return false;
  fragments.pulse = pulse;
  fragments.report = report;
  for (size_t f = 0; f < n; f++) {
    if (is_flat(sheet, f))
      continue;
    if (!cover_start(&cover, (uint32_t)f, NULL))
      goto end;
    for (size_t g = 0; g < n; g++)
      if (g != f && !is_flat(sheet, g) &&
          (!pulse_beat_at(pulse, 1 + cover.left.count, f, n) ||
           !cover_take_nearer(&cover, (uint32_t)g)))
        goto end;
    if (!cover_file(&cover, &fragments))
      goto end;
  }
  ok = fragments_finish(&fragments, areas, map);
end:
  cover_report(&cover, report);
  cover_fini(&cover);
  fragments_fini(&fragments);
  return ok;
}

static recto_status solve(struct sheet *sheet,
                          const struct solver_request *request, struct map *map,
                          struct report *report, recto_error *error) {
  struct hide_counts counts = {0};
  struct pulse pulse = pulse_of(request, "edges");
  struct pagegrid grid;
  recto_status status = RECTO_OK;
  if (!pagegrid_init(&grid, sheet))
    return error_memory(error);
  if (request->intersections)
    status = pierce_all(sheet, &grid, NULL, request, report, error);
  if (status == RECTO_OK && request->strokes &&
      !solve_strokes(sheet, map, &counts, &pulse))
    status = pulse_error(&pulse, error);
  pulse.stage = "faces";
  if (status == RECTO_OK && request->fragments &&
      !solve_fragments(sheet, &grid, request->areas, map, report, &pulse))
    status = pulse_error(&pulse, error);
  hide_report(&counts, report);
  pagegrid_fini(&grid);
  return status;
}

const struct solver solver_brute = {RECTO_METHOD_BRUTE, "brute", true, solve};
