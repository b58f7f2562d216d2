/* method.c - which method solves a view. */
#include "api/method.h"

#include "api/stats.h"

bool recto_method_is_available(recto_method method) {
  return method == RECTO_METHOD_AUTO || solver_by_method(method) != NULL;
}

recto_status method_check(const recto_options *options, recto_error *error) {
  if (!recto_method_is_available(options->solver.method))
    return error_set(error, RECTO_ERROR_UNSUPPORTED, NULL, 0,
                     "method %s is not available in this build",
                     recto_method_name(options->solver.method));
  return RECTO_OK;
}

const struct solver *method_choose(recto_method method,
                                   const struct sheet *sheet,
                                   const struct solver_request *request,
                                   struct report *report) {
  const char *why = "requested";
  const struct solver *solver = method == RECTO_METHOD_AUTO
                                    ? solver_choose(sheet, request, &why)
                                    : solver_by_method(method);
  stats_add_method(report, method, solver, why, request);
  return solver;
}
