/* importer.c - the program that reads a model through Assimp for the library,
 * in a process of its own with limits of time and memory, so that a broken file
 * cannot crash or block the caller.
 *
 *   recto-import SECONDS MB FORMAT [PATH]
 *
 * Without a path it reads standard input.  It writes to descriptor 3 what
 * scene/readers/import_format.h describes.
 *
 * The file is imported as it is, without any of Assimp's own improvements:
 * polygons stay polygons.  The tree of nodes is traversed with an explicit
 * stack, and each node's meshes are moved to where the node's transformations
 * put them. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* closefrom */
#endif
#include <assimp/cimport.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef __linux__
#include <signal.h>
#include <sys/prctl.h>
#endif

#include "base/child.h"
#include "base/input.h"
#include "base/sanitizer.h"
#include "import/model_3mf.h"
#include "import/opened_files.h"
#include "scene/readers/import_format.h"

/* From a node's own coordinates to the scene's: rows of a 3 x 4 matrix. */
struct transform {
  double row[3][4];
};

struct visit {
  const struct aiNode *node;
  struct transform parent;
};

/* Room for the names of a node and a mesh, and what stands between them. */
struct name {
  char text[sizeof(struct aiString) * 2];
};

struct import {
  FILE *to;
  const struct aiScene *from;
  bool is_3mf;
  struct model_3mf model_3mf; /* of other formats all zeros */
  double unit_mm;             /* of the model's unit; 0: unknown */
  ARRAY(struct visit) stack;
};

/* ---- Writing ------------------------------------------------------------- */

/* Ends the process where the reader is gone: there is nothing left to do. */
static void write_bytes(FILE *to, const void *bytes, size_t count) {
  if (count > 0 && fwrite(bytes, count, 1, to) != 1)
    _exit(1);
}

/* Ends the process, and so frees what Assimp holds.
 * unit_mm  of the model's unit; 0: unknown */
static _Noreturn void finish(FILE *to, double unit_mm) {
  struct import_record record = {.kind = IMPORT_DONE, .unit_mm = unit_mm};
  write_bytes(to, &record, sizeof record);
  _exit(fflush(to) != 0);
}

static _Noreturn void exit_with(FILE *to, enum import_why why,
                                const char *text) {
  struct import_record record = {
      .kind = IMPORT_FAILED, .why = why, .name_length = strlen(text)};
  write_bytes(to, &record, sizeof record);
  write_bytes(to, text, strlen(text));
  finish(to, 0);
}

/* ---- Errors -------------------------------------------------------------- */

/* What Assimp reports while it reads on: it leaves out elements that it cannot
 * read, such as faces of OFF files with more than nine corners. */
enum { ERRORS_MAX = 64, ERROR_LENGTH_MAX = 200 };

struct error_log {
  unsigned count;
  char text[ERRORS_MAX][ERROR_LENGTH_MAX];
};

/* Keeps a line of Assimp's log, "Error, T0: TEXT", if it is an error. */
static void keep_error(const char *line, char *user) {
  struct error_log *log = (struct error_log *)(void *)user;
  const char *text = strstr(line, ": ");
  if (strncmp(line, "Error,", 6) == 0 && text != NULL &&
      log->count < ERRORS_MAX)
    (void)snprintf(log->text[log->count++], ERROR_LENGTH_MAX, "%.*s",
                   (int)strcspn(text + 2, "\n"), text + 2);
}

static void put_errors(FILE *to, const struct error_log *log) {
  for (unsigned i = 0; i < log->count; i++) {
    struct import_record record = {.kind = IMPORT_ERROR,
                                   .name_length = strlen(log->text[i])};
    write_bytes(to, &record, sizeof record);
    write_bytes(to, log->text[i], (size_t)record.name_length);
  }
}

/* ---- Meshes -------------------------------------------------------------- */

static struct transform compose_transforms(const struct transform *parent,
                                           const struct aiMatrix4x4 *own) {
  const double rows[3][4] = {{own->a1, own->a2, own->a3, own->a4},
                             {own->b1, own->b2, own->b3, own->b4},
                             {own->c1, own->c2, own->c3, own->c4}};
  struct transform transform;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 4; j++) {
      double sum = j == 3 ? parent->row[i][3] : 0;
      for (int k = 0; k < 3; k++)
        sum += parent->row[i][k] * rows[k][j];
      transform.row[i][j] = sum;
    }
  return transform;
}

/* The diffuse colour of the mesh's material, if it has one. */
static void find_colour(const struct import *import, const struct aiMesh *mesh,
                        struct import_record *record) {
  struct aiColor4D colour;
  if (mesh->mMaterialIndex >= import->from->mNumMaterials ||
      aiGetMaterialColor(import->from->mMaterials[mesh->mMaterialIndex],
                         AI_MATKEY_COLOR_DIFFUSE, &colour) != aiReturn_SUCCESS)
    return;
  const double part[3] = {colour.r, colour.g, colour.b};
  record->has_colour = 1;
  for (int k = 0; k < 3; k++)
    record->colour =
        record->colour << 8 | (uint32_t)(fmin(fmax(part[k], 0), 1) * 255 + 0.5);
}

static void put_points(FILE *to, const struct aiMesh *mesh,
                       const struct transform *transform) {
  for (unsigned i = 0; i < mesh->mNumVertices; i++) {
    const struct aiVector3D *v = &mesh->mVertices[i];
    double at[3];
    for (int k = 0; k < 3; k++) {
      const double *row = transform->row[k];
      at[k] = row[0] * v->x + row[1] * v->y + row[2] * v->z + row[3];
    }
    write_bytes(to, at, sizeof at);
  }
}

/* Writes the normals of a mesh, turned as its planes are: by the matrix of the
 * cofactors, which is the inverse transposed but for the determinant. */
static void put_normals(FILE *to, const struct aiMesh *mesh,
                        const struct transform *transform) {
  double cofactor[3][3];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      const double *a = transform->row[(i + 1) % 3];
      const double *b = transform->row[(i + 2) % 3];
      cofactor[i][j] =
          a[(j + 1) % 3] * b[(j + 2) % 3] - a[(j + 2) % 3] * b[(j + 1) % 3];
    }
  double determinant = 0;
  for (int k = 0; k < 3; k++)
    determinant += transform->row[0][k] * cofactor[0][k];
  for (unsigned i = 0; i < mesh->mNumVertices; i++) {
    const struct aiVector3D *n = &mesh->mNormals[i];
    float turned[3];
    for (int k = 0; k < 3; k++) {
      double along =
          cofactor[k][0] * n->x + cofactor[k][1] * n->y + cofactor[k][2] * n->z;
      turned[k] = (float)(determinant < 0 ? -along : along);
    }
    write_bytes(to, turned, sizeof turned);
  }
}

/* The id of the object of a 3MF model that Assimp calls Object_ID, and its mesh
 * ID; 0 where it is none. */
static uint32_t object_of(const struct aiNode *node,
                          const struct aiMesh *mesh) {
  static const char prefix[] = "Object_";
  const char *id = node->mName.data + sizeof prefix - 1;
  if (strncmp(node->mName.data, prefix, sizeof prefix - 1) != 0 ||
      strcmp(mesh->mName.data, id) != 0)
    return 0;
  return (uint32_t)strtoul(id, NULL, 10);
}

/* Writes the name of a mesh's group: that of its object, or that of its node,
 * and of the mesh itself where that has another name. */
static const char *name_group(const struct import *import,
                              const struct aiNode *node,
                              const struct aiMesh *mesh, struct name *name) {
  const char *first = node->mName.data, *second = mesh->mName.data;
  uint32_t object = import->is_3mf ? object_of(node, mesh) : 0;
  const char *own = model_3mf_name(&import->model_3mf, object);
  if (own != NULL)
    return own;
  bool both = *first && *second && strcmp(first, second) != 0 && object == 0;
  (void)snprintf(name->text, sizeof name->text, "%s%s%s",
                 *first ? first : second, both ? "/" : "", both ? second : "");
  return name->text;
}

static void put_mesh(struct import *import, const struct aiNode *node,
                     const struct aiMesh *mesh,
                     const struct transform *transform) {
  struct name own;
  const char *name = name_group(import, node, mesh, &own);
  struct import_record record = {
      .kind = IMPORT_MESH,
      .name_length = strlen(name),
      .points = mesh->mNumVertices,
      .normals = mesh->mNormals != NULL ? mesh->mNumVertices : 0,
      .elements = mesh->mNumFaces};
  find_colour(import, mesh, &record);
  for (unsigned i = 0; i < mesh->mNumFaces; i++)
    record.corners += mesh->mFaces[i].mNumIndices;
  write_bytes(import->to, &record, sizeof record);
  write_bytes(import->to, name, (size_t)record.name_length);
  put_points(import->to, mesh, transform);
  if (mesh->mNormals != NULL)
    put_normals(import->to, mesh, transform);
  for (unsigned i = 0; i < mesh->mNumFaces; i++) {
    uint32_t count = mesh->mFaces[i].mNumIndices;
    write_bytes(import->to, &count, sizeof count);
  }
  for (unsigned i = 0; i < mesh->mNumFaces; i++)
    write_bytes(import->to, mesh->mFaces[i].mIndices,
                mesh->mFaces[i].mNumIndices * sizeof *mesh->mFaces[i].mIndices);
}

/* ---- Nodes --------------------------------------------------------------- */

static void push(struct import *import, struct visit visit) {
  if (!ARRAY_PUSH(&import->stack, visit))
    exit_with(import->to, IMPORT_NO_MEMORY, "");
}

/* Traverses the tree, each node before its children, these in their order. */
static void put_nodes(struct import *import) {
  push(import, (struct visit){import->from->mRootNode,
                              {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}});
  while (import->stack.count > 0) {
    struct visit visit = import->stack.item[--import->stack.count];
    const struct aiNode *node = visit.node;
    visit.parent = compose_transforms(&visit.parent, &node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; i++)
      if (node->mMeshes[i] < import->from->mNumMeshes)
        put_mesh(import, node, import->from->mMeshes[node->mMeshes[i]],
                 &visit.parent);
    for (unsigned i = node->mNumChildren; i > 0; i--) {
      visit.node = node->mChildren[i - 1];
      push(import, visit);
    }
  }
}

/* ---- The program --------------------------------------------------------- */

static void set_limit(int which, rlim_t most) {
  struct rlimit limit;
  if (getrlimit((__rlimit_resource_t)which, &limit) != 0)
    return;
  if (limit.rlim_max == RLIM_INFINITY || most < limit.rlim_max)
    limit.rlim_max = most;
  limit.rlim_cur = limit.rlim_max;
  (void)setrlimit((__rlimit_resource_t)which, &limit);
}

/* Limits core dumps, processor time and memory, and ends the process with its
 * parent. */
static void limit_self(long seconds, long mb) {
#ifdef __linux__
  (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
#ifdef HAVE_CLOSEFROM
  closefrom(CHILD_OUTPUT + 1);
#endif
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_CPU, (rlim_t)seconds + 1);
#if !SANITIZER_OF_ADDRESSES /* it reserves more addresses than that */
  set_limit(RLIMIT_AS, (rlim_t)mb << 20);
#endif
}

/* The name that Assimp gives to a file in memory, also in its messages: see
 * assimp/MemoryIOWrapper.h, which is C++. */
#define ASSIMP_MEMORY_NAME "$$$___magic___$$$"

/* Writes which files Assimp opened. */
static void put_files(FILE *to, const struct opened_files *files) {
  size_t bytes = files->file.count * sizeof *files->file.item;
  struct import_record record = {.kind = IMPORT_FILES, .name_length = bytes};
  if (files->no_memory)
    exit_with(to, IMPORT_NO_MEMORY, "");
  write_bytes(to, &record, sizeof record);
  write_bytes(to, files->file.item, bytes);
}

static const struct aiScene *import_path(FILE *to, const char *path) {
  struct opened_files files;
  opened_files_init(&files);
  const struct aiScene *scene = aiImportFileEx(path, 0, &files.io);
  put_files(to, &files);
  return scene;
}

/* What a unit of Assimp's coordinates is, in mm; 0: unknown.  It converts those
 * of Collada to metres. */
static double unit_of_format(const char *format) {
  static const char *const in_metres[] = {"gltf", "glb", "dae"};
  for (size_t i = 0; i < sizeof in_metres / sizeof *in_metres; i++)
    if (strcasecmp(format, in_metres[i]) == 0)
      return 1000;
  return 0;
}

/* Reads what Assimp leaves out of a 3MF model, after Assimp, which refuses what
 * is too large. */
static void read_3mf(struct import *import, const struct input *input) {
  model_3mf_read(&import->model_3mf, input->bytes, input->count);
  if (import->model_3mf.no_memory)
    exit_with(import->to, IMPORT_NO_MEMORY, "");
  import->unit_mm = import->model_3mf.unit_mm;
}

static void import_file(struct import *import, const char *format,
                        const char *path) {
  struct input input;
  import->is_3mf = strcasecmp(format, "3mf") == 0;
  import->unit_mm = unit_of_format(format);
  if (path != NULL && !import->is_3mf) {
    import->from = import_path(import->to, path);
    return;
  }
  recto_status status = input_load(&input, path != NULL ? path : "-", NULL);
  if (status == RECTO_ERROR_MEMORY)
    exit_with(import->to, IMPORT_NO_MEMORY, "");
  if (status != RECTO_OK || input.count > UINT32_MAX)
    exit_with(import->to, IMPORT_BROKEN, "too large");
  import->from = path != NULL
                     ? import_path(import->to, path)
                     : aiImportFileFromMemory(input.bytes,
                                              (unsigned)input.count, 0, format);
  if (import->is_3mf && import->from != NULL)
    read_3mf(import, &input);
}

static bool is_supported(const char *format) {
  char extension[32];
  int length = snprintf(extension, sizeof extension, ".%s", format);
  return length > 1 && (size_t)length < sizeof extension &&
         aiIsExtensionSupported(extension);
}

int main(int argc, char **argv) {
  if (argc != 4 && argc != 5) {
    fputs("recto-import: runs for recto alone\n", stderr);
    return 2;
  }
  limit_self(strtol(argv[1], NULL, 10), strtol(argv[2], NULL, 10));
  struct import import = {.to = fdopen(CHILD_OUTPUT, "wb")};
  if (import.to == NULL)
    return 2;
  static struct error_log errors;
  const struct aiLogStream stream = {keep_error, (char *)(void *)&errors};
  aiAttachLogStream(&stream);
  write_bytes(import.to, IMPORT_MAGIC, sizeof IMPORT_MAGIC - 1);
  if (!is_supported(argv[3]))
    exit_with(import.to, IMPORT_UNKNOWN_FORMAT, "");
  import_file(&import, argv[3], argc == 5 ? argv[4] : NULL);
  const char *text = import.from != NULL ? "nothing in it" : aiGetErrorString();
  if (strstr(text, "bad_alloc") != NULL)
    exit_with(import.to, IMPORT_NO_MEMORY, "");
  if (strstr(text, ASSIMP_MEMORY_NAME) != NULL)
    text = "nothing of this format is in it";
  if (import.from == NULL || import.from->mRootNode == NULL)
    exit_with(import.to, IMPORT_BROKEN, text);
  put_errors(import.to, &errors);
  put_nodes(&import);
  finish(import.to, import.unit_mm);
}
