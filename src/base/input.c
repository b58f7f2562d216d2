/* input.c - brings a whole file into memory.
 *
 * Robustness  Files are read, never mapped: another process may cut a file
 * short at any time, and touching a mapped page that is gone ends the process
 * with SIGBUS, which a library may neither cause nor catch. */
#include "base/input.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/gunzip.h"
#include "base/parallel_read.h"
#include "base/poll.h"

size_t input_size_max(void) {
  static const size_t most = (size_t)1 << 36;
  long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || size <= 0 || (size_t)pages / 2 > most / (size_t)size)
    return most;
  return (size_t)pages / 2 * (size_t)size;
}

/* Where bytes come from. */
struct source {
  int descriptor;
  const char *path;
  size_t size;     /* of a regular file, from where it is read; 0: not known */
  size_t size_max; /* bytes that are taken */
};

static recto_status refuse_size(const struct source *source,
                                recto_error *error) {
  return error_set(error, RECTO_ERROR_LIMIT, source->path, 0,
                   "larger than %zu MB, which is the most that is read here",
                   source->size_max >> 20);
}

/* Whether a file that ended before its size says has another size by now.
 * Some file systems report 0 for the sizes of their files. */
static bool was_cut_short(const struct source *source, size_t count) {
  struct stat attributes;
  return count < source->size && fstat(source->descriptor, &attributes) == 0 &&
         (size_t)attributes.st_size < source->size;
}

/* Reads what it can of a large file in parallel, from its position, to which it
 * adds what was read. */
static void read_parts(const struct source *source, struct byte_array *data) {
  if (!parallel_read_is_worth(source->size))
    return;
  off_t from = lseek(source->descriptor, 0, SEEK_CUR);
  if (from < 0)
    return;
  size_t got =
      parallel_read(source->descriptor, from, data->item, source->size);
  if (lseek(source->descriptor, from + (off_t)got, SEEK_SET) >= 0)
    data->count = got;
}

/* ---- Anything ------------------------------------------------------------ */

/* Reads to the end of the source. */
static recto_status read_all(const struct source *source, struct input *input,
                             recto_error *error) {
  enum { CHUNK = 1 << 16 };
  if (source->size > source->size_max)
    return refuse_size(source, error);
  /* One byte more than there are shows that the end is reached. */
  size_t capacity = source->size > 0 ? source->size + 2 : CHUNK;
  if (!ARRAY_RESERVE(&input->buffer, capacity))
    return error_memory(error);
  read_parts(source, &input->buffer);
  while (poll_now()) {
    if (input->buffer.capacity - input->buffer.count < 2 &&
        !ARRAY_RESERVE(&input->buffer, CHUNK))
      return error_memory(error);
    size_t left = input->buffer.capacity - input->buffer.count - 1;
    ssize_t got =
        read(source->descriptor, input->buffer.item + input->buffer.count,
             left < PARALLEL_READ_PART ? left : PARALLEL_READ_PART);
    if (got < 0 && errno == EINTR)
      continue;
    if (got < 0)
      return error_set(error, RECTO_ERROR_IO, source->path, 0,
                       "cannot read: %s", strerror(errno));
    input->buffer.count += (size_t)got;
    if (input->buffer.count > source->size_max)
      return refuse_size(source, error);
    if (got == 0)
      break;
  }
  if (poll_is_cancelled())
    return error_cancelled(error);
  if (was_cut_short(source, input->buffer.count))
    return error_set(error, RECTO_ERROR_IO, source->path, 0,
                     "was cut short while it was read");
  input->buffer.item[input->buffer.count] = '\0';
  return RECTO_OK;
}

/* Standard input may be a file too, and one that was read from already. */
static struct source describe_source(int descriptor, const char *path) {
  struct source source = {descriptor, path, 0, input_size_max()};
  struct stat attributes;
  if (fstat(descriptor, &attributes) != 0)
    return source;
  if (S_ISCHR(attributes.st_mode))
    source.size_max = INPUT_DEVICE_MAX;
  if (!S_ISREG(attributes.st_mode) || attributes.st_size <= 0)
    return source;
  off_t at = lseek(descriptor, 0, SEEK_CUR);
  if (at >= 0 && at < attributes.st_size)
    source.size = (size_t)(attributes.st_size - at);
  return source;
}

/* Expands what was loaded where it is compressed. */
static recto_status expand_input(struct input *input, const char *path,
                                 size_t size_max, recto_error *error) {
  struct byte_array *data = &input->buffer;
  recto_status status = gunzip_is_wanted(data->item, data->count)
                            ? gunzip(data, path, size_max, error)
                            : RECTO_OK;
  input->bytes = data->item;
  input->count = data->count;
  return status;
}

recto_status input_load(struct input *input, const char *path,
                        recto_error *error) {
  *input = (struct input){.bytes = NULL};
  bool standard = strcmp(path, "-") == 0;
  int descriptor =
      standard
          ? STDIN_FILENO
          : path_above_standard(open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY));
  if (descriptor < 0)
    return error_set(error, RECTO_ERROR_IO, path, 0, "cannot open: %s",
                     strerror(errno));
  struct source source = describe_source(descriptor, path);
  input->is_file = path_identity_of_descriptor(descriptor, &input->file);
  recto_status status = read_all(&source, input, error);
  if (!standard)
    close(descriptor);
  return status == RECTO_OK ? expand_input(input, path, source.size_max, error)
                            : status;
}

recto_status input_copy(struct input *input, const void *bytes, size_t count,
                        const char *name, recto_error *error) {
  *input = (struct input){.bytes = NULL};
  if (count == SIZE_MAX || !ARRAY_RESERVE(&input->buffer, count + 1))
    return error_memory(error);
  if (count > 0)
    memcpy(input->buffer.item, bytes, count);
  input->buffer.item[count] = '\0';
  input->buffer.count = count;
  return expand_input(input, name, input_size_max(), error);
}

recto_status input_load_named(struct input *input, const char *path,
                              recto_error *error) {
  *input = (struct input){.bytes = NULL};
  int descriptor = path_above_standard(
      open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK));
  if (descriptor < 0)
    return error_set(error, RECTO_ERROR_IO, path, 0, "cannot open: %s",
                     strerror(errno));
  recto_status status = RECTO_OK;
  struct stat attributes;
  struct source source = describe_source(descriptor, path);
  input->is_file = path_identity_of_descriptor(descriptor, &input->file);
  source.size_max = INPUT_NAMED_MAX;
  if (fstat(descriptor, &attributes) != 0 || !S_ISREG(attributes.st_mode))
    status = error_set(error, RECTO_ERROR_IO, path, 0, "no file");
  else if (attributes.st_size > INPUT_NAMED_MAX)
    status = error_set(error, RECTO_ERROR_LIMIT, path, 0, "too large");
  else if (attributes.st_size > 0)
    status = read_all(&source, input, error);
  close(descriptor);
  return status == RECTO_OK ? expand_input(input, path, source.size_max, error)
                            : status;
}

void input_unload(struct input *input) { ARRAY_FREE(&input->buffer); }
