/* byte_codec.c - numbers as bytes, and their checksum. */
#include "parts/byte_codec.h"

#include <math.h>
#include <string.h>

static void fail_for_memory(struct byte_codec *codec) {
  codec->failed = codec->out_of_memory = true;
}

bool byte_codec_grow_by(struct byte_codec *codec, size_t size) {
  if (ARRAY_RESERVE(&codec->bytes, size))
    return true;
  fail_for_memory(codec);
  return false;
}

bool byte_codec_grow(struct byte_codec *codec) {
  return byte_codec_grow_by(codec, sizeof(uint64_t));
}

void byte_codec_numbers(struct byte_codec *codec, uint32_t *value,
                        size_t count) {
  for (size_t i = 0; i < count; i++) {
    struct byte_record record = byte_codec_record(codec, sizeof *value);
    byte_record_u32(&record, &value[i]);
  }
}

void byte_codec_i64(struct byte_codec *codec, int64_t *value) {
  uint64_t number = codec->writes ? (uint64_t)*value : 0;
  byte_codec_number(codec, &number, 8);
  memcpy(value, &number, sizeof *value);
}

void byte_codec_doubles(struct byte_codec *codec, double *value, int count) {
  for (int i = 0; i < count; i++) {
    byte_codec_double(codec, &value[i]);
    byte_codec_require(codec, isfinite(value[i]));
  }
}

void byte_codec_float(struct byte_codec *codec, float *value) {
  uint32_t bits = 0;
  if (codec->writes)
    memcpy(&bits, value, sizeof bits);
  byte_codec_u32(codec, &bits);
  memcpy(value, &bits, sizeof bits);
}

void byte_codec_bool(struct byte_codec *codec, bool *value) {
  uint8_t byte = codec->writes && *value;
  byte_codec_u8(codec, &byte);
  codec->failed |= byte > 1;
  *value = byte == 1;
}

static void code_int128(struct byte_codec *codec, int128 *value) {
  uint64_t low = codec->writes ? (uint64_t)*value : 0;
  uint64_t high = codec->writes ? (uint64_t)(*value >> 64) : 0;
  byte_codec_number(codec, &low, 8);
  byte_codec_number(codec, &high, 8);
  if (!codec->writes)
    *value = 0;
  if (high >> 62 != 0) /* negative, or 2^126 or more */
    codec->failed = true;
  else
    *value = (int128)high << 64 | low;
}

void byte_codec_ratio(struct byte_codec *codec, struct ratio *value) {
  code_int128(codec, &value->num);
  code_int128(codec, &value->den);
  if (codec->failed || value->den <= 0 || value->num < 0 ||
      value->num > value->den) {
    codec->failed = true;
    *value = ratio_of(0, 1);
  }
}

void byte_codec_count(struct byte_codec *codec, size_t *count, size_t size) {
  uint64_t number = *count;
  byte_codec_number(codec, &number, 8);
  if (!codec->writes && number > codec->left / size) {
    codec->failed = true;
    number = 0;
  }
  *count = (size_t)number;
}

void byte_codec_text(struct byte_codec *codec, char **text) {
  size_t length = codec->writes ? strlen(*text) : 0;
  byte_codec_count(codec, &length, 1);
  if (codec->writes) {
    if (!ARRAY_RESERVE(&codec->bytes, length)) {
      fail_for_memory(codec);
      return;
    }
    if (length > 0)
      memcpy(codec->bytes.item + codec->bytes.count, *text, length);
    codec->bytes.count += length;
    return;
  }
  *text = NULL;
  if (codec->failed)
    return;
  if (length > 0 && memchr(codec->at, 0, length) != NULL) {
    codec->failed = true;
    return;
  }
  *text = mem_alloc(length + 1, 1);
  if (*text == NULL) {
    fail_for_memory(codec);
    return;
  }
  if (length > 0)
    memcpy(*text, codec->at, length);
  (*text)[length] = '\0';
  codec->at += length;
  codec->left -= length;
}

/* ---- The checksum -------------------------------------------------------- */

#define POLYNOMIAL UINT64_C(0x42f0e1eba9ea3693) /* ECMA-182, x^64 left out */

/* Table k: what the bits of a byte leave that k more bytes follow, so that
 * eight bytes are taken at once. */
enum { TABLES = 8 };

static void fill_tables(uint64_t table[TABLES][256]) {
  for (unsigned i = 0; i < 256; i++) {
    uint64_t rest = (uint64_t)i << 56;
    for (int bit = 0; bit < 8; bit++)
      rest = rest << 1 ^ (rest >> 63 ? POLYNOMIAL : 0);
    table[0][i] = rest;
  }
  for (int k = 1; k < TABLES; k++)
    for (unsigned i = 0; i < 256; i++) {
      uint64_t before = table[k - 1][i];
      table[k][i] = before << 8 ^ table[0][before >> 56];
    }
}

/* Goes on with eight more bytes. */
static inline uint64_t sum_word(uint64_t table[TABLES][256], uint64_t sum,
                                const unsigned char *at) {
  uint64_t word = sum ^ ((uint64_t)at[0] << 56 | (uint64_t)at[1] << 48 |
                         (uint64_t)at[2] << 40 | (uint64_t)at[3] << 32 |
                         (uint64_t)at[4] << 24 | (uint64_t)at[5] << 16 |
                         (uint64_t)at[6] << 8 | (uint64_t)at[7]);
  return table[7][word >> 56] ^ table[6][word >> 48 & 0xff] ^
         table[5][word >> 40 & 0xff] ^ table[4][word >> 32 & 0xff] ^
         table[3][word >> 24 & 0xff] ^ table[2][word >> 16 & 0xff] ^
         table[1][word >> 8 & 0xff] ^ table[0][word & 0xff];
}

/* The product of two polynomials modulo the polynomial. */
static uint64_t multiply(uint64_t a, uint64_t b) {
  uint64_t product = 0;
  for (int bit = 63; bit >= 0; bit--) {
    product = product << 1 ^ (product >> 63 ? POLYNOMIAL : 0);
    product ^= b >> bit & 1 ? a : 0;
  }
  return product;
}

/* What a sum is multiplied by where so many bytes follow: x^(8 count). */
static uint64_t power_of_bytes(size_t count) {
  uint64_t power = 1, square = 1 << 8;
  for (; count > 0; count >>= 1) {
    if (count & 1)
      power = multiply(power, square);
    square = multiply(square, square);
  }
  return power;
}

/* The sum of so many chunks of so many words, which follow one another.  Those
 * of the chunks do not wait for each other. */
enum { CHUNKS = 4 };

static uint64_t sum_of_chunks(uint64_t table[TABLES][256],
                              const unsigned char *at, size_t words) {
  size_t size = words * TABLES;
  uint64_t a = 0, b = 0, c = 0, d = 0, shift = power_of_bytes(size);
  for (size_t i = 0; i < words; i++, at += TABLES) {
    a = sum_word(table, a, at);
    b = sum_word(table, b, at + size);
    c = sum_word(table, c, at + 2 * size);
    d = sum_word(table, d, at + 3 * size);
  }
  return multiply(multiply(multiply(a, shift) ^ b, shift) ^ c, shift) ^ d;
}

uint64_t byte_codec_checksum(const void *bytes, size_t count) {
  uint64_t table[TABLES][256];
  const unsigned char *at = bytes;
  fill_tables(table);
  size_t words = count / (CHUNKS * TABLES);
  uint64_t sum = sum_of_chunks(table, at, words);
  at += words * CHUNKS * TABLES;
  count -= words * CHUNKS * TABLES;
  for (; count >= TABLES; count -= TABLES, at += TABLES)
    sum = sum_word(table, sum, at);
  for (size_t i = 0; i < count; i++)
    sum = sum << 8 ^ table[0][(sum >> 56 ^ at[i]) & 0xff];
  return sum;
}
