/* table.h - runs programs and measures their time and memory, for the bench. */
#ifndef BENCH_TABLE_H
#define BENCH_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/types.h>

enum { RUNS_MAX = 9 };

/* What one run of a program cost. */
struct run {
  double cpu_s, wall_s; /* user and system, all threads; elapsed */
  double peak_mb;       /* resident */
  int status;           /* exit status; -1: killed or too slow */
};

/* Runs argv[0], its standard output thrown away, for `limit_s` at most. */
void run_program(struct run *run, const char *const argv[], unsigned limit_s);

enum run_end { RUN_ANSWERED, RUN_OUT_OF_TIME, RUN_FAILED };

/* Reads the answer of `size` bytes that a child process writes into a pipe,
 * closes the pipe's end and waits for the child; ends it once it has used
 * `limit_s` of CPU time. */
enum run_end run_answer(pid_t child, int end, unsigned limit_s, void *answer,
                        size_t size);

/* A report that recto wrote: the number called `name` in it, 0 where there is
 * none.  `text` is the JSON. */
double report_number(const char *text, const char *name);

/* The whole file, NUL-terminated, to be freed; NULL where it cannot be read.
 * Its length goes to *length where that is not NULL. */
char *read_file(const char *path, size_t *length);

/* A file that gets its name when it is whole. */
struct whole_file {
  FILE *file;
  char path[4096], made[4096 + 4];
};

/* False where it cannot be opened. */
bool whole_open(struct whole_file *whole, const char *path);

/* Closes the file; gives it its name where `ok` and nothing failed, else
 * removes it.  Returns whether it has it. */
bool whole_close(struct whole_file *whole, bool ok);

/* The median; sorts the numbers. */
double median_of(double *number, size_t count);

#endif
