/* material.c - finds the libraries that an OBJ file names and colours its
 * groups.
 *
 * Robustness  Names come from a file that may be hostile: each library is read
 * once, at most LIBRARY_MAX of them, and only regular files. */
#include "scene/obj/material.h"

#include <string.h>

#include "base/input.h"
#include "base/path.h"
#include "scene/diagnostics.h"

enum { LIBRARY_MAX = 100 };

static const char GZIP[] = ".gz";

void materials_init(struct materials *materials) {
  *materials = (struct materials){0};
  scene_init(&materials->libraries);
}

void materials_fini(struct materials *materials) {
  scene_fini(&materials->libraries);
  ARRAY_FREE(&materials->library);
  ARRAY_FREE(&materials->use);
  arena_fini(&materials->names);
}

/* Makes the name a copy that the materials own; false when memory ran out. */
static bool own_name(struct materials *materials, struct material_name *name) {
  char *copy = arena_alloc(&materials->names, name->length + 1, 1);
  if (copy == NULL)
    return false;
  memcpy(copy, name->start, name->length);
  name->start = copy;
  return true;
}

recto_status materials_add_library(struct materials *materials,
                                   struct material_name name,
                                   recto_error *error) {
  size_t before = materials->libraries.group.count;
  recto_status status =
      scene_use_group(&materials->libraries, name.start, name.length, error);
  if (status == RECTO_OK && materials->libraries.group.count > before &&
      !(own_name(materials, &name) && ARRAY_PUSH(&materials->library, name)))
    status = error_memory(error);
  return status;
}

recto_status materials_add_use(struct materials *materials, uint32_t group,
                               struct material_name name, recto_error *error) {
  const struct material_name none = {NULL, 0, 0};
  while (materials->use.count <= group)
    if (!ARRAY_PUSH(&materials->use, none))
      return error_memory(error);
  if (materials->use.item[group].length > 0 || name.length == 0)
    return RECTO_OK;
  if (!own_name(materials, &name))
    return error_memory(error);
  materials->use.item[group] = name;
  return RECTO_OK;
}

/* ---- Libraries ----------------------------------------------------------- */

struct library_reader {
  struct scene *scene;  /* whose groups are coloured */
  struct scene palette; /* a group for each material */
  const char *model;    /* path; "": libraries are not looked for */
  struct diagnostics *diagnostics;
  recto_error *error;
};

/* Passes a library's faults on under its own name, and counts them with the
 * model's. */
static recto_status read_material_library(struct library_reader *reader,
                                          const char *path,
                                          const struct input *input) {
  struct diagnostics own = {.file = path};
  if (reader->diagnostics != NULL) {
    own.warning = reader->diagnostics->warning;
    own.user = reader->diagnostics->user;
  }
  recto_status status = material_read(&reader->palette, input->bytes,
                                      input->count, &own, reader->error);
  diagnostics_finish(&own);
  if (reader->diagnostics != NULL) {
    unsigned long count = own.count[SCENE_FAULT_MATERIAL];
    reader->diagnostics->count[SCENE_FAULT_MATERIAL] += count;
    reader->diagnostics->settled[SCENE_FAULT_MATERIAL] += count;
  }
  return status;
}

/* Loads the library at that path, which has room for GZIP after it: where
 * there is no such file, one that gzip has compressed, as models are.  The path
 * becomes that of the file that was taken. */
static recto_status load_library(struct input *input, char *path,
                                 recto_error *why) {
  size_t length = strlen(path);
  recto_error of_other;
  recto_status status = input_load_named(input, path, why);
  if (status != RECTO_ERROR_IO)
    return status;
  input_unload(input);
  memcpy(path + length, GZIP, sizeof GZIP);
  recto_status other = input_load_named(input, path, &of_other);
  if (other == RECTO_ERROR_IO) {
    path[length] = '\0'; /* messages give the name in the model */
    return status;
  }
  if (other != RECTO_OK)
    *why = of_other;
  return other;
}

/* Notes that a library belongs to the scene, if there is one at that path or at
 * that of load_library. */
static recto_status note_library(struct library_reader *reader, char *path,
                                 bool *found) {
  struct file_identity file;
  *found =
      path_identity(path, &file) || path_identity(strcat(path, GZIP), &file);
  return !*found || ARRAY_PUSH(&reader->scene->file, file)
             ? RECTO_OK
             : error_memory(reader->error);
}

/* Reads a library of that name beside the model; *found where there is one,
 * else `why` says what is wrong with it. */
static recto_status try_library(struct library_reader *reader, const char *name,
                                size_t length, bool *found, recto_error *why) {
  const char *slash = strrchr(reader->model, '/');
  size_t folder =
      slash != NULL && *name != '/' ? (size_t)(slash + 1 - reader->model) : 0;
  char *path = length < PTRDIFF_MAX / 2 - folder
                   ? mem_alloc(folder + length + sizeof GZIP, 1)
                   : NULL;
  if (path == NULL)
    return error_memory(reader->error);
  memcpy(path, reader->model, folder);
  memcpy(path + folder, name, length);
  path[folder + length] = '\0';
  if (!reader->scene->needs_colours) {
    recto_status status = note_library(reader, path, found);
    mem_free(path);
    return status;
  }
  struct input input;
  recto_status status = load_library(&input, path, why);
  *found = status == RECTO_OK;
  if (*found && !scene_note_file(reader->scene, &input))
    status = error_memory(reader->error);
  else if (*found && input.count > 0)
    status = read_material_library(reader, path, &input);
  else if (status == RECTO_ERROR_MEMORY)
    (void)error_memory(reader->error);
  else
    status = RECTO_OK;
  input_unload(&input);
  mem_free(path);
  return status;
}

static void warn_missing_material(struct library_reader *reader,
                                  const struct material_name *name,
                                  size_t length, const char *at,
                                  const recto_error *why) {
  if (!reader->scene->needs_colours)
    return;
  diagnostics_fault(reader->diagnostics, SCENE_FAULT_MATERIAL, name->line,
                    "material library %.*s: %s", length < 80 ? (int)length : 80,
                    at, why->text);
}

/* The rest of the line is one name, in which there may be blanks, or, where
 * there is no such file, several with blanks between them. */
static recto_status read_libraries(struct library_reader *reader,
                                   const struct material_name *name) {
  bool found = false;
  recto_error why;
  recto_status status =
      try_library(reader, name->start, name->length, &found, &why);
  if (status != RECTO_OK || found)
    return status;
  const char *at = name->start, *end = at + name->length;
  int tried = 0;
  while (status == RECTO_OK && at < end && tried++ < LIBRARY_MAX) {
    const char *stop = at;
    while (stop < end && *stop != ' ' && *stop != '\t')
      stop++;
    found = false;
    if (stop == end && at == name->start) /* has been tried */
      warn_missing_material(reader, name, name->length, at, &why);
    else if (stop > at) {
      status = try_library(reader, at, (size_t)(stop - at), &found, &why);
      if (status == RECTO_OK && !found)
        warn_missing_material(reader, name, (size_t)(stop - at), at, &why);
    }
    at = stop < end ? stop + 1 : end;
  }
  return status;
}

static recto_status read_all_libraries(struct library_reader *reader,
                                       const struct materials *materials) {
  recto_status status = RECTO_OK;
  size_t count = *reader->model != '\0' ? materials->library.count : 0;
  if (count > LIBRARY_MAX && reader->scene->needs_colours)
    diagnostics_fault(reader->diagnostics, SCENE_FAULT_MATERIAL,
                      materials->library.item[LIBRARY_MAX].line,
                      "more than %d material libraries, not read", LIBRARY_MAX);
  for (size_t i = 0; status == RECTO_OK && i < count && i < LIBRARY_MAX; i++)
    status = read_libraries(reader, &materials->library.item[i]);
  return status;
}

/* ---- Colours ------------------------------------------------------------- */

/* The palette's number of each group's material, SCENE_NONE where it has none,
 * to material[]. */
static recto_status find_group_materials(struct library_reader *reader,
                                         const struct materials *materials,
                                         uint32_t *material) {
  for (size_t g = 0; g < materials->use.count; g++) {
    const struct material_name *name = &materials->use.item[g];
    size_t known = reader->palette.group.count;
    material[g] = SCENE_NONE;
    if (name->length == 0)
      continue;
    recto_status status = scene_use_group(&reader->palette, name->start,
                                          name->length, reader->error);
    if (status != RECTO_OK)
      return status;
    material[g] = reader->palette.current_group;
    /* One that is not known is added here, and so reported once. */
    if (reader->palette.group.count > known)
      diagnostics_fault(reader->diagnostics, SCENE_FAULT_MATERIAL, name->line,
                        "material %.80s is in no library",
                        reader->palette.group.item[known].name);
  }
  return RECTO_OK;
}

static void colour_groups(struct scene *scene,
                          const struct library_reader *reader,
                          const uint32_t *material, size_t count) {
  for (size_t g = 0; g < count; g++) {
    struct scene_group *group = &scene->group.item[g];
    if (material[g] == SCENE_NONE || group->has_colour)
      continue;
    group->colour = reader->palette.group.item[material[g]].colour;
    group->has_colour = reader->palette.group.item[material[g]].has_colour;
  }
}

recto_status materials_colour(const struct materials *materials,
                              struct scene *scene, const char *path,
                              struct diagnostics *diagnostics,
                              recto_error *error) {
  struct library_reader reader = {.scene = scene,
                                  .model = path,
                                  .diagnostics = diagnostics,
                                  .error = error};
  size_t count = materials->use.count;
  scene_init(&reader.palette);
  uint32_t *material = mem_alloc(count, sizeof *material);
  recto_status status = material != NULL ? RECTO_OK : error_memory(error);
  if (status == RECTO_OK)
    status = read_all_libraries(&reader, materials);
  if (status == RECTO_OK)
    status = find_group_materials(&reader, materials, material);
  if (status == RECTO_OK)
    colour_groups(scene, &reader, material, count);
  mem_free(material);
  scene_fini(&reader.palette);
  return status;
}
