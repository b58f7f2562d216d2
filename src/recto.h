/* recto.h - exact visible lines and faces of 3D meshes, on paper.
 *
 * Units    Scene coordinates are the model's own unit; where a true scale is
 *          requested, millimetres unless files or options say otherwise.  Page
 *          coordinates are millimetres, x right and y up from the lower left
 *          corner.  Angles are degrees.
 * Errors   Every fallible call returns a recto_status and, when given one,
 *          fills a recto_error with the code, the file and line at fault and
 *          a sentence.  A failed call leaves its outputs NULL.  Every call that
 *          returns a status may return RECTO_ERROR_MEMORY, and
 *          RECTO_ERROR_ARGUMENT for an option out of its range or a pointer
 *          that is NULL where that has no meaning; every one that takes options
 *          RECTO_ERROR_UNSUPPORTED for an output format that is not built in,
 *          and for a field of a later version; what else it may return follows
 *          its description.  Given such a pointer, a call without a status does
 *          nothing and returns 0, NULL or the like.
 * Owner    The library copies what it is given.  You own what a _create,
 *          _read or _render returns and free it with the matching _destroy,
 *          which accepts NULL.  What getters return is owned by the object and
 *          valid until the object is changed or destroyed.
 * Threads  No global state: different objects may be used from different
 *          threads at once; one object from one thread at a time, but for
 *          calls that take it as const, recto_drawing_stats excepted: several
 *          threads may render a scene at once, or write a drawing.
 * Stability  Enumerators keep their values.  Options are initialised by
 *          recto_options_init.  Structs that are handed over grow at their end
 *          or in their reserved fields; macros pass the size that the caller
 *          was compiled with (doc/decisions/0032 in the sources); a size of 0
 *          is taken as a pointer that is NULL.
 */
#ifndef RECTO_H
#define RECTO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The library is built with hidden symbols; these are the exported ones. */
#if defined __GNUC__
#pragma GCC visibility push(default)
#endif

#if defined __GNUC__
#define RECTO_USE_RESULT __attribute__((warn_unused_result))
#else
#define RECTO_USE_RESULT
#endif

/* ---- Status and errors --------------------------------------------------- */

typedef enum recto_status {
  RECTO_OK = 0,
  RECTO_ERROR_ARGUMENT,    /* an option or argument makes no sense */
  RECTO_ERROR_MEMORY,      /* an allocation failed */
  RECTO_ERROR_IO,          /* a file could not be read or written */
  RECTO_ERROR_FORMAT,      /* a model file is broken or truncated */
  RECTO_ERROR_UNSUPPORTED, /* not built in, or not meant for this */
  RECTO_ERROR_EMPTY,       /* nothing to draw */
  RECTO_ERROR_LIMIT,       /* too large: a stated limit was passed */
  RECTO_ERROR_CANCELLED,   /* the caller's progress function returned false */
  RECTO_ERROR_VERIFY,      /* verification found the drawing wrong */
  RECTO_STATUS_COUNT       /* not a status: how many there are */
} recto_status;

/* This struct does not change. */
typedef struct recto_error {
  recto_status code;
  char file[256];     /* "" where no file is at fault */
  unsigned long line; /* 1-based; 0 where no line is at fault */
  char text[256];     /* one sentence, no file name, no newline */
} recto_error;

/* A short name for a status, for logs.  Never NULL, also for bad values. */
const char *recto_status_name(recto_status status);

/* The library's version, "MAJOR.MINOR.PATCH". */
const char *recto_version(void);

/* ---- Vocabulary ---------------------------------------------------------- */

typedef enum recto_method {
  RECTO_METHOD_AUTO = 0,
  RECTO_METHOD_NEWELL,
  RECTO_METHOD_WATKINS,
  RECTO_METHOD_WARNOCK,
  RECTO_METHOD_TILES,
  RECTO_METHOD_ZBUFFER,
  RECTO_METHOD_SCANLINE_ZBUFFER,
  RECTO_METHOD_PAINTER,       /* depth sort by centroid */
  RECTO_METHOD_PAINTER_GIVEN, /* the file's own order, first is rearmost */
  RECTO_METHOD_BRUTE,
  RECTO_METHOD_COUNT
} recto_method;

/* The word for a method, such as "newell", as --method takes it.  Never NULL,
 * also for bad values. */
const char *recto_method_name(recto_method method);

/* Whether this build has the method. */
bool recto_method_is_available(recto_method method);

/* Edge classes, as bits of a mask.  An edge has exactly one. */
typedef enum recto_edge_class {
  RECTO_EDGE_SILHOUETTE = 1 << 0,   /* both faces on one side of it; also where
                                       a face that is not planar folds */
  RECTO_EDGE_BORDER = 1 << 1,       /* one face, or more than two */
  RECTO_EDGE_CREASE = 1 << 2,       /* dihedral beyond the crease angle */
  RECTO_EDGE_GROUP = 1 << 3,        /* two groups meet */
  RECTO_EDGE_INTERSECTION = 1 << 4, /* two faces pierce each other */
  RECTO_EDGE_WIRE = 1 << 5,         /* the user's own polyline */
  RECTO_EDGE_SMOOTH = 1 << 6,       /* the rest */
  RECTO_EDGE_SECTION = 1 << 7       /* where recto_mesh_options.cut cuts a
                                       surface */
} recto_edge_class;

#define RECTO_EDGES_NONE 0u
#define RECTO_EDGES_DEFAULT 0xbfu
#define RECTO_EDGES_ALL 0xffu
#define RECTO_EDGE_CLASS_COUNT 8

/* The word for one class, such as "crease", as --edges takes it.  Never NULL,
 * also for masks and bad values. */
const char *recto_edge_class_name(recto_edge_class edge_class);

typedef enum recto_hidden {
  RECTO_HIDDEN_NONE = 0, /* hidden parts are dropped */
  RECTO_HIDDEN_DASHED,   /* drawn as dashes, real geometry */
  RECTO_HIDDEN_LAYER     /* drawn whole on a layer of their own */
} recto_hidden;

/* What is drawn as the class silhouette. */
typedef enum recto_contours {
  RECTO_CONTOURS_MESH = 0, /* edges of the mesh: exact, and jagged where the
                              mesh stands for a smooth surface */
  RECTO_CONTOURS_SMOOTH    /* the contours of that surface: few long curves */
} recto_contours;

typedef enum recto_fill {
  RECTO_FILL_NONE = 0,
  RECTO_FILL_PAINT, /* visible fragments in their group's colour */
  RECTO_FILL_SHADE, /* visible fragments in flat grey by the light */
  RECTO_FILL_HATCH  /* visible fragments as pen strokes */
} recto_fill;

typedef enum recto_order {
  RECTO_ORDER_NONE = 0, /* by layer, then as the edges come */
  RECTO_ORDER_NEAR,     /* short pen-up travel */
  RECTO_ORDER_AUTO      /* near where the format is for plotters, and in SVG
                           with hatching or several pens; else none */
} recto_order;

/* What is behind the drawing. */
typedef enum recto_background {
  RECTO_BACKGROUND_AUTO = 0, /* white in PNG, else none */
  RECTO_BACKGROUND_NONE,     /* transparent */
  RECTO_BACKGROUND_COLOUR    /* a colour, over all of the page */
} recto_background;

typedef enum recto_fit {
  RECTO_FIT_PAGE = 0, /* the drawing fills the page inside the margins; smooth
                         contours, which bulge beyond a coarse mesh, count
                         unless `ink.exact` */
  RECTO_FIT_NONE,     /* --fov spans the printable height, centred */
  RECTO_FIT_SCALE,    /* true scale: `scale` page mm for a mm of the scene */
  RECTO_FIT_SPHERE,   /* the sphere about the target that encloses the scene
                         fills the page inside the margins: one scale for all
                         directions */
  RECTO_FIT_PREFERRED /* true scale: the largest of those that ISO 5455 prefers,
                         1, 2 and 5 times a power of ten, at which the drawing
                         fits the page inside the margins */
} recto_fit;

typedef enum recto_camera {
  RECTO_CAMERA_DIRECTION = 0, /* from azimuth and elevation, orthographic */
  RECTO_CAMERA_EYE            /* from eye to target */
} recto_camera;

/* The direction at `index` that has a name, such as "iso", as --view takes it;
 * NULL past the last.  Its angles go to *azimuth_deg and *elevation_deg,
 * which may be NULL. */
const char *recto_view_name(size_t index, double *azimuth_deg,
                            double *elevation_deg);

/* The paper size at `index`, such as "A4", upright, as --page takes it; NULL
 * past the last.  Its sides go to *width_mm and *height_mm, which may be
 * NULL. */
const char *recto_page_name(size_t index, double *width_mm, double *height_mm);

/* Reads a colour: #cc0000, cc0000, #c00 or c00, or a name of CSS such as
 * "firebrick", in any case; 0xRRGGBB goes to *colour.  Returns false where it
 * is none of these, and leaves *colour. */
bool recto_colour_parse(const char *text, uint32_t *colour);

/* The most lengths of a pattern of dashes, and the longest. */
#define RECTO_DASH_MAX 12
#define RECTO_DASH_LONGEST 10000

typedef enum recto_divide {
  RECTO_DIVIDE_FOUR = 0, /* windows are cut in the middle */
  RECTO_DIVIDE_BOX       /* around the box of their nearest face */
} recto_divide;

/* Results that a drawing keeps on request, as bits of a mask. */
#define RECTO_RESULT_EDGES 1u        /* recto_drawing_edge */
#define RECTO_RESULT_INVISIBILITY 3u /* and how many faces hide each part */
#define RECTO_RESULT_FACES 4u        /* recto_drawing_fragment */
#define RECTO_RESULTS_ALL 7u

/* ---- Options -------------------------------------------------------------
 * Blocks of options by what they concern.  Every block ends with room for
 * fields that later versions add, so that no field ever moves: a program that
 * was compiled with an older header runs with a newer library, and with an
 * older library as long as it sets no field that this does not have
 * (RECTO_ERROR_UNSUPPORTED).  recto_options_init fills all of it. */

/* The least width of pens and pitch of hatching and scan lines: 200,000 lines
 * on the largest page, 2 m. */
#define RECTO_FINEST_MM 0.01

/* Called with the share of the work done and the name of the stage: by all
 * calls that take options, in each stage every few milliseconds, however large
 * the scene.  The share is that of the whole work from reading (0 to some 0.1)
 * to writing (up to 1), an estimate by the options, and never falls within a
 * call; of a check it is that of the check.  It stands still in the stage
 * topology, of preparation, and in writing PDF, PS, EPS and PNG.  The function
 * may itself call the library, with other objects.  It may fork, too, but the
 * new process is not to return from it: it ends, or starts another program.
 * It returns false to cancel: the call then ends within some 50 ms, for a
 * million triangles, with RECTO_ERROR_CANCELLED and no output, and does not
 * call it again.  Except that cairo lays out a page of PDF, PS or EPS without a
 * pause: for each 100,000 points of strokes up to 0.1 s in PDF, 0.2 s in PS and
 * EPS.
 * Threads  the thread that called the library; never two calls of it at once
 *          for one call of the library */
typedef bool (*recto_progress_fn)(void *user, double share, const char *stage);

/* Called with a warning: a bad element that was skipped, a clipped stroke.
 * `file` may be "", `line` 0. */
typedef void (*recto_warning_fn)(void *user, const char *file,
                                 unsigned long line, const char *text);

#define RECTO_USUAL_MARGIN_MM 10

/* The highest number of a pen; the first is 1. */
#define RECTO_PEN_MAX 1000

/* The lines that a pen is assigned to. */
typedef enum recto_lines {
  RECTO_LINES_OF_CLASS = 0, /* visible lines of an edge class */
  RECTO_LINES_OF_GROUP,     /* visible lines, and hatching, of a group */
  RECTO_LINES_HIDDEN,       /* all hidden lines */
  RECTO_LINES_HATCH         /* all hatching */
} recto_lines;

/* Assigns lines to a pen. */
typedef struct recto_pen_use {
  recto_lines lines;
  recto_edge_class edge_class; /* of RECTO_LINES_OF_CLASS */
  const char *group;    /* of RECTO_LINES_OF_GROUP: the name of a group, or its
                        part between two of the slashes that join object, group
                        and material */
  int pen;              /* 1 to RECTO_PEN_MAX */
  uint64_t reserved[2]; /* 0, as in all structs of arrays below */
} recto_pen_use;

/* How a pen differs from the others. */
typedef struct recto_pen {
  double width_mm; /* RECTO_FINEST_MM to 100; 0: that of all pens, pen_mm */
  bool has_colour; /* false: black, grey where it draws only hidden lines */
  uint32_t colour; /* 0xRRGGBB, of the layer in all formats but HPGL */
  uint64_t reserved[2];
} recto_pen;

/* How many pens wide the visible lines of a class are. */
typedef struct recto_weight {
  recto_edge_class edge_class;
  double weight; /* 0.01 to 100 */
  uint64_t reserved[2];
} recto_weight;

/* A pattern of dashes, and the lines that it is for.  Dashes begin and end at
 * the ends of lines and at corners, but where a hidden line continues a visible
 * one a gap comes first; gaps and short dashes are exact, and the longest ones
 * are fitted to the line; where a gap is wider than all dashes, all are.
 * A line that is too short for two dashes is drawn whole. */
typedef struct recto_dash {
  recto_lines lines;             /* RECTO_LINES_HIDDEN, RECTO_LINES_OF_CLASS */
  recto_edge_class edge_class;   /* of RECTO_LINES_OF_CLASS */
  double length[RECTO_DASH_MAX]; /* of a dash, a gap, a dash ...; at least
                                    RECTO_FINEST_MM, RECTO_DASH_LONGEST at
                                    most, along the middle of the pen's way,
                                    whose ends are round */
  int count;    /* of the lengths, an even number; 0: a line without gaps */
  bool in_pens; /* they are widths of the line, not mm */
  uint64_t reserved[2];
} recto_dash;

/* Reads a pattern of dashes: the name of a line type of ISO 128-2, such as
 * "chain", or lengths between colons, in mm, cm, in, pt or all of them in pen,
 * widths of the line; an odd number of them is given twice.  Sets the lengths
 * of *dash.  Returns false where it is none of these, and leaves *dash. */
bool recto_dash_parse(const char *text, recto_dash *dash);

/* The line type at `index`, such as "chain"; NULL past the last. */
const char *recto_dash_name(size_t index);

/* How visibility is found. */
typedef struct recto_solver_options {
  recto_method method;
  int threads;         /* at most the number of processors; 0: that number */
  double contact;      /* surfaces this close in depth count as touching, scene
                      units; negative: for each face the rounding error of its
                      coordinates */
  double pitch_mm;     /* watkins: between scan lines; 0: exact sweep, else at
                      least RECTO_FINEST_MM */
  int resolution;      /* raster methods: lines over the page height; warnock:
                      in pixels, so many lines; 0: exact */
  recto_divide divide; /* warnock */
  int subpixels;       /* in pixels: average K x K in each, to 16; 0: none */
  int depth_bits;      /* z-buffers: 1 to 32 bits of depth; 0: float64 */
  bool remove_backs;   /* in pixels (the z-buffers, and warnock where a
                          resolution is given): leave out faces that are seen
                          from behind */
  uint64_t reserved[8];
} recto_solver_options;

#define RECTO_CUT_MAX 3

/* A plane.  Beyond it are the points p for which normal . p is at least
 * `offset`. */
typedef struct recto_plane {
  double normal[3]; /* of any length but 0 */
  double offset;
  uint64_t reserved[2];
} recto_plane;

/* What cut faces are filled with, whatever `ink.fill` is. */
typedef enum recto_cut_fill {
  RECTO_CUT_FILL_HATCH = 0,
  RECTO_CUT_FILL_SOLID, /* hatching without gaps */
  RECTO_CUT_FILL_NONE
} recto_cut_fill;

/* How the cut faces of a group are hatched. */
typedef struct recto_cut_hatch {
  const char *group; /* as of recto_pen_use */
  double angle_deg;
  double pitch_mm; /* at least RECTO_FINEST_MM; 0: chosen */
  uint64_t reserved[2];
} recto_cut_hatch;

/* What of a file says which edges are creases, besides their angle: those that
 * it marks as hard, where the normals of two faces differ at both ends of their
 * edge, or else their smoothing groups do; and as smooth, where they are the
 * same. */
typedef enum recto_crease_marks {
  /* Marks between half and twice the crease angle, of connected parts of the
   * model that have hard edges and smooth ones. */
  RECTO_CREASE_MARKS_AUTO = 0,
  RECTO_CREASE_MARKS_NONE,
  RECTO_CREASE_MARKS_ALL
} recto_crease_marks;

/* How the scene's points are understood, and what is cut off. */
typedef struct recto_mesh_options {
  /* Corners of borders that are at most this far apart are welded, scene units;
   * negative: within the rounding error of the coordinates; 0: only those at
   * equal positions.  But for 0, slits without width are closed, and faces of a
   * group that are listed twice, with edges of more than two faces, left out
   * once, unless solver.remove_backs is set. */
  double weld;
  double crease_deg; /* faces that meet at a larger angle make a crease */
  /* Significant bits of the coordinates given to recto_scene_add_point, 1 to
   * 53: their rounding error is half a unit of the last one; 53: exact; 0: 24
   * where all of them are single precision numbers, else 53.  For coordinates
   * from files the precision follows from the file. */
  int coordinate_bits;
  /* Of OBJ files: both when they are read and when the scene is drawn; with
   * RECTO_CREASE_MARKS_NONE for either there are none. */
  recto_crease_marks crease_marks;
  /* Creases that are joined end to end are drawn only if faces meet at a larger
   * angle than this at one of them at least.  0: this holds, with 1.5 times
   * `crease_deg`, for lines that end free alone; for none where `ink.exact` is
   * set or `ink.min_stroke_mm` is 0. */
  double crease_start_deg;
  /* Planes: what is beyond all of them is removed before anything else, and
   * where that opens closed surfaces cut faces close them, which belong to
   * their groups and hide what is behind them like any face. */
  const recto_plane *cut; /* cut_count of them */
  size_t cut_count;       /* at most RECTO_CUT_MAX */
  recto_cut_fill cut_fill;
  char unused_2[4]; /* 0 */
  /* The hatching of some groups' cut faces, cut_hatch_count of them; of several
   * for one group the last counts.  Other groups get angles and pitches in
   * turn, from those of `ink.hatch_angle_deg` and `ink.hatch_pitch_mm` on, so
   * that no two neighbours have the same. */
  const recto_cut_hatch *cut_hatch;
  size_t cut_hatch_count;
  uint64_t reserved[2];
} recto_mesh_options;

typedef struct recto_camera_options {
  recto_camera kind;
  double azimuth_deg, elevation_deg; /* 0,0 is the front; azimuth turns the
                                        eye to the right, elevation up */
  double eye[3], target[3];          /* scene units */
  bool has_target;                   /* false: the middle of the scene */
  double up[3];                      /* 0,0,0: what the format means */
  double fov_deg;                    /* vertical, to 179; 0: orthographic */
  recto_fit fit;
  double scale;         /* with RECTO_FIT_SCALE */
  double near_distance; /* scene units; 0: as near as anything drawn, but at
                           least a 16384th of the way to the target */
  bool has_section;
  double section; /* scene units in front of the eye, or behind the scene's
                     nearest point for a direction: what is nearer is cut off,
                     as by a plane of mesh.cut parallel to the page; excludes
                     these */
  double unit_mm; /* with RECTO_FIT_SCALE and RECTO_FIT_PREFERRED: a scene unit
                     is so many mm, of which the scale's number of mm is drawn
                     for one; 0: what the first file says (glTF and Collada:
                     1000; 3MF: its unit), else 1 */
  uint64_t reserved[7];
} recto_camera_options;

typedef struct recto_page_options {
  double width_mm, height_mm; /* RECTO_FINEST_MM to 2000 */
  double margin_mm; /* on every side, and nothing is drawn there; negative:
                       RECTO_USUAL_MARGIN_MM or, if that is less, a quarter of
                       the shorter side; as much more as the plotter of the
                       output's format needs */
  bool may_turn;    /* the page is turned by a quarter where RECTO_FIT_PAGE then
                       draws the scene larger, or RECTO_FIT_SCALE more of it */
  char unused[7];   /* 0 */
  uint64_t reserved[7];
} recto_page_options;

typedef struct recto_ink_options {
  unsigned edges; /* mask of recto_edge_class */
  recto_hidden hidden;
  int hidden_by_max; /* draw hidden lines of at most this quantitative
                        invisibility (number of faces in front); 0: all */
  recto_fill fill;
  double seam_mm; /* below all fills, each is extended over its borders by half
                     of this, so that viewers show no hairlines between fills;
                     0 to 10; negative: what suits the output's format */
  double hatch_pitch_mm, hatch_angle_deg; /* at least RECTO_FINEST_MM */
  bool hatch_inset; /* without a light: hatching ends half a pen inside, so that
                       no ink lies beyond what is visible */
  double light[3];  /* direction towards the light; 0,0,0: the viewer's upper
                       left */
  double pen_mm;    /* RECTO_FINEST_MM to 100 */
  int pens;         /* pens to assign the groups to; 1: all on one */

  /* A line is drawn by the pen of the first use that applies to it: as a hidden
   * line or hatching, by its class, by its group; if there is none, `pens`
   * decides.  Of several uses for the same lines the last one counts. */
  const recto_pen_use *pen_use; /* pen_use_count of them */
  size_t pen_use_count;
  const recto_pen *pen; /* of the pens 1 to pen_count, in order */
  size_t pen_count;     /* at most RECTO_PEN_MAX */

  /* The weights of classes in SVG, PDF, EPS, PS and PNG; lines of different
   * weight are different strokes.  A class that is not listed is one pen wide;
   * without weights silhouettes and borders are two pens wide unless there are
   * several pens, or the output is for plotters, whose pens have one width. */
  bool has_weights;
  const recto_weight *weight; /* weight_count of them */
  size_t weight_count;

  recto_order order;
  double simplify_mm; /* no point of a line moves by more */
  /* Hatch lines that are shorter are dropped, and so are creases and group
   * borders of which an end is free, lines of creases mostly of shorter pieces,
   * and silhouettes of the mesh within the picture that lead nowhere, twice as
   * long ones if they touch nothing; negative: half a pen, and creases and
   * silhouettes 10 pens.
   * Other lines are dropped if they are shorter than that and than half a pen.
   */
  double min_stroke_mm;
  bool ids;   /* one source for each stroke, written with it */
  bool exact; /* visible lines as they are: no crease or silhouette is dropped
                     because an end is free, nor a line within half a pen of
                     longer ones, and no gap of less is closed, nor thin
                     loops of smooth contours left out; nor are they where
                     min_stroke_mm is 0 */
  /* Whether `ambient` and `fill_light` below are given; 0.3 and 0.5 else. */
  bool has_ambient, has_fill_light;
  char unused[4];          /* 0 */
  recto_contours contours; /* silhouettes of the mesh, or of the smooth surface
                              that it samples; not with verify */
  double curves_mm;  /* smooth strokes become cubic Bezier curves, no point of
                       which is farther from them; 0: polylines */
  double ambient;    /* the brightness of what no light reaches, 0 to 1 */
  double fill_light; /* the share of the rest that a second light gives, which
                        comes from all around the first one, so that what turns
                        away from that has tones too; 0 to 1 */
  /* The dashes of visible lines of a class, and of hidden lines if they are
   * drawn; dash_count of them.  Lines without one are drawn whole, but for
   * those that RECTO_HIDDEN_DASHED dashes.  Of several for the same lines the
   * last one counts. */
  const recto_dash *dash;
  size_t dash_count;
  uint64_t reserved[2];
} recto_ink_options;

typedef struct recto_output_options {
  /* The format that the drawing is made for, such as "svg", as of
   * recto_output_format; NULL: none.  It decides the resolution, where unit_mm
   * is 0, the width of seams and the order, and for plotters the margin and the
   * weights, where they are the defaults. */
  const char *format;
  /* The output's resolution: lines that coincide at it are drawn once; 0: that
   * of the format, or without one only lines at exactly the same place. */
  double unit_mm;
  int precision;      /* decimals of a millimetre in text formats, 0 to 9; also
                           those of a drawing to check */
  bool polyline;      /* SVG: <polyline> elements instead of <path> */
  bool tight;         /* all but HPGL: the page is the ink's box; of a drawing
                           to check, it is */
  double dpi;         /* PNG: pixels per inch; 0: 150 */
  const char *device; /* HPGL: the plotter's name; NULL: "generic" */
  double velocity_cm_s;    /* HPGL: pen speed; 0: the plotter's own */
  double velocity_up_cm_s; /* speed with the pen up, for the time that plotting
                              takes; 0: the plotter's own */
  /* Of SVG and PDF, the title also of PS and EPS, in UTF-8; NULL: the name of
   * the model's file, where there is one alone, and a sentence about the view;
   * "": none. */
  const char *title, *description;
  const char *id_prefix; /* SVG: what all ids begin with, and a second name of
                            every class: a letter or _, then letters, digits, -,
                            _ and points; NULL: nothing, and no second name */
  recto_background background;
  uint32_t background_colour; /* 0xRRGGBB, of RECTO_BACKGROUND_COLOUR; not in
                                 HPGL */
  uint64_t reserved[4];
} recto_output_options;

/* Where the views of a sheet lie, as ISO 5456-2 arranges them about the front
 * view. */
typedef enum recto_arrangement {
  RECTO_ARRANGEMENT_NONE = 0, /* there is no sheet: one view, by `camera` */
  RECTO_ARRANGEMENT_FIRST,    /* first-angle projection: the view from above is
                                 below, that from the left on the right */
  RECTO_ARRANGEMENT_THIRD     /* third-angle projection: the view from above is
                                 above, that from the left on the left */
} recto_arrangement;

/* A view of a sheet. */
typedef struct recto_sheet_view {
  const char *name; /* a name of recto_view_name; NULL: seen in the direction of
                       `camera`, and not aligned */
  double scale;     /* how many times the sheet's scale, for views that are not
                       along an axis; 0: once */
  bool has_hidden;  /* `hidden` takes the place of `ink.hidden` */
  char unused[3];   /* 0 */
  recto_hidden hidden;
  uint64_t reserved[2];
} recto_sheet_view;

/* The most details of a sheet. */
#define RECTO_DETAIL_MAX 8

/* A circle of a sheet that is drawn again, larger, where there is room beside
 * the views. */
typedef struct recto_detail {
  double x_mm, y_mm, radius_mm; /* of the page */
  double scale;                 /* above 0: how many times as large */
  uint64_t reserved[2];
} recto_detail;

/* Several views of a scene on one page: a sheet.  All are parallel projections
 * at one scale, by `camera.fit`: the largest that fits, a preferred or a given
 * one.  Front, back, left, right, top and bottom are aligned; other views stand
 * in the corner that these leave free, and beside it. */
typedef struct recto_sheet_options {
  recto_arrangement arrangement;
  bool names;                   /* draw each view's name below it */
  char unused[3];               /* 0 */
  const recto_sheet_view *view; /* view_count of them, each once; 0: front, top
                                   and left, in third-angle projection right */
  size_t view_count;
  const recto_detail *detail; /* detail_count of them */
  size_t detail_count;
  uint64_t reserved[6];
} recto_sheet_options;

typedef struct recto_options {
  size_t size; /* set by recto_options_init: that of this struct */
  recto_solver_options solver;
  recto_mesh_options mesh;
  recto_camera_options camera;
  recto_page_options page;
  recto_ink_options ink;
  recto_output_options output;

  int verify; /* number of samples that an independent ray caster checks, of the
                 drawn lines, and of the requested edges; 0: none */
  /* What the drawing keeps as data beside its strokes: a mask of
   * RECTO_RESULT_EDGES, RECTO_RESULT_INVISIBILITY and RECTO_RESULT_FACES; of
   * one view, not of a sheet. */
  unsigned results;

  /* Callbacks, called from the thread that called the library. */
  recto_progress_fn progress;
  recto_warning_fn warning;
  void *user;

  recto_sheet_options sheet;
} recto_options;

/* Fills `options` with the defaults: auto, isometric, A4 upright with a 10 mm
 * margin, a 0.3 mm pen, every class of edge but the smooth ones. */
#define recto_options_init(options)                                            \
  recto_options_init_sized((options), sizeof *(options))
void recto_options_init_sized(recto_options *options, size_t size);

/* ---- Level 1: one call for the whole job --------------------------------- */

/* Reads `model`, draws it and writes `output`.
 * model    path; its format by extension, or "-" for standard input
 * from     format name such as "obj"; NULL: by extension
 * output   path, or "-" for standard output
 * to       format name such as "svg"; NULL: by extension
 * options  NULL: the defaults
 * Errors   as of recto_scene_read, recto_scene_render and recto_drawing_write
 */
RECTO_USE_RESULT recto_status recto_draw_file(
    const char *model, const char *from, const char *output, const char *to,
    const recto_options *options, recto_error *error);

/* ---- Level 2: scene, drawing --------------------------------------------- */

typedef struct recto_scene recto_scene;
typedef struct recto_drawing recto_drawing;

/* Creates an empty scene; destroys one. */
RECTO_USE_RESULT recto_status recto_scene_create(recto_scene **scene,
                                                 recto_error *error);
void recto_scene_destroy(recto_scene *scene);

/* Reads a model file and adds it to `scene`.  Warnings go to the options'
 * warning function; colours, which OBJ has in its material libraries, are read
 * where the options' fill is RECTO_FILL_PAINT; `options` may be NULL.  A file
 * has groups of its own: what is in none is in one that is called as the file
 * without folder and extension, and where a group that is there already has a
 * name, the file's is called "FILE/NAME", or has a point and a number behind.
 * Its points are scaled to the unit of the scene and turned about X to its up
 * axis: those of the first file, or, of what the caller added before,
 * millimetres and +Y.  A file that states no unit is in millimetres once
 * another one states one, and a warning says so.  Where the options have
 * camera.unit_mm nothing is scaled, and where they have camera.up nothing is
 * turned.
 * path    "-" is standard input, which needs a format; its group is "default"
 * format  format name such as "obj"; NULL: by the path's extension
 * Errors  RECTO_ERROR_IO: it cannot be read; RECTO_ERROR_FORMAT: it is broken
 *         or cut short; RECTO_ERROR_UNSUPPORTED: there is no reader for it;
 *         RECTO_ERROR_LIMIT: it is too large; RECTO_ERROR_CANCELLED */
RECTO_USE_RESULT recto_status recto_scene_read(recto_scene *scene,
                                               const char *path,
                                               const char *format,
                                               const recto_options *options,
                                               recto_error *error);

/* Reads the bytes of a model file from memory and adds it to `scene`.
 * format  format name such as "obj"; NULL: by the name's extension
 * name    for messages, and for groups, like that of a file; beside a file of
 *         that name the material libraries of an OBJ file are looked for; NULL:
 *         they are not read
 * Errors  as of recto_scene_read; the scene is then as it was */
RECTO_USE_RESULT recto_status recto_scene_read_memory(
    recto_scene *scene, const void *bytes, size_t count, const char *format,
    const char *name, const recto_options *options, recto_error *error);

/* A mesh in arrays, which belong to the caller.  Initialise it with zeros, so
 * that fields that a later version adds are zero too. */
typedef struct recto_mesh {
  const double *points;       /* point_count triples x y z, scene units; or: */
  const float *points_single; /* the same in single precision, where `points`
                                 is NULL; their rounding counts as that of a
                                 file's coordinates */
  size_t point_count;
  const uint32_t *corners; /* corner_count indices of these points, from 0 */
  size_t corner_count;
  /* Face f has the corners from face_offsets[f] up to face_offsets[f + 1], or
   * up to corner_count for the last; NULL: face_size corners each. */
  const uint32_t *face_offsets;
  size_t face_count;  /* may be 0 where face_offsets is NULL: counted */
  uint32_t face_size; /* corners of every face; 0: 3 */
  const uint32_t *face_groups; /* index of group_names for each face; NULL: the
                                  current group */
  const char *const *group_names; /* UTF-8 */
  size_t group_count;
} recto_mesh;

/* Adds a mesh to the scene, all of it or, on an error, nothing.  Its faces are
 * numbered in their order from the number of faces that were added before.
 * Faces without area are skipped and counted in the stats, as in a file.
 * Errors  RECTO_ERROR_ARGUMENT: an index out of range, a face of fewer than
 *         three corners, a point that is not finite: the text has its number;
 *         RECTO_ERROR_LIMIT, RECTO_ERROR_MEMORY */
#define recto_scene_add_mesh(scene, mesh, error)                               \
  recto_scene_add_mesh_sized((scene), (mesh), sizeof *(mesh), (error))
RECTO_USE_RESULT recto_status recto_scene_add_mesh_sized(recto_scene *scene,
                                                         const recto_mesh *mesh,
                                                         size_t size,
                                                         recto_error *error);

/* Adds a point, x y z in scene units, finite; its index goes to *index.
 * Errors  RECTO_ERROR_LIMIT: 2^31 points are too many */
RECTO_USE_RESULT recto_status recto_scene_add_point(recto_scene *scene,
                                                    const double xyz[3],
                                                    uint32_t *index,
                                                    recto_error *error);

/* Starts a group; faces and polylines added later belong to it. */
RECTO_USE_RESULT recto_status recto_scene_add_group(recto_scene *scene,
                                                    const char *name,
                                                    recto_error *error);

/* Adds a face of `count` >= 3 corners, indices of points; it need not be
 * planar.  One without area is skipped and counted in the stats, as in a file.
 * Errors  RECTO_ERROR_LIMIT: 2^31 corners are too many */
RECTO_USE_RESULT recto_status recto_scene_add_face(recto_scene *scene,
                                                   const uint32_t *corner,
                                                   size_t count,
                                                   recto_error *error);

/* Adds a polyline of `count` >= 2 points, drawn with class wire. */
RECTO_USE_RESULT recto_status recto_scene_add_polyline(recto_scene *scene,
                                                       const uint32_t *corner,
                                                       size_t count,
                                                       recto_error *error);

/* Prepares the scene for several views: welds its corners, finds its edges and
 * decides which of them are borders and creases, as recto_scene_render does it
 * each time for a scene that was not prepared.  Renders with the same `weld`,
 * `coordinate_bits` and `remove_backs` then share the result, and with the same
 * `crease_deg` the decisions too; those with others do the work themselves, and
 * so do all with another `crease_deg` or `crease_marks` of a scene whose files
 * mark edges.  What is added to the scene later undoes it.
 * Errors   RECTO_ERROR_LIMIT: sizes and distances differ by too much;
 *          RECTO_ERROR_CANCELLED */
RECTO_USE_RESULT recto_status recto_scene_prepare(recto_scene *scene,
                                                  const recto_options *options,
                                                  recto_error *error);

/* Draws the scene as the options say; NULL: the defaults.  Each view of a sheet
 * has layers of its own, whose labels name it; what is verified is every view,
 * and the stats have a section for each.
 * Errors  RECTO_ERROR_EMPTY: there is nothing to draw; RECTO_ERROR_LIMIT: there
 *         is too much for the method, or sizes and distances differ by too
 *         much; RECTO_ERROR_UNSUPPORTED: the method or the output's format is
 *         not built in; RECTO_ERROR_VERIFY; RECTO_ERROR_CANCELLED */
RECTO_USE_RESULT recto_status recto_scene_render(const recto_scene *scene,
                                                 const recto_options *options,
                                                 recto_drawing **drawing,
                                                 recto_error *error);

/* Reads a model for recto_scene_write_part and recto_scene_has_part alone.  An
 * OBJ file that is not compressed is not held, where it is the only one of the
 * scene: they read it themselves, its faces block by block, and hold its points
 * and what meets the window; their options say what is warned of.  To all other
 * functions the scene is then empty, and nothing may be added to it.  Anything
 * else is read as by recto_scene_read.
 * Errors   as of recto_scene_read; of a file that is not held they come from
 *          the functions that read it */
RECTO_USE_RESULT recto_status recto_scene_read_for_parts(
    recto_scene *scene, const char *path, const char *format,
    const recto_options *options, recto_error *error);

/* The most parts of a drawing. */
#define RECTO_PARTS_MAX 4096

/* Draws one of `count` parts of a drawing, a window of the page, and writes it
 * to a file that recto_join_parts takes.  A part has what of the model meets
 * its window; the windows depend on the scene, the options and `count`, and
 * have about as many points each.  Of the options for ink those say what is
 * solved that choose what is drawn: edges, hidden, hidden_by_max, fill, ids,
 * and for hatching by tone light, ambient, fill_light and pen_mm: to find the
 * tones the model is held, and so it is to find which marks of creases count,
 * where a file may have such.
 * `output.format` is that of the joined drawing, as its margin may depend on
 * it.
 * number  from 1 to `count`
 * count   at most RECTO_PARTS_MAX
 * path    written whole or not at all, as by recto_drawing_write
 * Errors  those of recto_scene_render; RECTO_ERROR_UNSUPPORTED also where the
 *         parts could not be joined to the same drawing: with approximate
 *         methods, smooth contours, cuts, sheets, results or verification, in a
 *         view that the page or the near plane clips, of a scene of extreme
 *         size, and where welding might join corners or leave out faces;
 *         RECTO_ERROR_IO */
RECTO_USE_RESULT recto_status recto_scene_write_part(
    const recto_scene *scene, const recto_options *options, unsigned number,
    unsigned count, const char *path, recto_error *error);

/* Sets *is_there to whether a file is the very part that
 * recto_scene_write_part would write there, whole, and need not be made again.
 * Warns of nothing.
 * Errors  those of it, but for the solver's */
RECTO_USE_RESULT recto_status recto_scene_has_part(
    const recto_scene *scene, const recto_options *options, unsigned number,
    unsigned count, const char *path, bool *is_there, recto_error *error);

/* Makes the plan of a drawing's parts, a file by which recto_plan_write_part
 * draws each of them without the model: it holds the camera, the windows, and
 * of each window the faces that its part has.  So the model is read once for
 * all of them, and a part needs no more memory than for its window.  The plan
 * takes about 32 bytes for each triangle on disk, and 60 in memory while it is
 * made.
 * options  of the drawing, as for recto_scene_write_part; where they need
 *          tones, these are found once, for the plan
 * count    at most RECTO_PARTS_MAX
 * path     written whole or not at all, as by recto_drawing_write
 * Errors   as of recto_scene_write_part, but for corners that welding might
 *          join, which a part finds */
RECTO_USE_RESULT recto_status
recto_scene_write_plan(const recto_scene *scene, const recto_options *options,
                       unsigned count, const char *path, recto_error *error);

/* Draws a part by a plan.  The file has the bytes that recto_scene_write_part
 * writes, and may be joined with such parts.
 * plan     the path of the plan, a regular file
 * options  those of the solver are used; camera, page, mesh and edges are those
 *          of the plan, and so is what is solved; NULL: the defaults
 * count    that of the plan
 * Errors   as of recto_scene_write_part; RECTO_ERROR_ARGUMENT: the plan has
 *          another count; RECTO_ERROR_FORMAT: it is none, cut short or damaged;
 *          RECTO_ERROR_UNSUPPORTED: it is of another version, or the options
 *          need fills, hidden lines, a number of hiding faces, ids or tones
 *          that it was made without */
RECTO_USE_RESULT recto_status recto_plan_write_part(
    const char *plan, const recto_options *options, unsigned number,
    unsigned count, const char *path, recto_error *error);

/* Sets *is_there to whether a file is the very part that recto_plan_write_part
 * would write there, whole, and need not be made again.
 * Errors  those of it, but for the solver's */
RECTO_USE_RESULT recto_status recto_plan_has_part(
    const char *plan, const recto_options *options, unsigned number,
    unsigned count, const char *path, bool *is_there, recto_error *error);

/* Joins the parts of a drawing, in any order, and inks it: the drawing is the
 * one that recto_scene_render would make of the whole, to the byte.  Camera,
 * page and mesh are those of the parts, and so are the edges; of the options
 * those for ink and output are used.
 * Errors  RECTO_ERROR_ARGUMENT: a part is missing, there twice, or of another
 *         drawing; RECTO_ERROR_FORMAT: a file is no part, cut short or damaged;
 *         the error names it; RECTO_ERROR_UNSUPPORTED: the options need what
 *         the parts do not have: fills, hidden lines, a number of hiding faces,
 *         ids or tones that these were made without, or a plotter that needs a
 *         wider margin than theirs, unless they set one; results or
 *         verification; RECTO_ERROR_IO; RECTO_ERROR_LIMIT;
 *         RECTO_ERROR_CANCELLED */
RECTO_USE_RESULT recto_status recto_join_parts(const char *const *paths,
                                               size_t count,
                                               const recto_options *options,
                                               recto_drawing **drawing,
                                               recto_error *error);

/* Destroys a drawing and what its getters returned. */
void recto_drawing_destroy(recto_drawing *drawing);

/* Checks, before the work is done, whether recto_drawing_write_with_stats could
 * write to these paths: each can be created or replaced, none is a file that
 * the scene was read from, and they are not one file.
 * stats   NULL: none
 * Errors  RECTO_ERROR_IO; RECTO_ERROR_ARGUMENT: a file that was read would be
 *         replaced, or both are one */
RECTO_USE_RESULT recto_status recto_scene_try_output(const recto_scene *scene,
                                                     const char *path,
                                                     const char *stats,
                                                     recto_error *error);

/* Writes the drawing; whole or not at all.  Path "-" is standard output, and
 * so are /dev/stdout and the like; format NULL: by the path's extension, of
 * which svgz and svg.gz stand for a compressed one, or for standard output and
 * /dev/fd/N svg; options NULL: the defaults.
 * A file that is there is replaced by a new one with its owner, mode, access
 * list and attributes; where it has several names, or where these cannot be
 * kept, its bytes are replaced once all of them are known.
 * PNG is painted by cairo, whose version 1.16 may end the process if memory
 * runs out while it does so.
 * Errors  RECTO_ERROR_IO: it cannot be written; RECTO_ERROR_UNSUPPORTED: there
 *         is no such format; RECTO_ERROR_LIMIT: it is too large for the format;
 *         RECTO_ERROR_ARGUMENT also where a file that the scene was read from
 *         would be replaced; RECTO_ERROR_CANCELLED */
RECTO_USE_RESULT recto_status recto_drawing_write(const recto_drawing *drawing,
                                                  const char *path,
                                                  const char *format,
                                                  const recto_options *options,
                                                  recto_error *error);

/* The same, and writes the text of recto_drawing_stats: both or neither.
 * stats   a path as above; NULL: none
 * Errors  RECTO_ERROR_ARGUMENT also where both are one file */
RECTO_USE_RESULT recto_status recto_drawing_write_with_stats(
    const recto_drawing *drawing, const char *path, const char *format,
    const char *stats, const recto_options *options, recto_error *error);

/* Receives a part of an output; returns false where it cannot be taken. */
typedef bool (*recto_write_fn)(void *user, const void *bytes, size_t count);

/* Writes the drawing through a function, which is called once the whole output
 * has been made, and then with one part after the other.
 * format  name of a format such as "svg", "svgz" or "pdf"
 * write   called with `user`
 * Errors  as of recto_drawing_write; RECTO_ERROR_IO where `write` returned
 *         false */
RECTO_USE_RESULT recto_status
recto_drawing_write_to(const recto_drawing *drawing, const char *format,
                       const recto_options *options, recto_write_fn write,
                       void *user, recto_error *error);

/* The name of the output format that recto_drawing_write would take for this
 * path and format, which may be NULL; NULL where there is none. */
const char *recto_output_format(const char *path, const char *format);

/* The output format at `index`, such as "svg"; NULL past the last. */
const char *recto_output_format_name(size_t index);

/* The length of false and missing lines of a drawing, in mm of its page. */
typedef struct recto_verdict {
  double drawn_mm, false_mm;     /* lines; of these hidden, or of no edge */
  double visible_mm, missing_mm; /* requested edges; of these not drawn */
  double undecided_mm;           /* counted as right */
  double false_at_mm[2], missing_at_mm[2]; /* the first of each: x, y */
} recto_verdict;

/* Checks any program's drawing of the scene, an SVG file, by an independent ray
 * caster: seen by the camera of the options, on the file's own page, for the
 * options' edge classes.  Lines may be off by a quarter of the options' pen,
 * and by as much as simplify_mm and the output's unit, or where that is 0 its
 * precision, allow a drawing.  Dashed lines, those of the class hidden or of a
 * layer labelled so, hatching of the class hatch and lines of the class text
 * are not checked.
 * Errors  RECTO_ERROR_IO: the file cannot be read; RECTO_ERROR_FORMAT: it is no
 *         SVG that can be read; RECTO_ERROR_EMPTY, RECTO_ERROR_LIMIT as of
 *         recto_scene_render; RECTO_ERROR_CANCELLED */
#define recto_scene_check(scene, path, options, verdict, error)                \
  recto_scene_check_sized((scene), (path), (options), (verdict),               \
                          sizeof *(verdict), (error))
RECTO_USE_RESULT recto_status recto_scene_check_sized(
    const recto_scene *scene, const char *path, const recto_options *options,
    recto_verdict *verdict, size_t size, recto_error *error);

/* The result of verification, a sentence; NULL where it was not requested.
 * Errors that it finds are errors of recto_scene_render.  Owned by the
 * drawing. */
const char *recto_drawing_verdict(const recto_drawing *drawing);

/* Counts, times and choices as one JSON object.  Owned by the drawing, until
 * the next call for it. */
const char *recto_drawing_stats(const recto_drawing *drawing);

/* ---- Level 3: the drawing as data ----------------------------------------
 * Structs that are filled in here grow at their end in later versions.  The
 * macros pass the size that the caller was compiled with. */

/* No face, edge, group or layer. */
#define RECTO_NONE UINT32_MAX

/* The page's width and height. */
void recto_drawing_page(const recto_drawing *drawing, double size_mm[2]);

/* Layers are drawn in their order; within a layer, fills before strokes. */
typedef struct recto_layer {
  unsigned pen;      /* counts from 1; 0: a layer of fills without a pen */
  const char *label; /* such as "1 visible" */
  uint32_t colour;   /* of its strokes, 0xRRGGBB */
  double width_mm;   /* of its pen */
} recto_layer;

/* How many layers there are. */
size_t recto_drawing_layer_count(const recto_drawing *drawing);

/* Fills in the layer at `index`; past the last returns false, and the layer is
 * empty. */
#define recto_drawing_layer(drawing, index, layer)                             \
  recto_drawing_layer_sized((drawing), (index), (layer), sizeof *(layer))
bool recto_drawing_layer_sized(const recto_drawing *drawing, size_t index,
                               recto_layer *layer, size_t size);

/* The groups of the scene, in the order in which a face or a polyline was first
 * read or added to each; names that none has are left out, but for those given
 * to recto_scene_add_group.  A name is UTF-8, as it was in the file or
 * given. */
size_t recto_drawing_group_count(const recto_drawing *drawing);
/* NULL past the last. */
const char *recto_drawing_group_name(const recto_drawing *drawing,
                                     size_t index);

typedef struct recto_stroke {
  const double *points; /* count pairs x, y in page mm, of the polyline that
                           curves_mm > 0 lets a format draw as a curve */
  size_t count;
  bool closed; /* the last point joins the first, not repeated */
  bool hidden; /* a hidden part of a line */
  recto_edge_class edge_class; /* 0: a line of hatching */
  double width_mm;
  uint32_t layer;
  /* Of its first segment; RECTO_NONE where it has none.  Faces are counted in
   * the order in which they were read or added, skipped ones too; groups are
   * those of recto_drawing_group_name. */
  uint32_t face, edge, group;
  bool is_text; /* of a sheet: a line of its title, of a name or of a mark;
                   edge_class is 0 too */
} recto_stroke;

/* How many strokes the drawing has, in drawing order. */
size_t recto_drawing_stroke_count(const recto_drawing *drawing);

/* Fills in the stroke at `index`, whose points are owned by the drawing; past
 * the last returns false, and the stroke is empty. */
#define recto_drawing_stroke(drawing, index, stroke)                           \
  recto_drawing_stroke_sized((drawing), (index), (stroke), sizeof *(stroke))
bool recto_drawing_stroke_sized(const recto_drawing *drawing, size_t index,
                                recto_stroke *stroke, size_t size);

/* A part of an edge, which is visible all along or hidden by the same number of
 * faces all along.  This struct does not change. */
typedef struct recto_interval {
  double t0, t1; /* 0 at the edge's first point, 1 at its second, along the
                       edge in the scene; t0 < t1 */
  double from_mm[2], to_mm[2]; /* the ends on the page */
  uint32_t hidden_by; /* 0: visible; RECTO_NONE: hidden, and the number was not
                         requested or, by a raster method, is not known; else
                         the quantitative invisibility, the number of faces in
                         front */
} recto_interval;

/* An edge of the requested classes: of the mesh, of a polyline, or the line in
 * which two faces pierce each other. */
typedef struct recto_edge {
  recto_edge_class edge_class;
  uint32_t points[2]; /* points of the scene, in the order in which they were
                         read or added, and those that welding made one by the
                         first of them; RECTO_NONE: of an intersection, of a
                         diagonal along which a warped polygon folds, of a
                         polyline of more than 65536 points, or where a cut
                         made it */
  uint32_t faces[2];  /* RECTO_NONE: there is none, or it is a cut face */
  uint32_t group;     /* of the first face, or of the polyline */
  uint32_t number;    /* that strokes have as `edge`: of the mesh edge, or for
                      the class wire of the polyline; RECTO_NONE: none */
  /* The parts on the page, ascending and adjacent; owned by the drawing. */
  const recto_interval *intervals;
  size_t interval_count;
} recto_edge;

/* How many edges there are; 0 where the options' results are without
 * RECTO_RESULT_EDGES. */
size_t recto_drawing_edge_count(const recto_drawing *drawing);

/* Fills in the edge at `index`; past the last returns false, and the edge is
 * empty.  The parameters are as exact as the page grid of 2^-20 mm allows; for
 * an intersection they run along the line on the page. */
#define recto_drawing_edge(drawing, index, edge)                               \
  recto_drawing_edge_sized((drawing), (index), (edge), sizeof *(edge))
bool recto_drawing_edge_sized(const recto_drawing *drawing, size_t index,
                              recto_edge *edge, size_t size);

/* ---- Visible faces -------------------------------------------------------
 * The visible part of a face is one fragment or several, polygons that may have
 * holes.  All fragments together are a planar subdivision of the page: where
 * two of them meet, a side of one and a side of the other run along each other,
 * as two half-edges that are twins.  A side beside which several neighbours lie
 * is several half-edges.  Source: de Berg et al., Computational Geometry, ch. 2
 * (doubly connected edge list). */

/* A connected visible part of one face. */
typedef struct recto_fragment {
  uint32_t face, group; /* as of strokes; face RECTO_NONE: a cut face */
  uint32_t colour;      /* of its group, 0xRRGGBB: as RECTO_FILL_PAINT fills */
  double brightness;    /* by the options' light, to 1: as RECTO_FILL_SHADE */
  bool is_back;         /* the face is seen from its back: clockwise */
  uint32_t loop, loop_count; /* of recto_drawing_loops; the first is the outer
                                one, the others are holes */
} recto_fragment;

/* A closed boundary of a fragment, which is on its left: the outer one runs
 * counter-clockwise, holes clockwise.  This struct does not change. */
typedef struct recto_loop {
  uint32_t half_edge, count; /* consecutive ones of recto_drawing_half_edges;
                                each ends where the next one starts */
  bool is_hole;
} recto_loop;

/* What a side of a fragment is. */
typedef enum recto_side {
  RECTO_SIDE_EDGE = 0,     /* a part of the face's own edge */
  RECTO_SIDE_OCCLUDER,     /* a part of an edge of a nearer face: its contour */
  RECTO_SIDE_INTERSECTION, /* where another face pierces this one */
  RECTO_SIDE_CLIP          /* the page's margins or the near plane; also where
                              a method with scan lines or pixels divides a
                              face */
} recto_side;

/* A side of a fragment, or the part of it that one neighbour lies beside.  This
 * struct does not change. */
typedef struct recto_half_edge {
  double x_mm, y_mm; /* where it starts; exact to 2^-28 mm */
  uint32_t fragment; /* on its left */
  uint32_t twin;     /* the half-edge of the neighbour, which runs the other way
                        between the same points, to 2^-28 mm each; RECTO_NONE:
                        there is no visible face beside it */
  recto_side side;
  recto_edge_class edge_class; /* of the edge that it is a part of, whether that
                                  class was requested or not; 0 for a clip */
  uint32_t edge; /* the number that strokes have as `edge`; RECTO_NONE: none */
} recto_half_edge;

/* How many fragments there are; 0 where the options' results are without
 * RECTO_RESULT_FACES, or the method makes none. */
size_t recto_drawing_fragment_count(const recto_drawing *drawing);

/* Fills in the fragment at `index`; past the last returns false, and the
 * fragment is empty. */
#define recto_drawing_fragment(drawing, index, fragment)                       \
  recto_drawing_fragment_sized((drawing), (index), (fragment),                 \
                               sizeof *(fragment))
bool recto_drawing_fragment_sized(const recto_drawing *drawing, size_t index,
                                  recto_fragment *fragment, size_t size);

/* All loops and half-edges, arrays of *count owned by the drawing; NULL and 0
 * where there are none. */
const recto_loop *recto_drawing_loops(const recto_drawing *drawing,
                                      size_t *count);
const recto_half_edge *recto_drawing_half_edges(const recto_drawing *drawing,
                                                size_t *count);

/* Projects a point of the scene as the drawing was projected, a sheet as its
 * first view.
 * point    scene units
 * page_mm  where it lies on the page, which may be outside of it
 * depth    scene units along the view axis, growing away from the viewer: from
 *          the eye, or without perspective from the origin of the scene's
 *          coordinates; may be NULL
 * Returns false where the point is not in front of the eye. */
bool recto_drawing_project(const recto_drawing *drawing, const double point[3],
                           double page_mm[2], double *depth);

#if defined __GNUC__
#pragma GCC visibility pop
#endif

#ifdef __cplusplus
}
#endif

#endif
