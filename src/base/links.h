/* links.h - where paths lead, by their symbolic links, and their folders. */
#ifndef BASE_LINKS_H
#define BASE_LINKS_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/stat.h>

static inline bool links_same_file(const struct stat *a, const struct stat *b) {
  return a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

/* The length of the path's folder, the last slash included. */
size_t links_folder_length(const char *path);

/* The folder of what a path names, as a path: NULL when memory ran out. */
char *links_folder(const char *path);

/* The path with its symbolic links followed, so that a link is kept and the
 * file behind it is replaced, or made where there is none.  A ring of links is
 * left for the system to complain of.  NULL: failed. */
char *links_follow(const char *path);

#endif
