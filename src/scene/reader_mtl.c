/* reader_mtl.c - Wavefront material libraries: names and their diffuse
 * colours, nothing else of them. */
#include "scene/material.h"

#include <math.h>
#include <string.h>

#include "base/number.h"

static bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

static const char *skip_blanks(const char *at, const char *end) {
  while (at < end && is_blank(*at))
    at++;
  return at;
}

/* What follows the keyword where the statement [at, end) opens with it; else
 * NULL. */
static const char *follow_keyword(const char *at, const char *end,
                                  const char *keyword) {
  size_t length = strlen(keyword);
  if ((size_t)(end - at) <= length || memcmp(at, keyword, length) != 0 ||
      !is_blank(at[length]))
    return NULL;
  return skip_blanks(at + length, end);
}

/* Kd r g b, or Kd r where all three are alike; false where it is not that. */
static bool parse_colour(const char *at, const char *end, uint32_t *colour) {
  double part[3];
  int parts = 0;
  for (; parts < 3 && at < end && *at != '#'; parts++) {
    const char *stop = number_parse_double(at, end, &part[parts]);
    if (!stop || (stop < end && !is_blank(*stop)) || isnan(part[parts]))
      return false;
    at = skip_blanks(stop, end);
  }
  if ((parts != 1 && parts != 3) || (at < end && *at != '#'))
    return false;
  *colour = 0;
  for (int k = 0; k < 3; k++) {
    double share = fmin(fmax(part[parts == 3 ? k : 0], 0), 1);
    *colour = *colour << 8 | (uint32_t)lround(share * 255);
  }
  return true;
}

/* Takes one statement, without the blanks around it. */
static recto_status read_statement(struct scene *palette, const char *at,
                                   const char *end, unsigned long line,
                                   struct diagnostics *diagnostics,
                                   recto_error *error) {
  const char *rest = follow_keyword(at, end, "newmtl");
  if (rest)
    return scene_use_group(palette, rest, (size_t)(end - rest), error);
  rest = follow_keyword(at, end, "Kd");
  if (!rest || palette->group.count == 0)
    return RECTO_OK;
  struct scene_group *material = &palette->group.item[palette->current_group];
  uint32_t colour;
  if (!parse_colour(rest, end, &colour)) {
    diagnostics_fault(diagnostics, SCENE_FAULT_MATERIAL, line,
                      "Kd that is no colour, skipped");
  } else if (!material->has_colour) {
    material->colour = colour;
    material->has_colour = true;
  }
  return RECTO_OK;
}

recto_status material_read(struct scene *palette, const char *bytes,
                           size_t count, struct diagnostics *diagnostics,
                           recto_error *error) {
  const char *at = bytes, *end = bytes + count;
  recto_status status = RECTO_OK;
  for (unsigned long line = 1; status == RECTO_OK && at < end; line++) {
    const char *stop = memchr(at, '\n', (size_t)(end - at));
    const char *next = stop ? stop + 1 : end;
    stop = stop ? stop : end;
    at = skip_blanks(at, stop);
    while (stop > at && is_blank(stop[-1]))
      stop--;
    status = read_statement(palette, at, stop, line, diagnostics, error);
    at = next;
  }
  return status;
}
