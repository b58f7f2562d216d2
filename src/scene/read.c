/* read.c - brings a model file into memory and hands it to its reader.
 *
 * Readers see the whole of it, of an OBJ file a block of whole lines, with a
 * NUL behind, so that most of their look-ahead needs no comparison with the
 * end.
 */
#include "scene/read.h"

#include <string.h>

#include "base/input.h"
#include "base/path.h"
#include "base/word.h"
#include "scene/obj/obj_blocks.h"
#include "scene/precision_warning.h"
#include "scene/readers/conversion.h"

/* ---- The reader ---------------------------------------------------------- */

static const struct reader *const readers[] = {
    &reader_obj,
    &reader_ply,
    &reader_stl,
#ifdef HAVE_ASSIMP
    &reader_3mf,
#endif
};
enum { READER_COUNT = sizeof readers / sizeof readers[0] };

#ifdef HAVE_ASSIMP
static const struct reader *const reader_of_the_rest = &reader_import;
#else
static const struct reader *const reader_of_the_rest = NULL;
#endif

enum { EXTENSION_SIZE = 32 };

/* Copies what follows the last point of the name of that length; "" where
 * nothing does or it is longer than any extension.  Returns the length of what
 * stands before. */
static size_t copy_extension(const char *name, size_t length,
                             char to[EXTENSION_SIZE]) {
  size_t point = length;
  to[0] = '\0';
  while (point > 0 && name[point - 1] != '.')
    point--;
  if (point <= 1 || length - point >= EXTENSION_SIZE)
    return length;
  memcpy(to, name + point, length - point);
  to[length - point] = '\0';
  return point - 1;
}

/* The extension of the path's last part; of "a.obj.gz" it is "obj". */
static void find_extension(const char *path, char to[EXTENSION_SIZE]) {
  const char *slash = strrchr(path, '/');
  const char *name = slash != NULL ? slash + 1 : path;
  size_t rest = copy_extension(name, strlen(name), to);
  if (word_is_among(to, "gz", false))
    (void)copy_extension(name, rest, to);
}

/* The stem of a file's name, which is the path's last part without its
 * extensions; none where the path names no file.  Returns its length. */
static size_t find_stem(const char *path, const char **stem) {
  char extension[EXTENSION_SIZE];
  const char *slash = strrchr(path, '/');
  *stem = slash != NULL ? slash + 1 : path;
  if (strcmp(path, "-") == 0 || path_descriptor(path) >= 0)
    return 0;
  size_t length = copy_extension(*stem, strlen(*stem), extension);
  return word_is_among(extension, "gz", false)
             ? copy_extension(*stem, length, extension)
             : length;
}

void read_begin_file(struct scene *scene, const char *path) {
  const char *stem;
  size_t length = find_stem(path, &stem);
  scene_begin_file(scene, stem, length);
}

/* The reader of a file, and in *format what it was chosen by; NULL where there
 * is none.
 * extension  room for what is chosen by where *format is NULL */
static const struct reader *choose_reader(const char *path,
                                          char extension[EXTENSION_SIZE],
                                          const char **format) {
  bool named = *format != NULL;
  find_extension(path, extension);
  if (!named)
    *format = extension;
  for (int i = 0; i < READER_COUNT; i++)
    if (word_is_among(*format,
                      named ? readers[i]->name : readers[i]->extensions, false))
      return readers[i];
  return **format ? reader_of_the_rest : NULL;
}

const struct reader *read_find(const char *path, const char *format) {
  char extension[EXTENSION_SIZE];
  return choose_reader(path, extension, &format);
}

static recto_status refuse_format(const char *path, const char *format,
                                  recto_error *error) {
  const char *others = reader_of_the_rest != NULL
                           ? ""
                           : " (built without Assimp: " READ_OWN_FORMATS
                             " alone)";
  if (format != NULL && *format)
    return error_set(error, RECTO_ERROR_UNSUPPORTED, path, 0,
                     "no reader for the format '%s'%s", format, others);
  if (strcmp(path, "-") == 0)
    return error_set(error, RECTO_ERROR_UNSUPPORTED, path, 0,
                     "standard input needs the name of its format");
  return error_set(error, RECTO_ERROR_UNSUPPORTED, path, 0,
                   "no extension to tell the format by");
}

/* ---- Reading ------------------------------------------------------------- */

/* Reads what was loaded; on a failure the scene is as it was.
 * blocks  what it is read from instead; NULL: it was loaded */
static recto_status read_input(struct scene *scene, const struct reader *reader,
                               const struct input *input,
                               struct obj_blocks *blocks, const char *path,
                               const char *format,
                               struct diagnostics *diagnostics,
                               recto_error *error) {
  struct scene_snapshot before;
  struct model_coordinates model = {.path = path,
                                    .up_is_stated = reader->states_up};
  memcpy(model.up, reader->up, sizeof model.up);
  if (diagnostics != NULL) {
    diagnostics->bytes = diagnostics->poll_at = input->bytes;
    diagnostics->bytes_before = 0;
    diagnostics->byte_count = input->count;
  }
  scene_snapshot(scene, &before);
  recto_status status =
      scene_note_file(scene, input) ? RECTO_OK : error_memory(error);
  if (status == RECTO_OK && input->count == 0)
    status = error_set(error, RECTO_ERROR_FORMAT, path, 1, "the file is empty");
  read_begin_file(scene, path);
  if (status == RECTO_OK)
    status = blocks != NULL
                 ? obj_blocks_read(blocks, scene, path, diagnostics, error)
                 : reader->read(scene, input->bytes, input->count, path, format,
                                diagnostics, error);
  model.unit_mm = scene->file_unit_mm;
  scene_end_file(scene);
  if (status == RECTO_OK && scene->precision.count == before.precisions)
    status = scene_leave_precision(scene, before.points, error);
  if (status == RECTO_OK)
    precision_warn(scene, before.points, path, diagnostics);
  /* Of what Assimp reads, a format that states a unit states the axis too. */
  model.up_is_stated = model.up_is_stated || model.unit_mm > 0;
  if (status == RECTO_OK)
    status = conversion_apply(scene, &before, &model, diagnostics, error);
  if (status != RECTO_OK) {
    scene_restore(scene, &before);
    return status;
  }
  diagnostics_finish(diagnostics);
  return RECTO_OK;
}

recto_status scene_read_blocks(struct scene *scene, struct obj_blocks *blocks,
                               const char *path,
                               struct diagnostics *diagnostics,
                               recto_error *error) {
  const struct input input = {.count = (size_t)blocks->lines.size,
                              .is_file = true,
                              .file = blocks->lines.file};
  blocks->lines.is_read_once = true;
  recto_status status = read_input(scene, &reader_obj, &input, blocks, path,
                                   "obj", diagnostics, error);
  obj_blocks_close(blocks);
  return status;
}

recto_status scene_read(struct scene *scene, const char *path,
                        const char *format, struct diagnostics *diagnostics,
                        recto_error *error) {
  char extension[EXTENSION_SIZE];
  const struct reader *reader = choose_reader(path, extension, &format);
  if (reader == NULL)
    return refuse_format(path, format, error);
  struct obj_blocks blocks = {.lines = {.bytes = NULL}};
  if (reader == &reader_obj &&
      line_blocks_open(&blocks.lines, path, OBJ_BLOCK_BYTES) &&
      (uint64_t)blocks.lines.size <= input_size_max())
    return scene_read_blocks(scene, &blocks, path, diagnostics, error);
  obj_blocks_close(&blocks);
  struct input input;
  recto_status status = input_load(&input, path, error);
  if (status == RECTO_OK)
    status = read_input(scene, reader, &input, NULL, path, format, diagnostics,
                        error);
  input_unload(&input);
  return status;
}

recto_status scene_read_memory(struct scene *scene, const void *bytes,
                               size_t count, const char *name,
                               const char *format,
                               struct diagnostics *diagnostics,
                               recto_error *error) {
  char extension[EXTENSION_SIZE];
  const struct reader *reader = choose_reader(name, extension, &format);
  if (reader == NULL)
    return refuse_format(name, format, error);
  struct input input;
  recto_status status = input_copy(&input, bytes, count, name, error);
  if (status == RECTO_OK)
    status = read_input(scene, reader, &input, NULL, name, format, diagnostics,
                        error);
  input_unload(&input);
  return status;
}
