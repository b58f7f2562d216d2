/* comma_locale.c - a locale whose decimal point is a comma. */
#include "tests/comma_locale.h"

#include <locale.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool has_comma(const char *name) {
  return setlocale(LC_NUMERIC, name) &&
         strcmp(localeconv()->decimal_point, ",") == 0;
}

/* Machines for building often have the C locale alone, but mostly the tool
 * that makes others. */
static bool make_locale(void) {
  char folder[] = "/tmp/recto-locale-XXXXXX";
  char command[512];
  if (!mkdtemp(folder))
    return false;
  snprintf(command, sizeof command,
           "cd %s && printf 'LC_NUMERIC\\ndecimal_point \",\"\\n"
           "thousands_sep \".\"\\ngrouping 3;3\\nEND LC_NUMERIC\\n' >source && "
           "localedef -c --no-archive -i source -f ANSI_X3.4-1968 ./comma "
           ">/dev/null 2>&1",
           folder);
  (void)!system(command);
  setenv("LOCPATH", folder, 1);
  bool made = has_comma("comma");
  unsetenv("LOCPATH");
  snprintf(command, sizeof command, "rm -rf %s", folder);
  (void)!system(command);
  return made;
}

bool comma_locale_on(void) {
  static const char *const installed[] = {"de_DE.UTF-8", "de_DE.utf8", "de_DE",
                                          "fr_FR.UTF-8", "ru_RU.UTF-8"};
  for (size_t i = 0; i < sizeof installed / sizeof *installed; i++)
    if (has_comma(installed[i]))
      return true;
  return make_locale();
}

void comma_locale_off(void) { setlocale(LC_NUMERIC, "C"); }
