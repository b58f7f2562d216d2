/* progress.c - reports progress to the caller, and learns of cancellation. */
#include "visibility/progress.h"

bool progress_poll(struct progress *progress) {
  const struct solver_request *request = progress->request;
  progress->work_left = PROGRESS_WORK;
  if (!progress->cancelled && request != NULL && request->progress != NULL)
    progress->cancelled =
        !request->progress(request->user, progress->share, progress->stage);
  return !progress->cancelled;
}

recto_status progress_error(const struct progress *progress,
                            recto_error *error) {
  return progress != NULL && progress->cancelled ? error_cancelled(error)
                                                 : error_memory(error);
}
