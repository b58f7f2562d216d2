/* unit_3mf.h - the unit of a 3MF model, which Assimp does not tell. */
#ifndef IMPORT_UNIT_3MF_H
#define IMPORT_UNIT_3MF_H

#include <stddef.h>

/* The unit in mm that a 3MF file states, or 1 where it states none, as its
 * specification says; 0 where the bytes are no ZIP archive with a model that
 * can be read.
 * Source  3MF core specification 1.3, 3.4: the attribute unit of <model> */
double unit_3mf_mm(const char *bytes, size_t count);

#endif
