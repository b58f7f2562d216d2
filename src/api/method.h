/* method.h - which method solves a view. */
#ifndef API_METHOD_H
#define API_METHOD_H

#include "base/report.h"
#include "visibility/solver.h"

/* Errors  RECTO_ERROR_UNSUPPORTED  this build does not have it */
USE_RESULT recto_status method_check(const recto_options *options,
                                     recto_error *error);

/* The solver of a method, which is available, or the one that is chosen for
 * RECTO_METHOD_AUTO; reports it, and why. */
const struct solver *method_choose(recto_method method,
                                   const struct sheet *sheet,
                                   const struct solver_request *request,
                                   struct report *report);

#endif
