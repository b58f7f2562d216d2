/* render_warnings.c - formats the warnings of a view. */
#include "api/render_warnings.h"

#include <math.h>
#include <stdio.h>

void warn_of_borders(const recto_options *o, const char *path,
                     const struct preparation *prepared,
                     const struct topology *topology) {
  bool is_cut = prepared->planes > 0;
  size_t edges = is_cut ? prepared->edges : topology->edge.count;
  if (o->warning == NULL || o->mesh.weld == 0 ||
      !(is_cut ? prepared->is_suspicious
               : welded_is_suspicious(&prepared->welded, topology)))
    return;
  char text[128];
  snprintf(text, sizeof text,
           "%.0f %% of the edges are borders; --weld LENGTH joins corners that "
           "lie apart",
           100.0 * (double)prepared->welded.borders / (double)edges);
  o->warning(o->user, path != NULL ? path : "", 0, text);
}

void warn_of_open_cut(const recto_options *o, const char *path,
                      const struct preparation *prepared) {
  const struct cut *cut = &prepared->cut;
  int exponent = prepared->rescaled.exponent;
  if (o->warning == NULL || cut->open == 0)
    return;
  char text[192];
  snprintf(text, sizeof text,
           "%zu %s of the cut %s not closed, the first at %.9g,%.9g,%.9g: the "
           "surface is open there, and no cut face fills it",
           cut->open, cut->open == 1 ? "line" : "lines",
           cut->open == 1 ? "is" : "are", ldexp(cut->open_at.x, exponent),
           ldexp(cut->open_at.y, exponent), ldexp(cut->open_at.z, exponent));
  o->warning(o->user, path != NULL ? path : "", 0, text);
}

static void warn_of_empty_drawing(const recto_options *o, const char *why) {
  char text[128];
  if (o->warning == NULL)
    return;
  if (o->ink.edges == RECTO_EDGES_NONE && o->ink.fill == RECTO_FILL_NONE)
    why = "neither lines nor fills are requested";
  snprintf(text, sizeof text, "the drawing is empty: %s", why);
  o->warning(o->user, "", 0, text);
}

void warn_of_nothing(const recto_options *options) {
  warn_of_empty_drawing(
      options, "nothing that was requested is visible and long enough");
}

void warn_of_empty_page(const recto_options *options,
                        const struct drawing *drawing, bool is_outside) {
  if (drawing->stroke.count > 0 || drawing->fill.count > 0)
    return;
  if (is_outside)
    warn_of_empty_drawing(options,
                          "all of the scene is outside of the page's margins");
  else
    warn_of_nothing(options);
}

void warn_of_tiny_drawing(const recto_options *o,
                          const struct drawing *drawing) {
  double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
  if (o->warning == NULL || o->camera.fit != RECTO_FIT_SCALE ||
      drawing->point.count == 0)
    return;
  for (size_t i = 0; i < drawing->point.count; i++) {
    const double at[] = {drawing->point.item[i].x, drawing->point.item[i].y};
    for (int k = 0; k < 2; k++) {
      low[k] = fmin(low[k], at[k]);
      high[k] = fmax(high[k], at[k]);
    }
  }
  double width = high[0] - low[0], height = high[1] - low[1];
  if (fmax(width, height) >= fmin(drawing->width_mm, drawing->height_mm) / 50)
    return;
  char text[160];
  snprintf(
      text, sizeof text,
      "the drawing is %.3g mm wide and %.3g mm high: --unit says how large "
      "a unit of the model is, and --fit fills the page",
      width, height);
  o->warning(o->user, "", 0, text);
}

void warn_of_near_plane(const recto_options *o, unsigned long cut,
                        double near) {
  if (cut == 0 || o->warning == NULL)
    return;
  char text[160];
  snprintf(text, sizeof text,
           "%lu %s nearer to the eye than %.3g and %s cut there; --near takes "
           "a smaller distance",
           cut, cut == 1 ? "face comes" : "faces come", near,
           cut == 1 ? "is" : "are");
  o->warning(o->user, "", 0, text);
}
