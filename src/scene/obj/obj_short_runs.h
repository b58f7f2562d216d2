/* obj_short_runs.h - short runs of points and faces that take turns, read by
 * several threads. */
#ifndef SCENE_OBJ_OBJ_SHORT_RUNS_H
#define SCENE_OBJ_OBJ_SHORT_RUNS_H

#include "scene/obj/obj_parser.h"

/* Reads what follows in a file of blocks for as long as it is plain points,
 * normals, faces of any number of corners, names and smoothing groups: all or
 * nothing of it, with the same result as obj_read_statements.  To be called at
 * the start of a block. */
USE_RESULT recto_status obj_read_short_runs(struct obj_parser *p);

#endif
