/* frames.h - the drawings of one run: one, several views, or the frames of a
 * turntable, each to an output of its own. */
#ifndef CLI_FRAMES_H
#define CLI_FRAMES_H

#include "cli/arguments.h"

enum { FRAME_PATH_SIZE = 4096 };

/* How many drawings there are; --frames chooses some of them. */
int frames_count(const struct arguments *arguments);

/* The drawings that the run makes of these: from the first to before the
 * other. */
int frames_first(const struct arguments *arguments);
int frames_past(const struct arguments *arguments);

/* Sets the options for a drawing, counted from 0.  All frames of a turntable
 * have one scale: the direction turns about the up axis, and where nothing else
 * is said the sphere that encloses the scene fills the page. */
void frame_options(const struct arguments *arguments, int frame,
                   recto_options *options);

/* The output's path for a drawing: where there are several, of the pattern
 *   %d, %3d, %03d   the drawing's number
 *   %s              the name of its view
 *   %%              %
 * Returns NULL where the path is too long: see frame_fault. */
const char *frame_path(const struct arguments *arguments, const char *pattern,
                       int frame, char path[FRAME_PATH_SIZE]);

/* What is wrong with the pattern of several drawings: it must make a different
 * path of each; NULL: nothing. */
const char *frame_fault(const struct arguments *arguments, const char *pattern);

#endif
