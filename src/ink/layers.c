/* layers.c - the drawing's layers: one a pen, one for what is hidden. */
#include "ink/layers.h"

#include <stdio.h>
#include <string.h>

#include "base/sort.h"

#define BLACK 0x000000u
#define GREY 0x808080u /* hidden lines on a screen; a pen has its own colour   \
                        */

/* Appends to a label what fits of `text`, never half a character. */
static void append(char label[], size_t size, const char *text) {
  size_t used = strlen(label), length = strlen(text);
  if (length > size - 1 - used) {
    length = size - 1 - used;
    while (length > 0 && ((unsigned char)text[length] & 0xc0) == 0x80)
      length--;
  }
  memcpy(label + used, text, length);
  label[used + length] = '\0';
}

/* "2 wheel, axle": the pen's number and the groups it draws. */
static void label_pen(struct drawing_layer *layer, const struct scene *scene,
                      const recto_options *options) {
  bool first = true;
  for (size_t g = layer->pen - 1; g < scene->group.count;
       g += (size_t)options->pens) {
    const char *name = scene->group.item[g].name;
    if (!name || !*name)
      continue;
    append(layer->label, sizeof layer->label, first ? " " : ", ");
    append(layer->label, sizeof layer->label, name);
    first = false;
  }
  if (first)
    append(layer->label, sizeof layer->label, " unnamed");
}

static bool add_layer(struct drawing *drawing, const char *words,
                      uint32_t colour, double width_mm) {
  struct drawing_layer layer = {.pen = (unsigned)drawing->layer.count + 1,
                                .colour = colour,
                                .width_mm = width_mm};
  (void)snprintf(layer.label, sizeof layer.label, "%u%s", layer.pen, words);
  return ARRAY_PUSH(&drawing->layer, layer);
}

bool layers_add(struct drawing *drawing, const struct scene *scene,
                const recto_options *options) {
  uint32_t pens = layers_pen_count(scene, options);
  if (options->pens <= 1 &&
      !add_layer(drawing, " visible", BLACK, options->pen_mm))
    return false;
  for (uint32_t i = 0; options->pens > 1 && i < pens; i++) {
    if (!add_layer(drawing, "", BLACK, options->pen_mm))
      return false;
    label_pen(&drawing->layer.item[i], scene, options);
  }
  return options->hidden != RECTO_HIDDEN_LAYER ||
         add_layer(drawing, " hidden", GREY, options->pen_mm);
}

/* ---- Packing --------------------------------------------------------------
 */

/* Numbers the layers in use anew: number[old] is the new one.  Returns how
 * many there are. */
static uint32_t number_used(const struct drawing *drawing, uint32_t *number) {
  size_t layers = drawing->layer.count;
  uint32_t used = 0;
  memset(number, 0, layers * sizeof *number);
  for (size_t i = 0; i < drawing->stroke.count; i++)
    number[drawing->stroke.item[i].layer] = 1;
  for (size_t i = 0; i < drawing->fill.count; i++)
    number[drawing->fill.item[i].layer] = 1;
  for (size_t i = 0; i < layers; i++)
    used += number[i];
  if (used == 0 && layers > 0)
    used = number[0] = 1;
  for (size_t i = 0, next = 0; i < layers; i++)
    number[i] = number[i] ? (uint32_t)next++ : DRAWING_NONE;
  return used;
}

static int compare_strokes(const void *first, const void *second, void *user) {
  const struct drawing_stroke *a = first, *b = second;
  (void)user;
  return (a->layer > b->layer) - (a->layer < b->layer);
}

static int compare_fills(const void *first, const void *second, void *user) {
  const struct drawing_fill *a = first, *b = second;
  (void)user;
  return (a->layer > b->layer) - (a->layer < b->layer);
}

bool layers_pack(struct drawing *drawing) {
  uint32_t *number = mem_alloc(drawing->layer.count, sizeof *number);
  if (!number)
    return false;
  uint32_t used = number_used(drawing, number);
  for (size_t i = 0; i < drawing->layer.count; i++)
    if (number[i] != DRAWING_NONE)
      drawing->layer.item[number[i]] = drawing->layer.item[i];
  drawing->layer.count = used;
  for (size_t i = 0; i < drawing->stroke.count; i++)
    drawing->stroke.item[i].layer = number[drawing->stroke.item[i].layer];
  for (size_t i = 0; i < drawing->fill.count; i++)
    drawing->fill.item[i].layer = number[drawing->fill.item[i].layer];
  mem_free(number);
  if (used < 2)
    return true;
  return sort_stable(drawing->stroke.item, drawing->stroke.count,
                     sizeof *drawing->stroke.item, compare_strokes, NULL) &&
         sort_stable(drawing->fill.item, drawing->fill.count,
                     sizeof *drawing->fill.item, compare_fills, NULL);
}
