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

/* The zeros of the scripts that have ten digits in a row, but for ASCII. */
static const uint32_t zero[] = {
    0x660,   0x6f0,   0x7c0,   0x966,   0x9e6,   0xa66,   0xae6,   0xb66,
    0xbe6,   0xc66,   0xce6,   0xd66,   0xde6,   0xe50,   0xed0,   0xf20,
    0x1040,  0x1090,  0x17e0,  0x1810,  0x1946,  0x19d0,  0x1a80,  0x1a90,
    0x1b50,  0x1bb0,  0x1c40,  0x1c50,  0xa620,  0xa8d0,  0xa900,  0xa9d0,
    0xa9f0,  0xaa50,  0xabf0,  0xff10,  0x104a0, 0x10d30, 0x11066, 0x110f0,
    0x11136, 0x111d0, 0x112f0, 0x11450, 0x114d0, 0x11650, 0x116c0, 0x11730,
    0x118e0, 0x11950, 0x11c50, 0x11d50, 0x11da0, 0x11f50, 0x16a60, 0x16ac0,
    0x16b50, 0x1d7ce, 0x1d7d8, 0x1d7e2, 0x1d7ec, 0x1d7f6, 0x1e140, 0x1e2f0,
    0x1e4f0, 0x1e950, 0x1fbf0};

/* Other digits. */
static const uint32_t digit_range[][2] = {
    {0xb2, 0xb3},       {0xb9, 0xb9},       {0x1369, 0x1371},
    {0x19da, 0x19da},   {0x2070, 0x2070},   {0x2074, 0x2079},
    {0x2080, 0x2089},   {0x2460, 0x2468},   {0x2474, 0x247c},
    {0x2488, 0x2490},   {0x24ea, 0x24ea},   {0x24f5, 0x24fd},
    {0x24ff, 0x24ff},   {0x2776, 0x277e},   {0x2780, 0x2788},
    {0x278a, 0x2792},   {0x10a40, 0x10a43}, {0x10e60, 0x10e68},
    {0x11052, 0x1105a}, {0x1f100, 0x1f10a}};

bool utf8_is_digit(uint32_t code) {
  bool is_digit = code >= '0' && code <= '9';
  for (size_t i = 0; code > 0x7f && i < sizeof zero / sizeof *zero; i++)
    is_digit = is_digit || (code >= zero[i] && code - zero[i] < 10);
  for (size_t i = 0;
       code > 0x7f && i < sizeof digit_range / sizeof *digit_range; i++)
    is_digit =
        is_digit || (code >= digit_range[i][0] && code <= digit_range[i][1]);
  return is_digit;
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
