/* test_model_3mf.c - the unit of 3MF files and the names of their objects are
 * read, and no bytes do harm. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "import/model_3mf.h"
#include "import/xml_tags.h"

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

static double unit_of_bytes(const char *bytes, size_t count) {
  struct model_3mf model;
  model_3mf_read(&model, bytes, count);
  double mm = model.unit_mm;
  assert_false(model.no_memory);
  assert_true(mm >= 0 && mm <= 1000);
  for (size_t i = 0; i < model.object.count; i++)
    assert_true(model.object.item[i].name[0] != '\0');
  model_3mf_fini(&model);
  return mm;
}

static double unit_of(const char *model) {
  static struct archive a;
  make_archive(&a, "3D/3dmodel.model", model);
  return unit_of_bytes(a.bytes, a.count);
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
  assert_true(unit_of_bytes("", 0) == 0);
  assert_true(unit_of_bytes("PK", 2) == 0);
  make_archive(&a, "3D/other.model", "<model unit=\"inch\">");
  assert_true(unit_of_bytes(a.bytes, a.count) == 0);
}

/* ---- Names --------------------------------------------------------------- */

/* Reads a model of these elements, and compares the name of the object 7. */
static void assert_name(const char *name, const char *elements) {
  static struct archive a;
  struct model_3mf model;
  char text[1500];
  snprintf(text, sizeof text,
           "<model><resources>%s</resources><build/></model>", elements);
  make_archive(&a, "3D/3dmodel.model", text);
  model_3mf_read(&model, a.bytes, a.count);
  const char *found = model_3mf_name(&model, 7);
  if ((found == NULL) != (name == NULL) ||
      (name != NULL && strcmp(found, name) != 0))
    fail_msg("%s: '%s', not '%s'", elements, found ? found : "none",
             name ? name : "none");
  model_3mf_fini(&model);
}

static void names_of_objects_are_read(void **state) {
  (void)state;
  assert_name("Lid", "<object id=\"7\" name=\"Lid\">");
  assert_name("Lid", "<object name='Lid' type=\"model\"\n\tid = '07'/>");
  assert_name("Lid", "<object id='6' name='Box'><mesh/></object>"
                     "<m:object id='7' name='Lid' m:name='no'/>");
  assert_name("a > b/c", "<object id='7' name='a > b/c'/>");
  assert_name("  a b", "<object id='7' name='\n\ta\rb'/>");
  assert_name("Größe", "<object id='7' name='Größe'/>");
}

static void references_to_characters_are_replaced(void **state) {
  (void)state;
  assert_name("<\"&'>", "<object id='7' name='&lt;&quot;&amp;&apos;&gt;'/>");
  assert_name("A\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80!",
              "<object id='7' name='&#65;&#xE9;&#x20ac;&#128512;&#x000021;'/>");
  assert_name("&no;&;& &#;&#x;&#0;&#xd800;&#x110000;&#9z;",
              "<object id='7' name='&no;&;& &#;&#x;&#0;&#xd800;&#x110000;"
              "&#9z;'/>");
  assert_name("&#0000000065;", "<object id='7' name='&#0000000065;'/>");
}

static void objects_of_one_name_are_told_apart(void **state) {
  (void)state;
  assert_name("Leg.7",
              "<object id='7' name='Leg'/><object id='3' name='Leg'/>");
  assert_name("Leg.7", "<object id='3' name='Leg'/><object id='7' name='Leg'/>"
                       "<object id='9' name='Legs'/>");
  assert_name("Leg", "<object id='3' name='Le'/><object id='7' name='Leg'/>");
}

static void what_is_no_object_gives_no_name(void **state) {
  (void)state;
  assert_name(NULL, "<!-- <object id='7' name='a'/> -- > - -->");
  assert_name("b", "<!-- ' > <object id='7' name='a'/> --->"
                   "<object id='7' name='b'/>");
  assert_name("b", "<![CDATA[ <object id='7' name='a'/> ]]]>"
                   "<?x <object id='7' name='a'/> \?\?>"
                   "<object id='7' name='b'/>");
  assert_name(NULL, "<objects id='7' name='a'/><object id='7'/>");
  assert_name(NULL, "<object id='7' name=''/><object name='a'/>");
  assert_name(NULL, "<object id='x' name='a'/><object id='7x' name='a'/>");
  assert_name(NULL, "<object id='4294967303' name='a'/>");
  assert_name(NULL, "</object id='7' name='a'/>");
  assert_name(NULL, "<object id='7' title='a' name/>");
  assert_name(NULL, "<object id='7' other=a name='a'/>");
  assert_name(NULL, "<build/><object id='7' name='a'/>");
}

/* ---- Blocks -------------------------------------------------------------- */

struct found {
  char text[200];
};

static bool add_tag(void *user, const char *tag) {
  struct found *found = user;
  size_t length = strlen(found->text);
  snprintf(found->text + length, sizeof found->text - length, "%s|", tag);
  return true;
}

static void tags_may_begin_in_one_block_and_end_in_another(void **state) {
  static const char text[] = "<?x '?><a b='<>'/><!-- <c> --><![CDATA[<d>]]>"
                             "</a ><e\n>text</e>";
  (void)state;
  for (size_t size = 1; size < sizeof text; size++) {
    struct found found = {""};
    struct xml_tags *tags = calloc(1, sizeof *tags);
    assert_non_null(tags);
    tags->take = add_tag;
    tags->user = &found;
    for (size_t at = 0; at < sizeof text - 1; at += size)
      assert_true(xml_tags_read(
          tags, text + at,
          size < sizeof text - 1 - at ? size : sizeof text - 1 - at));
    assert_string_equal(found.text, "a b='<>'/|e\n|");
    free(tags);
  }
}

static void tags_that_are_too_long_are_skipped(void **state) {
  (void)state;
  for (size_t length = XML_TAG_MAX - 2; length < XML_TAG_MAX + 3; length++) {
    struct found found = {""};
    struct xml_tags *tags = calloc(1, sizeof *tags);
    char *text = malloc(length);
    assert_non_null(tags);
    assert_non_null(text);
    memset(text, 'x', length);
    tags->take = add_tag;
    tags->user = &found;
    assert_true(xml_tags_read(tags, "<", 1));
    assert_true(xml_tags_read(tags, text, length));
    assert_true(xml_tags_read(tags, "><a>", 4));
    assert_true(found.text[0] == (length <= XML_TAG_MAX ? 'x' : 'a'));
    free(text);
    free(tags);
  }
}

/* ---- Any bytes ----------------------------------------------------------- */

/* The archive in a block of its own size, whose end the sanitizers guard. */
static void read_exactly(const struct archive *a, size_t count) {
  char *exact = malloc(count > 0 ? count : 1);
  assert_non_null(exact);
  memcpy(exact, a->bytes, count);
  (void)unit_of_bytes(exact, count);
  free(exact);
}

static void archives_cut_short_and_changed_do_no_harm(void **state) {
  static struct archive a;
  uint32_t random = 1;
  (void)state;
  make_archive(&a, "3D/3dmodel.model",
               "<model unit=\"inch\"><!-- --><object id='1' name='&#65;'/>"
               "<object id='2' name='A'/>");
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
      cmocka_unit_test(names_of_objects_are_read),
      cmocka_unit_test(references_to_characters_are_replaced),
      cmocka_unit_test(objects_of_one_name_are_told_apart),
      cmocka_unit_test(what_is_no_object_gives_no_name),
      cmocka_unit_test(tags_may_begin_in_one_block_and_end_in_another),
      cmocka_unit_test(tags_that_are_too_long_are_skipped),
      cmocka_unit_test(archives_cut_short_and_changed_do_no_harm),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
