/* text.c - text as strokes of a pen, in Hershey's simplex Roman font.
 *
 * The font has the characters of ASCII.  Letters with accents are put together
 * of a letter and a mark, in units of the font. */
#include "drawing/text.h"

#include <string.h>

#include "base/utf8.h"
#include "drawing/simplex.h"

/* ---- Glyphs -------------------------------------------------------------- */

/* What a character is drawn by: a letter, and a mark above or below it. */
struct glyph {
  const char *letter; /* as in simplex.h */
  const char *mark;   /* the same without bounds; NULL: none */
  int up;             /* of the mark, in units */
};

/* Marks above a letter of the height of an x, y from -12 to -8: about x = 'R'.
 * A capital has them 8 units higher. */
static const struct {
  char name;
  const char *lines;
} marks[] = {
    {'`', "PFSJ"},         {'\'', "TFQJ"},      {'^', "NJRFVJ"},
    {'~', "MIOGQGSIUIWG"}, {':', "NGNH RVGVH"}, {'o', "RFPGPIRJTITGRF"},
    {',', "R[S]Q_O_"},     {'/', "KaYD"},
};

/* The letters of U+00C0 to U+00FF and their marks; a space: no letter, or no
 * mark. */
static const char letters[] = "AAAAAA CEEEEIIII NOOOOO OUUUUY  "
                              "aaaaaa ceeeeiiii nooooo ouuuuy y";
static const char accents[] = "`'^~:o ,`'^:`'^: ~`'^~: /`'^:'  "
                              "`'^~:o ,`'^:`'^: ~`'^~: /`'^:' :";
/* The i without its dot, which gives way to a mark, and the sharp s, which the
 * font does not have. */
static const char dotless_i[] = "NVRMR[";
static const char sharp_s[] = "HYL[LLMIOGRFTFVGWIWKVMTNRO RTNWPXRXUWXUZS[Q[OZ";
enum { SHARP_S = 0xDF, DEGREE = 0xB0, LATIN = 0xC0, LATIN_END = 0x100 };

static bool find_glyph(uint32_t code, struct glyph *glyph) {
  *glyph = (struct glyph){NULL, NULL, 0};
  if (code >= SIMPLEX_FIRST && code < SIMPLEX_FIRST + SIMPLEX_GLYPHS - 1)
    glyph->letter = simplex_glyph[code - SIMPLEX_FIRST];
  else if (code == DEGREE)
    glyph->letter = simplex_glyph[SIMPLEX_GLYPHS - 1];
  else if (code == SHARP_S)
    glyph->letter = sharp_s;
  if (code < LATIN || code >= LATIN_END || letters[code - LATIN] == ' ')
    return glyph->letter != NULL;
  char letter = letters[code - LATIN], accent = accents[code - LATIN];
  glyph->letter =
      letter == 'i' ? dotless_i : simplex_glyph[letter - SIMPLEX_FIRST];
  for (size_t i = 0; i < sizeof marks / sizeof marks[0]; i++)
    if (marks[i].name == accent)
      glyph->mark = marks[i].lines;
  glyph->up = letter < 'a' && accent != ',' && accent != '/' ? 8 : 0;
  return true;
}

/* ---- Text ---------------------------------------------------------------- */

recto_status text_check(const char *text, const char *what,
                        recto_error *error) {
  struct glyph glyph;
  while (*text != '\0') {
    uint32_t code;
    size_t length = utf8_measure(text, &code);
    if (length == 0)
      return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                       "%s is no text in UTF-8, and is to be drawn", what);
    if (!find_glyph(code, &glyph))
      return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                       "%s is to be drawn, and the font has no \"%.*s\" "
                       "(U+%04lX)",
                       what, code < ' ' ? 0 : (int)length, text,
                       (unsigned long)code);
    text += length;
  }
  return RECTO_OK;
}

/* The next character of a text that is valid; false at its end. */
static bool next_glyph(const char **text, struct glyph *glyph) {
  uint32_t code;
  if (**text == '\0')
    return false;
  size_t length = utf8_measure(*text, &code);
  *text += length > 0 ? length : 1;
  if (length == 0 || !find_glyph(code, glyph))
    glyph->letter = simplex_glyph[0];
  return true;
}

static int bound_of(const struct glyph *glyph, int side) {
  return glyph->letter[side] - 'R';
}

double text_width_mm(const struct text_line *line) {
  const char *text = line->text;
  struct glyph glyph;
  int units = 0;
  while (next_glyph(&text, &glyph))
    units += bound_of(&glyph, 1) - bound_of(&glyph, 0);
  return units * line->height_mm / SIMPLEX_CAPITAL;
}

/* Where the middle of a glyph is, and the mm of a unit. */
struct place {
  double x, y, unit_mm;
  uint32_t layer;
};

static bool end_text_stroke(struct drawing *drawing,
                            struct drawing_stroke *stroke) {
  stroke->count = (uint32_t)drawing->point.count - stroke->point;
  bool ok = stroke->count < 2 || ARRAY_PUSH(&drawing->stroke, *stroke);
  stroke->point = (uint32_t)drawing->point.count;
  return ok;
}

static bool add_polylines(struct drawing *drawing, const char *lines, int up,
                          const struct place *place) {
  struct drawing_stroke stroke = {.point = (uint32_t)drawing->point.count,
                                  .layer = place->layer,
                                  .face = DRAWING_NONE,
                                  .edge = DRAWING_NONE,
                                  .group = DRAWING_NONE,
                                  .text = true};
  bool ok = true;
  for (; ok && lines[0] != '\0' && lines[1] != '\0'; lines += 2) {
    const struct drawing_point p = {
        place->x + (lines[0] - 'R') * place->unit_mm,
        place->y + (SIMPLEX_BASELINE - (lines[1] - 'R') + up) * place->unit_mm};
    ok = lines[0] == ' ' ? end_text_stroke(drawing, &stroke)
                         : ARRAY_PUSH(&drawing->point, p);
  }
  return ok && end_text_stroke(drawing, &stroke);
}

bool text_add(struct drawing *drawing, uint32_t layer,
              const struct text_line *line, struct drawing_point at) {
  const char *text = line->text;
  struct place place = {at.x, at.y, line->height_mm / SIMPLEX_CAPITAL, layer};
  struct glyph glyph;
  bool ok = true;
  while (ok && next_glyph(&text, &glyph)) {
    place.x -= bound_of(&glyph, 0) * place.unit_mm;
    ok = add_polylines(drawing, glyph.letter + 2, 0, &place);
    if (ok && glyph.mark != NULL)
      ok = add_polylines(drawing, glyph.mark, glyph.up, &place);
    place.x += bound_of(&glyph, 1) * place.unit_mm;
  }
  return ok;
}
