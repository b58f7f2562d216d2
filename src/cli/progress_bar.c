/* progress_bar.c - shows the progress of the run on standard error.
 *
 * The bar is drawn by a thread of its own, ten times a second, so that it is
 * updated while a stage reports nothing.  The lock is also held while a message
 * is written. */
#include "cli/progress_bar.h"

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

enum { COLUMNS_MAX = 200, LEAST_COLUMNS = 12, USUAL_COLUMNS = 80 };

static const double delay_s = 0.5, tick_s = 0.1;

static struct {
  pthread_mutex_t lock;
  pthread_cond_t wake;
  pthread_t thread;
  bool runs;        /* the thread is running */
  bool ends;        /* the thread is to end */
  bool lines;       /* print lines, as there is no terminal */
  int last_percent; /* the last percentage printed as a line */
  int columns;      /* of the bar that is on the screen; 0: none is */
  double share;     /* never falls */
  double share_s;   /* when it was last heard of, from the start */
  const char *stage;
  double start_s;
} now = {.lock = PTHREAD_MUTEX_INITIALIZER, .wake = PTHREAD_COND_INITIALIZER};

static double clock_s(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + (double)time.tv_nsec / 1000000000;
}

/* ---- The bar ------------------------------------------------------------- */

static void write_out(const char *text, size_t length) {
  (void)!write(STDERR_FILENO, text, length);
}

/* By blanks, as some terminals have no control sequences. */
static void erase(void) {
  char text[COLUMNS_MAX + 2];
  if (now.columns == 0)
    return;
  size_t columns = (size_t)now.columns;
  text[0] = '\r';
  memset(text + 1, ' ', columns);
  text[columns + 1] = '\r';
  write_out(text, columns + 2);
  now.columns = 0;
}

/* One column less than there are: a line that is full may wrap. */
static int count_columns(void) {
  struct winsize size;
  int columns = USUAL_COLUMNS;
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    columns = size.ws_col;
  return columns > COLUMNS_MAX ? COLUMNS_MAX - 1 : columns - 1;
}

/* The time left, from what the work had taken when the share was last heard of;
 * "" where that says little yet, or is over. */
static void format_time_left(char text[24], double passed_s) {
  const double least_share = 0.03, most_s = 360000;
  text[0] = '\0';
  if (now.share < least_share)
    return;
  double left = now.share_s / now.share - passed_s;
  if (!(left > 0 && left < most_s))
    return;
  int s = (int)ceil(left);
  if (s < 3600)
    snprintf(text, 24, " %d:%02d left", s / 60, s % 60);
  else
    snprintf(text, 24, " %d:%02d h left", s / 3600, s / 60 % 60);
}

static void draw_bar(double passed_s) {
  char text[COLUMNS_MAX + 64], left[24];
  int columns = count_columns();
  if (columns < LEAST_COLUMNS || tcgetpgrp(STDERR_FILENO) != getpgrp())
    return;
  format_time_left(left, passed_s);
  int percent = (int)(now.share * 100);
  int width = columns - (int)strlen(left) - 5 - 11 - 3;
  int length;
  if (width >= 10) {
    char bar[COLUMNS_MAX];
    int filled = (int)(now.share * width);
    memset(bar, '#', (size_t)filled);
    memset(bar + filled, '-', (size_t)(width - filled));
    length = snprintf(text, sizeof text, "\r%-11.11s[%.*s] %3d%%%s", now.stage,
                      width, bar, percent, left);
  } else {
    length = snprintf(text, sizeof text, "\r%3d%%%s", percent, left);
  }
  if (length - 1 > columns)
    length = columns + 1;
  if (length - 1 < now.columns)
    erase();
  write_out(text, (size_t)length);
  now.columns = length - 1;
}

static void *draw_repeatedly(void *unused) {
  (void)unused;
  pthread_mutex_lock(&now.lock);
  while (!now.ends) {
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += (long)(tick_s * 1000000000);
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    pthread_cond_timedwait(&now.wake, &now.lock, &until);
    double passed_s = clock_s() - now.start_s;
    if (!now.ends && passed_s >= delay_s)
      draw_bar(passed_s);
  }
  erase();
  pthread_mutex_unlock(&now.lock);
  return NULL;
}

/* ---- What is seen from outside ------------------------------------------- */

static bool is_terminal(void) {
  const char *kind = getenv("TERM");
  return isatty(STDERR_FILENO) && kind != NULL && strcmp(kind, "dumb") != 0;
}

/* Signals are the main thread's. */
static void start_thread(void) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  now.runs = pthread_create(&now.thread, NULL, draw_repeatedly, NULL) == 0;
  pthread_sigmask(SIG_SETMASK, &before, NULL);
}

void progress_bar_start(bool requested) {
  now.start_s = clock_s();
  now.stage = "read";
  now.last_percent = -1;
  if (is_terminal())
    start_thread();
  else
    now.lines = requested;
}

static void print_progress_line(bool is_new) {
  int percent = (int)(now.share * 100);
  if (!is_new && percent < now.last_percent + 5)
    return;
  fprintf(stderr, "recto: %3d%% %s\n", percent, now.stage);
  now.last_percent = percent;
}

void progress_bar_update(double share, const char *stage) {
  if (!now.runs && !now.lines)
    return;
  pthread_mutex_lock(&now.lock);
  bool is_new = strcmp(stage, now.stage) != 0;
  if (share > now.share) {
    now.share = share < 1 ? share : 1;
    now.share_s = clock_s() - now.start_s;
  }
  now.stage = stage;
  if (now.lines)
    print_progress_line(is_new);
  pthread_mutex_unlock(&now.lock);
}

void progress_bar_hide(void) {
  pthread_mutex_lock(&now.lock);
  erase();
}

void progress_bar_show(void) { pthread_mutex_unlock(&now.lock); }

void progress_bar_end(void) {
  now.lines = false;
  if (!now.runs)
    return;
  pthread_mutex_lock(&now.lock);
  now.ends = true;
  pthread_cond_signal(&now.wake);
  pthread_mutex_unlock(&now.lock);
  pthread_join(now.thread, NULL);
  now.runs = false;
}
