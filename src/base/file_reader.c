/* file_reader.c - reads pieces of a file.
 *
 * Robustness  As in input.c the file is read, never mapped. */
#include "base/file_reader.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static recto_status refuse_file(const struct file_reader *reader,
                                const char *why, recto_error *error) {
  return error_set(error, RECTO_ERROR_IO, reader->path, 0, "cannot read: %s",
                   why);
}

recto_status file_reader_open(struct file_reader *reader, const char *path,
                              recto_error *error) {
  struct stat attributes;
  *reader = (struct file_reader){.path = path};
  /* A pipe is opened without waiting for its other end. */
  int descriptor = path_above_standard(
      open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK));
  if (descriptor < 0)
    return refuse_file(reader, strerror(errno), error);
  reader->descriptor = descriptor;
  reader->is_open = true;
  if (fstat(descriptor, &attributes) != 0)
    return refuse_file(reader, strerror(errno), error);
  if (!path_identity_of_descriptor(descriptor, &reader->file))
    return refuse_file(reader, "it is no regular file", error);
  reader->size = (uint64_t)attributes.st_size;
  return RECTO_OK;
}

recto_status file_reader_read(const struct file_reader *reader, uint64_t place,
                              void *bytes, size_t count, recto_error *error) {
  char *to = bytes;
  while (count > 0) {
    ssize_t got = pread(reader->descriptor, to, count, (off_t)place);
    if (got < 0 && errno == EINTR)
      continue;
    if (got <= 0)
      return refuse_file(reader, got < 0 ? strerror(errno) : "it is too short",
                         error);
    to += got;
    place += (uint64_t)got;
    count -= (size_t)got;
  }
  return RECTO_OK;
}

void file_reader_close(struct file_reader *reader) {
  if (reader->is_open)
    close(reader->descriptor);
  *reader = (struct file_reader){.path = NULL};
}
