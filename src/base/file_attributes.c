/* file_attributes.c - gives a file the owner, the mode, the access list and the
 * other attributes of another one. */
#define _GNU_SOURCE /* fchown, fchmod */
#include "base/file_attributes.h"

#include <errno.h>
#include <string.h>
#include <sys/xattr.h>
#include <unistd.h>

#include "base/memory.h"

/* Attributes that only the system may set are not copied. */
static bool is_user_attribute(const char *attribute) {
  return strncmp(attribute, "user.", 5) == 0 ||
         strcmp(attribute, "system.posix_acl_access") == 0;
}

static bool copy_attribute(const char *from, int to, const char *name) {
  enum { MOST = 1 << 16 }; /* of the system */
  char *value = mem_alloc(MOST, 1);
  ssize_t size = value != NULL ? getxattr(from, name, value, MOST) : -1;
  bool ok = size >= 0 && fsetxattr(to, name, value, (size_t)size, 0) == 0;
  mem_free(value);
  return ok || !is_user_attribute(name);
}

/* Access lists are such attributes.  They are read by the path: also of a file
 * that may not be opened, names and access list can be read. */
static bool copy_attributes(const char *from, int to) {
  ssize_t size = listxattr(from, NULL, 0);
  if (size <= 0)
    return size == 0 || errno == ENOTSUP;
  char *names = mem_alloc((size_t)size, 1);
  size = names != NULL ? listxattr(from, names, (size_t)size) : -1;
  bool ok = size >= 0;
  for (ssize_t at = 0; ok && at < size; at += (ssize_t)strlen(names + at) + 1)
    ok = copy_attribute(from, to, names + at);
  mem_free(names);
  return ok;
}

bool file_attributes_copy(const char *from, const struct stat *old, int to) {
  struct stat made;
  if (fstat(to, &made) != 0)
    return false;
  bool is_owned = made.st_uid == old->st_uid && made.st_gid == old->st_gid;
  if (!is_owned && fchown(to, old->st_uid, old->st_gid) != 0)
    return false;
  return copy_attributes(from, to) && fchmod(to, old->st_mode & 07777) == 0;
}
