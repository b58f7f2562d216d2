/* report.h - counts, times and choices gathered for --stats, as JSON. */
#ifndef BASE_REPORT_H
#define BASE_REPORT_H

#include <stddef.h>
#include <stdint.h>

/* Entries in order of first mention; a later one of the same name replaces
 * the value (report_add: adds to it).  Names are string literals, "section"
 * and "name": the JSON is { "section": { "name": value, ... }, ... }.
 * All functions accept a NULL report and then do nothing.  Running out of
 * memory loses entries, never the drawing. */
struct report;

struct report *report_create(void);
void report_destroy(struct report *report);

/* What several threads do with one report stands between these. */
void report_lock(struct report *report);
void report_unlock(struct report *report);

void report_int(struct report *report, const char *section, const char *name,
                int64_t value);
void report_count(struct report *report, const char *section, const char *name,
                  uint64_t count);
void report_add(struct report *report, const char *section, const char *name,
                uint64_t count);
void report_double(struct report *report, const char *section, const char *name,
                   double value);
void report_doubles(struct report *report, const char *section,
                    const char *name, const double *value, size_t count);
void report_text(struct report *report, const char *section, const char *name,
                 const char *value);

/* Makes a report, which may be NULL, an entry of another one, which owns it
 * from then on. */
void report_adopt(struct report *report, const char *section, const char *name,
                  struct report *part);

/* Looks an integer up; `otherwise` where it is not there. */
int64_t report_get(const struct report *report, const char *section,
                   const char *name, int64_t otherwise);

/* The report as JSON, two-space indented, ending in a newline; borrowed
 * until the report changes.  NULL when memory ran out. */
const char *report_json(struct report *report);

#endif
