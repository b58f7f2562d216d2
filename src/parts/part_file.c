/* part_file.c - writes and reads parts, by one description of the format. */
#include "parts/part_file.h"

#include <math.h>
#include <string.h>

#include "parts/part_common.h"
#include "scene/edges/crease_marks.h"
#include "scene/limit.h"

static const unsigned char magic[8] = {'r', 'e', 'c', 't', 'o', 'p', 't', '\n'};
enum { FORMAT_VERSION = 4, SUM_SIZE = 8, HEAD_SIZE = 8 + 4 + 8 };

/* Sizes of items, at least, in bytes. */
enum {
  POINT_SIZE = 28,
  ELEMENT_SIZE = 12,
  NUMBER_SIZE = 4,
  INTERVAL_SIZE = 64,
  EDGE_SIZE = 12,
  CROSSING_SIZE = 53,
  RUN_SIZE = 16,
  FRAGMENT_SIZE = 8,
  CORNER_SIZE = 25,
  KEY_SIZE = 9,
  PLACE_SIZE = 17,    /* of a corner: the rest depends on its side, */
  ALONG_SIZE_MAX = 12 /* and is no more than this */
};

/* ---- Lists --------------------------------------------------------------- */

static void code_points(struct byte_codec *codec, struct part *part) {
  BYTE_CODEC_LIST(codec, &part->point, POINT_SIZE);
  for (size_t p = 0; p < part->point.count && !codec->failed; p++) {
    struct part_point *point = &part->point.item[p];
    struct byte_record record = byte_codec_record(codec, POINT_SIZE);
    byte_record_u32(&record, &point->number);
    byte_record_double(&record, &point->at.x);
    byte_record_double(&record, &point->at.y);
    byte_record_double(&record, &point->at.z);
    byte_codec_require(codec, isfinite(point->at.x) && isfinite(point->at.y) &&
                                  isfinite(point->at.z) &&
                                  point->number < SCENE_LIMIT &&
                                  (p == 0 || point->number > point[-1].number));
  }
}

/* Faces or polylines of at least so many corners.  Their corners follow one
 * another in the list of corners. */
static void code_element(struct byte_codec *codec, struct part *part,
                         struct part_element *element, bool is_first,
                         uint32_t least) {
  bool has_ids = part->common.has_ids;
  if (!codec->writes)
    *element = (struct part_element){.number = 0};
  struct byte_record record =
      byte_codec_record(codec, ELEMENT_SIZE + (has_ids ? NUMBER_SIZE : 0));
  byte_record_u32(&record, &element->number);
  byte_record_u32(&record, &element->group);
  if (has_ids)
    byte_record_u32(&record, &element->in_group);
  byte_record_u32(&record, &element->count);
  if (codec->writes) {
    byte_codec_numbers(codec, part->corner.item + element->corner,
                       element->count);
    return;
  }
  byte_codec_require(codec,
                     element->group < part->common.group.count &&
                         element->count >= least &&
                         element->count <= codec->left / NUMBER_SIZE &&
                         part->corner.count + element->count < SCENE_LIMIT &&
                         element->number < SCENE_LIMIT &&
                         (is_first || element->number > element[-1].number));
  element->corner = (uint32_t)part->corner.count;
  if (codec->failed)
    return;
  if (!ARRAY_RESERVE(&part->corner, element->count)) {
    codec->failed = codec->out_of_memory = true;
    return;
  }
  byte_codec_numbers(codec, part->corner.item + part->corner.count,
                     element->count);
  part->corner.count += element->count;
}

/* The tones of a face: one where it is uniform, else one a corner.  They follow
 * one another in the list of tones. */
static void code_tones(struct byte_codec *codec, struct part *part,
                       struct part_element *face) {
  bool uniform = face->uniform;
  if (!part->common.has_tones)
    return;
  byte_codec_bool(codec, &uniform);
  face->uniform = uniform;
  float tone = 0;
  for (uint32_t i = 0; i < face->count && !codec->failed; i++) {
    if (codec->writes)
      tone = part->tone.item[face->corner + i];
    if (i == 0 || !uniform)
      byte_codec_float(codec, &tone);
    byte_codec_require(codec, tone >= 0 && tone <= 1);
    if (!codec->writes && !ARRAY_PUSH(&part->tone, tone))
      codec->failed = codec->out_of_memory = true;
  }
}

/* The marks of the sides likewise. */
static void code_marks(struct byte_codec *codec, struct part *part,
                       const struct part_element *face) {
  uint32_t sides = part->common.has_marks ? face->count : 0;
  for (uint32_t i = 0; i < sides && !codec->failed; i++) {
    uint8_t mark = codec->writes ? part->mark.item[face->corner + i] : 0;
    byte_codec_u8(codec, &mark);
    byte_codec_require(codec, mark <= CREASE_MARK_SOFT);
    if (!codec->writes && !ARRAY_PUSH(&part->mark, mark))
      codec->failed = codec->out_of_memory = true;
  }
}

static void code_face(struct byte_codec *codec, struct part *part,
                      struct part_element *face, bool is_first) {
  code_element(codec, part, face, is_first, 3);
  code_tones(codec, part, face);
  code_marks(codec, part, face);
}

static void code_elements(struct byte_codec *codec, struct part *part) {
  BYTE_CODEC_LIST(codec, &part->face, ELEMENT_SIZE);
  for (size_t f = 0; f < part->face.count && !codec->failed; f++)
    code_face(codec, part, &part->face.item[f], f == 0);
  BYTE_CODEC_LIST(codec, &part->wire, ELEMENT_SIZE);
  for (size_t w = 0; w < part->wire.count && !codec->failed; w++)
    code_element(codec, part, &part->wire.item[w], w == 0, 2);
}

static void code_interval(struct byte_codec *codec,
                          struct map_interval *interval) {
  byte_codec_ratio(codec, &interval->t0);
  byte_codec_ratio(codec, &interval->t1);
  byte_codec_require(codec, !codec->failed &&
                                ratio_compare(interval->t0, interval->t1) < 0);
}

static void code_intervals(struct byte_codec *codec, struct part *part) {
  BYTE_CODEC_LIST(codec, &part->interval, INTERVAL_SIZE);
  for (size_t i = 0; i < part->interval.count && !codec->failed; i++)
    code_interval(codec, &part->interval.item[i]);
  if (part->common.hidden_by_max == 0)
    return;
  BYTE_CODEC_LIST(codec, &part->over_limit, INTERVAL_SIZE);
  for (size_t i = 0; i < part->over_limit.count && !codec->failed; i++)
    code_interval(codec, &part->over_limit.item[i]);
}

/* Those over the limit likewise, where there is one. */
static void code_over_limit(struct byte_codec *codec, const struct part *part,
                            struct part_over_limit *over, size_t *next) {
  if (!codec->writes)
    *over = (struct part_over_limit){(uint32_t)*next, 0};
  if (part->common.hidden_by_max == 0)
    return;
  byte_codec_u32(codec, &over->count);
  if (codec->writes)
    return;
  byte_codec_require(codec, over->count <= part->over_limit.count - *next);
  *next += codec->failed ? 0 : over->count;
  const struct map_interval *interval = part->over_limit.item;
  for (size_t i = over->interval + 1u; i < *next; i++)
    byte_codec_require(codec,
                       ratio_compare(interval[i - 1].t1, interval[i].t0) < 0);
}

/* The intervals that go with a state.  Those of edges follow one another.
 * next  how many were used before; grows */
static void code_visibility(struct byte_codec *codec, const struct part *part,
                            struct part_visibility *visibility, size_t *next) {
  if (!codec->writes)
    visibility->count = 0;
  if (visibility->state == MAP_MIXED)
    byte_codec_u32(codec, &visibility->count);
  if (codec->writes)
    return;
  byte_codec_require(
      codec, visibility->state <= MAP_MIXED &&
                 (visibility->state != MAP_MIXED || visibility->count > 0) &&
                 visibility->count <= part->interval.count - *next);
  visibility->interval = (uint32_t)*next;
  *next += codec->failed ? 0 : visibility->count;
  const struct map_interval *interval = part->interval.item;
  for (size_t i = visibility->interval + 1u; i < *next; i++)
    byte_codec_require(codec,
                       ratio_compare(interval[i - 1].t1, interval[i].t0) <= 0);
}

static void code_key(struct byte_codec *codec, struct byte_record *record,
                     struct part_edge_key *key) {
  byte_record_u8(record, &key->kind);
  byte_record_u32(record, &key->element);
  byte_record_u32(record, &key->place);
  byte_codec_require(codec, key->kind <= PART_EDGE_OF_WIRE &&
                                key->element < SCENE_LIMIT &&
                                key->place < SCENE_LIMIT);
}

static bool is_one_class(unsigned edge_class) {
  return edge_class != 0 && (edge_class & (edge_class - 1)) == 0 &&
         edge_class <= RECTO_EDGES_ALL && edge_class != RECTO_EDGE_INTERSECTION;
}

static void code_edges(struct byte_codec *codec, struct part *part) {
  size_t next = 0, next_over = 0;
  BYTE_CODEC_LIST(codec, &part->edge, EDGE_SIZE);
  for (size_t e = 0; e < part->edge.count && !codec->failed; e++) {
    struct part_edge *edge = &part->edge.item[e];
    struct byte_record record = byte_codec_record(codec, EDGE_SIZE);
    code_key(codec, &record, &edge->key);
    byte_record_u16(&record, &edge->edge_class);
    byte_record_u8(&record, &edge->visibility.state);
    code_visibility(codec, part, &edge->visibility, &next);
    code_over_limit(codec, part, &edge->over_limit, &next_over);
    bool is_wire = edge->key.kind == PART_EDGE_OF_WIRE;
    byte_codec_require(
        codec,
        is_one_class(edge->edge_class) &&
            (edge->edge_class == RECTO_EDGE_WIRE) == is_wire &&
            (e == 0 || part_edge_key_compare(edge[-1].key, edge->key) < 0));
  }
  BYTE_CODEC_LIST(codec, &part->crossing, CROSSING_SIZE - 4);
  for (size_t i = 0; i < part->crossing.count && !codec->failed; i++) {
    struct part_crossing *crossing = &part->crossing.item[i];
    for (int k = 0; k < 2; k++) {
      byte_codec_u32(codec, &crossing->triangle[k].face);
      byte_codec_u32(codec, &crossing->triangle[k].place);
      struct geom_point *end = &crossing->end[k];
      int64_t xyz[3] = {end->x, end->y, end->z};
      for (int axis = 0; axis < 3; axis++)
        byte_codec_i64(codec, &xyz[axis]);
      byte_codec_require(
          codec, xyz[0] >= -SHEET_XY_MAX && xyz[0] <= SHEET_XY_MAX &&
                     xyz[1] >= -SHEET_XY_MAX && xyz[1] <= SHEET_XY_MAX &&
                     xyz[2] >= 0 && xyz[2] <= SHEET_Z_MAX);
      if (!codec->writes && !codec->failed)
        *end = (struct geom_point){(int32_t)xyz[0], (int32_t)xyz[1], xyz[2]};
    }
    byte_codec_u8(codec, &crossing->visibility.state);
    code_visibility(codec, part, &crossing->visibility, &next);
    code_over_limit(codec, part, &crossing->over_limit, &next_over);
    byte_codec_require(codec, part_triangle_compare(crossing->triangle[0],
                                                    crossing->triangle[1]) < 0);
  }
}

static void code_runs(struct byte_codec *codec, struct part *part) {
  if (!part->common.has_ids)
    return;
  BYTE_CODEC_LIST(codec, &part->run, RUN_SIZE);
  for (size_t r = 0; r < part->run.count && !codec->failed; r++) {
    struct part_edge_run *run = &part->run.item[r];
    byte_codec_u32(codec, &run->face);
    byte_codec_u32(codec, &run->place);
    byte_codec_u32(codec, &run->group);
    byte_codec_u32(codec, &run->count);
    byte_codec_require(
        codec, run->group < part->common.group.count && run->count > 0 &&
                   (r == 0 || part_edge_run_compare(&run[-1], run) < 0));
  }
}

/* ---- Fragments ----------------------------------------------------------- */

static void code_corner(struct byte_codec *codec, struct part_corner *corner) {
  const int64_t most = (int64_t)SHEET_XY_MAX * MAP_CORNER_SCALE;
  if (!codec->writes)
    *corner = (struct part_corner){.x = 0};
  struct byte_record record = byte_codec_record(codec, PLACE_SIZE);
  byte_record_i64(&record, &corner->x);
  byte_record_i64(&record, &corner->y);
  byte_record_u8(&record, &corner->side);
  if (corner->side == MAP_SIDE_EDGE || corner->side == MAP_SIDE_OCCLUDER) {
    record = byte_codec_record(codec, KEY_SIZE);
    code_key(codec, &record, &corner->along.edge);
    byte_codec_require(codec, corner->along.edge.kind <= PART_EDGE_FOLD);
  } else {
    byte_codec_u32(codec, &corner->along.of.line[0]);
    byte_codec_u32(codec, &corner->along.of.line[1]);
    if (corner->side == MAP_SIDE_INTERSECTION)
      byte_codec_u32(codec, &corner->along.of.face);
  }
  byte_codec_require(codec, corner->side <= MAP_SIDE_CLIP &&
                                corner->x >= -most && corner->x <= most &&
                                corner->y >= -most && corner->y <= most);
}

static void code_loops(struct byte_codec *codec, struct part *part,
                       struct part_fragment *fragment) {
  if (!codec->writes) {
    byte_codec_require(codec,
                       fragment->loops > 0 &&
                           fragment->loops <= codec->left / NUMBER_SIZE &&
                           part->loop.count + fragment->loops < SCENE_LIMIT);
    fragment->loop = (uint32_t)part->loop.count;
  }
  for (uint32_t l = 0; l < fragment->loops && !codec->failed; l++) {
    uint32_t count = codec->writes ? part->loop.item[fragment->loop + l] : 0;
    byte_codec_u32(codec, &count);
    byte_codec_require(codec, count >= 3 && count <= codec->left / CORNER_SIZE);
    if (!codec->writes && !codec->failed && !ARRAY_PUSH(&part->loop, count))
      codec->failed = codec->out_of_memory = true;
  }
}

static void code_fragments(struct byte_codec *codec, struct part *part) {
  size_t corner = 0;
  BYTE_CODEC_LIST(codec, &part->fragment, FRAGMENT_SIZE);
  for (size_t f = 0; f < part->fragment.count && !codec->failed; f++) {
    struct part_fragment *fragment = &part->fragment.item[f];
    byte_codec_u32(codec, &fragment->face);
    byte_codec_u32(codec, &fragment->loops);
    code_loops(codec, part, fragment);
    byte_codec_require(codec, f == 0 || fragment->face >= fragment[-1].face);
    for (uint32_t l = 0; l < fragment->loops && !codec->failed; l++)
      for (uint32_t k = 0;
           k < part->loop.item[fragment->loop + l] && !codec->failed; k++) {
        struct part_corner own = {.x = 0};
        if (codec->writes)
          own = part->fragment_corner.item[corner++];
        code_corner(codec, &own);
        if (!codec->writes && !ARRAY_PUSH(&part->fragment_corner, own))
          codec->failed = codec->out_of_memory = true;
      }
  }
}

static void code_part(struct byte_codec *codec, struct part *part) {
  part_common_code(codec, &part->common);
  byte_codec_u32(codec, &part->index);
  for (int k = 0; k < 2; k++) {
    byte_codec_u32(codec, (uint32_t *)&part->window.low[k]);
    byte_codec_u32(codec, (uint32_t *)&part->window.high[k]);
  }
  byte_codec_require(codec, part->index < part->common.parts);
  code_points(codec, part);
  code_elements(codec, part);
  code_intervals(codec, part);
  code_edges(codec, part);
  code_runs(codec, part);
  code_fragments(codec, part);
}

/* ---- Files --------------------------------------------------------------- */

/* About how many bytes a part takes: most, as the longest lists are counted.
 * With room for them from the start nothing is copied as the bytes grow. */
static size_t estimate_size(const struct part *part) {
  return part->point.count * POINT_SIZE +
         (part->face.count + part->wire.count) * (ELEMENT_SIZE + NUMBER_SIZE) +
         part->corner.count * NUMBER_SIZE + part->tone.count * sizeof(float) +
         part->mark.count + part->interval.count * INTERVAL_SIZE +
         part->edge.count * EDGE_SIZE + part->crossing.count * CROSSING_SIZE +
         part->run.count * RUN_SIZE +
         (part->fragment.count * 2 + part->loop.count) * NUMBER_SIZE +
         part->fragment_corner.count * (PLACE_SIZE + ALONG_SIZE_MAX);
}

recto_status part_file_make(struct part *part, struct byte_array *bytes,
                            recto_error *error) {
  struct byte_codec codec = {.writes = true};
  uint32_t version = FORMAT_VERSION;
  uint64_t size = 0, sum = 0;
  (void)byte_codec_grow_by(&codec, HEAD_SIZE + estimate_size(part) + SUM_SIZE);
  for (size_t i = 0; i < sizeof magic; i++) {
    uint8_t byte = magic[i];
    byte_codec_u8(&codec, &byte);
  }
  byte_codec_u32(&codec, &version);
  byte_codec_u64(&codec, &size);
  code_part(&codec, part);
  if (!codec.failed) {
    size = codec.bytes.count + SUM_SIZE;
    for (int i = 0; i < 8; i++)
      codec.bytes.item[sizeof magic + 4 + (size_t)i] =
          (char)(size >> 8 * i & 0xff);
    sum = byte_codec_checksum(codec.bytes.item, codec.bytes.count);
    byte_codec_u64(&codec, &sum);
  }
  if (codec.failed) {
    ARRAY_FREE(&codec.bytes);
    return error_memory(error);
  }
  *bytes = codec.bytes;
  return RECTO_OK;
}

static recto_status refuse(const char *path, const char *why,
                           recto_error *error) {
  return error_set(error, RECTO_ERROR_FORMAT, path, 0, "%s", why);
}

/* Checks the frame of a file: whether it is one, of this version, and whole. */
static recto_status check_frame(const unsigned char *bytes, size_t count,
                                const char *path, recto_error *error) {
  if (count < HEAD_SIZE + SUM_SIZE || memcmp(bytes, magic, sizeof magic) != 0)
    return refuse(path,
                  count < HEAD_SIZE + SUM_SIZE &&
                          memcmp(bytes, magic,
                                 count < sizeof magic ? count : sizeof magic) ==
                              0
                      ? "the part is cut short"
                      : "this is no part of a drawing",
                  error);
  struct byte_codec codec = {.at = bytes + sizeof magic,
                             .left = count - sizeof magic};
  uint32_t version = 0;
  uint64_t size = 0, sum = 0;
  byte_codec_u32(&codec, &version);
  byte_codec_u64(&codec, &size);
  if (version != FORMAT_VERSION)
    return error_set(error, RECTO_ERROR_UNSUPPORTED, path, 0,
                     "the part is of format %lu, and this program reads "
                     "format %d",
                     (unsigned long)version, FORMAT_VERSION);
  if (count < size)
    return refuse(path, "the part is cut short", error);
  codec.at = bytes + count - SUM_SIZE;
  codec.left = SUM_SIZE;
  byte_codec_u64(&codec, &sum);
  if (count > size || sum != byte_codec_checksum(bytes, count - SUM_SIZE))
    return refuse(path, "the part is damaged: its checksum is wrong", error);
  return RECTO_OK;
}

recto_status part_file_parse(struct part *part, const void *bytes, size_t count,
                             const char *path, recto_error *error) {
  struct byte_codec codec = {.at = (const unsigned char *)bytes + HEAD_SIZE};
  *part = (struct part){.index = 0};
  recto_status status = check_frame(bytes, count, path, error);
  if (status != RECTO_OK)
    return status;
  codec.left = count - HEAD_SIZE - SUM_SIZE;
  code_part(&codec, part);
  if (!codec.failed && codec.left == 0)
    return RECTO_OK;
  part_fini(part);
  return codec.out_of_memory
             ? error_memory(error)
             : refuse(path, "the part is damaged: a value is out of range",
                      error);
}
