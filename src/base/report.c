/* report.c - counts, times and choices gathered for --stats, as JSON. */
#include "base/report.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

#include "base/memory.h"
#include "base/number.h"
#include "base/stream.h"

enum kind { KIND_INT, KIND_DOUBLE, KIND_DOUBLES, KIND_TEXT, KIND_REPORT };

struct report_entry {
  const char *section, *name; /* literals */
  enum kind kind;
  int64_t integer;
  double number;
  char *text;      /* KIND_TEXT: owned */
  double *numbers; /* KIND_DOUBLES: owned */
  size_t count;
  struct report *part; /* KIND_REPORT: owned */
};

struct report {
  ARRAY(struct report_entry) entry;
  struct stream *json; /* NULL until the first report_json */
  pthread_mutex_t lock;
};

struct report *report_create(void) {
  struct report *report = mem_calloc(1, sizeof *report);
  if (report != NULL && pthread_mutex_init(&report->lock, NULL) != 0) {
    mem_free(report);
    return NULL;
  }
  return report;
}

void report_lock(struct report *report) {
  if (report != NULL)
    (void)pthread_mutex_lock(&report->lock);
}

void report_unlock(struct report *report) {
  if (report != NULL)
    (void)pthread_mutex_unlock(&report->lock);
}

static void free_value(struct report_entry *entry) {
  mem_free(entry->text);
  mem_free(entry->numbers);
  report_destroy(entry->part);
  entry->text = NULL;
  entry->numbers = NULL;
  entry->part = NULL;
  entry->count = 0;
}

void report_destroy(struct report *report) {
  if (report == NULL)
    return;
  for (size_t i = 0; i < report->entry.count; i++)
    free_value(&report->entry.item[i]);
  ARRAY_FREE(&report->entry);
  stream_discard(report->json);
  (void)pthread_mutex_destroy(&report->lock);
  mem_free(report);
}

/* ---- Gathering ----------------------------------------------------------- */

static struct report_entry *find_report_entry(const struct report *report,
                                              const char *section,
                                              const char *name) {
  for (size_t i = 0; i < report->entry.count; i++) {
    struct report_entry *entry = &report->entry.item[i];
    if (strcmp(entry->section, section) == 0 && strcmp(entry->name, name) == 0)
      return entry;
  }
  return NULL;
}

/* The entry of that name without a value, added where it is new; NULL without
 * a report or memory. */
static struct report_entry *make_entry(struct report *report,
                                       const char *section, const char *name,
                                       enum kind kind) {
  if (report == NULL)
    return NULL;
  struct report_entry *entry = find_report_entry(report, section, name);
  if (entry == NULL) {
    struct report_entry fresh = {.section = section, .name = name};
    if (!ARRAY_PUSH(&report->entry, fresh))
      return NULL;
    entry = &report->entry.item[report->entry.count - 1];
  }
  free_value(entry);
  entry->kind = kind;
  return entry;
}

void report_int(struct report *report, const char *section, const char *name,
                int64_t value) {
  struct report_entry *entry = make_entry(report, section, name, KIND_INT);
  if (entry != NULL)
    entry->integer = value;
}

void report_count(struct report *report, const char *section, const char *name,
                  uint64_t count) {
  report_int(report, section, name, (int64_t)count);
}

void report_add(struct report *report, const char *section, const char *name,
                uint64_t count) {
  report_int(report, section, name,
             report_get(report, section, name, 0) + (int64_t)count);
}

void report_double(struct report *report, const char *section, const char *name,
                   double value) {
  struct report_entry *entry = make_entry(report, section, name, KIND_DOUBLE);
  if (entry != NULL)
    entry->number = value;
}

void report_doubles(struct report *report, const char *section,
                    const char *name, const double *value, size_t count) {
  struct report_entry *entry = make_entry(report, section, name, KIND_DOUBLES);
  if (entry == NULL)
    return;
  entry->numbers = mem_alloc(count, sizeof *value);
  if (entry->numbers == NULL)
    return;
  if (count)
    memcpy(entry->numbers, value, count * sizeof *value);
  entry->count = count;
}

void report_text(struct report *report, const char *section, const char *name,
                 const char *value) {
  struct report_entry *entry = make_entry(report, section, name, KIND_TEXT);
  if (entry == NULL)
    return;
  size_t size = strlen(value) + 1;
  entry->text = mem_alloc(size, 1);
  if (entry->text != NULL)
    memcpy(entry->text, value, size);
}

void report_adopt(struct report *report, const char *section, const char *name,
                  struct report *part) {
  struct report_entry *entry = make_entry(report, section, name, KIND_REPORT);
  if (entry != NULL)
    entry->part = part;
  else
    report_destroy(part);
}

int64_t report_get(const struct report *report, const char *section,
                   const char *name, int64_t otherwise) {
  const struct report_entry *entry =
      report != NULL ? find_report_entry(report, section, name) : NULL;
  return entry != NULL && entry->kind == KIND_INT ? entry->integer : otherwise;
}

/* ---- JSON ---------------------------------------------------------------- */

/* Whatever bytes a file name holds, the quotes close again. */
static void put_text(struct stream *stream, const char *text) {
  static const char hex[] = "0123456789abcdef";
  stream_text(stream, "\"");
  for (; *text; text++) {
    unsigned char c = (unsigned char)*text;
    if (c == '"' || c == '\\')
      stream_text(stream, "\\");
    if (c >= 0x20 && c != 0x7f) {
      stream_write(stream, text, 1);
      continue;
    }
    char escape[6] = {'\\', 'u', '0', '0', hex[c >> 4], hex[c & 15]};
    stream_write(stream, escape, sizeof escape);
  }
  stream_text(stream, "\"");
}

/* JSON cannot represent values that are not finite. */
static void put_double(struct stream *stream, double value) {
  char text[NUMBER_TEXT_SIZE] = "null";
  if (isfinite(value))
    number_format_exact(text, value);
  stream_text(stream, text);
}

static void put_doubles(struct stream *stream, const double *value,
                        size_t count) {
  stream_text(stream, "[");
  for (size_t i = 0; i < count; i++) {
    stream_text(stream, i ? ", " : "");
    put_double(stream, value[i]);
  }
  stream_text(stream, "]");
}

static void put_report(struct stream *stream, const struct report *report,
                       int indent);

static void put_line(struct stream *stream, const char *text, int indent) {
  stream_text(stream, text);
  stream_text(stream, "\n");
  for (int i = 0; i < indent; i++)
    stream_text(stream, " ");
}

/* indent  of the line that the entry is on */
static void put_entry(struct stream *stream, const struct report_entry *entry,
                      int indent) {
  put_text(stream, entry->name);
  stream_text(stream, ": ");
  switch (entry->kind) {
  case KIND_INT:
    stream_int(stream, entry->integer);
    break;
  case KIND_DOUBLE:
    put_double(stream, entry->number);
    break;
  case KIND_DOUBLES:
    put_doubles(stream, entry->numbers, entry->count);
    break;
  case KIND_TEXT:
    put_text(stream, entry->text != NULL ? entry->text : "");
    break;
  case KIND_REPORT:
    put_report(stream, entry->part, indent);
    break;
  }
}

/* The section that starts at entry `first`, with the entries of the same name
 * that follow anywhere. */
static void put_section(struct stream *stream, const struct report *report,
                        size_t first, int indent) {
  const char *section = report->entry.item[first].section;
  put_text(stream, section);
  stream_text(stream, ": {");
  for (size_t i = first; i < report->entry.count; i++) {
    const struct report_entry *entry = &report->entry.item[i];
    if (strcmp(entry->section, section) != 0)
      continue;
    put_line(stream, i > first ? "," : "", indent + 2);
    put_entry(stream, entry, indent + 2);
  }
  put_line(stream, "", indent);
  stream_text(stream, "}");
}

static bool is_first_of_section(const struct report *report, size_t index) {
  for (size_t i = 0; i < index; i++)
    if (strcmp(report->entry.item[i].section,
               report->entry.item[index].section) == 0)
      return false;
  return true;
}

/* Reports within reports are of sheets, whose views have none. */
static void put_report(struct stream *stream, const struct report *report,
                       int indent) {
  stream_text(stream, "{");
  for (size_t i = 0; report != NULL && i < report->entry.count; i++) {
    if (!is_first_of_section(report, i))
      continue;
    put_line(stream, i ? "," : "", indent + 2);
    put_section(stream, report, i, indent + 2);
  }
  if (report != NULL && report->entry.count > 0)
    put_line(stream, "", indent);
  stream_text(stream, "}");
}

const char *report_json(struct report *report) {
  if (report == NULL)
    return NULL;
  stream_discard(report->json);
  if (stream_open_memory(&report->json, NULL) != RECTO_OK)
    return NULL;
  put_report(report->json, report, 0);
  stream_text(report->json, "\n");
  size_t count;
  const char *text = stream_memory(report->json, &count);
  return stream_status(report->json) == RECTO_OK ? text : NULL;
}
