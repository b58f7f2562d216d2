/* hatch.c - hatches the visible fragments by parallel lines at one pitch.
 *
 * Phases
 *   regions   of fragments that no drawn line separates (hatch_regions.h)
 *   strokes   of each region (hatch_region.c).  Threads hatch ranges of
 *             regions; where there are several, the strokes of each range are
 *             kept apart, and joined in order. */
#include "ink/hatch/hatch.h"

#include "base/parallel.h"
#include "ink/cut_hatch.h"
#include "ink/hatch/hatch_region.h"

enum { FRAGMENTS_IN_RANGE = PARALLEL_RANGE(1024) };

/* What is hatched, by all threads. */
struct hatching {
  struct drawing *drawing;
  const struct sheet *sheet;
  const struct scene *scene;
  const struct map *map;
  const struct pens *pens;
  const recto_options *options;
  struct hatch_regions regions;
  bool cuts; /* cut faces are, or all others */
  /* One a group: only those like `style` are; NULL: all. */
  const struct cut_hatch *of_group, *style;
  struct hatch *worker;
  struct drawing *part; /* the strokes of each range; NULL: one thread draws */
};

static bool is_hatched(const struct hatching *all, uint32_t face) {
  uint32_t group = scene_face_group(all->scene, face);
  return scene_is_cut_face(all->scene, face) == all->cuts &&
         (all->of_group == NULL ||
          (all->of_group[group].angle_deg == all->style->angle_deg &&
           all->of_group[group].pitch_mm == all->style->pitch_mm));
}

/* Hatches the region whose fragments are from `begin` to before `end`. */
static bool hatch_region_at(const struct hatching *all, struct hatch *h,
                            size_t begin, size_t end) {
  uint32_t first = all->regions.fragment[begin];
  uint32_t face = all->map->fragment.item[first].face;
  uint32_t group = scene_face_group(all->scene, face);
  if (!is_hatched(all, face))
    return true;
  h->pen = pens_of_hatch(all->pens, group);
  double half_pen = pens_width_mm(all->pens, h->pen) / 2;
  h->inset = all->options->ink.hatch_inset ? half_pen : 0;
  h->inked_distance = h->inset + half_pen;
  h->shortest = pens_shortest_hatch_mm(all->pens, h->pen);
  h->attributes = (struct drawing_stroke){
      .layer = h->pen, .face = face, .edge = DRAWING_NONE, .group = group};
  return hatch_region(h, all->map, begin, end);
}

/* Hatches the regions that begin in a range of the fragments. */
static bool hatch_range(void *user, struct parallel_range range) {
  const struct hatching *all = user;
  struct hatch *h = &all->worker[range.worker];
  h->drawing = all->part == NULL ? all->drawing
                                 : &all->part[range.begin / FRAGMENTS_IN_RANGE];
  size_t i = range.begin;
  while (i < range.end && !hatch_regions_begins(&all->regions, i))
    i++;
  for (size_t end, n = 0; i < range.end; i = end, n++) {
    end = hatch_regions_end(&all->regions, i);
    if (!poll_at(n) || !hatch_region_at(all, h, i, end))
      return false;
  }
  return true;
}

/* Moves the strokes of all ranges to the drawing, unless `ok` is false, and
 * frees them. */
static bool join_strokes(const struct hatching *all, size_t ranges, bool ok) {
  for (size_t r = 0; all->part != NULL && r < ranges; r++) {
    ok = ok && stroke_move_all(all->drawing, &all->part[r]);
    drawing_fini(&all->part[r]);
  }
  return ok;
}

/* Hatches all regions that are to be hatched. */
static bool hatch_regions(struct hatching *all, double pitch_mm,
                          double angle_deg) {
  size_t count = all->map->fragment.count;
  size_t ranges = parallel_range_count(count, FRAGMENTS_IN_RANGE);
  int workers = parallel_workers(count, FRAGMENTS_IN_RANGE);
  all->worker = mem_calloc((size_t)workers, sizeof *all->worker);
  all->part = workers > 1 ? mem_calloc(ranges, sizeof *all->part) : NULL;
  bool ok = all->worker != NULL && (workers == 1 || all->part != NULL);
  for (int w = 0; ok && w < workers; w++) {
    all->worker[w] = (struct hatch){
        .sheet = all->sheet, .regions = &all->regions, .pens = all->pens};
    hatch_init(&all->worker[w], pitch_mm, angle_deg);
  }
  ok = ok &&
       parallel_ranges(workers, count, FRAGMENTS_IN_RANGE, hatch_range, all);
  ok = join_strokes(all, ranges, ok);
  for (int w = 0; all->worker != NULL && w < workers; w++)
    hatch_fini(&all->worker[w]);
  mem_free(all->worker);
  mem_free(all->part);
  return ok;
}

bool hatch_add(struct drawing *drawing, const struct sheet *sheet,
               const struct scene *scene, const struct map *map,
               const struct pens *pens, const recto_options *options) {
  struct hatching all = {.drawing = drawing,
                         .sheet = sheet,
                         .scene = scene,
                         .map = map,
                         .pens = pens,
                         .options = options};
  bool ok =
      hatch_regions_init(&all.regions, sheet, scene, map, pens, options) &&
      hatch_regions(&all, options->ink.hatch_pitch_mm,
                    options->ink.hatch_angle_deg);
  hatch_regions_fini(&all.regions);
  return ok;
}

/* Whether a group before this one has the same hatching. */
static bool is_hatched_before(const struct cut_hatch *hatch, size_t group) {
  for (size_t g = 0; g < group; g++)
    if (hatch[g].angle_deg == hatch[group].angle_deg &&
        hatch[g].pitch_mm == hatch[group].pitch_mm)
      return true;
  return false;
}

bool hatch_add_cuts(struct drawing *drawing, const struct sheet *sheet,
                    const struct scene *scene, const struct map *map,
                    const struct pens *pens, const recto_options *options) {
  struct cut_hatch *hatch = cut_hatch_of_groups(scene, pens, options);
  struct hatching all = {.drawing = drawing,
                         .sheet = sheet,
                         .scene = scene,
                         .map = map,
                         .pens = pens,
                         .options = options,
                         .cuts = true,
                         .of_group = hatch};
  bool ok = hatch != NULL &&
            hatch_regions_init(&all.regions, sheet, scene, map, pens, options);
  /* Nothing pierces a cut face: surfaces end on it, and no line is drawn. */
  all.regions.intersections = false;
  for (size_t g = 0; ok && g < scene->group.count; g++) {
    if (hatch[g].pitch_mm == 0 || is_hatched_before(hatch, g))
      continue;
    all.style = &hatch[g];
    ok = hatch_regions(&all, hatch[g].pitch_mm, hatch[g].angle_deg);
  }
  hatch_regions_fini(&all.regions);
  mem_free(hatch);
  return ok;
}
