/* solver.h - the one interface of all visibility methods. */
#ifndef VISIBILITY_SOLVER_H
#define VISIBILITY_SOLVER_H

#include "base/report.h"
#include "visibility/map.h"

/* What the caller wants; a solver does no more. */
struct solver_request {
  bool strokes;       /* intervals of the sheet's drawable edges */
  bool fragments;     /* visible fragments of its faces */
  bool areas;         /* with fragments: the exact places of their corners,
                         for tests of areas */
  bool hidden;        /* hidden parts of intersections will be drawn too */
  bool intersections; /* edges where faces pierce each other are drawable */
  int threads;        /* at least 1 */
  double pitch_mm;    /* watkins */
  int resolution;     /* raster methods: lines over the page; 0: their own */
  recto_progress_fn progress; /* NULL: none */
  void *user;
  int depth_bits;     /* z-buffers: 1 to 32; 0: float64, ties exact */
  bool remove_backs;  /* in pixels: faces that run clockwise are left out */
  bool divide_by_box; /* warnock: windows are cut at faces' boxes */
  bool no_coherence;  /* watkins: depth orders are not kept line to line */
  int subpixels;      /* in pixels: K x K averaged in each; 0: none */
};

struct solver {
  recto_method method;
  const char *name;
  bool exact; /* gives the visible map itself, not an approximation */
  /* Solves `sheet`.  Where intersections are asked for, their edges are
   * appended to the sheet's drawable ones (see intersection.h).
   * map  initialised, empty
   * Errors  RECTO_ERROR_MEMORY, _CANCELLED, _LIMIT, _UNSUPPORTED. */
  recto_status (*solve)(struct sheet *sheet,
                        const struct solver_request *request, struct map *map,
                        struct report *report, recto_error *error);
};

extern const struct solver solver_brute;
extern const struct solver solver_newell;
extern const struct solver solver_warnock;
extern const struct solver solver_tiles;
extern const struct solver solver_painter;       /* by centroid */
extern const struct solver solver_painter_given; /* the file's order */
extern const struct solver solver_zbuffer;
extern const struct solver solver_scanline_zbuffer;
extern const struct solver solver_watkins; /* at a pitch */

/* What auto takes: the least exact method for this sheet and this request.
 * why  a phrase for --stats */
const struct solver *solver_choose(const struct sheet *sheet,
                                   const struct solver_request *request,
                                   const char **why);

/* The solver of a method, or of its name; NULL where there is none. */
const struct solver *solver_by_method(recto_method method);
const struct solver *solver_by_name(const char *name);
/* All solvers, ended by NULL, in the order they are offered. */
const struct solver *const *solvers(void);

#endif
