/* cover_verdict.c - decides which hairs are covered.
 *
 * In parallel  A hair is judged as if all others were drawn.  Those of which
 *   that says nothing yet, as they may be covered by hairs that are not drawn,
 *   are decided from the longest to the shortest.  One that may be covered by a
 *   hair which another thread has not decided yet is decided at the end: so
 *   what is decided is the same for any number of threads. */
#include "base/poll.h"
#include "ink/lines/covering.h"

enum { SIDES_TRIED_MAX = 256 };

/* ---- Pieces -------------------------------------------------------------- */

/* The side that covered the piece of a hair before this one; NULL: none did. */
struct last_cover {
  const struct cover_side *side;
};

/* What a piece of a hair, from at[0], at[1] to at[2], at[3], gives. */
typedef enum cover_verdict piece_fn(const struct covering *c,
                                    const struct measured_path *hair,
                                    const double at[4],
                                    struct last_cover *last);

/* Calls do_piece for the pieces of a path, until one is COVER_NONE; returns
 * that, or COVER_UNDECIDED where one is, or COVER_FOUND.  Begins in the middle
 * of the path and of each side, as other lines mostly meet it at its ends. */
static enum cover_verdict for_all_pieces(const struct covering *c,
                                         uint32_t number, piece_fn *do_piece) {
  const struct ink_path *path = &c->paths->path.item[number];
  const struct measured_path *hair = &c->measured[number];
  const uint32_t sides = path->count - 1, middle = sides / 2;
  enum cover_verdict all = COVER_FOUND;
  struct last_cover last = {NULL};
  for (uint32_t n = 0; n < sides; n++) {
    uint32_t i = n < sides - middle ? n + middle : n - (sides - middle);
    const struct ink_point *p = &c->paths->point.item[path->point + i];
    double pieces = ceil(covering_distance(p[0], p[1]) / hair->near * 2);
    double dx = ((double)p[1].x - p[0].x) / pieces;
    double dy = ((double)p[1].y - p[0].y) / pieces;
    double half = floor(pieces / 2);
    for (double m = 0; m < pieces; m++) {
      double k = m < pieces - half ? m + half : m - (pieces - half);
      const double at[4] = {p->x + k * dx, p->y + k * dy, p->x + (k + 1) * dx,
                            p->y + (k + 1) * dy};
      enum cover_verdict verdict = do_piece(c, hair, at, &last);
      if (verdict == COVER_NONE)
        return verdict;
      if (verdict == COVER_UNDECIDED)
        all = verdict;
    }
  }
  return all;
}

/* ---- 4 Judge, 5 Decide --------------------------------------------------- */

/* The sides that are tried for a piece of a hair. */
struct cover_trial {
  const uint32_t *side, *end;
  int tried;
};

static struct cover_trial trial_at(const struct covering *c,
                                   const double at[4]) {
  int64_t cell = covering_cell(c, (at[0] + at[2]) / 2, (at[1] + at[3]) / 2);
  return (struct cover_trial){c->sides.item + c->sides.start[cell],
                              c->sides.item + c->sides.start[cell + 1], 0};
}

/* The verdict of a hair, which another thread may be giving. */
static enum cover_verdict verdict_of(const struct covering *c, uint32_t path) {
  return (enum cover_verdict)atomic_load_explicit(&c->verdict[path],
                                                  memory_order_relaxed);
}

static void give_verdict(const struct covering *c, uint32_t path,
                         enum cover_verdict verdict) {
  atomic_store_explicit(&c->verdict[path], (unsigned char)verdict,
                        memory_order_relaxed);
}

/* Whether a side may take the place of a hair that is near it. */
static bool may_cover(const struct cover_side *side,
                      const struct measured_path *hair) {
  return side->layer == hair->layer && side->weight >= hair->weight;
}

/* The next side that may cover the hair; NULL: there is none, or enough have
 * been tried. */
static const struct cover_side *next_coverer(const struct covering *c,
                                             const struct measured_path *hair,
                                             struct cover_trial *trial) {
  while (trial->side < trial->end && trial->tried < SIDES_TRIED_MAX) {
    const struct cover_side *side = &c->side.item[*trial->side++];
    if (side->rank >= hair->rank)
      break;
    if (may_cover(side, hair))
      return side;
  }
  return NULL;
}

/* Does the side that covered the last piece cover this one?  It would be found
 * in this cell, too, as it is listed in all that it is near; only where so many
 * are that not all are tried it might not. */
static bool covers_again(const struct last_cover *last,
                         const struct cover_trial *trial,
                         const struct measured_path *hair, const double at[4]) {
  return last->side != NULL && trial->end - trial->side <= SIDES_TRIED_MAX &&
         cover_side_is_near(last->side, at, hair->near);
}

/* Of a piece, as if all hairs were drawn.  A path that is none is drawn in any
 * case, and would be tried at this place or before. */
static enum cover_verdict judge_piece(const struct covering *c,
                                      const struct measured_path *hair,
                                      const double at[4],
                                      struct last_cover *last) {
  struct cover_trial trial = trial_at(c, at);
  const struct cover_side *side;
  bool found = false;
  if (covers_again(last, &trial, hair, at))
    return COVER_FOUND;
  while ((side = next_coverer(c, hair, &trial)) != NULL) {
    trial.tried++;
    if (!cover_side_is_near(side, at, hair->near))
      continue;
    if (!side->is_hair) {
      last->side = side;
      return COVER_FOUND;
    }
    found = true;
  }
  return found || trial.tried == SIDES_TRIED_MAX ? COVER_UNDECIDED : COVER_NONE;
}

/* Of a piece, by the hairs that are drawn; COVER_UNDECIDED: one that is not
 * decided yet may cover it, or be one of the sides that are tried. */
static enum cover_verdict decide_piece(const struct covering *c,
                                       const struct measured_path *hair,
                                       const double at[4],
                                       struct last_cover *last) {
  struct cover_trial trial = trial_at(c, at);
  bool all_are_tried = trial.end - trial.side <= SIDES_TRIED_MAX;
  enum cover_verdict none = COVER_NONE;
  const struct cover_side *side;
  if (covers_again(last, &trial, hair, at))
    return COVER_FOUND;
  while ((side = next_coverer(c, hair, &trial)) != NULL) {
    enum cover_verdict its =
        side->is_hair ? verdict_of(c, c->by_rank[side->rank]) : COVER_NONE;
    if (its == COVER_FOUND)
      continue;
    if (its == COVER_UNDECIDED && !all_are_tried)
      return COVER_UNDECIDED;
    trial.tried++;
    if (!cover_side_is_near(side, at, hair->near))
      continue;
    if (its == COVER_NONE) {
      last->side = side;
      return COVER_FOUND;
    }
    none = COVER_UNDECIDED;
  }
  last->side = NULL;
  return none;
}

static bool judge_range(void *user, struct parallel_range range) {
  const struct covering *c = user;
  for (size_t i = range.begin; i < range.end; i++) {
    uint32_t path = c->hair[i].value;
    if (i + MEM_PREFETCH_AHEAD < range.end)
      covering_prefetch(c, c->hair[i + MEM_PREFETCH_AHEAD].value,
                        c->hair[i + MEM_PREFETCH_AHEAD / 2].value);
    give_verdict(c, path, for_all_pieces(c, path, judge_piece));
  }
  return true;
}

static bool decide_range(void *user, struct parallel_range range) {
  const struct covering *c = user;
  for (size_t i = range.begin; i < range.end; i++) {
    uint32_t path = c->undecided.item[i];
    give_verdict(c, path, for_all_pieces(c, path, decide_piece));
  }
  return true;
}

static bool set_covered_of_range(void *user, struct parallel_range range) {
  const struct covering *c = user;
  for (size_t i = range.begin; i < range.end; i++)
    c->paths->path.item[i].is_covered =
        verdict_of(c, (uint32_t)i) == COVER_FOUND;
  return true;
}

static bool list_undecided(struct covering *c) {
  for (size_t r = 0; r < c->paths->path.count; r++)
    if (!poll_at(r) || (verdict_of(c, c->by_rank[r]) == COVER_UNDECIDED &&
                        !ARRAY_PUSH(&c->undecided, c->by_rank[r])))
      return false;
  return true;
}

bool covering_decide(struct covering *c) {
  if (!parallel_ranges_ascending(parallel_workers(c->hairs, PATHS_IN_RANGE),
                                 c->hairs, PATHS_IN_RANGE, judge_range, c) ||
      !list_undecided(c))
    return false;
  size_t count = c->undecided.count;
  if (!parallel_ranges_ascending(parallel_workers(count, PATHS_IN_RANGE), count,
                                 PATHS_IN_RANGE, decide_range, c))
    return false;
  for (size_t i = 0; i < count; i++)
    if (verdict_of(c, c->undecided.item[i]) == COVER_UNDECIDED)
      (void)decide_range(c, (struct parallel_range){i, i + 1, 0});
  count = c->paths->path.count;
  return parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                         PARALLEL_ITEMS, set_covered_of_range, c);
}
