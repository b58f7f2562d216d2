/* lists.c - parses lists of pens, widths, colours and weights. */
#include "cli/lists.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/value.h"

/* ---- Items --------------------------------------------------------------- */

/* Appends an item to an allocated array of `count`.
 * Returns the array, which may have moved; NULL when memory ran out, and the
 * array is as it was. */
static void *append_item(void *array, size_t count, const void *item,
                         size_t size) {
  char *grown = realloc(array, (count + 1) * size);
  if (grown != NULL)
    memcpy(grown + count * size, item, size);
  return grown;
}

static bool is_pen(const char *text, int *pen) {
  return value_int(text, pen) && *pen >= 1 && *pen <= RECTO_PEN_MAX;
}

/* A name that is neither hidden, hatch nor a class is that of a group, which
 * the library looks up. */
recto_status lists_add_pen_use(struct arguments *a, const char *name,
                               const char *value) {
  recto_pen_use use = {.edge_class = (recto_edge_class)value_edge_class(name),
                       .group = name};
  use.lines = strcmp(name, "hidden") == 0  ? RECTO_LINES_HIDDEN
              : strcmp(name, "hatch") == 0 ? RECTO_LINES_HATCH
              : use.edge_class != 0        ? RECTO_LINES_OF_CLASS
                                           : RECTO_LINES_OF_GROUP;
  if (!is_pen(value, &use.pen))
    return RECTO_ERROR_ARGUMENT;
  recto_pen_use *grown =
      append_item(a->pen_use, a->options.ink.pen_use_count, &use, sizeof use);
  if (grown == NULL)
    return RECTO_ERROR_MEMORY;
  a->options.ink.pen_use = a->pen_use = grown;
  a->options.ink.pen_use_count++;
  return RECTO_OK;
}

/* The pen of that name among those of the options; NULL: there is none. */
static recto_pen *find_named_pen(struct arguments *a, const char *name) {
  int pen;
  if (!is_pen(name, &pen))
    return NULL;
  a->options.ink.pen = a->pen;
  if (a->options.ink.pen_count < (size_t)pen)
    a->options.ink.pen_count = (size_t)pen;
  return &a->pen[pen - 1];
}

recto_status lists_set_width(struct arguments *a, const char *name,
                             const char *value) {
  recto_pen *pen = find_named_pen(a, name);
  double mm;
  if (pen == NULL || !value_length(value, &mm) ||
      !(mm >= RECTO_FINEST_MM && mm <= 100))
    return RECTO_ERROR_ARGUMENT;
  pen->width_mm = mm;
  return RECTO_OK;
}

recto_status lists_set_colour(struct arguments *a, const char *name,
                              const char *value) {
  recto_pen *pen = find_named_pen(a, name);
  if (pen == NULL || !recto_colour_parse(value, &pen->colour))
    return RECTO_ERROR_ARGUMENT;
  pen->has_colour = true;
  return RECTO_OK;
}

recto_status lists_set_dash(struct arguments *a, const char *name,
                            const char *value) {
  recto_dash dash = {.edge_class = (recto_edge_class)value_edge_class(name)};
  size_t place = 0;
  dash.lines = dash.edge_class == 0 ? RECTO_LINES_HIDDEN : RECTO_LINES_OF_CLASS;
  if ((dash.edge_class == 0 && strcmp(name, "hidden") != 0) ||
      !recto_dash_parse(value, &dash))
    return RECTO_ERROR_ARGUMENT;
  while (place < a->options.ink.dash_count &&
         (a->dash[place].lines != dash.lines ||
          a->dash[place].edge_class != dash.edge_class))
    place++;
  a->dash[place] = dash;
  a->options.ink.dash = a->dash;
  if (a->options.ink.dash_count == place)
    a->options.ink.dash_count++;
  return RECTO_OK;
}

/* ANGLE, or ANGLE/PITCH. */
recto_status lists_add_cut_hatch(struct arguments *a, const char *name,
                                 const char *value) {
  recto_cut_hatch hatch = {.group = name};
  char angle[64];
  size_t length = strcspn(value, "/");
  if (length >= sizeof angle)
    return RECTO_ERROR_ARGUMENT;
  memcpy(angle, value, length);
  angle[length] = '\0';
  if (!value_number(angle, &hatch.angle_deg) ||
      (value[length] == '/' &&
       (!value_length(value + length + 1, &hatch.pitch_mm) ||
        !(hatch.pitch_mm >= RECTO_FINEST_MM))))
    return RECTO_ERROR_ARGUMENT;
  recto_cut_hatch *grown = append_item(
      a->cut_hatch, a->options.mesh.cut_hatch_count, &hatch, sizeof hatch);
  if (grown == NULL)
    return RECTO_ERROR_MEMORY;
  a->options.mesh.cut_hatch = a->cut_hatch = grown;
  a->options.mesh.cut_hatch_count++;
  return RECTO_OK;
}

recto_status lists_set_weight(struct arguments *a, const char *name,
                              const char *value) {
  recto_weight weight = {.edge_class =
                             (recto_edge_class)value_edge_class(name)};
  size_t place = 0;
  if (weight.edge_class == 0 || !value_number(value, &weight.weight) ||
      !(weight.weight >= 0.01 && weight.weight <= 100))
    return RECTO_ERROR_ARGUMENT;
  while (place < a->options.ink.weight_count &&
         a->weight[place].edge_class != weight.edge_class)
    place++;
  a->weight[place] = weight;
  a->options.ink.weight = a->weight;
  if (a->options.ink.weight_count == place)
    a->options.ink.weight_count++;
  return RECTO_OK;
}

/* ---- Lists --------------------------------------------------------------- */

/* The value of the name in the lists of that option, if it is a different one;
 * else NULL. */
static const char *find_other_value(const struct arguments *a,
                                    const struct list_item *item) {
  for (size_t i = 0; i < a->item_count; i++) {
    const struct list_item *other = &a->item[i];
    if (strcmp(other->option, item->option) == 0 &&
        strcmp(other->name, item->name) == 0 &&
        strcmp(other->value, item->value) != 0)
      return other->value;
  }
  return NULL;
}

static bool keep_item(struct arguments *a, const struct list_item *item) {
  struct list_item *grown =
      append_item(a->item, a->item_count, item, sizeof *item);
  if (grown == NULL)
    return false;
  a->item = grown;
  a->item_count++;
  return true;
}

/* Removes the items of the lists of that option. */
static void remove_items(struct arguments *a, const char *option) {
  size_t kept = 0;
  for (size_t i = 0; i < a->item_count; i++)
    if (strcmp(a->item[i].option, option) != 0)
      a->item[kept++] = a->item[i];
  a->item_count = kept;
}

/* The option's name, one for both spellings of a word. */
static const char *list_name(const struct option_entry *entry) {
  return strcmp(entry->name, "pen-color") == 0 ? "pen-colour" : entry->name;
}

static bool refuse_item(const struct option_entry *entry, const char *item,
                        char message[MESSAGE_SIZE]) {
  snprintf(message, MESSAGE_SIZE, "--%s: expected %s, not \"%.60s\"",
           entry->name, entry->expected, item);
  return false;
}

bool lists_parse(struct arguments *arguments, const struct option_entry *entry,
                 char *list, char message[MESSAGE_SIZE]) {
  if (entry->words != NULL && strcmp(list, entry->words) == 0) {
    arguments->options.ink.weight_count = 0;
    remove_items(arguments, list_name(entry));
    return true;
  }
  for (char *name = list, *end; name != NULL; name = end) {
    end = strchr(name, ',');
    if (end != NULL)
      *end++ = '\0';
    char *value = strrchr(name, '=');
    if (value == NULL || value == name || value[1] == '\0')
      return refuse_item(entry, name, message);
    *value++ = '\0';
    const struct list_item item = {list_name(entry), name, value};
    const char *other = find_other_value(arguments, &item);
    if (other != NULL) {
      snprintf(message, MESSAGE_SIZE,
               "--%s: two values for one name: \"%.60s=%.20s\" and "
               "\"%.60s=%.20s\"",
               entry->name, name, other, name, value);
      return false;
    }
    recto_status status = keep_item(arguments, &item)
                              ? entry->parse_item(arguments, name, value)
                              : RECTO_ERROR_MEMORY;
    if (status == RECTO_ERROR_MEMORY) {
      snprintf(message, MESSAGE_SIZE, "out of memory");
      return false;
    }
    if (status != RECTO_OK) {
      value[-1] = '=';
      return refuse_item(entry, name, message);
    }
  }
  return true;
}
