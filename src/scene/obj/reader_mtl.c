/* reader_mtl.c - Wavefront material libraries: names and their diffuse
 * colours, nothing else of them. */
#include "scene/obj/material.h"

#include <math.h>
#include <string.h>

#include "base/number.h"
#include "base/word.h"
#include "scene/diagnostics.h"

static const char *after_blanks(const char *at, const char *end) {
  while (at < end && is_blank(*at))
    at++;
  return at;
}

/* What follows the keyword, which may be nothing, where the statement [at, end)
 * opens with it; else NULL. */
static const char *follow_keyword(const char *at, const char *end,
                                  const char *keyword) {
  size_t length = strlen(keyword), count = (size_t)(end - at);
  if (count < length || memcmp(at, keyword, length) != 0 ||
      (count > length && !is_blank(at[length])))
    return NULL;
  return after_blanks(at + length, end);
}

/* Kd r g b, or Kd r where all three are alike; false where it is not that. */
static bool parse_colour(const char *at, const char *end, uint32_t *colour) {
  double part[3];
  int parts = 0;
  for (; parts < 3 && at < end && *at != '#'; parts++) {
    const char *stop = number_parse_double(at, end, &part[parts]);
    if (stop == NULL || (stop < end && !is_blank(*stop)) ||
        !isfinite(part[parts]))
      return false;
    at = after_blanks(stop, end);
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

/* A library as it is read. */
struct library {
  struct scene *palette;
  uint32_t first;    /* of its own materials in the palette */
  uint32_t material; /* that statements are about; SCENE_NONE */
  unsigned long line;
  struct diagnostics *diagnostics;
  recto_error *error;
};

static void warn_of_statement(const struct library *library, const char *text) {
  diagnostics_fault(library->diagnostics, SCENE_FAULT_MATERIAL, library->line,
                    "%s", text);
}

/* What several libraries have, the first gives; within one it is a mistake. */
static recto_status begin_material(struct library *library, const char *name,
                                   const char *end) {
  struct scene *palette = library->palette;
  size_t known = palette->group.count;
  library->material = SCENE_NONE;
  if (name == end) {
    warn_of_statement(library, "newmtl without a name, skipped");
    return RECTO_OK;
  }
  recto_status status =
      scene_use_group(palette, name, (size_t)(end - name), library->error);
  if (status != RECTO_OK)
    return status;
  library->material = palette->current_group;
  if (palette->group.count == known && library->material >= library->first)
    diagnostics_fault(library->diagnostics, SCENE_FAULT_MATERIAL, library->line,
                      "newmtl %.80s is defined again; its first Kd is used",
                      palette->group.item[library->material].name);
  return RECTO_OK;
}

static void store_colour(const struct library *library, const char *at,
                         const char *end) {
  uint32_t colour;
  if (library->material == SCENE_NONE) {
    warn_of_statement(library, "Kd of no material, skipped");
    return;
  }
  struct scene_group *material =
      &library->palette->group.item[library->material];
  if (!parse_colour(at, end, &colour)) {
    warn_of_statement(library, "Kd that is no colour, skipped");
  } else if (!material->has_colour) {
    material->colour = colour;
    material->has_colour = true;
  }
}

/* Takes one statement, without the blanks around it. */
static recto_status read_mtl_statement(struct library *library, const char *at,
                                       const char *end) {
  const char *rest = follow_keyword(at, end, "newmtl");
  if (rest != NULL)
    return begin_material(library, rest, end);
  rest = follow_keyword(at, end, "Kd");
  if (rest != NULL)
    store_colour(library, rest, end);
  return RECTO_OK;
}

static bool is_text(const char *at, const char *end) {
  for (; at < end; at++)
    if ((unsigned char)*at < ' ' && !is_blank(*at))
      return false;
  return true;
}

recto_status material_read(struct scene *palette, const char *bytes,
                           size_t count, struct diagnostics *diagnostics,
                           recto_error *error) {
  static const char byte_order_mark[] = "\xef\xbb\xbf";
  struct library library = {palette,     (uint32_t)palette->group.count,
                            SCENE_NONE,  1,
                            diagnostics, error};
  const char *at = bytes, *end = bytes + count;
  recto_status status = RECTO_OK;
  if (count >= 3 && memcmp(at, byte_order_mark, 3) == 0)
    at += 3;
  for (; status == RECTO_OK && at < end; library.line++) {
    const char *stop = memchr(at, '\n', (size_t)(end - at));
    const char *next = stop != NULL ? stop + 1 : end;
    stop = stop != NULL ? stop : end;
    at = after_blanks(at, stop);
    while (stop > at && is_blank(stop[-1]))
      stop--;
    if (!is_text(at, stop)) {
      warn_of_statement(&library,
                        "not text: the rest of the library is not read");
      return RECTO_OK;
    }
    status = read_mtl_statement(&library, at, stop);
    at = next;
  }
  return status;
}
