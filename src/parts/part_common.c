/* part_common.c - what all parts of a drawing have in common, as bytes. */
#include "parts/part_common.h"

#include <limits.h>
#include <math.h>

#include "parts/page_windows.h"

/* Sizes of items, at least, in bytes. */
enum { GROUP_SIZE = 14, PRECISION_SIZE = 21 };

static void code_precision(struct byte_codec *codec,
                           struct precision *precision) {
  byte_codec_doubles(codec, &precision->absolute, 1);
  byte_codec_doubles(codec, &precision->relative, 1);
  byte_codec_require(codec,
                     precision->absolute >= 0 && precision->relative >= 0);
}

static void code_camera(struct byte_codec *codec, struct camera *camera) {
  byte_codec_doubles(codec, camera->right, 3);
  byte_codec_doubles(codec, camera->up, 3);
  byte_codec_doubles(codec, camera->back, 3);
  byte_codec_doubles(codec, camera->eye, 3);
  byte_codec_bool(codec, &camera->perspective);
  byte_codec_doubles(codec, &camera->s, 1);
  byte_codec_doubles(codec, camera->middle_mm, 2);
  byte_codec_doubles(codec, &camera->near_d, 1);
  byte_codec_doubles(codec, &camera->d_min, 1);
  byte_codec_doubles(codec, &camera->d_max, 1);
  byte_codec_doubles(codec, camera->page_mm, 2);
  byte_codec_doubles(codec, &camera->margin_mm, 1);
  byte_codec_doubles(codec, &camera->size, 1);
  byte_codec_doubles(codec, &camera->contact, 1);
  byte_codec_doubles(codec, &camera->contact_most, 1);
  byte_codec_doubles(codec, &camera->error, 1);
  code_precision(codec, &camera->unstated);
  byte_codec_bool(codec, &camera->near_chosen);
  camera->all_on_page = true;
  for (int k = 0; k < 2; k++)
    byte_codec_require(codec, camera->page_mm[k] > 0 &&
                                  camera->page_mm[k] <= 2000 &&
                                  camera->margin_mm >= 0 &&
                                  2 * camera->margin_mm < camera->page_mm[k] &&
                                  fabs(camera->middle_mm[k]) <= 1e9);
  byte_codec_require(codec, camera->s > 0 && camera->d_min <= camera->d_max &&
                                camera->near_d <= camera->d_min &&
                                (!camera->perspective || camera->near_d > 0));
}

/* Is added to the colour of a group that has no name of its own. */
#define NAMELESS UINT32_C(0x1000000)

static void code_groups(struct byte_codec *codec, struct part_common *common) {
  BYTE_CODEC_LIST(codec, &common->group, GROUP_SIZE);
  for (size_t g = 0; g < common->group.count; g++) {
    struct scene_group *group = &common->group.item[g];
    if (!codec->writes)
      *group = (struct scene_group){.name = NULL};
    byte_codec_text(codec, &group->name);
    uint32_t colour = group->colour | (group->is_nameless ? NAMELESS : 0);
    byte_codec_u32(codec, &colour);
    group->colour = colour & 0xffffff;
    group->is_nameless = (colour & NAMELESS) != 0;
    byte_codec_bool(codec, &group->has_colour);
    byte_codec_bool(codec, &group->is_shade);
    byte_codec_require(codec, colour <= (0xffffff | NAMELESS));
  }
}

static void code_precisions(struct byte_codec *codec,
                            struct part_common *common) {
  BYTE_CODEC_LIST(codec, &common->precision, PRECISION_SIZE);
  for (size_t r = 0; r < common->precision.count; r++) {
    struct precision_range *range = &common->precision.item[r];
    byte_codec_u32(codec, &range->first_point);
    byte_codec_bool(codec, &range->stated);
    code_precision(codec, &range->precision);
    byte_codec_require(codec,
                       r == 0 || range->first_point > range[-1].first_point);
  }
}

void part_common_code(struct byte_codec *codec, struct part_common *common) {
  byte_codec_u64(codec, &common->id);
  byte_codec_u32(codec, &common->parts);
  byte_codec_u32(codec, &common->edges);
  byte_codec_bool(codec, &common->has_fragments);
  byte_codec_bool(codec, &common->has_hidden);
  byte_codec_u32(codec, &common->hidden_by_max);
  byte_codec_bool(codec, &common->has_ids);
  byte_codec_bool(codec, &common->has_tones);
  if (common->has_tones)
    byte_codec_doubles(codec, common->light, PART_LIGHT);
  byte_codec_bool(codec, &common->has_marks);
  byte_codec_doubles(codec, &common->crease_deg, 1);
  byte_codec_doubles(codec, &common->crease_start_deg, 1);
  code_camera(codec, &common->camera);
  byte_codec_u32(codec, &common->camera_kind);
  byte_codec_doubles(codec, &common->azimuth_deg, 1);
  byte_codec_doubles(codec, &common->elevation_deg, 1);
  byte_codec_doubles(codec, common->eye, 3);
  byte_codec_doubles(codec, &common->fov_deg, 1);
  byte_codec_text(codec, &common->path);
  code_groups(codec, common);
  code_precisions(codec, common);
  byte_codec_require(codec,
                     common->parts > 0 && common->parts <= PAGE_WINDOWS_MAX &&
                         common->edges <= RECTO_EDGES_ALL &&
                         common->hidden_by_max <= INT_MAX &&
                         (common->has_hidden || common->hidden_by_max == 0) &&
                         common->crease_deg >= 0 && common->crease_deg <= 180 &&
                         common->crease_start_deg >= 0 &&
                         common->crease_start_deg <= 180 &&
                         common->camera_kind <= RECTO_CAMERA_EYE &&
                         common->fov_deg >= 0 && common->fov_deg <= 179);
}

unsigned part_common_classes(const struct part_common *common) {
  bool has_two_angles = common->crease_start_deg > common->crease_deg;
  return has_two_angles &&
                 (common->edges & (RECTO_EDGE_CREASE | RECTO_EDGE_SMOOTH))
             ? common->edges | RECTO_EDGE_CREASE | RECTO_EDGE_SILHOUETTE
             : common->edges;
}

recto_status part_common_checksum(struct part_common *common, uint64_t *sum,
                                  recto_error *error) {
  struct byte_codec codec = {.writes = true};
  uint64_t id = common->id;
  common->id = 0;
  part_common_code(&codec, common);
  common->id = id;
  *sum = byte_codec_checksum(codec.bytes.item, codec.bytes.count);
  ARRAY_FREE(&codec.bytes);
  return codec.failed ? error_memory(error) : RECTO_OK;
}
