/* completion.h - --completion: what a shell offers while a command line is
 * typed. */
#ifndef CLI_COMPLETION_H
#define CLI_COMPLETION_H

enum completion_shell { COMPLETION_BASH, COMPLETION_ZSH };

/* Prints to standard output. */
void completion_print(enum completion_shell shell);

#endif
