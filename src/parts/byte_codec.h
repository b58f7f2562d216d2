/* byte_codec.h - one description of a binary format for both directions: each
 * function writes a value to the end of the bytes, or reads it from them.
 *
 * Numbers have a fixed size and the least significant byte first, on any
 * machine; doubles are the bits of IEEE 754.  Where bytes are missing, `failed`
 * is set and every later value is 0, so that the caller checks once.
 */
#ifndef PARTS_BYTE_CODEC_H
#define PARTS_BYTE_CODEC_H

#include <string.h>

#include "base/memory.h"
#include "geom/ratio.h"

/* Bytes of the longest record. */
enum { BYTE_RECORD_MAX = 32 };

struct byte_codec {
  bool writes;
  bool failed;             /* bytes were missing, or a value was not valid */
  bool out_of_memory;      /* and that is why */
  struct byte_array bytes; /* written; owned */
  const unsigned char *at; /* reading: the next one, */
  size_t left;             /* and how many are left */
  unsigned char spare[BYTE_RECORD_MAX]; /* a record after a failure: zeros */
};

/* Makes room for eight bytes; false when memory ran out. */
bool byte_codec_grow(struct byte_codec *codec);

/* Writes or reads the `size` low bytes of a number: 1, 2, 4 or 8.  The bytes
 * are written out, as compilers make one load or store of them. */
static inline void byte_codec_number(struct byte_codec *codec, uint64_t *value,
                                     size_t size) {
  if (codec->writes) {
    struct byte_array *bytes = &codec->bytes;
    if (bytes->capacity - bytes->count < sizeof *value &&
        !byte_codec_grow(codec))
      return;
    char *to = bytes->item + bytes->count;
    to[0] = (char)(*value & 0xff);
    to[1] = (char)(*value >> 8 & 0xff);
    to[2] = (char)(*value >> 16 & 0xff);
    to[3] = (char)(*value >> 24 & 0xff);
    to[4] = (char)(*value >> 32 & 0xff);
    to[5] = (char)(*value >> 40 & 0xff);
    to[6] = (char)(*value >> 48 & 0xff);
    to[7] = (char)(*value >> 56 & 0xff);
    bytes->count += size;
    return;
  }
  *value = 0;
  if (codec->failed || codec->left < size) {
    codec->failed = true;
    return;
  }
  const unsigned char *at = codec->at;
  if (size == 1)
    *value = at[0];
  else if (size == 2)
    *value = (uint64_t)at[0] | (uint64_t)at[1] << 8;
  else if (size == 4)
    *value = (uint64_t)at[0] | (uint64_t)at[1] << 8 | (uint64_t)at[2] << 16 |
             (uint64_t)at[3] << 24;
  else
    *value = (uint64_t)at[0] | (uint64_t)at[1] << 8 | (uint64_t)at[2] << 16 |
             (uint64_t)at[3] << 24 | (uint64_t)at[4] << 32 |
             (uint64_t)at[5] << 40 | (uint64_t)at[6] << 48 |
             (uint64_t)at[7] << 56;
  codec->at += size;
  codec->left -= size;
}

static inline void byte_codec_u8(struct byte_codec *codec, uint8_t *value) {
  uint64_t number = codec->writes ? *value : 0;
  byte_codec_number(codec, &number, 1);
  *value = (uint8_t)number;
}

static inline void byte_codec_u32(struct byte_codec *codec, uint32_t *value) {
  uint64_t number = codec->writes ? *value : 0;
  byte_codec_number(codec, &number, 4);
  *value = (uint32_t)number;
}

static inline void byte_codec_u64(struct byte_codec *codec, uint64_t *value) {
  byte_codec_number(codec, value, 8);
}

static inline void byte_codec_double(struct byte_codec *codec, double *value) {
  uint64_t bits = 0;
  if (codec->writes)
    memcpy(&bits, value, sizeof bits);
  byte_codec_number(codec, &bits, 8);
  memcpy(value, &bits, sizeof bits);
}

void byte_codec_i64(struct byte_codec *codec, int64_t *value);
void byte_codec_float(struct byte_codec *codec, float *value);
void byte_codec_bool(struct byte_codec *codec, bool *value);

/* Doubles that are finite. */
void byte_codec_doubles(struct byte_codec *codec, double *value, int count);

/* So many numbers of 32 bits. */
void byte_codec_numbers(struct byte_codec *codec, uint32_t *value,
                        size_t count);

/* ---- Records ------------------------------------------------------------
 * Consecutive numbers of a known size altogether: whether there is room, or
 * whether there are bytes, is tested once for all of them. */
struct byte_record {
  bool writes;
  unsigned char *to;         /* writing: the next number */
  const unsigned char *from; /* reading */
};

/* Makes room for `size` bytes; false when memory ran out. */
bool byte_codec_grow_by(struct byte_codec *codec, size_t size);

/* Writes or reads a record of `size` bytes, all of which the caller codes. */
static inline struct byte_record byte_codec_record(struct byte_codec *codec,
                                                   size_t size) {
  struct byte_record record = {codec->writes, codec->spare, codec->spare};
  if (codec->writes) {
    struct byte_array *bytes = &codec->bytes;
    if (bytes->capacity - bytes->count >= size ||
        byte_codec_grow_by(codec, size)) {
      record.to = (unsigned char *)bytes->item + bytes->count;
      bytes->count += size;
    }
  } else if (codec->failed || codec->left < size) {
    codec->failed = true;
  } else {
    record.from = codec->at;
    codec->at += size;
    codec->left -= size;
  }
  return record;
}

static inline void byte_record_u8(struct byte_record *record, uint8_t *value) {
  if (record->writes)
    *record->to++ = *value;
  else
    *value = *record->from++;
}

static inline void byte_record_u16(struct byte_record *record,
                                   uint16_t *value) {
  if (record->writes) {
    *record->to++ = (unsigned char)(*value & 0xff);
    *record->to++ = (unsigned char)(*value >> 8);
  } else {
    *value = (uint16_t)(record->from[0] | record->from[1] << 8);
    record->from += 2;
  }
}

static inline void byte_record_u32(struct byte_record *record,
                                   uint32_t *value) {
  if (record->writes) {
    unsigned char *to = record->to;
    uint32_t number = *value;
    to[0] = (unsigned char)(number & 0xff);
    to[1] = (unsigned char)(number >> 8 & 0xff);
    to[2] = (unsigned char)(number >> 16 & 0xff);
    to[3] = (unsigned char)(number >> 24);
    record->to += 4;
  } else {
    const unsigned char *from = record->from;
    *value = (uint32_t)from[0] | (uint32_t)from[1] << 8 |
             (uint32_t)from[2] << 16 | (uint32_t)from[3] << 24;
    record->from += 4;
  }
}

static inline void byte_record_u64(struct byte_record *record,
                                   uint64_t *value) {
  uint32_t low = (uint32_t)*value, high = (uint32_t)(*value >> 32);
  byte_record_u32(record, &low);
  byte_record_u32(record, &high);
  *value = (uint64_t)high << 32 | low;
}

static inline void byte_record_i64(struct byte_record *record, int64_t *value) {
  uint64_t number;
  memcpy(&number, value, sizeof number);
  byte_record_u64(record, &number);
  memcpy(value, &number, sizeof number);
}

static inline void byte_record_double(struct byte_record *record,
                                      double *value) {
  uint64_t bits;
  memcpy(&bits, value, sizeof bits);
  byte_record_u64(record, &bits);
  memcpy(value, &bits, sizeof bits);
}

/* Fails in reading where a condition does not hold. */
static inline void byte_codec_require(struct byte_codec *codec,
                                      bool condition) {
  codec->failed |= !codec->writes && !condition;
}

/* A parameter of an edge: in [0, 1], numbers below 2^126. */
void byte_codec_ratio(struct byte_codec *codec, struct ratio *value);

/* A number of items of at least `size` bytes each, of which there cannot be
 * more than there are bytes; 0 after a failure. */
void byte_codec_count(struct byte_codec *codec, size_t *count, size_t size);

/* Makes room for the items of a list that is read, and sets its count. */
#define BYTE_CODEC_LIST(codec, array, size)                                    \
  do {                                                                         \
    size_t count_ = (array)->count;                                            \
    byte_codec_count((codec), &count_, (size));                                \
    if (!(codec)->writes) {                                                    \
      if (!ARRAY_RESERVE((array), count_)) {                                   \
        (codec)->failed = (codec)->out_of_memory = true;                       \
        count_ = 0;                                                            \
      }                                                                        \
      (array)->count = count_;                                                 \
    }                                                                          \
  } while (0)

/* A text; in reading, allocated, the caller's to free, NULL after a failure.
 * It has no NUL within. */
void byte_codec_text(struct byte_codec *codec, char **text);

/* The checksum of 64 bits of so many bytes, by the polynomial of ECMA-182: each
 * change of up to 64 consecutive bits changes it. */
uint64_t byte_codec_checksum(const void *bytes, size_t count);

#endif
