/* model_3mf.c - what Assimp leaves out of a 3MF model: its unit and the
 * names of its objects. */
#include "import/model_3mf.h"

#include <stdio.h>
#include <string.h>

#include "base/sort.h"
#include "import/archive_3mf.h"
#include "import/xml_tags.h"

static bool is_the_text(const char *text, size_t length, const char *other) {
  return strlen(other) == length && memcmp(text, other, length) == 0;
}

/* ---- The unit ------------------------------------------------------------ */

static double unit_of_model(const char *tag) {
  static const struct {
    const char *name;
    double mm;
  } unit[] = {{"micron", 0.001}, {"millimeter", 1}, {"centimeter", 10},
              {"inch", 25.4},    {"foot", 304.8},   {"meter", 1000}};
  size_t length;
  const char *value = xml_attribute(tag, "unit", &length);
  for (size_t i = 0; i < sizeof unit / sizeof *unit && value != NULL; i++)
    if (is_the_text(value, length, unit[i].name))
      return unit[i].mm;
  return 1;
}

/* ---- The names ----------------------------------------------------------- */

/* Ids are whole numbers from 1 to 2^31 - 1; 0 stands for all else. */
static uint32_t id_of(const char *text, size_t length) {
  uint64_t id = 0;
  for (size_t i = 0; i < length && id <= INT32_MAX; i++) {
    if (text[i] < '0' || text[i] > '9')
      return 0;
    id = 10 * id + (uint64_t)(text[i] - '0');
  }
  return id <= INT32_MAX ? (uint32_t)id : 0;
}

/* What may stand behind a name: a point and an id. */
enum { ID_SIZE = 12 };

static bool add_object(struct model_3mf *model, const char *tag) {
  size_t id_length, length;
  const char *id = xml_attribute(tag, "id", &id_length);
  const char *name = xml_attribute(tag, "name", &length);
  struct model_3mf_object object = {id != NULL ? id_of(id, id_length) : 0,
                                    NULL};
  if (object.id == 0 || name == NULL)
    return true;
  object.name = mem_alloc(length + 1 + ID_SIZE, 1);
  if (object.name != NULL)
    xml_expand(name, length, object.name);
  if (object.name != NULL && object.name[0] == '\0') {
    mem_free(object.name);
    return true;
  }
  model->no_memory = object.name == NULL || !ARRAY_PUSH(&model->object, object);
  if (model->no_memory)
    mem_free(object.name);
  return !model->no_memory;
}

static int compare_object_names(const void *a, const void *b, void *user) {
  (void)user;
  return strcmp(((const struct model_3mf_object *)a)->name,
                ((const struct model_3mf_object *)b)->name);
}

static int compare_object_ids(const void *a, const void *b, void *user) {
  (void)user;
  return compare_numbers(((const struct model_3mf_object *)a)->id,
                         ((const struct model_3mf_object *)b)->id);
}

static void sort_objects(struct model_3mf *model,
                         int (*compare)(const void *, const void *, void *)) {
  if (!sort_stable(model->object.item, model->object.count,
                   sizeof *model->object.item, compare, NULL))
    model->no_memory = true;
}

/* Tells objects of one name apart by their ids. */
static void number_equal_names(struct model_3mf *model) {
  sort_objects(model, compare_object_names);
  struct model_3mf_object *object = model->object.item;
  for (size_t i = 0, end; i < model->object.count; i = end) {
    size_t length = strlen(object[i].name);
    for (end = i + 1; end < model->object.count &&
                      strcmp(object[end].name, object[i].name) == 0;)
      end++;
    for (size_t k = i; k < end && end > i + 1; k++)
      (void)snprintf(object[k].name + length, ID_SIZE, ".%u", object[k].id);
  }
}

/* ---- The model ----------------------------------------------------------- */

static bool take_tag(void *user, const char *tag) {
  struct model_3mf *model = user;
  size_t length;
  const char *name = xml_tag_name(tag, &length);
  if (is_the_text(name, length, "model") && model->unit_mm == 0)
    model->unit_mm = unit_of_model(tag);
  else if (is_the_text(name, length, "object"))
    return add_object(model, tag);
  /* All objects stand before it. */
  return !is_the_text(name, length, "build");
}

static bool take_bytes(void *user, const char *bytes, size_t count) {
  return xml_tags_read(user, bytes, count);
}

void model_3mf_read(struct model_3mf *model, const char *bytes, size_t count) {
  *model = (struct model_3mf){.unit_mm = 0};
  struct xml_tags *tags = mem_calloc(1, sizeof *tags);
  if (tags == NULL) {
    model->no_memory = true;
    return;
  }
  tags->take = take_tag;
  tags->user = model;
  archive_3mf_expand(bytes, count, take_bytes, tags);
  mem_free(tags);
  number_equal_names(model);
  sort_objects(model, compare_object_ids);
}

void model_3mf_fini(struct model_3mf *model) {
  while (model->object.count > 0)
    mem_free(model->object.item[--model->object.count].name);
  ARRAY_FREE(&model->object);
}

const char *model_3mf_name(const struct model_3mf *model, uint32_t id) {
  const struct model_3mf_object *object = model->object.item;
  size_t i;
  LOWER_BOUND(i, 0, model->object.count, object[i].id < id);
  return i < model->object.count && object[i].id == id ? object[i].name : NULL;
}
