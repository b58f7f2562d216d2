/* vertex_fans.c - raises the bounds of page cells about the vertices of a
 * sheet. */
#include "visibility/culling/vertex_fans.h"

#include "base/sort.h"
#include "visibility/predicate/surrounder.h"

enum { FAN_MAX = 16 }; /* triangles about a vertex */

/* The triangles about a vertex, counter-clockwise, and each one's opposite
 * side. */
struct vertex_fan {
  int count;
  struct geom_point from[FAN_MAX], to[FAN_MAX];
  struct surrounder_plane plane[FAN_MAX];
};

/* The corners of triangles: by their vertex and the one after it; the value is
 * thrice the triangle and the corner. */
struct corner_list {
  const struct sheet *sheet;
  struct sort_key *item;
  size_t count;
};

static uint64_t corner_key(uint32_t vertex, uint32_t next) {
  return (uint64_t)vertex << 32 | next;
}

static bool list_fan_corners(struct corner_list *list) {
  size_t n = list->sheet->triangle.count;
  list->item = mem_alloc(3 * n, sizeof *list->item);
  for (size_t t = 0; list->item != NULL && t < n; t++)
    for (size_t k = 0; !sheet_is_edge_on(list->sheet, t) && k < 3; k++) {
      const uint32_t *point = list->sheet->triangle.item[t].point;
      list->item[list->count++] = (struct sort_key){
          corner_key(point[k], point[(k + 1) % 3]), (uint32_t)(3 * t + k)};
    }
  return list->item != NULL && sort_keys_alone(list->item, list->count);
}

/* Finds the triangles from list item `first` on, each beyond a side of the one
 * before.  Returns whether they go round the vertex. */
static bool go_round(const struct corner_list *list, size_t first,
                     struct vertex_fan *fan) {
  const struct sheet *sheet = list->sheet;
  uint32_t vertex = (uint32_t)(list->item[first].key >> 32);
  size_t at = first;
  for (fan->count = 0; fan->count < FAN_MAX; fan->count++) {
    uint32_t t = list->item[at].value / 3, k = list->item[at].value % 3;
    const uint32_t *point = sheet->triangle.item[t].point;
    uint32_t from = point[(k + 1) % 3], to = point[(k + 2) % 3];
    if (fan->count > 0 && at == first)
      return true;
    fan->from[fan->count] = sheet->point.item[from];
    fan->to[fan->count] = sheet->point.item[to];
    fan->plane[fan->count] = surrounder_plane_of(sheet, t);
    LOWER_BOUND(at, 0, list->count,
                list->item[at].key < corner_key(vertex, to));
    if (at == list->count || list->item[at].key != corner_key(vertex, to))
      return false;
  }
  return false;
}

/* Is the cell on the inner side of the side that triangle i of a fan has
 * opposite to the vertex? */
static bool is_within_side(const struct vertex_fan *fan, int i,
                           const struct box2 *cell) {
  const struct geom_point corner[4] = {{cell->x0, cell->y0, 0},
                                       {cell->x1, cell->y0, 0},
                                       {cell->x0, cell->y1, 0},
                                       {cell->x1, cell->y1, 0}};
  for (int k = 0; k < 4; k++)
    if (geom_orient2d(fan->from[i], fan->to[i], corner[k]) <= 0)
      return false;
  return true;
}

/* The bound of a cell, in steps; -1: the fan does not surround it. */
static int32_t bound_by_fan(const struct vertex_fan *fan,
                            const struct box2 *cell) {
  double low = INFINITY;
  for (int i = 0; i < fan->count; i++) {
    if (!is_within_side(fan, i, cell))
      return -1;
    low = fmin(low, surrounder_farthest_z(&fan->plane[i], cell));
  }
  return occlusion_steps_down(low);
}

/* Raises the bounds of the cells about a vertex: of the one in which it is, and
 * of those around. */
static void raise_about(struct occlusion_buffer *buffer,
                        const struct vertex_fan *fan,
                        struct geom_point vertex) {
  const struct triangle_grid *cells = &buffer->cells;
  int64_t side = INT64_C(1) << cells->shift;
  int x = triangle_grid_cell(vertex.x, cells->x0, cells->shift, cells->columns),
      y = triangle_grid_cell(vertex.y, cells->y0, cells->shift, cells->rows);
  /* The last column and row are not wholly within the page. */
  for (int cy = y > 0 ? y - 1 : 0; cy <= y + 1 && cy < cells->rows - 1; cy++)
    for (int cx = x > 0 ? x - 1 : 0; cx <= x + 1 && cx < cells->columns - 1;
         cx++) {
      int64_t x0 = cells->x0 + cx * side, y0 = cells->y0 + cy * side;
      const struct box2 cell = {(int32_t)x0, (int32_t)y0, (int32_t)(x0 + side),
                                (int32_t)(y0 + side)};
      occlusion_buffer_raise_cell(buffer, cx, cy, bound_by_fan(fan, &cell));
    }
}

bool vertex_fans_raise(struct occlusion_buffer *buffer,
                       const struct sheet *sheet) {
  struct corner_list list = {.sheet = sheet};
  bool ok = list_fan_corners(&list);
  for (size_t i = 0; ok && i < list.count; i++) {
    struct vertex_fan fan;
    uint32_t vertex = (uint32_t)(list.item[i].key >> 32);
    bool is_first = i == 0 || list.item[i - 1].key >> 32 != vertex;
    if (is_first && go_round(&list, i, &fan))
      raise_about(buffer, &fan, sheet->point.item[vertex]);
  }
  mem_free(list.item);
  return ok;
}
