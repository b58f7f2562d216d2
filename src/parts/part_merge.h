/* part_merge.h - all parts of a drawing as one. */
#ifndef PARTS_PART_MERGE_H
#define PARTS_PART_MERGE_H

#include "parts/part.h"

/* Checks that the parts are those of one drawing, each of them once.
 * path    of each, for messages
 * Errors  RECTO_ERROR_ARGUMENT: one is missing, there twice, or of another
 *         drawing: the error names its path, or its number */
USE_RESULT recto_status part_merge_check(const struct part *part,
                                         const char *const *path, size_t count,
                                         recto_error *error);

/* Merges parts that were so checked, and empties them.
 *   An edge in several parts is visible where each of them says so: what hides
 *     a point of it meets the window in which the point lies, and a part has
 *     all that meets its window.
 *   An intersection that a part with its window did not list, as it looks for
 *     those alone that may be visible, is hidden in that window.
 *   The fragments of a face are those of the part that owns it.
 * all     empty; gets the lists, and `common` of the first part
 * Errors  RECTO_ERROR_FORMAT: parts contradict each other: the error names a
 *         path; RECTO_ERROR_MEMORY, _CANCELLED */
USE_RESULT recto_status part_merge(struct part *all, struct part *part,
                                   const char *const *path, size_t count,
                                   recto_error *error);

#endif
