/* obj_blocks.c - an OBJ file that is handed to its parser block by block.
 *
 * The memory of a block is used again for the next one: the system need not
 * clear as many pages as the file has, and what is parsed is still in the
 * cache from being read (doc/decisions/0091). */
#include "scene/obj/obj_blocks.h"

#include "scene/diagnostics.h"
#include "scene/obj/obj_short_runs.h"

/* Hands a block to the parser. */
static recto_status enter_lines(const struct line_blocks *lines,
                                struct obj_parser *p) {
  struct diagnostics *diagnostics = p->diagnostics;
  if (diagnostics != NULL) {
    diagnostics->bytes = diagnostics->poll_at = lines->bytes;
    diagnostics->bytes_before = (size_t)lines->begin;
    diagnostics->byte_count = (size_t)lines->size;
  }
  if (lines->begin == 0)
    return obj_parser_open(p, lines->bytes, lines->count);
  p->at = p->run_end = p->next_v = lines->bytes;
  p->end = lines->bytes + lines->count;
  return RECTO_OK;
}

recto_status obj_blocks_enter(const struct obj_blocks *blocks,
                              struct obj_parser *p) {
  return enter_lines(&blocks->lines, p);
}

recto_status obj_blocks_read_points_behind(const struct obj_blocks *blocks,
                                           struct obj_parser *p) {
  struct line_blocks behind, *lines = p->lines;
  recto_status status = RECTO_OK;
  line_blocks_share(&behind, &blocks->lines);
  p->lines = &behind;
  while (status == RECTO_OK) {
    status = line_blocks_next(&behind, p->error);
    if (status != RECTO_OK || behind.count == 0)
      break;
    status = enter_lines(&behind, p);
    if (status == RECTO_OK)
      status = obj_read_statements(p, true);
  }
  line_blocks_close(&behind);
  p->lines = lines;
  if (status == RECTO_OK)
    status = enter_lines(&blocks->lines, p);
  return status;
}

recto_status obj_blocks_read(struct obj_blocks *blocks, struct scene *scene,
                             const char *path, struct diagnostics *diagnostics,
                             recto_error *error) {
  struct obj_parser p;
  recto_status status = RECTO_OK;
  obj_parser_begin(&p, scene, path, diagnostics, error);
  p.blocks = blocks;
  p.lines = &blocks->lines;
  while (status == RECTO_OK) {
    status = line_blocks_next(&blocks->lines, error);
    if (status != RECTO_OK || blocks->lines.count == 0)
      break;
    status = obj_blocks_enter(blocks, &p);
    if (status == RECTO_OK)
      status = obj_read_short_runs(&p);
    if (status == RECTO_OK)
      status = obj_read_statements(&p, false);
    if (status == RECTO_OK)
      status = obj_keep_names(&p);
  }
  if (status == RECTO_OK)
    status = obj_finish_points(&p);
  if (status == RECTO_OK)
    status = obj_finish(&p);
  obj_parser_fini(&p);
  return status;
}

void obj_blocks_close(struct obj_blocks *blocks) {
  line_blocks_close(&blocks->lines);
}
