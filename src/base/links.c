/* links.c - where paths lead, by their symbolic links, and their folders. */
#define _GNU_SOURCE /* lstat, readlink */
#include "base/links.h"

#include <limits.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/path.h"

size_t links_folder_length(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash != NULL ? (size_t)(slash + 1 - path) : 0;
}

/* What the link at `path` says, as seen from here; NULL with *failed false
 * where there is no link. */
static char *read_link(const char *path, bool *failed) {
  struct stat attributes;
  *failed = false;
  if (lstat(path, &attributes) != 0 || !S_ISLNK(attributes.st_mode))
    return NULL;
  size_t folder = links_folder_length(path);
  char *to = mem_alloc(folder + PATH_MAX, 1);
  ssize_t length = to != NULL ? readlink(path, to + folder, PATH_MAX - 1) : -1;
  *failed = length <= 0;
  if (*failed) {
    mem_free(to);
    return NULL;
  }
  to[folder + (size_t)length] = '\0';
  if (to[folder] == '/')
    memmove(to, to + folder, (size_t)length + 1);
  else
    memcpy(to, path, folder);
  return to;
}

/* Whether what the system finds at `link` is not at the path that the link
 * says: /proc has such links to what is open, which may have no path. */
static bool leads_elsewhere(const char *link, const char *says) {
  struct stat there, said;
  return stat(link, &there) == 0 &&
         (stat(says, &said) != 0 || !links_same_file(&there, &said));
}

char *links_follow(const char *path) {
  enum { LINKS_MAX = 40 };
  char *here = mem_copy_text(path);
  bool failed = here == NULL;
  for (int i = 0; i < LINKS_MAX && !failed && path_descriptor(here) < 0; i++) {
    char *to = read_link(here, &failed);
    if (to == NULL)
      break;
    if (leads_elsewhere(here, to)) {
      mem_free(to);
      break;
    }
    mem_free(here);
    here = to;
  }
  if (failed) {
    mem_free(here);
    return NULL;
  }
  return here;
}

char *links_folder(const char *path) {
  size_t length = links_folder_length(path);
  char *folder = mem_copy_text(length > 0 ? path : ".");
  if (folder != NULL && length > 0)
    folder[length] = '\0';
  return folder;
}
