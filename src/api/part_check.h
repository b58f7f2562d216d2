/* part_check.h - which options can be used with parts of a drawing. */
#ifndef API_PART_CHECK_H
#define API_PART_CHECK_H

#include "base/status.h"
#include "parts/part.h"

/* The number of faces that a line may be behind to be drawn; 0: any. */
uint32_t part_hidden_by_max(const recto_options *options);

/* Whether parts that are solved with these options can be joined exactly.
 * Errors  RECTO_ERROR_UNSUPPORTED: the text says what cannot be */
USE_RESULT recto_status part_check_solve(const recto_options *options,
                                         recto_error *error);

/* Whether there is a part of this number, from 1.
 * Errors  RECTO_ERROR_ARGUMENT */
USE_RESULT recto_status part_check_number(unsigned number, unsigned count,
                                          recto_error *error);

/* Whether parts, or a plan of them, have what these options draw.
 * of_plan  it is a plan that has it, for messages
 * Errors   RECTO_ERROR_UNSUPPORTED */
USE_RESULT recto_status part_check_ink(const recto_options *options,
                                       const struct part_common *common,
                                       bool of_plan, recto_error *error);

#endif
