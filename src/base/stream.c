/* stream.c - buffered output that appears whole or not at all.
 *
 * Three kinds share one buffer.  A file's buffer is emptied to a temporary
 * file in the same folder whenever it is full; what goes to standard output,
 * to a device or to a pipe stays in the buffer, which grows, until the stream
 * is finished; memory just stays.
 */
#include "base/stream.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/number.h"

enum { CHUNK = 1 << 16 };

enum kind { KIND_FILE, KIND_HELD, KIND_MEMORY };

struct stream {
  enum kind kind;
  recto_status status;
  int fault;       /* errno of the first fault */
  int descriptor;  /* -1 where none is open */
  char *name;      /* as the user wrote it, for messages */
  char *path;      /* KIND_FILE: where the file is to appear */
  char *temporary; /* KIND_FILE: where it is being written */
  ARRAY(char) buffer;
  bool (*go_on)(void *user); /* NULL: nobody is asked */
  void *user;
};

/* For tests alone: see stream_fail_after. */
static unsigned long writes_to_failure;

void stream_fail_after(unsigned long n) { writes_to_failure = n; }

/* The first fault is the one that is told. */
static void fail(struct stream *stream, recto_status status, int fault) {
  if (stream->status != RECTO_OK)
    return;
  stream->status = status;
  stream->fault = fault;
}

static void write_physically(struct stream *stream, const char *bytes,
                             size_t count) {
  while (count > 0 && stream->status == RECTO_OK) {
    if (stream->go_on != NULL && !stream->go_on(stream->user)) {
      fail(stream, RECTO_ERROR_CANCELLED, 0);
      return;
    }
    if (writes_to_failure && --writes_to_failure == 0) {
      fail(stream, RECTO_ERROR_IO, ENOSPC);
      return;
    }
    ssize_t written = write(stream->descriptor, bytes, count);
    if (written > 0) {
      bytes += written;
      count -= (size_t)written;
    } else if (written == 0 || errno != EINTR) {
      fail(stream, RECTO_ERROR_IO, written == 0 ? EIO : errno);
    }
  }
}

static void empty_buffer(struct stream *stream) {
  write_physically(stream, stream->buffer.item, stream->buffer.count);
  stream->buffer.count = 0;
}

/* ---- Opening ------------------------------------------------------------- */

static char *copy_text(const char *text) {
  size_t size = strlen(text) + 1;
  char *copy = mem_alloc(size, 1);
  if (copy)
    memcpy(copy, text, size);
  return copy;
}

/* What the link at `path` says, as seen from here; NULL with *failed false
 * where there is no link. */
static char *read_link(const char *path, bool *failed) {
  struct stat about;
  *failed = false;
  if (lstat(path, &about) != 0 || !S_ISLNK(about.st_mode))
    return NULL;
  const char *slash = strrchr(path, '/');
  size_t folder = slash ? (size_t)(slash + 1 - path) : 0;
  char *target = mem_alloc(folder + PATH_MAX, 1);
  ssize_t length = target ? readlink(path, target + folder, PATH_MAX - 1) : -1;
  *failed = length <= 0;
  if (*failed) {
    mem_free(target);
    return NULL;
  }
  target[folder + (size_t)length] = '\0';
  if (target[folder] == '/')
    memmove(target, target + folder, (size_t)length + 1);
  else
    memcpy(target, path, folder);
  return target;
}

/* The path with its symbolic links followed, so that a link is kept and the
 * file behind it is replaced, or made where there is none.  A ring of links is
 * left for the system to complain of; so is what is no path, as the links of
 * /dev/stdout may be: what is behind it is opened by its own name. */
static char *follow_links(const char *path) {
  enum { MOST_LINKS = 40 };
  struct stat about;
  if (stat(path, &about) == 0 && !S_ISREG(about.st_mode))
    return copy_text(path);
  char *here = copy_text(path);
  bool failed = here == NULL;
  for (int i = 0; i < MOST_LINKS && !failed; i++) {
    char *target = read_link(here, &failed);
    if (target == NULL)
      break;
    mem_free(here);
    here = target;
  }
  if (failed) {
    mem_free(here);
    return NULL;
  }
  return here;
}

/* Creates a file of a new name in the folder of stream->path. */
static bool create_temporary(struct stream *stream, recto_error *error) {
  enum { TRIES = 1000, NAME_SIZE = 64 };
  const char *slash = strrchr(stream->path, '/');
  size_t folder = slash ? (size_t)(slash + 1 - stream->path) : 0;
  stream->temporary = mem_alloc(folder + NAME_SIZE, 1);
  if (!stream->temporary) {
    error_memory(error);
    return false;
  }
  memcpy(stream->temporary, stream->path, folder);
  for (int i = 0; i < TRIES; i++) {
    snprintf(stream->temporary + folder, NAME_SIZE, ".recto-%ld-%d.tmp",
             (long)getpid(), i);
    stream->descriptor =
        open(stream->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (stream->descriptor >= 0)
      return true;
    if (errno != EEXIST)
      break;
  }
  error_set(error, RECTO_ERROR_IO, stream->name, 0, "cannot create: %s",
            strerror(errno));
  mem_free(stream->temporary);
  stream->temporary = NULL;
  return false;
}

/* Opens what stands at stream->path, or makes ready to replace it. */
static bool open_path(struct stream *stream, recto_error *error) {
  struct stat about;
  bool exists = stat(stream->path, &about) == 0;
  if (!exists && errno == ELOOP) {
    error_set(error, RECTO_ERROR_IO, stream->name, 0, "cannot create: %s",
              strerror(errno));
    return false;
  }
  if (exists && S_ISDIR(about.st_mode)) {
    error_set(error, RECTO_ERROR_IO, stream->name, 0, "is a directory");
    return false;
  }
  if (exists && access(stream->path, W_OK) != 0) {
    error_set(error, RECTO_ERROR_IO, stream->name, 0, "cannot write: %s",
              strerror(errno));
    return false;
  }
  if (exists && !S_ISREG(about.st_mode)) {
    stream->kind = KIND_HELD;
    stream->descriptor = open(stream->path, O_WRONLY | O_CLOEXEC);
    if (stream->descriptor < 0)
      error_set(error, RECTO_ERROR_IO, stream->name, 0, "cannot open: %s",
                strerror(errno));
    return stream->descriptor >= 0;
  }
  if (!create_temporary(stream, error))
    return false;
  /* The new file keeps the old one's mode where the system lets it. */
  if (exists)
    (void)!fchmod(stream->descriptor, about.st_mode & 07777);
  return true;
}

static struct stream *create(enum kind kind, const char *name) {
  struct stream *stream = mem_calloc(1, sizeof *stream);
  if (!stream)
    return NULL;
  stream->kind = kind;
  stream->status = RECTO_OK;
  stream->descriptor = -1;
  stream->name = copy_text(name);
  if (!stream->name || !ARRAY_RESERVE(&stream->buffer, CHUNK)) {
    stream_discard(stream);
    return NULL;
  }
  return stream;
}

recto_status stream_open(struct stream **stream, const char *path,
                         recto_error *error) {
  *stream = NULL;
  bool standard = strcmp(path, "-") == 0;
  struct stream *opened = create(standard ? KIND_HELD : KIND_FILE, path);
  if (!opened)
    return error_memory(error);
  if (standard) {
    opened->descriptor = STDOUT_FILENO;
  } else {
    opened->path = follow_links(path);
    if (!opened->path) {
      stream_discard(opened);
      return error_memory(error);
    }
    recto_error why = {.code = RECTO_OK};
    if (!open_path(opened, &why)) {
      stream_discard(opened);
      if (error)
        *error = why;
      return why.code;
    }
  }
  *stream = opened;
  return RECTO_OK;
}

recto_status stream_open_memory(struct stream **stream, recto_error *error) {
  *stream = create(KIND_MEMORY, "");
  return *stream ? RECTO_OK : error_memory(error);
}

/* ---- Writing ------------------------------------------------------------- */

void stream_ask(struct stream *stream, bool (*go_on)(void *user), void *user) {
  stream->go_on = go_on;
  stream->user = user;
}

void stream_write(struct stream *stream, const void *bytes, size_t count) {
  if (stream->status != RECTO_OK || count == 0)
    return;
  if (stream->kind == KIND_FILE) {
    if (count > stream->buffer.capacity - stream->buffer.count)
      empty_buffer(stream);
    if (count > stream->buffer.capacity) {
      write_physically(stream, bytes, count);
      return;
    }
  } else if (!ARRAY_RESERVE(&stream->buffer, count + 1)) {
    fail(stream, RECTO_ERROR_MEMORY, ENOMEM);
    return;
  }
  memcpy(stream->buffer.item + stream->buffer.count, bytes, count);
  stream->buffer.count += count;
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
  fail(stream, RECTO_ERROR_IO, fault != 0 ? fault : EIO);
}

recto_status stream_status(const struct stream *stream) {
  return stream->status;
}

const char *stream_memory(const struct stream *stream, size_t *count) {
  /* stream_write keeps room for the NUL. */
  *count = stream->buffer.count;
  stream->buffer.item[stream->buffer.count] = '\0';
  return stream->buffer.item;
}

/* ---- Closing ------------------------------------------------------------- */

/* Closes what the stream opened; standard output stays open. */
static void close_descriptor(struct stream *stream) {
  bool ours = stream->descriptor >= 0 && stream->descriptor != STDOUT_FILENO;
  if (ours && close(stream->descriptor) != 0 && errno != EINTR)
    fail(stream, RECTO_ERROR_IO, errno);
  stream->descriptor = -1;
}

void stream_discard(struct stream *stream) {
  if (!stream)
    return;
  close_descriptor(stream);
  if (stream->temporary)
    unlink(stream->temporary);
  mem_free(stream->temporary);
  mem_free(stream->path);
  mem_free(stream->name);
  ARRAY_FREE(&stream->buffer);
  mem_free(stream);
}

recto_status stream_finish(struct stream *stream, recto_error *error) {
  if (stream->kind != KIND_MEMORY)
    empty_buffer(stream);
  close_descriptor(stream);
  if (stream->kind == KIND_FILE && stream->status == RECTO_OK) {
    if (rename(stream->temporary, stream->path) == 0) {
      mem_free(stream->temporary);
      stream->temporary = NULL;
    } else {
      fail(stream, RECTO_ERROR_IO, errno);
    }
  }
  recto_status status = stream->status;
  if (status == RECTO_ERROR_MEMORY)
    error_memory(error);
  else if (status == RECTO_ERROR_CANCELLED)
    error_set(error, status, NULL, 0, "cancelled");
  else if (status != RECTO_OK)
    error_set(error, status, stream->name, 0, "cannot write: %s",
              strerror(stream->fault));
  stream_discard(stream);
  return status;
}
