/* handle.h - the structures behind the opaque handles of recto.h. */
#ifndef API_HANDLE_H
#define API_HANDLE_H

#include "api/preparation.h"
#include "api/verify.h"
#include "drawing/drawing.h"
#include "scene/diagnostics.h"
#include "scene/scene.h"

struct recto_scene {
  struct scene scene;
  unsigned long fault[SCENE_FAULT_COUNT]; /* of everything added so far */
  double read_cpu, read_wall;             /* seconds spent on reading files */
  char *path;   /* of the only file that was read; NULL: none or several were */
  char *format; /* of that file, as it was named; NULL: by extension */
  bool is_deferred; /* that file is to be read by parts, in passes */
  bool read_before; /* a file was read */
  struct preparation *prepared; /* recto_scene_prepare; NULL: not prepared */
};

/* Drops what was prepared, as the scene changes. */
void scene_drop_preparation(recto_scene *scene);

/* A drawable edge and its parts. */
struct result_edge {
  uint32_t point[2], face[2], group, number;
  recto_edge_class edge_class;
  uint32_t interval, count;
};

struct recto_drawing {
  struct drawing drawing;
  struct report *report; /* owned; NULL where memory ran out */
  double matrix[12];     /* 3 x 4, from scene units to homogeneous page mm */
  double depth[4];       /* 1 x 4, from scene units to the depth */
  char verdict[VERIFY_SUMMARY_SIZE]; /* "": not verified */
  struct verify_counts verified;
  ARRAY(struct result_edge) edge; /* RECTO_RESULT_EDGES */
  ARRAY(recto_interval) interval;
  ARRAY(recto_fragment) fragment; /* RECTO_RESULT_FACES */
  ARRAY(recto_loop) loop;
  ARRAY(recto_half_edge) half_edge;
  ARRAY(struct file_identity) file; /* that the scene was read from */
};

/* Adds the faults of elements that were added to those of the scene. */
void scene_add_faults(recto_scene *scene,
                      const struct diagnostics *diagnostics);

/* The drawing's report as JSON; the report is locked by the caller. */
const char *drawing_json(const recto_drawing *drawing);

#endif
