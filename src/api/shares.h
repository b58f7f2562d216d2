/* shares.h - how much of a render's work lies behind each of its stages. */
#ifndef API_SHARES_H
#define API_SHARES_H

#include "recto.h"

enum share_stage {
  SHARE_TOPOLOGY,
  SHARE_CAMERA,
  SHARE_SHEET,
  SHARE_SOLVE,
  SHARE_INK,
  SHARE_VERIFY,
  SHARE_WRITE,
  SHARE_STAGES
};

/* The share of the work that is done when each stage begins, from 0 upwards, as
 * measured on models of several sizes: a guess, so that progress grows with
 * time. */
void shares_plan(double begin[SHARE_STAGES + 1], const recto_options *options);

/* Where a phase of a solver, at that share of its own, is within the solving.
 * fragments  are asked for too, behind the edges */
double shares_of_phase(const char *phase, double share, bool fragments);

#endif
