/* unit_3mf.c - the unit of a 3MF model, which Assimp does not tell.
 *
 * A 3MF file is a ZIP archive.  Its directory, at the end, says where the model
 * is, the part 3D/3dmodel.model; the beginning of that is expanded, and the
 * attribute of its root element is read.
 * Robustness  every offset and length is compared with the bytes there are. */
#include "import/unit_3mf.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>
#include <strings.h>

#ifdef HAVE_ZLIB
#include <zlib.h>
#endif

/* The root element stands within so many bytes, or its unit is not found. */
enum { HEAD_SIZE = 16384 };

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

/* ---- The archive --------------------------------------------------------- */

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

/* Expands the beginning of deflated data to `to`; returns its length. */
static size_t inflate_head(const unsigned char *from, size_t count,
                           char to[HEAD_SIZE]) {
#ifdef HAVE_ZLIB
  z_stream stream = {.next_in = (z_const Bytef *)from,
                     .avail_in =
                         (uInt)(count < UINT32_MAX ? count : UINT32_MAX),
                     .next_out = (Bytef *)to,
                     .avail_out = HEAD_SIZE};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK)
    return 0;
  (void)inflate(&stream, Z_SYNC_FLUSH);
  size_t length = HEAD_SIZE - stream.avail_out;
  (void)inflateEnd(&stream);
  return length;
#else
  (void)from;
  (void)count;
  (void)to;
  return 0;
#endif
}

/* Copies the beginning of the model to `to`; returns its length, 0 where it
 * cannot be read. */
static size_t read_head(const struct archive *a, char to[HEAD_SIZE]) {
  enum { STORED = 0, DEFLATED = 8 };
  size_t entry = find_model(a), at = number_of(a, entry + 42, 4);
  if (entry >= a->count || number_of(a, at, 4) != FILE_HEADER)
    return 0;
  uint32_t method = number_of(a, entry + 10, 2);
  size_t length = number_of(a, entry + 20, 4);
  at += HEADER_SIZE + number_of(a, at + 26, 2) + number_of(a, at + 28, 2);
  if (at >= a->count || length > a->count - at)
    return 0;
  if (method == DEFLATED)
    return inflate_head(a->bytes + at, length, to);
  if (method != STORED)
    return 0;
  length = length < HEAD_SIZE ? length : HEAD_SIZE;
  memcpy(to, a->bytes + at, length);
  return length;
}

/* ---- The unit ------------------------------------------------------------ */

/* The value of the attribute unit within an element's text, or 1. */
static double unit_of_element(const char *text) {
  static const struct {
    const char *name;
    double mm;
  } unit[] = {{"micron", 0.001}, {"millimeter", 1}, {"centimeter", 10},
              {"inch", 25.4},    {"foot", 304.8},   {"meter", 1000}};
  const char *at = text;
  while ((at = strstr(at, "unit")) != NULL) {
    bool begins = at > text && strchr(" \t\r\n", at[-1]) != NULL;
    at += strlen("unit");
    const char *value = at + strspn(at, " \t\r\n");
    if (!begins || *value != '=')
      continue;
    value++;
    value += strspn(value, " \t\r\n");
    for (size_t i = 0; i < sizeof unit / sizeof *unit; i++) {
      size_t length = strlen(unit[i].name);
      if ((*value == '"' || *value == '\'') &&
          strncmp(value + 1, unit[i].name, length) == 0 &&
          value[1 + length] == *value)
        return unit[i].mm;
    }
  }
  return 1;
}

/* The root element in `text`, from behind its name up to its end, which becomes
 * NUL; its name may have a prefix.  NULL where it is not whole. */
static char *find_root(char *text) {
  for (char *at = strchr(text, '<'); at != NULL; at = strchr(at + 1, '<')) {
    size_t length = strcspn(at, " \t\r\n>");
    char *end = strchr(at, '>');
    bool is_root = length >= 6 && strncmp(at + length - 5, "model", 5) == 0 &&
                   (at[length - 6] == '<' || at[length - 6] == ':');
    if (end == NULL)
      return NULL;
    if (is_root) {
      *end = '\0';
      return at + length;
    }
  }
  return NULL;
}

double unit_3mf_mm(const char *bytes, size_t count) {
  const struct archive archive = {(const unsigned char *)bytes, count};
  char head[HEAD_SIZE + 1];
  size_t length = read_head(&archive, head);
  head[length] = '\0';
  char *root = find_root(head);
  return root != NULL ? unit_of_element(root) : 0;
}
