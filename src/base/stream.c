/* stream.c - buffered output that appears whole or not at all.
 *
 * Three kinds share one buffer.  A new file's is emptied to it whenever it is
 * full; what goes to a descriptor, or replaces the bytes of a file in place,
 * stays in the buffer, which grows, until the stream is finished; memory just
 * stays.
 */
#include "base/stream.h"

#include <errno.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

#include "base/gzip.h"
#include "base/memory.h"
#include "base/number.h"
#include "base/poll.h"
#include "base/target.h"

enum { CHUNK = 1 << 16 };

struct stream {
  bool is_memory;
  recto_status status;
  int fault; /* errno of the first fault */
  struct target target;
  struct gzip *gzip; /* NULL: bytes are written as they are */
  ARRAY(char) buffer;
};

/* For tests alone: see stream_fail_after. */
static unsigned long writes_to_failure;

void stream_fail_after(unsigned long n) { writes_to_failure = n; }

/* The first error is the one that is reported. */
static void set_fault(struct stream *stream, recto_status status, int fault) {
  if (stream->status != RECTO_OK)
    return;
  stream->status = status;
  stream->fault = fault;
}

/* A fault that the system reports. */
static void set_system_fault(struct stream *stream, int fault) {
  set_fault(stream, fault == ENOMEM ? RECTO_ERROR_MEMORY : RECTO_ERROR_IO,
            fault);
}

static void write_physically(struct stream *stream, const char *bytes,
                             size_t count) {
  while (count > 0 && stream->status == RECTO_OK) {
    if (!poll_now()) {
      set_fault(stream, RECTO_ERROR_CANCELLED, 0);
      return;
    }
    if (writes_to_failure && --writes_to_failure == 0) {
      set_fault(stream, RECTO_ERROR_IO, ENOSPC);
      return;
    }
    ssize_t written = write(stream->target.descriptor, bytes, count);
    if (written > 0) {
      bytes += written;
      count -= (size_t)written;
    } else if (written == 0 || errno != EINTR) {
      set_system_fault(stream, written == 0 ? EIO : errno);
    }
  }
}

static void flush_buffer(struct stream *stream) {
  write_physically(stream, stream->buffer.item, stream->buffer.count);
  stream->buffer.count = 0;
}

/* ---- Opening ------------------------------------------------------------- */

static struct stream *allocate_stream(void) {
  struct stream *stream = mem_calloc(1, sizeof *stream);
  if (stream == NULL)
    return NULL;
  stream->status = RECTO_OK;
  stream->target.descriptor = -1;
  if (!ARRAY_RESERVE(&stream->buffer, CHUNK)) {
    stream_discard(stream);
    return NULL;
  }
  return stream;
}

recto_status stream_open(struct stream **stream, const char *path,
                         recto_error *error) {
  *stream = NULL;
  struct stream *opened = allocate_stream();
  if (opened == NULL)
    return error_memory(error);
  recto_status status = target_open(&opened->target, path, error);
  if (status != RECTO_OK) {
    stream_discard(opened);
    return status;
  }
  *stream = opened;
  return RECTO_OK;
}

recto_status stream_open_memory(struct stream **stream, recto_error *error) {
  *stream = allocate_stream();
  if (*stream == NULL)
    return error_memory(error);
  (*stream)->is_memory = true;
  return RECTO_OK;
}

bool stream_is_same(const struct stream *a, const struct stream *b) {
  return !a->is_memory && !b->is_memory &&
         target_is_same(&a->target, &b->target);
}

bool stream_replaces(const struct stream *stream, struct file_identity it) {
  return !stream->is_memory && target_is(&stream->target, it);
}

/* ---- Writing ------------------------------------------------------------- */

/* Whether the buffer may be emptied before the end. */
static bool may_flush_early(const struct stream *stream) {
  return !stream->is_memory && stream->target.kind == TARGET_NEW;
}

static void put_bytes(void *user, const void *bytes, size_t count) {
  struct stream *stream = user;
  if (stream->status != RECTO_OK || count == 0)
    return;
  if (may_flush_early(stream)) {
    if (count > stream->buffer.capacity - stream->buffer.count)
      flush_buffer(stream);
    if (count > stream->buffer.capacity) {
      write_physically(stream, bytes, count);
      return;
    }
  } else if (!ARRAY_RESERVE(&stream->buffer, count + 1)) {
    set_fault(stream, RECTO_ERROR_MEMORY, ENOMEM);
    return;
  } else if (stream->buffer.count / CHUNK !=
                 (stream->buffer.count + count) / CHUNK &&
             !poll_now()) {
    set_fault(stream, RECTO_ERROR_CANCELLED, 0);
    return;
  }
  memcpy(stream->buffer.item + stream->buffer.count, bytes, count);
  stream->buffer.count += count;
}

recto_status stream_compress(struct stream *stream, recto_error *error) {
  return gzip_create(&stream->gzip, put_bytes, stream, error);
}

void stream_write(struct stream *stream, const void *bytes, size_t count) {
  if (stream->gzip == NULL)
    put_bytes(stream, bytes, count);
  else if (stream->status == RECTO_OK)
    gzip_write(stream->gzip, bytes, count);
}

void stream_text(struct stream *stream, const char *text) {
  stream_write(stream, text, strlen(text));
}

void stream_number(struct stream *stream, double value, int decimals) {
  char text[NUMBER_TEXT_SIZE];
  stream_write(stream, text, number_format(text, value, decimals));
}

void stream_int(struct stream *stream, int64_t value) {
  char text[NUMBER_TEXT_SIZE];
  stream_write(stream, text, number_format_int(text, value));
}

void stream_fault(struct stream *stream, int fault) {
  set_fault(stream, RECTO_ERROR_IO, fault != 0 ? fault : EIO);
}

recto_status stream_status(const struct stream *stream) {
  return stream->status;
}

const char *stream_memory(const struct stream *stream, size_t *count) {
  /* put keeps room for the NUL. */
  *count = stream->buffer.count;
  stream->buffer.item[stream->buffer.count] = '\0';
  return stream->buffer.item;
}

void stream_clear_memory(struct stream *stream) { stream->buffer.count = 0; }

/* ---- Closing ------------------------------------------------------------- */

void stream_discard(struct stream *stream) {
  if (stream == NULL)
    return;
  (void)target_close(&stream->target);
  gzip_destroy(stream->gzip);
  ARRAY_FREE(&stream->buffer);
  mem_free(stream);
}

/* Brings a new file to its end, and reserves the room that one needs whose
 * bytes will be replaced; nothing else is touched. */
static void complete_file(struct stream *stream) {
  if (stream->gzip != NULL && stream->status == RECTO_OK)
    gzip_end(stream->gzip);
  if (may_flush_early(stream))
    flush_buffer(stream);
  else if (!stream->is_memory && stream->status == RECTO_OK &&
           stream->target.kind == TARGET_IN_PLACE &&
           !target_reserve(&stream->target, stream->buffer.count))
    set_system_fault(stream, errno);
}

static void commit_target(struct stream *stream, bool keep_old) {
  struct target *target = &stream->target;
  if (stream->status != RECTO_OK)
    return;
  bool ok =
      target->kind == TARGET_NEW ? target_commit(target, keep_old)
      : target->kind == TARGET_IN_PLACE
          ? target_replace(target, stream->buffer.item, stream->buffer.count)
          : true;
  if (!ok)
    set_system_fault(stream, errno);
}

static recto_status report_failure(const struct stream *stream,
                                   recto_error *error) {
  recto_status status = stream->status;
  if (status == RECTO_ERROR_MEMORY)
    return error_memory(error);
  if (status == RECTO_ERROR_CANCELLED)
    return error_cancelled(error);
  if (status == RECTO_ERROR_ARGUMENT)
    return error_set(error, status, stream->target.name, 0,
                     "another output of this run has taken this place");
  if (status != RECTO_OK)
    return error_set(error, status, stream->target.name, 0, "cannot write: %s",
                     strerror(stream->fault));
  return status;
}

/* Whether the place of a stream has been taken by one before it: names that
 * differ may be one to the file system. */
static bool is_path_taken(struct stream *const *stream, size_t at) {
  struct file_identity there;
  const struct target *target = &stream[at]->target;
  if (stream[at]->is_memory || target->kind != TARGET_NEW || target->existed ||
      !path_identity(target->path, &there))
    return false;
  for (size_t i = 0; i < at; i++) {
    struct file_identity own;
    if (stream[i] != NULL && !stream[i]->is_memory &&
        path_identity_of_descriptor(stream[i]->target.descriptor, &own) &&
        file_identity_is_same(own, there))
      return true;
  }
  return false;
}

/* The first fault of all of them. */
static recto_status first_fault(struct stream *const *stream, size_t count,
                                recto_error *error) {
  for (size_t i = 0; i < count; i++)
    if (stream[i] != NULL && stream[i]->status != RECTO_OK)
      return report_failure(stream[i], error);
  return RECTO_OK;
}

/* Commits the streams of one kind, until one fails. */
static recto_status commit_kind(struct stream *const *stream, size_t count,
                                enum target_kind kind, recto_error *error) {
  recto_status status = RECTO_OK;
  for (size_t i = 0; i < count && status == RECTO_OK; i++) {
    if (stream[i] == NULL || stream[i]->is_memory ||
        stream[i]->target.kind != kind)
      continue;
    if (is_path_taken(stream, i))
      set_fault(stream[i], RECTO_ERROR_ARGUMENT, 0);
    commit_target(stream[i], count > 1);
    status = first_fault(stream, count, error);
  }
  return status;
}

/* Commits all streams or none.  Files whose bytes are replaced are last, since
 * their old bytes are not kept; there is room for them. */
static recto_status commit_all(struct stream *const *stream, size_t count,
                               recto_error *error) {
  recto_status status = commit_kind(stream, count, TARGET_NEW, error);
  if (status == RECTO_OK)
    status = commit_kind(stream, count, TARGET_IN_PLACE, error);
  for (size_t i = 0; i < count && status != RECTO_OK; i++)
    if (stream[i] != NULL)
      target_roll_back(&stream[i]->target);
  return status;
}

static void discard_all(struct stream *const *stream, size_t count) {
  for (size_t i = 0; i < count; i++)
    stream_discard(stream[i]);
}

/* No signal comes between giving the files their names and removing those that
 * they replaced. */
static recto_status commit_and_discard(struct stream *const *stream,
                                       size_t count, recto_error *error) {
  sigset_t all, before;
  sigfillset(&all);
  (void)pthread_sigmask(SIG_SETMASK, &all, &before);
  recto_status status = commit_all(stream, count, error);
  discard_all(stream, count);
  (void)pthread_sigmask(SIG_SETMASK, &before, NULL);
  return status;
}

recto_status stream_finish_all(struct stream *const *stream, size_t count,
                               recto_error *error) {
  for (size_t i = 0; i < count; i++)
    if (stream[i] != NULL)
      complete_file(stream[i]);
  recto_status status = first_fault(stream, count, error);
  for (size_t i = count; i-- > 0 && status == RECTO_OK;) {
    if (stream[i] != NULL && !stream[i]->is_memory &&
        stream[i]->target.kind == TARGET_DESCRIPTOR)
      flush_buffer(stream[i]);
    status = first_fault(stream, count, error);
  }
  if (status == RECTO_OK)
    return commit_and_discard(stream, count, error);
  discard_all(stream, count);
  return status;
}

recto_status stream_complete(struct stream *stream, recto_error *error) {
  complete_file(stream);
  return report_failure(stream, error);
}

recto_status stream_finish(struct stream *stream, recto_error *error) {
  return stream_finish_all(&stream, 1, error);
}
