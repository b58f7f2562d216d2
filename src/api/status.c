/* status.c - the names of statuses, and the library's version. */
#include "recto.h"

const char *recto_status_name(recto_status status) {
  switch (status) {
  case RECTO_OK:
    return "ok";
  case RECTO_ERROR_ARGUMENT:
    return "argument";
  case RECTO_ERROR_MEMORY:
    return "memory";
  case RECTO_ERROR_IO:
    return "io";
  case RECTO_ERROR_FORMAT:
    return "format";
  case RECTO_ERROR_UNSUPPORTED:
    return "unsupported";
  case RECTO_ERROR_EMPTY:
    return "empty";
  case RECTO_ERROR_LIMIT:
    return "limit";
  case RECTO_ERROR_CANCELLED:
    return "cancelled";
  case RECTO_STATUS_COUNT:
    break;
  }
  return "unknown";
}

const char *recto_version(void) { return PACKAGE_VERSION; }
