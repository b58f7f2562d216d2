/* section.c - the arrays of a section: its nodes in order, and its end. */
#include "cut/section.h"

#include "base/sort.h"

/* ---- Nodes --------------------------------------------------------------- */

static int compare_section_nodes(const void *a, const void *b, void *user) {
  (void)user;
  return section_compare_nodes(a, b);
}

bool section_sort_nodes(struct section *section) {
  size_t kept = 0;
  struct section_node *node = section->node.item;
  if (!sort_stable(node, section->node.count, sizeof *node,
                   compare_section_nodes, NULL))
    return false;
  for (size_t i = 0; i < section->node.count; i++)
    if (kept == 0 || section_compare_nodes(&node[kept - 1], &node[i]) != 0)
      node[kept++] = node[i];
  section->node.count = kept;
  return true;
}

uint32_t section_node_at(const struct section *section, int64_t u, int64_t v) {
  const struct section_node at = {u, v, SECTION_NONE};
  size_t i;
  LOWER_BOUND(i, 0, section->node.count,
              section_compare_nodes(&section->node.item[i], &at) < 0);
  return i < section->node.count &&
                 section_compare_nodes(&section->node.item[i], &at) == 0
             ? (uint32_t)i
             : SECTION_NONE;
}

void section_fini(struct section *section) {
  ARRAY_FREE(&section->node);
  ARRAY_FREE(&section->segment);
  ARRAY_FREE(&section->path);
  ARRAY_FREE(&section->path_start);
  ARRAY_FREE(&section->line);
  ARRAY_FREE(&section->winding);
  ARRAY_FREE(&section->edge);
  ARRAY_FREE(&section->corner);
  ARRAY_FREE(&section->loop);
  mem_free(section->area);
  section->area = NULL;
}
