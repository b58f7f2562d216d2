/* pens.c - parses the options' lists of pens, widths, colours and weights, such
 * as silhouette=2,hidden=3. */
#include "ink/pens.h"

#include <math.h>
#include <string.h>

#include "base/length.h"
#include "base/number.h"

/* ISO 128: wide lines are twice as wide as narrow ones. */
#define WIDE 2.0
#define WEIGHT_MOST 100.0

/* One KEY=VALUE of a list. */
struct item {
  const char *list; /* name of the option, for messages */
  const char *key, *value, *end;
  size_t length; /* of the key */
  recto_error *error;
};

typedef recto_status (*take_fn)(struct pens *pens, const struct scene *scene,
                                const struct item *item);

/* ---- Lists --------------------------------------------------------------- */

static int clip(ptrdiff_t length) { return length < 80 ? (int)length : 80; }

static recto_status reject(const struct item *item, const char *expected) {
  return error_set(item->error, RECTO_ERROR_ARGUMENT, NULL, 0,
                   "%s: \"%.*s\" is not %s", item->list,
                   clip(item->end - item->key), item->key, expected);
}

/* Rejects an item whose name has a different value in an earlier item of the
 * list that begins at `first`. */
static recto_status check_earlier(const struct item *item, const char *first) {
  size_t whole = (size_t)(item->end - item->key);
  while (first < item->key) {
    size_t length = strcspn(first, ",");
    bool same_name =
        length > item->length &&
        memcmp(first, item->key, item->length + 1) == 0 &&
        !memchr(first + item->length + 1, '=', length - item->length - 1);
    if (same_name && (length != whole || memcmp(first, item->key, whole) != 0))
      return error_set(item->error, RECTO_ERROR_ARGUMENT, NULL, 0,
                       "%s: two values for one name: \"%.*s\" and \"%.*s\"",
                       item->list, clip((ptrdiff_t)length), first,
                       clip((ptrdiff_t)whole), item->key);
    first += length + 1;
  }
  return RECTO_OK;
}

/* Calls take for each item of a comma-separated list; NULL: empty. */
static recto_status read_list(struct pens *pens, const struct scene *scene,
                              const char *name, const char *list, take_fn take,
                              recto_error *error) {
  const char *first = list;
  recto_status status = RECTO_OK;
  while (list && status == RECTO_OK) {
    size_t length = strcspn(list, ",");
    struct item item = {name, list, NULL, list + length, 0, error};
    for (size_t i = 0; i < length; i++)
      if (list[i] == '=')
        item.value = list + i + 1;
    if (!item.value || item.value == list + 1)
      return reject(&item, "of the form NAME=VALUE");
    item.length = (size_t)(item.value - 1 - list);
    status = take(pens, scene, &item);
    if (status == RECTO_OK)
      status = check_earlier(&item, first);
    list = list[length] == ',' ? list + length + 1 : NULL;
  }
  return status;
}

static bool parse_pen(const char *text, const char *end, uint32_t *pen) {
  int64_t number;
  if (number_parse_int(text, end, &number) != end || number < 1 ||
      number > PENS_MOST)
    return false;
  *pen = (uint32_t)number - 1;
  return true;
}

static bool has_name(const struct item *item, const char *word) {
  return strlen(word) == item->length &&
         memcmp(item->key, word, item->length) == 0;
}

/* The bit index of the class of that name; RECTO_EDGE_CLASS_COUNT: none. */
static unsigned find_class(const struct item *item) {
  unsigned place = 0;
  while (
      place < RECTO_EDGE_CLASS_COUNT &&
      !has_name(item, recto_edge_class_name((recto_edge_class)(1u << place))))
    place++;
  return place;
}

/* Whether the key names a group: by the whole name, or by one of the parts
 * between slashes, which join object, group and material. */
static bool names_group(const struct item *item, const char *name) {
  const char *at = name;
  for (; at; at = strchr(at, '/') ? strchr(at, '/') + 1 : NULL)
    if (strncmp(at, item->key, item->length) == 0 &&
        (at[item->length] == '\0' || at[item->length] == '/'))
      return true;
  return false;
}

/* ---- Values -------------------------------------------------------------- */

static recto_status take_pen(struct pens *pens, const struct scene *scene,
                             const struct item *item) {
  uint32_t pen;
  bool found = false;
  if (!parse_pen(item->value, item->end, &pen))
    return reject(item, "a name and a pen from 1 to 1000");
  unsigned place = find_class(item);
  if (pen + 1 > pens->count)
    pens->count = pen + 1;
  if (has_name(item, "hidden")) {
    pens->of_hidden = pen;
    return RECTO_OK;
  }
  if (has_name(item, "hatch")) {
    pens->of_hatch = pen;
    return RECTO_OK;
  }
  pens->several = true;
  if (place < RECTO_EDGE_CLASS_COUNT) {
    pens->of_class[place] = pen;
    return RECTO_OK;
  }
  for (size_t g = 0; g < scene->group.count; g++)
    if (names_group(item, scene->group.item[g].name)) {
      pens->of_group[g] = pen;
      found = true;
    }
  if (found)
    return RECTO_OK;
  return error_set(item->error, RECTO_ERROR_ARGUMENT, NULL, 0,
                   "%s: \"%.*s\" is neither hidden, hatch, a class of lines "
                   "nor a group of the model",
                   item->list, clip((ptrdiff_t)item->length), item->key);
}

static recto_status take_width(struct pens *pens, const struct scene *scene,
                               const struct item *item) {
  uint32_t pen;
  double number;
  (void)scene;
  const char *stop = number_parse_double(item->value, item->end, &number);
  double mm = stop ? number * length_unit_mm(stop, item->end) : 0;
  if (!parse_pen(item->key, item->key + item->length, &pen) ||
      !(mm >= RECTO_FINEST_MM && mm <= 100))
    return reject(item, "a pen and its width, 0.01 to 100 mm");
  pens->own[pen].width_mm = mm;
  return RECTO_OK;
}

static recto_status take_colour(struct pens *pens, const struct scene *scene,
                                const struct item *item) {
  static const char digits[] = "0123456789abcdefABCDEF";
  const char *at = item->value + (*item->value == '#');
  size_t count = (size_t)(item->end - at), i = 0;
  uint32_t pen, colour = 0;
  (void)scene;
  for (; i < count && i < 6 && strchr(digits, at[i]); i++) {
    uint32_t digit = (uint32_t)(strchr(digits, at[i]) - digits);
    digit -= digit > 15 ? 6 : 0;
    colour =
        count == 3 ? colour << 8 | digit << 4 | digit : colour << 4 | digit;
  }
  if (!parse_pen(item->key, item->key + item->length, &pen) || i != count ||
      (count != 3 && count != 6))
    return reject(item, "a pen and its colour, such as 2=#c00 or 2=#cc0000");
  pens->own[pen].colour = colour;
  return RECTO_OK;
}

static recto_status take_weight(struct pens *pens, const struct scene *scene,
                                const struct item *item) {
  double weight;
  unsigned place = find_class(item);
  (void)scene;
  if (place == RECTO_EDGE_CLASS_COUNT ||
      number_parse_double(item->value, item->end, &weight) != item->end ||
      !(weight >= 1 / WEIGHT_MOST && weight <= WEIGHT_MOST))
    return reject(item, "a class of lines and its weight, 0.01 to 100");
  pens->weight[place] = weight;
  pens->weighed |= 1u << place;
  return RECTO_OK;
}

/* ---- All lists ----------------------------------------------------------- */

/* Assigns the groups to the pens in turn. */
static bool assign_groups(struct pens *pens, const struct scene *scene,
                          const recto_options *options) {
  uint32_t count = options->pens > 1 ? (uint32_t)options->pens : 1;
  pens->group_count = scene->group.count;
  pens->of_group = mem_alloc(pens->group_count, sizeof *pens->of_group);
  pens->own = mem_alloc(PENS_MOST + 1, sizeof *pens->own);
  if (!pens->of_group || !pens->own)
    return false;
  for (size_t g = 0; g < pens->group_count; g++)
    pens->of_group[g] = (uint32_t)g % count;
  for (size_t i = 0; i <= PENS_MOST; i++)
    pens->own[i] = (struct pens_own){0, PENS_NONE};
  pens->count = count < pens->group_count ? count : (uint32_t)pens->group_count;
  pens->count = pens->count > 0 ? pens->count : 1;
  pens->several = count > 1;
  return true;
}

recto_status pens_init(struct pens *pens, const struct scene *scene,
                       const recto_options *options, recto_error *error) {
  const char *weights = options->weights;
  *pens = (struct pens){.of_hidden = PENS_NONE,
                        .of_hatch = PENS_NONE,
                        .width_mm = options->pen_mm,
                        .shortest_mm = options->min_stroke_mm};
  for (int i = 0; i < RECTO_EDGE_CLASS_COUNT; i++) {
    pens->of_class[i] = PENS_NONE;
    pens->weight[i] = 1;
  }
  if (!assign_groups(pens, scene, options))
    return error_memory(error);
  recto_status status =
      read_list(pens, scene, "pens", options->pen_for, take_pen, error);
  if (status == RECTO_OK)
    status = read_list(pens, scene, "widths of pens", options->pen_widths,
                       take_width, error);
  if (status == RECTO_OK)
    status = read_list(pens, scene, "colours of pens", options->pen_colours,
                       take_colour, error);
  if (!weights && !pens->several)
    pens->weight[pens_place(RECTO_EDGE_SILHOUETTE)] =
        pens->weight[pens_place(RECTO_EDGE_BORDER)] = WIDE;
  if (status == RECTO_OK && weights && strcmp(weights, "none") != 0)
    status = read_list(pens, scene, "weights", weights, take_weight, error);
  return status;
}

void pens_fini(struct pens *pens) {
  mem_free(pens->of_group);
  mem_free(pens->own);
}

/* ---- Queries ------------------------------------------------------------- */

unsigned pens_place(unsigned edge_class) {
  unsigned place = 0;
  while (place + 1 < RECTO_EDGE_CLASS_COUNT && edge_class >> (place + 1))
    place++;
  return place;
}

uint32_t pens_of_line(const struct pens *pens, unsigned edge_class,
                      uint32_t group) {
  uint32_t pen = pens->of_class[pens_place(edge_class)];
  return pen != PENS_NONE ? pen : pens_of_group(pens, group);
}

uint32_t pens_of_hidden(const struct pens *pens, const recto_options *options,
                        unsigned edge_class, uint32_t group) {
  if (pens->of_hidden != PENS_NONE)
    return pens->of_hidden;
  return options->hidden == RECTO_HIDDEN_LAYER
             ? pens->count
             : pens_of_line(pens, edge_class, group);
}

uint32_t pens_of_hatch(const struct pens *pens, uint32_t group) {
  return pens->of_hatch != PENS_NONE ? pens->of_hatch
                                     : pens_of_group(pens, group);
}

double pens_width_mm(const struct pens *pens, uint32_t pen) {
  double own = pens->own[pen].width_mm;
  return own > 0 ? own : pens->width_mm;
}

double pens_shortest_mm(const struct pens *pens, uint32_t pen) {
  return pens->shortest_mm < 0 ? pens_width_mm(pens, pen) / 2
                               : pens->shortest_mm;
}

unsigned pens_weight_rank(const struct pens *pens, unsigned edge_class) {
  unsigned rank = 0, place = pens_place(edge_class);
  while (pens->weight[rank] != pens->weight[place])
    rank++;
  return rank;
}
