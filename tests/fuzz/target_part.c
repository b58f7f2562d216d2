/* target_part.c - the file of the one part of a drawing, of any bytes: refused
 * with a reason, or joined and inked.  Size and checksum are made right first,
 * as whoever means harm would. */
#define _GNU_SOURCE
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "parts/byte_codec.h"
#include "recto.h"
#include "tests/fuzz/fuzz.h"

enum { SIZE_AT = 12, SUM_SIZE = 8, LEAST = SIZE_AT + 8 + SUM_SIZE };

static void put_u64(uint8_t *to, uint64_t value) {
  for (int i = 0; i < 8; i++)
    to[i] = (uint8_t)(value >> 8 * i);
}

/* What the drawing is to have. */
struct join_mode {
  recto_fill fill;
  recto_hidden hidden;
  int limit; /* of hiding faces */
  bool ids;
  double light[3];
};

static void join(const char *path, const struct join_mode *mode,
                 struct fuzz_finding *finding) {
  const char *const paths[1] = {path};
  recto_drawing *drawing = NULL;
  recto_options options;
  recto_error error = {0};
  recto_options_init(&options);
  options.ink.fill = mode->fill;
  options.ink.hidden = mode->hidden;
  options.ink.hidden_by_max = mode->limit;
  options.ink.ids = mode->ids;
  memcpy(options.ink.light, mode->light, sizeof mode->light);
  recto_status status = recto_join_parts(paths, 1, &options, &drawing, &error);
  if ((status == RECTO_OK) != (drawing != NULL))
    fuzz_found(finding, "status %d and %s drawing", (int)status,
               drawing != NULL ? "a" : "no");
  if (status != RECTO_OK && error.text[0] == '\0')
    fuzz_found(finding, "refused without a reason");
  recto_drawing_destroy(drawing);
}

/* With a limit, ids and a light: those of inputs of the corpus. */
static const struct join_mode modes[] = {
    {.fill = RECTO_FILL_NONE},
    {.fill = RECTO_FILL_SHADE, .hidden = RECTO_HIDDEN_DASHED},
    {.hidden = RECTO_HIDDEN_LAYER, .limit = 1},
    {.ids = true},
    {.fill = RECTO_FILL_HATCH, .light = {-1, 2, 1}}};

static void run(const uint8_t *bytes, size_t count,
                struct fuzz_finding *finding) {
  char path[40];
  uint8_t *own = malloc(count + 1);
  int file = memfd_create("part", 0);
  if (own == NULL || file < 0)
    abort();
  if (count > 0)
    memcpy(own, bytes, count);
  if (count >= LEAST) {
    put_u64(own + SIZE_AT, count);
    put_u64(own + count - SUM_SIZE, byte_codec_checksum(own, count - SUM_SIZE));
  }
  if (write(file, own, count) != (ssize_t)count)
    abort();
  snprintf(path, sizeof path, "/proc/self/fd/%d", file);
  for (size_t i = 0; i < sizeof modes / sizeof *modes; i++)
    join(path, &modes[i], finding);
  close(file);
  free(own);
}

const struct fuzz_target fuzz_target_part = {"part", run, NULL};
