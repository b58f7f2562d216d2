/* tone.c - the tone of faces: the share of the paper that ink is to cover.
 *
 * Phases
 *   1 normals   of the faces, with lengths proportional to their areas
 *   2 joins     corners of faces that meet at a smooth edge are united into
 *               sets, and the faces into smooth regions (disjoint sets), of
 *               which some are flat (planar_regions.h)
 *   3 corners   the normal of a set is the sum of the normals of its faces, of
 *               the flat ones alone where there are such; its angle to the
 *               light gives the tone
 *   4 regions   uniform regions get the middle of their tones, and flat ones
 *               the tone of their plane */
#include "ink/tone.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "base/tolerance.h"
#include "base/union_find.h"
#include "geom/vector.h"
#include "ink/fill/light.h"
#include "ink/planar_regions.h"
#include "scene/edges/edge_classes.h"
#include "scene/newell_normal.h"

/* The side of a square, in pens, in which one sees whether hatching is even. */
#define EVEN_PENS 16

struct tone_normal {
  double xyz[3];
};

/* The tones of a set of corners, seen from its front and from its back; below 0
 * before they are found. */
struct set_tones {
  float of[2];
};

struct tone_work {
  const struct scene *scene;
  const struct sheet *sheet;
  struct light light;
  double crease_deg;
  struct tone_normal *face; /* of each face */
  uint32_t *corner_set;     /* of each corner: disjoint sets, then numbered */
  struct tone_normal *sum;  /* of each set of corners */
  struct set_tones *set_tone;
  uint32_t *face_root; /* disjoint sets of faces: smooth regions */
  struct planar_regions planar;
  double least_flat_area; /* mm^2 */
  bool *beside_flat;      /* of each set of corners: a flat face has one */
  uint32_t *first_use;    /* of each edge: the corner where the first of its
                               two faces leaves along it, and this face */
  uint32_t *first_face;
  uint8_t *class_masks; /* of each edge */
  float *min, *max;     /* extreme tones of each region, at its root */
};

/* ---- 2 Joins ------------------------------------------------------------- */

/* Whether an edge is smooth where its two faces are not one. */
static bool is_smooth(const struct tone_work *w, uint32_t e) {
  const struct topology_edge *edge = &w->sheet->topology->edge.item[e];
  return edge->uses == 2 && !edge->same_way &&
         (w->class_masks[e] & RECTO_EDGE_CREASE) == 0;
}

/* Joins two faces f and g at the smooth edge they share, and their corners.  It
 * starts at corner a of f and, in the opposite direction, at corner b of g. */
static void join_faces(struct tone_work *w, uint32_t f, uint32_t a, uint32_t g,
                       uint32_t b) {
  planar_regions_join(&w->planar, f, w->face[f].xyz, g, w->face[g].xyz);
  union_find_join(w->face_root, f, g);
  union_find_join(w->corner_set, a, scene_next_corner(w->scene, g, b));
  union_find_join(w->corner_set, scene_next_corner(w->scene, f, a), b);
}

/* Joins at all smooth edges, in time linear in the number of corners. */
static void join_at_smooth_edges(struct tone_work *w) {
  const struct topology *topology = w->sheet->topology;
  for (size_t e = 0; e < topology->edge.count; e++)
    w->first_use[e] = SCENE_NONE;
  for (uint32_t f = 0; f < scene_face_count(w->scene) && poll_at(f); f++)
    for (uint32_t c = scene_face_start(w->scene, f);
         c < scene_face_start(w->scene, f + 1); c++) {
      uint32_t e = topology->corner_edge[c];
      if (!is_smooth(w, e))
        continue;
      if (w->first_use[e] == SCENE_NONE) {
        w->first_use[e] = c;
        w->first_face[e] = f;
      } else if (w->first_face[e] != f) {
        join_faces(w, f, c, w->first_face[e], w->first_use[e]);
      }
    }
}

/* Compares the regions on both sides of all smooth edges. */
static void compare_at_smooth_edges(struct tone_work *w) {
  const struct topology *topology = w->sheet->topology;
  for (uint32_t e = 0; e < topology->edge.count && poll_at(e); e++)
    if (is_smooth(w, e))
      (void)planar_regions_compare(&w->planar, topology->edge.item[e].first,
                                   topology->edge.item[e].second);
}

/* The projection of a corner; NaN in front of the near plane. */
static struct drawing_point project_corner(const struct camera *camera,
                                           const struct scene *scene,
                                           uint32_t corner) {
  struct view_point v =
      camera_view(camera, &scene->point.item[scene->corner.item[corner]]);
  double s = camera->s;
  if (camera->perspective)
    s = v.d >= camera->near_d ? s / v.d : NAN;
  return (struct drawing_point){camera->middle_mm[0] + s * v.x,
                                camera->middle_mm[1] + s * v.y};
}

/* The area of a face on the page, mm^2; 0 where it is not all before the near
 * plane. */
static double page_area(const struct tone_work *w, uint32_t face) {
  const struct camera *camera = &w->sheet->camera;
  const uint32_t start[2] = {scene_face_start(w->scene, face),
                             scene_face_start(w->scene, face + 1)};
  struct drawing_point o = project_corner(camera, w->scene, start[0]);
  struct drawing_point p = project_corner(camera, w->scene, start[0] + 1);
  double twice = 0;
  for (uint32_t c = start[0] + 1; c + 1 < start[1]; c++) {
    struct drawing_point next = project_corner(camera, w->scene, c + 1);
    twice += (p.x - o.x) * (next.y - o.y) - (p.y - o.y) * (next.x - o.x);
    p = next;
  }
  return isfinite(twice) ? fabs(twice) / 2 : 0;
}

/* Adds the areas on the page of the regions that may be flat. */
static void measure_on_page(struct tone_work *w) {
  for (uint32_t f = 0; f < scene_face_count(w->scene) && poll_at(f); f++) {
    struct planar_region *flat = planar_regions_flat(&w->planar, f, 0);
    if (flat != NULL)
      flat->page_area += page_area(w, f);
  }
}

static void join_smooth_edges(struct tone_work *w) {
  join_at_smooth_edges(w);
  for (uint32_t f = 0; f < scene_face_count(w->scene) && poll_at(f); f++)
    planar_regions_measure(&w->planar, w->scene, f, w->face[f].xyz);
  compare_at_smooth_edges(w);
  measure_on_page(w);
}

/* ---- 3 Corners ----------------------------------------------------------- */

/* The region of a flat face, or NULL. */
static const struct planar_region *flat_of(const struct tone_work *w,
                                           uint32_t face) {
  return planar_regions_flat(&w->planar, face, w->least_flat_area);
}

/* Numbers the sets of corners, and makes room for what is known of them; false
 * when memory ran out.  The root of a set is its lowest corner. */
static bool number_corner_sets(struct tone_work *w) {
  uint32_t *set = w->corner_set, sets = 0;
  size_t corners = w->scene->corner.count;
  for (uint32_t c = 0; c < corners; c++)
    set[c] = union_find_root(set, c);
  for (uint32_t c = 0; c < corners; c++)
    set[c] = set[c] == c ? sets++ : set[set[c]];
  w->sum = mem_calloc(sets, sizeof *w->sum);
  w->beside_flat = mem_calloc(sets, sizeof *w->beside_flat);
  w->set_tone = mem_alloc(sets, sizeof *w->set_tone);
  for (uint32_t i = 0; w->set_tone != NULL && i < sets; i++)
    w->set_tone[i] = (struct set_tones){{-1, -1}};
  return w->sum != NULL && w->beside_flat != NULL && w->set_tone != NULL;
}

/* Marks the sets with corners of flat faces. */
static void mark_beside_flat(struct tone_work *w) {
  for (uint32_t f = 0; f < scene_face_count(w->scene) && poll_at(f); f++) {
    if (flat_of(w, f) == NULL)
      continue;
    for (uint32_t c = scene_face_start(w->scene, f);
         c < scene_face_start(w->scene, f + 1); c++)
      w->beside_flat[w->corner_set[c]] = true;
  }
}

/* Sums the face normals of each set of corners, weighted by area: where a flat
 * face goes over into a curved surface, this begins with the flat's normal. */
static void sum_normals(struct tone_work *w) {
  for (uint32_t f = 0; f < scene_face_count(w->scene) && poll_at(f); f++) {
    bool is_flat = flat_of(w, f) != NULL;
    for (uint32_t c = scene_face_start(w->scene, f);
         c < scene_face_start(w->scene, f + 1); c++) {
      uint32_t set = w->corner_set[c];
      if (w->beside_flat[set] && !is_flat)
        continue;
      for (int k = 0; k < 3; k++)
        w->sum[set].xyz[k] += w->face[f].xyz[k];
    }
  }
}

/* away  the face is seen from its back: its normal is reversed */
static double tone_of_normal(const struct tone_work *w, const double normal[3],
                             bool away) {
  double n[3];
  for (int k = 0; k < 3; k++)
    n[k] = away ? -normal[k] : normal[k];
  (void)vector_normalise(n);
  return 1 - light_brightness(n, &w->light);
}

static bool is_away(const struct tone_work *w, uint32_t face) {
  return light_is_turned_away(w->scene, face, &w->sheet->camera,
                              w->face[face].xyz);
}

/* Sets the tone of all corners, and the extreme tones of all regions.  Corners
 * of a set have one tone, or two where some of their faces are seen from
 * behind. */
static void set_corners(struct tone_work *w, struct tones *tones) {
  for (uint32_t f = 0; f < scene_face_count(w->scene) && poll_at(f); f++) {
    uint32_t region = union_find_root(w->face_root, f);
    bool away = is_away(w, f);
    for (uint32_t c = scene_face_start(w->scene, f);
         c < scene_face_start(w->scene, f + 1); c++) {
      uint32_t set = w->corner_set[c];
      float *known = &w->set_tone[set].of[away];
      if (*known < 0)
        *known = (float)tone_of_normal(w, w->sum[set].xyz, away);
      float tone = *known;
      tones->corner[c] = tone;
      w->min[region] = fminf(w->min[region], tone);
      w->max[region] = fmaxf(w->max[region], tone);
    }
  }
}

/* ---- 4 Regions ----------------------------------------------------------- */

/* Finds the uniform regions and the flat ones, and gives all corners of each
 * one tone. */
static void set_regions(struct tone_work *w, struct tones *tones) {
  for (uint32_t f = 0; f < scene_face_count(w->scene) && poll_at(f); f++) {
    const struct planar_region *flat = flat_of(w, f);
    uint32_t region = union_find_root(w->face_root, f);
    double min = w->min[region], max = w->max[region];
    bool is_even = max - min < TOLERANCE_TONE;
    tones->uniform[f] = is_even || flat != NULL;
    if (!tones->uniform[f])
      continue;
    double tone = is_even ? (min + max) / 2
                          : tone_of_normal(w, flat->normal, is_away(w, f));
    double rounded = round(tone * TONE_STEPS) / TONE_STEPS;
    for (uint32_t c = scene_face_start(w->scene, f);
         c < scene_face_start(w->scene, f + 1); c++)
      tones->corner[c] = (float)rounded;
  }
}

void tones_set_light(double light[TONES_LIGHT], const struct camera *camera,
                     const recto_options *options) {
  const struct light own = light_of(camera, options);
  memcpy(light, own.towards, sizeof own.towards);
  light[3] = own.ambient;
  light[4] = own.fill;
  light[5] = options->ink.pen_mm;
}

/* ---- All ----------------------------------------------------------------- */

/* Allocates the work arrays and sets the face normals.  False when memory ran
 * out; release must be called all the same. */
static bool prepare_tone_work(struct tone_work *w) {
  size_t faces = scene_face_count(w->scene);
  size_t edges =
      w->sheet->topology != NULL ? w->sheet->topology->edge.count : 0;
  w->face = mem_alloc(faces, sizeof *w->face);
  w->corner_set = union_find_create(w->scene->corner.count);
  w->face_root = union_find_create(faces);
  w->first_use = mem_alloc(edges, sizeof *w->first_use);
  w->first_face = mem_alloc(edges, sizeof *w->first_face);
  w->class_masks = mem_alloc(edges, sizeof *w->class_masks);
  w->min = mem_alloc(faces, sizeof *w->min);
  w->max = mem_alloc(faces, sizeof *w->max);
  bool ok = planar_regions_init(&w->planar, w->scene);
  if (!ok || w->face == NULL || w->corner_set == NULL || w->face_root == NULL ||
      w->first_use == NULL || w->first_face == NULL || w->class_masks == NULL ||
      w->min == NULL || w->max == NULL ||
      (edges > 0 && !topology_class_masks(w->sheet->topology, w->scene,
                                          w->crease_deg, w->class_masks)))
    return false;
  for (uint32_t f = 0; f < faces; f++) {
    if (!poll_at(f))
      return false;
    newell_normal_of_face(w->scene, f, w->face[f].xyz);
    w->min[f] = 1;
    w->max[f] = 0;
  }
  return true;
}

static void release_tone_work(struct tone_work *w) {
  mem_free(w->face);
  mem_free(w->sum);
  mem_free(w->set_tone);
  mem_free(w->corner_set);
  mem_free(w->face_root);
  mem_free(w->first_use);
  mem_free(w->first_face);
  mem_free(w->class_masks);
  mem_free(w->min);
  mem_free(w->max);
  mem_free(w->beside_flat);
  planar_regions_fini(&w->planar);
}

static bool allocate_tones(struct tones *tones, const struct sheet *sheet,
                           const struct scene *scene) {
  *tones = (struct tones){.scene = scene, .camera = &sheet->camera};
  tones->corner = mem_alloc(scene->corner.count, sizeof *tones->corner);
  tones->uniform = mem_alloc(scene_face_count(scene), sizeof *tones->uniform);
  return tones->corner != NULL && tones->uniform != NULL;
}

bool tones_copy(struct tones *tones, const struct sheet *sheet,
                const struct scene *scene, const float *corner,
                const uint8_t *uniform) {
  bool ok = allocate_tones(tones, sheet, scene);
  if (ok) {
    for (size_t c = 0; c < scene->corner.count; c++)
      tones->corner[c] = corner[c];
    for (uint32_t f = 0; f < scene_face_count(scene); f++)
      tones->uniform[f] = uniform[f] != 0;
    ok = !poll_is_cancelled();
  }
  if (!ok)
    tones_fini(tones);
  return ok;
}

bool tones_init(struct tones *tones, const struct sheet *sheet,
                const struct scene *scene, const recto_options *options) {
  struct tone_work w = {
      .scene = scene, .sheet = sheet, .crease_deg = options->mesh.crease_deg};
  w.light = light_of(&sheet->camera, options);
  w.least_flat_area = pow(EVEN_PENS * options->ink.pen_mm, 2);
  bool ok = allocate_tones(tones, sheet, scene) && prepare_tone_work(&w);
  if (ok) {
    if (sheet->topology != NULL && sheet->topology->corner_edge != NULL)
      join_smooth_edges(&w);
    ok = number_corner_sets(&w);
  }
  if (ok) {
    mark_beside_flat(&w);
    sum_normals(&w);
    set_corners(&w, tones);
    set_regions(&w, tones);
    ok = !poll_is_cancelled();
  }
  release_tone_work(&w);
  if (!ok)
    tones_fini(tones);
  return ok;
}

void tones_fini(struct tones *tones) {
  mem_free(tones->corner);
  mem_free(tones->uniform);
  *tones = (struct tones){0};
}

/* ---- Over a face --------------------------------------------------------- */

static struct drawing_point tone_position(const struct tones *tones,
                                          uint32_t corner) {
  return project_corner(tones->camera, tones->scene, corner);
}

/* The plane through the tones of the corners o, a and b, with its origin at o.
 * False where the corners are collinear on the page. */
static bool find_plane(const struct tones *tones, uint32_t o, uint32_t a,
                       uint32_t b, struct tone_plane *plane) {
  struct drawing_point at_o = tone_position(tones, o);
  struct drawing_point at_a = tone_position(tones, a);
  struct drawing_point at_b = tone_position(tones, b);
  double ax = at_a.x - at_o.x, ay = at_a.y - at_o.y;
  double bx = at_b.x - at_o.x, by = at_b.y - at_o.y;
  double at = tones->corner[o];
  double ta = tones->corner[a] - at, tb = tones->corner[b] - at;
  double area = ax * by - ay * bx;
  *plane = (struct tone_plane){at, (ta * by - tb * ay) / area,
                               (tb * ax - ta * bx) / area};
  return isfinite(plane->dx) && isfinite(plane->dy);
}

/* The value of one plane of a tone at a point. */
static double value_of(const struct tone *tone, int plane,
                       struct drawing_point p) {
  const struct tone_plane *t = &tone->plane[plane];
  return t->value + t->dx * (p.x - tone->origin.x) +
         t->dy * (p.y - tone->origin.y);
}

/* Sets the planes of a triangle or a quadrilateral; false where there is none.
 * The two planes of a quadrilateral agree along the diagonal from corner 0 to
 * corner 2, and the first holds on the side of corner 1.  If it is the higher
 * one there, the tone is the maximum of the two planes on the whole face, else
 * the minimum. */
static bool find_planes(const struct tones *tones, uint32_t first,
                        uint32_t count, struct tone *tone) {
  if (!find_plane(tones, first, first + 1, first + 2, &tone->plane[0]))
    return false;
  tone->planes = 1;
  if (count == 3)
    return true;
  if (!find_plane(tones, first, first + 2, first + 3, &tone->plane[1]))
    return false;
  struct drawing_point p = tone_position(tones, first + 1);
  tone->planes = 2;
  tone->take_max = value_of(tone, 0, p) >= value_of(tone, 1, p);
  return true;
}

struct tone tones_of_face(const struct tones *tones, uint32_t face) {
  uint32_t first = scene_face_start(tones->scene, face);
  uint32_t count = scene_face_start(tones->scene, face + 1) - first;
  struct tone tone = {.origin = tone_position(tones, first),
                      .uniform = tones->uniform[face]};
  double sum = 0;
  for (uint32_t c = first; c < first + count; c++) {
    sum += tones->corner[c];
    tone.max = fmax(tone.max, tones->corner[c]);
  }
  if (tone.uniform || count > 4 || !find_planes(tones, first, count, &tone)) {
    double mean = tone.uniform ? tones->corner[first] : sum / count;
    tone.plane[0] = (struct tone_plane){mean, 0, 0};
    tone.planes = 1;
    tone.origin = (struct drawing_point){0, 0};
  }
  return tone;
}
