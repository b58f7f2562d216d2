/* svg_text.c - text in SVG: escaped, as colours, and as ids. */
#include "backends/svg_text.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "base/hash.h"
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

static inline bool is_letter_or_digit(unsigned char c) {
  return (unsigned char)((c | 0x20) - 'a') < 26 ||
         (unsigned char)(c - '0') < 10;
}

/* Copies a name with underlines in place of what no id holds; returns how many
 * bytes it has then. */
static size_t copy_name(char *to, const char *name) {
  char *start = to;
  while (*name != '\0') {
    if (is_letter_or_digit((unsigned char)*name)) {
      *to++ = *name++;
      continue;
    }
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
  return (size_t)(to - start);
}

static int compare_group_ids(const void *first, const void *second,
                             void *user) {
  char *const *id = user;
  uint32_t a = *(const uint32_t *)first, b = *(const uint32_t *)second;
  return strcmp(id[a], id[b]);
}

/* What makes equal ids different takes so many bytes. */
enum { SUFFIX_SIZE = 64 };

/* Sorts the groups of a list by their ids. */
static bool sort_by_ids(char **id, uint32_t *order, size_t count) {
  return sort_stable(order, count, sizeof *order, compare_group_ids, id);
}

/* Appends a point and the hash of its name to each of equal ids, unless it is
 * the name itself. */
static void append_hashes(char *const *name, char **id, const uint32_t *order,
                          size_t count) {
  for (size_t i = 0, end; i < count; i = end) {
    for (end = i + 1; end < count && strcmp(id[order[end]], id[order[i]]) == 0;)
      end++;
    for (size_t k = i; end - i > 1 && k < end; k++) {
      char *at = id[order[k]];
      const char *whole = name[order[k]];
      if (strcmp(at, whole) != 0)
        (void)snprintf(at + strlen(at), SUFFIX_SIZE / 2, ".%08" PRIx32,
                       (uint32_t)hash_text(whole, strlen(whole)));
    }
  }
}

/* Appends a point and a number to all but the first of equal ids. */
static void append_numbers(char **id, const uint32_t *order, size_t count) {
  for (size_t i = 1, first = 0, equal = 1; i < count; i++) {
    char *at = id[order[i]];
    if (strcmp(at, id[order[first]]) != 0) {
      first = i;
      equal = 1;
    } else {
      (void)snprintf(at + strlen(at), SUFFIX_SIZE / 2, ".%zu", ++equal);
    }
  }
}

/* Makes the ids of listed groups differ.  Numbers, which depend on the order of
 * the groups, are left for equal names and for equal hashes. */
static bool tell_apart(struct svg_ids *ids, char *const *name, uint32_t *order,
                       size_t count) {
  for (size_t i = 0; i < count; i++) {
    const char *clean = ids->id[order[i]];
    size_t size = strlen(clean) + 1;
    char *longer = arena_alloc(&ids->text, size + SUFFIX_SIZE, 1);
    if (longer == NULL)
      return false;
    memcpy(longer, clean, size);
    ids->id[order[i]] = longer;
  }
  if (!sort_by_ids(ids->id, order, count))
    return false;
  append_hashes(name, ids->id, order, count);
  if (!sort_by_ids(ids->id, order, count))
    return false;
  append_numbers(ids->id, order, count);
  return true;
}

/* Lists the groups whose ids may be alike, as their hashes are: most often
 * none.
 * hash   sorted
 * order  gets them, ascending */
static bool list_alike(const struct sort_key *hash, size_t count,
                       uint32_t *order, size_t *alike) {
  *alike = 0;
  for (size_t i = 0; i < count; i++)
    if ((i > 0 && hash[i].key == hash[i - 1].key) ||
        (i + 1 < count && hash[i].key == hash[i + 1].key))
      order[(*alike)++] = hash[i].value;
  return sort_ids(order, *alike);
}

/* Writes the clean names of groups, and lists their hashes. */
static bool clean_names(struct svg_ids *ids, char *const *name, size_t count,
                        struct sort_key *hash, size_t *named) {
  *named = 0;
  for (size_t i = 0; i < count; i++) {
    if (name[i] == NULL || *name[i] == '\0')
      continue;
    char *id = arena_alloc(&ids->text, strlen(name[i]) + 1, 1);
    if (id == NULL)
      return false;
    uint64_t key = hash_text(id, copy_name(id, name[i]));
    hash[(*named)++] = (struct sort_key){(uint32_t)key, (uint32_t)i};
    ids->id[i] = id;
  }
  return true;
}

bool svg_ids_init(struct svg_ids *ids, char *const *name, size_t count) {
  *ids = (struct svg_ids){.id = mem_calloc(count, sizeof *ids->id)};
  struct sort_key *hash = mem_alloc(count, sizeof *hash);
  uint32_t *order = mem_alloc(count, sizeof *order);
  size_t named, alike;
  bool ok = ids->id != NULL && hash != NULL && order != NULL &&
            clean_names(ids, name, count, hash, &named) &&
            sort_keys_alone(hash, named) &&
            list_alike(hash, named, order, &alike) &&
            tell_apart(ids, name, order, alike);
  mem_free(hash);
  mem_free(order);
  return ok;
}

void svg_ids_fini(struct svg_ids *ids) {
  mem_free(ids->id);
  arena_fini(&ids->text);
  *ids = (struct svg_ids){.id = NULL};
}
