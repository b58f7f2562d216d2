/* line_blocks.c - a text file read in blocks of whole lines.
 *
 * Robustness  As in input.c the file is read, never mapped.  What is read again
 * should be what was read before, so the file's time of modification is looked
 * at where it ends. */
#include "base/line_blocks.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/gunzip.h"
#include "base/input.h"
#include "base/parallel_read.h"
#include "base/poll.h"

enum { NULS = 8 }; /* behind a block */

bool line_blocks_open(struct line_blocks *blocks, const char *path,
                      size_t least) {
  char head[4];
  struct stat attributes;
  *blocks = (struct line_blocks){.path = path, .least = least};
  /* A pipe is not even opened: its other end would notice. */
  if (strcmp(path, "-") == 0 || !path_identity(path, &blocks->file))
    return false;
  int descriptor = path_above_standard(
      open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK));
  if (descriptor < 0)
    return false;
  ssize_t got = -1;
  if (path_identity_of_descriptor(descriptor, &blocks->file) &&
      fstat(descriptor, &attributes) == 0)
    got = pread(descriptor, head, sizeof head, 0);
  /* Some file systems report 0 for the sizes of their files. */
  if (got < 0 || attributes.st_size < got ||
      gunzip_is_wanted(head, (size_t)got)) {
    close(descriptor);
    return false;
  }
  blocks->descriptor = descriptor;
  blocks->is_open = true;
  blocks->size = attributes.st_size;
  blocks->modified = attributes.st_mtim;
  return true;
}

void line_blocks_seek(struct line_blocks *blocks, off_t place) {
  blocks->begin = blocks->end = place;
  blocks->count = 0;
}

/* Whether the file is what it was when it was opened. */
static bool is_unchanged(const struct line_blocks *blocks) {
  struct stat attributes;
  return fstat(blocks->descriptor, &attributes) == 0 &&
         attributes.st_size == blocks->size &&
         attributes.st_mtim.tv_sec == blocks->modified.tv_sec &&
         attributes.st_mtim.tv_nsec == blocks->modified.tv_nsec;
}

static recto_status refuse_change(const struct line_blocks *blocks,
                                  recto_error *error) {
  return error_set(error, RECTO_ERROR_IO, blocks->path, 0,
                   "was changed while it was read");
}

/* Appends bytes from the place after those that are there.
 * wanted  no more than the file has from there on */
static recto_status append_bytes(struct line_blocks *blocks, size_t wanted,
                                 recto_error *error) {
  struct byte_array *buffer = &blocks->buffer;
  if (!ARRAY_RESERVE(buffer, wanted + NULS))
    return error_memory(error);
  size_t left = wanted;
  if (parallel_read_is_worth(wanted)) {
    size_t got =
        parallel_read(blocks->descriptor, blocks->begin + (off_t)buffer->count,
                      buffer->item + buffer->count, wanted);
    buffer->count += got;
    left -= got;
  }
  while (left > 0) {
    ssize_t got = pread(blocks->descriptor, buffer->item + buffer->count, left,
                        blocks->begin + (off_t)buffer->count);
    if (got < 0 && errno == EINTR)
      continue;
    if (got < 0)
      return error_set(error, RECTO_ERROR_IO, blocks->path, 0,
                       "cannot read: %s", strerror(errno));
    if (got == 0)
      return refuse_change(blocks, error);
    buffer->count += (size_t)got;
    left -= (size_t)got;
  }
  return RECTO_OK;
}

/* The number of bytes up to the end of the last line that is whole and not
 * continued; 0: there is none. */
static size_t whole_lines(const struct byte_array *buffer) {
  for (size_t past = buffer->count; past > 0; past--) {
    if (buffer->item[past - 1] != '\n')
      continue;
    size_t end = past - 1;
    end -= end > 0 && buffer->item[end - 1] == '\r';
    if (end == 0 || buffer->item[end - 1] != '\\')
      return past;
  }
  return 0;
}

recto_status line_blocks_next(struct line_blocks *blocks, recto_error *error) {
  struct byte_array *buffer = &blocks->buffer;
  blocks->begin = blocks->end;
  buffer->count = blocks->count = 0;
  if (!poll_now())
    return error_cancelled(error);
  do {
    off_t left = blocks->size - blocks->begin - (off_t)buffer->count;
    /* What has no end yet grows to twice its size. */
    size_t wanted = buffer->count > 0 ? buffer->count : blocks->least;
    wanted = left < (off_t)wanted ? (size_t)left : wanted;
    if (buffer->count + wanted > input_size_max())
      return error_set(error, RECTO_ERROR_LIMIT, blocks->path, 0,
                       "a line is longer than %zu MB", buffer->count >> 20);
    recto_status status = append_bytes(blocks, wanted, error);
    if (status != RECTO_OK)
      return status;
    blocks->count =
        wanted == (size_t)left ? buffer->count : whole_lines(buffer);
  } while (blocks->count == 0 && buffer->count > 0);
  blocks->end = blocks->begin + (off_t)blocks->count;
  if (blocks->end == blocks->size && !blocks->is_read_once &&
      !is_unchanged(blocks))
    return refuse_change(blocks, error);
  memset(buffer->item + blocks->count, 0, NULS);
  blocks->bytes = buffer->item;
  return RECTO_OK;
}

size_t line_blocks_copy(const struct line_blocks *blocks, off_t place, char *to,
                        size_t count) {
  size_t sum = 0;
  ssize_t got = 1;
  while (sum < count && got != 0) {
    got = pread(blocks->descriptor, to + sum, count - sum, place + (off_t)sum);
    if (got < 0 && errno != EINTR)
      break;
    sum += got > 0 ? (size_t)got : 0;
  }
  return sum;
}

void line_blocks_share(struct line_blocks *second,
                       const struct line_blocks *blocks) {
  *second = *blocks;
  second->is_shared = true;
  second->buffer = (struct byte_array){NULL, 0, 0};
}

void line_blocks_close(struct line_blocks *blocks) {
  if (blocks->is_open && !blocks->is_shared)
    close(blocks->descriptor);
  ARRAY_FREE(&blocks->buffer);
  *blocks = (struct line_blocks){.bytes = NULL};
}
