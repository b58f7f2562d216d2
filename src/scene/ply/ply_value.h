/* ply_value.h - single values of a binary PLY file. */
#ifndef SCENE_PLY_PLY_VALUE_H
#define SCENE_PLY_PLY_VALUE_H

#include <math.h>
#include <string.h>

#include "scene/ply/ply_header.h"

/* Whether bytes in that order must be turned round on this machine. */
static inline bool ply_must_swap(enum ply_format format) {
#if defined __BYTE_ORDER__ && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  return format == PLY_LITTLE_ENDIAN;
#else
  return format == PLY_BIG_ENDIAN;
#endif
}

static inline uint16_t ply_load16(const char *at, bool swap) {
  uint16_t bits;
  memcpy(&bits, at, sizeof bits);
  return swap ? __builtin_bswap16(bits) : bits;
}

static inline uint32_t ply_load32(const char *at, bool swap) {
  uint32_t bits;
  memcpy(&bits, at, sizeof bits);
  return swap ? __builtin_bswap32(bits) : bits;
}

static inline double ply_load_float32(const char *at, bool swap) {
  uint32_t bits = ply_load32(at, swap);
  float value;
  memcpy(&value, &bits, sizeof value);
  return (double)value;
}

static inline double ply_load_float64(const char *at, bool swap) {
  uint64_t bits;
  double value;
  memcpy(&bits, at, sizeof bits);
  if (swap)
    bits = __builtin_bswap64(bits);
  memcpy(&value, &bits, sizeof value);
  return value;
}

/* The value as a double, which holds it exactly. */
static inline double ply_load(const char *at, enum ply_type type, bool swap) {
  switch (type) {
  case PLY_INT8:
    return (double)(signed char)*at;
  case PLY_UINT8:
    return (double)(unsigned char)*at;
  case PLY_INT16:
    return (double)(int16_t)ply_load16(at, swap);
  case PLY_UINT16:
    return (double)ply_load16(at, swap);
  case PLY_INT32:
    return (double)(int32_t)ply_load32(at, swap);
  case PLY_UINT32:
    return (double)ply_load32(at, swap);
  case PLY_FLOAT32:
    return ply_load_float32(at, swap);
  case PLY_FLOAT64:
    return ply_load_float64(at, swap);
  case PLY_NO_TYPE:
    break;
  }
  return 0;
}

/* A double as a whole number; -2 where it is none, or larger than any index or
 * count can be.  (-1 ends a strip.) */
static inline int64_t ply_whole(double value) {
  return value >= -1 && value <= 0x1p40 && value == floor(value)
             ? (int64_t)value
             : -2;
}

/* The value as an index or a count: see ply_whole. */
static inline int64_t ply_load_whole(const char *at, enum ply_type type,
                                     bool swap) {
  if (type == PLY_UINT8)
    return (unsigned char)*at;
  if (type == PLY_INT32)
    return (int32_t)ply_load32(at, swap);
  if (type == PLY_UINT32)
    return ply_load32(at, swap);
  return ply_whole(ply_load(at, type, swap));
}

#endif
