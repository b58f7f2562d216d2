/* path.c - names of files. */
#include "base/path.h"

#include <string.h>
#include <sys/stat.h>

bool path_is_same(const char *a, const char *b) {
  struct stat one, two;
  bool standard = strcmp(a, "-") == 0 || strcmp(b, "-") == 0;
  return !standard && stat(a, &one) == 0 && stat(b, &two) == 0 && S_ISREG(one.st_mode) &&
         one.st_dev == two.st_dev && one.st_ino == two.st_ino;
}
