/* progress.h - how far the run is, on standard error. */
#ifndef CLI_PROGRESS_H
#define CLI_PROGRESS_H

#include <stdbool.h>

/* From now on progress is shown: on a terminal as a bar that appears after half
 * a second, elsewhere as lines where it is asked for. */
void progress_start(bool asked_for);

/* Notes the share of the work that is done, 0 to 1, and the stage. */
void progress_note(double share, const char *stage);

/* Takes the bar away for something else to be written, and lets it come again.
 */
void progress_hide(void);
void progress_go_on(void);

/* Takes the bar away for good. */
void progress_end(void);

#endif
