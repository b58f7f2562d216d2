/* soak_kinds.c - generators of tests/scenes/ with random sizes. */
#include "tests/fuzz/soak_kinds.h"

static unsigned below(struct random *random, unsigned low, unsigned high) {
  return (unsigned)random_int(random, (int)low, (int)high);
}

static void make_sticks(struct scene *s, recto_options *o, struct random *r) {
  scenes_sticks(s, o, below(r, 2, 60), random_next(r));
}
static void make_soup(struct scene *s, recto_options *o, struct random *r) {
  scenes_soup(s, o, below(r, 2, 60), random_next(r));
}
static void make_cycles(struct scene *s, recto_options *o, struct random *r) {
  if (random_below(r, 2))
    scenes_cycle(s, o, below(r, 3, 12));
  else
    scenes_nested_cycles(s, o, below(r, 1, 6));
}
static void make_needles(struct scene *s, recto_options *o, struct random *r) {
  enum scenes_needles kind = random_below(r, SCENES_NEEDLES_COUNT);
  scenes_needles(s, o, kind, below(r, 8, 80), random_next(r));
}
static void make_duplicates(struct scene *s, recto_options *o,
                            struct random *r) {
  static const double by[] = {0, 1e-9, 1e-6, 1e-3, 0.1};
  scenes_duplicates(s, o, below(r, 2, 30), random_below(r, 2),
                    by[below(r, 0, 4)]);
}
static void make_book(struct scene *s, recto_options *o, struct random *r) {
  scenes_book(s, o, below(r, 2, 40), random_between(r, 0.1, 3));
}
static void make_plates(struct scene *s, recto_options *o, struct random *r) {
  scenes_plates(s, o, below(r, 2, 20), random_below(r, 2));
}
static void make_boxes(struct scene *s, recto_options *o, struct random *r) {
  static const double turn[] = {0, 1e-12, 1e-9, 1e-6, 0.3};
  double radians = turn[below(r, 0, 4)];
  switch (random_below(r, 4)) {
  case 0:
    scenes_cube_stack(s, o, below(r, 2, 8), radians);
    break;
  case 1:
    scenes_touching_boxes(s, o, radians);
    break;
  case 2:
    scenes_box_on_table(s, o, random_below(r, 2), radians);
    break;
  default:
    scenes_cube(s, o, radians);
  }
}
static void make_solids(struct scene *s, recto_options *o, struct random *r) {
  switch (random_below(r, 6)) {
  case 0:
    scenes_globe(s, o, below(r, 2, 10));
    break;
  case 1:
    scenes_pipe(s, o, below(r, 3, 20), below(r, 1, 5));
    break;
  case 2:
    scenes_honeycomb(s, o, below(r, 1, 3));
    break;
  case 3:
    scenes_shells(s, o, below(r, 1, 4), below(r, 2, 6));
    break;
  case 4:
    scenes_lattice(s, o, below(r, 1, 6));
    break;
  default:
    scenes_collinear_edges(s, o, below(r, 1, 5));
  }
}
static void make_surfaces(struct scene *s, recto_options *o, struct random *r) {
  if (random_below(r, 2))
    scenes_paraboloid(s, o, below(r, 1, 14));
  else
    scenes_sinc(s, o, below(r, 2, 14));
}
static void make_piercing(struct scene *s, recto_options *o, struct random *r) {
  static void (*const fill[])(struct scene *,
                              recto_options *) = {scenes_crossed_boxes,
                                                  scenes_three_sheets,
                                                  scenes_edge_through_vertex,
                                                  scenes_pierced_along_diagonal,
                                                  scenes_crossed_in_diagonal,
                                                  scenes_self_intersecting,
                                                  scenes_large_table,
                                                  scenes_coplanar,
                                                  scenes_doubled,
                                                  scenes_two_colours,
                                                  scenes_unwelded,
                                                  scenes_split_faces};
  fill[random_below(r, sizeof fill / sizeof *fill)](s, o);
}
static void make_flaws(struct scene *s, recto_options *o, struct random *r) {
  if (random_below(r, 2))
    scenes_flaw(s, o, below(r, 0, SCENES_FLAW_COUNT));
  else
    scenes_thin_bars(s, o, below(r, 1, 20));
}
static void make_rooms(struct scene *s, recto_options *o, struct random *r) {
  scenes_room(s, o, (enum scenes_eye)random_below(r, SCENES_EYE_ON_LINE + 1));
}
static void make_near(struct scene *s, recto_options *o, struct random *r) {
  static const double by[] = {1e-9, 1e-6, 1e-4, 1e-3, 0.1};
  if (random_below(r, 2))
    scenes_near_sheets(s, o, by[below(r, 0, 4)]);
  else
    scenes_slit(s, o, by[below(r, 1, 4)]);
}
static void make_meshes(struct scene *s, recto_options *o, struct random *r) {
  switch (random_below(r, 6)) {
  case 0:
    scenes_t_junctions(s, o, below(r, 1, 8));
    break;
  case 1:
    scenes_fan(s, o, below(r, 3, 60));
    break;
  case 2:
    scenes_icosahedron(s, o);
    break;
  case 3:
    scenes_box_square_on(s, o);
    break;
  case 4:
    scenes_cycle_field(s, o, below(r, 1, 4));
    break;
  default:
    scenes_white_square(s, o, below(r, 1, 6));
  }
}
/* Segments between corners of another scene: along its faces, through them,
 * before and behind them. */
static void make_wires(struct scene *s, recto_options *o, struct random *r) {
  unsigned wires = below(r, 1, 6);
  if (random_below(r, 2))
    make_boxes(s, o, r);
  else
    make_soup(s, o, r);
  uint32_t points = (uint32_t)s->point.count;
  for (unsigned i = 0; i < wires; i++) {
    uint32_t from = random_below(r, points);
    build_segment(s, from, random_below(r, points));
  }
}
static void make_small(struct scene *s, recto_options *o, struct random *r) {
  scenes_small(s, o, random_next(r));
}

const struct soak_kind soak_kinds[] = {{"sticks", make_sticks},
                                       {"soup", make_soup},
                                       {"cycles", make_cycles},
                                       {"needles", make_needles},
                                       {"duplicates", make_duplicates},
                                       {"book", make_book},
                                       {"plates", make_plates},
                                       {"boxes", make_boxes},
                                       {"solids", make_solids},
                                       {"surfaces", make_surfaces},
                                       {"piercing", make_piercing},
                                       {"flaws", make_flaws},
                                       {"rooms", make_rooms},
                                       {"near", make_near},
                                       {"meshes", make_meshes},
                                       {"wires", make_wires},
                                       {"small", make_small}};
const unsigned soak_kind_count = sizeof soak_kinds / sizeof *soak_kinds;
