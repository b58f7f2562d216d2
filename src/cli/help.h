/* help.h - --help. */
#ifndef CLI_HELP_H
#define CLI_HELP_H

/* Prints to standard output. */
void help_print(void);

#endif
