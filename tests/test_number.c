/* test_number.c - numbers are read to the nearest double and written short,
 * whatever the locale. */
#include <fenv.h>
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/digits.h"
#include "base/number.h"
#include "base/sanitizer.h"
#include "tests/comma_locale.h"
#include "tests/scenes/random.h"
#include "tests/valgrind.h"

/* As many samples as the tools that slow us down leave time for. */
static int samples(int count) {
#if SANITIZER_OF_ADDRESSES
  count /= 5;
#endif
  return is_under_valgrind() ? count / 100 : count;
}

static double double_of(uint64_t bits) {
  double value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

static uint64_t bits_of(double value) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  return bits;
}

static double random_finite(struct random *random) {
  double value;
  do
    value = double_of(random_next(random));
  while (!isfinite(value));
  return value;
}

/* ---- Reading ------------------------------------------------------------- */

static double parse(const char *text) {
  double value = -12345;
  const char *end = text + strlen(text);
  if (number_parse_double(text, end, &value) != end)
    fail_msg("'%s' is not read to its end", text);
  return value;
}

static void assert_reads(const char *text, double expected) {
  double value = parse(text);
  if (bits_of(value) != bits_of(expected))
    fail_msg("'%s' is read as %a, not %a", text, value, expected);
}

static void put_digits(struct random *random, char **text, int count) {
  while (count-- > 0)
    *(*text)++ = (char)('0' + random_below(random, 10));
}

/* Any digits, with a point anywhere among them and any exponent. */
static void make_odd_number(struct random *random, char *text) {
  if (random_below(random, 2))
    *text++ = "+-"[random_below(random, 2)];
  int before = random_int(random, 0, 25), after = random_int(random, 0, 25);
  put_digits(random, &text, before + (before + after == 0));
  if (after || random_below(random, 2))
    *text++ = '.';
  put_digits(random, &text, after);
  *text = '\0';
  if (random_below(random, 2))
    sprintf(text, "%c%d", "eE"[random_below(random, 2)],
            random_int(random, -360, 340));
}

/* One of the ways in which programs write numbers, and some in which they do
 * not. */
static void make_number(struct random *random, int kind, char *text) {
  double value = random_finite(random);
  double near =
      random_between(random, -1, 1) * pow(10, random_int(random, -20, 20));
  int precision = random_int(random, 0, 20);
  switch (kind) {
  case 0:
    sprintf(text, "%.*e", precision, value);
    break;
  case 1:
    sprintf(text, "%.*e", precision, near);
    break;
  case 2:
    sprintf(text, "%.*f", precision, near);
    break;
  case 3:
    sprintf(text, "%.*g", precision, near);
    break;
  default:
    make_odd_number(random, text);
    break;
  }
}

static void a_million_numbers_are_read_as_strtod_reads_them(void **state) {
  (void)state;
  struct random random = {1};
  char text[512];
  for (int i = 0; i < samples(1000000); i++) {
    make_number(&random, i % 5, text);
    assert_reads(text, strtod(text, NULL));
  }
}

/* The text of the number halfway from `value` to the double above it. */
static bool write_halfway(double value, char *text, size_t size) {
  double above = nextafter(value, INFINITY);
  long double halfway = ((long double)value + above) / 2;
  if (halfway == value || halfway == above || isinf(above))
    return false;
  snprintf(text, size, "%.1100Le", halfway);
  return true;
}

/* Puts digits that make the number a little larger, or smaller, before its
 * exponent.  The fraction is known to end in zeros. */
static void nudge(const char *text, bool up, char *nudged) {
  const char *exponent = strchr(text, 'e');
  size_t length = (size_t)(exponent - text);
  memcpy(nudged, text, length);
  if (up) {
    nudged[length - 1] = '1';
  } else {
    size_t i = length - 1;
    for (; nudged[i] == '0'; i--)
      nudged[i] = '9';
    nudged[i]--;
  }
  strcpy(nudged + length, exponent);
}

static void assert_halfway(double value) {
  char text[1200], nudged[1200];
  if (!write_halfway(value, text, sizeof text))
    return;
  double above = nextafter(value, INFINITY);
  assert_reads(text, bits_of(value) % 2 == 0 ? value : above);
  nudge(text, true, nudged);
  assert_reads(nudged, above);
  nudge(text, false, nudged);
  assert_reads(nudged, value);
}

static void halfway_goes_to_even_and_a_hair_beside_it_does_not(void **state) {
  (void)state;
  if (LDBL_MANT_DIG < 64)
    skip();
  struct random random = {2};
  for (int i = 0; i < samples(20000); i++)
    assert_halfway(fabs(random_finite(&random)));
  for (int i = 0; i < samples(2000); i++)
    assert_halfway(double_of(random_next(&random) >> 12)); /* subnormal */
  assert_halfway(0);
  assert_halfway(DBL_MIN);
  assert_halfway(nextafter(DBL_MIN, 0));
}

/* Of 17 digits and small exponents: the 128-bit path has its own. */
static void short_halfway_numbers_go_to_even(void **state) {
  (void)state;
  assert_reads("9007199254740993", 9007199254740992.0);
  assert_reads("9007199254740993.0", 9007199254740992.0);
  assert_reads("9007199254740993.00000000000000000000000000001",
               9007199254740994.0);
  assert_reads("9007199254740995", 9007199254740996.0);
  assert_reads("900719925474099.3e1", 9007199254740992.0);
  assert_reads("90071992547409930000000e-7", 9007199254740992.0);
  assert_reads("4503599627370496.5", 4503599627370496.0);
  assert_reads("4503599627370497.5", 4503599627370498.0);
  assert_reads("1.00000000000000011102230246251565404", 1.0);
  assert_reads("1.000000000000000111022302462515654042363166809082031250", 1.0);
  assert_reads("1.000000000000000111022302462515654042363166809082031251",
               1.0 + DBL_EPSILON);
}

static void the_ends_of_the_range_are_exact(void **state) {
  (void)state;
  assert_reads("1.7976931348623157e308", DBL_MAX);
  assert_reads("1.7976931348623158e308", DBL_MAX);
  assert_reads("1.7976931348623159e308", INFINITY);
  assert_reads("-1.8e308", -INFINITY);
  assert_reads("2.2250738585072014e-308", DBL_MIN);
  assert_reads("2.2250738585072011e-308", nextafter(DBL_MIN, 0));
  assert_reads("4.9406564584124654e-324", 0x1p-1074);
  assert_reads("2.4703282292062328e-324", 0x1p-1074);
  assert_reads("2.4703282292062327e-324", 0);
  assert_reads("-2e-324", -0.0);
}

static void exponents_of_any_length_are_read(void **state) {
  (void)state;
  assert_reads("1e99999999999999999999999999", INFINITY);
  assert_reads("-1e99999999999999999999999999", -INFINITY);
  assert_reads("1e-99999999999999999999999999", 0);
  assert_reads("0e99999999999999999999999999", 0);
  assert_reads("-0.000e-5", -0.0);
  assert_reads("1e0000000000000000000000000002", 100);
}

static void digits_of_any_number_are_read(void **state) {
  (void)state;
  char text[4096];
  memset(text, '0', sizeof text);
  text[0] = '1';
  strcpy(text + 2001, "e-2000");
  assert_reads(text, 1);
  memset(text, '0', sizeof text);
  text[1] = '.';
  strcpy(text + 2000, "15e1999");
  assert_reads(text, 1.5);
  memset(text, '9', sizeof text);
  text[1] = '.';
  text[3000] = '\0';
  assert_reads(text, 10);
  /* Halfway, and then a digit past those that are kept. */
  strcpy(text, "9007199254740993.");
  memset(text + 17, '0', 2000);
  strcpy(text + 2017, "1");
  assert_reads(text, 9007199254740994.0);
}

struct stop {
  const char *text;
  size_t length; /* of the number at its start; 0: none */
  double value;
};

static void reading_stops_where_the_number_does(void **state) {
  (void)state;
  static const struct stop stops[] = {
      {"1.5x", 3, 1.5},
      {"1e", 1, 1},
      {"1e+", 1, 1},
      {"1e+x", 1, 1},
      {"2.e3", 4, 2000},
      {".5", 2, 0.5},
      {"5.", 2, 5},
      {"1..2", 2, 1},
      {"0x10", 1, 0},
      {"1,5", 1, 1},
      {"+7 8", 2, 7},
      {"--1", 0, 0},
      {"+-1", 0, 0},
      {"", 0, 0},
      {".", 0, 0},
      {"-", 0, 0},
      {"-.", 0, 0},
      {".e3", 0, 0},
      {"e3", 0, 0},
      {" 1", 0, 0},
      {"x", 0, 0},
      {"12345678", 8, 12345678},
      {"0.12345678/", 10, 0.12345678},
      {"1.#IND", 2, 1},
  };
  for (size_t i = 0; i < sizeof stops / sizeof *stops; i++) {
    const struct stop *stop = &stops[i];
    const char *end = stop->text + strlen(stop->text);
    double value = 99;
    const char *stopped = number_parse_double(stop->text, end, &value);
    if (stop->length == 0) {
      assert_null(stopped);
    } else {
      assert_ptr_equal(stopped, stop->text + stop->length);
      assert_true(value == stop->value);
    }
  }
}

/* In a block that ends where the text does, so that a sanitizer or valgrind
 * sees a look past it. */
static void nothing_is_read_past_the_end(void **state) {
  (void)state;
  static const char text[] = "-1234567890.123456789012345e-12";
  for (size_t length = 1; length < sizeof text; length++) {
    char *block = malloc(length);
    char copy[sizeof text] = {0};
    assert_non_null(block);
    memcpy(block, text, length);
    memcpy(copy, text, length);
    double value = 0, expected = strtod(copy, NULL);
    const char *stop = number_parse_double(block, block + length, &value);
    if (length > 1) {
      assert_non_null(stop);
      assert_true(value == expected);
    } else {
      assert_null(stop);
    }
    int64_t integer;
    (void)number_parse_int(block, block + length, &integer);
    free(block);
  }
}

#if DIGITS_CHUNKS
static void plain_numbers_are_read_as_all_others(void **state) {
  struct random random = {7};
  int plain = 0;
  (void)state;
  for (int i = 0; i < samples(300000); i++) {
    char text[2 * NUMBER_PLAIN_ROOM + 40] = "", *at = text;
    double value = 0, expected;
    if (i % 3 == 0)
      *at++ = '-';
    put_digits(&random, &at, i / 3 % 10);
    if (i % 5 != 0)
      *at++ = '.';
    put_digits(&random, &at, i / 7 % 21);
    *at = " e/\n"[i % 4];
    const char *stop = number_parse_plain(text, &value);
    if (stop == NULL)
      continue;
    plain++;
    assert_ptr_equal(stop, number_parse_double(text, at, &expected));
    assert_true(bits_of(value) == bits_of(expected));
  }
  assert_true(plain > samples(120000));
}

/* Their quotients by powers of ten end in ones or zeros: powers of two, and
 * what lies next to the middle of two doubles. */
static void few_digits_are_read_to_their_end(void **state) {
  (void)state;
  for (uint64_t number = 0; number < 100000000; number = 7 * number / 5 + 1)
    for (int width = 1; width <= 8; width++) {
      char text[32]; /* eight bytes are read at once */
      int length = snprintf(text, sizeof text, "%0*d", width, (int)number);
      uint64_t sum = 12345;
      text[length] = "/ \n"[width % 3];
      const char *past = digits_read_few(text, &sum);
      if (length > 7) {
        assert_null(past);
        continue;
      }
      assert_ptr_equal(past, text + length);
      assert_int_equal(sum, number);
    }
  uint64_t sum;
  assert_null(digits_read_few("/1234567", &sum));
}

static void plain_numbers_carry_where_they_are_rounded(void **state) {
  static const char *const text[] = {
      "0.5",
      "0.015625",
      "0.001953125",
      "64.0",
      "0.999999999999999944",
      "0.999999999999999945",
      "0.999999999999999999",
      "99.99999999999999999",
      "0.125000000000000013",
      "0.125000000000000014",
      "0.125000000000000041",
      "0.125000000000000042",
      "0.000000000000000001",
      "0.0019531250000000001",
      "0.000015258789062500000001",
      "1.8446744073709551615",
      "0.00018446744073709551615",
      "0.0",
      "9999999.999999999",
  };
  (void)state;
  for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
    char block[2 * NUMBER_PLAIN_ROOM] = "-";
    double value = 0;
    strcat(block, text[i]);
    size_t length = strlen(block);
    block[length] = '\n';
    assert_ptr_equal(number_parse_plain(block, &value), block + length);
    assert_true(bits_of(value) == bits_of(strtod(block, NULL)));
  }
}

static void plain_numbers_fit_in_64_bits(void **state) {
  static const char *const text[] = {
      "1.8446744073709551616", "0.00018446744073709551616",
      "99.999999999999999999", "1234567.8901234567890", "12345678.9"};
  (void)state;
  for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
    char block[2 * NUMBER_PLAIN_ROOM] = "";
    double value;
    strcat(block, text[i]);
    assert_null(number_parse_plain(block, &value));
  }
}
#endif

/* Is the whole text one number? */
static bool is_number(const char *text) {
  const char *end = text + strlen(text);
  double value;
  return number_parse_double(text, end, &value) == end;
}

static void names_of_non_finite_numbers_are_read(void **state) {
  (void)state;
  assert_reads("inf", INFINITY);
  assert_reads("-INF", -INFINITY);
  assert_reads("+Infinity", INFINITY);
  assert_true(isnan(parse("nan")));
  assert_true(isnan(parse("-NaN")));
  assert_false(is_number("in"));
  assert_false(is_number("infinit"));
  assert_false(is_number("nano"));
}

static void integers_are_read_up_to_their_limits(void **state) {
  (void)state;
  static const struct {
    const char *text;
    int64_t value;
  } good[] = {{"0", 0},
              {"-0", 0},
              {"+42", 42},
              {"00000000000000000000000017", 17},
              {"9223372036854775807", INT64_MAX},
              {"-9223372036854775808", INT64_MIN}};
  static const char *const bad[] = {"9223372036854775808",
                                    "-9223372036854775809",
                                    "99999999999999999999999",
                                    "",
                                    "+",
                                    "-",
                                    "x1"};
  int64_t value;
  for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
    const char *end = good[i].text + strlen(good[i].text);
    assert_ptr_equal(number_parse_int(good[i].text, end, &value), end);
    assert_int_equal(value, good[i].value);
  }
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
    assert_null(number_parse_int(bad[i], bad[i] + strlen(bad[i]), &value));
}

/* ---- Writing ------------------------------------------------------------- */

static void assert_format(double value, int decimals, const char *expected) {
  char text[NUMBER_TEXT_SIZE];
  size_t length = number_format(text, value, decimals);
  assert_string_equal(text, expected);
  assert_int_equal(length, strlen(expected));
}

static void decimals_are_rounded_half_away_from_zero(void **state) {
  (void)state;
  assert_format(0.5, 0, "1");
  assert_format(1.5, 0, "2");
  assert_format(2.5, 0, "3");
  assert_format(-0.5, 0, "-1");
  assert_format(-2.5, 0, "-3");
  assert_format(0.125, 2, "0.13");
  assert_format(-0.125, 2, "-0.13");
  assert_format(nextafter(0.125, 0), 2, "0.12");
  assert_format(1.0005, 3, "1"); /* is below 1.0005 */
  assert_format(0.49999999999999994, 0, "0");
}

static void there_are_no_needless_characters(void **state) {
  (void)state;
  assert_format(0, 3, "0");
  assert_format(-0.0, 3, "0");
  assert_format(-0.0004, 3, "0");
  assert_format(-0.0005001, 3, "-0.001");
  assert_format(10, 3, "10");
  assert_format(100.5, 3, "100.5");
  assert_format(1.23, 9, "1.23");
  assert_format(0.05, 3, "0.05");
  assert_format(0.999999, 3, "1");
  assert_format(99.9996, 3, "100");
  assert_format(999999999.9999999, 3, "1000000000");
  assert_format(999999999.123456789, 9, "999999999.123456836");
  assert_format(0x1p-1074, 9, "0");
  assert_format(1e-300, 9, "0");
  assert_format(0x1p-31, 9, "0");
  assert_format(-0x1p-30, 9, "-0.000000001");
}

static void assert_scaled(int64_t value, int decimals, const char *expected) {
  char text[NUMBER_TEXT_SIZE];
  size_t length = number_format_scaled(text, value, decimals);
  assert_string_equal(text, expected);
  assert_int_equal(length, strlen(expected));
}

static void scaled_integers_are_written_exactly(void **state) {
  (void)state;
  assert_scaled(0, 3, "0");
  assert_scaled(-1, 3, "-0.001");
  assert_scaled(-120, 2, "-1.2");
  assert_scaled(1000, 3, "1");
  assert_scaled(1050, 3, "1.05");
  assert_scaled(17, 0, "17");
  assert_scaled(INT64_MAX, 9, "9223372036.854775807");
  assert_scaled(INT64_MIN, 9, "-9223372036.854775808");
  struct random random = {4};
  for (int i = 0; i < samples(100000); i++) {
    int decimals = random_int(&random, 0, 9);
    int64_t value = (int64_t)(random_between(&random, -1, 1) *
                              pow(10, random_int(&random, 0, 9)));
    char text[NUMBER_TEXT_SIZE];
    number_format(text, (double)value / pow(10, decimals), decimals);
    assert_scaled(value, decimals, text);
  }
}

/* What printf writes, less trailing zeros; it rounds as we do but for ties,
 * which are too rare to come up here. */
static void numbers_are_written_as_printf_writes_them(void **state) {
  (void)state;
  struct random random = {3};
  for (int i = 0; i < samples(200000); i++) {
    double scale = pow(10, random_int(&random, -11, 9));
    double value = random_between(&random, -1, 1) * scale;
    int decimals = random_int(&random, 0, 9);
    char expected[64];
    sprintf(expected, "%.*f", decimals, value);
    char *end = expected + strlen(expected);
    while (decimals && end[-1] == '0')
      *--end = '\0';
    if (end[-1] == '.')
      *--end = '\0';
    assert_format(value, decimals,
                  strcmp(expected, "-0") == 0 ? "0" : expected);
  }
}

static void assert_exact(double value, const char *expected) {
  char text[NUMBER_TEXT_SIZE];
  size_t length = number_format_exact(text, value);
  assert_string_equal(text, expected);
  assert_int_equal(length, strlen(expected));
}

static void exact_text_is_plain_where_that_is_short(void **state) {
  (void)state;
  assert_exact(0, "0");
  assert_exact(-0.0, "-0");
  assert_exact(1, "1");
  assert_exact(-0.1, "-0.1");
  assert_exact(100, "100");
  assert_exact(12.5, "12.5");
  assert_exact(1234567890123456, "1234567890123456");
  assert_exact(1e16, "10000000000000000");
  assert_exact(1e17, "1e17");
  assert_exact(1.5e300, "1.5e300");
  assert_exact(0.00001, "0.00001");
  assert_exact(0.000001, "1e-6");
  assert_exact(5e-324, "5e-324");
  assert_exact(DBL_MAX, "1.7976931348623157e308");
  assert_exact(0x1p-44, "5.684341886080802e-14");
  assert_exact(1.0 / 3, "0.3333333333333333");
}

/* How many digits printf needs for a text that reads back the same. */
static int digits_needed(double value) {
  char text[64];
  for (int digits = 1; digits < DBL_DECIMAL_DIG; digits++) {
    sprintf(text, "%.*e", digits - 1, value);
    if (strtod(text, NULL) == value)
      return digits;
  }
  return DBL_DECIMAL_DIG;
}

static int count_digits(const char *text) {
  int count = 0, zeros = 0;
  for (; *text && *text != 'e'; text++) {
    if (*text < '0' || *text > '9' || (*text == '0' && count == 0))
      continue;
    count++;
    zeros = *text == '0' ? zeros + 1 : 0;
  }
  return count - zeros;
}

static void exact_text_reads_back_and_is_shortest(void **state) {
  (void)state;
  struct random random = {4};
  for (int i = 0; i < samples(40000); i++) {
    double value = random_finite(&random);
    if (i % 4 == 1)
      value = (float)random_between(&random, -1000, 1000);
    if (i % 4 == 2)
      value = random_int(&random, -999999, 999999) / 1000.0;
    if (i % 4 == 3)
      value = ldexp(1, random_int(&random, -1074, 1023));
    char text[NUMBER_TEXT_SIZE];
    size_t length = number_format_exact(text, value);
    assert_int_equal(length, strlen(text));
    assert_true(strlen(text) < NUMBER_TEXT_SIZE);
    assert_true(bits_of(parse(text)) == bits_of(value));
    assert_true(bits_of(strtod(text, NULL)) == bits_of(value));
    if (value != 0)
      assert_true(count_digits(text) <= digits_needed(value));
  }
}

static void integers_are_written_whole(void **state) {
  (void)state;
  char text[NUMBER_TEXT_SIZE];
  assert_int_equal(number_format_int(text, 0), 1);
  assert_string_equal(text, "0");
  number_format_int(text, -17);
  assert_string_equal(text, "-17");
  number_format_int(text, INT64_MAX);
  assert_string_equal(text, "9223372036854775807");
  assert_int_equal(number_format_int(text, INT64_MIN), 20);
  assert_string_equal(text, "-9223372036854775808");
}

static void a_decimal_comma_changes_nothing(void **state) {
  (void)state;
  if (!comma_locale_on()) {
    print_message("no locale with a decimal comma\n");
    skip();
  }
  char text[NUMBER_TEXT_SIZE];
  sprintf(text, "%.1f", 1.5);
  assert_string_equal(text, "1,5"); /* the locale is what we think */
  assert_reads("1234.5", 1234.5);
  assert_reads("0.1234567890123456789012", 0.1234567890123456789012);
  assert_reads("6.123233995736766e-177", 6.123233995736766e-177);
  assert_false(is_number("1,5"));
  assert_format(1234.5678, 3, "1234.568");
  assert_exact(0.1, "0.1");
  assert_exact(1.25e-9, "1.25e-9");
  comma_locale_off();
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_million_numbers_are_read_as_strtod_reads_them),
    cmocka_unit_test(halfway_goes_to_even_and_a_hair_beside_it_does_not),
    cmocka_unit_test(short_halfway_numbers_go_to_even),
    cmocka_unit_test(the_ends_of_the_range_are_exact),
    cmocka_unit_test(exponents_of_any_length_are_read),
    cmocka_unit_test(digits_of_any_number_are_read),
    cmocka_unit_test(reading_stops_where_the_number_does),
    cmocka_unit_test(nothing_is_read_past_the_end),
#if DIGITS_CHUNKS
    cmocka_unit_test(plain_numbers_are_read_as_all_others),
    cmocka_unit_test(plain_numbers_carry_where_they_are_rounded),
    cmocka_unit_test(plain_numbers_fit_in_64_bits),
    cmocka_unit_test(few_digits_are_read_to_their_end),
#endif
    cmocka_unit_test(names_of_non_finite_numbers_are_read),
    cmocka_unit_test(integers_are_read_up_to_their_limits),
    cmocka_unit_test(decimals_are_rounded_half_away_from_zero),
    cmocka_unit_test(there_are_no_needless_characters),
    cmocka_unit_test(scaled_integers_are_written_exactly),
    cmocka_unit_test(numbers_are_written_as_printf_writes_them),
    cmocka_unit_test(exact_text_is_plain_where_that_is_short),
    cmocka_unit_test(exact_text_reads_back_and_is_shortest),
    cmocka_unit_test(integers_are_written_whole),
    cmocka_unit_test(a_decimal_comma_changes_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
