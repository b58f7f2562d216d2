/* byte_codec.c - numbers as bytes, and their checksum. */
#include "parts/byte_codec.h"

#include <math.h>
#include <string.h>

static void fail_for_memory(struct byte_codec *codec) {
  codec->failed = codec->out_of_memory = true;
}

bool byte_codec_grow(struct byte_codec *codec) {
  if (ARRAY_RESERVE(&codec->bytes, sizeof(uint64_t)))
    return true;
  fail_for_memory(codec);
  return false;
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

uint64_t byte_codec_checksum(const void *bytes, size_t count) {
  uint64_t table[TABLES][256], sum = 0;
  const unsigned char *at = bytes;
  fill_tables(table);
  for (; count >= TABLES; count -= TABLES, at += TABLES) {
    uint64_t word = sum ^ ((uint64_t)at[0] << 56 | (uint64_t)at[1] << 48 |
                           (uint64_t)at[2] << 40 | (uint64_t)at[3] << 32 |
                           (uint64_t)at[4] << 24 | (uint64_t)at[5] << 16 |
                           (uint64_t)at[6] << 8 | (uint64_t)at[7]);
    sum = table[7][word >> 56] ^ table[6][word >> 48 & 0xff] ^
          table[5][word >> 40 & 0xff] ^ table[4][word >> 32 & 0xff] ^
          table[3][word >> 24 & 0xff] ^ table[2][word >> 16 & 0xff] ^
          table[1][word >> 8 & 0xff] ^ table[0][word & 0xff];
  }
  for (size_t i = 0; i < count; i++)
    sum = sum << 8 ^ table[0][(sum >> 56 ^ at[i]) & 0xff];
  return sum;
}
