/* warnock_faces.c - visible pieces of faces window by window, and the fragments
 * of whole faces from them.
 *
 * Memory: each window adds pieces of its own.  Each time that their number has
 * doubled, the faces of many pieces are deferred to pairwise_fallback.h and
 * their pieces are discarded.
 */
#include "base/sort.h"
#include "visibility/warnock/warnock_subdivision.h"

/* Faces of more pieces are deferred when there are too many pieces in all. */
enum { PIECES_PER_FACE_MAX = 8 };

static int compare_face_pieces(const void *a, const void *b, void *user) {
  const struct triangle_piece *p = a, *q = b;
  (void)user;
  return (p->triangle > q->triangle) - (p->triangle < q->triangle);
}

/* Sorts the pieces by face. */
static bool sort_pieces(struct warnock *w) {
  return sort_stable(w->piece.item, w->piece.count, sizeof *w->piece.item,
                     compare_face_pieces, NULL);
}

/* Defers faces of many pieces to the fallback, and discards their pieces. */
static bool limit_pieces(struct warnock *w) {
  struct triangle_piece *piece = w->piece.item;
  size_t n = w->piece.count, kept = 0;
  struct arena arena = {0};
  bool ok = sort_pieces(w);
  for (size_t i = 0, past; ok && i < n; i = past) {
    uint32_t t = piece[i].triangle;
    for (past = i; past < n && piece[past].triangle == t;)
      past++;
    if (past - i > PIECES_PER_FACE_MAX)
      w->triangle_deferred[t] = w->any_deferred = true;
    for (size_t k = i; ok && k < past && !w->triangle_deferred[t]; k++) {
      struct triangle_piece copy = {.triangle = t};
      ok = geom_convex_copy(&copy.piece, &piece[k].piece, &arena);
      piece[kept++] = copy;
    }
  }
  arena_fini(&w->arena);
  w->arena = arena;
  w->piece.count = kept;
  w->piece_limit = 2 * kept + WARNOCK_LIMIT_FROM;
  return ok;
}

/* The window's borders as lines with the window on their left, and the same
 * lines reversed. */
static void window_lines(const struct box2 *window, struct geom_line line[4],
                         struct geom_line reversed[4]) {
  const struct geom_point at[4] = {{window->x0, window->y0, 0},
                                   {window->x1, window->y0, 0},
                                   {window->x1, window->y1, 0},
                                   {window->x0, window->y1, 0}};
  for (int k = 0; k < 4; k++) {
    geom_line_through(&line[k], at[k], at[(k + 1) % 4]);
    reversed[k] = geom_line_reversed(&line[k]);
  }
}

bool warnock_solve_face(struct warnock *w, const struct warnock_window *win,
                        uint32_t t) {
  struct geom_line border[8];
  const struct warnock_range *list[2] = {&win->surrounders, &win->facets};
  if (sheet_is_edge_on(w->sheet, t) || w->triangle_deferred[t])
    return true;
  window_lines(&win->box, border, border + 4);
  if (!occluder_subtraction_start(&w->subtraction, t, NULL))
    return false;
  struct geom_convex inside, *piece = w->subtraction.left.item;
  for (int k = 0; k < 4; k++, *piece = inside)
    if (!geom_convex_split(piece, &border[k], &border[4 + k], &inside, NULL,
                           &w->subtraction.arena))
      return false;
  if (piece->count == 0)
    return true;
  for (int l = 0; l < 2; l++) {
    const uint32_t *pool =
        l == 0 ? w->windows.surrounder_pool.item : w->windows.facet_pool.item;
    for (size_t i = list[l]->from; i < list[l]->to; i++) {
      uint32_t g = pool[i];
      if (occluder_subtraction_is_empty(&w->subtraction))
        return true;
      if (g != t && !sheet_is_edge_on(w->sheet, g) &&
          (!progress_step(&w->progress, 1 + w->subtraction.left.count) ||
           !occluder_subtraction_subtract_nearer(&w->subtraction, g)))
        return false;
    }
  }
  for (size_t i = 0; i < w->subtraction.left.count; i++) {
    struct triangle_piece part = {.triangle = t};
    if (!geom_convex_copy(&part.piece, &w->subtraction.left.item[i],
                          &w->arena) ||
        !ARRAY_PUSH(&w->piece, part))
      return false;
  }
  return w->piece.count < w->piece_limit || limit_pieces(w);
}

/* ---- All faces ----------------------------------------------------------- */

/* Adds the fragments of the deferred faces, solved by the fallback. */
static bool store_deferred_faces(struct warnock *w,
                                 struct pairwise_fallback *fallback,
                                 struct fragments *fragments) {
  ARRAY(uint32_t) left = {0};
  bool ok = true;
  for (uint32_t t = 0; ok && t < w->sheet->triangle.count; t++)
    if (w->triangle_deferred[t])
      ok = ARRAY_PUSH(&left, t);
  ok =
      ok && pairwise_fallback_faces(fallback, left.item, left.count, fragments);
  ARRAY_FREE(&left);
  return ok;
}

bool warnock_store_faces(struct warnock *w, struct pairwise_fallback *fallback,
                         const struct triangle_grid *grid, struct map *map,
                         struct report *report) {
  struct fragments fragments;
  geom_pieces piece = {0};
  size_t n = w->piece.count;
  bool ok = fragments_init(&fragments, w->sheet, grid, true) && sort_pieces(w);
  fragments.progress = &w->progress;
  fragments.report = report;
  for (size_t i = 0, j; ok && i < n; i = j) {
    piece.count = 0;
    for (j = i;
         ok && j < n && w->piece.item[j].triangle == w->piece.item[i].triangle;
         j++)
      ok = ARRAY_PUSH(&piece, w->piece.item[j].piece);
    ok = ok && (w->triangle_deferred[w->piece.item[i].triangle] ||
                fragments_add(&fragments, w->piece.item[i].triangle, piece.item,
                              piece.count));
  }
  if (w->any_deferred)
    ok = ok && store_deferred_faces(w, fallback, &fragments);
  ok = ok && fragments_finish(&fragments, map);
  ARRAY_FREE(&piece);
  fragments_fini(&fragments);
  return ok;
}
