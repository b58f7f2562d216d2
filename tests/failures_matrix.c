/* failures_matrix.c - what each method makes of each scene of the list.
 *   failures_matrix          two Markdown tables: the share of the visible
 *                            lines that is missing or false, and the share of
 *                            the covered area that is of the wrong face, or of
 *                            none
 *   failures_matrix FOLDER   the pictures of doc/failures.md, as SVG
 *
 * The map of brute force is taken as right. */
#include <stdio.h>

#include "base/memory.h"
#include "base/stream.h"
#include "tests/measure/trial.h"
#include "tests/scenes/pipeline.h"

/* What rounding in the sums of areas amounts to; more is an error. */
static const double share_min = 1e-9;

enum { LINES = 200 }; /* over the page: pixels, or scan lines */

struct column {
  const char *heading;
  const struct solver *solver; /* NULL: the one that auto takes */
  int lines, depth_bits;       /* 0: exact; double precision */
};

static const struct column columns[] = {
    {"auto", NULL, 0, 0},
    {"brute", &solver_brute, 0, 0},
    {"newell", &solver_newell, 0, 0},
    {"warnock", &solver_warnock, 0, 0},
    {"watkins", &solver_watkins, 0, 0},
    {"tiles", &solver_tiles, 0, 0},
    {"warnock, pixels", &solver_warnock, LINES, 0},
    {"watkins, pitch", &solver_watkins, LINES, 0},
    {"zbuffer", &solver_zbuffer, LINES, 0},
    {"zbuffer, 16 bits", &solver_zbuffer, LINES, 16},
    {"scanline-zbuffer", &solver_scanline_zbuffer, LINES, 0},
    {"painter", &solver_painter, 0, 0},
    {"painter-given", &solver_painter_given, 0, 0},
};
enum { COLUMNS = sizeof columns / sizeof *columns };

static void print_head(void) {
  printf("| scene |");
  for (int i = 0; i < COLUMNS; i++)
    printf(" %s |", columns[i].heading);
  printf("\n|---|");
  for (int i = 0; i < COLUMNS; i++)
    printf("---|");
  printf("\n");
}

/* Two digits of a per cent.
 * least  what is less is rounding */
static void print_share(double share, double least) {
  if (share <= least)
    printf(" right |");
  else if (share < 1e-5)
    printf(" < 0.001 %% |");
  else if (share < 0.995)
    printf(" %.2g %% |", 100 * share);
  else
    printf(" 100 %% |");
}

static void print_measure(const struct measure *measure, enum trial_part part) {
  bool edges = part == TRIAL_EDGES;
  if ((edges ? measure->true_ink : measure->true_area) == 0)
    printf(" none |");
  else if (edges)
    print_share(measure_ink_share(measure), 0);
  else
    print_share(measure_area_share(measure), share_min);
}

static void print_cell(const struct scene *scene, const recto_options *given,
                       const struct column *column, enum trial_part part,
                       const struct trial *truth) {
  recto_options options = *given;
  struct trial trial;
  struct measure measure;
  options.solver.depth_bits = column->depth_bits;
  trial_run(&trial, scene, &options, column->solver, column->lines, part);
  if (trial.status != RECTO_OK)
    printf(" refused |");
  else if (!measure_map(&measure, &truth->sheet, &truth->map, &trial.sheet,
                        &trial.map))
    printf(" no memory |");
  else
    print_measure(&measure, part);
  trial_fini(&trial);
}

static void print_row(const struct scenes_entry *entry, enum trial_part part) {
  struct scene scene;
  recto_options options;
  struct trial truth;
  scene_init(&scene);
  recto_options_init(&options);
  entry->fill(&scene, &options);
  trial_run(&truth, &scene, &options, &solver_brute, 0, part);
  printf("| %s |", entry->name);
  for (int i = 0; i < COLUMNS; i++)
    print_cell(&scene, &options, &columns[i], part, &truth);
  printf("\n");
  trial_fini(&truth);
  scene_fini(&scene);
}

static int print_tables(void) {
  static const struct {
    enum trial_part part;
    const char *title;
  } tables[] = {{TRIAL_EDGES, "Lines"}, {TRIAL_FRAGMENTS, "Faces"}};
  for (int t = 0; t < 2; t++) {
    printf("### %s\n\n", tables[t].title);
    print_head();
    for (const struct scenes_entry *entry = scene_list; entry->name; entry++)
      print_row(entry, tables[t].part);
    printf(t == 0 ? "\n" : "");
  }
  return fflush(stdout) != 0;
}

/* ---- Pictures ------------------------------------------------------------ */

static const struct picture {
  const char *name, *scene;
  struct column column;
  bool painted;
} pictures[] = {
    {"cycle-painter", "cycle of 3", {"", &solver_painter, 0, 0}, true},
    {"cycle", "cycle of 3", {"", &solver_newell, 0, 0}, true},
    {"sheets-painter", "three sheets", {"", &solver_painter, 0, 0}, true},
    {"sheets", "three sheets", {"", &solver_newell, 0, 0}, true},
    {"near-zbuffer", "sheets 1e-6 apart", {"", &solver_zbuffer, 60, 16}, true},
    {"near", "sheets 1e-6 apart", {"", &solver_tiles, 0, 0}, true},
    {"boxes-watkins", "crossed boxes", {"", &solver_watkins, 40, 0}, false},
    {"boxes", "crossed boxes", {"", &solver_watkins, 0, 0}, false},
    {"table-zbuffer", "large table", {"", &solver_zbuffer, 80, 0}, true},
    {"table", "large table", {"", &solver_tiles, 0, 0}, true},
    {"room-painter", "room from inside", {"", &solver_painter, 0, 0}, true},
    {"room", "room from inside", {"", &solver_tiles, 0, 0}, true},
    {"coplanar-zbuffer", "coplanar faces", {"", &solver_zbuffer, 60, 0}, true},
    {"coplanar", "coplanar faces", {"", &solver_tiles, 0, 0}, true},
    {"surface-zbuffer", "sinc", {"", &solver_zbuffer, 100, 0}, false},
    {"surface", "sinc", {"", &solver_tiles, 0, 0}, false},
    {"table-painter", "large table", {"", &solver_painter, 0, 0}, true},
    {"plates-painter", "plates", {"", &solver_painter, 0, 0}, true},
    {"plates", "plates", {"", &solver_tiles, 0, 0}, true},
    {"plane-watkins", "eye on a plane", {"", &solver_watkins, 60, 0}, false},
    {"plane", "eye on a plane", {"", &solver_watkins, 0, 0}, false},
    {"tube-given",
     "self-intersecting",
     {"", &solver_painter_given, 0, 0},
     true},
    {"tube", "self-intersecting", {"", &solver_tiles, 0, 0}, true},
    {"needles-painter", "needles", {"", &solver_painter, 0, 0}, true},
    {"needles", "needles", {"", &solver_tiles, 0, 0}, true},
};

/* False where the file cannot be written. */
static bool draw_picture(const struct picture *picture, const char *folder) {
  char path[4096];
  struct scene scene;
  recto_options options;
  size_t length;
  scene_init(&scene);
  recto_options_init(&options);
  scenes_find(picture->scene)->fill(&scene, &options);
  options.ink.fill = picture->painted ? RECTO_FILL_PAINT : RECTO_FILL_NONE;
  options.output.precision = 2;
  options.solver.depth_bits = picture->column.depth_bits;
  options.solver.resolution = picture->column.lines;
  options.solver.pitch_mm =
      picture->column.lines > 0 ? 100.0 / picture->column.lines : 0;
  char *text = pipeline_draw(&scene, &options, picture->column.solver, &length);
  snprintf(path, sizeof path, "%s/%s.svg", folder, picture->name);
  struct stream *stream;
  bool ok = stream_open(&stream, path, NULL) == RECTO_OK;
  if (ok) {
    stream_write(stream, text, length);
    ok = stream_finish(stream, NULL) == RECTO_OK;
  }
  mem_free(text);
  scene_fini(&scene);
  return ok;
}

int main(int argc, char **argv) {
  if (argc < 2)
    return print_tables();
  for (size_t i = 0; i < sizeof pictures / sizeof *pictures; i++)
    if (!draw_picture(&pictures[i], argv[1])) {
      fprintf(stderr, "failures_matrix: cannot write into %s\n", argv[1]);
      return 1;
    }
  return 0;
}
