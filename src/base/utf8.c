/* utf8.c - text in UTF-8 that every format can hold. */
#include "base/utf8.h"

#include <string.h>

#include "base/memory.h"

#define REPLACEMENT "\xef\xbf\xbd"

size_t utf8_measure(const char *text, uint32_t *character) {
  static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const unsigned char *at = (const unsigned char *)text;
  size_t length = at[0] < 0x80             ? 1
                  : (at[0] & 0xe0) == 0xc0 ? 2
                  : (at[0] & 0xf0) == 0xe0 ? 3
                  : (at[0] & 0xf8) == 0xf0 ? 4
                                           : 0;
  if (length == 0)
    return 0;
  uint32_t code = length == 1 ? at[0] : at[0] & (0x7fu >> length);
  for (size_t i = 1; i < length; i++) {
    if ((at[i] & 0xc0) != 0x80)
      return 0;
    code = code << 6 | (at[i] & 0x3fu);
  }
  bool allowed = code == '\t' || code == '\n' || code == '\r' ||
                 (code >= 0x20 && code < 0xd800) ||
                 (code >= 0xe000 && code < 0xfffe) ||
                 (code >= 0x10000 && code < 0x110000);
  if (character != NULL)
    *character = code;
  return allowed && code >= least[length] ? length : 0;
}

char *utf8_clean(const char *text) {
  const size_t longest = sizeof REPLACEMENT - 1;
  char *copy = mem_alloc(strlen(text) + 1, longest);
  char *to = copy;
  if (copy == NULL)
    return NULL;
  while (*text != '\0') {
    size_t length = utf8_measure(text, NULL);
    if (length == 1 && ((unsigned char)*text < ' ' || *text == '\x7f')) {
      *to++ = ' ';
    } else if (length > 0) {
      memcpy(to, text, length);
      to += length;
    } else {
      memcpy(to, REPLACEMENT, longest);
      to += longest;
    }
    text += length > 0 ? length : 1;
  }
  *to = '\0';
  return copy;
}
