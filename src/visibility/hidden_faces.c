/* hidden_faces.c - finds faces that are certainly hidden before they are
 * triangulated and projected.
 *
 * Phases
 *   1 estimate from a sample how many faces lie over each other on the page
 *     (culling/face_samples.h); stop where they are few
 *   2 divide the faces into runs, and list the large ones; stop where many are
 *     about as large as the largest, as triangles at random are, before that
 *     where many are large
 *   3 lay out the large faces alone, and raise the bounds of an occlusion
 *     buffer by them, from near to far
 *   4 test the boxes of runs; for fragments, lower the bounds by the contact
 *     tolerances of what is not hidden, and test the hidden ones again
 *   5 restore the runs that are connected to one that is not hidden
 */
#include "visibility/hidden_faces.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "base/sort.h"
#include "geom/vector.h"
#include "view/project.h"
#include "view/scene_part.h"
#include "visibility/culling/contact_bounds.h"
#include "visibility/culling/face_runs.h"
#include "visibility/culling/face_samples.h"
#include "visibility/culling/occlusion_culling.h"
#include "visibility/culling/space_box.h"
#include "visibility/culling/vertex_fans.h"

enum {
  LARGE_SHARE = 1 << 10, /* of the scene's square size: the least large face */
  LARGE_MAX = 1 << 12,   /* as many large faces are laid out */
  CELLS_FOR = 1 << 15,   /* the cells are those of so many triangles */
  SAMPLES = 1 << 9,      /* of faces that may be about as large as these */
  LIKE_LARGEST = 16,     /* one part of so many of the largest face's size */
  SHARE_MAX = 4,         /* one part of so many of all faces are that large */
  ROUNDS_MAX = 16        /* of restoring connected runs */
};

/* What the phases share. */
struct hiding {
  const struct scene *scene;
  const struct topology *topology;
  const struct camera *camera;
  const recto_options *options;
  bool fragments;
  struct projection projection;
  struct face_runs runs;
  struct occlusion_buffer buffer;
  struct box2 page; /* that of the buffer */
  struct occlusion_margins margins;
};

/* ---- 2. Large faces ------------------------------------------------------ */

/* Whether many faces are at least this large, of a sample. */
static bool has_many_of_size(const struct scene *scene, double least) {
  size_t faces = scene_face_count(scene), count = 0, samples = 0;
  for (size_t f = 0; f < faces; f += faces / SAMPLES + 1, samples++)
    count += face_runs_size(scene, (uint32_t)f) >= least;
  return SHARE_MAX * count > samples;
}

/* Whether many faces are about as large as the largest one, which may be a
 * costly question only where many are large. */
static bool has_many_like_largest(const struct scene *scene, double large) {
  uint32_t faces = scene_face_count(scene);
  double most = 0;
  if (!has_many_of_size(scene, large))
    return false;
  for (uint32_t f = 0; f < faces; f++)
    most = max_number(most, face_runs_size(scene, f));
  return has_many_of_size(scene, most / LIKE_LARGEST);
}

/* The same where not many are large, of which the largest ones are listed. */
static bool has_many_like_listed(const struct hiding *hiding) {
  const struct face_runs *runs = &hiding->runs;
  double most = 0;
  for (size_t i = 0; i < runs->large.count; i++)
    most = max_number(most, runs->large.item[i].size);
  return has_many_of_size(hiding->scene, most / LIKE_LARGEST);
}

/* Marks the largest faces, at most LARGE_MAX, as not left out; returns how many
 * there are. */
static size_t choose_large(const struct hiding *hiding, double least,
                           uint8_t *left_out) {
  const struct large_face *large = hiding->runs.large.item;
  size_t n = hiding->runs.large.count, count = n;
  for (; count > LARGE_MAX; least *= 2) {
    count = 0;
    for (size_t i = 0; i < n; i++)
      count += large[i].size >= 2 * least;
  }
  for (size_t i = 0; i < n; i++)
    if (large[i].size >= least)
      left_out[large[i].face] = 0;
  return count;
}

/* ---- 3. The buffer ------------------------------------------------------- */

/* Raises the bounds by the triangles of a sheet, from near to far. */
static bool raise_bounds(struct hiding *hiding, const struct sheet *sheet) {
  size_t n = sheet->triangle.count;
  struct sort_key *order = mem_alloc(n, sizeof *order);
  for (size_t t = 0; order != NULL && t < n; t++)
    order[t] = (struct sort_key){
        (uint64_t)(SHEET_Z_MAX - sheet_nearest_z(sheet, t)), (uint32_t)t};
  bool ok = order != NULL && sort_keys_alone(order, n) &&
            occlusion_buffer_init(&hiding->buffer);
  for (int k = 0; ok && k < OCCLUSION_BANDS; k++) {
    struct occlusion_band band = occlusion_buffer_band(&hiding->buffer, k);
    for (size_t i = 0; i < n && band.visits > 0; i++)
      occlusion_buffer_raise(&hiding->buffer, &band, sheet, order[i].value);
  }
  mem_free(order);
  return ok && vertex_fans_raise(&hiding->buffer, sheet);
}

/* What is not left out of a scene, and its sheet. */
struct laid_out {
  struct scene_part part;
  struct sheet sheet;
};

/* Lays out the faces that are not left out; end with fini_laid_out either
 * way. */
static recto_status lay_out(struct laid_out *out, const struct hiding *hiding,
                            const uint8_t *left_out, recto_error *error) {
  recto_options options = *hiding->options;
  options.ink.edges = RECTO_EDGES_NONE;
  out->sheet = (struct sheet){.triangle_flags = NULL};
  recto_status status =
      scene_part_init(&out->part, hiding->scene, left_out, error);
  if (status == RECTO_OK)
    status = layout_sheet(&out->sheet, &out->part.scene, &out->part.topology,
                          hiding->camera, &options, true, error);
  return status;
}

static void fini_laid_out(struct laid_out *out) {
  sheet_fini(&out->sheet);
  scene_part_fini(&out->part);
}

/* Raises the bounds by the faces that are not left out. */
static recto_status fill_buffer(struct hiding *hiding, const uint8_t *left_out,
                                recto_error *error) {
  struct laid_out large;
  recto_status status = lay_out(&large, hiding, left_out, error);
  if (status == RECTO_OK) {
    hiding->page = box2_of_sheet(&large.sheet);
    hiding->margins = occlusion_margins_of(&large.sheet);
    occlusion_buffer_shape(&hiding->buffer, hiding->page, CELLS_FOR);
    if (!raise_bounds(hiding, &large.sheet))
      status = error_memory(error);
  }
  fini_laid_out(&large);
  return status;
}

/* ---- 4. Boxes ------------------------------------------------------------ */

/* Is what is in the box hidden in all cells of a row: by its nearest point, or
 * by the planes of its sides over each cell; or is nothing of it there? */
static bool is_row_hidden(const struct hiding *hiding,
                          const struct space_box *box, struct cell_range r,
                          int y) {
  const struct triangle_grid *cells = &hiding->buffer.cells;
  const int32_t *bound =
      hiding->buffer.bound + (size_t)y * (size_t)cells->columns;
  double side = (double)(INT64_C(1) << cells->shift),
         margin = (double)hiding->margins.xy, low = cells->y0 + y * side;
  int32_t nearest = occlusion_steps_up(box->nearest + hiding->margins.depth);
  for (int x = r.x0; x <= r.x1; x++) {
    double left = cells->x0 + x * side;
    if (bound[x] > nearest)
      continue;
    struct box_depths depths =
        space_box_depths(box, left - margin, low - margin, left + side + margin,
                         low + side + margin);
    double high = depths.high + hiding->margins.depth;
    if (depths.low <= high && bound[x] <= occlusion_steps_up(high))
      return false;
  }
  return true;
}

static bool is_run_hidden(const struct hiding *hiding,
                          const struct face_run *run) {
  struct space_box box;
  if (!space_box_project(&box, hiding->camera, &hiding->projection, run->low,
                         run->high))
    return false;
  struct box2 page = hiding->page;
  int64_t margin = hiding->margins.xy, x0 = box.page.x0 - margin,
          y0 = box.page.y0 - margin, x1 = box.page.x1 + margin,
          y1 = box.page.y1 + margin;
  if (x0 < page.x0 || y0 < page.y0 || x1 > page.x1 || y1 > page.y1)
    return false;
  struct cell_range r = triangle_grid_cells(
      &hiding->buffer.cells,
      (struct box2){(int32_t)x0, (int32_t)y0, (int32_t)x1, (int32_t)y1});
  bool hidden = occlusion_buffer_hides_in_blocks(
      &hiding->buffer, r,
      occlusion_steps_up(box.nearest + hiding->margins.depth));
  if (hidden)
    return true;
  for (int y = r.y0; y <= r.y1; y++)
    if (!is_row_hidden(hiding, &box, r, y))
      return false;
  return true;
}

/* Tests all runs, or again those that were hidden. */
static void test_runs(struct hiding *hiding, bool again) {
  for (size_t r = 0; r < hiding->runs.run.count; r++) {
    struct face_run *run = &hiding->runs.run.item[r];
    if (!again || run->hidden)
      run->hidden = is_run_hidden(hiding, run);
  }
}

/* Marks the faces of hidden runs, and no others. */
static size_t mark_left_out(const struct hiding *hiding, uint8_t *left_out) {
  size_t count = 0;
  for (size_t r = 0; r < hiding->runs.run.count; r++) {
    uint32_t first = hiding->runs.run.item[r].first,
             end = face_runs_end(&hiding->runs, hiding->scene, r);
    bool hidden = hiding->runs.run.item[r].hidden;
    memset(left_out + first, hidden, end - first);
    count += hidden ? end - first : 0;
  }
  return count;
}

/* Tests the hidden runs again, behind bounds that are lowered by the contact
 * tolerances of all faces that are not left out. */
static recto_status rule_out_contact(struct hiding *hiding,
                                     const uint8_t *left_out,
                                     recto_error *error) {
  struct laid_out visible;
  recto_status status = lay_out(&visible, hiding, left_out, error);
  if (status == RECTO_OK &&
      !contact_bounds_lower(&hiding->buffer, &visible.sheet))
    status = error_memory(error);
  fini_laid_out(&visible);
  if (status == RECTO_OK)
    test_runs(hiding, true);
  return status;
}

/* ---- 5. Connected runs --------------------------------------------------- */

/* The corners of a run. */
struct corner_range {
  uint32_t begin, end;
};

static struct corner_range corners_of_run(const struct hiding *hiding,
                                          size_t r) {
  const struct scene *scene = hiding->scene;
  return (struct corner_range){
      scene_face_start(scene, hiding->runs.run.item[r].first),
      scene_face_start(scene, face_runs_end(&hiding->runs, scene, r))};
}

static inline uint32_t welded(const struct hiding *hiding, uint32_t corner) {
  const uint32_t *weld = hiding->topology->weld;
  uint32_t point = hiding->scene->corner.item[corner];
  return weld != NULL ? weld[point] : point;
}

static void mark_run(const struct hiding *hiding, size_t r, uint8_t *marked) {
  struct corner_range corners = corners_of_run(hiding, r);
  for (uint32_t c = corners.begin; c < corners.end; c++)
    marked[welded(hiding, c)] = 1;
}

static bool has_mark(const struct hiding *hiding, size_t r,
                     const uint8_t *marked) {
  const struct face_run *run = &hiding->runs.run.item[r];
  if (hiding->topology->weld == NULL &&
      memchr(marked + run->first_point, 1, run->end_point - run->first_point) ==
          NULL)
    return false;
  struct corner_range corners = corners_of_run(hiding, r);
  for (uint32_t c = corners.begin; c < corners.end; c++)
    if (marked[welded(hiding, c)])
      return true;
  return false;
}

/* Restores the hidden runs that have a marked point, in either order; returns
 * whether there were any. */
static bool restore_marked(struct hiding *hiding, bool backward,
                           uint8_t *marked) {
  size_t n = hiding->runs.run.count;
  bool any = false;
  for (size_t i = 0; i < n; i++) {
    size_t r = backward ? n - 1 - i : i;
    struct face_run *run = &hiding->runs.run.item[r];
    if (!run->hidden || !has_mark(hiding, r, marked))
      continue;
    run->hidden = false;
    mark_run(hiding, r, marked);
    any = true;
  }
  return any;
}

/* Restores the runs that are connected to one that is not hidden.  Returns
 * false when memory ran out.
 * *done  gets whether all were found */
static bool restore_connected(struct hiding *hiding, bool *done) {
  uint8_t *marked = mem_calloc(hiding->scene->point.count, sizeof *marked);
  for (size_t r = 0; marked != NULL && r < hiding->runs.run.count; r++)
    if (!hiding->runs.run.item[r].hidden)
      mark_run(hiding, r, marked);
  *done = false;
  for (int round = 0; marked != NULL && !*done && round < ROUNDS_MAX; round++)
    *done = !restore_marked(hiding, round % 2 != 0, marked);
  mem_free(marked);
  return marked != NULL;
}

/* ---- All ----------------------------------------------------------------- */

/* Phases 2 to 5. */
static recto_status find_hidden(struct hiding *hiding,
                                struct hidden_faces *hidden,
                                recto_error *error) {
  double size = hiding->camera->size, large = size * size / LARGE_SHARE;
  size_t faces = scene_face_count(hiding->scene);
  uint8_t *left_out = mem_alloc(faces, 1);
  recto_status status = RECTO_OK;
  bool done;
  if (!(large > 0) || has_many_like_largest(hiding->scene, large))
    goto end;
  if (left_out == NULL ||
      !face_runs_init(&hiding->runs, hiding->scene, large)) {
    status = error_memory(error);
    goto end;
  }
  if (has_many_like_listed(hiding))
    goto end;
  memset(left_out, 1, faces);
  if (choose_large(hiding, large, left_out) == 0)
    goto end;
  status = fill_buffer(hiding, left_out, error);
  if (status != RECTO_OK)
    goto end;
  test_runs(hiding, false);
  if (2 * mark_left_out(hiding, left_out) < faces)
    goto end;
  if (hiding->fragments)
    status = rule_out_contact(hiding, left_out, error);
  if (status != RECTO_OK)
    goto end;
  if (!restore_connected(hiding, &done))
    status = error_memory(error);
  else if (done)
    hidden->count = mark_left_out(hiding, left_out);
  if (2 * hidden->count < faces)
    hidden->count = 0;
end:
  if (hidden->count > 0)
    hidden->left_out = left_out;
  else
    mem_free(left_out);
  return status;
}

recto_status hidden_faces_init(struct hidden_faces *hidden,
                               const struct scene *scene,
                               const struct topology *topology,
                               const struct camera *camera,
                               const recto_options *options, bool fragments,
                               recto_error *error) {
  struct hiding hiding = {.scene = scene,
                          .topology = topology,
                          .camera = camera,
                          .options = options,
                          .fragments = fragments,
                          .projection = projection_of(camera)};
  *hidden = (struct hidden_faces){.left_out = NULL};
  if (!face_samples_are_deep(scene, camera, &hiding.projection))
    return RECTO_OK;
  recto_status status = find_hidden(&hiding, hidden, error);
  face_runs_fini(&hiding.runs);
  occlusion_buffer_fini(&hiding.buffer);
  return status;
}

void hidden_faces_fini(struct hidden_faces *hidden) {
  mem_free(hidden->left_out);
  *hidden = (struct hidden_faces){.left_out = NULL};
}
