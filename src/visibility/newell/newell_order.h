/* newell_order.h - the painter's order of Newell, Newell and Sancha.
 *
 * The order says which faces may be painted before which; faces are split where
 * no order exists.
 */
#ifndef VISIBILITY_NEWELL_NEWELL_ORDER_H
#define VISIBILITY_NEWELL_NEWELL_ORDER_H

#include "visibility/newell/newell_piece.h"

/* Orders all triangles of the sheet except those that would be split too often.
 * Where the request says so, only some of the tests are applied and nothing is
 * split: every triangle has a rank, also one that is not to be painted.
 * End with newell_order_fini whatever is returned.
 * Errors  RECTO_ERROR_MEMORY
 *         RECTO_ERROR_CANCELLED
 * Source  [Newell1972] */
USE_RESULT recto_status newell_order_init(struct newell_order *order,
                                          const struct sheet *sheet,
                                          const struct triangle_grid *grid,
                                          const struct solver_request *request,
                                          recto_error *error);
void newell_order_fini(struct newell_order *order);

#endif
