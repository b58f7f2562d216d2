/* read_passes.c - an OBJ file that is read in passes.
 *
 * A face may name a point that comes after it, so all points are read first;
 * the passes over faces then begin at the block with the first statement that
 * is none of a point.  It is the same parser that reads a file at once: between
 * two blocks it is handed the next one.
 *
 * Performance  Where a block has nothing but plain triangles, the pass over the
 * points holds their corners, and the passes over faces take these: of all
 * blocks up to 32 MB. */
#include "scene/read_passes.h"

#include <string.h>

#include "base/poll.h"
#include "scene/obj/obj_blocks.h"
#include "scene/read.h"

enum { BLOCK_BYTES = 1 << 20 };

/* A block of triangles that are held, by place in the file. */
struct held_block {
  off_t begin, end;
  size_t first, past; /* in parser.held */
};

struct read_passes {
  struct obj_blocks blocks;
  struct obj_parser parser;
  const char *path;
  struct diagnostics *diagnostics;
  struct diagnostics silent; /* of the passes after the first */
  bool knows_faces;          /* they have been read once */
  /* Where the first block begins that has anything but points. */
  off_t faces_at;
  unsigned long faces_line;
  size_t faces_seen, faces_normals_seen;
  ARRAY(struct held_block) held;
  size_t next_held;
};

recto_status read_passes_open(struct read_passes **passes, const char *path,
                              const char *format, size_t least,
                              recto_error *error) {
  struct line_blocks blocks;
  *passes = NULL;
  if (read_find(path, format) != &reader_obj ||
      !line_blocks_open(&blocks, path, least > 0 ? least : BLOCK_BYTES))
    return RECTO_OK;
  *passes = mem_calloc(1, sizeof **passes);
  if (*passes == NULL) {
    line_blocks_close(&blocks);
    return error_memory(error);
  }
  (*passes)->blocks.lines = blocks;
  (*passes)->path = path;
  return RECTO_OK;
}

struct file_identity read_passes_file(const struct read_passes *passes) {
  return passes->blocks.lines.file;
}

/* ---- Points -------------------------------------------------------------- */

/* Holds the block's triangles if it has nothing else. */
static recto_status hold_block(struct read_passes *passes, size_t first) {
  struct obj_parser *p = &passes->parser;
  const struct line_blocks *blocks = &passes->blocks.lines;
  if (p->plain_bytes != blocks->count) {
    p->held.count = first;
    return RECTO_OK;
  }
  return p->held.count == first ||
                 ARRAY_PUSH(&passes->held,
                            ((struct held_block){blocks->begin, blocks->end,
                                                 first, p->held.count}))
             ? RECTO_OK
             : error_memory(p->error);
}

static recto_status read_point_blocks(struct read_passes *passes,
                                      recto_error *error) {
  struct obj_parser *p = &passes->parser;
  for (;;) {
    recto_status status = line_blocks_next(&passes->blocks.lines, error);
    if (status == RECTO_OK && passes->blocks.lines.size == 0)
      status = error_set(error, RECTO_ERROR_FORMAT, passes->path, 1,
                         "the file is empty");
    if (status != RECTO_OK || passes->blocks.lines.count == 0)
      return status;
    if (!p->others) {
      passes->faces_at = passes->blocks.lines.begin;
      passes->faces_line = p->line;
      passes->faces_seen = p->seen;
      passes->faces_normals_seen = p->normals_seen;
    }
    size_t held = p->held.count;
    p->plain_bytes = 0;
    status = obj_blocks_enter(&passes->blocks, p);
    if (status == RECTO_OK)
      status = obj_read_statements(p, true);
    if (status == RECTO_OK)
      status = hold_block(passes, held);
    if (status != RECTO_OK)
      return status;
  }
}

recto_status read_passes_points(struct read_passes *passes, struct scene *scene,
                                struct diagnostics *diagnostics,
                                recto_error *error) {
  struct obj_parser *p = &passes->parser;
  passes->diagnostics = diagnostics;
  obj_parser_begin(p, scene, passes->path, diagnostics, error);
  p->marks = p->holds = true;
  scene->is_read_in_passes = true;
  if (!ARRAY_PUSH(&scene->file, passes->blocks.lines.file))
    return error_memory(error);
  memcpy(scene->up, reader_obj.up, sizeof scene->up);
  read_begin_file(scene, passes->path);
  line_blocks_seek(&passes->blocks.lines, 0);
  recto_status status = read_point_blocks(passes, error);
  return status == RECTO_OK ? obj_finish_points(p) : status;
}

void read_passes_guess_used(const struct read_passes *passes, uint8_t *used) {
  const struct obj_parser *p = &passes->parser;
  for (size_t i = 0; i < p->scene->point.count; i++)
    used[i] = p->mark_failed || (i < p->mark.count && p->mark.item[i] != 0);
}

/* ---- Faces --------------------------------------------------------------- */

static void begin_faces(struct read_passes *passes, recto_error *error) {
  struct obj_parser *p = &passes->parser;
  p->ahead = true;
  p->seen = passes->faces_seen;
  p->normals_seen = passes->faces_normals_seen;
  p->line = passes->faces_line;
  p->renamed = true;
  p->error = error;
  memset(p->name, 0, sizeof p->name);
  p->diagnostics = passes->knows_faces ? &passes->silent : passes->diagnostics;
  passes->silent = (struct diagnostics){.file = passes->path};
  passes->next_held = 0;
  line_blocks_seek(&passes->blocks.lines, passes->faces_at);
}

/* Reads the faces of the next block; *count: of so many bytes. */
static recto_status read_block(struct read_passes *passes, size_t *count,
                               recto_error *error) {
  struct obj_parser *p = &passes->parser;
  const struct held_block *held = passes->held.item + passes->next_held;
  if (passes->next_held < passes->held.count &&
      held->begin == passes->blocks.lines.end) {
    passes->next_held++;
    line_blocks_seek(&passes->blocks.lines, held->end);
    *count = (size_t)(held->end - held->begin);
    return poll_now() ? obj_add_triangles(p, p->held.item + held->first,
                                          (held->past - held->first) / 3)
                      : error_cancelled(error);
  }
  recto_status status = line_blocks_next(&passes->blocks.lines, error);
  *count = passes->blocks.lines.count;
  if (status == RECTO_OK && *count > 0)
    status = obj_blocks_enter(&passes->blocks, p);
  return status == RECTO_OK && *count > 0 ? obj_read_statements(p, false)
                                          : status;
}

recto_status read_passes_faces(struct read_passes *passes,
                               read_passes_take *take, void *user,
                               recto_error *error) {
  struct obj_parser *p = &passes->parser;
  recto_status status = RECTO_OK;
  ARRAY_FREE(&p->mark);
  begin_faces(passes, error);
  while (status == RECTO_OK) {
    size_t count;
    status = read_block(passes, &count, error);
    if (status == RECTO_OK && count == 0)
      break;
    if (status == RECTO_OK)
      status = take(user, p->scene, error);
    scene_drop_elements(p->scene);
    if (status == RECTO_OK)
      status = obj_keep_names(p);
  }
  if (status == RECTO_OK && !passes->knows_faces) {
    passes->knows_faces = true;
    status = obj_finish(p);
    diagnostics_finish(passes->diagnostics);
  }
  return status;
}

void read_passes_close(struct read_passes *passes) {
  if (passes == NULL)
    return;
  obj_blocks_close(&passes->blocks);
  obj_parser_fini(&passes->parser);
  ARRAY_FREE(&passes->held);
  mem_free(passes);
}
