/* scenes.h - the scenes that tests, bench and fuzzer share: each shows
 * what programs of this kind are known to fail at.
 *
 * Every generator adds to an initialised, empty scene and sets the camera,
 * page and ink options that show the failure; all else in `options` is left
 * as recto_options_init made it.  The same arguments give the same scene on
 * every machine (up to the last bits of sin, cos and sqrt). */
#ifndef TESTS_SCENES_SCENES_H
#define TESTS_SCENES_SCENES_H

#include "scene/diagnostics.h"
#include "tests/scenes/build.h"

/* One entry of the list of scenes. */
struct scenes_entry {
  const char *name;
  void (*fill)(struct scene *scene, recto_options *options);
};

/* The list of scenes: small enough that every solver, the slowest included,
 * takes little time for each.  Ended by an entry whose name is NULL. */
extern const struct scenes_entry scene_list[];

/* The entry of that name, which must exist. */
const struct scenes_entry *scenes_find(const char *name);

/* ---- Cameras ------------------------------------------------------------- */

/* A 100 x 100 mm page with a 5 mm margin, seen from a direction. */
void scenes_view_direction(recto_options *options, double azimuth_deg,
                           double elevation_deg);
/* The same, in perspective from `eye` towards `target`, up +Z. */
void scenes_view_eye(recto_options *options, struct vector eye,
                     struct vector target, double fov_deg);
/* The same page, looking along -z with up +y, orthographic. */
void scenes_view_above(recto_options *options);
/* True scale, looking along -z with up +y: the page's lower left corner is
 * the scene's (0, 0) and one scene unit is one millimetre. */
void scenes_view_page(recto_options *options, double width_mm,
                      double height_mm);

/* ---- Solids and contact -------------------------------------------------- */

/* The unit cube, turned about z by `radians`; seen from a generic corner. */
void scenes_cube(struct scene *scene, recto_options *options, double radians);
void scenes_icosahedron(struct scene *scene, recto_options *options);

enum scenes_contact {
  SCENES_CONTACT_EXACT, /* shared planes agree to the last bit */
  SCENES_CONTACT_FLOAT  /* turned, then rounded to float32 */
};

/* A box standing on a table top, all turned about a generic axis. */
void scenes_box_on_table(struct scene *scene, recto_options *options,
                         enum scenes_contact contact, double radians);
/* n cubes of falling size on top of each other. */
void scenes_cube_stack(struct scene *scene, recto_options *options, unsigned n,
                       double radians);
/* Two boxes that share a part of a wall. */
void scenes_touching_boxes(struct scene *scene, recto_options *options,
                           double radians);

/* ---- Eyes in degenerate positions ---------------------------------------- */

enum scenes_eye {
  SCENES_EYE_INSIDE,   /* in the middle of the room */
  SCENES_EYE_ON_PLANE, /* on the plane of a face, beside it */
  SCENES_EYE_ON_FACE,  /* within a face */
  SCENES_EYE_ON_VERTEX,
  SCENES_EYE_ON_EDGE, /* within an edge */
  SCENES_EYE_ON_LINE  /* on the line of an edge, beyond its end */
};

/* A room with a table and a column, seen from such a position. */
void scenes_room(struct scene *scene, recto_options *options,
                 enum scenes_eye eye);

/* ---- Degenerate faces ---------------------------------------------------- */

enum scenes_flaw {
  SCENES_FLAW_EDGE_ON,
  SCENES_FLAW_NEEDLE,
  SCENES_FLAW_ZERO_AREA,
  SCENES_FLAW_COLLINEAR,
  SCENES_FLAW_REPEATED,
  SCENES_FLAW_COUNT
};

/* A cube and, in front of it and in it, faces with that flaw (COUNT: with
 * all). */
void scenes_flaw(struct scene *scene, recto_options *options,
                 enum scenes_flaw flaw);
/* n bars, each thinner than the one before by a third. */
void scenes_thin_bars(struct scene *scene, recto_options *options, unsigned n);

/* ---- Piercing ------------------------------------------------------------ */

void scenes_crossed_boxes(struct scene *scene, recto_options *options);
void scenes_three_sheets(struct scene *scene, recto_options *options);
/* An edge that runs exactly through another mesh's vertex. */
void scenes_edge_through_vertex(struct scene *scene, recto_options *options);
/* Sheets that pierce faces exactly along a diagonal and a shared edge. */
void scenes_pierced_along_diagonal(struct scene *scene, recto_options *options);
/* Two quads that share, by index, the diagonal in which they cross; and a quad
 * crossed in its diagonal by two triangles, whose common edge that is.  The
 * lines are from 0,0,0 to 3,0,0 and from 0,6,0 to 3,6,0. */
void scenes_crossed_in_diagonal(struct scene *scene, recto_options *options);
/* A closed tube bent so that it runs through itself. */
void scenes_self_intersecting(struct scene *scene, recto_options *options);

/* ---- Cycles -------------------------------------------------------------- */

/* n >= 3 flat bars that overlap in a ring, none of them rearmost. */
void scenes_cycle(struct scene *scene, recto_options *options, unsigned n);
/* `depth` rings of three bars, each within the opening of the one before. */
void scenes_nested_cycles(struct scene *scene, recto_options *options,
                          unsigned depth);
/* n x n rings of three bars; bars of a ring never touch another ring. */
void scenes_cycle_field(struct scene *scene, recto_options *options,
                        unsigned n);
/* n flat sticks at random; some of them pierce each other. */
void scenes_sticks(struct scene *scene, recto_options *options, unsigned n,
                   uint64_t seed);

/* ---- Large under small, coplanar, doubled -------------------------------- */

void scenes_large_table(struct scene *scene, recto_options *options);
/* Overlapping faces in one plane, in three groups. */
void scenes_coplanar(struct scene *scene, recto_options *options);
/* The same mesh twice, point for point. */
void scenes_doubled(struct scene *scene, recto_options *options);
/* One plane in two colours that meet along a line, as a checked board. */
void scenes_two_colours(struct scene *scene, recto_options *options);

/* ---- Meshes with common defects ------------------------------------------ */

/* n x n quads beside one row of quads half as wide: hanging vertices. */
void scenes_t_junctions(struct scene *scene, recto_options *options,
                        unsigned n);
/* A closed shell whose every triangle has points of its own. */
void scenes_unwelded(struct scene *scene, recto_options *options);
/* Faces that are divided along each other; no dividing line may be drawn. */
void scenes_split_faces(struct scene *scene, recto_options *options);
/* A globe of `rings` x 2 `rings` quads and triangles: one closed outline. */
void scenes_globe(struct scene *scene, recto_options *options, unsigned rings);
/* A box seen square-on: all that shows is one rectangle. */
void scenes_box_square_on(struct scene *scene, recto_options *options);
/* A box whose every edge has `n` points within it. */
void scenes_collinear_edges(struct scene *scene, recto_options *options,
                            unsigned n);

/* ---- Size ---------------------------------------------------------------- */

/* A plate with n x n hexagonal holes. */
void scenes_honeycomb(struct scene *scene, recto_options *options, unsigned n);
/* A Menger sponge of that level, outer faces only (level <= 4). */
void scenes_menger(struct scene *scene, recto_options *options, unsigned level);
/* n bars over n bars: n^2 crossings. */
void scenes_lattice(struct scene *scene, recto_options *options, unsigned n);
/* A pipe of n sides and `rings` sections, seen along its axis. */
void scenes_pipe(struct scene *scene, recto_options *options, unsigned n,
                 unsigned rings);
/* A fan of n triangles about one vertex, up and down like a bellows. */
void scenes_fan(struct scene *scene, recto_options *options, unsigned n);
enum scenes_needles {
  SCENES_NEEDLES_DISC,     /* polygons of n corners: a convex one, ... */
  SCENES_NEEDLES_COMB,     /* ... long teeth, ... */
  SCENES_NEEDLES_SPIRAL,   /* ... a strip rolled up, ... */
  SCENES_NEEDLES_SPIKES,   /* ... a star with spikes at random */
  SCENES_NEEDLES_FLAT_FAN, /* n triangles about one vertex: in a plane, ... */
  SCENES_NEEDLES_CONE,     /* ... a cone, ... */
  SCENES_NEEDLES_UMBRELLA, /* ... a cone with a torn rim */
  SCENES_NEEDLES_COUNT
};

/* Very many thin triangles that overlap (up to three corners may be left
 * out). */
void scenes_needles(struct scene *scene, recto_options *options,
                    enum scenes_needles kind, unsigned n, uint64_t seed);
/* n triangles at one position, each corner moved at random by up to `by`:
 * some seen from behind; where `pierced`, every other one goes through the
 * rest. */
void scenes_duplicates(struct scene *scene, recto_options *options, unsigned n,
                       bool pierced, double by);
/* n pages on one edge, over so many turns. */
void scenes_book(struct scene *scene, recto_options *options, unsigned n,
                 double turns);
/* n large plates over each other, seen obliquely or from above. */
void scenes_plates(struct scene *scene, recto_options *options, unsigned n,
                   bool above);
/* n nested globes: only the outermost is visible. */
void scenes_shells(struct scene *scene, recto_options *options, unsigned n,
                   unsigned rings);
/* n triangles at random that pierce each other. */
void scenes_soup(struct scene *scene, recto_options *options, unsigned n,
                 uint64_t seed);

/* ---- Surfaces and small distances ---------------------------------------- */

/* z = x^2 + y^2 over n x n cells. */
void scenes_paraboloid(struct scene *scene, recto_options *options, unsigned n);
/* z = sin(r) / r over n x n cells. */
void scenes_sinc(struct scene *scene, recto_options *options, unsigned n);
/* Two sheets `gap` apart, as a share of the scene's depth. */
void scenes_near_sheets(struct scene *scene, recto_options *options,
                        double gap);
/* Two plates with a slit of `width_mm` in front of a long edge; true scale. */
void scenes_slit(struct scene *scene, recto_options *options, double width_mm);

/* ---- True scale ---------------------------------------------------------- */

/* A square of 100 mm as a wire, on A4. */
void scenes_calibration_square(struct scene *scene, recto_options *options);
/* 10 mm squares as wires, 150 x 200 mm, on A4. */
void scenes_calibration_grid(struct scene *scene, recto_options *options);
/* A white square in n x n pieces. */
void scenes_white_square(struct scene *scene, recto_options *options,
                         unsigned n);

/* ---- Worked examples ----------------------------------------------------- */

/* Each on a page of 32 x 32 mm, page mm = scene x and y, depth = scene z.
 * Faces in order: the rectangle, the triangle. */
void scenes_pierced_rectangle(struct scene *scene, recto_options *options);
/* Faces in order: 1, 2 (rectangles), 3 (triangle). */
void scenes_two_rectangles(struct scene *scene, recto_options *options);

/* ---- Random small scenes ------------------------------------------------- */

/* 2 to 12 faces on small whole coordinates: touching, coplanar, piercing,
 * cyclic and edge-on, from an axis or a generic camera. */
void scenes_small(struct scene *scene, recto_options *options, uint64_t seed);

/* ---- Faulty files -------------------------------------------------------- */

struct scenes_faulty {
  const char *name;
  const char *text;       /* an OBJ file */
  enum scene_fault fault; /* the fault it has, SCENE_FAULT_COUNT: none */
  unsigned long line;     /* where, 1-based */
  unsigned faces;         /* how many faces are left to draw */
};

/* Ended by an entry whose name is NULL. */
extern const struct scenes_faulty scenes_faulty_list[];

#endif
