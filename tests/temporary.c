/* temporary.c - a folder for a test's files. */
#include "tests/temporary.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PATH_SIZE = 512, PATH_COUNT = 4 };

int temporary_set_up(void **state) {
  const char *parent = getenv("TMPDIR");
  char *folder = malloc(PATH_SIZE);
  if (folder == NULL)
    return -1;
  snprintf(folder, PATH_SIZE, "%s/recto-test-XXXXXX",
           parent && *parent ? parent : "/tmp");
  if (!mkdtemp(folder)) {
    free(folder);
    return -1;
  }
  *state = folder;
  return 0;
}

int temporary_tear_down(void **state) {
  DIR *folder = opendir(*state);
  if (folder == NULL)
    return -1;
  for (struct dirent *entry; (entry = readdir(folder)) != NULL;)
    if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
      (void)!unlink(temporary_path(state, entry->d_name));
  closedir(folder);
  int result = rmdir(*state);
  free(*state);
  return result;
}

const char *temporary_path(void *const *state, const char *name) {
  static char path[PATH_COUNT][PATH_SIZE];
  static int next;
  char *here = path[next];
  next = (next + 1) % PATH_COUNT;
  snprintf(here, PATH_SIZE, "%.200s/%.256s", (const char *)*state, name);
  return here;
}

const char *temporary_file(void *const *state, const char *name,
                           const void *bytes, size_t count) {
  const char *path = temporary_path(state, name);
  FILE *file = fopen(path, "wb");
  if (file == NULL || (count && fwrite(bytes, count, 1, file) != 1) ||
      fclose(file) != 0) {
    perror(path);
    exit(1);
  }
  return path;
}

char *temporary_read(const char *path, size_t *count) {
  enum { SIZE_MAX_READ = 1 << 24 };
  FILE *file = fopen(path, "rb");
  char *bytes = malloc(SIZE_MAX_READ);
  if (file == NULL || bytes == NULL) {
    free(bytes);
    if (file != NULL)
      fclose(file);
    return NULL;
  }
  *count = fread(bytes, 1, SIZE_MAX_READ - 1, file);
  bytes[*count] = '\0';
  fclose(file);
  return bytes;
}

size_t temporary_count(void *const *state) {
  size_t count = 0;
  DIR *folder = opendir(*state);
  if (folder == NULL)
    return 0;
  for (struct dirent *entry; (entry = readdir(folder)) != NULL;)
    count +=
        strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
  closedir(folder);
  return count;
}
