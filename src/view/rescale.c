/* rescale.c - scales a scene of extreme size so that products of its
 * coordinates are finite and not zero.
 *
 * Robustness  The exact predicates accept any doubles; lengths and normals do
 * not.  A scene whose largest coordinate is from 2^-LARGEST_EXPONENT to
 * 2^LARGEST_EXPONENT is not changed.  Any other is scaled just into that range,
 * and no farther, so that the eye may still be very far from a tiny scene. */
#include "view/rescale.h"

#include <float.h>
#include <math.h>

#include "geom/vector.h"
#include "view/used_box.h"

enum { LARGEST_EXPONENT = 100 };

/* ---- The size of the scene ----------------------------------------------- */

static double largest_of(const struct scene_point *p) {
  return max_number(max_number(fabs(p->x), fabs(p->y)), fabs(p->z));
}

/* The largest coordinate of the corners; stops at the first that is at least
 * `enough`. */
static double largest_corner(const struct scene *scene, const uint32_t *corner,
                             size_t count, double enough) {
  double largest = 0;
  for (size_t c = 0; c < count && largest < enough; c++)
    largest = max_number(largest, largest_of(&scene->point.item[corner[c]]));
  return largest;
}

static double largest_used(const struct scene *scene, double enough) {
  return fmax(
      largest_corner(scene, scene->corner.item, scene->corner.count, enough),
      largest_corner(scene, scene->wire_corner.item, scene->wire_corner.count,
                     enough));
}

/* The exponent of the power of two to divide by; 0 also where the caller
 * cancelled, which is found later.
 * box   gets that of all points
 * part  room for those of their parts */
static int choose_exponent(const struct scene *scene, struct used_box *box,
                           struct used_box *part) {
  const double largest_kept = ldexp(1, LARGEST_EXPONENT),
               least = 1 / largest_kept;
  double largest = 0;
  if (!used_box_find_parts(box, part, scene))
    return 0;
  for (int k = 0; k < 3; k++)
    largest = max_number(largest, max_number(-box->low[k], box->high[k]));
  if (largest <= largest_kept && largest_used(scene, least) >= least)
    return 0;
  largest = largest_used(scene, INFINITY);
  if (largest == 0 || (largest >= least && largest <= largest_kept))
    return 0;
  int exponent;
  frexp(largest, &exponent);
  return exponent < 0 ? exponent + LARGEST_EXPONENT
                      : exponent - LARGEST_EXPONENT;
}

bool rescale_is_wanted(const struct scene *scene, const uint8_t *used) {
  const double largest_kept = ldexp(1, LARGEST_EXPONENT);
  double largest = 0;
  for (size_t p = 0; p < scene->point.count; p++)
    if (used[p] && largest_of(&scene->point.item[p]) > largest)
      largest = largest_of(&scene->point.item[p]);
  return largest != 0 && (largest < 1 / largest_kept || largest > largest_kept);
}

/* ---- Scaling ------------------------------------------------------------- */

static recto_status scale_points(struct rescaled *rescaled,
                                 recto_error *error) {
  struct scene *scene = &rescaled->scene;
  size_t count = scene->point.count;
  const struct scene_point *from = scene->point.item;
  struct scene_point *to = mem_alloc(count, sizeof *to);
  scene->point.item = to;
  if (to == NULL)
    return error_memory(error);
  for (size_t p = 0; p < count; p++) {
    to[p] = (struct scene_point){ldexp(from[p].x, -rescaled->exponent),
                                 ldexp(from[p].y, -rescaled->exponent),
                                 ldexp(from[p].z, -rescaled->exponent)};
    if (!isfinite(largest_of(&to[p])))
      to[p] = (struct scene_point){0, 0, 0}; /* no face or polyline uses it */
  }
  return RECTO_OK;
}

static recto_status scale_precision(struct rescaled *rescaled,
                                    recto_error *error) {
  struct scene *scene = &rescaled->scene;
  size_t count = scene->precision.count;
  const struct precision_range *from = scene->precision.item;
  struct precision_range *to = mem_alloc(count, sizeof *to);
  scene->precision.item = to;
  if (to == NULL)
    return error_memory(error);
  for (size_t i = 0; i < count; i++) {
    to[i] = from[i];
    to[i].precision.absolute =
        ldexp(from[i].precision.absolute, -rescaled->exponent);
  }
  return RECTO_OK;
}

/* Returns whether the eye, target, section and near distance are finite. */
static bool scale_lengths(recto_options *o, int exponent) {
  double *const length[] = {&o->camera.eye[0],    &o->camera.eye[1],
                            &o->camera.eye[2],    &o->camera.target[0],
                            &o->camera.target[1], &o->camera.target[2],
                            &o->camera.section,   &o->camera.near_distance};
  bool finite = true;
  for (size_t i = 0; i < sizeof length / sizeof length[0]; i++) {
    *length[i] = ldexp(*length[i], -exponent);
    finite = finite && isfinite(*length[i]);
  }
  /* A positive contact or weld length must not underflow to 0, which has a
   * meaning of its own, nor overflow. */
  if (o->solver.contact > 0)
    o->solver.contact =
        fmin(fmax(ldexp(o->solver.contact, -exponent), DBL_MIN), DBL_MAX);
  if (o->mesh.weld > 0)
    o->mesh.weld = fmin(fmax(ldexp(o->mesh.weld, -exponent), DBL_MIN), DBL_MAX);
  o->camera.scale =
      fmin(fmax(ldexp(o->camera.scale, exponent), DBL_MIN), DBL_MAX);
  return finite;
}

recto_status rescale(struct rescaled *rescaled, const struct scene *scene,
                     recto_error *error) {
  *rescaled = (struct rescaled){.scene = *scene};
  rescaled->part = mem_alloc(scene->point.count / USED_BOX_POINTS + 1,
                             sizeof *rescaled->part);
  if (rescaled->part == NULL)
    return error_memory(error);
  rescaled->exponent = choose_exponent(scene, &rescaled->box, rescaled->part);
  if (rescaled->exponent == 0)
    return RECTO_OK;
  recto_status status = scale_points(rescaled, error);
  recto_status other = scale_precision(rescaled, error);
  return status == RECTO_OK ? other : status;
}

recto_status rescale_options(const struct rescaled *rescaled,
                             recto_options *options, recto_error *error) {
  if (rescaled->exponent == 0 || scale_lengths(options, rescaled->exponent))
    return RECTO_OK;
  return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                   "the scene is too small for so far an eye, target or "
                   "section");
}

void rescale_fini(struct rescaled *rescaled) {
  if (rescaled->exponent != 0) {
    mem_free(rescaled->scene.point.item);
    mem_free(rescaled->scene.precision.item);
  }
  rescaled->exponent = 0;
  mem_free(rescaled->part);
  rescaled->part = NULL;
}

void rescale_matrix(const struct rescaled *rescaled, double matrix[12]) {
  int exponent = rescaled->exponent;
  for (int i = 0; i < 12; i++)
    if ((i % 4 == 3) == (exponent < 0))
      matrix[i] = ldexp(matrix[i], exponent < 0 ? exponent : -exponent);
}
