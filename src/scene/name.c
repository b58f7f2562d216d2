/* name.c - names of groups as clean UTF-8. */
#include "scene/name.h"

#include <stdint.h>
#include <string.h>

/* The code point and length of a character of two to four bytes; 0 where none
 * stands there. */
static size_t decode(const unsigned char *text, size_t length,
                     uint32_t *code_point) {
  size_t size = text[0] >= 0xf0 ? 4 : text[0] >= 0xe0 ? 3 : 2;
  if (text[0] < 0xc2 || text[0] > 0xf4 || size > length)
    return 0;
  *code_point = text[0] & (0xffu >> (size + 1));
  for (size_t i = 1; i < size; i++) {
    if ((text[i] & 0xc0) != 0x80)
      return 0;
    *code_point = *code_point << 6 | (text[i] & 0x3fu);
  }
  return size;
}

/* Whether XML, the strictest of our outputs, takes a character written in so
 * many bytes; longer forms than needed are no characters. */
static int is_fit(uint32_t code_point, size_t size) {
  static const uint32_t least[5] = {0, 0, 0x80, 0x800, 0x10000};
  return code_point >= least[size] && code_point <= 0x10ffff &&
         (code_point < 0xd800 || code_point > 0xdfff) && code_point != 0xfffe &&
         code_point != 0xffff && (code_point < 0x80 || code_point > 0x9f);
}

size_t name_clean(const char *name, size_t length, char *to) {
  const unsigned char *text = (const unsigned char *)name;
  char *start = to;
  for (size_t i = 0; i < length;) {
    uint32_t code_point = 0;
    size_t size = decode(text + i, length - i, &code_point);
    if (size && is_fit(code_point, size)) {
      memcpy(to, name + i, size);
      to += size;
      i += size;
      continue;
    }
    unsigned char c = text[i++];
    if (c >= 0xa0) {
      *to++ = (char)(0xc0 | c >> 6);
      *to++ = (char)(0x80 | (c & 0x3f));
    } else {
      *to++ = c < ' ' || c >= 0x7f ? '?' : (char)c;
    }
  }
  return (size_t)(to - start);
}
