/* clip_warning.h - warns of lines and faces that the page's margins clip. */
#ifndef API_CLIP_WARNING_H
#define API_CLIP_WARNING_H

#include "base/report.h"
#include "view/page_overflow.h"

/* Issues one warning if requested lines or filled faces are clipped, and says
 * which options help.
 * faces      the number of clipped faces; 0 where faces are not filled
 * margin_mm  the margin used, also where the options have the default */
void clipped_warn(const struct page_overflow *overflow, uint64_t faces,
                  double margin_mm, const recto_options *options);

/* Stores the same as numbers in the report. */
void clipped_report(const struct page_overflow *overflow,
                    struct report *report);

#endif
