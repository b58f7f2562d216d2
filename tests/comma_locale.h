/* comma_locale.h - a locale whose decimal point is a comma. */
#ifndef TESTS_COMMA_LOCALE_H
#define TESTS_COMMA_LOCALE_H

#include <stdbool.h>

/* Switches to such a locale: one that is installed or, where none is, one made
 * for the purpose.  False where neither can be had. */
bool comma_locale_on(void);

/* Back to the C locale. */
void comma_locale_off(void);

#endif
