/* message.c - messages for the user, on standard error.
 *
 * Names of files and words of the command line may hold anything: sequences
 * that clear a terminal or retype a command, a newline with a forged message
 * behind it, characters that turn the direction of the text. */
#include "cli/message.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "cli/progress_bar.h"

/* ---- A line, written in one piece ---------------------------------------- */

struct message_line {
  char text[4096];
  size_t length;
};

static void flush_line(struct message_line *line) {
  (void)!fwrite(line->text, 1, line->length, stderr);
  line->length = 0;
}

static void add_bytes(struct message_line *line, const char *bytes,
                      size_t count) {
  if (count > sizeof line->text - line->length)
    flush_line(line);
  memcpy(line->text + line->length, bytes, count);
  line->length += count;
}

/* ---- Characters ---------------------------------------------------------- */

/* The bytes of the UTF-8 character at `text`, which ends in a NUL, and in
 * *code its number; 0 where there is none. */
static size_t read_character(const unsigned char *text, uint32_t *code) {
  static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  size_t length = text[0] < 0x80             ? 1
                  : (text[0] & 0xe0) == 0xc0 ? 2
                  : (text[0] & 0xf0) == 0xe0 ? 3
                  : (text[0] & 0xf8) == 0xf0 ? 4
                                             : 0;
  *code = length == 1 ? text[0] : text[0] & (0x7fu >> length);
  for (size_t i = 1; i < length; i++) {
    if ((text[i] & 0xc0) != 0x80)
      return 0;
    *code = *code << 6 | (text[i] & 0x3f);
  }
  return length > 0 && *code >= least[length] ? length : 0;
}

/* Control characters, also those from 0x80 on; separators of lines; and what
 * turns the direction of the text around it. */
static bool is_control(uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) ||
         (code >= 0x2028 && code <= 0x202e) ||
         (code >= 0x2066 && code <= 0x2069);
}

static void put_escaped(struct message_line *line, unsigned char byte) {
  char escape[5];
  int length = byte == '\n'   ? snprintf(escape, sizeof escape, "\\n")
               : byte == '\t' ? snprintf(escape, sizeof escape, "\\t")
                              : snprintf(escape, sizeof escape, "\\%03o", byte);
  add_bytes(line, escape, (size_t)length);
}

static void put_escaped_text(struct message_line *line, const char *text) {
  while (*text != '\0') {
    const unsigned char *at = (const unsigned char *)text;
    uint32_t code;
    size_t length = read_character(at, &code);
    if (length > 0 && !is_control(code)) {
      add_bytes(line, text, length);
    } else {
      length = length > 0 ? length : 1;
      for (size_t i = 0; i < length; i++)
        put_escaped(line, at[i]);
    }
    text += length;
  }
}

void message_print(const char *file, unsigned long line, const char *text) {
  struct message_line whole = {.length = 0};
  char number[32];
  add_bytes(&whole, "recto: ", 7);
  put_escaped_text(&whole, file);
  if (file[0] != '\0')
    add_bytes(&whole, ":", 1);
  if (line != 0)
    add_bytes(&whole, number,
              (size_t)snprintf(number, sizeof number, "%lu:", line));
  if (file[0] != '\0' || line != 0)
    add_bytes(&whole, " ", 1);
  put_escaped_text(&whole, text);
  add_bytes(&whole, "\n", 1);
  progress_bar_hide();
  flush_line(&whole);
  progress_bar_show();
}
