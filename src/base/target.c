/* target.c - output files that are complete before they have their name.
 *
 * A new file has no name while it is written, where the file system can do
 * that (O_TMPFILE): whatever ends the process, nothing is left.  Elsewhere it
 * has a temporary name in the same folder. */
#define _GNU_SOURCE /* O_TMPFILE, fallocate */
#include "base/target.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/file_attributes.h"
#include "base/links.h"
#include "base/memory.h"

enum {
  NAME_SIZE = 64, /* of a temporary file */
  DESCRIPTOR_NAME_SIZE = 32
};

static recto_status io_error(const struct target *target, const char *what,
                             recto_error *error) {
  return error_set(error, RECTO_ERROR_IO, target->name, 0, "cannot %s: %s",
                   what, strerror(errno));
}

/* ---- A new file ---------------------------------------------------------- */

/* A file without a name is given one through this link. */
static void name_descriptor(int descriptor, char name[DESCRIPTOR_NAME_SIZE]) {
  snprintf(name, DESCRIPTOR_NAME_SIZE, "/proc/self/fd/%d", descriptor);
}

static bool create_nameless(struct target *target, const char *folder) {
#ifdef O_TMPFILE
  char name[DESCRIPTOR_NAME_SIZE];
  target->descriptor =
      path_above_standard(open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0666));
  if (target->descriptor < 0)
    return false;
  name_descriptor(target->descriptor, name);
  if (access(name, F_OK) == 0)
    return true;
  close(target->descriptor);
  target->descriptor = -1;
#else
  (void)target;
  (void)folder;
#endif
  return false;
}

/* Tries names beside the path until one is free.
 * make  makes a file of that name; false with errno EEXIST: the next */
static bool try_names(struct target *target,
                      bool (*make)(struct target *target, const char *name)) {
  enum { TRIES = 1000 };
  size_t folder = links_folder_length(target->path);
  char *name = mem_alloc(folder + NAME_SIZE, 1);
  if (name == NULL) {
    errno = ENOMEM;
    return false;
  }
  memcpy(name, target->path, folder);
  for (int i = 0; i < TRIES; i++) {
    snprintf(name + folder, NAME_SIZE, ".recto-%ld-%d.tmp", (long)getpid(), i);
    if (make(target, name)) {
      target->temporary = name;
      return true;
    }
    if (errno != EEXIST)
      break;
  }
  int fault = errno;
  mem_free(name);
  errno = fault;
  return false;
}

static bool make_named(struct target *target, const char *name) {
  target->descriptor = path_above_standard(
      open(name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  return target->descriptor >= 0;
}

static bool make_link(struct target *target, const char *name) {
  char from[DESCRIPTOR_NAME_SIZE];
  name_descriptor(target->descriptor, from);
  return linkat(AT_FDCWD, from, AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0;
}

static recto_status create_file(struct target *target, recto_error *error) {
  char *folder = links_folder(target->path);
  if (folder == NULL)
    return error_memory(error);
  bool there = stat(folder, &target->folder) == 0;
  bool made = there && (create_nameless(target, folder) ||
                        try_names(target, make_named));
  int fault = errno;
  mem_free(folder);
  errno = fault;
  if (made)
    return RECTO_OK;
  return errno == ENOMEM ? error_memory(error)
                         : io_error(target, "create", error);
}

static void remove_temporary(struct target *target) {
  if (target->temporary != NULL)
    unlink(target->temporary);
  mem_free(target->temporary);
  target->temporary = NULL;
}

/* ---- Opening ------------------------------------------------------------- */

static recto_status open_in_place(struct target *target, recto_error *error) {
  target->kind =
      S_ISREG(target->old.st_mode) ? TARGET_IN_PLACE : TARGET_DESCRIPTOR;
  target->descriptor =
      path_above_standard(open(target->path, O_WRONLY | O_CLOEXEC | O_NOCTTY));
  return target->descriptor >= 0 ? RECTO_OK : io_error(target, "open", error);
}

static recto_status open_descriptor(struct target *target, int descriptor,
                                    recto_error *error) {
  target->kind = TARGET_DESCRIPTOR;
  mem_free(target->path);
  target->path = NULL;
  target->descriptor = fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  return target->descriptor >= 0 ? RECTO_OK : io_error(target, "write", error);
}

static recto_status replace(struct target *target, recto_error *error) {
  recto_error why;
  bool is_too_long = links_folder_length(target->path) + NAME_SIZE > PATH_MAX;
  if (target->old.st_nlink > 1 || is_too_long)
    return open_in_place(target, error);
  recto_status status = create_file(target, &why);
  if (status == RECTO_OK &&
      file_attributes_copy(target->path, &target->old, target->descriptor))
    return RECTO_OK;
  if (status == RECTO_OK) {
    close(target->descriptor);
    target->descriptor = -1;
    remove_temporary(target);
  } else if (status != RECTO_ERROR_IO) {
    return error_memory(error);
  }
  return open_in_place(target, error);
}

/* Finds out what is there; target->path is set. */
static recto_status query_target(struct target *target, recto_error *error) {
  target->existed = stat(target->path, &target->old) == 0;
  if (!target->existed && errno != ENOENT)
    return io_error(target, "create", error);
  if (target->existed && S_ISDIR(target->old.st_mode))
    return error_set(error, RECTO_ERROR_IO, target->name, 0, "is a directory");
  if (target->existed && access(target->path, W_OK) != 0)
    return io_error(target, "write", error);
  return RECTO_OK;
}

static recto_status open_path(struct target *target, recto_error *error) {
  target->path = links_follow(target->name);
  if (target->path == NULL)
    return error_memory(error);
  int descriptor = path_descriptor(target->path);
  if (descriptor >= 0)
    return open_descriptor(target, descriptor, error);
  recto_status status = query_target(target, error);
  if (status != RECTO_OK)
    return status;
  if (!target->existed)
    return create_file(target, error);
  return S_ISREG(target->old.st_mode) ? replace(target, error)
                                      : open_in_place(target, error);
}

recto_status target_open(struct target *target, const char *path,
                         recto_error *error) {
  *target = (struct target){.descriptor = -1, .name = mem_copy_text(path)};
  recto_status status = target->name == NULL ? error_memory(error)
                        : strcmp(path, "-") == 0
                            ? open_descriptor(target, STDOUT_FILENO, error)
                            : open_path(target, error);
  if (status != RECTO_OK)
    (void)target_close(target);
  return status;
}

/* Whether something other than a file or a folder stands there, which opening
 * may wake. */
static bool is_special(const char *path) {
  struct stat attributes;
  return strcmp(path, "-") != 0 && path_descriptor(path) < 0 &&
         stat(path, &attributes) == 0 && !S_ISREG(attributes.st_mode) &&
         !S_ISDIR(attributes.st_mode);
}

recto_status target_try(const char *path, recto_error *error) {
  struct target target;
  if (is_special(path))
    return RECTO_OK;
  if (*path == '\0')
    return error_set(error, RECTO_ERROR_IO, path, 0, "cannot create: %s",
                     strerror(ENOENT));
  recto_status status = target_open(&target, path, error);
  if (status == RECTO_OK)
    (void)target_close(&target);
  return status;
}

/* ---- Telling targets apart ----------------------------------------------- */

/* What is there now, by whatever it is known. */
static bool find_old(const struct target *target, struct stat *old) {
  *old = target->old;
  return target->existed || (target->kind == TARGET_DESCRIPTOR &&
                             fstat(target->descriptor, old) == 0);
}

bool target_is_same(const struct target *a, const struct target *b) {
  struct stat one, two;
  bool there = find_old(a, &one), other_there = find_old(b, &two);
  if (there && other_there) /* much may well go to one terminal */
    return links_same_file(&one, &two) && !S_ISCHR(one.st_mode);
  return !there && !other_there && links_same_file(&a->folder, &b->folder) &&
         strcmp(a->path + links_folder_length(a->path),
                b->path + links_folder_length(b->path)) == 0;
}

bool target_paths_are_same(const char *a, const char *b) {
  struct target one, other;
  if (is_special(a) || is_special(b) || target_open(&one, a, NULL) != RECTO_OK)
    return false;
  bool same = target_open(&other, b, NULL) == RECTO_OK;
  same = same && target_is_same(&one, &other);
  (void)target_close(&one);
  (void)target_close(&other);
  return same;
}

bool target_is(const struct target *target, struct file_identity it) {
  struct stat old;
  return find_old(target, &old) && S_ISREG(old.st_mode) &&
         (uint64_t)old.st_dev == it.device && (uint64_t)old.st_ino == it.number;
}

/* ---- Putting in place ---------------------------------------------------- */

static bool write_bytes_all(int descriptor, const char *bytes, size_t count) {
  while (count > 0) {
    ssize_t written = write(descriptor, bytes, count);
    if (written < 0 && errno == EINTR)
      continue;
    if (written <= 0) {
      errno = written == 0 ? EIO : errno;
      return false;
    }
    bytes += written;
    count -= (size_t)written;
  }
  return true;
}

/* Whether the process may write a file of that size.  What reserves space does
 * not test that, as it leaves the size of the file. */
static bool is_within_limit(size_t count) {
  struct rlimit limit;
  return getrlimit(RLIMIT_FSIZE, &limit) != 0 ||
         limit.rlim_cur == RLIM_INFINITY || count <= limit.rlim_cur;
}

/* Makes sure that there is room before a byte is changed, where the file system
 * can. */
static bool reserve_space(int descriptor, size_t count) {
  if (!is_within_limit(count)) {
    errno = EFBIG;
    return false;
  }
#ifdef FALLOC_FL_KEEP_SIZE
  if (count > 0 &&
      fallocate(descriptor, FALLOC_FL_KEEP_SIZE, 0, (off_t)count) != 0)
    return errno != ENOSPC && errno != EDQUOT && errno != EFBIG;
#else
  (void)descriptor;
  (void)count;
#endif
  return true;
}

/* Some file systems can be interrupted there. */
static bool set_size(int descriptor, size_t count) {
  int failed;
  do
    failed = ftruncate(descriptor, (off_t)count);
  while (failed != 0 && errno == EINTR);
  return failed == 0;
}

bool target_reserve(struct target *target, size_t count) {
  return reserve_space(target->descriptor, count);
}

bool target_replace(struct target *target, const char *bytes, size_t count) {
  int to = target->descriptor;
  return write_bytes_all(to, bytes, count) && set_size(to, count);
}

/* Where the folder's entry cannot be changed, as that of a file that is mounted
 * by itself, its bytes can. */
static bool copy_in_place(struct target *target) {
  enum { CHUNK = 1 << 16 };
  struct stat attributes;
  int to = path_above_standard(open(target->path, O_WRONLY | O_CLOEXEC));
  char *chunk = mem_alloc(CHUNK, 1);
  off_t at = 0;
  bool ok = to >= 0 && chunk != NULL &&
            fstat(target->descriptor, &attributes) == 0 &&
            reserve_space(to, (size_t)attributes.st_size);
  while (ok && at < attributes.st_size) {
    ssize_t got = pread(target->descriptor, chunk, CHUNK, at);
    ok = got > 0 && write_bytes_all(to, chunk, (size_t)got);
    at += got;
  }
  ok = ok && set_size(to, (size_t)at);
  if (to >= 0)
    ok = close(to) == 0 && ok;
  mem_free(chunk);
  return ok;
}

/* Exchanges the file with the one that has the temporary name, where the
 * system can. */
static bool exchange(const struct target *target) {
#ifdef RENAME_EXCHANGE
  return renameat2(AT_FDCWD, target->temporary, AT_FDCWD, target->path,
                   RENAME_EXCHANGE) == 0;
#else
  (void)target;
  return false;
#endif
}

static bool move_into_place(struct target *target, bool keep_old) {
  bool is_nameless = target->temporary == NULL;
  if (is_nameless && !target->existed && make_link(target, target->path))
    return true;
  if (is_nameless && !try_names(target, make_link))
    return false;
  target->exchanged = keep_old && target->existed && exchange(target);
  if (target->exchanged)
    return true;
  if (rename(target->temporary, target->path) == 0) {
    mem_free(target->temporary);
    target->temporary = NULL;
    return true;
  }
  int fault = errno;
  remove_temporary(target);
  errno = fault;
  return target->existed && (errno == EBUSY || errno == EPERM) &&
         copy_in_place(target);
}

/* Some file systems report a failed write only when a descriptor is closed;
 * the file's own stays open, to identify it. */
static bool is_written(int descriptor) {
  int copy = fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  return copy < 0 || close(copy) == 0 || errno == EINTR;
}

bool target_commit(struct target *target, bool keep_old) {
  target->committed =
      is_written(target->descriptor) && move_into_place(target, keep_old);
  return target->committed;
}

void target_roll_back(struct target *target) {
  struct stat there, own;
  if (!target->committed || lstat(target->path, &there) != 0 ||
      fstat(target->descriptor, &own) != 0 || !links_same_file(&there, &own))
    return;
  if (target->exchanged)
    (void)exchange(target);
  else if (!target->existed)
    unlink(target->path);
}

bool target_close(struct target *target) {
  bool ok = target->descriptor < 0 || close(target->descriptor) == 0 ||
            errno == EINTR;
  int fault = errno;
  remove_temporary(target);
  mem_free(target->path);
  mem_free(target->name);
  *target = (struct target){.descriptor = -1};
  errno = fault;
  return ok;
}
