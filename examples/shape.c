/* shape.c - see shape.h. */
#include "examples/shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Makes room for one more item in a block, or ends the program. */
static void *grow(void *block, size_t count, size_t *room, size_t size) {
  if (count < *room)
    return block;
  *room = *room == 0 ? 256 : 2 * *room;
  block = realloc(block, *room * size);
  if (block == NULL) {
    fputs("generate: out of memory\n", stderr);
    exit(1);
  }
  return block;
}

struct point3 point3_polar(double radius, double radians, double z) {
  return point3_of(radius * cos(radians), radius * sin(radians), z);
}

struct point3 point3_between(struct point3 a, struct point3 b, double t) {
  return point3_of(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y),
                   a.z + t * (b.z - a.z));
}

void shape_free(struct shape *shape) {
  free(shape->point);
  free(shape->word);
  free(shape->group);
  *shape = (struct shape){0};
}

void shape_group(struct shape *shape, const char *name) {
  shape->group = grow(shape->group, shape->groups, &shape->group_room,
                      sizeof *shape->group);
  struct shape_group *group = &shape->group[shape->groups++];
  snprintf(group->name, sizeof group->name, "%s", name);
  group->point = shape->points;
  group->word = shape->words;
}

uint32_t shape_point(struct shape *shape, struct point3 at) {
  shape->point = grow(shape->point, shape->points, &shape->point_room,
                      sizeof *shape->point);
  shape->point[shape->points] = at;
  return (uint32_t)shape->points++;
}

static void add_word(struct shape *shape, uint32_t word) {
  shape->word =
      grow(shape->word, shape->words, &shape->word_room, sizeof *shape->word);
  shape->word[shape->words++] = word;
}

void shape_face(struct shape *shape, const uint32_t *point, size_t count) {
  add_word(shape, (uint32_t)count);
  for (size_t i = 0; i < count; i++)
    add_word(shape, point[i]);
}

void shape_triangle(struct shape *shape, uint32_t a, uint32_t b, uint32_t c) {
  uint32_t point[3] = {a, b, c};
  shape_face(shape, point, 3);
}

void shape_quad(struct shape *shape, uint32_t a, uint32_t b, uint32_t c,
                uint32_t d) {
  uint32_t point[4] = {a, b, c, d};
  shape_face(shape, point, 4);
}

uint32_t shape_raise(struct shape *shape, uint32_t first, uint32_t count,
                     double rise) {
  uint32_t raised = (uint32_t)shape->points;
  for (uint32_t i = 0; i < count; i++) {
    struct point3 at = shape->point[first + i];
    at.z += rise;
    shape_point(shape, at);
  }
  return raised;
}

void shape_band(struct shape *shape, uint32_t low, uint32_t high,
                uint32_t count) {
  for (uint32_t i = 0; i < count; i++) {
    uint32_t k = (i + 1) % count;
    shape_quad(shape, low + i, low + k, high + k, high + i);
  }
}

void shape_lid(struct shape *shape, uint32_t ring, uint32_t count,
               bool from_above) {
  add_word(shape, count);
  for (uint32_t i = 0; i < count; i++)
    add_word(shape, ring + (from_above ? i : count - 1 - i));
}

void shape_prism(struct shape *shape, const struct point3 *corner,
                 uint32_t count, struct point3 push) {
  uint32_t low = (uint32_t)shape->points;
  for (uint32_t i = 0; i < count; i++)
    shape_point(shape, corner[i]);
  for (uint32_t i = 0; i < count; i++)
    shape_point(shape, point3_of(corner[i].x + push.x, corner[i].y + push.y,
                                 corner[i].z + push.z));
  shape_band(shape, low, low + count, count);
  shape_lid(shape, low, count, false);
  shape_lid(shape, low + count, count, true);
}

void shape_box(struct shape *shape, struct point3 low, struct point3 high) {
  const struct point3 corner[4] = {
      low,
      {high.x, low.y, low.z},
      {high.x, high.y, low.z},
      {low.x, high.y, low.z},
  };
  shape_prism(shape, corner, 4, point3_of(0, 0, high.z - low.z));
}

void shape_cylinder(struct shape *shape, struct point3 foot, double radius,
                    double height, uint32_t sides) {
  const double turn = 2 * acos(-1);
  uint32_t low = (uint32_t)shape->points;
  for (uint32_t i = 0; i < sides; i++) {
    struct point3 at = point3_polar(radius, turn * i / sides, foot.z);
    shape_point(shape, point3_of(at.x + foot.x, at.y + foot.y, foot.z));
  }
  uint32_t high = shape_raise(shape, low, sides, height);
  shape_band(shape, low, high, sides);
  shape_lid(shape, low, sides, false);
  shape_lid(shape, high, sides, true);
}

/* Writes a coordinate without a minus before zeros, without idle zeros. */
static void write_number(double value, FILE *file) {
  char text[64];
  snprintf(text, sizeof text, "%.4f", value);
  size_t length = strlen(text);
  while (text[length - 1] == '0')
    text[--length] = '\0';
  if (text[length - 1] == '.')
    text[--length] = '\0';
  fprintf(file, " %s", strcmp(text, "-0") == 0 ? "0" : text);
}

/* Numbers the points that a face uses, from 1, in their order; 0: unused. */
static uint32_t *number_points(const struct shape *shape) {
  uint32_t *number = calloc(shape->points + 1, sizeof *number), count = 0;
  if (number == NULL)
    return NULL;
  for (size_t i = 0; i < shape->words; i += shape->word[i] + 1)
    for (uint32_t k = 1; k <= shape->word[i]; k++)
      number[shape->word[i + k]] = 1;
  for (size_t i = 0; i < shape->points; i++)
    if (number[i] != 0)
      number[i] = ++count;
  return number;
}

static void write_group(const struct shape *shape, size_t which,
                        const uint32_t *number, FILE *file) {
  const struct shape_group *group = &shape->group[which], *next = group + 1;
  bool last = which + 1 == shape->groups;
  size_t point_end = last ? shape->points : next->point;
  size_t word_end = last ? shape->words : next->word;
  fprintf(file, "g %s\n", group->name);
  for (size_t i = group->point; i < point_end; i++) {
    if (number[i] == 0)
      continue;
    fputs("v", file);
    write_number(shape->point[i].x, file);
    write_number(shape->point[i].z, file);
    write_number(-shape->point[i].y, file);
    fputs("\n", file);
  }
  for (size_t i = group->word; i < word_end; i += shape->word[i] + 1) {
    fputs("f", file);
    for (uint32_t k = 1; k <= shape->word[i]; k++)
      fprintf(file, " %lu", (unsigned long)number[shape->word[i + k]]);
    fputs("\n", file);
  }
}

bool shape_write(const struct shape *shape, const char *title, FILE *file) {
  uint32_t *number = number_points(shape);
  if (number == NULL)
    return false;
  fprintf(file, "# %s\n", title);
  for (size_t i = 0; i < shape->groups; i++)
    write_group(shape, i, number, file);
  free(number);
  return !ferror(file);
}
