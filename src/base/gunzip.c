/* gunzip.c - expands data compressed with gzip, through zlib. */
#include "base/gunzip.h"

bool gunzip_is_wanted(const char *bytes, size_t count) {
  const unsigned char *b = (const unsigned char *)bytes;
  /* The signature, the only method that there is, no reserved flags. */
  return count >= 4 && b[0] == 0x1f && b[1] == 0x8b && b[2] == 8 &&
         (b[3] & 0xe0) == 0;
}

#ifdef HAVE_ZLIB

#include <zlib.h>

#include "base/gzip.h"
#include "base/poll.h"

struct expansion {
  z_stream stream;
  const char *bytes; /* compressed, `count` of them */
  size_t count, taken, size_max;
  struct byte_array to;
  const char *path;
  recto_error *error;
};

/* The most that the data may expand to. */
static size_t expansion_limit(size_t count, size_t size_max) {
  size_t limit = (size_t)GUNZIP_SIZE_ALWAYS_ALLOWED;
  if (count > limit / GUNZIP_RATIO)
    limit = count > size_max / GUNZIP_RATIO ? size_max : count * GUNZIP_RATIO;
  return limit < size_max ? limit : size_max;
}

/* A first guess at the expanded size: the last four bytes hold it, modulo
 * 2^32, where there is one member.  Deflated data are at best a thousandth. */
static size_t guess_size(const struct expansion *x) {
  const unsigned char *b = (const unsigned char *)x->bytes + x->count - 4;
  size_t size =
      b[0] | (size_t)b[1] << 8 | (size_t)b[2] << 16 | (size_t)b[3] << 24;
  size_t probable = x->count < x->size_max / 16 ? 16 * x->count : x->size_max;
  return (size < probable ? size : probable) + 2;
}

static recto_status expansion_fault(const struct expansion *x, int result) {
  if (result == Z_MEM_ERROR)
    return error_memory(x->error);
  if (result == Z_BUF_ERROR)
    return error_set(x->error, RECTO_ERROR_FORMAT, x->path, 0,
                     "gzip data cut short");
  return error_set(x->error, RECTO_ERROR_FORMAT, x->path, 0,
                   "broken gzip data%s%s", x->stream.msg != NULL ? ": " : "",
                   x->stream.msg != NULL ? x->stream.msg : "");
}

/* Expands some more into the capacity that is left, which is one byte at least
 * besides that of the NUL.
 * Returns zlib's code: Z_BUF_ERROR where there are no data left. */
static int expand_some(struct expansion *x) {
  enum { AT_ONCE_MAX = 1 << 22 };
  size_t left = x->count - x->taken;
  size_t capacity = x->to.capacity - x->to.count - 1;
  uInt in = left < AT_ONCE_MAX ? (uInt)left : AT_ONCE_MAX;
  uInt out = capacity < AT_ONCE_MAX ? (uInt)capacity : AT_ONCE_MAX;
  x->stream.next_in = (z_const Bytef *)(uintptr_t)(x->bytes + x->taken);
  x->stream.avail_in = in;
  x->stream.next_out = (Bytef *)(x->to.item + x->to.count);
  x->stream.avail_out = out;
  int result = inflate(&x->stream, Z_NO_FLUSH);
  x->taken += in - x->stream.avail_in;
  x->to.count += out - x->stream.avail_out;
  return result;
}

/* Expands one member. */
static recto_status expand_member(struct expansion *x) {
  int result = Z_OK;
  while (result == Z_OK) {
    if (!poll_now())
      return error_cancelled(x->error);
    if (x->to.capacity - x->to.count < 2 &&
        !ARRAY_RESERVE(&x->to, (size_t)1 << 16))
      return error_memory(x->error);
    result = expand_some(x);
    if (x->to.count > x->size_max)
      return error_set(x->error, RECTO_ERROR_LIMIT, x->path, 0,
                       "gzip data that expand to more than %zu MB",
                       x->size_max >> 20);
  }
  return result == Z_STREAM_END ? RECTO_OK : expansion_fault(x, result);
}

static bool is_padding(const char *bytes, size_t count) {
  for (size_t i = 0; i < count; i++)
    if (bytes[i] != 0)
      return false;
  return true;
}

static recto_status expand(struct expansion *x) {
  enum { GZIP_ALONE = 16 + MAX_WBITS };
  int result = inflateInit2(&x->stream, GZIP_ALONE);
  if (result != Z_OK)
    return error_memory(x->error);
  recto_status status = RECTO_OK;
  while (status == RECTO_OK) {
    status = expand_member(x);
    if (status != RECTO_OK ||
        is_padding(x->bytes + x->taken, x->count - x->taken))
      break;
    if (inflateReset(&x->stream) != Z_OK)
      status = error_memory(x->error);
  }
  inflateEnd(&x->stream);
  return status;
}

recto_status gunzip(struct byte_array *data, const char *path, size_t size_max,
                    recto_error *error) {
  struct expansion x = {
      .stream = {.zalloc = gzip_allocate, .zfree = gzip_release},
      .bytes = data->item,
      .count = data->count,
      .size_max = expansion_limit(data->count, size_max),
      .path = path,
      .error = error};
  recto_status status =
      ARRAY_RESERVE(&x.to, guess_size(&x)) ? expand(&x) : error_memory(error);
  if (status != RECTO_OK) {
    ARRAY_FREE(&x.to);
    return status;
  }
  x.to.item[x.to.count] = '\0';
  ARRAY_FREE(data);
  *data = x.to;
  return RECTO_OK;
}

#else

recto_status gunzip(struct byte_array *data, const char *path, size_t size_max,
                    recto_error *error) {
  (void)data;
  (void)size_max;
  return error_set(error, RECTO_ERROR_UNSUPPORTED, path, 0,
                   "compressed with gzip, and this build is without zlib");
}

#endif
