/* write_obj.c - writes a scene as OBJ text that reads back as the same scene.
 * */
#include "tests/scenes/write_obj.h"

#include "base/number.h"

static void write_point(struct stream *stream,
                        const struct scene_point *point) {
  const double xyz[3] = {point->x, point->y, point->z};
  char text[NUMBER_TEXT_SIZE];
  stream_text(stream, "v");
  for (int k = 0; k < 3; k++) {
    stream_text(stream, " ");
    stream_write(stream, text, number_format_exact(text, xyz[k]));
  }
  stream_text(stream, "\n");
}

/* Names come from files and callers: what would end the line becomes a
 * space. */
static void write_group(struct stream *stream, const char *name) {
  stream_text(stream, "g ");
  for (; *name; name++)
    stream_write(stream, *name == '\n' || *name == '\r' ? " " : name, 1);
  stream_text(stream, "\n");
}

/* One f or l statement for each element, with a g before it where the group
 * changes; *group is the one that was written last. */
static void write_elements(const struct scene *scene, struct stream *stream,
                           const char *keyword, const uint32_t *start,
                           const uint32_t *corner, const uint32_t *groups,
                           uint32_t count, uint32_t *group) {
  for (uint32_t i = 0; i < count; i++) {
    if (groups[i] != *group) {
      *group = groups[i];
      write_group(stream, scene->group.item[*group].name);
    }
    stream_text(stream, keyword);
    for (uint32_t c = start[i]; c < start[i + 1]; c++) {
      stream_text(stream, " ");
      stream_int(stream, (int64_t)corner[c] + 1);
    }
    stream_text(stream, "\n");
  }
}

void scene_write_obj(const struct scene *scene, struct stream *stream) {
  uint32_t group = SCENE_NONE;
  for (size_t i = 0; i < scene->point.count; i++)
    write_point(stream, &scene->point.item[i]);
  write_elements(scene, stream, "f", scene->face_start.item, scene->corner.item,
                 scene->face_group.item, scene_face_count(scene), &group);
  write_elements(scene, stream, "l", scene->wire_start.item,
                 scene->wire_corner.item, scene->wire_group.item,
                 scene_wire_count(scene), &group);
}
