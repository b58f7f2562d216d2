/* part_check.c - which options can be used with parts of a drawing. */
#include "api/part_check.h"

#include <string.h>

#include "api/part_tones.h"
#include "ink/tone.h"
#include "visibility/solver.h"

static recto_status refuse_parts(const char *what, recto_error *error) {
  return error_set(error, RECTO_ERROR_UNSUPPORTED, NULL, 0,
                   "drawings in parts have no %s", what);
}

/* What neither parts nor their join can do. */
static const char *name_unsupported(const recto_options *o) {
  if (o->results != 0)
    return "results as data";
  if (o->verify != 0)
    return "verification";
  if (o->ink.contours == RECTO_CONTOURS_SMOOTH)
    return "smooth contours";
  if (o->sheet.arrangement != RECTO_ARRANGEMENT_NONE)
    return "sheets of several views";
  return NULL;
}

uint32_t part_hidden_by_max(const recto_options *o) {
  return o->ink.hidden != RECTO_HIDDEN_NONE && o->ink.hidden_by_max > 0
             ? (uint32_t)o->ink.hidden_by_max
             : 0;
}

recto_status part_check_solve(const recto_options *o, recto_error *error) {
  const char *what = name_unsupported(o);
  if (what == NULL && !solver_is_exact(o))
    what = "approximate methods";
  if (what == NULL && (o->mesh.cut_count > 0 || o->camera.has_section))
    what = "cuts";
  return what != NULL ? refuse_parts(what, error) : RECTO_OK;
}

recto_status part_check_number(unsigned number, unsigned count,
                               recto_error *error) {
  if (count >= 1 && count <= RECTO_PARTS_MAX && number >= 1 && number <= count)
    return RECTO_OK;
  return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                   "there is no part %u of %u: there are at most %d", number,
                   count, RECTO_PARTS_MAX);
}

static recto_status refuse_without(bool of_plan, const char *missing,
                                   const char *how, recto_error *error) {
  return error_set(error, RECTO_ERROR_UNSUPPORTED, NULL, 0,
                   "the %s made without %s: make %s with %s",
                   of_plan ? "plan was" : "parts were", missing,
                   of_plan ? "it" : "them", how);
}

recto_status part_check_ink(const recto_options *o,
                            const struct part_common *common, bool of_plan,
                            recto_error *error) {
  const char *never = name_unsupported(o);
  if (never != NULL)
    return refuse_parts(never, error);
  if (o->ink.fill != RECTO_FILL_NONE && !common->has_fragments)
    return refuse_without(of_plan, "visible faces", "--fill", error);
  double light[PART_LIGHT];
  _Static_assert((int)PART_LIGHT == (int)TONES_LIGHT, "are one light");
  tones_set_light(light, &common->camera, o);
  if (part_tones_are_wanted(o) &&
      (!common->has_tones || memcmp(light, common->light, sizeof light) != 0))
    return refuse_without(of_plan, "these tones",
                          "the same --fill hatch, --light, --ambient, "
                          "--fill-light and --pen",
                          error);
  if (o->ink.ids && !common->has_ids)
    return refuse_without(of_plan, "ids", "--ids", error);
  if (o->ink.hidden != RECTO_HIDDEN_NONE && !common->has_hidden)
    return refuse_without(of_plan, "hidden lines", "--hidden", error);
  uint32_t limit = part_hidden_by_max(o);
  if (limit != 0 && limit != common->hidden_by_max)
    return error_set(error, RECTO_ERROR_UNSUPPORTED, NULL, 0,
                     "the %s made without --hidden=%lu: make %s with it",
                     of_plan ? "plan was" : "parts were", (unsigned long)limit,
                     of_plan ? "it" : "them");
  return RECTO_OK;
}
