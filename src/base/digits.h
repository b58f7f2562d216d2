/* digits.h - runs of decimal digits, eight at a time. */
#ifndef BASE_DIGITS_H
#define BASE_DIGITS_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

static inline bool digits_is_one(char c) { return c >= '0' && c <= '9'; }

/* Appends the digits at `text` to *w, which goes round where they are too
 * many, and returns where they end.  Best where they are few. */
static inline const char *digits_gather_singly(const char *text,
                                               const char *end, uint64_t *w) {
  for (; text < end && digits_is_one(*text); text++)
    *w = *w * 10 + (uint64_t)(*text - '0');
  return text;
}

/* The same, without a branch that depends on how many there are up to eight.
 *
 * A byte b of the window is a digit where b ^ '0' <= 9; adding 0x76 then
 * carries into its top bit if it is not.  The digits are shifted to the
 * window's end, zeros before them, and added up in pairs, then fours, then
 * all eight. */
static inline const char *digits_gather(const char *text, const char *end,
                                        uint64_t *w) {
#if defined __BYTE_ORDER__ && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  static const uint64_t scale[9] = {1,      10,      100,      1000,     10000,
                                    100000, 1000000, 10000000, 100000000};
  while (end - text >= 8) {
    uint64_t window;
    memcpy(&window, text, 8);
    window ^= UINT64_C(0x3030303030303030);
    uint64_t other = ((window & UINT64_C(0x7f7f7f7f7f7f7f7f)) +
                      UINT64_C(0x7676767676767676)) |
                     window;
    other &= UINT64_C(0x8080808080808080);
    int count = other ? __builtin_ctzll(other) / 8 : 8;
    if (count == 0)
      return text;
    window <<= 64 - 8 * count;
    window = window * 10 + (window >> 8);
    uint64_t first = window & UINT64_C(0x000000ff000000ff);
    uint64_t second = (window >> 16) & UINT64_C(0x000000ff000000ff);
    window = first * (UINT64_C(1000000) << 32 | 100) +
             second * (UINT64_C(10000) << 32 | 1);
    *w = *w * scale[count] + (window >> 32);
    text += count;
    if (count < 8)
      return text;
  }
#endif
  return digits_gather_singly(text, end, w);
}

#endif
