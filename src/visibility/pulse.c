/* pulse.c - asks the caller whether to go on, after so much work. */
#include "visibility/pulse.h"

bool pulse_ask(struct pulse *pulse) {
  const struct solver_request *request = pulse->request;
  pulse->left = PULSE_WORK;
  if (!pulse->cancelled && request != NULL && request->progress != NULL)
    pulse->cancelled =
        !request->progress(request->user, pulse->share, pulse->stage);
  return !pulse->cancelled;
}

recto_status pulse_error(const struct pulse *pulse, recto_error *error) {
  return pulse != NULL && pulse->cancelled
             ? error_set(error, RECTO_ERROR_CANCELLED, NULL, 0, "cancelled")
             : error_memory(error);
}
