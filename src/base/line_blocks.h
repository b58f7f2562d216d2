/* line_blocks.h - a text file read in blocks of whole lines, as often as it is
 * wanted, so that it is never in memory as a whole. */
#ifndef BASE_LINE_BLOCKS_H
#define BASE_LINE_BLOCKS_H

#include <sys/types.h>
#include <time.h>

#include "base/memory.h"
#include "base/path.h"
#include "base/status.h"

/* Zero-initialised is closed. */
struct line_blocks {
  const char *bytes; /* the block; eight NULs stand behind its last byte */
  size_t count;
  off_t begin, end; /* where it lies in the file */
  off_t size;       /* of the file */
  struct file_identity file;
  bool is_read_once; /* so that it may be changed after it was read */
  /* private */
  bool is_open;
  bool is_shared; /* the descriptor is another one's */
  int descriptor;
  const char *path;
  struct timespec modified;
  size_t least; /* bytes that a block has */
  struct byte_array buffer;
};

/* Opens a file, before its first block.
 * path    must outlive the blocks
 * least   how many bytes a block has, before it ends with its last line
 * Returns false where the file cannot be read so: it cannot be opened, is no
 * regular file, is standard input ("-"), or compressed with gzip. */
USE_RESULT bool line_blocks_open(struct line_blocks *blocks, const char *path,
                                 size_t least);

/* Goes to a place in the file: where a block began or ended. */
void line_blocks_seek(struct line_blocks *blocks, off_t place);

/* Reads the block that follows; at the end of the file it is empty.  It ends
 * with a line that no backslash continues, or with the file.
 * Errors  RECTO_ERROR_IO, also where the file is cut short in the meantime or,
 *         unless it is read once, changed; RECTO_ERROR_LIMIT: a line is too
 *         long; RECTO_ERROR_MEMORY, _CANCELLED */
USE_RESULT recto_status line_blocks_next(struct line_blocks *blocks,
                                         recto_error *error);

/* Copies up to `count` bytes of the file from a place on; the blocks stay where
 * they are.  Returns how many there are, fewer also where they cannot be read.
 * Threads  may be called from several at once */
size_t line_blocks_copy(const struct line_blocks *blocks, off_t place, char *to,
                        size_t count);

/* Makes `second` blocks of the same file, which are to be closed first. */
void line_blocks_share(struct line_blocks *second,
                       const struct line_blocks *blocks);

void line_blocks_close(struct line_blocks *blocks);

#endif
