/* ply_colour.c - colours of a PLY file, which become groups.
 *
 * A scan has a colour for each of its vertices, and so as many of its faces;
 * so many groups would be of no use.  What agrees in the upper bits of red,
 * green and blue is taken together. */
#include "scene/ply/ply_colour.h"

#include <math.h>
#include <stdio.h>

#include "base/sort.h"

static uint32_t part_of(const struct ply_parser *p,
                        const struct ply_element *element, enum ply_role role) {
  const struct ply_property *property =
      p->header.property.item + element->property;
  while (property->role != role)
    property++;
  double scale = 1;
  if (property->type == PLY_FLOAT32 || property->type == PLY_FLOAT64)
    scale = 255;
  else if (property->type == PLY_UINT16)
    scale = 1 / 257.0;
  /* fmax passes over what is no number. */
  return (uint32_t)(fmin(fmax(p->value[role] * scale, 0), 255) + 0.5);
}

uint32_t ply_colour_of(const struct ply_parser *p,
                       const struct ply_element *element) {
  return part_of(p, element, PLY_RED) << 16 |
         part_of(p, element, PLY_GREEN) << 8 | part_of(p, element, PLY_BLUE);
}

/* Sums of colours, to find their mean. */
struct sum {
  uint64_t part[3], count;
};

static void sum_add(struct sum *sum, uint32_t colour) {
  for (int k = 0; k < 3; k++)
    sum->part[k] += colour >> (16 - 8 * k) & 255;
  sum->count++;
}

static uint32_t sum_mean(const struct sum *sum) {
  uint32_t colour = 0;
  for (int k = 0; k < 3; k++)
    colour =
        colour << 8 | (uint32_t)((sum->part[k] + sum->count / 2) / sum->count);
  return colour;
}

uint32_t ply_mean_colour(const struct ply_parser *p, const uint32_t *corner,
                         size_t count) {
  struct sum sum = {{0, 0, 0}, 0};
  for (size_t i = 0; i < count; i++)
    sum_add(&sum, p->vertex_colour.item[corner[i] - p->first]);
  return sum_mean(&sum);
}

/* ---- Groups -------------------------------------------------------------- */

/* The upper bits of a colour that are compared. */
static uint32_t mask_of(int bits) {
  uint32_t part = 0xffu << (8 - bits) & 0xff;
  return part << 16 | part << 8 | part;
}

/* Keys of the coloured faces by their colour within the mask, sorted; faces
 * of one key are in their order.  Returns how many keys differ. */
static size_t sort_within(const struct ply_parser *p, uint32_t mask,
                          struct sort_key *key, size_t count) {
  size_t different = count > 0, n = 0;
  for (size_t i = 0; i < p->face_colour.count; i++)
    if (p->face_colour.item[i] != PLY_NO_COLOUR)
      key[n++] = (struct sort_key){p->face_colour.item[i] & mask, (uint32_t)i};
  sort_keys(key, key + count, count);
  for (size_t i = 1; i < count; i++)
    different += key[i].key != key[i - 1].key;
  return different;
}

/* Gives all faces of a run of equal keys the mean of their colours.  Returns
 * where the run ends. */
static size_t average_run(struct ply_parser *p, const struct sort_key *key,
                          size_t start, size_t count) {
  struct sum sum = {{0, 0, 0}, 0};
  size_t end = start;
  for (; end < count && key[end].key == key[start].key; end++)
    sum_add(&sum, p->face_colour.item[key[end].value]);
  for (size_t i = start; i < end; i++)
    p->face_colour.item[key[i].value] = sum_mean(&sum);
  return end;
}

static recto_status use_colour(struct scene *scene, uint32_t colour,
                               recto_error *error) {
  char name[32];
  int length = snprintf(name, sizeof name, "colour #%06x", (unsigned)colour);
  recto_status status = scene_use_group(scene, name, (size_t)length, error);
  if (status != RECTO_OK)
    return status;
  struct scene_group *group = &scene->group.item[scene->current_group];
  group->colour = colour;
  group->has_colour = true;
  group->is_shade = true;
  return RECTO_OK;
}

/* Groups are made as their colours come in the file. */
static recto_status use_groups(struct ply_parser *p, size_t first) {
  struct scene *scene = p->scene;
  uint32_t before = scene->current_group, colour = PLY_NO_COLOUR;
  recto_status status =
      scene_list_groups(scene) ? RECTO_OK : error_memory(p->error);
  for (size_t i = 0; i < p->face_colour.count && status == RECTO_OK; i++) {
    if (p->face_colour.item[i] == PLY_NO_COLOUR)
      continue;
    if (p->face_colour.item[i] != colour) {
      colour = p->face_colour.item[i];
      status = use_colour(scene, colour, p->error);
    }
    scene->face_group.item[first + i] = scene->current_group;
  }
  scene->current_group = before;
  return status;
}

recto_status ply_colour_faces(struct ply_parser *p, size_t first) {
  size_t count = 0;
  for (size_t i = 0; i < p->face_colour.count; i++)
    count += p->face_colour.item[i] != PLY_NO_COLOUR;
  struct sort_key *key = mem_alloc(2 * count, sizeof *key);
  if (key == NULL)
    return error_memory(p->error);
  int bits = 8;
  while (sort_within(p, mask_of(bits), key, count) > PLY_COLOUR_MAX)
    bits--;
  for (size_t i = 0; i < count;)
    i = average_run(p, key, i, count);
  mem_free(key);
  return use_groups(p, first);
}
