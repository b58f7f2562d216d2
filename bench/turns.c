/* turns.c - how much a drawing changes when its camera moves a little.
 *
 *   turns FOLDER
 *
 * Eight scenes; turns, shifts and scalings by 1e-12 to 1e-3, 200 of each; the
 * largest and the median change of drawn length and of fragments' area, as
 * shares.  Writes FOLDER/turns.csv and FOLDER/turns.svg. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bench/plot.h"
#include "bench/table.h"
#include "tests/measure/turns.h"

enum { DECADES = 10, SMALLEST = -12, EACH = 200, ALL = EACH * TURN_KINDS };

enum { LENGTH_MOST, LENGTH_MEDIAN, AREA_MOST, AREA_MEDIAN, SERIES };

static const struct plot_series series[SERIES] = {
    {"drawn length, largest of 600 changes", "#0060a0", "", false, false,
     "none: length, largest"},
    {"drawn length, median", "#0060a0", "4 3", false, false,
     "none: length, median"},
    {"area of fragments, largest of 600 changes", "#b07000", "", false, false,
     "none: area, largest"},
    {"area of fragments, median", "#b07000", "4 3", false, false,
     "none: area, median"},
};

static const char *tick_power(int exponent) {
  static char text[16];
  snprintf(text, sizeof text, "1e%d", exponent);
  return text;
}

static const char *write_share(double share) {
  static char text[16];
  snprintf(text, sizeof text, "%.2g", share);
  return text;
}

static bool solve(struct trial *trial, const struct scene *scene,
                  const recto_options *options) {
  trial_run(trial, scene, options, &solver_tiles, 0, TRIAL_BOTH);
  return trial->status == RECTO_OK;
}

/* One decade of a scene: the changes, and how many had other topology. */
static bool take_decade(const struct scene *scene, const recto_options *options,
                        const struct trial *before, double by, double *length,
                        double *area, unsigned *other) {
  bool ok = true;
  *other = 0;
  for (int i = 0; i < ALL && ok; i++) {
    struct random random = {(uint64_t)i + 1};
    recto_options moved;
    struct trial after;
    struct turn_change change;
    turn_camera(&moved, options, (enum turn_kind)(i % TURN_KINDS), by, &random);
    ok = solve(&after, scene, &moved) && turn_compare(&change, before, &after);
    if (ok) {
      length[i] = change.length;
      area[i] = change.area;
      *other += change.edges + change.faces > 0;
    }
    trial_fini(&after);
  }
  return ok;
}

static bool take_scene(struct plot *plot, int index, FILE *csv) {
  static double length[ALL], area[ALL];
  struct scene scene;
  recto_options options;
  struct trial before;
  turn_scene(&scene, &options, index);
  bool ok = solve(&before, &scene, &options);
  snprintf(plot->panel[index], PLOT_TEXT, "%s", turn_scenes[index].name);
  for (int d = 0; d < DECADES && ok; d++) {
    double by = pow(10, SMALLEST + d), value[SERIES];
    unsigned other;
    ok = take_decade(&scene, &options, &before, by, length, area, &other);
    value[LENGTH_MEDIAN] = median_of(length, ALL);
    value[AREA_MEDIAN] = median_of(area, ALL);
    value[LENGTH_MOST] = length[ALL - 1]; /* they are sorted now */
    value[AREA_MOST] = area[ALL - 1];
    for (int s = 0; s < SERIES; s++)
      plot_add(plot, index, s, by, value[s], "");
    fprintf(csv, "\"%s\",%g,%.4g,%.4g,%.4g,%.4g,%u\n", turn_scenes[index].name,
            by, value[LENGTH_MOST], value[LENGTH_MEDIAN], value[AREA_MOST],
            value[AREA_MEDIAN], other);
  }
  trial_fini(&before);
  scene_fini(&scene);
  return ok;
}

int main(int argc, char **argv) {
  static struct plot plot;
  struct whole_file csv;
  char path[4096];
  if (argc != 2) {
    fputs("usage: turns FOLDER\n", stderr);
    return 2;
  }
  plot = (struct plot){
      .title = "What a small move of the camera changes in the drawing",
      .x_title = "turned by (radians), shifted by (of the distance), scaled by",
      .y_title = "share that changes",
      .x_tick = tick_power,
      .y_tick = tick_power,
      .y_value = write_share,
      .y_least = 1e-14,
      .series = series,
      .series_count = SERIES,
      .panels = TURN_SCENES,
      .columns = 2};
  snprintf(path, sizeof path, "%s/turns.csv", argv[1]);
  bool ok = whole_open(&csv, path);
  if (ok) {
    fputs("scene,by,length_most,length_median,area_most,area_median,"
          "with_other_topology\n",
          csv.file);
    for (int i = 0; i < TURN_SCENES && ok; i++)
      ok = take_scene(&plot, i, csv.file);
    ok = whole_close(&csv, ok);
  }
  snprintf(path, sizeof path, "%s/turns.svg", argv[1]);
  ok = ok && plot_write(&plot, path);
  if (!ok)
    fprintf(stderr, "turns: cannot chart into %s\n", argv[1]);
  return !ok;
}
