/* stream.h - buffered output that appears whole or not at all.
 *
 * A stream writes to a new file that gets its name when it is finished
 * without a fault; or to a pipe, a device or a file that must be written in
 * place, for which bytes are held back until then; or to memory.  Its status is
 * sticky: after the first fault every write is ignored, and stream_finish
 * returns it.  Every part of 64 KB polls (poll.h), so that writing may be
 * cancelled. */
#ifndef BASE_STREAM_H
#define BASE_STREAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/path.h"
#include "base/status.h"

struct stream;

/* Opens a stream to `path`; "-" is standard output: see target.h. */
USE_RESULT recto_status stream_open(struct stream **stream, const char *path,
                                    recto_error *error);
/* Opens a stream to memory: see stream_memory. */
USE_RESULT recto_status stream_open_memory(struct stream **stream,
                                           recto_error *error);

/* Whether both streams would write to one place, there already or not. */
bool stream_is_same(const struct stream *a, const struct stream *b);

/* Whether the stream would replace this file. */
bool stream_replaces(const struct stream *stream, struct file_identity it);

/* Compresses all that is written from now on, in the format of gzip, with no
 * name or time in it.  RECTO_ERROR_UNSUPPORTED, RECTO_ERROR_MEMORY. */
USE_RESULT recto_status stream_compress(struct stream *stream,
                                        recto_error *error);

void stream_write(struct stream *stream, const void *bytes, size_t count);
void stream_text(struct stream *stream, const char *text);
/* See number_format. */
void stream_number(struct stream *stream, double value, int decimals);
void stream_int(struct stream *stream, int64_t value);

/* Lets the stream fail for what its writer could not write elsewhere on the
 * way.
 * fault  errno; 0: not known */
void stream_fault(struct stream *stream, int fault);

/* RECTO_OK while all went well so far. */
recto_status stream_status(const struct stream *stream);

/* Ends a memory stream's compression, so that its bytes are whole.
 * Errors  of what was written so far */
USE_RESULT recto_status stream_complete(struct stream *stream,
                                        recto_error *error);

/* The bytes written so far to a memory stream, NUL-terminated (the NUL is not
 * counted); borrowed from the stream, until it is written to or freed. */
const char *stream_memory(const struct stream *stream, size_t *count);

/* Empties a memory stream, and keeps its memory. */
void stream_clear_memory(struct stream *stream);

/* Flushes, closes and renames; on a fault removes what was written.  Frees
 * the stream in either case. */
USE_RESULT recto_status stream_finish(struct stream *stream,
                                      recto_error *error);
/* Finishes several streams, all of them or none: what goes to pipes and devices
 * cannot be taken back and comes first, the last stream's before the others',
 * and then each file is put in its place.
 * stream  some may be NULL */
USE_RESULT recto_status stream_finish_all(struct stream *const *stream,
                                          size_t count, recto_error *error);
/* Closes and removes what was written; frees the stream.  Accepts NULL. */
void stream_discard(struct stream *stream);

/* For tests: the n-th physical write from now (1-based) fails; 0: off. */
void stream_fail_after(unsigned long n);

#endif
