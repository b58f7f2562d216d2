/* fold_samples.c - places samples on outlines, and smooths runs of them by the
 * mean of those about each. */
#include "visibility/fold/fold_samples.h"

#include <math.h>

#include "geom/vector.h"
#include "scene/newell_normal.h"

/* Samples for each height of a triangle, and of an outline, at most. */
enum { SAMPLES_A_HEIGHT = 4, SAMPLES_MAX = 64 };

/* The length of a run, at least, as a multiple of the mean height of its
 * triangles, and the outlines that it is of. */
#define LONG_HEIGHTS 6
enum { MANY_OUTLINES = 10, SEVERAL_OUTLINES = 5, FEW_OUTLINES = 3 };

/* The least length of a run of few outlines where the mesh samples a smooth
 * surface. */
#define SMOOTH_LONG_HEIGHTS 3

/* From how many heights on triangles beside an outline are slivers, of which
 * noise makes long runs. */
#define SLIVER_HEIGHTS 4

/* The share of a run that may be on creases. */
#define CREASE_SHARE 0.5

/* The share of a run that is long, or leads from a contour to another one, at
 * least, that the surface does not contradict. */
#define FOLDED_SHARE 0.5

/* How far about a sample the mean of a zigzag is found, in heights, and how far
 * apart the places of a line are. */
#define MEAN_HEIGHTS 1.5
#define PLACE_HEIGHTS 0.5

/* The height of a face's triangles on the page, grid units: the least one of a
 * triangle, and about as much of the triangles of a polygon. */
static double height_of_face(const struct sheet *sheet, uint32_t face) {
  const struct scene *scene = sheet->scene;
  const struct scene_point *point = scene->point.item;
  uint32_t start = scene_face_start(scene, face);
  uint32_t stop = scene_face_start(scene, face + 1);
  const struct scene_point *o = &point[scene->corner.item[start]];
  double n[3], longest = 0;
  for (uint32_t c = start; c < stop; c++) {
    const struct scene_point *p = &point[scene->corner.item[c]];
    const struct scene_point *q =
        &point[scene->corner.item[c + 1 < stop ? c + 1 : start]];
    const double side[3] = {q->x - p->x, q->y - p->y, q->z - p->z};
    const double from[3] = {p->x - o->x, p->y - o->y, p->z - o->z};
    longest =
        fmax(longest, fmax(vector_dot(side, side), vector_dot(from, from)));
  }
  newell_normal_of_face(scene, face, n);
  double height = sqrt(vector_dot(n, n) / longest) / (stop - start - 2) *
                  sheet->camera.s * SHEET_UNITS_PER_MM;
  return sheet->camera.perspective ? height / camera_view(&sheet->camera, o).d
                                   : height;
}

static double height_of_face_by(struct large_face_size *last,
                                const struct sheet *sheet, uint32_t face) {
  if (scene_face_corners(sheet->scene, face) <= SMALL_FACE_MAX)
    return height_of_face(sheet, face);
  if (last->face_after != face + 1)
    *last = (struct large_face_size){height_of_face(sheet, face), face + 1};
  return last->size;
}

bool fold_samples_add(struct fold_samples *samples, const struct sheet *sheet,
                      const struct contour_outline *outline, uint32_t number) {
  struct geom_segment s = outline->image;
  double x = (double)s.q.x - s.p.x, y = (double)s.q.y - s.p.y;
  double length = vector2_length(x, y);
  double height = height_of_face_by(&samples->last, sheet, outline->face);
  if (length == 0 || !(height > 0))
    return true;
  double count = fmin(ceil(SAMPLES_A_HEIGHT * length / height), SAMPLES_MAX);
  for (int k = 0; k < (int)count; k++) {
    double t = (k + 0.5) / count;
    struct fold_sample made = {.x = s.p.x + t * x,
                               .y = s.p.y + t * y,
                               .z = (double)s.p.z + t * (double)(s.q.z - s.p.z),
                               .along = {x / length, y / length},
                               .step = length / count,
                               .height = height,
                               .curvature = outline->curvature,
                               .is_contradicted = outline->is_contradicted,
                               .outline = number,
                               .face = outline->face};
    if (!ARRAY_PUSH(samples, made))
      return false;
  }
  return true;
}

double fold_run_length(struct fold_run run) {
  double sum = 0;
  for (size_t i = 0; i < run.count; i++)
    sum += run.sample[i].step;
  return sum;
}

/* What is known of a run as a whole. */
struct run_measure {
  double length, height; /* its own; the mean of its triangles' */
  double folded;         /* the length that the surface does not contradict */
  int outlines;
  struct curvature_squares curvature;
  bool on_creases; /* more than a share of it is */
  bool is_smooth;  /* the mesh samples a smooth surface about it */
};

static struct run_measure measure_run(struct fold_run run) {
  double sum = 0, on_creases = 0;
  struct run_measure made = {.outlines = 0};
  for (size_t i = 0; i < run.count; i++) {
    const struct fold_sample *s = &run.sample[i];
    made.length += s->step;
    sum += s->step * s->height;
    on_creases += s->is_on_crease ? s->step : 0;
    made.folded += s->is_contradicted ? 0 : s->step;
    if (i > 0 && s->outline == run.sample[i - 1].outline)
      continue;
    made.outlines++;
    curvature_squares_add(&made.curvature, s->curvature);
  }
  made.height = made.length > 0 ? sum / made.length : 0;
  made.on_creases = on_creases > CREASE_SHARE * made.length;
  made.is_smooth = curvature_is_smooth(made.curvature);
  return made;
}

bool fold_run_is_long(struct fold_run run, double long_on_page,
                      double *height) {
  struct run_measure of = measure_run(run);
  bool is_sliver = of.length > SLIVER_HEIGHTS * of.height * of.outlines;
  bool is_large = of.length >= long_on_page;
  int outlines = is_large && !is_sliver ? SEVERAL_OUTLINES : MANY_OUTLINES;
  double heights = LONG_HEIGHTS;
  if (of.is_smooth && !is_sliver && of.folded >= FOLDED_SHARE * of.length) {
    outlines = FEW_OUTLINES;
    heights = SMOOTH_LONG_HEIGHTS;
  }
  *height = of.height;
  return of.outlines >= outlines && !of.on_creases &&
         of.length >= heights * of.height;
}

bool fold_run_is_line(struct fold_run run, double heights, bool is_gap) {
  struct run_measure of = measure_run(run);
  double length = of.is_smooth && !is_gap ? of.folded : of.length;
  return !of.on_creases && length >= heights * of.height &&
         (of.outlines >= FEW_OUTLINES || of.is_smooth);
}

bool fold_run_is_contradicted(struct fold_run run) {
  struct run_measure of = measure_run(run);
  return of.is_smooth && of.length > of.height &&
         of.folded < FOLDED_SHARE * of.length;
}

bool fold_run_is_smooth(struct fold_run run) {
  return measure_run(run).is_smooth;
}

bool fold_run_may_be_smooth(struct fold_run run) {
  struct run_measure of = measure_run(run);
  return of.curvature.known == 0 || of.is_smooth;
}

/* The mean of the samples about one, as far to either side as there are such of
 * the run. */
static struct fold_place mean_about(struct fold_run run, size_t i,
                                    double reach) {
  const struct fold_sample *s = &run.sample[i];
  size_t before = run.is_ring ? run.count / 4 : i;
  size_t after = run.is_ring ? run.count / 4 : run.count - 1 - i;
  struct fold_place mean = {s->step * s->x, s->step * s->y, s->step * s->z,
                            s->face};
  double weight = s->step, away = 0;
  for (size_t k = 1; k <= before && k <= after && away < reach; k++)
    for (int side = 0; side < 2; side++) {
      size_t at = side == 0 ? i + run.count - k : i + k;
      const struct fold_sample *n = &run.sample[at % run.count];
      mean.x += n->step * n->x;
      mean.y += n->step * n->y;
      mean.z += n->step * n->z;
      weight += n->step;
      away += n->step / 2;
    }
  mean.x /= weight;
  mean.y /= weight;
  mean.z /= weight;
  return mean;
}

bool fold_run_smooth(struct fold_run run, double height,
                     struct fold_places *places) {
  struct fold_place last = {0, 0, 0, 0};
  places->count = 0;
  for (size_t i = 0; i < run.count; i++) {
    struct fold_place mean = mean_about(run, i, MEAN_HEIGHTS * height);
    double away = vector2_length(mean.x - last.x, mean.y - last.y);
    if (i > 0 && i + 1 < run.count && away < PLACE_HEIGHTS * height)
      continue;
    last = mean;
    if (!ARRAY_PUSH(places, mean))
      return false;
  }
  return true;
}
