/* hpgl_reader.c - see hpgl_reader.h. */
#include "tests/hpgl_reader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"

struct reader {
  struct hpgl *hpgl;
  const char *at, *end;
  unsigned pen;   /* held */
  bool lifted;    /* by a bare PU since the last ink */
  bool travelled; /* a PUx,y stands without ink */
  bool drawing;   /* the current stroke may continue */
};

static void complain(struct reader *reader, const char *what) {
  struct hpgl *hpgl = reader->hpgl;
  if (hpgl->fault[0] == '\0')
    snprintf(hpgl->fault, sizeof hpgl->fault, "%s before: %.40s", what,
             reader->at);
}

static void need(bool ok) {
  if (!ok)
    abort();
}

/* Moves past `word` where it stands here. */
static bool take(struct reader *reader, const char *word) {
  size_t length = strlen(word);
  if ((size_t)(reader->end - reader->at) < length ||
      memcmp(reader->at, word, length) != 0)
    return false;
  reader->at += length;
  return true;
}

static int64_t take_int(struct reader *reader) {
  int64_t value = 0;
  const char *after = number_parse_int(reader->at, reader->end, &value);
  if (after == NULL || *reader->at == '+') {
    complain(reader, "no number");
    return 0;
  }
  reader->at = after;
  return value;
}

static struct hpgl_point take_pair(struct reader *reader) {
  struct hpgl_point point;
  point.x = (int32_t)take_int(reader);
  if (!take(reader, ","))
    complain(reader, "no comma");
  point.y = (int32_t)take_int(reader);
  return point;
}

static void end_command(struct reader *reader) {
  if (!take(reader, ";\n"))
    complain(reader, "no end of a command");
}

static void read_up(struct reader *reader) {
  struct hpgl *hpgl = reader->hpgl;
  if (reader->travelled)
    complain(reader, "travel without ink");
  reader->drawing = false;
  reader->lifted = take(reader, ";\n");
  if (reader->lifted)
    return;
  struct hpgl_stroke stroke = {reader->pen, (uint32_t)hpgl->point.count, 1};
  need(ARRAY_PUSH(&hpgl->stroke, stroke));
  need(ARRAY_PUSH(&hpgl->point, take_pair(reader)));
  end_command(reader);
  if (reader->pen == 0)
    complain(reader, "travel without a pen");
  reader->travelled = true;
  reader->drawing = true;
}

static void read_down(struct reader *reader) {
  struct hpgl *hpgl = reader->hpgl;
  size_t points = 0;
  if (!reader->drawing) {
    complain(reader, "ink before travel");
    return;
  }
  do {
    need(ARRAY_PUSH(&hpgl->point, take_pair(reader)));
    hpgl->stroke.item[hpgl->stroke.count - 1].count++;
    points++;
  } while (take(reader, ","));
  end_command(reader);
  if (points > hpgl->longest)
    hpgl->longest = points;
  reader->travelled = false;
}

static void read_pen(struct reader *reader) {
  if (reader->pen != 0 && !reader->lifted)
    complain(reader, "pen changed while down");
  reader->pen = (unsigned)take_int(reader);
  end_command(reader);
  reader->lifted = false;
  reader->drawing = false;
  if (reader->pen != 0)
    need(ARRAY_PUSH(&reader->hpgl->pen, reader->pen));
}

static void read_end(struct reader *reader) {
  if (reader->pen != 0 || reader->at != reader->end)
    complain(reader, "end before the pen is put back, or not the end");
}

void hpgl_read(struct hpgl *hpgl, const char *text, size_t count) {
  struct reader reader = {.hpgl = hpgl, .at = text, .end = text + count};
  *hpgl = (struct hpgl){0};
  bool ended = false;
  if (!take(&reader, "IN;\nDF;\n"))
    complain(&reader, "no IN;DF;");
  if (take(&reader, "VS")) {
    hpgl->velocity = (int)take_int(&reader);
    end_command(&reader);
  }
  while (!ended && hpgl->fault[0] == '\0') {
    if (take(&reader, "PU")) {
      read_up(&reader);
    } else if (take(&reader, "PD")) {
      read_down(&reader);
    } else if (take(&reader, "SP")) {
      read_pen(&reader);
    } else if (take(&reader, "IN;\n")) {
      read_end(&reader);
      ended = true;
    } else {
      complain(&reader, "an unknown command");
    }
  }
}

void hpgl_free(struct hpgl *hpgl) {
  ARRAY_FREE(&hpgl->stroke);
  ARRAY_FREE(&hpgl->point);
  ARRAY_FREE(&hpgl->pen);
}
