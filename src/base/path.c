/* path.c - names of files, and which file they name. */
#include "base/path.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool identify(const struct stat *attributes, struct file_identity *it) {
  *it =
      (struct file_identity){(uint64_t)attributes->st_dev, attributes->st_ino};
  return S_ISREG(attributes->st_mode);
}

bool path_identity_of_descriptor(int descriptor, struct file_identity *it) {
  struct stat attributes;
  return fstat(descriptor, &attributes) == 0 && identify(&attributes, it);
}

bool path_identity(const char *path, struct file_identity *it) {
  struct stat attributes;
  return strcmp(path, "-") == 0
             ? path_identity_of_descriptor(STDIN_FILENO, it)
             : stat(path, &attributes) == 0 && identify(&attributes, it);
}

bool path_is_same(const char *a, const char *b) {
  struct file_identity one, two;
  bool standard = strcmp(a, "-") == 0 || strcmp(b, "-") == 0;
  return !standard && path_identity(a, &one) && path_identity(b, &two) &&
         file_identity_is_same(one, two);
}

/* A number of few digits as a whole word; -1 where it is none. */
static int read_volume_number(const char *text) {
  int number = 0;
  size_t length = strspn(text, "0123456789");
  if (length == 0 || length > 6 || text[length] != '\0')
    return -1;
  for (; *text != '\0'; text++)
    number = 10 * number + (*text - '0');
  return number;
}

int path_descriptor(const char *path) {
  static const char *const name[] = {"/dev/stdin", "/dev/stdout",
                                     "/dev/stderr"};
  static const char *const folder[] = {"/dev/fd/", "/proc/self/fd/"};
  for (int i = 0; i < 3; i++)
    if (strcmp(path, name[i]) == 0)
      return i;
  for (int i = 0; i < 2; i++)
    if (strncmp(path, folder[i], strlen(folder[i])) == 0)
      return read_volume_number(path + strlen(folder[i]));
  return -1;
}

bool path_is_standard_output(const char *path) {
  return strcmp(path, "-") == 0 || path_descriptor(path) == STDOUT_FILENO;
}

int path_above_standard(int descriptor) {
  if (descriptor < 0 || descriptor > STDERR_FILENO)
    return descriptor;
  int moved = fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  int fault = errno;
  close(descriptor);
  errno = fault;
  return moved;
}
