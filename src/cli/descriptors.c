/* descriptors.c - makes sure that the standard descriptors are open.
 */
#include "cli/descriptors.h"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

/* Each descriptor is opened in the wrong mode (standard input for writing, the
 * others for reading), so that its use fails. */
static bool reserve_descriptor(int number) {
  if (fcntl(number, F_GETFD) != -1 || errno != EBADF)
    return true;
  int opened = open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  return opened ==
         number; /* the lowest that is free, and those below are not */
}

bool descriptors_reserve(void) {
  return reserve_descriptor(STDIN_FILENO) &&
         reserve_descriptor(STDOUT_FILENO) && reserve_descriptor(STDERR_FILENO);
}
