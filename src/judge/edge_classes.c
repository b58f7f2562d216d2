/* edge_classes.c - decides what an edge is: silhouette, crease, group border or
 * smooth. */
#include "judge/edge_classes.h"

#include "base/poll.h"
#include "judge/camera.h"
#include "judge/triangulation.h"

/* ---- Facings ------------------------------------------------------------- */

/* The corner of a face whose image is farthest from a point of the page. */
static struct judge_point2 farthest_image(const struct judge_facings *facings,
                                          uint32_t start, uint32_t count,
                                          struct judge_point2 from) {
  struct judge_point2 best = from;
  double most = 0;
  for (uint32_t c = start; c < start + count; c++) {
    struct judge_point2 at = judge_project(
        facings->camera,
        judge_point3_at(facings->scene, facings->scene->corner.item[c]));
    double away = hypot(at.x - from.x, at.y - from.y);
    if (away > most) {
      most = away;
      best = at;
    }
  }
  return best;
}

/* How far on the page the contact tolerance and rounding may move a point of
 * this position, mm. */
static double thickness_at(const struct judge_facings *facings, double contact,
                           struct judge_point3 at) {
  struct judge_point3 beside = judge_shift(facings->camera, at, 1, 0);
  double unit = point3_length(point3_sub(beside, at)); /* a mm there */
  return facings->options->ray_offset_mm + 2 * contact / unit;
}

/* Whether the images of all corners of a face are on one line, within that
 * distance. */
static bool is_thin(const struct judge_facings *facings, uint32_t face,
                    double contact) {
  const struct scene *scene = facings->scene;
  const struct judge_camera *camera = facings->camera;
  uint32_t start = scene->face_start.item[face];
  uint32_t count = scene->face_start.item[face + 1] - start;
  for (uint32_t c = start; c < start + count; c++)
    if (!(judge_ahead(camera, judge_point3_at(scene, scene->corner.item[c])) >
          judge_near(camera)))
      return false;
  struct judge_point2 first =
      judge_project(camera, judge_point3_at(scene, scene->corner.item[start]));
  struct judge_point2 a = farthest_image(facings, start, count, first);
  struct judge_point2 b = farthest_image(facings, start, count, a);
  double length = hypot(b.x - a.x, b.y - a.y);
  for (uint32_t c = start; c < start + count; c++) {
    struct judge_point3 position =
        judge_point3_at(scene, scene->corner.item[c]);
    struct judge_point2 p = judge_project(camera, position);
    double off = fabs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x));
    if (off > length * thickness_at(facings, contact, position))
      return false;
  }
  return true;
}

static struct judge_facing facing_of(const struct judge_facings *facings,
                                     uint32_t face, double contact) {
  struct judge_point3 sum = judge_area(facings->scene, face);
  struct judge_facing facing = {.flat = !(point3_length(sum) > 0)};
  if (!facing.flat)
    facing.normal = point3_unit(sum);
  const uint32_t *start = facings->scene->face_start.item + face;
  facing.open =
      start[1] - start[0] > JUDGE_TRIANGULATION_MAX &&
      judge_is_warped(facings->scene, face, facings->options->contact);
  facing.thin = is_thin(facings, face, contact);
  return facing;
}

/* The sine of the angle between a plane and the view ray through a point of
 * it. */
static double slope(const struct judge_facings *facings,
                    struct judge_point3 normal, struct judge_point3 at) {
  const struct judge_camera *camera = facings->camera;
  struct judge_point3 view = camera->perspective
                                 ? point3_unit(point3_sub(camera->eye, at))
                                 : camera->back;
  return point3_dot(normal, view);
}

/* Whether a triangle's image is so thick that rounding cannot turn it over. */
static bool is_thick(const struct judge_facings *facings,
                     const struct judge_triangle *t) {
  struct judge_point2 p[3];
  double longest = 0;
  for (int k = 0; k < 3; k++) {
    if (!(judge_ahead(facings->camera, t->p[k]) > judge_near(facings->camera)))
      return true;
    p[k] = judge_project(facings->camera, t->p[k]);
  }
  for (int k = 0; k < 3; k++)
    longest = fmax(longest,
                   hypot(p[(k + 1) % 3].x - p[k].x, p[(k + 1) % 3].y - p[k].y));
  return fabs((p[1].x - p[0].x) * (p[2].y - p[0].y) -
              (p[1].y - p[0].y) * (p[2].x - p[0].x)) >
         longest * facings->options->ray_offset_mm;
}

double judge_fan_slope(const struct judge_facings *facings,
                       const struct judge_side_triangle *side_triangle,
                       struct judge_point3 at) {
  bool sure = !facings->facing[side_triangle->face].thin &&
              is_thick(facings, &side_triangle->triangle);
  return sure ? slope(facings, side_triangle->triangle.normal, at) : 0;
}

/* The slope of a face at one of its sides; of a face that is not planar, that
 * of the triangle with this side.  0 where it is not sure. */
static double slope_at_side(const struct judge_facings *facings,
                            const struct judge_side *side) {
  struct judge_point3 at = judge_point3_at(facings->scene, side->a);
  const struct judge_facing *facing = &facings->facing[side->face];
  size_t fan;
  const struct judge_side_triangle *side_triangle =
      judge_fan_along(facings->all, side->face, side->a, side->b, &fan);
  if (fan > 0)
    return fan == 1 ? judge_fan_slope(facings, side_triangle, at) : 0;
  return facing->flat || facing->open || facing->thin
             ? 0
             : slope(facings, facing->normal, at);
}

unsigned judge_class_mask_of_pair(const struct judge_facings *facings,
                                  const struct judge_side *s,
                                  const struct judge_side *t, bool against) {
  const struct judge_facing *f = &facings->facing[s->face];
  const struct judge_facing *g = &facings->facing[t->face];
  unsigned class_mask = 0;
  if (scene_groups_differ(facings->scene,
                          facings->scene->face_group.item[s->face],
                          facings->scene->face_group.item[t->face]))
    class_mask |= RECTO_EDGE_GROUP;
  double one = slope_at_side(facings, s), two = slope_at_side(facings, t);
  if (judge_is_silhouette(one, against ? two : -two))
    class_mask |= RECTO_EDGE_SILHOUETTE;
  if (f->flat || g->flat)
    return class_mask;
  double cosine = point3_dot(f->normal, g->normal);
  cosine = against ? cosine : -cosine;
  double crease = cos(facings->options->crease_deg / 180 * acos(-1));
  if (cosine < crease - TOLERANCE_JUDGE_ANGLE)
    class_mask |= RECTO_EDGE_CREASE;
  if (class_mask == 0 && cosine > crease + TOLERANCE_JUDGE_ANGLE &&
      judge_is_sure(one, two))
    class_mask = RECTO_EDGE_SMOOTH;
  return class_mask;
}

bool judge_facings_init(struct judge_facings *facings,
                        const struct judge_triangles *all,
                        const struct judge_camera *camera,
                        const struct judge_options *options) {
  *facings = (struct judge_facings){all, all->scene, camera, options, NULL};
  uint32_t faces = scene_face_count(facings->scene);
  facings->facing = mem_alloc(faces, sizeof *facings->facing);
  if (facings->facing == NULL)
    return false;
  double *contact = mem_calloc(faces, sizeof *contact);
  if (contact == NULL)
    return false;
  for (size_t t = 0; t < facings->all->triangle.count; t++) {
    const struct judge_triangle *triangle = &facings->all->triangle.item[t];
    contact[triangle->face] = fmax(contact[triangle->face], triangle->contact);
  }
  for (uint32_t i = 0; i < faces && poll_at(i); i++)
    facings->facing[i] = facing_of(facings, i, contact[i]);
  mem_free(contact);
  return true;
}

void judge_facings_fini(struct judge_facings *facings) {
  mem_free(facings->facing);
  facings->facing = NULL;
}
