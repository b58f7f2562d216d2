/* detail_places.h - finds places for the details of a sheet. */
#ifndef API_DETAIL_PLACES_H
#define API_DETAIL_PLACES_H

#include "api/multiview_layout.h"

/* Places the details of the options, whose views are arranged, each where there
 * is room that is nearest to what it shows.
 * Errors  RECTO_ERROR_ARGUMENT: one shows nothing, or has no room */
USE_RESULT recto_status detail_places_find(struct multiview *views,
                                           const recto_options *options,
                                           recto_error *error);

#endif
