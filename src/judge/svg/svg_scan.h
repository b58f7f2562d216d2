/* svg_scan.h - tags, attributes, numbers and transforms of an SVG file.
 *
 * Numbers are read by code of its own, not by the library's, so that an error
 * in writing them cannot be masked by the same error in reading. */
#ifndef JUDGE_SVG_SVG_SCAN_H
#define JUDGE_SVG_SVG_SCAN_H

#include <stdbool.h>

#include "judge/triangles.h"

/* A part of the file: a pointer to it and past it. */
struct svg_text {
  const char *at, *end;
};

enum svg_tag_kind { SVG_TAG_OPEN, SVG_TAG_CLOSE, SVG_TAG_WHOLE };

struct svg_tag {
  enum svg_tag_kind kind;
  struct svg_text name; /* without a prefix svg: */
  struct svg_text rest; /* its attributes */
};

/* Finds the next tag; comments, declarations and text are skipped.
 * broken  set where the file ends within a tag
 * Returns false at the end. */
bool svg_next_tag(struct svg_text *file, struct svg_tag *tag, bool *broken);

bool svg_is(struct svg_text text, const char *word);
struct svg_text svg_trim(struct svg_text text);
/* The next word of a list with blanks between; false where there is none. */
bool svg_next_word(struct svg_text *list, struct svg_text *word);

/* The attribute of that name. */
bool svg_attribute(const struct svg_tag *tag, const char *name,
                   struct svg_text *value);
/* The property of that name: of the style attribute, or an attribute. */
bool svg_property(const struct svg_tag *tag, const char *name,
                  struct svg_text *value);

void svg_skip_spaces(struct svg_text *text); /* and commas */
/* Reads a number, after spaces; false where there is none, or one that is too
 * large for a double. */
bool svg_number(struct svg_text *text, double *value);
/* Converts a length to mm; without a unit it is in pixels, 96 to the inch.
 * False for percentages and what is no length. */
bool svg_length_mm(struct svg_text text, double *mm);

/* x' = a x + c y + e, y' = b x + d y + f */
struct svg_matrix {
  double a, b, c, d, e, f;
};

struct judge_point2 svg_apply(const struct svg_matrix *m, double x, double y);
/* The matrix that applies n, then m. */
struct svg_matrix svg_product(const struct svg_matrix *m,
                              const struct svg_matrix *n);
/* Reads a list of transforms; false on a syntax error. */
bool svg_transform(struct svg_text text, struct svg_matrix *matrix);

#endif
