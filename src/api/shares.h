/* shares.h - estimates the share of the work of each stage of a drawing, from
 * reading to writing, for progress. */
#ifndef API_SHARES_H
#define API_SHARES_H

#include "base/poll.h"

enum share_stage {
  SHARE_READ,
  SHARE_TOPOLOGY,
  SHARE_CAMERA,
  SHARE_SHEET,
  SHARE_SOLVE,
  SHARE_INVISIBILITY,
  SHARE_CONTOURS,
  SHARE_INK,
  SHARE_VERIFY,
  SHARE_RESULTS,
  SHARE_WRITE,
  SHARE_STAGES
};

/* Sets the share of the work that is done when each stage begins, from 0 to 1:
 * an estimate by measurements on models of several sizes, so that progress is
 * about linear in time. */
void shares_plan(double begin[SHARE_STAGES + 1], const recto_options *options);

/* Opens a poll for a call whose work is one stage. */
void shares_open_poll(struct poll *poll, const recto_options *options,
                      enum share_stage stage, const char *name);

#endif
