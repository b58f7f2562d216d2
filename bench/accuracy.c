/* accuracy.c - what every method gets wrong over its knob, and how long it
 * takes: its map against the exact one, on eight scenes.
 *
 *   accuracy EXAMPLES FOLDER [SCENE...]
 *
 * Writes a file of comma-separated values a scene into the folder, such as
 * FOLDER/cubes.csv; with names, those of these scenes alone.  Each setting runs
 * in a process of its own, with a limit of CPU time; the time is the median of
 * repeated runs of the solver alone.  doc/accuracy.md defines the errors.
 *
 * Ends with status 1 where an exact method has an error. */
#include "bench/accuracy.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "bench/table.h"

enum { LIMIT_S = 15, REPEATS = 9 };

/* Repeated until so much was measured. */
static const double ENOUGH_S = 0.4;

/* What rounding in the sums of areas amounts to; more is an error. */
static const double SHARE_MIN = 1e-9;

/* What the process of a setting answers. */
struct answer {
  double seconds;
  struct measure measure;
  bool ok;
  bool refused;     /* beyond what the method does: it would take hours */
  enum run_end end; /* of its process */
};

/* ---- One setting --------------------------------------------------------- */

static struct solver_request request_of(const struct accuracy_setting *setting,
                                        const recto_options *options,
                                        enum trial_part part) {
  struct solver_request request = trial_request(options, setting->lines, part);
  request.depth_bits = setting->depth_bits;
  request.subpixels = setting->subpixels;
  request.newell_tests = setting->newell_tests;
  return request;
}

static void run_setting(struct answer *answer,
                        const struct accuracy_setting *setting,
                        const struct scene *scene, const recto_options *options,
                        enum trial_part part, const struct trial *truth) {
  struct solver_request request = request_of(setting, options, part);
  double seconds[REPEATS], sum = 0;
  size_t n = 0;
  memset(answer, 0, sizeof *answer);
  answer->ok = true;
  while (n < REPEATS && answer->ok && (n == 0 || sum < ENOUGH_S)) {
    struct trial trial;
    trial_run_request(&trial, scene, options, setting->solver, &request);
    sum += seconds[n++] = trial.solve_s;
    answer->refused = trial.status == RECTO_ERROR_LIMIT;
    answer->ok = trial.status == RECTO_OK &&
                 (n > 1 || measure_map(&answer->measure, &truth->sheet,
                                       &truth->map, &trial.sheet, &trial.map));
    trial_fini(&trial);
  }
  answer->seconds = median_of(seconds, n);
}

/* The same in a process of its own. */
static void measure_setting(struct answer *answer,
                            const struct accuracy_setting *setting,
                            const struct scene *scene,
                            const recto_options *options, enum trial_part part,
                            const struct trial *truth) {
  int ends[2];
  *answer = (struct answer){.ok = false, .end = RUN_FAILED};
  fflush(NULL);
  if (pipe(ends) != 0)
    return;
  pid_t child = fork();
  if (child == 0) {
    run_setting(answer, setting, scene, options, part, truth);
    _exit(write(ends[1], answer, sizeof *answer) != (ssize_t)sizeof *answer);
  }
  close(ends[1]);
  if (child < 0)
    return;
  enum run_end end =
      run_answer(child, ends[0], LIMIT_S, answer, sizeof *answer);
  answer->ok = answer->ok && end == RUN_ANSWERED;
  answer->end = end;
}

/* ---- A scene ------------------------------------------------------------- */

/* A share that is nothing but rounding is nothing. */
static double clean(double share) { return share < SHARE_MIN ? 0 : share; }

static const char *const part_name[] = {
    [TRIAL_EDGES] = "lines", [TRIAL_FRAGMENTS] = "faces"};

/* One row; false where an exact method has an error, or any fails but for its
 * time or as it refuses so much. */
static bool print_row(FILE *file, const char *scene, enum trial_part part,
                      const struct accuracy_setting *setting,
                      const struct answer *answer) {
  const struct measure *m = &answer->measure;
  double truth = part == TRIAL_EDGES ? m->true_ink : m->true_area;
  fprintf(file, "\"%s\",%s,%s,%s,%s,", scene, part_name[part], setting->method,
          setting->knob, setting->value);
  if (!answer->ok) {
    fprintf(file, ",,,,,\n");
    bool excused = answer->end == RUN_OUT_OF_TIME ||
                   (answer->end == RUN_ANSWERED && answer->refused);
    if (!excused)
      fprintf(stderr, "accuracy: %s, %s: %s %s %s failed\n", scene,
              part_name[part], setting->method, setting->knob, setting->value);
    return excused;
  }
  double part_share[3] = {m->missing_ink, m->false_ink, 0};
  if (part == TRIAL_FRAGMENTS) {
    part_share[0] = m->missing_area;
    part_share[1] = m->false_area;
    part_share[2] = m->wrong_face;
  }
  double sum = 0;
  for (int k = 0; k < 3; k++)
    sum += part_share[k] = part == TRIAL_FRAGMENTS
                               ? clean(part_share[k] / truth)
                               : part_share[k] / truth;
  fprintf(file, "%.6f,%.4g,%.4g,%.4g,%.4g,%.6g\n", answer->seconds, sum,
          part_share[0], part_share[1], part_share[2], truth);
  if (setting->exact && sum > 0)
    fprintf(stderr, "accuracy: %s, %s: %s has an error of %g\n", scene,
            part_name[part], setting->method, sum);
  return !setting->exact || sum == 0;
}

static bool measure_part(FILE *file, const char *name,
                         const struct scene *scene,
                         const recto_options *options, enum trial_part part) {
  struct trial truth;
  bool ok = true;
  trial_run(&truth, scene, options, &solver_tiles, 0, part);
  if (truth.status != RECTO_OK)
    fprintf(stderr, "accuracy: %s has no exact map\n", name);
  for (const struct accuracy_setting *s = accuracy_settings;
       s->method != NULL && truth.status == RECTO_OK; s++) {
    struct answer answer;
    measure_setting(&answer, s, scene, options, part, &truth);
    ok = print_row(file, name, part, s, &answer) && ok;
  }
  ok = ok && truth.status == RECTO_OK;
  trial_fini(&truth);
  return ok;
}

static bool measure_scene(int index, const char *examples, const char *folder,
                          int argc, char **argv) {
  const char *id = accuracy_id[index];
  struct accuracy_names names;
  char path[4096];
  struct whole_file whole;
  struct scene scene;
  recto_options options;
  bool wanted = argc == 0, ok = false;
  double start = clock_wall();
  bool is_there = accuracy_scene(index, examples, &scene, &options, &names);
  for (int i = 0; i < argc; i++)
    if (strcmp(argv[i], id) == 0) {
      wanted = true;
      *argv[i] = '\0';
    }
  if (!is_there) {
    fprintf(stderr, "accuracy: no model for %s\n", id);
    scene_fini(&scene);
    return !wanted;
  }
  snprintf(path, sizeof path, "%s/%s.csv", folder, id);
  if (wanted && whole_open(&whole, path)) {
    FILE *file = whole.file;
    fputs("scene,part,method,knob,value,cpu_s,wrong,missing,false,"
          "wrong_face,truth\n",
          file);
    ok = measure_part(file, names.name, &scene, &options, TRIAL_EDGES);
    ok =
        measure_part(file, names.name, &scene, &options, TRIAL_FRAGMENTS) && ok;
    ok = whole_close(&whole, true) && ok;
    fprintf(stderr, "%s: %s, %.0f s\n", id, names.name, clock_wall() - start);
  } else if (wanted) {
    fprintf(stderr, "accuracy: cannot write %s\n", path);
  }
  scene_fini(&scene);
  return ok || !wanted;
}

int main(int argc, char **argv) {
  bool ok = true;
  if (argc < 3) {
    fputs("usage: accuracy EXAMPLES FOLDER [SCENE...]\n", stderr);
    return 2;
  }
  for (int i = 0; i < ACCURACY_SCENES; i++)
    ok = measure_scene(i, argv[1], argv[2], argc - 3, argv + 3) && ok;
  for (int i = 3; i < argc; i++)
    if (argv[i][0] != '\0') {
      fprintf(stderr, "accuracy: there is no scene %s\n", argv[i]);
      ok = false;
    }
  return !ok;
}
