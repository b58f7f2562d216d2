/* test_unit_3mf.c - the unit of 3MF files is read, and no bytes do harm. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "import/unit_3mf.h"

/* ---- Archives ------------------------------------------------------------ */

struct archive {
  char bytes[2048];
  size_t count;
};

static void put_text(struct archive *a, const char *text) {
  memcpy(a->bytes + a->count, text, strlen(text));
  a->count += strlen(text);
}

static void put_number(struct archive *a, size_t value, int size) {
  for (int i = 0; i < size; i++)
    a->bytes[a->count++] = (char)(value >> 8 * i & 0xff);
}

/* The fields that the header of a part and its entry of the directory have in
 * common, from the version on. */
static void put_fields(struct archive *a, size_t length, const char *name) {
  put_number(a, 20, 2);
  put_number(a, 0, 2);
  put_number(a, 0, 2); /* stored */
  put_number(a, 0, 4);
  put_number(a, 0, 4);
  put_number(a, length, 4);
  put_number(a, length, 4);
  put_number(a, strlen(name), 2);
  put_number(a, 0, 2);
}

static void put_part(struct archive *a, const char *name, const char *text) {
  put_number(a, 0x04034b50, 4);
  put_fields(a, strlen(text), name);
  put_text(a, name);
  put_text(a, text);
}

static void put_entry(struct archive *a, const char *name, const char *text,
                      size_t at) {
  put_number(a, 0x02014b50, 4);
  put_number(a, 20, 2);
  put_fields(a, strlen(text), name);
  put_number(a, 0, 2); /* no comment */
  put_number(a, 0, 2);
  put_number(a, 0, 2);
  put_number(a, 0, 4);
  put_number(a, at, 4);
  put_text(a, name);
}

/* An archive of some part and the model; then a comment of the archive. */
static void make_archive(struct archive *a, const char *path,
                         const char *model) {
  static const char other[] = "[Content_Types].xml", text[] = "<Types/>";
  a->count = 0;
  put_part(a, other, text);
  size_t second = a->count;
  put_part(a, path, model);
  size_t directory = a->count;
  put_entry(a, other, text, 0);
  put_entry(a, path, model, second);
  size_t length = a->count - directory;
  put_number(a, 0x06054b50, 4);
  put_number(a, 0, 4);
  put_number(a, 2, 2);
  put_number(a, 2, 2);
  put_number(a, length, 4);
  put_number(a, directory, 4);
  put_number(a, 7, 2);
  put_text(a, "comment");
}

static double unit_of(const char *model) {
  static struct archive a;
  make_archive(&a, "3D/3dmodel.model", model);
  return unit_3mf_mm(a.bytes, a.count);
}

/* ---- Units --------------------------------------------------------------- */

static void every_unit_of_the_specification_is_read(void **state) {
  static const struct {
    const char *name;
    double mm;
  } unit[] = {{"micron", 0.001}, {"millimeter", 1}, {"centimeter", 10},
              {"inch", 25.4},    {"foot", 304.8},   {"meter", 1000}};
  (void)state;
  for (size_t i = 0; i < sizeof unit / sizeof *unit; i++) {
    char model[200];
    snprintf(model, sizeof model,
             "<?xml version=\"1.0\"?>\n<!-- unit=\"none\" -->\n"
             "<model xml:lang=\"en\" unit=\"%s\" xmlns=\"x\"><resources/>",
             unit[i].name);
    assert_true(unit_of(model) == unit[i].mm);
  }
}

static void unit_may_be_written_in_any_way_that_xml_allows(void **state) {
  (void)state;
  assert_true(unit_of("<model\n\tunit = 'inch'>") == 25.4);
  assert_true(unit_of("<c:model xmlns:c='x' c:unit='foot' unit='inch'>") ==
              25.4);
  assert_true(unit_of("<model a=\"unit\" subunit='foot' unit=\"meter\"/>") ==
              1000);
}

static void without_a_unit_it_is_the_millimetre(void **state) {
  (void)state;
  assert_true(unit_of("<model><object unit=\"inch\"/></model>") == 1);
  assert_true(unit_of("<model unit=\"furlong\">") == 1);
  assert_true(unit_of("<model unit=\"inches\">") == 1);
}

static void what_is_no_model_has_no_unit(void **state) {
  static struct archive a;
  (void)state;
  assert_true(unit_of("<models unit=\"inch\">") == 0);
  assert_true(unit_of("<model unit=\"inch\"") == 0);
  assert_true(unit_of("") == 0);
  assert_true(unit_3mf_mm("", 0) == 0);
  assert_true(unit_3mf_mm("PK", 2) == 0);
  make_archive(&a, "3D/other.model", "<model unit=\"inch\">");
  assert_true(unit_3mf_mm(a.bytes, a.count) == 0);
}

/* ---- Any bytes ----------------------------------------------------------- */

/* The archive in a block of its own size, whose end the sanitizers guard. */
static void read_exactly(const struct archive *a, size_t count) {
  char *exact = malloc(count > 0 ? count : 1);
  assert_non_null(exact);
  memcpy(exact, a->bytes, count);
  double mm = unit_3mf_mm(exact, count);
  assert_true(mm >= 0 && mm <= 1000);
  free(exact);
}

static void archives_cut_short_and_changed_do_no_harm(void **state) {
  static struct archive a;
  uint32_t random = 1;
  (void)state;
  make_archive(&a, "3D/3dmodel.model", "<model unit=\"inch\">");
  for (size_t count = 0; count <= a.count; count++)
    read_exactly(&a, count);
  for (int i = 0; i < 100000; i++) {
    struct archive changed = a;
    for (int k = 0; k < 3; k++) {
      random = random * 1664525u + 1013904223u;
      changed.bytes[(random >> 8) % a.count] = (char)(random >> 24);
    }
    read_exactly(&changed, a.count);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_unit_of_the_specification_is_read),
      cmocka_unit_test(unit_may_be_written_in_any_way_that_xml_allows),
      cmocka_unit_test(without_a_unit_it_is_the_millimetre),
      cmocka_unit_test(what_is_no_model_has_no_unit),
      cmocka_unit_test(archives_cut_short_and_changed_do_no_harm),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
