/* edge_classes.c - decides what an edge is: silhouette, crease, group border or
 * smooth. */
#include "judge/edge_classes.h"

#include "base/poll.h"
#include "judge/camera.h"
#include "judge/clipped_triangle.h"
#include "judge/triangulation.h"
#include "scene/edges/crease_rounding.h"

/* ---- Facings ------------------------------------------------------------- */

/* How far on the page the contact tolerance and rounding may move a point of
 * this position, mm. */
static double thickness_at(const struct judge_facings *facings, double contact,
                           struct judge_point3 at) {
  struct judge_point3 beside = judge_shift(facings->camera, at, 1, 0);
  double unit = point3_length(point3_sub(beside, at)); /* a mm there */
  return facings->options->ray_offset_mm + 2 * contact / unit;
}

/* The point whose image is farthest from one on the page. */
static struct judge_point2 farthest_image(const struct judge_camera *camera,
                                          const struct judge_point3 *point,
                                          size_t count,
                                          struct judge_point2 from) {
  struct judge_point2 best = from;
  double most = 0;
  for (size_t i = 0; i < count; i++) {
    struct judge_point2 at = judge_project(camera, point[i]);
    double away = hypot(at.x - from.x, at.y - from.y);
    if (away > most) {
      most = away;
      best = at;
    }
  }
  return best;
}

/* Whether the images of points in front of the eye are on one line, within what
 * contact and rounding may move them. */
static bool are_in_line(const struct judge_facings *facings,
                        const struct judge_point3 *point, size_t count,
                        double contact) {
  const struct judge_camera *camera = facings->camera;
  struct judge_point2 a =
      farthest_image(camera, point, count, judge_project(camera, point[0]));
  struct judge_point2 b = farthest_image(camera, point, count, a);
  double length = hypot(b.x - a.x, b.y - a.y);
  for (size_t i = 0; i < count; i++) {
    struct judge_point2 p = judge_project(camera, point[i]);
    double off = fabs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x));
    if (off > length * thickness_at(facings, contact, point[i]))
      return false;
  }
  return true;
}

/* Whether what is drawn of a triangle is so thick that contact and rounding
 * cannot turn its image over. */
static bool is_thick(const struct judge_facings *facings,
                     const struct judge_triangle *t, double contact) {
  struct judge_clipped_triangle clipped =
      judge_clip_triangle(facings->camera, t);
  return clipped.count < 3 ||
         !are_in_line(facings, clipped.p, clipped.count, contact);
}

/* Whether all of a face is drawn: its corners are in front of the near plane
 * and within the margins. */
static bool is_inside_page(const struct judge_camera *camera,
                           const struct judge_point3 *corner, size_t count) {
  double low = camera->margin_mm;
  for (size_t i = 0; i < count; i++) {
    struct judge_point2 at = judge_project(camera, corner[i]);
    if (!(judge_view_depth(camera, corner[i]) > judge_near(camera) &&
          at.x >= low && at.x <= camera->width_mm - low && at.y >= low &&
          at.y <= camera->height_mm - low))
      return false;
  }
  return true;
}

/* A face that is clipped counts as thin until one of its triangles does not. */
static struct judge_facing facing_of(const struct judge_facings *facings,
                                     uint32_t face,
                                     const struct judge_point3 *corner,
                                     size_t count, double contact) {
  struct judge_point3 sum = judge_area(facings->scene, face);
  struct judge_facing facing = {.has_no_area = !(point3_length(sum) > 0)};
  if (!facing.has_no_area)
    facing.normal = point3_unit(sum);
  facing.open =
      count > JUDGE_TRIANGULATION_MAX &&
      judge_is_warped(facings->scene, face, facings->options->contact);
  facing.clipped = !is_inside_page(facings->camera, corner, count);
  facing.thin = facing.clipped || are_in_line(facings, corner, count, contact);
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

double judge_fan_slope(const struct judge_facings *facings,
                       const struct judge_side_triangle *side_triangle,
                       struct judge_point3 at) {
  const struct judge_facing *facing = &facings->facing[side_triangle->face];
  bool sure = !facing->thin &&
              is_thick(facings, &side_triangle->triangle, facing->contact);
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
  return facing->has_no_area || facing->open || facing->thin
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
                          scene_face_group(facings->scene, s->face),
                          scene_face_group(facings->scene, t->face)))
    class_mask |= RECTO_EDGE_GROUP;
  double one = slope_at_side(facings, s), two = slope_at_side(facings, t);
  if (judge_is_silhouette(one, against ? two : -two))
    class_mask |= RECTO_EDGE_SILHOUETTE;
  if (f->has_no_area || g->has_no_area)
    return class_mask;
  double cosine = point3_dot(f->normal, g->normal);
  cosine = against ? cosine : -cosine;
  double degree = acos(-1) / 180, weak = facings->options->crease_deg;
  double strong = fmax(weak, facings->options->crease_start_deg);
  double bound = cos(strong * degree) - TOLERANCE_JUDGE_ANGLE;
  if (cosine < bound &&
      cosine < bound - crease_rounding(facings->scene, s->face, t->face, bound))
    class_mask |= RECTO_EDGE_CREASE;
  if (class_mask == 0 && cosine > cos(weak * degree) + TOLERANCE_JUDGE_ANGLE &&
      judge_is_sure(one, two))
    class_mask = RECTO_EDGE_SMOOTH;
  return class_mask;
}

/* Sets the facings.  Returns false when memory ran out. */
static bool set_facings(struct judge_facings *facings, const double *contact) {
  const struct scene *scene = facings->scene;
  uint32_t faces = scene_face_count(scene);
  ARRAY(struct judge_point3) corner = {0};
  bool ok = true;
  for (uint32_t i = 0; ok && i < faces && poll_at(i); i++) {
    corner.count = 0;
    for (uint32_t c = scene_face_start(scene, i);
         ok && c < scene_face_start(scene, i + 1); c++)
      ok = ARRAY_PUSH(&corner, judge_point3_at(scene, scene->corner.item[c]));
    if (ok)
      facings->facing[i] =
          facing_of(facings, i, corner.item, corner.count, contact[i]);
  }
  ARRAY_FREE(&corner);
  for (size_t t = 0; ok && t < facings->all->triangle.count && poll_at(t);
       t++) {
    const struct judge_triangle *triangle = &facings->all->triangle.item[t];
    struct judge_facing *facing = &facings->facing[triangle->face];
    facing->contact = fmax(facing->contact, triangle->planar);
    if (facing->clipped && facing->thin &&
        is_thick(facings, triangle, contact[triangle->face]))
      facing->thin = false;
  }
  return ok;
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
  bool ok = set_facings(facings, contact);
  mem_free(contact);
  return ok;
}

void judge_facings_fini(struct judge_facings *facings) {
  mem_free(facings->facing);
  facings->facing = NULL;
}
