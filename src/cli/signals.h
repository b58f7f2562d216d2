/* signals.h - handles termination signals: the run cleans up, then terminates
 * by the signal. */
#ifndef CLI_SIGNALS_H
#define CLI_SIGNALS_H

#include <stdbool.h>

/* Installs handlers that record termination signals, so that the work can be
 * cancelled and cleaned up; a second signal of the kind terminates the process
 * at once.  Ignored signals stay ignored, as nohup requires. */
void signals_catch(void);

/* Whether one of them has arrived. */
bool signals_arrived(void);

/* Whether the signal that arrived was SIGPIPE. */
bool signals_are_of_a_pipe(void);

/* Terminates the process by the signal that has arrived, as if it had not been
 * caught, so that a shell's loop stops; returns if none has. */
void signals_die(void);

#endif
