/* obj_blocks.h - an OBJ file that is handed to its parser block by block. */
#ifndef SCENE_OBJ_OBJ_BLOCKS_H
#define SCENE_OBJ_OBJ_BLOCKS_H

#include "base/line_blocks.h"
#include "scene/obj/obj_parser.h"

/* Zero-initialised has no file. */
struct obj_blocks {
  struct line_blocks lines;
};

/* How many bytes of a block are read at once. */
enum { OBJ_BLOCK_BYTES = 1 << 18 };

/* Hands the current block to the parser.
 * Errors  as of obj_parser_open */
USE_RESULT recto_status obj_blocks_enter(const struct obj_blocks *blocks,
                                         struct obj_parser *p);

/* Reads the points of all blocks after the current one, which stays. */
USE_RESULT recto_status obj_blocks_read_points_behind(
    const struct obj_blocks *blocks, struct obj_parser *p);

/* Reads a file that was opened, as the reader of OBJ does with one in memory.
 * Errors  as of scene_read */
USE_RESULT recto_status obj_blocks_read(struct obj_blocks *blocks,
                                        struct scene *scene, const char *path,
                                        struct diagnostics *diagnostics,
                                        recto_error *error);

void obj_blocks_close(struct obj_blocks *blocks);

#endif
