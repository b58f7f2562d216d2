/* signals.c - handles termination signals: the run cleans up, then terminates
 * by the signal.
 *
 * A shell stops its script only if the process was terminated by the signal: an
 * exit status, even 130, is not enough.  So the signal is raised again with its
 * default action after incomplete files have been removed. */
#include "cli/signals.h"

#include <signal.h>
#include <stddef.h>

/* SIGPIPE is among them: closing the pipe of messages or of a drawing ends the
 * run, but only after its other incomplete files are removed. */
static const int caught[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXCPU};
enum { CAUGHT = sizeof caught / sizeof caught[0] };

static volatile sig_atomic_t arrived; /* the first; 0: none */

static void record_signal(int number) {
  if (arrived == 0)
    arrived = number;
}

void signals_catch(void) {
  struct sigaction action = {.sa_handler = record_signal,
                             .sa_flags = (int)SA_RESETHAND};
  struct sigaction before;
  sigemptyset(&action.sa_mask);
  for (int i = 0; i < CAUGHT; i++)
    if (sigaction(caught[i], NULL, &before) == 0 &&
        before.sa_handler != SIG_IGN)
      sigaction(caught[i], &action, NULL);
}

bool signals_arrived(void) { return arrived != 0; }

bool signals_are_of_a_pipe(void) { return arrived == SIGPIPE; }

void signals_die(void) {
  int number = arrived;
  if (number == 0)
    return;
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, number);
  (void)signal(number, SIG_DFL);
  (void)sigprocmask(SIG_UNBLOCK, &only, NULL);
  (void)raise(number);
}
