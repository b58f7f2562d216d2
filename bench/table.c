/* table.c - see table.h. */
#include "bench/table.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static double now(void) {
  struct timespec at;
  clock_gettime(CLOCK_MONOTONIC, &at);
  return (double)at.tv_sec + 1e-9 * (double)at.tv_nsec;
}

static double seconds_of(struct timeval at) {
  return (double)at.tv_sec + 1e-6 * (double)at.tv_usec;
}

/* Becomes the program; an alarm ends it when its time is up. */
static void become(const char *const argv[], unsigned limit_s) {
  int nothing = open("/dev/null", O_WRONLY);
  if (nothing >= 0)
    dup2(nothing, STDOUT_FILENO);
  alarm(limit_s);
  execv(argv[0], (char *const *)argv);
  _exit(127);
}

void run_program(struct run *run, const char *const argv[], unsigned limit_s) {
  memset(run, 0, sizeof *run);
  fflush(NULL);
  double start = now();
  pid_t child = fork();
  if (child == 0)
    become(argv, limit_s);
  struct rusage usage;
  int status;
  run->status = -1;
  if (child < 0 || wait4(child, &status, 0, &usage) != child)
    return;
  run->wall_s = now() - start;
  run->cpu_s = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  run->peak_mb = (double)usage.ru_maxrss / 1000;
  if (WIFEXITED(status))
    run->status = WEXITSTATUS(status);
}

/* A limit of the child's own would make its clock as coarse as the
 * system's. */
enum run_end run_answer(pid_t child, int end, unsigned limit_s, void *answer,
                        size_t size) {
  bool in_time = true;
  struct pollfd ready = {.fd = end, .events = POLLIN};
  struct timespec used = {0, 0};
  clockid_t clock;
  if (clock_getcpuclockid(child, &clock) == 0)
    while (poll(&ready, 1, 100) == 0 && clock_gettime(clock, &used) == 0)
      if (used.tv_sec >= (time_t)limit_s) {
        in_time = false;
        kill(child, SIGKILL);
      }
  bool ok = read(end, answer, size) == (ssize_t)size;
  close(end);
  waitpid(child, NULL, 0);
  return ok ? RUN_ANSWERED : in_time ? RUN_FAILED : RUN_OUT_OF_TIME;
}

double report_number(const char *text, const char *name) {
  char key[64];
  snprintf(key, sizeof key, "\"%s\":", name);
  const char *at = text == NULL ? NULL : strstr(text, key);
  return at == NULL ? 0 : strtod(at + strlen(key), NULL);
}

char *read_file(const char *path, size_t *length) {
  FILE *file = fopen(path, "rb");
  char *text = NULL;
  if (file == NULL)
    return NULL;
  long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
  if (size >= 0 && fseek(file, 0, SEEK_SET) == 0)
    text = malloc((size_t)size + 1);
  if (text != NULL && fread(text, 1, (size_t)size, file) == (size_t)size) {
    text[size] = '\0';
    if (length != NULL)
      *length = (size_t)size;
  } else {
    free(text);
    text = NULL;
  }
  fclose(file);
  return text;
}

bool whole_open(struct whole_file *whole, const char *path) {
  snprintf(whole->path, sizeof whole->path, "%s", path);
  snprintf(whole->made, sizeof whole->made, "%s.new", whole->path);
  whole->file = fopen(whole->made, "w");
  return whole->file != NULL;
}

bool whole_close(struct whole_file *whole, bool ok) {
  ok = !ferror(whole->file) && ok;
  ok = fclose(whole->file) == 0 && ok;
  ok = ok && rename(whole->made, whole->path) == 0;
  if (!ok)
    (void)remove(whole->made);
  return ok;
}

static int compare_numbers(const void *a, const void *b) {
  const double *x = a, *y = b;
  return *x < *y ? -1 : *x > *y;
}

double median_of(double *number, size_t count) {
  qsort(number, count, sizeof *number, compare_numbers);
  return count % 2 == 1 ? number[count / 2]
                        : (number[count / 2 - 1] + number[count / 2]) / 2;
}
