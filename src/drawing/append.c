/* append.c - puts several drawings of one scene on one page. */
#include "drawing/append.h"

#include <stdio.h>
#include <string.h>

#include "base/poll.h"

/* Puts the view's name behind the number that a label opens with. */
static void insert_name(char label[], size_t size, const char *view) {
  char rest[sizeof(struct drawing_layer)];
  size_t number = strcspn(label, " ");
  (void)snprintf(rest, sizeof rest, "%s", label + number);
  (void)snprintf(label + number, size - number, " %s%s", view, rest);
}

static bool append_layers(struct drawing *drawing, const struct drawing *other,
                          const char *view) {
  for (size_t i = 0; i < other->layer.count; i++) {
    struct drawing_layer layer = other->layer.item[i];
    layer.view = view;
    insert_name(layer.label, sizeof layer.label, view);
    if (!ARRAY_PUSH(&drawing->layer, layer))
      return false;
  }
  return true;
}

/* Where the arrays of the drawing ended before. */
struct offsets {
  uint32_t layer, point, loop, control;
};

static bool append_strokes(struct drawing *drawing, const struct drawing *other,
                           const struct offsets *begin) {
  for (size_t i = 0; i < other->stroke.count; i++) {
    struct drawing_stroke stroke = other->stroke.item[i];
    stroke.layer += begin->layer;
    stroke.point += begin->point;
    if (!poll_at(i) || !ARRAY_PUSH(&drawing->stroke, stroke))
      return false;
  }
  for (size_t i = 0; i < other->curve.count; i++) {
    struct drawing_curve curve = other->curve.item[i];
    curve.control += begin->control;
    if (!poll_at(i) || !ARRAY_PUSH(&drawing->curve, curve))
      return false;
  }
  return true;
}

static bool append_fills(struct drawing *drawing, const struct drawing *other,
                         const struct offsets *begin) {
  for (size_t i = 0; i < other->fill.count; i++) {
    struct drawing_fill fill = other->fill.item[i];
    fill.layer += begin->layer;
    fill.loop += begin->loop;
    if (!poll_at(i) || !ARRAY_PUSH(&drawing->fill, fill))
      return false;
  }
  for (size_t i = 0; i < other->loop.count; i++) {
    struct drawing_loop loop = other->loop.item[i];
    loop.point += begin->point;
    if (!poll_at(i) || !ARRAY_PUSH(&drawing->loop, loop))
      return false;
  }
  return true;
}

static bool append_points(struct drawing *drawing,
                          const struct drawing *other) {
  for (size_t i = 0; i < other->point.count; i++)
    if (!poll_at(i) || !ARRAY_PUSH(&drawing->point, other->point.item[i]))
      return false;
  for (size_t i = 0; i < other->control.count; i++)
    if (!poll_at(i) || !ARRAY_PUSH(&drawing->control, other->control.item[i]))
      return false;
  return true;
}

/* Sources are there for all strokes and fills, or for none. */
static bool append_sources(struct drawing *drawing,
                           const struct drawing *other) {
  for (size_t i = 0; i < other->stroke_source.count; i++)
    if (!ARRAY_PUSH(&drawing->stroke_source, other->stroke_source.item[i]))
      return false;
  for (size_t i = 0; i < other->fill_source.count; i++)
    if (!ARRAY_PUSH(&drawing->fill_source, other->fill_source.item[i]))
      return false;
  return true;
}

static bool append_group_names(struct drawing *drawing,
                               const struct drawing *other) {
  for (size_t i = drawing->group_name.count; i < other->group_name.count; i++) {
    char *copy = mem_copy_text(other->group_name.item[i]);
    if (copy == NULL || !ARRAY_PUSH(&drawing->group_name, copy)) {
      mem_free(copy);
      return false;
    }
  }
  return true;
}

static void append_counts(struct drawing_counts *counts,
                          const struct drawing_counts *more) {
  counts->segments += more->segments;
  counts->without_length += more->without_length;
  counts->drawn_twice += more->drawn_twice;
  counts->too_short += more->too_short;
  counts->covered += more->covered;
  counts->pen_lifts += more->pen_lifts;
  counts->travel_before_mm += more->travel_before_mm;
}

/* Whether indices of 32 bits still count what two arrays hold together. */
static bool is_countable(size_t count, size_t more) {
  return more <= UINT32_MAX - count;
}

static bool are_countable(const struct drawing *drawing,
                          const struct drawing *other) {
  return is_countable(drawing->point.count, other->point.count) &&
         is_countable(drawing->loop.count, other->loop.count) &&
         is_countable(drawing->control.count, other->control.count);
}

recto_status drawing_append(struct drawing *drawing,
                            const struct drawing *other, const char *view,
                            recto_error *error) {
  if (!are_countable(drawing, other))
    return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                     "the views together have more than 2^32 points");
  const struct offsets begin = {
      (uint32_t)drawing->layer.count, (uint32_t)drawing->point.count,
      (uint32_t)drawing->loop.count, (uint32_t)drawing->control.count};
  drawing->width_mm = other->width_mm;
  drawing->height_mm = other->height_mm;
  drawing->seam_mm = other->seam_mm;
  memcpy(drawing->weight, other->weight, sizeof drawing->weight);
  drawing->weighted = other->weighted;
  drawing->by_pens = other->by_pens;
  drawing->by_groups = other->by_groups;
  drawing->ids = other->ids;
  append_counts(&drawing->counts, &other->counts);
  return append_layers(drawing, other, view) &&
                 append_strokes(drawing, other, &begin) &&
                 append_fills(drawing, other, &begin) &&
                 append_points(drawing, other) &&
                 append_sources(drawing, other) &&
                 append_group_names(drawing, other)
             ? RECTO_OK
             : error_memory(error);
}
