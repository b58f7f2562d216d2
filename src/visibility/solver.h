/* solver.h - the one interface of all visibility methods. */
#ifndef VISIBILITY_SOLVER_H
#define VISIBILITY_SOLVER_H

#include "base/report.h"
#include "visibility/map.h"

/* What a solver is to compute, and how; it computes nothing else. */
struct solver_request {
  bool edges;         /* visible intervals of the sheet's drawable edges */
  bool fragments;     /* visible fragments of its faces */
  bool hidden;        /* hidden parts of intersections will be drawn too */
  bool intersections; /* edges where faces pierce each other are found */
  int threads;        /* at least 1 */
  double pitch_mm;    /* watkins: distance of the scan lines */
  int resolution;     /* raster methods: lines of the page; 0: their default */
  int depth_bits;     /* z-buffers: 1 to 32; 0: float64 with ties decided
                         exactly */
  bool remove_backs;  /* raster methods: faces that run clockwise on the page
                         are left out (back-face culling) */
  bool divide_by_box; /* warnock: windows are split at bounding boxes of faces
                         rather than in the middle */
  int subpixels;      /* raster methods: K x K samples averaged per pixel; 0:
                         one sample */
  /* newell: so many of the tests A to D alone, and no face is split; 0: all,
   * and splitting.  No option sets it: the charts of doc/accuracy.md show by it
   * what each test adds. */
  int newell_tests;
  double short_gap; /* between visible parts of an edge that has very many:
                       grid units; no longer ones are closed (dense_edges.h) */
};

/* The request that options make of a solver: edges, fragments only where faces
 * are filled, one thread. */
struct solver_request solver_request_of(const recto_options *options);

/* The same for a whole drawing and its results; where lines are drawn as a pen
 * shows them, short gaps are closed. */
struct solver_request solver_request_to_draw(const recto_options *options);

struct solver {
  recto_method method;
  /* Solves `sheet`.  Where intersections are requested, their edges are
   * appended to the sheet's drawable ones (intersection.h).
   * map     initialised, empty
   * Errors  RECTO_ERROR_MEMORY, _CANCELLED, _LIMIT, _UNSUPPORTED. */
  recto_status (*solve)(struct sheet *sheet,
                        const struct solver_request *request, struct map *map,
                        struct report *report, recto_error *error);
};

/* Solves by one of them; what it makes does not depend on the method where that
 * is exact.  Errors as of `solve`. */
USE_RESULT recto_status solver_run(const struct solver *solver,
                                   struct sheet *sheet,
                                   const struct solver_request *request,
                                   struct map *map, struct report *report,
                                   recto_error *error);

extern const struct solver solver_brute;
extern const struct solver solver_newell;
extern const struct solver solver_warnock;
extern const struct solver solver_tiles;
extern const struct solver solver_painter;       /* faces sorted by centroid */
extern const struct solver solver_painter_given; /* faces in the file's order */
extern const struct solver solver_zbuffer;
extern const struct solver solver_scanline_zbuffer;
extern const struct solver solver_watkins; /* exact; approximate, on scan
                                              lines, where a pitch is given */

/* Chooses the cheapest exact method for this sheet and this request: what the
 * method "auto" uses.
 * why  gets the reason, a phrase for --stats */
const struct solver *solver_choose(const struct sheet *sheet,
                                   const struct solver_request *request,
                                   const char **why);

/* Whether the method is exact as the options are. */
bool solver_is_exact(const recto_options *options);

/* The solver of a method; NULL where there is none. */
const struct solver *solver_by_method(recto_method method);
/* All solvers in the order in which they are offered, ended by NULL. */
const struct solver *const *solvers(void);

#endif
