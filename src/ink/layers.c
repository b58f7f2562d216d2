/* layers.c - the layers of a drawing: one a pen, one for hidden lines, one for
 * fills.
 *
 * Programs for plotters read a layer's number from its label: vpype takes all
 * digits of it, of any script, as one number, others those that it opens with.
 * So a label has no digits but its number. */
#include "ink/layers.h"

#include <stdio.h>
#include <string.h>

#include "base/sort.h"
#include "base/utf8.h"

#define BLACK 0x000000u
#define GREY 0x808080u /* of hidden lines on a screen */

/* The size of a label of names; on sheets the view's name is put into it. */
enum { LABEL_SIZE = 48 };

/* Appends as much of `text` without its digits as fits, without splitting a
 * UTF-8 sequence. */
static void append_text(char label[], size_t size, const char *text) {
  size_t used = strlen(label);
  while (*text != '\0') {
    uint32_t code = 0;
    size_t length = utf8_measure(text, &code);
    length = length > 0 ? length : 1;
    if (used + length >= size)
      break;
    if (!utf8_is_digit(code)) {
      memcpy(label + used, text, length);
      used += length;
    }
    text += length;
  }
  label[used] = '\0';
}

/* Whether a name has anything but digits. */
static bool has_letters(const char *name) {
  uint32_t code = '0';
  while (*name != '\0' && utf8_is_digit(code)) {
    size_t length = utf8_measure(name, &code);
    name += length > 0 ? length : 1;
  }
  return !utf8_is_digit(code);
}

struct label {
  struct drawing_layer *layer;
  bool first, full;
};

/* Adds a word.  Where it does not fit, three points stand for it and for all
 * that follow; of a first word they stand for its end. */
static void add_word(struct label *label, const char *word) {
  static const char rest[] = ", ...";
  char *text = label->layer->label;
  size_t used = strlen(text);
  if (label->full)
    return;
  append_text(text, LABEL_SIZE - 3, label->first ? " " : ", ");
  append_text(text, LABEL_SIZE, word);
  label->full = strlen(text) + sizeof rest > LABEL_SIZE;
  if (label->full && label->first) {
    text[used] = '\0';
    append_text(text, LABEL_SIZE - 3, " ");
    append_text(text, LABEL_SIZE - 3, word);
    append_text(text, LABEL_SIZE, "...");
  } else if (label->full) {
    text[used] = '\0';
    append_text(text, LABEL_SIZE, rest);
  }
  label->first = false;
}

static void add_groups(struct label *label, const struct pens *pens,
                       const struct scene *scene) {
  for (size_t g = 0; g < scene->group.count; g++) {
    const char *name = scene->group.item[g].name;
    if (pens->of_group[g] == label->layer->pen - 1 && name != NULL &&
        has_letters(name))
      add_word(label, name);
  }
}

/* Whether the pen is the one for hidden lines. */
static bool draws_hidden(const struct pens *pens, uint32_t pen,
                         const recto_options *options) {
  return (pens->of_hidden == pen && options->ink.hidden != RECTO_HIDDEN_NONE) ||
         (pens->of_hidden == PENS_NONE && pen == pens->count);
}

/* Whether only hidden lines are drawn with the pen. */
static bool is_for_hidden(const struct pens *pens, uint32_t pen) {
  bool alone = pens->of_hidden == pen && pens->of_hatch != pen;
  for (int i = 0; i < RECTO_EDGE_CLASS_COUNT; i++)
    alone = alone && pens->of_class[i] != pen;
  for (size_t g = 0; alone && g < pens->group_count; g++)
    alone = pens->of_group[g] != pen;
  return alone || pen == pens->count;
}

/* "2 crease, wheel, axle": the pen's number, then what it draws.
 * hidden_lies_apart  hidden lines of the pen have a layer of their own */
static void label_pen(struct drawing_layer *layer, const struct pens *pens,
                      const struct scene *scene, const recto_options *options,
                      bool hidden_lies_apart) {
  struct label label = {.layer = layer, .first = true};
  uint32_t pen = layer->pen - 1;
  bool has_rest = options->ink.pens <= 1 && pen == 0;
  if (has_rest)
    add_word(&label, "visible");
  for (unsigned i = 0; !has_rest && i < RECTO_EDGE_CLASS_COUNT; i++)
    if (pens->of_class[i] == pen && pens_is_drawn(options, i))
      add_word(&label, recto_edge_class_name((recto_edge_class)(1u << i)));
  if (draws_hidden(pens, pen, options) &&
      (!hidden_lies_apart || is_for_hidden(pens, pen)))
    add_word(&label, "hidden");
  if (pens->of_hatch == pen && options->ink.fill == RECTO_FILL_HATCH)
    add_word(&label, "hatch");
  if (!has_rest)
    add_groups(&label, pens, scene);
  if (label.first)
    add_word(&label, "unnamed");
}

static bool add_layer(struct drawing *drawing, const struct pens *pens,
                      uint32_t pen, uint32_t usual_colour) {
  bool own = pen < pens->own_count && pens->own[pen].has_colour;
  struct drawing_layer layer = {.pen = pen + 1,
                                .colour =
                                    own ? pens->own[pen].colour : usual_colour,
                                .width_mm = pens_width_mm(pens, pen)};
  (void)snprintf(layer.label, sizeof layer.label, "%u", layer.pen);
  return ARRAY_PUSH(&drawing->layer, layer);
}

/* Adds a layer for the hidden lines of each of the first `count` pens that
 * draws others too. */
static bool add_hidden_layers(struct drawing *drawing, const struct pens *pens,
                              uint32_t count) {
  for (uint32_t pen = 0; pen < count; pen++) {
    if (!add_layer(drawing, pens, pen, BLACK))
      return false;
    struct drawing_layer *layer = &drawing->layer.item[count + pen];
    append_text(layer->label, sizeof layer->label, " hidden");
    layer->hidden = !is_for_hidden(pens, pen);
  }
  return true;
}

bool layers_add(struct drawing *drawing, const struct pens *pens,
                const struct scene *scene, const recto_options *options) {
  bool one_more =
      options->ink.hidden == RECTO_HIDDEN_LAYER && pens->of_hidden == PENS_NONE;
  uint32_t count = pens->count + one_more;
  bool apart = !drawing->by_pens &&
               (count > 1 || drawing->by_groups ||
                options->ink.hidden == RECTO_HIDDEN_LAYER) &&
               options->ink.hidden != RECTO_HIDDEN_NONE;
  for (uint32_t pen = 0; pen < count; pen++) {
    if (!add_layer(drawing, pens, pen, is_for_hidden(pens, pen) ? GREY : BLACK))
      return false;
    label_pen(&drawing->layer.item[pen], pens, scene, options, apart);
  }
  return !apart || add_hidden_layers(drawing, pens, count);
}

/* ---- Packing ------------------------------------------------------------- */

/* Renumbers the layers that have strokes: number[old] is the new number.
 * Returns how many there are. */
static uint32_t number_used(const struct drawing *drawing, uint32_t *number) {
  size_t layers = drawing->layer.count;
  uint32_t used = 0;
  memset(number, 0, layers * sizeof *number);
  for (size_t i = 0; i < drawing->stroke.count; i++)
    number[drawing->stroke.item[i].layer] = 1;
  for (size_t i = 0; i < layers; i++)
    number[i] = number[i] ? used++ : DRAWING_NONE;
  return used;
}

/* Makes a layer for fills below all others, with a number that no pen has: what
 * reads fills as lines keeps them apart. */
static bool add_fill_layer(struct drawing *drawing) {
  struct drawing_layer layer = drawing->layer.item[0];
  unsigned greatest = 0;
  for (size_t i = 0; i < drawing->layer.count; i++)
    if (drawing->layer.item[i].pen > greatest)
      greatest = drawing->layer.item[i].pen;
  layer.pen = 0;
  layer.hidden = false;
  (void)snprintf(layer.label, sizeof layer.label, "%%%u fills", greatest + 1);
  if (drawing->stroke.count == 0) {
    drawing->layer.item[0] = layer;
    return true;
  }
  if (!ARRAY_PUSH(&drawing->layer, layer))
    return false;
  memmove(drawing->layer.item + 1, drawing->layer.item,
          (drawing->layer.count - 1) * sizeof layer);
  drawing->layer.item[0] = layer;
  for (size_t i = 0; i < drawing->stroke.count; i++)
    drawing->stroke.item[i].layer++;
  return true;
}

/* Moves hidden strokes to the layers for those of their pens, where there are
 * such layers. */
static void move_hidden_apart(struct drawing *drawing) {
  size_t pens = drawing->layer.count / 2;
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    struct drawing_stroke *stroke = &drawing->stroke.item[i];
    if (stroke->hidden && pens + stroke->layer < drawing->layer.count &&
        drawing->layer.item[pens + stroke->layer].hidden)
      stroke->layer += (uint32_t)pens;
  }
}

/* Moves the layers that have nothing but hidden lines below the others, and
 * sets number[old] accordingly. */
static void move_hidden_down(struct drawing *drawing, uint32_t *number,
                             struct drawing_layer *layer) {
  uint32_t count = (uint32_t)drawing->layer.count, next = 0;
  memset(number, 0, count * sizeof *number);
  for (size_t i = 0; i < drawing->stroke.count; i++)
    number[drawing->stroke.item[i].layer] |= !drawing->stroke.item[i].hidden;
  memcpy(layer, drawing->layer.item, count * sizeof *layer);
  for (uint32_t visible = 0; visible < 2; visible++)
    for (uint32_t i = 0; i < count; i++)
      if (number[i] == visible) {
        drawing->layer.item[next] = layer[i];
        number[i] = 2 + next++;
      }
  for (size_t i = 0; i < drawing->stroke.count; i++)
    drawing->stroke.item[i].layer = number[drawing->stroke.item[i].layer] - 2;
}

/* Removes the layers without strokes, and puts the others in order. */
static bool arrange_layers(struct drawing *drawing) {
  uint32_t *number = mem_alloc(drawing->layer.count, sizeof *number);
  if (number == NULL)
    return false;
  uint32_t used = number_used(drawing, number);
  for (size_t i = 0; i < drawing->layer.count; i++)
    if (number[i] != DRAWING_NONE)
      drawing->layer.item[number[i]] = drawing->layer.item[i];
  for (size_t i = 0; i < drawing->stroke.count; i++)
    drawing->stroke.item[i].layer = number[drawing->stroke.item[i].layer];
  if (drawing->layer.count > used)
    drawing->layer.count = used > 0 ? used : 1;
  struct drawing_layer *layer = mem_alloc(drawing->layer.count, sizeof *layer);
  if (layer != NULL && used > 1)
    move_hidden_down(drawing, number, layer);
  mem_free(layer);
  mem_free(number);
  return layer != NULL;
}

/* By groups the strokes of one are consecutive within a layer.  Hidden ones
 * are first. */
static int compare_layers(const void *first, const void *second, void *user) {
  const struct drawing_stroke *a = first, *b = second;
  const struct drawing *drawing = user;
  if (a->layer != b->layer)
    return a->layer > b->layer ? 1 : -1;
  if (drawing->by_groups && a->group != b->group)
    return a->group > b->group ? 1 : -1;
  return drawing->by_pens ? 0 : b->hidden - a->hidden;
}

/* With several weights the strokes of a class are consecutive: first hidden
 * ones, then the lightest classes, so that heavy lines lie on top. */
static int compare_strokes(const void *first, const void *second, void *user) {
  const struct drawing_stroke *a = first, *b = second;
  const struct drawing *drawing = user;
  int order = compare_layers(first, second, user);
  if (order != 0)
    return order;
  if (a->hidden != b->hidden)
    return a->hidden ? -1 : 1;
  if (a->edge_class == b->edge_class)
    return 0; /* as most are, and so wide as each other */
  double a_mm = drawing_width_mm(drawing, a),
         b_mm = drawing_width_mm(drawing, b);
  if (a_mm != b_mm)
    return a_mm > b_mm ? 1 : -1;
  return (a->edge_class < b->edge_class) - (a->edge_class > b->edge_class);
}

static int compare_fills(const void *first, const void *second, void *user) {
  const struct drawing_fill *a = first, *b = second;
  (void)user;
  return (a->group > b->group) - (a->group < b->group);
}

static bool has_weights(const struct drawing *drawing) {
  bool any = false;
  for (int i = 1; i < RECTO_EDGE_CLASS_COUNT; i++)
    any = any || drawing->weight[i] != drawing->weight[0];
  return any;
}

static bool has_hidden(const struct drawing *drawing) {
  for (size_t i = 0; i < drawing->stroke.count; i++)
    if (drawing->stroke.item[i].hidden)
      return true;
  return false;
}

bool layers_pack(struct drawing *drawing) {
  move_hidden_apart(drawing);
  if (!arrange_layers(drawing) ||
      (drawing->fill.count > 0 && !add_fill_layer(drawing)))
    return false;
  drawing->weighted = has_weights(drawing);
  if (drawing->by_groups &&
      !sort_stable(drawing->fill.item, drawing->fill.count,
                   sizeof *drawing->fill.item, compare_fills, NULL))
    return false;
  if (drawing->layer.count < 2 && !drawing->weighted && !drawing->by_groups &&
      (drawing->by_pens || !has_hidden(drawing)))
    return true;
  return sort_stable(
      drawing->stroke.item, drawing->stroke.count, sizeof *drawing->stroke.item,
      drawing->weighted ? compare_strokes : compare_layers, drawing);
}
