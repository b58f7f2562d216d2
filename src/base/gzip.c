/* gzip.c - compresses bytes on their way. */
#include "base/gzip.h"

#include "base/memory.h"

#ifdef HAVE_ZLIB

#include <limits.h>
#include <zlib.h>

enum { CHUNK = 1 << 15, UNKNOWN_SYSTEM = 255 };

struct gzip {
  z_stream z;
  gz_header header;
  gzip_sink *sink;
  void *user;
  unsigned char out[CHUNK];
};

void *gzip_allocate(void *user, unsigned count, unsigned size) {
  (void)user;
  return mem_alloc(count, size);
}

void gzip_release(void *user, void *block) {
  (void)user;
  mem_free(block);
}

recto_status gzip_create(struct gzip **gzip, gzip_sink *sink, void *user,
                         recto_error *error) {
  enum { WINDOW_BITS = 15, AS_GZIP = 16, USUAL_MEMORY = 8 };
  struct gzip *made = mem_calloc(1, sizeof *made);
  *gzip = NULL;
  if (made == NULL)
    return error_memory(error);
  made->sink = sink;
  made->user = user;
  made->z.zalloc = gzip_allocate;
  made->z.zfree = gzip_release;
  made->header.os = UNKNOWN_SYSTEM;
  if (deflateInit2(&made->z, Z_BEST_COMPRESSION, Z_DEFLATED,
                   WINDOW_BITS + AS_GZIP, USUAL_MEMORY,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    mem_free(made);
    return error_memory(error);
  }
  (void)deflateSetHeader(&made->z, &made->header);
  *gzip = made;
  return RECTO_OK;
}

/* Deflates the pending input and writes the output to the target. */
static void deflate_pending(struct gzip *gzip, int flush) {
  do {
    gzip->z.next_out = gzip->out;
    gzip->z.avail_out = CHUNK;
    (void)deflate(&gzip->z, flush);
    gzip->sink(gzip->user, gzip->out, CHUNK - gzip->z.avail_out);
  } while (gzip->z.avail_out == 0);
}

void gzip_write(struct gzip *gzip, const void *bytes, size_t count) {
  const unsigned char *next = bytes;
  while (count > 0) {
    uInt now = count < UINT_MAX ? (uInt)count : UINT_MAX;
    gzip->z.next_in = (z_const Bytef *)(uintptr_t)next;
    gzip->z.avail_in = now;
    deflate_pending(gzip, Z_NO_FLUSH);
    next += now;
    count -= now;
  }
}

void gzip_end(struct gzip *gzip) { deflate_pending(gzip, Z_FINISH); }

void gzip_destroy(struct gzip *gzip) {
  if (gzip == NULL)
    return;
  (void)deflateEnd(&gzip->z);
  mem_free(gzip);
}

#else

recto_status gzip_create(struct gzip **gzip, gzip_sink *sink, void *user,
                         recto_error *error) {
  (void)sink;
  (void)user;
  *gzip = NULL;
  return error_set(error, RECTO_ERROR_UNSUPPORTED, NULL, 0,
                   "compressed files need zlib, which this build is without");
}

void gzip_write(struct gzip *gzip, const void *bytes, size_t count) {
  (void)gzip;
  (void)bytes;
  (void)count;
}

void gzip_end(struct gzip *gzip) { (void)gzip; }

void gzip_destroy(struct gzip *gzip) { (void)gzip; }

#endif
