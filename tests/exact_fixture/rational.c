/* rational.c - plane geometry in rational arithmetic. */
#include "exact_fixture/rational.h"

void rational_set_int128(mpz_t to, int128 value) {
  mpz_set_si(to, (long)(value >> 64));
  mpz_mul_2exp(to, to, 64);
  mpz_add_ui(to, to, (unsigned long)(uint64_t)value);
}

void rational_set_ratio(mpq_t to, struct ratio ratio) {
  rational_set_int128(mpq_numref(to), ratio.num);
  rational_set_int128(mpq_denref(to), ratio.den);
  mpq_canonicalize(to);
}

void rational_set_wide(mpz_t to, const struct wide *value) {
  mpz_import(to, (size_t)value->count, -1, sizeof value->limb[0], 0, 0,
             value->limb);
  if (value->sign < 0)
    mpz_neg(to, to);
}

void rational_point_init(struct rational_point *p) {
  mpq_inits(p->x, p->y, NULL);
}

void rational_point_clear(struct rational_point *p) {
  mpq_clears(p->x, p->y, NULL);
}

void rational_line_init(struct rational_line *l) {
  mpq_inits(l->a, l->b, l->c, NULL);
}

void rational_line_clear(struct rational_line *l) {
  mpq_clears(l->a, l->b, l->c, NULL);
}

void rational_point_at(struct rational_point *to, struct geom_point p) {
  mpq_set_si(to->x, p.x, 1);
  mpq_set_si(to->y, p.y, 1);
}

void rational_point_of(struct rational_point *to, const struct wide h[3]) {
  for (int k = 0; k < 2; k++) {
    mpq_ptr coordinate = k == 0 ? to->x : to->y;
    rational_set_wide(mpq_numref(coordinate), &h[k]);
    rational_set_wide(mpq_denref(coordinate), &h[2]);
    mpq_canonicalize(coordinate);
  }
}

void rational_point_at_corner(struct rational_point *to,
                              const struct geom_corner *corner) {
  struct wide h[3];
  geom_corner_exact(corner, h);
  rational_point_of(to, h);
}

/* to = p q - r s */
static void cross(mpq_t to, const mpq_t p, const mpq_t q, const mpq_t r,
                  const mpq_t s) {
  mpq_t left, right;
  mpq_inits(left, right, NULL);
  mpq_mul(left, p, q);
  mpq_mul(right, r, s);
  mpq_sub(to, left, right);
  mpq_clears(left, right, NULL);
}

bool rational_point_meet(struct rational_point *to,
                         const struct rational_line *l,
                         const struct rational_line *m) {
  mpq_t det;
  bool met;
  mpq_init(det);
  cross(det, l->a, m->b, m->a, l->b);
  met = mpq_sgn(det) != 0;
  if (met) {
    cross(to->x, l->b, m->c, m->b, l->c);
    cross(to->y, m->a, l->c, l->a, m->c);
    mpq_div(to->x, to->x, det);
    mpq_div(to->y, to->y, det);
  }
  mpq_clear(det);
  return met;
}

void rational_line_through(struct rational_line *to, struct geom_point p,
                           struct geom_point q) {
  mpq_t x, y;
  mpq_inits(x, y, NULL);
  mpq_set_si(x, p.x, 1);
  mpq_set_si(y, p.y, 1);
  mpq_set_si(to->a, (long)p.y - q.y, 1);
  mpq_set_si(to->b, (long)q.x - p.x, 1);
  mpq_mul(x, x, to->a);
  mpq_mul(y, y, to->b);
  mpq_add(to->c, x, y);
  mpq_neg(to->c, to->c);
  mpq_clears(x, y, NULL);
}

/* The plane z = a x + b y + c through three points, by Cramer's rule. */
static void solve_plane(struct rational_line *to,
                        const struct geom_point p[3]) {
  mpq_t ux, uy, uz, vx, vy, vz, det;
  mpq_inits(ux, uy, uz, vx, vy, vz, det, NULL);
  mpq_set_si(ux, (long)p[1].x - p[0].x, 1);
  mpq_set_si(uy, (long)p[1].y - p[0].y, 1);
  mpq_set_si(uz, p[1].z - p[0].z, 1);
  mpq_set_si(vx, (long)p[2].x - p[0].x, 1);
  mpq_set_si(vy, (long)p[2].y - p[0].y, 1);
  mpq_set_si(vz, p[2].z - p[0].z, 1);
  cross(det, ux, vy, vx, uy);
  cross(to->a, uz, vy, vz, uy);
  cross(to->b, ux, vz, vx, uz);
  mpq_div(to->a, to->a, det);
  mpq_div(to->b, to->b, det);
  mpq_set_si(ux, p[0].x, 1);
  mpq_set_si(uy, p[0].y, 1);
  mpq_set_si(to->c, p[0].z, 1);
  mpq_mul(ux, ux, to->a);
  mpq_mul(uy, uy, to->b);
  mpq_sub(to->c, to->c, ux);
  mpq_sub(to->c, to->c, uy);
  mpq_clears(ux, uy, uz, vx, vy, vz, det, NULL);
}

void rational_line_between(struct rational_line *to,
                           const struct geom_point f[3],
                           const struct geom_point g[3]) {
  struct rational_line back;
  rational_line_init(&back);
  solve_plane(to, f);
  solve_plane(&back, g);
  mpq_sub(to->a, to->a, back.a);
  mpq_sub(to->b, to->b, back.b);
  mpq_sub(to->c, to->c, back.c);
  rational_line_clear(&back);
}

void rational_line_value(mpq_t to, const struct rational_line *l,
                         const struct rational_point *p) {
  mpq_t term;
  mpq_init(term);
  mpq_mul(term, l->a, p->x);
  mpq_add(term, term, l->c);
  mpq_mul(to, l->b, p->y);
  mpq_add(to, to, term);
  mpq_clear(term);
}

int rational_line_side(const struct rational_line *l,
                       const struct rational_point *p) {
  mpq_t value;
  int sign;
  mpq_init(value);
  rational_line_value(value, l, p);
  sign = mpq_sgn(value);
  mpq_clear(value);
  return sign;
}

void rational_depth(mpq_t to, const struct geom_point f[3],
                    const struct rational_point *p) {
  struct rational_line plane;
  rational_line_init(&plane);
  solve_plane(&plane, f);
  rational_line_value(to, &plane, p);
  rational_line_clear(&plane);
}

void rational_add_side(mpq_t sum, const struct rational_point *p,
                       const struct rational_point *q) {
  mpq_t term;
  mpq_init(term);
  cross(term, p->x, q->y, q->x, p->y);
  mpq_add(sum, sum, term);
  mpq_clear(term);
}

void rational_add_loop(mpq_t sum, const struct geom_region *region,
                       size_t loop) {
  const struct geom_region_loop *l = &region->loop.item[loop];
  const struct geom_region_side *side = region->side.item + l->side;
  struct rational_point p, q;
  rational_point_init(&p);
  rational_point_init(&q);
  for (uint32_t k = 0; k < l->count; k++) {
    rational_point_at_corner(&p, &side[k].corner);
    rational_point_at_corner(&q, &side[(k + 1) % l->count].corner);
    rational_add_side(sum, &p, &q);
  }
  rational_point_clear(&p);
  rational_point_clear(&q);
}

void rational_add_area2(mpq_t sum, const struct geom_convex *piece) {
  struct rational_point p, q;
  rational_point_init(&p);
  rational_point_init(&q);
  for (uint32_t k = 0; k < piece->count; k++) {
    rational_point_at_corner(&p, &piece->corner[k]);
    rational_point_at_corner(&q, &piece->corner[(k + 1) % piece->count]);
    rational_add_side(sum, &p, &q);
  }
  rational_point_clear(&p);
  rational_point_clear(&q);
}

void rational_area2(mpq_t to, const struct geom_convex *piece) {
  mpq_set_si(to, 0, 1);
  rational_add_area2(to, piece);
}
