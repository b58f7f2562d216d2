/* list.c - the stability list: every generator at a small size. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/scenes/scenes.h"

/* Each line below makes one fill function of the list. */
#define FILL(name, call)                                                       \
  static void fill_##name(struct scene *scene, recto_options *options) { call; }

FILL(cube, scenes_cube(scene, options, 0))
FILL(icosahedron, scenes_icosahedron(scene, options))
FILL(inside, scenes_room(scene, options, SCENES_EYE_INSIDE))
FILL(on_plane, scenes_room(scene, options, SCENES_EYE_ON_PLANE))
FILL(on_face, scenes_room(scene, options, SCENES_EYE_ON_FACE))
FILL(on_vertex, scenes_room(scene, options, SCENES_EYE_ON_VERTEX))
FILL(on_edge, scenes_room(scene, options, SCENES_EYE_ON_EDGE))
FILL(on_line, scenes_room(scene, options, SCENES_EYE_ON_LINE))
FILL(turned_12, scenes_cube(scene, options, 1e-12))
FILL(turned_9, scenes_cube(scene, options, 1e-9))
FILL(turned_6, scenes_cube(scene, options, 1e-6))
FILL(turned_3, scenes_cube(scene, options, 1e-3))
FILL(edge_on, scenes_flaw(scene, options, SCENES_FLAW_EDGE_ON))
FILL(needles, scenes_flaw(scene, options, SCENES_FLAW_NEEDLE))
FILL(zero_area, scenes_flaw(scene, options, SCENES_FLAW_ZERO_AREA))
FILL(collinear, scenes_flaw(scene, options, SCENES_FLAW_COLLINEAR))
FILL(repeated, scenes_flaw(scene, options, SCENES_FLAW_REPEATED))
FILL(flaws_mixed, scenes_flaw(scene, options, SCENES_FLAW_COUNT))
FILL(sticks, scenes_sticks(scene, options, 30, 1))
FILL(cycle_3, scenes_cycle(scene, options, 3))
FILL(cycle_4, scenes_cycle(scene, options, 4))
FILL(nested_cycles, scenes_nested_cycles(scene, options, 4))
FILL(cycle_field, scenes_cycle_field(scene, options, 3))
FILL(on_table, scenes_box_on_table(scene, options, SCENES_CONTACT_EXACT, 0))
FILL(on_table_float,
     scenes_box_on_table(scene, options, SCENES_CONTACT_FLOAT, 0.7))
FILL(on_table_turned,
     scenes_box_on_table(scene, options, SCENES_CONTACT_EXACT, 1e-9))
FILL(cube_stack, scenes_cube_stack(scene, options, 6, 0))
FILL(cube_stack_turned, scenes_cube_stack(scene, options, 6, 1e-9))
FILL(touching, scenes_touching_boxes(scene, options, 0))
FILL(touching_turned, scenes_touching_boxes(scene, options, 1e-9))
FILL(t_junctions, scenes_t_junctions(scene, options, 4))
FILL(globe, scenes_globe(scene, options, 6))
FILL(collinear_edges, scenes_collinear_edges(scene, options, 3))
FILL(honeycomb, scenes_honeycomb(scene, options, 3))
FILL(menger, scenes_menger(scene, options, 1))
FILL(lattice, scenes_lattice(scene, options, 5))
FILL(pipe, scenes_pipe(scene, options, 12, 3))
FILL(paraboloid, scenes_paraboloid(scene, options, 8))
FILL(sinc, scenes_sinc(scene, options, 12))
FILL(slit, scenes_slit(scene, options, 1e-4))
FILL(near_3, scenes_near_sheets(scene, options, 1e-3))
FILL(near_6, scenes_near_sheets(scene, options, 1e-6))
FILL(near_9, scenes_near_sheets(scene, options, 1e-9))
FILL(fan, scenes_fan(scene, options, 40))
FILL(plates, scenes_plates(scene, options, 9, false))
FILL(plates_above, scenes_plates(scene, options, 9, true))
FILL(shells, scenes_shells(scene, options, 3, 5))
FILL(thin_bars, scenes_thin_bars(scene, options, 12))
FILL(soup, scenes_soup(scene, options, 40, 1))
FILL(white_square, scenes_white_square(scene, options, 4))

const struct scenes_entry scene_list[] = {
    {"cube", 1, fill_cube},
    {"icosahedron", 1, fill_icosahedron},
    {"room from inside", 2, fill_inside},
    {"eye on a plane", 2, fill_on_plane},
    {"eye on a face", 2, fill_on_face},
    {"eye on a vertex", 2, fill_on_vertex},
    {"eye on an edge", 2, fill_on_edge},
    {"eye on an edge's line", 2, fill_on_line},
    {"cube turned by 1e-12", 3, fill_turned_12},
    {"cube turned by 1e-9", 3, fill_turned_9},
    {"cube turned by 1e-6", 3, fill_turned_6},
    {"cube turned by 1e-3", 3, fill_turned_3},
    {"faces edge-on", 4, fill_edge_on},
    {"needles", 4, fill_needles},
    {"zero area", 4, fill_zero_area},
    {"collinear vertices", 4, fill_collinear},
    {"repeated vertices", 4, fill_repeated},
    {"flaws mixed", 4, fill_flaws_mixed},
    {"crossed boxes", 5, scenes_crossed_boxes},
    {"three sheets", 5, scenes_three_sheets},
    {"edge through vertex", 5, scenes_edge_through_vertex},
    {"pierced along diagonal", 5, scenes_pierced_along_diagonal},
    {"crossed in a diagonal", 5, scenes_crossed_in_diagonal},
    {"self-intersecting", 5, scenes_self_intersecting},
    {"pierced rectangle", 5, scenes_pierced_rectangle},
    {"two rectangles", 5, scenes_two_rectangles},
    {"cycle of 3", 6, fill_cycle_3},
    {"cycle of 4", 6, fill_cycle_4},
    {"nested cycles", 6, fill_nested_cycles},
    {"field of cycles", 6, fill_cycle_field},
    {"sticks", 6, fill_sticks},
    {"large table", 7, scenes_large_table},
    {"coplanar faces", 8, scenes_coplanar},
    {"doubled mesh", 8, scenes_doubled},
    {"two colours", 8, scenes_two_colours},
    {"touching boxes", 8, fill_touching},
    {"touching boxes turned", 8, fill_touching_turned},
    {"box on table", 0, fill_on_table},
    {"box on table in float32", 0, fill_on_table_float},
    {"box on table turned", 0, fill_on_table_turned},
    {"cube stack", 0, fill_cube_stack},
    {"cube stack turned", 0, fill_cube_stack_turned},
    {"T-junctions", 9, fill_t_junctions},
    {"unwelded", 9, scenes_unwelded},
    {"split faces", 10, scenes_split_faces},
    {"white square", 11, fill_white_square},
    {"globe", 12, fill_globe},
    {"box square-on", 13, scenes_box_square_on},
    {"collinear edges", 15, fill_collinear_edges},
    {"honeycomb", 16, fill_honeycomb},
    {"Menger sponge", 16, fill_menger},
    {"lattice", 16, fill_lattice},
    {"pipe along its axis", 17, fill_pipe},
    {"paraboloid", 20, fill_paraboloid},
    {"sinc", 20, fill_sinc},
    {"calibration square", 24, scenes_calibration_square},
    {"calibration grid", 24, scenes_calibration_grid},
    {"slit", 27, fill_slit},
    {"sheets 1e-3 apart", 28, fill_near_3},
    {"sheets 1e-6 apart", 28, fill_near_6},
    {"sheets 1e-9 apart", 28, fill_near_9},
    {"fan", 29, fill_fan},
    {"plates", 16, fill_plates},
    {"plates from above", 16, fill_plates_above},
    {"shells", 16, fill_shells},
    {"thin bars", 30, fill_thin_bars},
    {"soup", 5, fill_soup},
    {NULL, 0, NULL},
};

const struct scenes_entry *scenes_find(const char *name) {
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++)
    if (strcmp(entry->name, name) == 0)
      return entry;
  fprintf(stderr, "scenes: there is no scene called %s\n", name);
  abort();
}
