/* test_least_model.c - nothing is modelled that was not asked for, by any exact
 * method on any scene of the list: the sheet and the visible map have what the
 * request needs and nothing else. */
#include "tests/scenes/exact.h"
#include "tests/scenes/pipeline.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* What a case asks for, and how it looks at the result. */
struct request {
  unsigned edges;
  recto_fill fill;
  recto_hidden hidden;
  void (*look)(const struct pipeline *pipeline, const char *name);
};

static void draw_all(const struct request *request) {
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++)
    for (const struct solver *const *s = solvers(); *s != NULL; s++) {
      struct scene scene;
      recto_options options;
      struct pipeline pipeline;
      if (!is_exact(*s))
        continue;
      pipeline_fill(&scene, &options, entry);
      options.ink.edges = request->edges;
      options.ink.fill = request->fill;
      options.ink.hidden = request->hidden;
      pipeline_run(&pipeline, &scene, &options, *s);
      if (pipeline.status == RECTO_OK)
        request->look(&pipeline, entry->name);
      else
        assert_int_equal(pipeline.status, RECTO_ERROR_EMPTY);
      pipeline_fini(&pipeline);
      scene_fini(&scene);
    }
}

/* ---- Lines --------------------------------------------------------------- */

static void look_for_faces(const struct pipeline *p, const char *name) {
  if (p->map.fragment.count + p->map.loop.count + p->map.corner.count +
          p->map.half_edge.count >
      0)
    fail_msg("%s: fragments for lines alone", name);
  if (p->drawing.fill.count > 0)
    fail_msg("%s: fills for lines alone", name);
}

static void lines_alone_make_no_fragments(void **state) {
  (void)state;
  draw_all(&(struct request){RECTO_EDGES_ALL, RECTO_FILL_NONE,
                             RECTO_HIDDEN_NONE, look_for_faces});
}

static void look_for_other_classes(const struct pipeline *p, const char *name) {
  for (size_t e = 0; e < p->sheet.edge.count; e++)
    if (p->sheet.edge.item[e].edge_class != RECTO_EDGE_SILHOUETTE)
      fail_msg("%s: an edge of class %d was laid out", name,
               p->sheet.edge.item[e].edge_class);
}

static void edges_that_are_not_drawn_are_not_laid_out(void **state) {
  (void)state;
  draw_all(&(struct request){RECTO_EDGE_SILHOUETTE, RECTO_FILL_NONE,
                             RECTO_HIDDEN_NONE, look_for_other_classes});
}

/* ---- Intersections ------------------------------------------------------- */

static void look_for_intersections(const struct pipeline *p, const char *name) {
  if (report_get(p->report, "intersections", "pairs_tested", -1) != -1)
    fail_msg("%s: intersections were looked for", name);
  for (size_t e = 0; e < p->sheet.edge.count; e++)
    if (p->sheet.edge.item[e].edge_class == RECTO_EDGE_INTERSECTION)
      fail_msg("%s: an intersection was made", name);
}

static void intersections_that_are_not_drawn_are_not_found(void **state) {
  const unsigned others = RECTO_EDGES_ALL & ~(unsigned)RECTO_EDGE_INTERSECTION;
  (void)state;
  draw_all(&(struct request){others, RECTO_FILL_NONE, RECTO_HIDDEN_NONE,
                             look_for_intersections});
  draw_all(&(struct request){others, RECTO_FILL_PAINT, RECTO_HIDDEN_LAYER,
                             look_for_intersections});
}

/* ---- Hidden parts -------------------------------------------------------- */

static void look_for_hidden_parts(const struct pipeline *p, const char *name) {
  const struct map *map = &p->map;
  if (map->over_limit.count + map->over_limit_interval.count +
          map->invisible.count + map->invisible_interval.count >
      0)
    fail_msg("%s: hidden parts were counted", name);
  for (size_t i = 0; i < p->drawing.layer.count; i++)
    if (strstr(p->drawing.layer.item[i].label, "hidden") != NULL)
      fail_msg("%s: a layer of hidden lines", name);
}

static void hidden_parts_that_are_dropped_are_not_made(void **state) {
  (void)state;
  draw_all(&(struct request){RECTO_EDGES_ALL, RECTO_FILL_NONE,
                             RECTO_HIDDEN_NONE, look_for_hidden_parts});
}

/* ---- Faces --------------------------------------------------------------- */

static void look_for_lines(const struct pipeline *p, const char *name) {
  if (p->map.edge_state != NULL || p->map.interval.count > 0)
    fail_msg("%s: lines for faces alone", name);
  if (report_get(p->report, "occlusion", "pairs", 0) != 0)
    fail_msg("%s: edges were compared with faces", name);
  look_for_intersections(p, name);
}

static void faces_alone_make_no_lines(void **state) {
  (void)state;
  draw_all(&(struct request){RECTO_EDGES_NONE, RECTO_FILL_PAINT,
                             RECTO_HIDDEN_NONE, look_for_lines});
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lines_alone_make_no_fragments),
      cmocka_unit_test(edges_that_are_not_drawn_are_not_laid_out),
      cmocka_unit_test(intersections_that_are_not_drawn_are_not_found),
      cmocka_unit_test(hidden_parts_that_are_dropped_are_not_made),
      cmocka_unit_test(faces_alone_make_no_lines),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
