/* smooth_curves.c - finds the curves of a contour while the sheet is solved, or
 * after it. */
#include "visibility/smooth_curves.h"

#include "base/parallel.h"
#include "visibility/contour/contour_cusps.h"
#include "visibility/contour/end_zigzags.h"
#include "visibility/contour/page_crossings.h"
#include "visibility/contour/thin_loops.h"
#include "visibility/fold/outlined_curves.h"
#include "visibility/zero_set/facing.h"
#include "visibility/zero_set/folded_faces.h"
#include "visibility/zero_set/zero_set.h"

struct smooth_curves {
  struct smooth_curves_input in;
  struct folded_faces folded; /* of the sheet */
  struct outlined_curves found;
  bool is_begun, ok;
  struct parallel_aside aside;
};

static bool find_smooth_set(struct smooth_curves *c) {
  const struct smooth_curves_input *in = &c->in;
  const struct camera *camera = &in->sheet->camera;
  struct smooth_surface *surface = in->surface;
  bool ok = smooth_surface_find(surface, in->sheet->scene, in->topology, camera,
                                in->crease_deg, NULL) == RECTO_OK;
  if (ok) {
    surface->facing->camera = camera; /* whose scale is final */
    *surface->facing->large = large_face_normals_start();
    ok = zero_set_find(&c->found.set, in->sheet, &c->folded, surface->facing,
                       NULL) == RECTO_OK;
  }
  return ok;
}

static bool cut_curves(struct smooth_curves *c) {
  const struct smooth_curves_input *in = &c->in;
  const struct camera *camera = &in->sheet->camera;
  return contour_curves_join(&c->found.curves, &c->found.set, in->crease_deg) &&
         (in->exact ||
          (thin_loops_remove(&c->found.curves, &c->found.set, in->sheet,
                             in->topology) &&
           end_zigzags_straighten(&c->found.curves, &c->found.set, camera))) &&
         contour_cusps_cut(&c->found.curves) &&
         page_crossings_cut(&c->found.curves, camera);
}

/* Gives up what was found, which a thread of another process may have left half
 * done. */
static void forget_curves(struct smooth_curves *c) {
  c->found = (struct outlined_curves){.curves = {.set = &c->found.set}};
}

static void find_smooth_curves(void *user) {
  struct smooth_curves *c = user;
  forget_curves(c);
  c->ok = find_smooth_set(c) && cut_curves(c) &&
          (c->folded.is_folded != NULL ||
           outline_chains_link(&c->found.chains, &c->found.set));
}

/* A search that is not begun, with the folded faces; NULL when memory ran
 * out. */
static struct smooth_curves *
prepare_search(const struct smooth_curves_input *input) {
  struct smooth_curves *c = mem_calloc(1, sizeof *c);
  if (c == NULL)
    return NULL;
  c->in = *input;
  c->folded = (struct folded_faces){.sheet = input->sheet};
  if (folded_faces_mark(&c->folded))
    return c;
  smooth_curves_end(c);
  return NULL;
}

struct smooth_curves *
smooth_curves_begin(const struct smooth_curves_input *input) {
  struct smooth_curves *c = NULL;
  if (input->surface->facing != NULL)
    c = prepare_search(input);
  /* Triangles of folded faces have no points while the sheet is solved. */
  if (c != NULL && c->folded.is_folded == NULL) {
    c->is_begun = true;
    parallel_aside_begin(&c->aside, find_smooth_curves, c);
  }
  return c;
}

recto_status smooth_curves_find(struct smooth_curves **curves,
                                const struct smooth_curves_input *input,
                                struct outlined_curves **found,
                                recto_error *error) {
  if (*curves == NULL)
    *curves = prepare_search(input);
  struct smooth_curves *c = *curves;
  if (c != NULL && c->is_begun)
    (void)parallel_aside_finish(&c->aside, true);
  else if (c != NULL)
    find_smooth_curves(c);
  smooth_surface_fini(input->surface);
  if (c == NULL)
    return error_memory(error);
  c->is_begun = false;
  if (!c->ok)
    return error_memory(error);
  *found = &c->found;
  return RECTO_OK;
}

void smooth_curves_end(struct smooth_curves *c) {
  if (c == NULL)
    return;
  if (c->is_begun && !parallel_aside_finish(&c->aside, false))
    forget_curves(c);
  folded_faces_fini(&c->folded);
  outline_chains_fini(&c->found.chains);
  contour_curves_fini(&c->found.curves);
  zero_set_fini(&c->found.set);
  mem_free(c);
}
