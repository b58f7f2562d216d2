/* hpgl_reader.h - reads the dialect of HPGL that recto writes, and reports
 * anything else as a fault. */
#ifndef TESTS_HPGL_READER_H
#define TESTS_HPGL_READER_H

#include "base/memory.h"

struct hpgl_stroke {
  unsigned pen;
  uint32_t point, count;
};

struct hpgl_point {
  int32_t x, y;
};

struct hpgl {
  ARRAY(struct hpgl_stroke) stroke;
  ARRAY(struct hpgl_point) point;
  ARRAY(unsigned) pen; /* in the order in which they were taken */
  int velocity;        /* of VS; 0: none */
  size_t longest;      /* most points in one PD */
  char fault[128];     /* "" where the file is in the dialect */
};

/* Reads `count` bytes.
 * Held to: IN;DF;[VSn;] at the start, PU;SP0;IN; at the end; a command a line;
 * only PU, PD and SP between; whole numbers; a PU before every SP but the
 * first; pens up to travel, and every PUx,y followed by ink. */
void hpgl_read(struct hpgl *hpgl, const char *text, size_t count);

void hpgl_free(struct hpgl *hpgl);

#endif
