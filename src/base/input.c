/* input.c - brings a whole file into memory.
 *
 * A file is mapped, a pipe is read to its end. */
#include "base/input.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

/* Maps a file of `count` bytes over the start of a mapping of zeros that is
 * at least one byte longer.  The pages of the file itself are not written to,
 * so they cost no memory of our own. */
static bool map_file(int descriptor, size_t count, struct input *input) {
  long page = sysconf(_SC_PAGESIZE);
  if (page <= 0 || count > PTRDIFF_MAX - 2 * (size_t)page)
    return false;
  size_t length = (count / (size_t)page + 1) * (size_t)page;
  void *zeros = mmap(NULL, length, PROT_READ,
                     MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (zeros == MAP_FAILED)
    return false;
  void *bytes =
      mmap(zeros, count, PROT_READ, MAP_PRIVATE | MAP_FIXED, descriptor, 0);
  if (bytes == MAP_FAILED) {
    munmap(zeros, length);
    return false;
  }
  (void)madvise(bytes, count, MADV_SEQUENTIAL);
  input->bytes = bytes;
  input->count = count;
  input->mapped = length;
  return true;
}

static recto_status slurp(int descriptor, const char *path, struct input *input,
                          recto_error *error) {
  enum { CHUNK = 1 << 16 };
  for (;;) {
    if (!ARRAY_RESERVE(&input->slurped, CHUNK + 1))
      return error_memory(error);
    ssize_t got = read(descriptor, input->slurped.item + input->slurped.count,
                       input->slurped.capacity - input->slurped.count - 1);
    if (got < 0 && errno == EINTR)
      continue;
    if (got < 0)
      return error_set(error, RECTO_ERROR_IO, path, 0, "cannot read: %s",
                       strerror(errno));
    if (got == 0)
      break;
    input->slurped.count += (size_t)got;
  }
  input->slurped.item[input->slurped.count] = '\0';
  input->bytes = input->slurped.item;
  input->count = input->slurped.count;
  return RECTO_OK;
}

/* Standard input may be a file too, and one that was read from already. */
recto_status input_load(struct input *input, const char *path,
                        recto_error *error) {
  *input = (struct input){.bytes = NULL};
  bool standard = strcmp(path, "-") == 0;
  int descriptor =
      standard ? STDIN_FILENO : open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0)
    return error_set(error, RECTO_ERROR_IO, path, 0, "cannot open: %s",
                     strerror(errno));
  recto_status status = RECTO_OK;
  struct stat about;
  bool from_start = !standard || lseek(descriptor, 0, SEEK_CUR) == 0;
  if (fstat(descriptor, &about) != 0 || !S_ISREG(about.st_mode) ||
      about.st_size <= 0 || !from_start ||
      !map_file(descriptor, (size_t)about.st_size, input))
    status = slurp(descriptor, path, input, error);
  if (!standard)
    close(descriptor);
  return status;
}

recto_status input_load_named(struct input *input, const char *path,
                              recto_error *error) {
  *input = (struct input){.bytes = NULL};
  int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
  if (descriptor < 0)
    return error_set(error, RECTO_ERROR_IO, path, 0, "cannot open: %s",
                     strerror(errno));
  recto_status status = RECTO_OK;
  struct stat about;
  if (fstat(descriptor, &about) != 0 || !S_ISREG(about.st_mode))
    status = error_set(error, RECTO_ERROR_IO, path, 0, "no file");
  else if (about.st_size > INPUT_NAMED_MOST)
    status = error_set(error, RECTO_ERROR_LIMIT, path, 0, "too large");
  else if (about.st_size > 0 &&
           !map_file(descriptor, (size_t)about.st_size, input))
    status = slurp(descriptor, path, input, error);
  close(descriptor);
  return status;
}

void input_unload(struct input *input) {
  /* Only what mmap gave is given back to it: the const is ours. */
  if (input->mapped)
    munmap((void *)(uintptr_t)input->bytes, input->mapped);
  ARRAY_FREE(&input->slurped);
}
