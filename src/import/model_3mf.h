/* model_3mf.h - what Assimp leaves out of a 3MF model: its unit and the
 * names of its objects. */
#ifndef IMPORT_MODEL_3MF_H
#define IMPORT_MODEL_3MF_H

#include <stddef.h>
#include <stdint.h>

#include "base/memory.h"

struct model_3mf_object {
  uint32_t id;
  char *name; /* owned, not "" */
};

struct model_3mf {
  /* In mm; 1 where the model states none, as the specification says; 0 where
   * the bytes are no ZIP archive with a model that can be read. */
  double unit_mm;
  ARRAY(struct model_3mf_object) object; /* those with a name, ascending */
  bool no_memory;                        /* for the names */
};

/* Reads the bytes of a 3MF file, which may be any.  Where several objects have
 * one name, a point and its id stand behind that of each.
 * Source  3MF core specification 1.3, 3.4: the attribute unit of <model>; 4.1:
 *         the attributes id and name of <object> */
void model_3mf_read(struct model_3mf *model, const char *bytes, size_t count);
void model_3mf_fini(struct model_3mf *model);

/* The name of an object; NULL where it has none. */
const char *model_3mf_name(const struct model_3mf *model, uint32_t id);

#endif
