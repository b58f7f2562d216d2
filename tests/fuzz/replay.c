/* replay.c - runs inputs of a fuzzer without the fuzzer, shows them, makes them
 * smaller, and makes random ones.
 *
 * - `replay TARGET FILE|FOLDER...` runs them, and exits with 1 where something
 *   is found;
 * - `replay --print TARGET FILE` shows an input as a model and a command;
 * - `replay --random SEED COUNT TARGET FOLDER` runs random inputs, and keeps
 *   the findings;
 * - `replay --minimise TARGET FILE OUT` makes the least input that still finds
 *   it;
 * - `replay --dictionary TARGET` prints words for libFuzzer. */
#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "tests/fuzz/fuzz.h"
#include "tests/scenes/random.h"

enum { INPUT_SIZE = 1 << 20, PATH_SIZE = 1000 };

struct bytes {
  uint8_t item[INPUT_SIZE];
  size_t count;
};

static void fail(const char *what, const char *path) {
  fprintf(stderr, "replay: %s: %s\n", path, what);
  exit(2);
}

static void load(struct bytes *bytes, const char *path) {
  FILE *file = fopen(path, "rb");
  if (file == NULL)
    fail("cannot be read", path);
  bytes->count = fread(bytes->item, 1, sizeof bytes->item, file);
  fclose(file);
}

static void save(const struct bytes *bytes, const char *path) {
  FILE *file = fopen(path, "wb");
  if (file == NULL ||
      fwrite(bytes->item, 1, bytes->count, file) != bytes->count ||
      fclose(file) != 0)
    fail("cannot be written", path);
}

/* The sentence of what was found; "" where nothing was.  Runs a block of just
 * this size, so that a read past its end is noticed. */
static const char *find(const struct fuzz_target *target,
                        const struct bytes *bytes) {
  static struct fuzz_finding finding;
  uint8_t *block = malloc(bytes->count > 0 ? bytes->count : 1);
  if (block == NULL)
    fail("no memory", target->name);
  memcpy(block, bytes->item, bytes->count);
  finding.text[0] = '\0';
  target->run(block, bytes->count, &finding);
  free(block);
  return finding.text;
}

/* ---- Replaying ----------------------------------------------------------- */

struct tally {
  size_t inputs, findings;
};

static void replay_file(const struct fuzz_target *target, const char *path,
                        struct tally *tally) {
  static struct bytes bytes;
  load(&bytes, path);
  const char *found = find(target, &bytes);
  tally->inputs++;
  tally->findings += *found != '\0';
  if (*found != '\0')
    printf("%s: %s\n", path, found);
}

/* A folder's own files, not those of its folders. */
static void replay_folder(const struct fuzz_target *target, const char *path,
                          struct tally *tally) {
  struct dirent **entry;
  int count = scandir(path, &entry, NULL, alphasort);
  if (count < 0)
    fail("cannot be read", path);
  for (int i = 0; i < count; i++) {
    char name[PATH_SIZE];
    struct stat state;
    snprintf(name, sizeof name, "%s/%s", path, entry[i]->d_name);
    if (stat(name, &state) == 0 && S_ISREG(state.st_mode))
      replay_file(target, name, tally);
    free(entry[i]);
  }
  free(entry);
}

static int replay(const struct fuzz_target *target, char **path) {
  struct tally tally = {0, 0};
  for (; *path != NULL; path++) {
    struct stat state;
    if (stat(*path, &state) == 0 && S_ISDIR(state.st_mode))
      replay_folder(target, *path, &tally);
    else
      replay_file(target, *path, &tally);
  }
  printf("%s: %zu inputs, %zu findings\n", target->name, tally.inputs,
         tally.findings);
  return tally.findings > 0 || tally.inputs == 0;
}

/* ---- Random inputs ------------------------------------------------------- */

enum { RANDOM_LEAST = 40, RANDOM_MAX = 160 };

/* Half of the bytes of options are 0, for what is usual. */
static void make_random(struct bytes *bytes, uint64_t seed) {
  struct random random = {seed};
  bytes->count = (size_t)random_int(&random, RANDOM_LEAST, RANDOM_MAX);
  for (size_t i = 0; i < bytes->count; i++)
    bytes->item[i] = i < RANDOM_LEAST / 2 && random_below(&random, 2) == 0
                         ? 0
                         : (uint8_t)random_next(&random);
}

static int run_random(const struct fuzz_target *target, const char *seed,
                      const char *count, const char *folder) {
  static struct bytes bytes;
  uint64_t first = strtoull(seed, NULL, 10);
  unsigned long findings = 0;
  for (uint64_t i = first; i < first + strtoull(count, NULL, 10); i++) {
    char path[PATH_SIZE];
    make_random(&bytes, i);
    /* Written first, so that it is there after a crash. */
    snprintf(path, sizeof path, "%s/%s-%llu", folder, target->name,
             (unsigned long long)i);
    save(&bytes, path);
    const char *found = find(target, &bytes);
    if (*found == '\0') {
      remove(path);
      continue;
    }
    findings++;
    printf("%s: %s\n", path, found);
    fflush(stdout);
  }
  printf("%s: %s inputs, %lu findings\n", target->name, count, findings);
  return findings > 0;
}

/* ---- Smaller inputs ------------------------------------------------------ */

/* Findings of one kind open with the same words. */
static bool is_same_kind(const char *a, const char *b) {
  size_t length = strcspn(a, ":");
  return *b != '\0' && strcspn(b, ":") == length && memcmp(a, b, length) == 0;
}

static bool still_found(const struct fuzz_target *target,
                        const struct bytes *bytes, const char *kind) {
  return is_same_kind(kind, find(target, bytes));
}

/* Leaves out `count` bytes at a time, from the end; whether any could be. */
static bool cut(const struct fuzz_target *target, struct bytes *bytes,
                size_t count, const char *kind) {
  static struct bytes trial;
  bool ok = false;
  for (size_t at = bytes->count; at >= count; at--) {
    trial.count = bytes->count - count;
    memcpy(trial.item, bytes->item, at - count);
    memcpy(trial.item + at - count, bytes->item + at, bytes->count - at);
    if (!still_found(target, &trial, kind))
      continue;
    *bytes = trial;
    ok = true;
    at = at > bytes->count ? bytes->count + 1 : at;
  }
  return ok;
}

/* Sets bytes to 0, or else lowers them; whether any could be. */
static bool lower(const struct fuzz_target *target, struct bytes *bytes,
                  const char *kind) {
  bool ok = false;
  for (size_t i = 0; i < bytes->count; i++)
    for (unsigned value = 0; value < bytes->item[i]; value++) {
      uint8_t old = bytes->item[i];
      bytes->item[i] = (uint8_t)value;
      if (still_found(target, bytes, kind)) {
        ok = true;
        break;
      }
      bytes->item[i] = old;
      value = value < 32 ? value : old;
    }
  return ok;
}

static int minimise(const struct fuzz_target *target, const char *from,
                    const char *to) {
  static struct bytes bytes;
  static const size_t sizes[] = {32, 16, 8, 7, 6, 5, 4, 3, 2, 1};
  char kind[FUZZ_FINDING_SIZE];
  load(&bytes, from);
  snprintf(kind, sizeof kind, "%s", find(target, &bytes));
  if (*kind == '\0')
    fail("nothing is found", from);
  bool ok;
  do {
    ok = false;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
      ok |= cut(target, &bytes, sizes[i], kind);
    ok |= lower(target, &bytes, kind);
  } while (ok);
  save(&bytes, to);
  printf("%s: %zu bytes: %s\n", to, bytes.count, find(target, &bytes));
  return 0;
}

/* ---- The command line ---------------------------------------------------- */

static int show(const struct fuzz_target *target, const char *path) {
  static struct bytes bytes;
  load(&bytes, path);
  if (target->print != NULL)
    target->print(bytes.item, bytes.count, stdout);
  else
    fwrite(bytes.item, 1, bytes.count, stdout);
  return 0;
}

static const struct fuzz_target *take_target(const char *name) {
  const struct fuzz_target *target = fuzz_find(name);
  if (target == NULL)
    fail("no such target", name);
  return target;
}

int main(int argc, char **argv) {
  const char *verb = argc > 1 ? argv[1] : "";
  if (strcmp(verb, "--print") == 0 && argc == 4)
    return show(take_target(argv[2]), argv[3]);
  if (strcmp(verb, "--random") == 0 && argc == 6)
    return run_random(take_target(argv[4]), argv[2], argv[3], argv[5]);
  if (strcmp(verb, "--minimise") == 0 && argc == 5)
    return minimise(take_target(argv[2]), argv[3], argv[4]);
  if (strcmp(verb, "--dictionary") == 0 && argc == 3) {
    fuzz_print_dictionary(take_target(argv[2]), stdout);
    return 0;
  }
  if (argc > 2 && verb[0] != '-')
    return replay(take_target(verb), argv + 2);
  fail("see the head of tests/fuzz/replay.c", "usage");
}
