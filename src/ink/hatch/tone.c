/* tone.c - the share of the paper that ink is to cover, over the faces seen.
 *
 * Phases
 *   1 normals   of the faces, as long as their areas
 *   2 joints    corners of faces that meet smoothly become one set, faces that
 *               do one region
 *   3 corners   the normal of a set is the sum of its faces'; its angle to the
 *               light is the tone
 *   4 regions   even ones get their mean tone */
#include "ink/hatch/tone.h"

#include <math.h>

#include "base/sets.h"
#include "ink/fill/light.h"
#include "view/project.h"
#include "view/vector.h"

/* A region whose tones differ by less is even: below what a pen can show. */
#define EVEN_TONE (1.0 / 512)

struct tone_normal {
  double xyz[3];
};

struct tone_work {
  const struct scene *scene;
  const struct sheet *sheet;
  double light[3];
  double crease_cosine;
  struct tone_normal *face; /* of each face */
  struct tone_normal *sum;  /* of each set of corners, at its root */
  uint32_t *corner_root;    /* sets of corners, and of faces */
  uint32_t *face_root;
  uint32_t *first_use; /* of each edge: a corner and its face */
  uint32_t *first_face;
  float *least, *most; /* tones of each region, at its root */
};

/* ---- 2 Joints ------------------------------------------------------------ */

static bool is_smooth(const struct tone_work *w, uint32_t f, uint32_t g) {
  const double *a = w->face[f].xyz, *b = w->face[g].xyz;
  double dot = vector_dot(a, b);
  return dot >= w->crease_cosine * vector_length(a) * vector_length(b);
}

static uint32_t next_corner(const struct scene *scene, uint32_t face,
                            uint32_t corner) {
  return corner + 1 < scene->face_start.item[face + 1]
             ? corner + 1
             : scene->face_start.item[face];
}

/* Faces f and g leave their corners a and b along one edge, in opposite
 * directions. */
static void join_faces(struct tone_work *w, uint32_t f, uint32_t a, uint32_t g,
                       uint32_t b) {
  if (!is_smooth(w, f, g))
    return;
  sets_join(w->face_root, f, g);
  sets_join(w->corner_root, a, next_corner(w->scene, g, b));
  sets_join(w->corner_root, next_corner(w->scene, f, a), b);
}

static void join_all(struct tone_work *w) {
  const struct topology *topology = w->sheet->topology;
  for (size_t e = 0; e < topology->edge.count; e++)
    w->first_use[e] = SCENE_NONE;
  for (uint32_t f = 0; f < scene_face_count(w->scene); f++)
    for (uint32_t c = w->scene->face_start.item[f];
         c < w->scene->face_start.item[f + 1]; c++) {
      uint32_t e = topology->corner_edge[c];
      const struct topology_edge *edge = &topology->edge.item[e];
      if (edge->uses != 2 || edge->same_way)
        continue;
      if (w->first_use[e] == SCENE_NONE) {
        w->first_use[e] = c;
        w->first_face[e] = f;
      } else if (w->first_face[e] != f) {
        join_faces(w, f, c, w->first_face[e], w->first_use[e]);
      }
    }
}

/* ---- 3 Corners ----------------------------------------------------------- */

static void sum_normals(struct tone_work *w) {
  for (uint32_t f = 0; f < scene_face_count(w->scene); f++)
    for (uint32_t c = w->scene->face_start.item[f];
         c < w->scene->face_start.item[f + 1]; c++) {
      double *sum = w->sum[sets_root(w->corner_root, c)].xyz;
      for (int k = 0; k < 3; k++)
        sum[k] += w->face[f].xyz[k];
    }
}

static float tone_of_corner(struct tone_work *w, uint32_t corner, bool away) {
  struct tone_normal n = w->sum[sets_root(w->corner_root, corner)];
  for (int k = 0; away && k < 3; k++)
    n.xyz[k] = -n.xyz[k];
  if (!vector_normalise(n.xyz))
    return (float)(1 - LIGHT_DARKEST);
  return (float)(1 - light_brightness(n.xyz, w->light));
}

static struct drawing_point place_corner(const struct tone_work *w,
                                         uint32_t corner) {
  const struct camera *camera = &w->sheet->camera;
  const struct scene_point *p =
      &w->scene->point.item[w->scene->corner.item[corner]];
  struct view_point v = camera_view(camera, p->x, p->y, p->z);
  double s = camera->s;
  if (camera->perspective)
    s = v.d >= camera->near_d ? s / v.d : NAN;
  return (struct drawing_point){camera->middle_mm[0] + s * v.x,
                                camera->middle_mm[1] + s * v.y};
}

static void set_corners(struct tone_work *w, struct tones *tones) {
  for (uint32_t f = 0; f < scene_face_count(w->scene); f++) {
    uint32_t region = sets_root(w->face_root, f);
    bool away =
        light_is_turned_away(w->scene, f, &w->sheet->camera, w->face[f].xyz);
    for (uint32_t c = w->scene->face_start.item[f];
         c < w->scene->face_start.item[f + 1]; c++) {
      float tone = tone_of_corner(w, c, away);
      tones->corner[c] = tone;
      tones->place[c] = place_corner(w, c);
      w->least[region] = fminf(w->least[region], tone);
      w->most[region] = fmaxf(w->most[region], tone);
    }
  }
}

/* ---- 4 Regions ----------------------------------------------------------- */

static void set_regions(struct tone_work *w, struct tones *tones) {
  for (uint32_t f = 0; f < scene_face_count(w->scene); f++) {
    uint32_t region = sets_root(w->face_root, f);
    double least = w->least[region], most = w->most[region];
    tones->even[f] = most - least < EVEN_TONE;
    if (!tones->even[f])
      continue;
    double mean = round((least + most) / 2 * TONE_STEPS) / TONE_STEPS;
    for (uint32_t c = w->scene->face_start.item[f];
         c < w->scene->face_start.item[f + 1]; c++)
      tones->corner[c] = (float)mean;
  }
}

/* ---- All ----------------------------------------------------------------- */

static bool prepare(struct tone_work *w) {
  size_t faces = scene_face_count(w->scene);
  size_t corners = w->scene->corner.count;
  size_t edges = w->sheet->topology ? w->sheet->topology->edge.count : 0;
  w->face = mem_alloc(faces, sizeof *w->face);
  w->sum = mem_calloc(corners, sizeof *w->sum);
  w->corner_root = sets_create(corners);
  w->face_root = sets_create(faces);
  w->first_use = mem_alloc(edges, sizeof *w->first_use);
  w->first_face = mem_alloc(edges, sizeof *w->first_face);
  w->least = mem_alloc(faces, sizeof *w->least);
  w->most = mem_alloc(faces, sizeof *w->most);
  if (!w->face || !w->sum || !w->corner_root || !w->face_root ||
      !w->first_use || !w->first_face || !w->least || !w->most)
    return false;
  for (uint32_t f = 0; f < faces; f++) {
    light_face_normal(w->scene, f, w->face[f].xyz);
    w->least[f] = 1;
    w->most[f] = 0;
  }
  return true;
}

static void finish(struct tone_work *w) {
  mem_free(w->face);
  mem_free(w->sum);
  mem_free(w->corner_root);
  mem_free(w->face_root);
  mem_free(w->first_use);
  mem_free(w->first_face);
  mem_free(w->least);
  mem_free(w->most);
}

bool tones_init(struct tones *tones, const struct sheet *sheet,
                const struct scene *scene, const recto_options *options) {
  struct tone_work w = {.scene = scene, .sheet = sheet};
  w.crease_cosine = cos(options->crease_deg * (acos(-1.0) / 180));
  light_direction(&sheet->camera, options, w.light);
  *tones = (struct tones){.scene = scene};
  tones->corner = mem_alloc(scene->corner.count, sizeof *tones->corner);
  tones->place = mem_alloc(scene->corner.count, sizeof *tones->place);
  tones->even = mem_alloc(scene_face_count(scene), sizeof *tones->even);
  bool ok = tones->corner && tones->place && tones->even && prepare(&w);
  if (ok) {
    if (sheet->topology && sheet->topology->corner_edge)
      join_all(&w);
    sum_normals(&w);
    set_corners(&w, tones);
    set_regions(&w, tones);
  }
  finish(&w);
  if (!ok)
    tones_fini(tones);
  return ok;
}

void tones_fini(struct tones *tones) {
  mem_free(tones->corner);
  mem_free(tones->place);
  mem_free(tones->even);
  *tones = (struct tones){0};
}

/* ---- Over a face --------------------------------------------------------- */

/* The plane through the tones of three corners, from the place of the first
 * on; false where they are in line on the page. */
static bool find_plane(const struct tones *tones, uint32_t o, uint32_t a,
                       uint32_t b, struct tone_plane *plane) {
  const struct drawing_point *place = tones->place;
  double ax = place[a].x - place[o].x, ay = place[a].y - place[o].y;
  double bx = place[b].x - place[o].x, by = place[b].y - place[o].y;
  double at = tones->corner[o];
  double ta = tones->corner[a] - at, tb = tones->corner[b] - at;
  double area = ax * by - ay * bx;
  *plane = (struct tone_plane){at, (ta * by - tb * ay) / area,
                               (tb * ax - ta * bx) / area};
  return isfinite(plane->x) && isfinite(plane->y);
}

static double value_of(const struct tone *tone, int plane,
                       struct drawing_point p) {
  const struct tone_plane *t = &tone->plane[plane];
  return t->at + t->x * (p.x - tone->from.x) + t->y * (p.y - tone->from.y);
}

/* Two planes that agree along the diagonal from corner 0 to 2: on the side of
 * corner 1 the first is meant, and it is the higher there or the lower, so it
 * is on the whole of the face that one is higher or lower. */
static bool find_planes(const struct tones *tones, uint32_t first,
                        uint32_t count, struct tone *tone) {
  if (!find_plane(tones, first, first + 1, first + 2, &tone->plane[0]))
    return false;
  tone->planes = 1;
  if (count == 3)
    return true;
  if (!find_plane(tones, first, first + 2, first + 3, &tone->plane[1]))
    return false;
  struct drawing_point p = tones->place[first + 1];
  tone->planes = 2;
  tone->higher = value_of(tone, 0, p) >= value_of(tone, 1, p);
  return true;
}

struct tone tones_of_face(const struct tones *tones, uint32_t face) {
  uint32_t first = tones->scene->face_start.item[face];
  uint32_t count = tones->scene->face_start.item[face + 1] - first;
  struct tone tone = {.from = tones->place[first], .even = tones->even[face]};
  double sum = 0;
  for (uint32_t c = first; c < first + count; c++) {
    sum += tones->corner[c];
    tone.most = fmax(tone.most, tones->corner[c]);
  }
  if (tone.even || count > 4 || !find_planes(tones, first, count, &tone)) {
    double mean = tone.even ? tones->corner[first] : sum / count;
    tone.plane[0] = (struct tone_plane){mean, 0, 0};
    tone.planes = 1;
    tone.from = (struct drawing_point){0, 0};
  }
  return tone;
}
