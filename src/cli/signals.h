/* signals.h - an interrupted run cleans up and then dies of its signal. */
#ifndef CLI_SIGNALS_H
#define CLI_SIGNALS_H

#include <stdbool.h>

/* From now on the signals that ask the process to end are noted, so that the
 * work can be cancelled and cleaned up; the second of a kind ends the process
 * at once.  A signal that is ignored stays so: nohup means it. */
void signals_catch(void);

/* Whether one of them has arrived. */
bool signals_arrived(void);

/* Whether the one that arrived says that nobody reads what is written. */
bool signals_are_of_a_pipe(void);

/* Ends the process by the signal that has arrived, as if it had never been
 * caught, so that a shell's loop stops; returns where none has. */
void signals_die(void);

#endif
