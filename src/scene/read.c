/* read.c - brings a model file into memory and hands it to its reader.
 *
 * A file is mapped, a pipe is read to its end.  Readers see the whole of it
 * with a NUL behind, so that most of their look-ahead needs no comparison
 * with the end.
 */
#include "scene/scene.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "scene/mark.h"

/* ---- The bytes ----------------------------------------------------------- */

struct input {
  const char *bytes;
  size_t count;
  size_t mapped; /* length of the mapping; 0: the bytes are in `slurped` */
  ARRAY(char) slurped;
};

/* Maps a file of `count` bytes over the start of a mapping of zeros that is
 * at least one byte longer.  The pages of the file itself are not written to,
 * so they cost no memory of our own. */
static bool map_file(int descriptor, size_t count, struct input *input) {
  long page = sysconf(_SC_PAGESIZE);
  if (page <= 0 || count > PTRDIFF_MAX - 2 * (size_t)page)
    return false;
  size_t length = (count / (size_t)page + 1) * (size_t)page;
  void *zeros = mmap(NULL, length, PROT_READ,
                     MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (zeros == MAP_FAILED)
    return false;
  void *bytes =
      mmap(zeros, count, PROT_READ, MAP_PRIVATE | MAP_FIXED, descriptor, 0);
  if (bytes == MAP_FAILED) {
    munmap(zeros, length);
    return false;
  }
  (void)madvise(bytes, count, MADV_SEQUENTIAL);
  input->bytes = bytes;
  input->count = count;
  input->mapped = length;
  return true;
}

static recto_status slurp(int descriptor, const char *path, struct input *input,
                          recto_error *error) {
  enum { CHUNK = 1 << 16 };
  for (;;) {
    if (!ARRAY_RESERVE(&input->slurped, CHUNK + 1))
      return error_memory(error);
    ssize_t got = read(descriptor, input->slurped.item + input->slurped.count,
                       input->slurped.capacity - input->slurped.count - 1);
    if (got < 0 && errno == EINTR)
      continue;
    if (got < 0)
      return error_set(error, RECTO_ERROR_IO, path, 0, "cannot read: %s",
                       strerror(errno));
    if (got == 0)
      break;
    input->slurped.count += (size_t)got;
  }
  input->slurped.item[input->slurped.count] = '\0';
  input->bytes = input->slurped.item;
  input->count = input->slurped.count;
  return RECTO_OK;
}

/* Standard input may be a file too, and one that was read from already. */
static recto_status load(const char *path, struct input *input,
                         recto_error *error) {
  bool standard = strcmp(path, "-") == 0;
  int descriptor =
      standard ? STDIN_FILENO : open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0)
    return error_set(error, RECTO_ERROR_IO, path, 0, "cannot open: %s",
                     strerror(errno));
  recto_status status = RECTO_OK;
  struct stat about;
  bool from_start = !standard || lseek(descriptor, 0, SEEK_CUR) == 0;
  if (fstat(descriptor, &about) != 0 || !S_ISREG(about.st_mode) ||
      about.st_size <= 0 || !from_start ||
      !map_file(descriptor, (size_t)about.st_size, input))
    status = slurp(descriptor, path, input, error);
  if (!standard)
    close(descriptor);
  return status;
}

static void unload(struct input *input) {
  /* Only what mmap gave is given back to it: the const is ours. */
  if (input->mapped)
    munmap((void *)(uintptr_t)input->bytes, input->mapped);
  ARRAY_FREE(&input->slurped);
}

/* ---- The reader ---------------------------------------------------------- */

static const struct reader *const readers[] = {&reader_obj, &reader_stl};
enum { READER_COUNT = sizeof readers / sizeof readers[0] };

#ifdef HAVE_ASSIMP
static const struct reader *const reader_of_the_rest = &reader_assimp;
#else
static const struct reader *const reader_of_the_rest = NULL;
#endif

static char lower(char c) {
  return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

/* Whether `word`, in any case, is one of those in a space-separated list. */
static bool is_listed(const char *word, const char *list) {
  while (*list) {
    size_t length = strcspn(list, " "), i = 0;
    while (i < length && lower(word[i]) == list[i])
      i++;
    if (i == length && word[i] == '\0')
      return true;
    list += length;
    list += strspn(list, " ");
  }
  return false;
}

/* What follows the last point of the path's last part; "" where none does. */
static const char *extension_of(const char *path) {
  const char *slash = strrchr(path, '/');
  const char *name = slash ? slash + 1 : path;
  const char *point = strrchr(name, '.');
  return point && point > name ? point + 1 : "";
}

/* The reader of a file, and in *format what it was chosen by; NULL where there
 * is none. */
static const struct reader *choose_reader(const char *path,
                                          const char **format) {
  bool named = *format != NULL;
  if (!named)
    *format = extension_of(path);
  for (int i = 0; i < READER_COUNT; i++)
    if (is_listed(*format, named ? readers[i]->name : readers[i]->extensions))
      return readers[i];
  return **format ? reader_of_the_rest : NULL;
}

static recto_status refuse(const char *path, const char *format,
                           recto_error *error) {
  const char *others = reader_of_the_rest ? "" : " (built without Assimp)";
  if (format && *format)
    return error_set(error, RECTO_ERROR_UNSUPPORTED, path, 0,
                     "no reader for the format '%s'%s", format, others);
  if (strcmp(path, "-") == 0)
    return error_set(error, RECTO_ERROR_UNSUPPORTED, path, 0,
                     "standard input needs the name of its format");
  return error_set(error, RECTO_ERROR_UNSUPPORTED, path, 0,
                   "no extension to tell the format by");
}

/* ---- Reading ------------------------------------------------------------- */

recto_status scene_read(struct scene *scene, const char *path,
                        const char *format, struct diagnostics *diagnostics,
                        recto_error *error) {
  const struct reader *reader = choose_reader(path, &format);
  if (!reader)
    return refuse(path, format, error);
  struct input input = {.bytes = NULL};
  struct scene_mark mark;
  bool first = scene->point.count == 0;
  scene_mark(scene, &mark);
  recto_status status = load(path, &input, error);
  if (status == RECTO_OK && input.count == 0)
    status = error_set(error, RECTO_ERROR_FORMAT, path, 1, "the file is empty");
  if (status == RECTO_OK)
    status = reader->read(scene, input.bytes, input.count, path, format,
                          diagnostics, error);
  unload(&input);
  if (status != RECTO_OK) {
    scene_return(scene, &mark);
    return status;
  }
  if (first)
    memcpy(scene->up, reader->up, sizeof scene->up);
  diagnostics_finish(diagnostics);
  return RECTO_OK;
}
