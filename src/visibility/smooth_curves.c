/* smooth_curves.c - finds the curves of a contour while the sheet is solved, or
 * after it. */
#include "visibility/smooth_curves.h"

#include "visibility/contour/contour_cusps.h"
#include "visibility/contour/end_zigzags.h"
#include "visibility/contour/page_crossings.h"
#include "visibility/contour/thin_loops.h"
#include "visibility/zero_set/facing.h"
#include "visibility/zero_set/zero_set.h"

static bool find_smooth_set(struct smooth_curves *c) {
  const struct smooth_curves_input *in = &c->in;
  const struct camera *camera = &in->sheet->camera;
  struct smooth_surface *surface = in->surface;
  bool ok = smooth_surface_find(surface, in->sheet->scene, in->topology, camera,
                                in->crease_deg, NULL) == RECTO_OK;
  if (ok) {
    surface->facing->camera = camera; /* whose scale is final */
    *surface->facing->large = large_face_normals_start();
    ok = zero_set_find(&c->set, in->sheet, surface->facing, NULL) == RECTO_OK;
  }
  return ok;
}

static bool cut_curves(struct smooth_curves *c) {
  const struct smooth_curves_input *in = &c->in;
  const struct camera *camera = &in->sheet->camera;
  return contour_curves_join(&c->curves, &c->set, in->crease_deg) &&
         (in->exact ||
          (thin_loops_remove(&c->curves, &c->set, in->sheet, in->topology) &&
           end_zigzags_straighten(&c->curves, &c->set, camera))) &&
         contour_cusps_cut(&c->curves) &&
         page_crossings_cut(&c->curves, camera);
}

/* Gives up what was found, which a thread of another process may have left half
 * done. */
static void forget_curves(struct smooth_curves *c) {
  c->set = (struct zero_set){.node = {0}};
  c->chains = (struct outline_chains){.next = NULL};
  c->curves = (struct contour_curves){.set = &c->set};
}

static void find_smooth_curves(void *user) {
  struct smooth_curves *c = user;
  forget_curves(c);
  c->ok = find_smooth_set(c) && cut_curves(c) &&
          (c->has_folds || outline_chains_link(&c->chains, &c->set));
}

/* Whether the sheet is asked for triangles of warped faces, which have no points
 * while it is solved. */
static bool has_folds(const struct sheet *sheet) {
  for (size_t e = 0; e < sheet->edge.count; e++)
    if (folded_faces_is_diagonal(sheet, &sheet->edge.item[e]))
      return true;
  return false;
}

void smooth_curves_begin(struct smooth_curves *c,
                         const struct smooth_curves_input *input) {
  c->has_folds = has_folds(input->sheet);
  if (input->surface->facing == NULL || c->has_folds)
    return;
  c->in = *input;
  c->is_begun = true;
  parallel_aside_begin(&c->aside, find_smooth_curves, c);
}

recto_status smooth_curves_find(struct smooth_curves *c,
                                const struct smooth_curves_input *input,
                                recto_error *error) {
  if (c->is_begun) {
    (void)parallel_aside_finish(&c->aside, true);
  } else {
    c->in = *input;
    c->has_folds = has_folds(input->sheet);
    find_smooth_curves(c);
  }
  c->is_begun = false;
  smooth_surface_fini(input->surface);
  return c->ok ? RECTO_OK : error_memory(error);
}

void smooth_curves_fini(struct smooth_curves *c) {
  if (c->is_begun && !parallel_aside_finish(&c->aside, false))
    forget_curves(c);
  c->is_begun = false;
  outline_chains_fini(&c->chains);
  contour_curves_fini(&c->curves);
  zero_set_fini(&c->set);
}
