/* soak.c - random scenes of all kinds, for as long as one likes.
 *
 * - `soak SECONDS SEED FOLDER` draws scenes of the seeds from SEED on by all
 *   exact methods and in parts, which must give the same bytes, and asks the
 *   judge.  What it finds it reduces to the fewest faces and writes into FOLDER
 *   as an OBJ file, whose first line says what is wrong and whose second is the
 *   command line.  Exit 1 where there is a finding.
 * - `soak --replay FILE...` does the same with such files.
 *
 * soak_sample.h has the scenes. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "tests/fuzz/agreement.h"
#include "tests/fuzz/soak_sample.h"

enum { COUNTS_MAX = 40, PATH_SIZE = 1000 };

/* ---- Findings ------------------------------------------------------------ */

static const char *find(const struct sample *sample,
                        struct agreement_done *done) {
  static struct fuzz_finding finding;
  static char program[] = "recto", o[] = "-o", to[] = "out.svg",
              model[] = "model.obj";
  char *argv[SAMPLE_WORDS_MAX + 5] = {program};
  int argc = 1;
  for (int i = 0; i < sample->words; i++)
    argv[argc++] = (char *)(uintptr_t)sample->word[i];
  argv[argc++] = o;
  argv[argc++] = to;
  argv[argc++] = model;
  finding.text[0] = '\0';
  agreement_check(sample->obj, sample->length, argc, argv, &finding, done);
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
    if (end == at || index == 0 || index > SAMPLE_TEXT_MAX / 8)
      return;
    each(user, index);
    at = end;
  }
}

struct numbering {
  struct sample *to;
  uint32_t number[SAMPLE_TEXT_MAX / 8 + 1]; /* of a point anew; 0: not used */
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
  if (!is_same_kind(kind, find(trial, NULL)))
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
    soak_fail("cannot be written", path);
  fprintf(file, "# %s\n# recto", what);
  for (int i = 0; i < sample->words; i++)
    fprintf(file, " %s", sample->word[i]);
  fprintf(file, "\n%s", sample->obj);
  if (fclose(file) != 0)
    soak_fail("cannot be written", path);
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
    soak_fail("is no report", path);
  for (char *word = strtok(line + 7, " \n"); word != NULL;
       word = strtok(NULL, " \n"))
    sample_add_word(sample, "%s", word);
  sample->length = fread(sample->obj, 1, SAMPLE_TEXT_MAX - 1, file);
  sample->obj[sample->length] = '\0';
  fclose(file);
}

static int replay(char **path) {
  static struct sample sample;
  int findings = 0;
  for (; *path != NULL; path++) {
    read_report(&sample, *path);
    const char *what = find(&sample, NULL);
    findings += *what != '\0';
    if (*what != '\0')
      printf("%s: %s\n", *path, what);
  }
  return findings > 0;
}

/* ---- Soaking ------------------------------------------------------------- */

/* What was done with the scenes of a kind. */
struct count {
  char kind[32];
  unsigned long scenes, drawn, judged, cut, cut_judged, sheets, in_parts;
};

static struct count *find_count(struct count *count, const char *kind) {
  while (*count->kind != '\0' && strcmp(count->kind, kind) != 0)
    count++;
  snprintf(count->kind, sizeof count->kind, "%s", kind);
  return count;
}

static void count_scene(struct count *count,
                        const struct agreement_done *done) {
  count->scenes++;
  count->drawn += done->drawn;
  count->judged += done->judged;
  count->cut += done->drawn && done->cut;
  count->cut_judged += done->cut && done->judged;
  count->sheets += done->drawn && done->sheet;
  count->in_parts += done->in_parts;
}

static void print_counts(const struct count *count) {
  printf("| kind | scenes | drawn | judged | cut | of these judged | sheets | "
         "in parts |\n|---|---|---|---|---|---|---|---|\n");
  for (; *count->kind != '\0'; count++)
    printf("| %s | %lu | %lu | %lu | %lu | %lu | %lu | %lu |\n", count->kind,
           count->scenes, count->drawn, count->judged, count->cut,
           count->cut_judged, count->sheets, count->in_parts);
}

static int soak(double seconds, uint64_t seed, const char *folder) {
  static struct sample sample;
  struct count count[COUNTS_MAX] = {{.kind = "all"}};
  unsigned long findings = 0;
  time_t start = time(NULL), reported = start;
  for (; difftime(time(NULL), start) < seconds; seed++) {
    struct agreement_done done;
    sample_make(&sample, seed);
    const char *what = find(&sample, &done);
    count_scene(&count[0], &done);
    count_scene(find_count(count, sample.kind), &done);
    if (*what != '\0') {
      findings++;
      reduce(&sample, what);
      write_report(&sample, find(&sample, NULL), folder, seed);
    }
    if (difftime(time(NULL), reported) >= 10) {
      reported = time(NULL);
      fprintf(stderr, "soak: %lu scenes, %lu findings, seed %" PRIu64 "\n",
              count[0].scenes, findings, seed);
    }
  }
  printf("%lu scenes, up to seed %" PRIu64 ", %lu findings\n\n",
         count[0].scenes, seed - 1, findings);
  print_counts(count);
  return findings > 0;
}

int main(int argc, char **argv) {
  if (argc > 2 && strcmp(argv[1], "--replay") == 0)
    return replay(argv + 2);
  if (argc != 4)
    soak_fail("see the head of tests/fuzz/soak.c", "usage");
  return soak(strtod(argv[1], NULL), strtoull(argv[2], NULL, 10), argv[3]);
}
