/* svg_text.c - text in SVG: escaped, as colours, and as ids. */
#include "backends/svg_text.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "base/hash.h"
#include "base/memory.h"
#include "base/sort.h"
#include "base/utf8.h"

void svg_write_text(struct stream *stream, const char *text) {
  for (const char *at = text; *at != '\0';) {
    size_t length = utf8_measure(at, NULL);
    switch (*at) {
    case '&':
      stream_text(stream, "&amp;");
      break;
    case '<':
      stream_text(stream, "&lt;");
      break;
    case '>':
      stream_text(stream, "&gt;");
      break;
    case '"':
      stream_text(stream, "&quot;");
      break;
    case '\t':
      stream_text(stream, "&#9;");
      break;
    case '\n':
      stream_text(stream, "&#10;");
      break;
    case '\r':
      stream_text(stream, "&#13;");
      break;
    default:
      if (length > 0)
        stream_write(stream, at, length);
      else
        stream_text(stream, "\xef\xbf\xbd");
    }
    at += length > 0 ? length : 1;
  }
}

void svg_write_colour(struct stream *stream, uint32_t colour) {
  static const char digit[] = "0123456789abcdef";
  char text[8] = "#";
  for (int i = 0; i < 6; i++)
    text[1 + i] = digit[colour >> (20 - 4 * i) & 0xf];
  stream_write(stream, text, 7);
}

/* ---- Ids ----------------------------------------------------------------- */

/* Whether a character may stand within an XML name, and is no point or colon:
 * these are left for what makes equal names different. */
static bool is_of_name(uint32_t code) {
  static const uint32_t range[][2] = {
      {'-', '-'},       {'0', '9'},        {'A', 'Z'},       {'_', '_'},
      {'a', 'z'},       {0xb7, 0xb7},      {0xc0, 0xd6},     {0xd8, 0xf6},
      {0xf8, 0x37d},    {0x37f, 0x1fff},   {0x200c, 0x200d}, {0x203f, 0x2040},
      {0x2070, 0x218f}, {0x2c00, 0x2fef},  {0x3001, 0xd7ff}, {0xf900, 0xfdcf},
      {0xfdf0, 0xfffd}, {0x10000, 0xeffff}};
  for (size_t i = 0; i < sizeof range / sizeof *range; i++)
    if (code >= range[i][0] && code <= range[i][1])
      return true;
  return false;
}

/* Copies a name with underlines in place of what no id holds. */
static void copy_name(char *to, const char *name) {
  while (*name != '\0') {
    uint32_t code = 0;
    size_t length = utf8_measure(name, &code);
    bool kept = length > 0 && is_of_name(code);
    if (kept)
      memcpy(to, name, length);
    else
      *to = '_';
    to += kept ? length : 1;
    name += length > 0 ? length : 1;
  }
  *to = '\0';
}

static int compare_group_ids(const void *first, const void *second,
                             void *user) {
  char *const *id = user;
  uint32_t a = *(const uint32_t *)first, b = *(const uint32_t *)second;
  return strcmp(id[a], id[b]);
}

/* What makes equal ids different takes so many bytes. */
enum { SUFFIX_SIZE = 64 };

/* Sets order to the groups with names, by their ids; returns how many. */
static size_t sort_by_ids(char **id, size_t count, uint32_t *order, bool *ok) {
  size_t named = 0;
  for (uint32_t i = 0; i < count; i++)
    if (id[i] != NULL)
      order[named++] = i;
  *ok = sort_stable(order, named, sizeof *order, compare_group_ids, id);
  return named;
}

/* Appends a point and the hash of its name to each of equal ids, unless it is
 * the name itself. */
static bool append_hashes(char *const *name, char **id, size_t count,
                          uint32_t *order) {
  bool ok;
  size_t named = sort_by_ids(id, count, order, &ok);
  for (size_t i = 0, end; ok && i < named; i = end) {
    for (end = i + 1; end < named && strcmp(id[order[end]], id[order[i]]) == 0;)
      end++;
    for (size_t k = i; end - i > 1 && k < end; k++) {
      char *at = id[order[k]];
      const char *whole = name[order[k]];
      if (strcmp(at, whole) != 0)
        (void)snprintf(at + strlen(at), SUFFIX_SIZE / 2, ".%08" PRIx32,
                       (uint32_t)hash_text(whole, strlen(whole)));
    }
  }
  return ok;
}

/* Appends a point and a number to all but the first of equal ids. */
static bool append_numbers(char **id, size_t count, uint32_t *order) {
  bool ok;
  size_t named = sort_by_ids(id, count, order, &ok), equal = 1;
  for (size_t i = 1, first = 0; ok && i < named; i++) {
    char *at = id[order[i]];
    if (strcmp(at, id[order[first]]) != 0) {
      first = i;
      equal = 1;
    } else {
      (void)snprintf(at + strlen(at), SUFFIX_SIZE / 2, ".%zu", ++equal);
    }
  }
  return ok;
}

/* Makes equal ids differ.  Numbers, which depend on the order of the groups,
 * are left for equal names and for equal hashes. */
static bool tell_apart(char *const *name, char **id, size_t count) {
  uint32_t *order = mem_alloc(count, sizeof *order);
  bool ok = order != NULL && append_hashes(name, id, count, order) &&
            append_numbers(id, count, order);
  mem_free(order);
  return ok;
}

char **svg_ids_make(char *const *name, size_t count) {
  char **id = mem_calloc(count, sizeof *id);
  bool ok = id != NULL;
  for (size_t i = 0; ok && i < count; i++) {
    if (name[i] == NULL || *name[i] == '\0')
      continue;
    id[i] = mem_alloc(strlen(name[i]) + SUFFIX_SIZE, 1);
    ok = id[i] != NULL;
    if (ok)
      copy_name(id[i], name[i]);
  }
  if (ok && tell_apart(name, id, count))
    return id;
  svg_ids_free(id, count);
  return NULL;
}

void svg_ids_free(char **id, size_t count) {
  for (size_t i = 0; id != NULL && i < count; i++)
    mem_free(id[i]);
  mem_free(id);
}
