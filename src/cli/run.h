/* run.h - runs the program by its parsed command line. */
#ifndef CLI_RUN_H
#define CLI_RUN_H

#include "cli/arguments.h"

/* Exit statuses; with --check as of diff: right, wrong, any error. */
enum { EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_USAGE = 2 };

/* Reads, draws, writes, reports.  Returns the exit status; if the run was
 * cancelled by a signal, terminates the process by that signal. */
int cli_run(struct arguments *arguments);

#endif
