/* obj_parser.c - how the reader of OBJ passes over the ends of lines and over
 * what is broken. */
#include "scene/obj_parser.h"

#include "scene/diagnostics.h"

#include <string.h>

bool obj_pass_continuation(struct obj_parser *p, const char **at) {
  const char *q = *at + 1;
  if (*q == '\r')
    q++;
  if (*q != '\n')
    return false;
  p->line++;
  *at = q + 1;
  return true;
}

/* A comment is never continued: it may end in a path of one system. */
void obj_skip_line(struct obj_parser *p, bool may_continue) {
  for (;;) {
    const char *start = p->at;
    const char *stop = memchr(start, '\n', (size_t)(p->end - start));
    if (stop == NULL) {
      p->at = p->end;
      return;
    }
    p->line++;
    p->at = stop + 1;
    if (stop > start && stop[-1] == '\r')
      stop--;
    if (!may_continue || stop == start || stop[-1] != '\\' ||
        memchr(start, '#', (size_t)(stop - start)) != NULL)
      return;
  }
}

void obj_finish_statement(struct obj_parser *p) {
  if (*p->at == '\n') {
    p->at++;
    p->line++;
  } else {
    obj_skip_line(p, *p->at != '#');
  }
}

/* ---- What is broken ------------------------------------------------------ */

recto_status obj_check_text(struct obj_parser *p, const char *start,
                            unsigned long line) {
  for (; start < p->end && *start != '\n'; start++)
    if ((unsigned char)*start < ' ' && !is_blank(*start))
      return error_set(p->error, RECTO_ERROR_FORMAT, p->path, line,
                       "not text: a byte 0x%02x", (unsigned char)*start);
  return RECTO_OK;
}

recto_status obj_skip_broken(struct obj_parser *p, const char *start,
                             unsigned long line, const char *what) {
  if (memchr(start, '\n', (size_t)(p->end - start)) == NULL)
    return error_set(p->error, RECTO_ERROR_FORMAT, p->path, line,
                     "the file ends in the middle of a %s", what);
  recto_status status = obj_check_text(p, start, line);
  if (status != RECTO_OK)
    return status;
  diagnostics_fault(p->diagnostics, SCENE_FAULT_SYNTAX, line,
                    "%s that cannot be parsed, skipped", what);
  obj_skip_line(p, true);
  return RECTO_OK;
}
