/* xml_tags.c - the start tags of an XML document, and their attributes. */
#include "import/xml_tags.h"

#include <stdint.h>
#include <string.h>

/* ---- Tags ---------------------------------------------------------------- */

/* Whether what is skipped ends with c. */
static bool is_past_end(struct xml_tags *tags, char c) {
  const char *end = tags->state == XML_COMMENT ? "--"
                    : tags->state == XML_CDATA ? "]]"
                                               : "?";
  size_t most = strlen(end);
  if (c == '>' && tags->length == most)
    return true;
  tags->length = c != end[0]           ? 0
                 : tags->length < most ? tags->length + 1
                                       : most;
  return false;
}

/* Passes a tag on that has come to its end. */
static bool end_tag(struct xml_tags *tags) {
  size_t length = tags->length;
  tags->state = XML_TEXT;
  tags->length = 0;
  if (length == 0 || length > XML_TAG_MAX || tags->tag[0] == '/' ||
      tags->tag[0] == '!')
    return true;
  tags->tag[length] = '\0';
  return tags->take(tags->user, tags->tag);
}

/* Whether the tag so far is these characters. */
static bool is_so_far(const struct xml_tags *tags, const char *text) {
  return tags->length == strlen(text) &&
         memcmp(tags->tag, text, tags->length) == 0;
}

/* Adds a character to a tag. */
static bool add_to_tag(struct xml_tags *tags, char c) {
  if (c == '>' && tags->quote == 0)
    return end_tag(tags);
  if (tags->quote == c)
    tags->quote = 0;
  else if (tags->quote == 0 && (c == '"' || c == '\''))
    tags->quote = c;
  if (tags->length < XML_TAG_MAX)
    tags->tag[tags->length++] = c;
  else
    tags->length = XML_TAG_MAX + 1;
  if (is_so_far(tags, "?"))
    tags->state = XML_INSTRUCTION;
  else if (is_so_far(tags, "!--"))
    tags->state = XML_COMMENT;
  else if (is_so_far(tags, "![CDATA["))
    tags->state = XML_CDATA;
  if (tags->state != XML_TAG)
    tags->length = 0;
  return true;
}

bool xml_tags_read(struct xml_tags *tags, const char *bytes, size_t count) {
  bool goes_on = true;
  for (size_t i = 0; i < count && goes_on; i++) {
    if (tags->state == XML_TEXT) {
      const char *begin = memchr(bytes + i, '<', count - i);
      if (begin == NULL)
        return true;
      i = (size_t)(begin - bytes);
      tags->state = XML_TAG;
      tags->length = 0;
      tags->quote = 0;
    } else if (tags->state == XML_TAG) {
      goes_on = add_to_tag(tags, bytes[i]);
    } else if (is_past_end(tags, bytes[i])) {
      tags->state = XML_TEXT;
    }
  }
  return goes_on;
}

/* ---- Attributes ---------------------------------------------------------- */

static const char space[] = " \t\r\n";

const char *xml_tag_name(const char *tag, size_t *length) {
  size_t all = strcspn(tag, " \t\r\n/");
  const char *colon = memchr(tag, ':', all);
  const char *name = colon != NULL ? colon + 1 : tag;
  *length = all - (size_t)(name - tag);
  return name;
}

const char *xml_attribute(const char *tag, const char *name, size_t *length) {
  const char *at = tag + strcspn(tag, space);
  for (;;) {
    at += strspn(at, space);
    size_t size = strcspn(at, " \t\r\n=");
    bool is_it = size == strlen(name) && memcmp(at, name, size) == 0;
    at += size;
    at += strspn(at, space);
    if (*at != '=')
      return NULL;
    at++;
    at += strspn(at, space);
    const char *end = *at == '"' || *at == '\'' ? strchr(at + 1, *at) : NULL;
    if (end == NULL)
      return NULL;
    *length = (size_t)(end - at) - 1;
    if (is_it)
      return at + 1;
    at = end + 1;
  }
}

/* Writes a character as UTF-8, and returns its length; 0 where it is none. */
static size_t put_character(uint32_t code, char *to) {
  size_t size = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
  static const unsigned char lead[] = {0, 0, 0xc0, 0xe0, 0xf0};
  if (code == 0 || code > 0x10ffff || (code >= 0xd800 && code < 0xe000))
    return 0;
  for (size_t i = size - 1; i > 0; i--, code >>= 6)
    to[i] = (char)(0x80 | (code & 0x3f));
  to[0] = (char)(lead[size] | code);
  return size;
}

/* The character of a reference without & and ;, which is at most 8 long; 0:
 * it names none. */
static uint32_t character_of(const char *text, size_t length) {
  static const struct {
    const char *name;
    char character;
  } known[] = {
      {"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}};
  static const char digits[] = "0123456789abcdef";
  for (size_t i = 0; i < sizeof known / sizeof *known; i++)
    if (strlen(known[i].name) == length &&
        memcmp(known[i].name, text, length) == 0)
      return (uint32_t)known[i].character;
  bool is_hexadecimal = length > 1 && text[1] == 'x';
  size_t first = is_hexadecimal ? 2 : 1, base = is_hexadecimal ? 16 : 10;
  uint32_t code = 0;
  if (length <= first || text[0] != '#')
    return 0;
  for (size_t i = first; i < length; i++) {
    char c = (char)(text[i] >= 'A' && text[i] <= 'F' ? text[i] + 32 : text[i]);
    const char *digit = memchr(digits, c, base);
    if (digit == NULL)
      return 0;
    code = (uint32_t)base * code + (uint32_t)(digit - digits);
  }
  return code;
}

void xml_expand(const char *value, size_t length, char *to) {
  enum { REFERENCE_MAX = 8 };
  for (size_t i = 0; i < length;) {
    const char *end =
        value[i] == '&' ? memchr(value + i, ';', length - i) : NULL;
    size_t size = end != NULL ? (size_t)(end - value) - i - 1 : 0;
    uint32_t code = size > 0 && size <= REFERENCE_MAX
                        ? character_of(value + i + 1, size)
                        : 0;
    size_t written = put_character(code, to);
    if (written > 0) {
      i += size + 2;
      to += written;
    } else {
      /* White space of a value counts as spaces. */
      *to++ = strchr(space, value[i]) != NULL ? ' ' : value[i];
      i++;
    }
  }
  *to = '\0';
}
