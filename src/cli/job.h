/* job.h - what the program does once the command line is understood. */
#ifndef CLI_JOB_H
#define CLI_JOB_H

#include "cli/arguments.h"

enum { EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_USAGE = 2 };

/* Prints `recto: FILE:LINE: text` on standard error, leaving out what is not
 * known. */
void job_complain(const char *file, unsigned long line, const char *text);

/* Reads, draws, writes, reports.  Returns the exit status. */
int job_run(struct arguments *arguments);

#endif
