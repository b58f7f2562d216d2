/* list.c - the list of scenes: every generator at a small size. */
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
    {"cube", fill_cube},
    {"icosahedron", fill_icosahedron},
    {"room from inside", fill_inside},
    {"eye on a plane", fill_on_plane},
    {"eye on a face", fill_on_face},
    {"eye on a vertex", fill_on_vertex},
    {"eye on an edge", fill_on_edge},
    {"eye on an edge's line", fill_on_line},
    {"cube turned by 1e-12", fill_turned_12},
    {"cube turned by 1e-9", fill_turned_9},
    {"cube turned by 1e-6", fill_turned_6},
    {"cube turned by 1e-3", fill_turned_3},
    {"faces edge-on", fill_edge_on},
    {"needles", fill_needles},
    {"zero area", fill_zero_area},
    {"collinear vertices", fill_collinear},
    {"repeated vertices", fill_repeated},
    {"flaws mixed", fill_flaws_mixed},
    {"crossed boxes", scenes_crossed_boxes},
    {"three sheets", scenes_three_sheets},
    {"edge through vertex", scenes_edge_through_vertex},
    {"pierced along diagonal", scenes_pierced_along_diagonal},
    {"crossed in a diagonal", scenes_crossed_in_diagonal},
    {"self-intersecting", scenes_self_intersecting},
    {"pierced rectangle", scenes_pierced_rectangle},
    {"two rectangles", scenes_two_rectangles},
    {"cycle of 3", fill_cycle_3},
    {"cycle of 4", fill_cycle_4},
    {"nested cycles", fill_nested_cycles},
    {"field of cycles", fill_cycle_field},
    {"sticks", fill_sticks},
    {"large table", scenes_large_table},
    {"coplanar faces", scenes_coplanar},
    {"doubled mesh", scenes_doubled},
    {"two colours", scenes_two_colours},
    {"touching boxes", fill_touching},
    {"touching boxes turned", fill_touching_turned},
    {"box on table", fill_on_table},
    {"box on table in float32", fill_on_table_float},
    {"box on table turned", fill_on_table_turned},
    {"cube stack", fill_cube_stack},
    {"cube stack turned", fill_cube_stack_turned},
    {"T-junctions", fill_t_junctions},
    {"unwelded", scenes_unwelded},
    {"split faces", scenes_split_faces},
    {"white square", fill_white_square},
    {"globe", fill_globe},
    {"box square-on", scenes_box_square_on},
    {"collinear edges", fill_collinear_edges},
    {"honeycomb", fill_honeycomb},
    {"Menger sponge", fill_menger},
    {"lattice", fill_lattice},
    {"pipe along its axis", fill_pipe},
    {"paraboloid", fill_paraboloid},
    {"sinc", fill_sinc},
    {"calibration square", scenes_calibration_square},
    {"calibration grid", scenes_calibration_grid},
    {"slit", fill_slit},
    {"sheets 1e-3 apart", fill_near_3},
    {"sheets 1e-6 apart", fill_near_6},
    {"sheets 1e-9 apart", fill_near_9},
    {"fan", fill_fan},
    {"plates", fill_plates},
    {"plates from above", fill_plates_above},
    {"shells", fill_shells},
    {"thin bars", fill_thin_bars},
    {"soup", fill_soup},
    {NULL, NULL},
};

const struct scenes_entry *scenes_find(const char *name) {
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++)
    if (strcmp(entry->name, name) == 0)
      return entry;
  fprintf(stderr, "scenes: there is no scene called %s\n", name);
  abort();
}
