/* version.c - which library this is. */
#include "recto.h"

const char *recto_version(void) { return PACKAGE_VERSION; }
