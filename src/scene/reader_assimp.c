/* reader_assimp.c - every other format, through Assimp's C interface.
 *
 * The file is imported as it is, without any of Assimp's own improvements:
 * polygons stay polygons.  The tree of nodes is walked with a stack of our
 * own, and each node's meshes become a group, moved to where the node's
 * transformations put them.  Faces of two corners become polylines.
 *
 * Robustness: Assimp's numbers are single precision, so this is not the way
 * for OBJ or STL.  It allocates by itself; running out of memory there ends
 * as a broken file.
 */
#include "scene/scene.h"

#include <assimp/cimport.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "scene/limit.h"

/* From a node's own coordinates to the scene's: rows of a 3 x 4 matrix. */
struct placement {
  double row[3][4];
};

struct visit {
  const struct aiNode *node;
  struct placement parent;
};

struct import {
  struct scene *scene;
  const struct aiScene *from;
  ARRAY(struct visit) stack;
  ARRAY(uint32_t) corner;
  ARRAY(bool) bad; /* one for each point of the mesh: not finite */
  struct diagnostics *diagnostics;
  recto_error *error;
};

static struct placement place_node(const struct placement *parent,
                                   const struct aiMatrix4x4 *own) {
  const double rows[3][4] = {{own->a1, own->a2, own->a3, own->a4},
                             {own->b1, own->b2, own->b3, own->b4},
                             {own->c1, own->c2, own->c3, own->c4}};
  struct placement placed;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 4; j++) {
      double sum = j == 3 ? parent->row[i][3] : 0;
      for (int k = 0; k < 3; k++)
        sum += parent->row[i][k] * rows[k][j];
      placed.row[i][j] = sum;
    }
  return placed;
}

/* ---- Meshes -------------------------------------------------------------- */

/* The group of a mesh is named by its node, and by the mesh itself where that
 * has another name. */
static recto_status use_group(struct import *import, const struct aiNode *node,
                              const struct aiMesh *mesh) {
  char name[2 * sizeof node->mName.data + 2];
  const char *first = node->mName.data, *second = mesh->mName.data;
  bool both = *first && *second && strcmp(first, second) != 0;
  int length = snprintf(name, sizeof name, "%s%s%s", *first ? first : second,
                        both ? "/" : "", both ? second : "");
  recto_status status = scene_use_group(
      import->scene, name, length > 0 ? (size_t)length : 0, import->error);
  if (status != RECTO_OK || mesh->mMaterialIndex >= import->from->mNumMaterials)
    return status;
  struct aiColor4D colour;
  struct scene_group *group =
      &import->scene->group.item[import->scene->current_group];
  if (aiGetMaterialColor(import->from->mMaterials[mesh->mMaterialIndex],
                         AI_MATKEY_COLOR_DIFFUSE,
                         &colour) == aiReturn_SUCCESS) {
    const double part[3] = {colour.r, colour.g, colour.b};
    group->colour = 0;
    group->has_colour = true;
    for (int k = 0; k < 3; k++)
      group->colour = group->colour << 8 |
                      (uint32_t)(fmin(fmax(part[k], 0), 1) * 255 + 0.5);
  }
  return RECTO_OK;
}

/* Points that are not finite get the position of another point, so that the
 * scene grows no larger by them. */
static void place_bad_points(struct import *import, size_t first) {
  struct scene_point *point = import->scene->point.item;
  size_t good = 0;
  while (good < import->bad.count && import->bad.item[good])
    good++;
  struct scene_point other = {0, 0, 0};
  if (good < import->bad.count)
    other = point[first + good];
  else if (first > 0)
    other = point[0];
  for (size_t i = 0; i < import->bad.count; i++)
    if (import->bad.item[i])
      point[first + i] = other;
}

static recto_status add_points(struct import *import, const struct aiMesh *mesh,
                               const struct placement *placed) {
  struct scene *scene = import->scene;
  size_t count = mesh->mNumVertices, first = scene->point.count;
  if (count > SCENE_LIMIT - first)
    return error_set(import->error, RECTO_ERROR_LIMIT, NULL, 0,
                     "the scene has more than 2^31 points");
  import->bad.count = 0;
  if (!ARRAY_RESERVE(&scene->point, count) ||
      !ARRAY_RESERVE(&import->bad, count))
    return error_memory(import->error);
  for (size_t i = 0; i < count; i++) {
    const struct aiVector3D *v = &mesh->mVertices[i];
    double at[3];
    for (int k = 0; k < 3; k++) {
      const double *row = placed->row[k];
      at[k] = row[0] * v->x + row[1] * v->y + row[2] * v->z + row[3];
    }
    bool bad = !isfinite(at[0]) || !isfinite(at[1]) || !isfinite(at[2]);
    if (bad)
      diagnostics_fault(import->diagnostics, SCENE_FAULT_NOT_FINITE, 0,
                        "point that is not finite; its faces are skipped");
    import->bad.item[import->bad.count++] = bad;
    scene->point.item[scene->point.count++] =
        (struct scene_point){at[0], at[1], at[2]};
  }
  place_bad_points(import, first);
  return RECTO_OK;
}

/* Adds face `number` of a mesh whose points start at `first`. */
static recto_status add_element(struct import *import,
                                const struct aiMesh *mesh, unsigned number,
                                size_t first) {
  const struct aiFace *face = &mesh->mFaces[number];
  size_t count = face->mNumIndices;
  if (count < 2)
    return RECTO_OK;
  import->corner.count = 0;
  if (!ARRAY_RESERVE(&import->corner, count))
    return error_memory(import->error);
  for (size_t i = 0; i < count; i++) {
    unsigned index = face->mIndices[i];
    bool there = index < mesh->mNumVertices;
    if (there && import->bad.item[index]) {
      diagnostics_fault(import->diagnostics, SCENE_FAULT_NOT_FINITE, 0,
                        "face with a point that is not finite, skipped");
      return RECTO_OK;
    }
    import->corner.item[import->corner.count++] =
        there ? (uint32_t)(first + index) : SCENE_NONE;
  }
  if (count == 2)
    return scene_add_wire(import->scene, import->corner.item, count, 0,
                          import->diagnostics, import->error);
  return scene_add_face(import->scene, import->corner.item, count, 0,
                        import->diagnostics, import->error);
}

static recto_status add_mesh(struct import *import, const struct aiNode *node,
                             const struct aiMesh *mesh,
                             const struct placement *placed) {
  size_t first = import->scene->point.count;
  recto_status status = use_group(import, node, mesh);
  if (status == RECTO_OK)
    status = add_points(import, mesh, placed);
  for (unsigned i = 0; i < mesh->mNumFaces && status == RECTO_OK; i++)
    status = add_element(import, mesh, i, first);
  return status;
}

/* ---- Nodes --------------------------------------------------------------- */

/* Walks the tree, each node before its children and those in their order. */
static recto_status add_nodes(struct import *import) {
  struct visit root = {import->from->mRootNode,
                       {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}};
  if (!ARRAY_PUSH(&import->stack, root))
    return error_memory(import->error);
  recto_status status = RECTO_OK;
  while (import->stack.count > 0 && status == RECTO_OK) {
    struct visit visit = import->stack.item[--import->stack.count];
    const struct aiNode *node = visit.node;
    visit.parent = place_node(&visit.parent, &node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes && status == RECTO_OK; i++)
      status = add_mesh(import, node, import->from->mMeshes[node->mMeshes[i]],
                        &visit.parent);
    for (unsigned i = node->mNumChildren; i > 0 && status == RECTO_OK; i--) {
      visit.node = node->mChildren[i - 1];
      if (!ARRAY_PUSH(&import->stack, visit))
        status = error_memory(import->error);
    }
  }
  return status;
}

/* A file that keeps its extension is opened by its path, since formats such
 * as glTF have their data in other files beside it. */
static const struct aiScene *import_file(const char *bytes, size_t count,
                                         const char *path, const char *format) {
  const char *point = strrchr(path, '.');
  if (point && strcasecmp(point + 1, format) == 0)
    return aiImportFile(path, 0);
  if (count > UINT32_MAX)
    return NULL;
  return aiImportFileFromMemory(bytes, (unsigned)count, 0, format);
}

static bool is_supported(const char *format) {
  char extension[32];
  int length = snprintf(extension, sizeof extension, ".%s", format);
  return length > 1 && (size_t)length < sizeof extension &&
         aiIsExtensionSupported(extension);
}

static recto_status read_assimp(struct scene *scene, const char *bytes,
                                size_t count, const char *path,
                                const char *format,
                                struct diagnostics *diagnostics,
                                recto_error *error) {
  if (!is_supported(format))
    return error_set(error, RECTO_ERROR_UNSUPPORTED, path, 0,
                     "no reader for the format '%s'", format);
  const struct aiScene *from = import_file(bytes, count, path, format);
  if (!from || !from->mRootNode) {
    recto_status status =
        error_set(error, RECTO_ERROR_FORMAT, path, 0, "%s",
                  from ? "nothing in it" : aiGetErrorString());
    aiReleaseImport(from);
    return status;
  }
  struct import import = {
      .scene = scene, .from = from, .diagnostics = diagnostics, .error = error};
  size_t first = scene->point.count;
  recto_status status = add_nodes(&import);
  if (status == RECTO_OK)
    status = scene_state_precision(
        scene, first, (struct precision){0, PRECISION_SINGLE}, error);
  ARRAY_FREE(&import.stack);
  ARRAY_FREE(&import.corner);
  ARRAY_FREE(&import.bad);
  aiReleaseImport(from);
  return status;
}

const struct reader reader_assimp = {"assimp", "", {0, 1, 0}, read_assimp};
