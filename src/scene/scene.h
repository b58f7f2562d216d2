/* scene.h - the input: points, faces, polylines and groups.
 *
 * Invariants (scene_add_* keep them, everything after relies on them)
 *   points are finite; corner indices are in range; a face has at least three
 *   corners, no two neighbouring ones equal in position; a polyline has at
 *   least two points.  A face need not be planar. */
#ifndef SCENE_SCENE_H
#define SCENE_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/input.h"
#include "base/memory.h"
#include "base/status.h"
#include "scene/precision.h"
#include "scene/smoothing.h"

#define SCENE_NONE UINT32_MAX

struct scene_point {
  double x, y, z; /* scene units */
};

struct scene_group {
  char *name;      /* owned, UTF-8 as it was in the file */
  uint32_t colour; /* 0xRRGGBB */
  bool has_colour;
  /* One of the colours of a surface: where it meets another such group there
   * is no line. */
  bool is_shade;
  bool is_nameless; /* what has no name, called as its file or "default" */
};

/* What a cut made of a scene. */
struct scene_cut {
  uint32_t first_point;  /* this point, and those after it, lie in planes */
  uint32_t first_face;   /* this face, and those after it, are cut faces */
  const uint8_t *planes; /* of the points from the first one on: the planes in
                            which they lie, a bit each */
  const uint32_t *face;  /* of the faces before the first: in the scene that was
                            cut */
  const uint32_t *wire;  /* of the polylines: likewise */
  const uint64_t *edge;  /* where surfaces were cut: keys of their two points,
                            ascending; edges in a plane that are not among them
                            lie within cut faces */
  size_t edges;
  const uint64_t *inner; /* along which parts of faces meet, and nothing else
                            does: likewise */
  size_t inners;
};

struct scene {
  ARRAY(struct scene_point) point;
  /* Face f has corners corner[s(f) .. s(f + 1)), indices of points, in the
   * file's order: s is scene_face_start.  What most scenes have in common is
   * not stored: face_start has one more item than there are faces, or none
   * where all faces are triangles, and face_group one a face, or none where all
   * are of group 0. */
  uint32_t face_count;
  ARRAY(uint32_t) face_start;
  ARRAY(uint32_t) corner;
  ARRAY(uint32_t) face_group;
  /* For each face that was skipped, how many there were before it;
   * ascending. */
  ARRAY(uint32_t) face_skipped;
  /* Polyline w likewise. */
  ARRAY(uint32_t) wire_start;
  ARRAY(uint32_t) wire_corner;
  ARRAY(uint32_t) wire_group;
  /* How exact the points are, one range a file, ascending; points before the
   * first range were added without a stated precision. */
  ARRAY(struct precision_range) precision;
  ARRAY(struct scene_group) group; /* group 0 is there once anything is */
  uint32_t current_group;          /* what scene_add_* add to */
  uint32_t *group_slot;            /* finds groups by name: see scene.c */
  size_t group_slot_count;
  /* While a file is read: its name without folder and extension, lent, and how
   * many groups there were before. */
  const char *file_stem;
  size_t file_stem_length, groups_before_file;
  double file_unit_mm; /* of a unit, as the file says; 0: it does not */
  double up[3];        /* what is up in the first file */
  bool up_is_stated;   /* by that file or its format; else it is likely */
  double unit_mm;      /* of a unit, to which all files were converted; 0: none
                         states one, or they differ and were not converted */
  bool keeps_unit, keeps_up;  /* what is read is not converted */
  ARRAY(char *) without_unit; /* paths of files that state no unit, owned;
                                  none once another one does */
  bool needs_colours; /* readers look for colours of groups in other files */
  /* What files say of hard and smooth edges, if readers are to note it; the
   * arrays end with the last element that has any. */
  bool needs_crease_marks;
  struct smoothing_groups smoothing; /* of faces */
  ARRAY(uint32_t) point_normal;  /* one a point, where corner_normal ends: see
                                    corner_normals.h */
  ARRAY(uint32_t) corner_normal; /* one a corner */
  size_t first_file_corner;      /* of the file that is read */
  bool has_file_normals;         /* it has normals so far, */
  bool lists_normals;            /* and one a corner */
  bool is_read_in_passes;        /* its faces are not kept: */
  bool has_several_normals;      /* a point of it has */
  const struct scene_cut *cut;   /* NULL: it was not cut */
  ARRAY(struct file_identity) file; /* what it was read from */
};

void scene_init(struct scene *scene);
void scene_fini(struct scene *scene);

static inline uint32_t scene_face_count(const struct scene *scene) {
  return scene->face_count;
}
static inline uint32_t scene_wire_count(const struct scene *scene) {
  return (uint32_t)scene->wire_group.count;
}

/* Where the corners of a face begin; of the number of all faces, where those of
 * the last end. */
static inline uint32_t scene_face_start(const struct scene *scene,
                                        uint32_t face) {
  return scene->face_start.count > 0 ? scene->face_start.item[face] : 3 * face;
}

static inline uint32_t scene_face_corners(const struct scene *scene,
                                          uint32_t face) {
  return scene_face_start(scene, face + 1) - scene_face_start(scene, face);
}

static inline uint32_t scene_face_group(const struct scene *scene,
                                        uint32_t face) {
  return scene->face_group.count > 0 ? scene->face_group.item[face] : 0;
}

/* The corner after one of a face's, around the face. */
static inline uint32_t scene_next_corner(const struct scene *scene,
                                         uint32_t face, uint32_t corner) {
  return corner + 1 < scene_face_start(scene, face + 1)
             ? corner + 1
             : scene_face_start(scene, face);
}

static inline bool scene_is_cut_face(const struct scene *scene, uint32_t face) {
  return scene->cut != NULL && face >= scene->cut->first_face;
}

/* Whether there is a line of the class group where faces of the two meet. */
static inline bool scene_groups_differ(const struct scene *scene, uint32_t a,
                                       uint32_t b) {
  const struct scene_group *group = scene->group.item;
  return a != b && !(group[a].is_shade && group[b].is_shade);
}

/* Notes what was read, so that no output replaces it; false when memory ran
 * out. */
USE_RESULT bool scene_note_file(struct scene *scene, const struct input *input);

/* Forgets which files state no unit. */
void scene_clear_without_unit(struct scene *scene);

/* What is added up to scene_end_file is of a file, and in groups of its own:
 * where a group of another one has the name, this is "STEM/name", or has a
 * point and a number behind.  What has no name is called as the file.
 * stem  the file's name without folder and extension, `length` bytes that stay
 *       there; none: it has no name */
void scene_begin_file(struct scene *scene, const char *stem, size_t length);
void scene_end_file(struct scene *scene);

/* Makes the group of that name the current one, adding it where it is new.
 * name  of `length` bytes, need not be NUL-terminated; none: that of the file,
 *       else "default" */
USE_RESULT recto_status scene_use_group(struct scene *scene, const char *name,
                                        size_t length, recto_error *error);

/* ---- Adding elements -----------------------------------------------------
 * A bad element is skipped, reported and counted, never fatal. */
struct diagnostics;

/* Adds a face after the checks of enum scene_fault, but for planarity.  Corners
 * at the position of the one before them are left out.
 * corner  indices of points already in the scene, `count` of them
 * Returns RECTO_OK also for a skipped face; fails only on memory, or with
 *         RECTO_ERROR_LIMIT. */
USE_RESULT recto_status scene_add_face(struct scene *scene,
                                       const uint32_t *corner, size_t count,
                                       unsigned long line,
                                       struct diagnostics *diagnostics,
                                       recto_error *error);
/* Makes a face of the corners that were put behind those of the last face.
 * They are to be valid.  Returns false when memory ran out. */
USE_RESULT bool scene_end_face(struct scene *scene, uint32_t group);

/* Makes room for so many faces and corners that are added soon; false when
 * memory ran out. */
USE_RESULT bool scene_reserve_faces(struct scene *scene, size_t faces,
                                    size_t corners);

/* Stores the groups of faces, or where their corners begin, though all are of
 * group 0, or triangles; false when memory ran out. */
USE_RESULT bool scene_list_groups(struct scene *scene);
USE_RESULT bool scene_list_starts(struct scene *scene);

/* Removes the faces, polylines and what is known of skipped ones. */
void scene_drop_elements(struct scene *scene);

/* Records that a face of the source is not added, so that those after it keep
 * their numbers; scene_add_face does it for those that it skips.
 * Errors  RECTO_ERROR_MEMORY */
USE_RESULT recto_status scene_skip_face(struct scene *scene,
                                        recto_error *error);

/* The number of a face where those that were skipped are counted too: its place
 * in the files or calls that it comes from; SCENE_NONE: it is a cut face.
 * Cost  logarithmic in the number of skipped faces */
uint32_t scene_face_number(const struct scene *scene, uint32_t face);

/* Adds a polyline in the same way; it needs two points that differ. */
USE_RESULT recto_status scene_add_wire(struct scene *scene,
                                       const uint32_t *corner, size_t count,
                                       unsigned long line,
                                       struct diagnostics *diagnostics,
                                       recto_error *error);

/* ---- The precision of the coordinates ------------------------------------ */

/* States the precision of the points from `first` on, which are those of one
 * file and the scene's last; no range begins after `first`.
 * Errors  RECTO_ERROR_MEMORY */
USE_RESULT recto_status scene_state_precision(struct scene *scene, size_t first,
                                              struct precision precision,
                                              recto_error *error);

/* Begins a range of points whose precision is not stated, where the one before
 * was stated.
 * Errors  RECTO_ERROR_MEMORY */
USE_RESULT recto_status scene_leave_precision(struct scene *scene, size_t first,
                                              recto_error *error);

/* The precision of the points for which none is stated: that of `bits`, or for
 * 0 what the points themselves show: where all their coordinates are numbers of
 * single precision they were rounded to it; others are of double precision,
 * which counts as exact. */
struct precision scene_unstated_precision(const struct scene *scene, int bits);

/* The precision of one point.
 * unstated  of points that were added without a stated one */
struct precision scene_point_precision(const struct scene *scene,
                                       uint32_t point,
                                       struct precision unstated);

/* ---- Earlier states ------------------------------------------------------ */

struct scene_snapshot {
  size_t points, faces, skipped, corners, wires, wire_corners, precisions,
      groups;
  uint32_t current_group;
};

/* Records the sizes of the scene's arrays. */
void scene_snapshot(const struct scene *scene, struct scene_snapshot *before);

/* Removes everything that was added since. */
void scene_restore(struct scene *scene, const struct scene_snapshot *before);

#endif
