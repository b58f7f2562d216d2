/* layout_edge_choice.c - finds the class of each edge of the topology, and
 * which edges are to be made. */
#include "view/layout_edge_choice.h"

#include "base/memory.h"

bool layout_has_mesh_contours(const struct layout *layout, uint32_t point) {
  return layout->coarse == NULL || layout->coarse[point];
}

/* The classes of an edge in this view: the given ones, with silhouette in place
 * of smooth where it is one.  An edge that one face has twice (a bridge to a
 * hole, or a spike) lies inside that face and is no silhouette; nor is one
 * within a cut face.
 * still  the classes that do not depend on the camera */
static unsigned class_mask_of(const struct scene *scene,
                              const struct topology_edge *edge, unsigned still,
                              uint8_t sides) {
  if (edge->uses != 2 || edge->first == edge->second ||
      !layout_is_silhouette(sides) ||
      (still == 0 && topology_is_in_cut(scene, edge)))
    return still;
  return (still & ~(unsigned)RECTO_EDGE_SMOOTH) | RECTO_EDGE_SILHOUETTE;
}

/* On which sides of an edge its faces lie, where it has two.  By their flags it
 * is seen along the first face's way. */
static uint8_t sides_of_edge(const struct layout *layout, uint32_t edge) {
  const struct topology_edge *e = &layout->topology->edge.item[edge];
  const uint32_t face[2] = {e->first, e->second};
  uint8_t sides = 0;
  if (layout->sides != NULL)
    return layout->sides[edge];
  for (int k = 0; e->uses == 2 && k < 2; k++) {
    uint8_t flags = layout->flags.item[face[k]];
    if (flags != LAYOUT_NO_TRIANGLE)
      layout_record_side(&sides, k == 0 || e->same_way,
                         flags & SHEET_FLIPPED   ? -1
                         : flags & SHEET_EDGE_ON ? 0
                                                 : 1);
  }
  return sides;
}

bool layout_is_contour(const struct layout *layout, uint32_t edge) {
  return layout->topology->edge.item[edge].uses != 2 ||
         sides_of_edge(layout, edge) != LAYOUT_TWO_SIDED;
}

/* The requested class of an edge, of those that it has whatever the view. */
static unsigned requested_class(const struct layout *layout, uint32_t e,
                                unsigned still, uint8_t sides) {
  const struct topology_edge *edge = &layout->topology->edge.item[e];
  unsigned wanted = layout->options->ink.edges & LAYOUT_FACE_CLASSES;
  if (!layout_has_mesh_contours(layout, edge->point[0]))
    wanted &= ~(unsigned)RECTO_EDGE_SILHOUETTE;
  return topology_class_of_mask(
      class_mask_of(layout->scene, edge, still, sides) & wanted);
}

/* Whether no edge leaves the page: all faces were found to be on it. */
static bool is_all_on_page(const struct layout *layout) {
  return layout->face_range != NULL &&
         layout->flags.count == scene_face_count(layout->scene);
}

static bool leaves_page(const struct layout *layout, uint32_t e) {
  const uint32_t *point = layout->topology->edge.item[e].point;
  return layout_sheet_point(layout, point[0]) == SHEET_NONE ||
         layout_sheet_point(layout, point[1]) == SHEET_NONE;
}

/* What is read of all edges, as a copy. */
struct edge_choice {
  struct layout *layout;
  uint64_t *special;
  const struct topology_edge *edge;
  size_t edges;
  const uint8_t *sides, *flags; /* as in struct layout */
  uint8_t *class_masks;
  struct crease_filter filter;
  unsigned smooth; /* as a requested class, or 0 */
  bool all_edges, all_on_page;
};

static struct edge_choice edge_choice_of(struct layout *layout,
                                         uint64_t *special) {
  return (struct edge_choice){
      .layout = layout,
      .special = special,
      .edge = layout->topology->edge.item,
      .edges = layout->topology->edge.count,
      .sides = layout->sides,
      .flags = layout->flags.item,
      .class_masks = layout->class_masks,
      .filter = layout->filter,
      .smooth = layout->options->ink.edges & RECTO_EDGE_SMOOTH,
      .all_edges = layout->all_edges,
      .all_on_page = is_all_on_page(layout),
  };
}

/* Fetches what is read of the second face of an edge that comes later: those
 * of the first are in the order of the edges. */
MEM_PREFETCH_INLINE void prefetch_second_face(const struct edge_choice *c,
                                              size_t e) {
  if (e + MEM_PREFETCH_AHEAD >= c->edges)
    return;
  uint32_t face = c->edge[e + MEM_PREFETCH_AHEAD].second;
  if (face == TOPOLOGY_NONE)
    return;
  MEM_PREFETCH(&c->flags[face]);
  MEM_PREFETCH(&c->filter.direction[face]);
}

/* Whether an edge has two faces, one on each side of it, by the flags of
 * faces. */
static inline bool has_face_on_each_side(const struct edge_choice *c,
                                         size_t e) {
  const struct topology_edge *edge = &c->edge[e];
  return edge->uses == 2 &&
         layout_flags_are_two_sided(c->flags[edge->first],
                                    c->flags[edge->second], edge->same_way);
}

/* The same in any case. */
static inline bool is_between_sides(const struct edge_choice *c, size_t e) {
  return c->sides != NULL
             ? c->edge[e].uses == 2 && c->sides[e] == LAYOUT_TWO_SIDED
             : has_face_on_each_side(c, e);
}

/* Whether an edge has no class but smooth, as far as that is certain at
 * once. */
static inline bool is_plainly_smooth(const struct edge_choice *c, size_t e) {
  return c->filter.direction != NULL
             ? crease_filter_is_smooth(&c->filter, &c->edge[e])
             : c->class_masks != NULL && c->class_masks[e] == RECTO_EDGE_SMOOTH;
}

/* Chooses whether an edge is made, and its class.
 * between  is_between_sides
 * smooth   it has no class but that */
static inline void choose_class(const struct edge_choice *c, uint32_t e,
                                bool between, bool smooth) {
  struct layout *layout = c->layout;
  uint64_t bit = UINT64_C(1) << e % 64;
  bool made = c->all_edges;
  if (c->class_masks != NULL) {
    unsigned edge_class = c->smooth;
    if (!between || !smooth) {
      unsigned still = c->filter.direction != NULL
                           ? crease_filter_class_mask(&c->filter, &c->edge[e])
                           : c->class_masks[e];
      uint8_t sides = c->edge[e].uses == 2 ? sides_of_edge(layout, e) : 0;
      edge_class = requested_class(layout, e, still, sides);
    }
    c->class_masks[e] = (uint8_t)edge_class;
    made |= edge_class != 0;
  }
  if (made)
    layout->ids.bits[e / 64] |= bit;
  if (!between || (made && !c->all_on_page && leaves_page(layout, e)))
    c->special[e / 64] |= bit;
}

/* Chooses the requested edges of a range, and contours.  Most are smooth. */
static bool choose_edges(void *user, struct parallel_range range) {
  const struct edge_choice c = *(const struct edge_choice *)user;
  uint64_t *bits = c.layout->ids.bits;
  bool made = c.all_edges || c.smooth != 0,
       by_faces = c.sides == NULL && c.filter.direction != NULL;
  for (uint32_t e = (uint32_t)range.begin; e < range.end; e++) {
    if (by_faces)
      prefetch_second_face(&c, e);
    bool between = is_between_sides(&c, e),
         smooth = between && is_plainly_smooth(&c, e);
    if (smooth && c.all_on_page) {
      c.class_masks[e] = (uint8_t)c.smooth;
      bits[e / 64] |= (uint64_t)made << e % 64;
    } else {
      choose_class(&c, e, between, smooth);
    }
  }
  return true;
}

/* The same where smooth edges are not made, and neither sides nor classes of
 * all are there: most edges are passed over at once. */
static bool choose_few_edges(void *user, struct parallel_range range) {
  const struct edge_choice c = *(const struct edge_choice *)user;
  for (size_t e = range.begin; e < range.end; e++) {
    prefetch_second_face(&c, e);
    bool between = has_face_on_each_side(&c, e),
         smooth = between && crease_filter_is_smooth(&c.filter, &c.edge[e]);
    if (!smooth)
      choose_class(&c, (uint32_t)e, between, smooth);
  }
  return true;
}

/* The same where the classes of all are there. */
static bool choose_few_classed_edges(void *user, struct parallel_range range) {
  const struct edge_choice c = *(const struct edge_choice *)user;
  for (size_t e = range.begin; e < range.end; e++) {
    bool between = is_between_sides(&c, e),
         smooth = c.class_masks[e] == RECTO_EDGE_SMOOTH;
    if (between && smooth)
      c.class_masks[e] = 0;
    else
      choose_class(&c, (uint32_t)e, between, smooth);
  }
  return true;
}

bool layout_choose_edges(struct layout *layout, uint64_t *special) {
  struct edge_choice choice = edge_choice_of(layout, special);
  size_t edges = layout->topology->edge.count;
  bool are_few = !choice.all_edges && choice.smooth == 0;
  parallel_task *task = choose_edges;
  if (are_few && choice.filter.direction != NULL && choice.sides == NULL)
    task = choose_few_edges;
  else if (are_few && choice.filter.direction == NULL &&
           choice.class_masks != NULL)
    task = choose_few_classed_edges;
  return parallel_ranges(parallel_workers(edges, LAYOUT_EDGES_IN_RANGE), edges,
                         LAYOUT_EDGES_IN_RANGE, task, &choice);
}
