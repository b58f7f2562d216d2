/* plan_file.c - writes and reads the frame of a plan: its head, the list of its
 * sections, and its end, from which it is read. */
#include "parts/plan_file.h"

#include <string.h>

#include "parts/part_common.h"

static const unsigned char head_magic[8] = {'r', 'e', 'c', 't',
                                            'o', 'p', 'l', '\n'};
static const unsigned char end_magic[8] = {'\n', 'r', 'e', 'c',
                                           't',  'o', 'p', 'l'};
enum {
  PLAN_VERSION = 2,
  HEAD_BYTES = PLAN_BLOCK,
  END_BYTES = 8 + 8 + 8, /* size of the list, its checksum, magic */
  PLACE_SIZE = 24
};

static struct plan_section_form form_of(const struct part_common *common) {
  return (struct plan_section_form){common->has_ids, common->has_tones,
                                    common->has_marks,
                                    (uint32_t)common->group.count};
}

static void code_magic(struct byte_codec *codec, const unsigned char magic[8]) {
  for (int i = 0; i < 8; i++) {
    uint8_t byte = magic[i];
    byte_codec_u8(codec, &byte);
    byte_codec_require(codec, byte == magic[i]);
  }
}

/* What stands behind the sections, but for the end. */
static void code_list(struct byte_codec *codec, struct part_common *common,
                      double *weld, struct plan_place *section) {
  for (uint32_t i = 0; i < common->parts; i++) {
    byte_codec_u64(codec, &section[i].place);
    byte_codec_u64(codec, &section[i].size);
    byte_codec_u64(codec, &section[i].sum);
  }
  byte_codec_doubles(codec, weld, 1);
  byte_codec_require(codec, *weld >= 0);
}

/* ---- Writing ------------------------------------------------------------- */

void plan_writer_begin(struct plan_writer *writer, struct stream *stream,
                       const struct part_common *common, recto_error *error) {
  uint64_t head[HEAD_BYTES / 8] = {0};
  *writer = (struct plan_writer){.form = form_of(common)};
  writer->bytes.stream = stream;
  writer->bytes.error = error;
  for (int i = 0; i < 8; i++)
    head[0] |= (uint64_t)head_magic[i] << 8 * i;
  head[1] = PLAN_VERSION;
  plan_bytes_array(&writer->bytes, head, HEAD_BYTES / 8, 8);
}

recto_status plan_writer_add(struct plan_writer *writer,
                             struct plan_section *section, recto_error *error) {
  struct plan_place own = {.place = writer->bytes.place};
  section->index = (uint32_t)writer->section.count;
  plan_bytes_begin_sum(&writer->bytes);
  plan_section_write(&writer->bytes, section, &writer->form);
  own.size = writer->bytes.place - own.place;
  own.sum = plan_bytes_sum(&writer->bytes);
  return writer->bytes.status == RECTO_OK && ARRAY_PUSH(&writer->section, own)
             ? RECTO_OK
             : error_memory(error);
}

recto_status plan_writer_end(struct plan_writer *writer,
                             struct part_common *common, double weld,
                             recto_error *error) {
  struct byte_codec codec = {.writes = true};
  uint64_t size = 0, sum = 0;
  part_common_code(&codec, common);
  code_list(&codec, common, &weld, writer->section.item);
  if (!codec.failed) {
    size = codec.bytes.count;
    sum = byte_codec_checksum(codec.bytes.item, codec.bytes.count);
  }
  byte_codec_u64(&codec, &size);
  byte_codec_u64(&codec, &sum);
  code_magic(&codec, end_magic);
  if (!codec.failed)
    stream_write(writer->bytes.stream, codec.bytes.item, codec.bytes.count);
  ARRAY_FREE(&codec.bytes);
  return codec.failed ? error_memory(error) : RECTO_OK;
}

void plan_writer_fini(struct plan_writer *writer) {
  ARRAY_FREE(&writer->section);
}

/* ---- Reading ------------------------------------------------------------- */

static recto_status refuse_plan(const struct plan *plan, const char *why,
                                recto_error *error) {
  return error_set(error, RECTO_ERROR_FORMAT, plan->path, 0, "%s", why);
}

/* Checks the first bytes of the file. */
static recto_status check_head(const struct plan *plan, recto_error *error) {
  unsigned char head[HEAD_BYTES] = {0};
  size_t count =
      plan->reader.size < HEAD_BYTES ? (size_t)plan->reader.size : HEAD_BYTES;
  recto_status status = file_reader_read(&plan->reader, 0, head, count, error);
  struct byte_codec codec = {.at = head, .left = count};
  uint32_t version = 0;
  if (status != RECTO_OK)
    return status;
  if (count > 0 && count < HEAD_BYTES &&
      memcmp(head, head_magic, count < 8 ? count : 8) == 0)
    return refuse_plan(plan, "the plan is cut short", error);
  code_magic(&codec, head_magic);
  byte_codec_u32(&codec, &version);
  if (codec.failed)
    return refuse_plan(plan, "this is no plan of a drawing", error);
  return version == PLAN_VERSION
             ? RECTO_OK
             : error_set(error, RECTO_ERROR_UNSUPPORTED, plan->path, 0,
                         "the plan is of format %lu, and this program reads "
                         "format %d",
                         (unsigned long)version, PLAN_VERSION);
}

/* Reads the list, of which the checksum was right. */
static recto_status parse_list(struct plan *plan, const unsigned char *bytes,
                               size_t count, uint64_t list_at,
                               recto_error *error) {
  struct byte_codec codec = {.at = bytes, .left = count};
  part_common_code(&codec, &plan->common);
  byte_codec_require(&codec, plan->common.parts <= codec.left / PLACE_SIZE);
  if (!codec.failed && !ARRAY_RESERVE(&plan->section, plan->common.parts))
    return error_memory(error);
  if (!codec.failed) {
    plan->section.count = plan->common.parts;
    code_list(&codec, &plan->common, &plan->weld, plan->section.item);
  }
  for (size_t i = 0; i < plan->section.count; i++) {
    const struct plan_place *own = &plan->section.item[i];
    byte_codec_require(&codec, own->place <= list_at &&
                                   own->size <= list_at - own->place);
  }
  if (!codec.failed && codec.left == 0)
    return RECTO_OK;
  return codec.out_of_memory
             ? error_memory(error)
             : refuse_plan(plan, "the plan is damaged: a value is out of range",
                           error);
}

/* Reads the end of the file, and the list before it. */
static recto_status read_list(struct plan *plan, recto_error *error) {
  unsigned char end[END_BYTES];
  uint64_t file = plan->reader.size, size = 0, sum = 0;
  if (file < HEAD_BYTES + END_BYTES)
    return refuse_plan(plan, "the plan is cut short", error);
  recto_status status =
      file_reader_read(&plan->reader, file - END_BYTES, end, END_BYTES, error);
  struct byte_codec codec = {.at = end, .left = END_BYTES};
  byte_codec_u64(&codec, &size);
  byte_codec_u64(&codec, &sum);
  code_magic(&codec, end_magic);
  if (status != RECTO_OK)
    return status;
  if (codec.failed)
    return refuse_plan(plan, "the plan is cut short", error);
  if (size > file - HEAD_BYTES - END_BYTES)
    return refuse_plan(plan, "the plan is damaged: its checksum is wrong",
                       error);
  uint64_t at = file - END_BYTES - size;
  unsigned char *bytes = mem_alloc((size_t)size, 1);
  if (bytes == NULL)
    return error_memory(error);
  status = file_reader_read(&plan->reader, at, bytes, (size_t)size, error);
  if (status == RECTO_OK && sum != byte_codec_checksum(bytes, (size_t)size))
    status =
        refuse_plan(plan, "the plan is damaged: its checksum is wrong", error);
  if (status == RECTO_OK)
    status = parse_list(plan, bytes, (size_t)size, at, error);
  mem_free(bytes);
  return status;
}

recto_status plan_open(struct plan *plan, const char *path,
                       recto_error *error) {
  *plan = (struct plan){.path = path};
  recto_status status = file_reader_open(&plan->reader, path, error);
  if (status == RECTO_OK)
    status = check_head(plan, error);
  return status == RECTO_OK ? read_list(plan, error) : status;
}

recto_status plan_read_section(const struct plan *plan, uint32_t index,
                               struct plan_section *section,
                               recto_error *error) {
  const struct plan_place *own = &plan->section.item[index];
  const struct plan_section_form form = form_of(&plan->common);
  struct plan_bytes bytes = {.reader = &plan->reader, .place = own->place};
  recto_status status = plan_section_read(&bytes, section, &form, own->size,
                                          own->sum, plan->path, error);
  if (status == RECTO_OK && section->index != index)
    status = refuse_plan(plan, "the plan is damaged: a value is out of range",
                         error);
  return status;
}

void plan_close(struct plan *plan) {
  file_reader_close(&plan->reader);
  part_common_fini(&plan->common);
  ARRAY_FREE(&plan->section);
}
