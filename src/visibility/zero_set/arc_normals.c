/* arc_normals.c - turns normals where the faces about a vertex differ in size.
 *
 * The mean normal of a large face and a narrow one leans towards the narrow one
 * by half of the angle between them, whichever of both the surface bends over.
 * But along a short edge it is an arc: the normals at both ends are then
 * mirror images of each other, at the plane across the edge.  So where the
 * faces on the other side of a vertex reach far beyond an edge, and those
 * beyond its other end do not, the normal is turned towards the mirror image of
 * that at the other end. */
#include "visibility/zero_set/facing.h"

enum {
  MOST_FACES = 32,  /* about a vertex; those about others stay as they are */
  MOST_CORNERS = 64 /* of a face that are looked at */
};

/* The faces about a vertex that share a normal there. */
struct smooth_fan {
  uint32_t face[MOST_FACES], corner[MOST_FACES];
  double way[MOST_FACES][3]; /* to the faces' next corners */
  double square[MOST_FACES]; /* of the lengths of these */
  double far;     /* to the farthest corner of a face with more than three */
  double longest; /* the square of the greatest of all these lengths */
  size_t count;
};

/* The half plane that is spanned by a direction from a vertex and the normal
 * there, and where it leaves the flat that begins at the vertex. */
struct ray {
  double at[3], way[3], across[3]; /* unit lengths */
  double along[3]; /* from the vertex to where it leaves the first face; unit
                      length */
  double reach;    /* how far the flat goes that way */
};

/* An edge from a vertex to the next one. */
struct arc {
  uint32_t face, next; /* a face there, and its corner at the other end */
  double at[3], to[3];
  double along[3]; /* unit length */
  double length;
};

static void subtract(const double a[3], const double b[3], double c[3]) {
  for (int k = 0; k < 3; k++)
    c[k] = a[k] - b[k];
}

/* ---- Fans ---------------------------------------------------------------- */

static uint32_t previous_corner(const struct facing *f, uint32_t face,
                                uint32_t corner) {
  return corner > scene_face_start(f->scene, face)
             ? corner - 1
             : scene_face_start(f->scene, face + 1) - 1;
}

/* Goes on from a face to the next one about a vertex.
 * forward  across the side that starts there, not the one that ends there
 * Returns false where the surface is not smooth. */
static bool next_about(const struct facing *f, bool forward, uint32_t *face,
                       uint32_t *corner) {
  uint32_t side = forward ? *corner : previous_corner(f, *face, *corner);
  uint32_t edge = f->topology->corner_edge[side];
  const struct topology_edge *e = &f->topology->edge.item[edge];
  if (facing_is_feature(f, edge))
    return false;
  uint32_t other = e->first == *face ? e->second : e->first;
  uint32_t c = facing_corner_of_edge(f, other, edge);
  if (c == SHEET_NONE)
    return false;
  *face = other;
  *corner = forward ? scene_next_corner(f->scene, other, c) : c;
  return true;
}

/* Lists the faces about a vertex that share a normal with a corner.  Returns
 * false where they are too many. */
static bool find_faces_about(const struct facing *f, uint32_t face,
                             uint32_t corner, struct smooth_fan *fan) {
  fan->count = 0;
  for (int way = 0; way < 2; way++) {
    uint32_t at = face, c = corner;
    do {
      if (fan->count == MOST_FACES)
        return false;
      if (way == 0 || c != corner) {
        fan->face[fan->count] = at;
        fan->corner[fan->count++] = c;
      }
      if (!next_about(f, way == 0, &at, &c))
        break;
    } while (c != corner);
    if (c == corner && fan->count > 1)
      break;
  }
  return true;
}

/* Finds where the corners of a fan's faces are. */
static void find_ways(const struct facing *f, const double at[3],
                      struct smooth_fan *fan) {
  double square = 0, p[3];
  fan->longest = 0;
  for (size_t i = 0; i < fan->count; i++) {
    uint32_t face = fan->face[i], end = scene_face_start(f->scene, face + 1);
    uint32_t start = scene_face_start(f->scene, face);
    uint32_t next = scene_next_corner(f->scene, face, fan->corner[i]);
    facing_position(f, facing_point(f, next), p);
    subtract(p, at, fan->way[i]);
    fan->square[i] = vector_dot(fan->way[i], fan->way[i]);
    fan->longest = max_number(fan->longest, fan->square[i]);
    for (uint32_t c = start; end - start > 3 && c < end; c++) {
      facing_position(f, facing_point(f, c), p);
      subtract(p, at, p);
      square = fmax(square, vector_dot(p, p));
    }
  }
  fan->far = sqrt(square);
  fan->longest = max_number(fan->longest, square);
}

/* A filter for may_reach, of the edge to a face's next corner: false only where
 * no corner may be twice as far as that. */
static bool may_be_short(const struct smooth_fan *fan, size_t i) {
  return 4 * fan->square[i] < fan->longest * (1 + 0x1p-30);
}

/* Whether a corner of a fan's faces may be farther than this the other way. */
static bool may_reach(const struct smooth_fan *fan, const double along[3],
                      double far) {
  bool reaches = fan->far > far;
  for (size_t i = 0; i < fan->count && !reaches; i++)
    reaches = -vector_dot(fan->way[i], along) > far;
  return reaches;
}

/* The mean normal of a fan. */
static void find_mean(const struct facing *f, const struct smooth_fan *fan,
                      double mean[3]) {
  for (int k = 0; k < 3; k++)
    mean[k] = 0;
  for (size_t i = 0; i < fan->count; i++) {
    double n[3], angle = facing_angle(f, fan->face[i], fan->corner[i]);
    facing_face_normal(f, fan->face[i], n);
    if (!vector_normalise(n))
      continue;
    for (int k = 0; k < 3; k++)
      mean[k] += angle * n[k];
  }
  (void)vector_normalise(mean);
}

/* ---- Rays ---------------------------------------------------------------- */

/* Finds where a half plane leaves a face.
 * first  a corner
 * point  is set to that place
 * side   is set to the corner at which the side starts there; SHEET_NONE: not
 *        all sides were looked at
 * Returns how far it is that way; 0: the face is not there. */
static double leave_face(const struct facing *f, const struct ray *ray,
                         uint32_t face, uint32_t first, double point[3],
                         uint32_t *side) {
  uint32_t start = scene_face_start(f->scene, face);
  uint32_t count = scene_face_corners(f->scene, face);
  uint32_t step = 1 + count / MOST_CORNERS;
  double most = 0, p[2][3], y[2];
  for (uint32_t i = 0; i < count + step; i += step) {
    uint32_t c = start + (first - start + (i < count ? i : 0)) % count;
    int now = (int)(i / step) & 1, last = 1 - now;
    facing_position(f, facing_point(f, c), p[now]);
    subtract(p[now], ray->at, p[now]);
    y[now] = vector_dot(p[now], ray->across);
    if (i > 0 && (y[0] > 0) != (y[1] > 0)) {
      double t = y[last] / (y[last] - y[now]), q[3];
      for (int k = 0; k < 3; k++)
        q[k] = p[last][k] + t * (p[now][k] - p[last][k]);
      double far = vector_dot(q, ray->way);
      if (far > most) {
        most = far;
        *side = step == 1 ? previous_corner(f, face, c) : SHEET_NONE;
        for (int k = 0; k < 3; k++)
          point[k] = q[k];
      }
    }
  }
  return most;
}

/* Goes on as long as faces bend no more than this, as the sine of the angle
 * between them and the first one that way. */
static void follow_flat(const struct facing *f, struct ray *ray, uint32_t face,
                        uint32_t side, double bend) {
  for (int i = 0; i < MOST_CORNERS && side != SHEET_NONE; i++) {
    uint32_t edge = f->topology->corner_edge[side];
    const struct topology_edge *e = &f->topology->edge.item[edge];
    double n[3], point[3];
    if (facing_is_feature(f, edge))
      return;
    face = e->first == face ? e->second : e->first;
    facing_face_normal(f, face, n);
    if (!vector_normalise(n) || fabs(vector_dot(n, ray->along)) > bend)
      return;
    double far = leave_face(f, ray, face, scene_face_start(f->scene, face),
                            point, &side);
    if (!(far > ray->reach))
      return;
    ray->reach = far;
  }
}

/* Takes the side of a face from the vertex to a corner for the ray if it leads
 * that way, within 30 degrees, and farther. */
static void follow_side(const struct facing *f, uint32_t corner,
                        struct ray *ray) {
  double to[3];
  facing_position(f, facing_point(f, corner), to);
  subtract(to, ray->at, to);
  double far = vector_dot(to, ray->way), square = vector_dot(to, to);
  if (!(far > ray->reach) || far * far < 0.75 * square)
    return;
  ray->reach = far;
  for (int k = 0; k < 3; k++)
    ray->along[k] = to[k] / sqrt(square);
}

/* Finds how far the surface goes on in a direction without bending more than
 * this.  Returns false where there is none. */
static bool find_ray(const struct facing *f, const struct smooth_fan *fan,
                     const double at[3], const double normal[3],
                     const double way[3], double bend, struct ray *ray) {
  uint32_t face = 0, side = SHEET_NONE;
  ray->reach = 0;
  for (int k = 0; k < 3; k++) {
    ray->at[k] = at[k];
    ray->way[k] = way[k];
  }
  vector_cross(normal, way, ray->across);
  for (size_t i = 0; i < fan->count; i++) {
    double point[3];
    uint32_t s = SHEET_NONE;
    double far = leave_face(f, ray, fan->face[i], fan->corner[i], point, &s);
    if (far > ray->reach) {
      ray->reach = far;
      face = fan->face[i];
      side = s;
      for (int k = 0; k < 3; k++)
        ray->along[k] = point[k];
    }
  }
  if (ray->reach > 0 && vector_normalise(ray->along))
    follow_flat(f, ray, face, side, bend);
  double whole = ray->reach;
  ray->reach /= 2;
  for (size_t i = 0; i < fan->count; i++) {
    uint32_t c = fan->corner[i];
    follow_side(f, scene_next_corner(f->scene, fan->face[i], c), ray);
    follow_side(f, previous_corner(f, fan->face[i], c), ray);
  }
  ray->reach = fmax(ray->reach, whole);
  return ray->reach > 0;
}

/* ---- Arcs ---------------------------------------------------------------- */

static bool find_arc(const struct facing *f, uint32_t face, uint32_t corner,
                     uint32_t next, struct arc *arc) {
  arc->face = face;
  arc->next = next;
  facing_position(f, facing_point(f, corner), arc->at);
  facing_position(f, facing_point(f, next), arc->to);
  subtract(arc->to, arc->at, arc->along);
  arc->length = vector_length(arc->along);
  return vector_normalise(arc->along);
}

/* A normal, of unit length, turned in the plane of it and a direction to be at
 * right angles to that. */
static void turn_across(const double normal[3], const double along[3],
                        double turned[3]) {
  double lean = vector_dot(normal, along);
  for (int k = 0; k < 3; k++)
    turned[k] = normal[k] - lean * along[k];
  (void)vector_normalise(turned);
}

/* How much an arc counts, where the mean normal counts 1.
 * behind  is set to how the surface goes on behind it
 * value   is set to what the normal is to be along that: 0 if all that the
 *         surface bends there is what the arc bends, or up to five ninths are
 *         left, as beside a flat face that begins with a part of a strip */
static double weigh_arc(const struct facing *f, const struct arc *arc,
                        const struct smooth_fan *about, const double normal[3],
                        struct ray *behind, double *value) {
  struct smooth_fan fan;
  struct ray ahead;
  double mean[3], flat[3], bent[3];
  const double back[3] = {-arc->along[0], -arc->along[1], -arc->along[2]};
  double bend = fabs(vector_dot(normal, arc->along)) / 2;
  if (!find_ray(f, about, arc->at, normal, back, bend, behind) ||
      !(behind->reach > 2 * arc->length) ||
      !find_faces_about(f, arc->face, arc->next, &fan))
    return 0;
  find_mean(f, &fan, mean);
  if (!find_ray(f, &fan, arc->to, mean, arc->along, bend, &ahead))
    return 0;
  double uneven = fmax(ahead.reach / arc->length, arc->length / ahead.reach);
  double ratio = behind->reach / (2 * arc->length * uneven);
  if (!(ratio > 1))
    return 0;
  turn_across(normal, behind->along, flat);
  turn_across(normal, arc->along, bent);
  double whole = vector_dot(flat, arc->along);
  double part = whole != 0 ? 1 + vector_dot(mean, arc->along) / whole : 1;
  part = fmin(fmax(part, 0), 1);
  part = fmax(0, fmin(part, 6 * part - 10. / 3));
  *value = part * vector_dot(bent, behind->along);
  return fmin(ratio, 64) * fmin(ratio, 64) - 1;
}

/* ---- Least squares ------------------------------------------------------- */

/* The sum of the squares of x - mean and of weight (x . along - value) is least
 * for matrix x = right. */
struct squares {
  double matrix[3][3], right[3];
};

static void add_lean(struct squares *s, const double along[3], double value,
                     double weight) {
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 3; k++)
      s->matrix[i][k] += weight * along[i] * along[k];
    s->right[i] += weight * value * along[i];
  }
}

static void solve_squares(const struct squares *s, double x[3]) {
  double across[3];
  for (int k = 0; k < 3; k++) {
    vector_cross(s->matrix[(k + 1) % 3], s->matrix[(k + 2) % 3], across);
    x[k] = vector_dot(across, s->right) / vector_dot(across, s->matrix[k]);
  }
}

/* ---- The whole ----------------------------------------------------------- */

static bool add_arc_lean(const struct facing *f, const struct smooth_fan *fan,
                         uint32_t face, uint32_t corner, uint32_t next,
                         const double normal[3], struct squares *s) {
  struct arc arc;
  struct ray behind;
  double value = 0;
  if (!find_arc(f, face, corner, next, &arc) ||
      !may_reach(fan, arc.along, 2 * arc.length))
    return false;
  double weight = weigh_arc(f, &arc, fan, normal, &behind, &value);
  if (!(weight > 0))
    return false;
  add_lean(s, behind.along, value, weight);
  return true;
}

void facing_turn_normal(struct facing *f, uint32_t face, uint32_t corner) {
  struct smooth_fan fan;
  double at[3], *normal = f->normal[facing_place(f, facing_slot(f, corner))];
  struct squares s = {.matrix = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                      .right = {normal[0], normal[1], normal[2]}};
  bool any = false;
  if (!find_faces_about(f, face, corner, &fan))
    return;
  facing_position(f, facing_point(f, corner), at);
  find_ways(f, at, &fan);
  for (size_t i = 0; i < fan.count; i++) {
    uint32_t of = fan.face[i], c = fan.corner[i];
    uint32_t last = previous_corner(f, of, c);
    if (may_be_short(&fan, i))
      any |= add_arc_lean(f, &fan, of, c, scene_next_corner(f->scene, of, c),
                          normal, &s);
    if (facing_is_feature(f, f->topology->corner_edge[last]))
      any |= add_arc_lean(f, &fan, of, c, last, normal, &s);
  }
  if (any) {
    solve_squares(&s, normal);
    (void)vector_normalise(normal);
  }
}
