/* archive_3mf.c - the model within the ZIP archive that a 3MF file is.
 *
 * The directory, at the archive's end, says where the part 3D/3dmodel.model is.
 * Robustness  every offset and length is compared with the bytes there are. */
#include "import/archive_3mf.h"

#include <stdint.h>
#include <string.h>
#include <strings.h>

#ifdef HAVE_ZLIB
#include <zlib.h>
#endif

struct archive {
  const unsigned char *bytes;
  size_t count;
};

/* A little-endian number of `size` bytes; 0 past the end. */
static uint32_t number_of(const struct archive *a, size_t at, int size) {
  uint32_t value = 0;
  for (int i = size; i > 0; i--)
    value = value << 8 |
            (at + (size_t)i <= a->count ? a->bytes[at + (size_t)i - 1] : 0);
  return value;
}

#define END_OF_DIRECTORY 0x06054b50u
#define DIRECTORY_ENTRY 0x02014b50u
#define FILE_HEADER 0x04034b50u
enum { END_SIZE = 22, ENTRY_SIZE = 46, HEADER_SIZE = 30, COMMENT_MAX = 65535 };

/* Where the directory begins; a->count where there is none. */
static size_t find_directory(const struct archive *a) {
  for (size_t back = END_SIZE;
       back <= a->count && back <= END_SIZE + COMMENT_MAX; back++)
    if (number_of(a, a->count - back, 4) == END_OF_DIRECTORY)
      return number_of(a, a->count - back + 16, 4);
  return a->count;
}

static bool is_model(const struct archive *a, size_t name, size_t length) {
  static const char path[] = "3D/3dmodel.model";
  return length == sizeof path - 1 && name <= a->count &&
         length <= a->count - name &&
         strncasecmp((const char *)a->bytes + name, path, length) == 0;
}

/* Finds the model's entry of the directory; a->count where there is none. */
static size_t find_model(const struct archive *a) {
  size_t at = find_directory(a);
  while (at < a->count && number_of(a, at, 4) == DIRECTORY_ENTRY) {
    size_t length = number_of(a, at + 28, 2);
    if (is_model(a, at + ENTRY_SIZE, length))
      return at;
    at += ENTRY_SIZE + length + number_of(a, at + 30, 2) +
          number_of(a, at + 32, 2);
  }
  return a->count;
}

static void inflate_part(const unsigned char *from, uint32_t count,
                         archive_3mf_take *take, void *user) {
#ifdef HAVE_ZLIB
  char block[1 << 15];
  z_stream stream = {.next_in = (z_const Bytef *)from, .avail_in = count};
  int state = Z_OK;
  bool goes_on = true;
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK)
    return;
  while (state == Z_OK && goes_on) {
    stream.next_out = (Bytef *)block;
    stream.avail_out = sizeof block;
    state = inflate(&stream, Z_NO_FLUSH);
    goes_on = take(user, block, sizeof block - stream.avail_out);
  }
  (void)inflateEnd(&stream);
#else
  (void)from;
  (void)count;
  (void)take;
  (void)user;
#endif
}

void archive_3mf_expand(const char *bytes, size_t count, archive_3mf_take *take,
                        void *user) {
  enum { STORED = 0, DEFLATED = 8 };
  const struct archive archive = {(const unsigned char *)bytes, count};
  const struct archive *a = &archive;
  size_t entry = find_model(a), at = number_of(a, entry + 42, 4);
  if (entry >= a->count || number_of(a, at, 4) != FILE_HEADER)
    return;
  uint32_t method = number_of(a, entry + 10, 2);
  uint32_t length = number_of(a, entry + 20, 4);
  at += HEADER_SIZE + number_of(a, at + 26, 2) + number_of(a, at + 28, 2);
  if (at >= a->count || length > a->count - at)
    return;
  if (method == DEFLATED)
    inflate_part(a->bytes + at, length, take, user);
  else if (method == STORED)
    (void)take(user, bytes + at, length);
}
