/* length.c - units of length on paper. */
#include "base/length.h"

#include <string.h>

double length_unit_mm(const char *text, const char *end) {
  static const struct {
    const char *name;
    double mm;
  } unit[] = {{"", 1}, {"mm", 1}, {"cm", 10}, {"in", 25.4}, {"pt", 25.4 / 72}};
  size_t length = (size_t)(end - text);
  for (size_t i = 0; i < sizeof unit / sizeof unit[0]; i++)
    if (strlen(unit[i].name) == length &&
        memcmp(unit[i].name, text, length) == 0)
      return unit[i].mm;
  return 0;
}
