/* multiview_labels.h - the words that name views and details of a sheet. */
#ifndef API_MULTIVIEW_LABELS_H
#define API_MULTIVIEW_LABELS_H

#include "api/multiview_layout.h"

/* Writes the labels of all views that are to have one: "FRONT", and where a
 * view has a true scale that is not the sheet's, "ISO (2:1)".  The room of a
 * label is never made smaller.
 * Returns whether any needs more room than before. */
bool multiview_labels_of_views(struct multiview *views);

/* Writes the label of a detail, whose scale is known: "A (2:1)", or where
 * scales are no true ones "A". */
void multiview_labels_of_detail(const struct multiview *views,
                                struct multiview_detail *detail);

/* The letter of a detail. */
const char *multiview_labels_letter(const struct multiview_detail *detail);

#endif
