/* test_plan.c - plans of a drawing's parts: what is no plan of theirs, or not
 * whole, is refused, and nothing is written then.  test_parts.c has that parts
 * by a plan are those without one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "api/handle.h"
#include "parts/byte_codec.h"
#include "parts/plan_bytes.h"
#include "tests/memory_faults.h"
#include "tests/scenes/scenes.h"
#include "tests/temporary.h"

enum { PARTS = 2, END_SIZE = 24, PLACE_SIZE = 24 };

struct planned {
  recto_scene *scene;
  recto_options options;
  char *plan, *bad, *part;
  char *bytes; /* of the plan */
  size_t count;
};

/* Crossed boxes, with ids and tones, so that a plan has all there can be. */
static struct planned make_plan(void *const *state) {
  struct planned p;
  assert_int_equal(recto_scene_create(&p.scene, NULL), RECTO_OK);
  recto_options_init(&p.options);
  scenes_crossed_boxes(&p.scene->scene, &p.options);
  assert_int_equal(
      recto_scene_add_polyline(p.scene, (const uint32_t[]){0, 1, 2}, 3, NULL),
      RECTO_OK);
  p.options.camera.fit = RECTO_FIT_PAGE;
  p.options.solver.threads = 1;
  p.options.ink.ids = true;
  p.options.ink.fill = RECTO_FILL_HATCH;
  p.options.ink.light[0] = 1;
  p.plan = mem_copy_text(temporary_path(state, "drawing.plan"));
  p.bad = mem_copy_text(temporary_path(state, "bad.plan"));
  p.part = mem_copy_text(temporary_path(state, "part.recto"));
  assert_int_equal(
      recto_scene_write_plan(p.scene, &p.options, PARTS, p.plan, NULL),
      RECTO_OK);
  p.bytes = temporary_read(p.plan, &p.count);
  assert_non_null(p.bytes);
  return p;
}

static void end_plan(struct planned *p) {
  recto_scene_destroy(p->scene);
  mem_free(p->plan);
  mem_free(p->bad);
  mem_free(p->part);
  free(p->bytes);
}

/* Draws a part by these bytes. */
static recto_status draw_by(void *const *state, const struct planned *p,
                            const char *bytes, size_t count, unsigned number,
                            recto_error *error) {
  assert_string_equal(temporary_file(state, "bad.plan", bytes, count), p->bad);
  return recto_plan_write_part(p->bad, NULL, number, PARTS, p->part, error);
}

static bool part_is_there(const struct planned *p) {
  size_t count;
  char *bytes = temporary_read(p->part, &count);
  free(bytes);
  return bytes != NULL;
}

/* A change is in the frame, which all parts see, or in the section of one. */
static void each_flipped_byte_is_found(void **state) {
  struct planned p = make_plan(state);
  for (size_t i = 0; i < p.count; i++) {
    unsigned refused = 0;
    p.bytes[i] ^= (char)(1 << i % 8);
    for (unsigned number = 1; number <= PARTS; number++) {
      recto_error error = {0};
      recto_status status =
          draw_by(state, &p, p.bytes, p.count, number, &error);
      assert_true(status == RECTO_OK || status == RECTO_ERROR_FORMAT ||
                  status == RECTO_ERROR_UNSUPPORTED);
      assert_int_equal(part_is_there(&p), status == RECTO_OK);
      remove(p.part);
      if (status != RECTO_OK)
        assert_string_equal(error.file, p.bad);
      refused += status != RECTO_OK;
    }
    p.bytes[i] ^= (char)(1 << i % 8);
    /* The head is filled up with zeros, that mean nothing. */
    assert_true(refused > 0 || (i >= 12 && i < PLAN_BLOCK));
  }
  end_plan(&p);
}

static void each_length_is_cut_short(void **state) {
  struct planned p = make_plan(state);
  for (size_t i = 0; i < p.count; i += 1 + i / 64) {
    recto_error error = {0};
    assert_int_equal(draw_by(state, &p, p.bytes, i, 1, &error),
                     RECTO_ERROR_FORMAT);
    assert_true(
        strcmp(error.text, "the plan is cut short") == 0 ||
        (i == 0 && strcmp(error.text, "this is no plan of a drawing") == 0));
    assert_false(part_is_there(&p));
  }
  end_plan(&p);
}

static void other_files_are_no_plans(void **state) {
  struct planned p = make_plan(state);
  recto_error error;
  const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n# no plan at all\n";
  assert_int_equal(draw_by(state, &p, obj, sizeof obj - 1, 1, &error),
                   RECTO_ERROR_FORMAT);
  assert_string_equal(error.text, "this is no plan of a drawing");
  assert_int_equal(recto_plan_write_part(temporary_path(state, "none"), NULL, 1,
                                         PARTS, p.part, &error),
                   RECTO_ERROR_IO);
  p.bytes[8]++;
  assert_int_equal(draw_by(state, &p, p.bytes, p.count, 1, &error),
                   RECTO_ERROR_UNSUPPORTED);
  assert_non_null(strstr(error.text, "this program reads format 2"));
  assert_false(part_is_there(&p));
  end_plan(&p);
}

static void what_a_plan_does_not_have_is_refused(void **state) {
  struct planned p = make_plan(state);
  recto_error error;
  recto_options lines;
  assert_int_equal(
      recto_plan_write_part(p.plan, NULL, 1, PARTS + 1, p.part, &error),
      RECTO_ERROR_ARGUMENT);
  assert_string_equal(error.text, "the plan is one of 2 parts, not of 3");
  assert_int_equal(
      recto_plan_write_part(p.plan, NULL, PARTS + 1, PARTS, p.part, &error),
      RECTO_ERROR_ARGUMENT);
  p.options.ink.light[0] = 2;
  p.options.ink.light[1] = 1;
  assert_int_equal(
      recto_plan_write_part(p.plan, &p.options, 1, PARTS, p.part, &error),
      RECTO_ERROR_UNSUPPORTED);
  assert_non_null(strstr(error.text, "the plan was made without these tones"));
  recto_options_init(&lines);
  assert_int_equal(recto_scene_write_plan(p.scene, &lines, PARTS, p.plan, NULL),
                   RECTO_OK);
  lines.ink.fill = RECTO_FILL_SHADE;
  assert_int_equal(
      recto_plan_write_part(p.plan, &lines, 1, PARTS, p.part, &error),
      RECTO_ERROR_UNSUPPORTED);
  lines.ink.fill = RECTO_FILL_NONE;
  lines.solver.method = RECTO_METHOD_ZBUFFER;
  assert_int_equal(
      recto_plan_write_part(p.plan, &lines, 1, PARTS, p.part, &error),
      RECTO_ERROR_UNSUPPORTED);
  assert_int_equal(
      recto_scene_write_plan(p.scene, &lines, PARTS, p.bad, &error),
      RECTO_ERROR_UNSUPPORTED);
  assert_int_equal(
      recto_scene_write_plan(p.scene, NULL, RECTO_PARTS_MAX + 1, p.bad, &error),
      RECTO_ERROR_ARGUMENT);
  assert_int_equal(
      recto_plan_write_part(p.plan, NULL, 1, PARTS, p.plan, &error),
      RECTO_ERROR_ARGUMENT);
  assert_string_equal(error.text, "the part would replace the plan");
  assert_false(part_is_there(&p));
  end_plan(&p);
}

static void a_part_of_the_plan_is_there(void **state) {
  struct planned p = make_plan(state);
  bool is_there;
  assert_int_equal(
      recto_plan_has_part(p.plan, NULL, 1, PARTS, p.part, &is_there, NULL),
      RECTO_OK);
  assert_false(is_there);
  assert_int_equal(recto_plan_write_part(p.plan, NULL, 1, PARTS, p.part, NULL),
                   RECTO_OK);
  for (unsigned number = 1; number <= PARTS; number++) {
    assert_int_equal(recto_plan_has_part(p.plan, NULL, number, PARTS, p.part,
                                         &is_there, NULL),
                     RECTO_OK);
    assert_int_equal(is_there, number == 1);
  }
  p.options.camera.azimuth_deg += 1;
  assert_int_equal(
      recto_scene_write_plan(p.scene, &p.options, PARTS, p.plan, NULL),
      RECTO_OK);
  assert_int_equal(
      recto_plan_has_part(p.plan, NULL, 1, PARTS, p.part, &is_there, NULL),
      RECTO_OK);
  assert_false(is_there);
  end_plan(&p);
}

/* ---- Damage on purpose --------------------------------------------------- */

static uint64_t get_u64(const char *at) {
  uint64_t value = 0;
  for (int i = 0; i < 8; i++)
    value |= (uint64_t)(unsigned char)at[i] << 8 * i;
  return value;
}

static void put_u64(char *at, uint64_t value) {
  for (int i = 0; i < 8; i++)
    at[i] = (char)(value >> 8 * i & 0xff);
}

/* The sum of a section, written down from the description of the format. */
static uint64_t sum_section(const char *bytes, size_t count) {
  uint64_t lane[4] = {0}, sum = 0;
  for (size_t i = 0; i + 8 <= count; i += 8) {
    uint64_t *own = &lane[i / 8 % 4];
    *own = (*own ^ get_u64(bytes + i)) * UINT64_C(0x9e3779b97f4a7c15);
    *own ^= *own >> 32;
  }
  for (int i = 0; i < 4; i++) {
    sum = (sum ^ lane[i]) * UINT64_C(0x9e3779b97f4a7c15);
    sum ^= sum >> 32;
  }
  return sum;
}

/* Makes all sums right again. */
static void make_sums(char *bytes, size_t count) {
  char *end = bytes + count - END_SIZE;
  uint64_t size = get_u64(end);
  if (size > count - END_SIZE || size < PARTS * PLACE_SIZE + 8)
    return;
  char *place = end - 8 - PARTS * PLACE_SIZE;
  for (int i = 0; i < PARTS; i++, place += PLACE_SIZE) {
    uint64_t at = get_u64(place), own = get_u64(place + 8);
    if (at <= count && own <= count - at)
      put_u64(place + 16, sum_section(bytes + at, (size_t)own));
  }
  put_u64(end + 8, byte_codec_checksum(end - size, (size_t)size));
}

/* Whoever makes a file can make its sums. */
static void damage_with_right_sums_does_no_harm(void **state) {
  struct planned p = make_plan(state);
  char *whole = mem_alloc(p.count, 1);
  size_t accepted = 0, refused = 0;
  assert_non_null(whole);
  memcpy(whole, p.bytes, p.count);
  make_sums(p.bytes, p.count);
  assert_memory_equal(whole, p.bytes, p.count);
  for (size_t i = 0; i < p.count - END_SIZE; i++) {
    p.bytes[i] ^= (char)(i % 3 == 0 ? 0xff : 1 << i % 8);
    make_sums(p.bytes, p.count);
    for (unsigned number = 1; number <= PARTS; number++) {
      recto_status status = draw_by(state, &p, p.bytes, p.count, number, NULL);
      assert_int_equal(part_is_there(&p), status == RECTO_OK);
      remove(p.part);
      accepted += status == RECTO_OK;
      refused += status != RECTO_OK;
    }
    memcpy(p.bytes, whole, p.count);
  }
  assert_true(accepted > 0 && refused > 0);
  mem_free(whole);
  end_plan(&p);
}

/* ---- Memory -------------------------------------------------------------- */

static recto_status write_plan_of(void *user) {
  const struct planned *p = user;
  return recto_scene_write_plan(p->scene, &p->options, PARTS, p->bad, NULL);
}

static recto_status write_part_of(void *user) {
  const struct planned *p = user;
  return recto_plan_write_part(p->plan, NULL, 1, PARTS, p->part, NULL);
}

static void fail_allocations(recto_status (*run)(void *user), void *user) {
  struct memory_faults faults = {.least = 51, .in_a_row = 10};
  while (memory_faults_go_on(&faults)) {
    memory_faults_begin(&faults);
    memory_faults_end(&faults, run(user));
  }
}

static void what_runs_out_of_memory_says_so(void **state) {
  struct planned p = make_plan(state);
  fail_allocations(write_plan_of, &p);
  fail_allocations(write_part_of, &p);
  end_plan(&p);
}

#define IN_FOLDER(test)                                                        \
  cmocka_unit_test_setup_teardown(test, temporary_set_up, temporary_tear_down)

int main(void) {
  const struct CMUnitTest tests[] = {
      IN_FOLDER(each_flipped_byte_is_found),
      IN_FOLDER(each_length_is_cut_short),
      IN_FOLDER(other_files_are_no_plans),
      IN_FOLDER(what_a_plan_does_not_have_is_refused),
      IN_FOLDER(a_part_of_the_plan_is_there),
      IN_FOLDER(damage_with_right_sums_does_no_harm),
      IN_FOLDER(what_runs_out_of_memory_says_so),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
