/* file_reader.h - a file of which pieces are read, at any place. */
#ifndef BASE_FILE_READER_H
#define BASE_FILE_READER_H

#include <stddef.h>
#include <stdint.h>

#include "base/path.h"
#include "base/status.h"

/* Zero-initialised is closed. */
struct file_reader {
  uint64_t size;             /* of the file */
  struct file_identity file; /* which one it is */
  /* private */
  bool is_open;
  int descriptor;
  const char *path;
};

/* Opens a regular file.
 * path    must outlive the reader
 * Errors  RECTO_ERROR_IO: there is none, or it cannot be read */
USE_RESULT recto_status file_reader_open(struct file_reader *reader,
                                         const char *path, recto_error *error);

/* Reads so many bytes from a place on.
 * Errors  RECTO_ERROR_IO, also where the file ends before */
USE_RESULT recto_status file_reader_read(const struct file_reader *reader,
                                         uint64_t place, void *bytes,
                                         size_t count, recto_error *error);

void file_reader_close(struct file_reader *reader);

#endif
