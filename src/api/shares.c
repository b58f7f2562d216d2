/* shares.c - estimates the share of the work of each stage of a drawing.
 *
 * The weights are hundredths of what lines of a scanned model take with the
 * automatic method; see bench/ for the times by stage. */
#include "api/shares.h"

static double weigh_solving(const recto_options *o) {
  bool fast = o->solver.method == RECTO_METHOD_AUTO ||
              o->solver.method == RECTO_METHOD_TILES;
  return (fast ? 60 : 400) * (o->ink.fill != RECTO_FILL_NONE ? 3 : 1);
}

static double weigh_ink(const recto_options *o) {
  return 3 + (o->ink.fill == RECTO_FILL_HATCH ? 80 : 0) +
         (o->ink.fill != RECTO_FILL_NONE ? 20 : 0) +
         (o->ink.order == RECTO_ORDER_NEAR ? 30 : 0);
}

/* Quantitative invisibility, of the hidden edges. */
static double weigh_invisibility(const recto_options *o) {
  bool has_limit =
      o->ink.hidden != RECTO_HIDDEN_NONE && o->ink.hidden_by_max > 0;
  bool is_kept =
      (o->results & RECTO_RESULT_INVISIBILITY) == RECTO_RESULT_INVISIBILITY;
  return has_limit || is_kept ? 90 : 0;
}

/* The constant part is the preparation before the first sample. */
static double weigh_verifying(const recto_options *o) {
  const double usual = 4000;
  return o->verify > 0 ? 150 + 250 * (o->verify / usual) : 0;
}

void shares_plan(double begin[SHARE_STAGES + 1], const recto_options *options) {
  const double weight[SHARE_STAGES] = {
      [SHARE_READ] = 12,
      [SHARE_TOPOLOGY] = 6,
      [SHARE_CAMERA] = 1,
      [SHARE_SHEET] = 12,
      [SHARE_SOLVE] = weigh_solving(options),
      [SHARE_INVISIBILITY] = weigh_invisibility(options),
      [SHARE_CONTOURS] = options->ink.contours == RECTO_CONTOURS_SMOOTH ? 8 : 0,
      [SHARE_INK] = weigh_ink(options),
      [SHARE_VERIFY] = weigh_verifying(options),
      [SHARE_RESULTS] = options->results != 0 ? 10 : 0,
      [SHARE_WRITE] = 5,
  };
  double sum = 0;
  for (int i = 0; i < SHARE_STAGES; i++)
    sum += weight[i];
  begin[0] = 0;
  for (int i = 0; i < SHARE_STAGES; i++)
    begin[i + 1] = begin[i] + weight[i] / sum;
}

void shares_open_poll(struct poll *poll, const recto_options *options,
                      enum share_stage stage, const char *name) {
  double begin[SHARE_STAGES + 1];
  shares_plan(begin, options);
  poll_open(poll, options);
  poll->from = poll->share = begin[stage];
  poll->to = begin[stage + 1];
  poll->stage = name;
}
