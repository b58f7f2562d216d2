/* clip_warning.h - says what the page's margins cut away, and what helps. */
#ifndef API_CLIP_WARNING_H
#define API_CLIP_WARNING_H

#include "base/report.h"
#include "view/page_overflow.h"

/* Warns, once, where lines that were asked for or, with fills, faces leave the
 * page inside its margins.
 * faces      that do; 0 where none is filled
 * margin_mm  as it is, whatever the options leave open */
void clipped_warn(const struct page_overflow *overflow, uint64_t faces,
                  double margin_mm, const recto_options *options);

/* The same in numbers. */
void clipped_report(const struct page_overflow *overflow,
                    struct report *report);

#endif
