/* run.h - what the program does once the command line is understood. */
#ifndef CLI_RUN_H
#define CLI_RUN_H

#include "cli/arguments.h"

/* As diff has it where a drawing is checked: right, wrong, and trouble of any
 * kind. */
enum { EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_USAGE = 2 };

/* Reads, draws, writes, reports.  Returns the exit status; after a signal that
 * asked for the end, ends the process by it. */
int cli_run(struct arguments *arguments);

#endif
