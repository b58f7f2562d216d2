/* render_warnings.h - warnings of what is seldom intended: a torn mesh, an open
 * cut, an empty drawing or a tiny one, faces that the near plane clips. */
#ifndef API_RENDER_WARNINGS_H
#define API_RENDER_WARNINGS_H

#include "api/preparation.h"
#include "drawing/drawing.h"

/* Corners that were one before something moved them apart make borders of all
 * edges.
 * path  of the model; NULL: it has none */
void warn_of_borders(const recto_options *options, const char *path,
                     const struct preparation *prepared,
                     const struct topology *topology);

/* Surfaces that are not closed have no inside that a cut could show. */
void warn_of_open_cut(const recto_options *options, const char *path,
                      const struct preparation *prepared);

/* Warns that nothing is drawn. */
void warn_of_nothing(const recto_options *options);

/* Warns if the drawing is empty, which is no error but seldom intended.
 * is_outside  nothing of the scene is inside the page's margins */
void warn_of_empty_page(const recto_options *options,
                        const struct drawing *drawing, bool is_outside);

/* Warns if a drawing at a true scale is smaller than a fiftieth of its page:
 * then the model's unit is seldom the one that was assumed. */
void warn_of_tiny_drawing(const recto_options *options,
                          const struct drawing *drawing);

/* Warns of faces that the default near plane clips, which it does where depths
 * would otherwise become too coarse.
 * cut   so many
 * near  its distance, units of the user's scene */
void warn_of_near_plane(const recto_options *options, unsigned long cut,
                        double near);

#endif
