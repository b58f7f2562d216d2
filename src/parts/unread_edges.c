/* unread_edges.c - finds the hidden edges that ink does not look at.
 *
 * Of an edge that is hidden, ink that draws no hidden lines reads only what
 * decides where lines end on the mesh: at a vertex of a crease that has no
 * other edge of a class.  So smooth edges matter at the ends of others alone;
 * with all edges drawn, nearly all edges that are hidden matter nowhere.
 * Fragments name the edges along their sides, whose classes ink reads. */
#include "parts/unread_edges.h"

#include "base/poll.h"

bool unread_edges_find(struct unread_edges *unread, const struct part *part,
                       const struct part_sources *from) {
  const struct part_common *common = &part->common;
  const struct sheet *sheet = from->sheet;
  *unread = (struct unread_edges){part, from, NULL};
  if ((common->edges & RECTO_EDGE_SMOOTH) == 0 || common->has_hidden ||
      common->has_fragments || from->map->edge_state == NULL)
    return true;
  unread->has_line = mem_calloc(sheet->point.count, 1);
  for (size_t e = 0; unread->has_line != NULL && e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    (void)poll_at(e);
    for (int k = 0; k < 2 && (edge->edge_class & ~RECTO_EDGE_SMOOTH) != 0; k++)
      unread->has_line[edge->point[k]] = 1;
  }
  return unread->has_line != NULL;
}

void unread_edges_fini(struct unread_edges *unread) {
  mem_free(unread->has_line);
  *unread = (struct unread_edges){.has_line = NULL};
}

/* Whether a point lies in a window, but not on its border: no other window has
 * it. */
static bool is_within_window(const struct part_window *window,
                             struct geom_point p) {
  return window->low[0] < p.x && p.x < window->high[0] &&
         window->low[1] < p.y && p.y < window->high[1];
}

bool unread_edges_have(const struct unread_edges *unread, uint32_t edge) {
  if (unread->has_line == NULL)
    return false;
  const struct sheet *sheet = unread->from->sheet;
  const struct map *map = unread->from->map;
  const struct sheet_edge *own = &sheet->edge.item[edge];
  if (own->edge_class != RECTO_EDGE_SMOOTH || edge >= map->edge_count ||
      map->edge_state[edge] != MAP_HIDDEN)
    return false;
  struct geom_segment s = sheet_ends(sheet, own->point);
  return !unread->has_line[own->point[0]] && !unread->has_line[own->point[1]] &&
         is_within_window(&unread->part->window, s.p) &&
         is_within_window(&unread->part->window, s.q);
}
