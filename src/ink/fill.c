/* fill.c - one fill for each visible fragment, painted or shaded. */
#include "ink/fill.h"

#include <math.h>

#include "ink/layers.h"

/* Muted, so that lines stay the picture, and apart in hue or in lightness. */
static const uint32_t palette[] = {
    0x9db4c8, 0xe0c29a, 0xa9c4a0, 0xd3a39c, 0xb9aecb, 0xd9d3a4,
    0x8fb5b0, 0xc4a586, 0xc7d4de, 0xe3b8a0, 0x96a68a, 0xcfb3c3,
};

uint32_t fill_colour(const struct scene *scene, uint32_t group) {
  if (group < scene->group.count && scene->group.item[group].has_colour)
    return scene->group.item[group].colour;
  return palette[group % (sizeof palette / sizeof palette[0])];
}

/* ---- Shade ----------------------------------------------------------------
 */

struct vector {
  double x, y, z;
};

static double dot(struct vector a, struct vector b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

static struct vector normalise(struct vector a) {
  double length = sqrt(dot(a, a));
  if (!(length > 0))
    return a;
  return (struct vector){a.x / length, a.y / length, a.z / length};
}

static struct vector of_array(const double v[3]) {
  return (struct vector){v[0], v[1], v[2]};
}

/* Towards the light, of unit length; over the viewer's left shoulder where
 * none was given. */
static struct vector choose_light(const struct camera *camera,
                                  const recto_options *options) {
  struct vector light = of_array(options->light);
  if (dot(light, light) > 0)
    return normalise(light);
  struct vector right = of_array(camera->right), up = of_array(camera->up);
  struct vector back = of_array(camera->back);
  return normalise((struct vector){back.x + (up.x - right.x) / 2,
                                   back.y + (up.y - right.y) / 2,
                                   back.z + (up.z - right.z) / 2});
}

/* The normal of a face by Newell's sums, of unit length, on the side that is
 * seen; measured from its first corner, so that far models lose nothing. */
static struct vector seen_normal(const struct scene *scene, uint32_t face,
                                 const struct camera *camera) {
  const uint32_t *corner = scene->corner.item + scene->face_start.item[face];
  uint32_t count =
      scene->face_start.item[face + 1] - scene->face_start.item[face];
  struct scene_point o = scene->point.item[corner[0]];
  struct vector n = {0, 0, 0};
  for (uint32_t i = 0; i < count; i++) {
    struct scene_point p = scene->point.item[corner[i]];
    struct scene_point q = scene->point.item[corner[(i + 1) % count]];
    struct vector a = {p.x - o.x, p.y - o.y, p.z - o.z};
    struct vector b = {q.x - o.x, q.y - o.y, q.z - o.z};
    n.x += (a.y - b.y) * (a.z + b.z);
    n.y += (a.z - b.z) * (a.x + b.x);
    n.z += (a.x - b.x) * (a.y + b.y);
  }
  struct vector eye = of_array(camera->back);
  if (camera->perspective)
    eye = (struct vector){camera->eye[0] - o.x, camera->eye[1] - o.y,
                          camera->eye[2] - o.z};
  if (dot(n, eye) < 0)
    n = (struct vector){-n.x, -n.y, -n.z};
  return normalise(n);
}

static uint32_t grey_of(struct vector normal, struct vector light) {
  const double darkest = 0.3; /* where the light does not reach */
  double lit = dot(normal, light);
  double share = darkest + (1 - darkest) * (lit > 0 ? lit : 0);
  uint32_t level = (uint32_t)(255 * (share < 1 ? share : 1) + 0.5);
  return level << 16 | level << 8 | level;
}

/* ---- Fills ----------------------------------------------------------------
 */

static bool add_loops(struct drawing *drawing, const struct sheet *sheet,
                      const struct map *map,
                      const struct map_fragment *fragment) {
  for (uint32_t l = 0; l < fragment->loops; l++) {
    const struct map_loop *loop = &map->loop.item[fragment->loop + l];
    struct drawing_loop made = {(uint32_t)drawing->point.count, loop->count};
    if (!ARRAY_RESERVE(&drawing->point, loop->count) ||
        !ARRAY_PUSH(&drawing->loop, made))
      return false;
    for (uint32_t i = 0; i < loop->count; i++) {
      const struct map_corner *c = &map->corner.item[loop->corner + i];
      drawing->point.item[drawing->point.count++] = (struct drawing_point){
          sheet_x_mm(sheet, c->x), sheet_y_mm(sheet, c->y)};
    }
  }
  return true;
}

bool fill_add(struct drawing *drawing, const struct sheet *sheet,
              const struct scene *scene, const struct map *map,
              const recto_options *options) {
  struct vector light = choose_light(&sheet->camera, options);
  for (size_t i = 0; i < map->fragment.count; i++) {
    const struct map_fragment *fragment = &map->fragment.item[i];
    uint32_t group = scene->face_group.item[fragment->face];
    struct drawing_fill fill = {.loop = (uint32_t)drawing->loop.count,
                                .loops = fragment->loops,
                                .layer = layers_pen_of_group(options, group),
                                .face = fragment->face,
                                .group = group};
    fill.colour =
        options->fill == RECTO_FILL_SHADE
            ? grey_of(seen_normal(scene, fragment->face, &sheet->camera), light)
            : fill_colour(scene, group);
    if (!add_loops(drawing, sheet, map, fragment) ||
        !ARRAY_PUSH(&drawing->fill, fill))
      return false;
  }
  return true;
}
