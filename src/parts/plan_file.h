/* plan_file.h - plans as files: what the parts of a drawing have in common, and
 * a section for each: doc/part-format.md. */
#ifndef PARTS_PLAN_FILE_H
#define PARTS_PLAN_FILE_H

#include "parts/part.h"
#include "parts/plan_section.h"

/* ---- Writing ------------------------------------------------------------- */

/* Where a section lies, and its sum. */
struct plan_place {
  uint64_t place, size, sum;
};

/* A plan that is written, section by section.  Zero-initialised is empty. */
struct plan_writer {
  struct plan_bytes bytes;
  struct plan_section_form form;
  ARRAY(struct plan_place) section;
};

/* Begins a plan. */
void plan_writer_begin(struct plan_writer *writer, struct stream *stream,
                       const struct part_common *common, recto_error *error);

/* Appends the section of the next window.
 * Errors  RECTO_ERROR_MEMORY; those of the stream are its own */
USE_RESULT recto_status plan_writer_add(struct plan_writer *writer,
                                        struct plan_section *section,
                                        recto_error *error);

/* Ends the plan: the stream is still to be finished.
 * weld    the length of struct plan
 * Errors  likewise */
USE_RESULT recto_status plan_writer_end(struct plan_writer *writer,
                                        struct part_common *common, double weld,
                                        recto_error *error);
void plan_writer_fini(struct plan_writer *writer);

/* ---- Reading ------------------------------------------------------------- */

/* A plan that is open: what the parts have in common.  Zero-initialised is
 * closed. */
struct plan {
  struct file_reader reader;
  const char *path;
  struct part_common common;
  double weld; /* the most that welding could join, scene units */
  ARRAY(struct plan_place) section;
};

/* Opens a plan; its bytes may be hostile.
 * path    must outlive it
 * Errors  RECTO_ERROR_IO; RECTO_ERROR_FORMAT: it is no plan, cut short or
 *         damaged; RECTO_ERROR_UNSUPPORTED: of another version;
 *         RECTO_ERROR_MEMORY; end with plan_close either way */
USE_RESULT recto_status plan_open(struct plan *plan, const char *path,
                                  recto_error *error);

/* Reads the section of a window, from 0.
 * Errors  as of plan_section_read */
USE_RESULT recto_status plan_read_section(const struct plan *plan,
                                          uint32_t index,
                                          struct plan_section *section,
                                          recto_error *error);
void plan_close(struct plan *plan);

#endif
