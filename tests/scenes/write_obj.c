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

/* An f or l statement, with a g before it where the group changes; *written is
 * the one that was written last. */
static void write_element(const struct scene *scene, struct stream *stream,
                          const char *keyword, const uint32_t *corner,
                          uint32_t count, uint32_t group, uint32_t *written) {
  if (group != *written) {
    *written = group;
    write_group(stream, scene->group.item[group].name);
  }
  stream_text(stream, keyword);
  for (uint32_t c = 0; c < count; c++) {
    stream_text(stream, " ");
    stream_int(stream, (int64_t)corner[c] + 1);
  }
  stream_text(stream, "\n");
}

void scene_write_obj(const struct scene *scene, struct stream *stream) {
  uint32_t group = SCENE_NONE;
  for (size_t i = 0; i < scene->point.count; i++)
    write_point(stream, &scene->point.item[i]);
  for (uint32_t f = 0; f < scene_face_count(scene); f++)
    write_element(
        scene, stream, "f", scene->corner.item + scene_face_start(scene, f),
        scene_face_corners(scene, f), scene_face_group(scene, f), &group);
  for (uint32_t w = 0; w < scene_wire_count(scene); w++) {
    const uint32_t *start = scene->wire_start.item + w;
    write_element(scene, stream, "l", scene->wire_corner.item + start[0],
                  start[1] - start[0], scene->wire_group.item[w], &group);
  }
}
