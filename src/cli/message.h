/* message.h - messages for the user, on standard error. */
#ifndef CLI_MESSAGE_H
#define CLI_MESSAGE_H

/* Prints `recto: FILE:LINE: text` on standard error; an unknown file or line is
 * omitted.  Control characters are written as escapes such as \033 or \n. */
void message_print(const char *file, unsigned long line, const char *text);

#endif
