/* soak.c - random scenes of all kinds, for as long as one likes.
 *
 * - `soak SECONDS SEED FOLDER` draws scenes of the seeds from SEED on by all
 *   exact methods, which must give the same bytes, and asks the judge.  What it
 *   finds it reduces to the fewest faces and writes into FOLDER as an OBJ file,
 *   whose first line says what is wrong and whose second is the command line.
 *   Exit 1 where there is a finding.
 * - `soak --replay FILE...` does the same with such files.
 *
 * A scene is a generator of tests/scenes/ with random sizes, seen from a random
 * direction, with random options; one in four is one of decode.h. */
#include <inttypes.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/stream.h"
#include "tests/fuzz/agreement.h"
#include "tests/fuzz/decode.h"
#include "tests/fuzz/soak_kinds.h"
#include "tests/scenes/write_obj.h"

enum { COUNTS_MAX = 40 };
enum { TEXT_MAX = 1 << 22, WORDS_MAX = 32, WORD_SIZE = 64, PATH_SIZE = 1000 };

struct sample {
  char kind[32];
  char obj[TEXT_MAX];
  size_t length;
  char word[WORDS_MAX][WORD_SIZE];
  int words;
};

static void fail(const char *what, const char *path) {
  fprintf(stderr, "soak: %s: %s\n", path, what);
  exit(2);
}

/* ---- Command lines ------------------------------------------------------- */

static void add_word(struct sample *sample, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
static void add_word(struct sample *sample, const char *format, ...) {
  va_list arguments;
  if (sample->words == WORDS_MAX)
    fail("too many words", sample->kind);
  va_start(arguments, format);
  vsnprintf(sample->word[sample->words++], WORD_SIZE, format, arguments);
  va_end(arguments);
}

/* Half of the time the first, which says nothing. */
static void add_options(struct sample *sample, struct random *random) {
  static const char *const option[][6] = {
      {"", "--edges=all", "--edges=silhouette,border", "--edges=intersection"},
      {"", "--fill=paint", "--fill=shade", "--fill=hatch"},
      {"", "--hidden=dashed", "--hidden=layer", "--hidden=2"},
      {"", "--contact=0"},
      {"", "--crease=0", "--crease=90", "--crease=180"},
      {"", "--exact", "--min-stroke=0"},
      {"", "--page=50x200", "--page=A5"},
      {"", "--order=near", "--ids"}};
  for (size_t i = 0; i < sizeof option / sizeof *option; i++) {
    unsigned count = 0;
    while (count < 6 && option[i][count] != NULL)
      count++;
    unsigned chosen = random_below(random, 2) ? random_below(random, count) : 0;
    if (chosen > 0)
      add_word(sample, "%s", option[i][chosen]);
  }
}

static void add_camera(struct sample *sample, struct random *random) {
  static const double right[] = {0, 90, 180, 45, 26.56505117707799, 1e-7};
  bool special = random_below(random, 3) == 0;
  add_word(sample, "--azimuth=%.17g",
           special ? right[random_below(random, 6)]
                   : random_between(random, -180, 180));
  add_word(sample, "--elevation=%.17g",
           special ? right[random_below(random, 2)]
                   : random_between(random, -90, 90));
  if (random_below(random, 3) == 0)
    add_word(sample, "--fov=%d", random_int(random, 5, 120));
}

/* ---- Inputs -------------------------------------------------------------- */

static void set_obj(struct sample *sample, const char *text, size_t length) {
  if (length >= TEXT_MAX)
    fail("too long", sample->kind);
  memcpy(sample->obj, text, length);
  sample->obj[length] = '\0';
  sample->length = length;
}

static void make_generated(struct sample *sample, struct random *random) {
  const struct soak_kind *kind =
      &soak_kinds[random_below(random, soak_kind_count)];
  struct scene scene;
  recto_options options;
  struct stream *stream;
  size_t length;
  snprintf(sample->kind, sizeof sample->kind, "%s", kind->name);
  scene_init(&scene);
  recto_options_init(&options);
  kind->make(&scene, &options, random);
  if (stream_open_memory(&stream, NULL) != RECTO_OK)
    fail("no memory", kind->name);
  scene_write_obj(&scene, stream);
  const char *text = stream_memory(stream, &length);
  set_obj(sample, text, length);
  stream_discard(stream);
  scene_fini(&scene);
  add_word(sample, "--up=0,0,1");
  add_options(sample, random);
  add_camera(sample, random);
}

/* As the fuzzer's, whose words name the files last. */
static void make_lattice(struct sample *sample, struct random *random) {
  static struct decoded decoded;
  uint8_t bytes[120];
  for (size_t i = 0; i < sizeof bytes; i++)
    bytes[i] =
        i < 20 && random_below(random, 2) ? 0 : (uint8_t)random_next(random);
  decode_scene(&decoded, bytes, sizeof bytes);
  snprintf(sample->kind, sizeof sample->kind, "lattice");
  set_obj(sample, decoded.obj, decoded.obj_length);
  for (int i = 1; i + 3 < decoded.argc; i++)
    add_word(sample, "%s", decoded.argv[i]);
}

static void make_sample(struct sample *sample, uint64_t seed) {
  struct random random = {seed};
  sample->words = 0;
  if (random_below(&random, 4) == 0)
    make_lattice(sample, &random);
  else
    make_generated(sample, &random);
}

static const char *find(const struct sample *sample) {
  static struct fuzz_finding finding;
  static char program[] = "recto", o[] = "-o", to[] = "out.svg",
              model[] = "model.obj";
  char *argv[WORDS_MAX + 5] = {program};
  int argc = 1;
  for (int i = 0; i < sample->words; i++)
    argv[argc++] = (char *)(uintptr_t)sample->word[i];
  argv[argc++] = o;
  argv[argc++] = to;
  argv[argc++] = model;
  finding.text[0] = '\0';
  agreement_check(sample->obj, sample->length, argc, argv, &finding);
  return finding.text;
}

/* ---- Fewer faces --------------------------------------------------------- */

static bool is_same_kind(const char *a, const char *b) {
  size_t length = strcspn(a, ":");
  return *b != '\0' && strcspn(b, ":") == length && memcmp(a, b, length) == 0;
}

struct line {
  const char *at;
  size_t length; /* with its end */
  bool is_point, is_element;
};

/* Takes the next line of a text; false where there is none. */
static bool next_line(const char **at, struct line *line) {
  size_t length = strcspn(*at, "\n");
  *line = (struct line){*at, length + ((*at)[length] == '\n'), false, false};
  line->is_point = strncmp(*at, "v ", 2) == 0;
  line->is_element = strncmp(*at, "f ", 2) == 0 || strncmp(*at, "l ", 2) == 0;
  *at += line->length;
  return line->length > 0;
}

static void append(struct sample *sample, const char *text, size_t length) {
  memcpy(sample->obj + sample->length, text, length);
  sample->length += length;
  sample->obj[sample->length] = '\0';
}

/* Copies the text without the elements from `first` to `last`; returns how many
 * it has. */
static size_t copy_without(struct sample *to, const struct sample *from,
                           size_t first, size_t last) {
  size_t elements = 0;
  const char *at = from->obj;
  to->length = 0;
  for (struct line line; next_line(&at, &line); elements += line.is_element)
    if (!line.is_element || elements < first || elements >= last)
      append(to, line.at, line.length);
  return elements;
}

/* Calls `each` for the indices of an element, of points before it. */
static void for_indices(const struct line *line, void *user,
                        void (*each)(void *user, unsigned long index)) {
  const char *at = line->at + 1;
  while (at < line->at + line->length && *at != '\n') {
    char *end;
    unsigned long index = strtoul(at, &end, 10);
    if (end == at || index == 0 || index > TEXT_MAX / 8)
      return;
    each(user, index);
    at = end;
  }
}

struct numbering {
  struct sample *to;
  uint32_t number[TEXT_MAX / 8 + 1]; /* of a point anew; 0: not used */
};

static void mark_used(void *user, unsigned long index) {
  ((struct numbering *)user)->number[index] = 1;
}

static void append_number(void *user, unsigned long index) {
  const struct numbering *numbering = user;
  char text[20];
  append(numbering->to, text,
         (size_t)snprintf(text, sizeof text, " %" PRIu32,
                          numbering->number[index]));
}

/* Copies the text without the points that no element has.  Its indices must be
 * plain numbers. */
static void copy_used(struct sample *to, const struct sample *from) {
  static struct numbering numbering;
  const char *at = from->obj;
  uint32_t point = 0, used = 0;
  memset(&numbering, 0, sizeof numbering);
  numbering.to = to;
  to->length = 0;
  for (struct line line; next_line(&at, &line);)
    if (line.is_element)
      for_indices(&line, &numbering, mark_used);
  at = from->obj;
  for (struct line line; next_line(&at, &line);) {
    if (line.is_point && numbering.number[++point] == 0)
      continue;
    if (line.is_point)
      numbering.number[point] = ++used;
    append(to, line.at, line.is_element ? 1 : line.length);
    if (line.is_element) {
      for_indices(&line, &numbering, append_number);
      append(to, "\n", 1);
    }
  }
}

static bool replace_if_found(struct sample *sample, const struct sample *trial,
                             const char *kind) {
  if (!is_same_kind(kind, find(trial)))
    return false;
  memcpy(sample->obj, trial->obj, trial->length + 1);
  sample->length = trial->length;
  return true;
}

/* Leaves out ever shorter runs of elements, then points, as long as something
 * of the same kind is found. */
static void reduce(struct sample *sample, const char *what) {
  static struct sample trial;
  char kind[FUZZ_FINDING_SIZE];
  snprintf(kind, sizeof kind, "%s", what);
  trial = *sample;
  size_t count = copy_without(&trial, sample, 0, 0);
  for (size_t run = count / 2; run > 0; run /= 2)
    for (size_t first = 0; first < count;) {
      (void)copy_without(&trial, sample, first, first + run);
      if (replace_if_found(sample, &trial, kind))
        count = copy_without(&trial, sample, 0, 0);
      else
        first += run;
    }
  copy_used(&trial, sample);
  (void)replace_if_found(sample, &trial, kind);
}

/* ---- Reports ------------------------------------------------------------- */

static void write_report(const struct sample *sample, const char *what,
                         const char *folder, uint64_t seed) {
  char path[PATH_SIZE];
  snprintf(path, sizeof path, "%s/%s-%" PRIu64 ".obj", folder, sample->kind,
           seed);
  FILE *file = fopen(path, "w");
  if (file == NULL)
    fail("cannot be written", path);
  fprintf(file, "# %s\n# recto", what);
  for (int i = 0; i < sample->words; i++)
    fprintf(file, " %s", sample->word[i]);
  fprintf(file, "\n%s", sample->obj);
  if (fclose(file) != 0)
    fail("cannot be written", path);
  printf("%s: %s\n", path, what);
  fflush(stdout);
}

static void read_report(struct sample *sample, const char *path) {
  char line[4096];
  FILE *file = fopen(path, "r");
  sample->words = 0;
  if (file == NULL || fgets(line, sizeof line, file) == NULL ||
      fgets(line, sizeof line, file) == NULL ||
      strncmp(line, "# recto", 7) != 0)
    fail("is no report", path);
  for (char *word = strtok(line + 7, " \n"); word != NULL;
       word = strtok(NULL, " \n"))
    add_word(sample, "%s", word);
  sample->length = fread(sample->obj, 1, TEXT_MAX - 1, file);
  sample->obj[sample->length] = '\0';
  fclose(file);
}

static int replay(char **path) {
  static struct sample sample;
  int findings = 0;
  for (; *path != NULL; path++) {
    read_report(&sample, *path);
    const char *what = find(&sample);
    findings += *what != '\0';
    if (*what != '\0')
      printf("%s: %s\n", *path, what);
  }
  return findings > 0;
}

/* ---- Soaking ------------------------------------------------------------- */

struct count {
  char kind[32];
  unsigned long scenes;
};

static void count_scene(struct count *count, const char *kind) {
  while (*count->kind != '\0' && strcmp(count->kind, kind) != 0)
    count++;
  snprintf(count->kind, sizeof count->kind, "%s", kind);
  count->scenes++;
}

static int soak(double seconds, uint64_t seed, const char *folder) {
  static struct sample sample;
  struct count count[COUNTS_MAX] = {{"", 0}};
  unsigned long scenes = 0, findings = 0;
  time_t start = time(NULL), told = start;
  for (; difftime(time(NULL), start) < seconds; seed++, scenes++) {
    make_sample(&sample, seed);
    count_scene(count, sample.kind);
    const char *what = find(&sample);
    if (*what != '\0') {
      findings++;
      reduce(&sample, what);
      write_report(&sample, find(&sample), folder, seed);
    }
    if (difftime(time(NULL), told) >= 10) {
      told = time(NULL);
      fprintf(stderr, "soak: %lu scenes, %lu findings, seed %" PRIu64 "\n",
              scenes, findings, seed);
    }
  }
  printf("%lu scenes, up to seed %" PRIu64 ", %lu findings:", scenes, seed - 1,
         findings);
  for (const struct count *c = count; *c->kind != '\0'; c++)
    printf(" %s %lu", c->kind, c->scenes);
  printf("\n");
  return findings > 0;
}

int main(int argc, char **argv) {
  if (argc > 2 && strcmp(argv[1], "--replay") == 0)
    return replay(argv + 2);
  if (argc != 4)
    fail("see the head of tests/fuzz/soak.c", "usage");
  return soak(strtod(argv[1], NULL), strtoull(argv[2], NULL, 10), argv[3]);
}
