/* message.h - messages for the user, on standard error. */
#ifndef CLI_MESSAGE_H
#define CLI_MESSAGE_H

/* Prints `recto: FILE:LINE: text` on standard error, leaving out what is not
 * known.  What a terminal would obey rather than show is written as an escape
 * such as \033 or \n. */
void message_print(const char *file, unsigned long line, const char *text);

#endif
