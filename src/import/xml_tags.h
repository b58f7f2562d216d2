/* xml_tags.h - the start tags of an XML document, and their attributes.
 *
 * This is no parser of XML: it finds tags in well-formed documents and does no
 * harm with others.  Comments, CDATA sections, processing instructions, end
 * tags and text are skipped, and tags of more than XML_TAG_MAX bytes. */
#ifndef IMPORT_XML_TAGS_H
#define IMPORT_XML_TAGS_H

#include <stdbool.h>
#include <stddef.h>

enum { XML_TAG_MAX = 1 << 14 };

/* Takes a start tag without its angle brackets, NUL-terminated; returns false
 * where it needs no more. */
typedef bool xml_take_tag(void *user, const char *tag);

/* The state between two blocks of a document; but for the first two fields
 * zero-initialised at its beginning. */
struct xml_tags {
  xml_take_tag *take;
  void *user;
  enum { XML_TEXT, XML_TAG, XML_COMMENT, XML_CDATA, XML_INSTRUCTION } state;
  char quote;    /* within the value of an attribute: what ends it; else 0 */
  size_t length; /* of the tag so far; else how much of its end was found */
  char tag[XML_TAG_MAX + 1];
};

/* Reads the next block; returns false where no more is wanted. */
bool xml_tags_read(struct xml_tags *tags, const char *bytes, size_t count);

/* The name of a tag's element without its prefix; its length goes to
 * *length. */
const char *xml_tag_name(const char *tag, size_t *length);

/* The value of the tag's attribute of that name, as it is written there; NULL
 * where it has none. */
const char *xml_attribute(const char *tag, const char *name, size_t *length);

/* Writes a value with its references to characters replaced, UTF-8 and
 * NUL-terminated, to `to`, which has room for one byte more than the value. */
void xml_expand(const char *value, size_t length, char *to);

#endif
