/* progress_bar.h - shows the progress of the run on standard error. */
#ifndef CLI_PROGRESS_BAR_H
#define CLI_PROGRESS_BAR_H

#include <stdbool.h>

/* Starts showing progress: on a terminal as a bar that appears after half a
 * second, elsewhere as lines if requested. */
void progress_bar_start(bool requested);

/* Sets the share of the work that is done, 0 to 1, and the stage. */
void progress_bar_update(double share, const char *stage);

/* Hide the bar while something else is written, and show it again. */
void progress_bar_hide(void);
void progress_bar_show(void);

/* Removes the bar and stops showing progress. */
void progress_bar_end(void);

#endif
