/* decode.c - see decode.h. */
#include "tests/fuzz/decode.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

struct source {
  const uint8_t *at, *end;
};

static unsigned next(struct source *source) {
  return source->at < source->end ? *source->at++ : 0;
}

static const char *choose(struct source *source, const char *const *from,
                          size_t count) {
  return from[next(source) % count];
}

/* ---- Options -------------------------------------------------------------
 * Words of one alternative are separated by spaces; "" says nothing. */

enum { MAX_ALTERNATIVES = 10 };

/* No row may be removed or moved: the corpus would say something else.  New
 * rows go to the end, of OPTION_BYTES at most. */
enum { OPTION_BYTES = 24 };
static const char *const alternatives[][MAX_ALTERNATIVES] = {
    {"", "--edges=all", "--edges=silhouette,border", "--edges=intersection",
     "--edges=smooth,crease", "--edges=none", "--edges=group,wire,border",
     "--edges=all"},
    {"", "--fill=paint", "--fill=shade", "--fill=hatch",
     "--fill=hatch --light=1,2,3", "--fill=hatch --hatch-inset",
     "--fill=paint"},
    {"", "--hidden=dashed", "--hidden=layer", "--hidden=1", "--hidden=layer,2",
     "--hidden=2"},
    {"", "--contact=0", "--contact=0.001", "--contact=0.1", "--contact=0.5",
     "--contact=1e-9", "--contact=0"},
    {"", "--section=1", "--section=0.5", "--section=2", "--section=-1",
     "--section=0"},
    {"", "--near=0.5", "--near=1", "--near=1.5", "--near=0.001"},
    {"", "--crease=0", "--crease=90", "--crease=180", "--crease=45",
     "--crease=60", "--crease=20,50"},
    {"", "--no-fit", "--scale=10", "--scale=100", "--fit", "--scale=1:2"},
    {"", "--page=20x20", "--page=A4 --landscape", "--page=50x200", "--margin=0",
     "--margin=3cm"},
    {"", "--seam=0.5", "--pens=2", "--weights=none", "--pen=2",
     "--pen-for=crease=2,hidden=3", "--ids", "--path=polyline"},
    {"", "--hatch-pitch=3", "--hatch-angle=0", "--hatch-angle=90 --pen=0.5",
     "--hatch-pitch=0.5"},
    {"", "--order=near", "--simplify=0.1", "--simplify=3 --order=near",
     "--min-stroke=0", "--min-stroke=5"},
    {"", "--precision=9", "--precision=6 --min-stroke=0", "--precision=0"},
    {"", "--up=0,0,1", "--up=1,0,0", "--up=1,1,1"},
    {"--threads=1", "--threads=2"},
    {"", "--divide=box"},
    {"", "", "--contours=smooth"},
    {"", "", "--curves=0.1", "--curves=4"},
    {"", "", "--ambient=0", "--ambient=1 --fill-light=0", "--fill-light=1"},
    {"", "", "", "--dash=crease=chain,border=0.5pen:3pen",
     "--dash=silhouette=3,smooth=phantom --hidden=dashed --dash=hidden=2:1"},
    {"", "", "", "--background=navy --ids --id-prefix=a", "--title= --desc="},
    {"", "", "--cut=x=1", "--cut=y<1 --cut=z=0.5", "--cut=1,2,3,4",
     "--cut=x=0 --cut=y=0 --cut=z=0 --cut-fill=solid",
     "--cut=z=1 --cut-fill=none"},
    {"", "", "", "--sheet=first", "--sheet=third --view-names --title=A",
     "--views=front,iso:2 --hidden-in=iso=none --view-names",
     "--sheet=third --views=left,top,back,dimetric:1:2 --scale=auto",
     "--sheet=third --scale=5 --detail=97,136,6,2 --detail=97,160,9,3",
     "--scale=10 --detail=105,148,8,2"},
};

/* ---- Words --------------------------------------------------------------- */

static void add_word(struct decoded *d, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
static void add_word(struct decoded *d, const char *format, ...) {
  char *word = d->words + d->words_length;
  size_t room = sizeof d->words - d->words_length;
  va_list arguments;
  va_start(arguments, format);
  int length = vsnprintf(word, room, format, arguments);
  va_end(arguments);
  if (length < 0 || (size_t)length >= room || d->argc + 1 >= DECODE_MAX_WORDS)
    return;
  d->argv[d->argc++] = word;
  d->words_length += (size_t)length + 1;
}

static void add_words(struct decoded *d, const char *text) {
  while (*text != '\0') {
    size_t length = strcspn(text, " ");
    add_word(d, "%.*s", (int)length, text);
    text += length + (text[length] == ' ');
  }
}

static bool has_word(const struct decoded *d, const char *begin) {
  for (int i = 0; i < d->argc; i++)
    if (strncmp(d->argv[i], begin, strlen(begin)) == 0)
      return true;
  return false;
}

static void add_options(struct decoded *d, struct source *source) {
  for (size_t i = 0; i < COUNT(alternatives); i++) {
    size_t count = 0;
    while (count < MAX_ALTERNATIVES && alternatives[i][count] != NULL)
      count++;
    add_words(d, choose(source, alternatives[i], count));
  }
  for (size_t i = COUNT(alternatives); i < OPTION_BYTES; i++)
    (void)next(source);
}

/* ---- The camera ---------------------------------------------------------- */

static const char *const views[] = {"--view=iso",
                                    "--view=front",
                                    "--view=top",
                                    "--view=right",
                                    "--view=left",
                                    "--view=back",
                                    "--view=bottom",
                                    "--view=dimetric",
                                    "--view=trimetric",
                                    "--azimuth=45 --elevation=0",
                                    "--azimuth=26.56505117707799 --elevation=0",
                                    "--azimuth=0 --elevation=45",
                                    "--azimuth=0.0001",
                                    "--azimuth=89.9999999 --elevation=1e-7"};

/* Places of the eye: the lattice of the points and some that are farther. */
static const char *const places[] = {
    "0",  "1", "-1", "2",  "-2",  "0.5",  "-0.5", "1.5",     "3",
    "-3", "5", "-5", "10", "-10", "0.25", "100",  "0.333333"};

static void add_place(struct decoded *d, struct source *source,
                      const char *option) {
  const char *x = choose(source, places, COUNT(places));
  const char *y = choose(source, places, COUNT(places));
  const char *z = choose(source, places, COUNT(places));
  add_word(d, "--%s=%s,%s,%s", option, x, y, z);
}

/* A named view, alone or in perspective, or an eye on the lattice. */
static void add_any_camera(struct decoded *d, struct source *source) {
  static const char *const angles[] = {"--fov=30", "--fov=60", "--fov=90",
                                       "--fov=150", "--fov=1"};
  unsigned kind = next(source) % 8;
  if (kind < 4) {
    add_words(d, choose(source, views, COUNT(views)));
    if (kind == 3)
      add_words(d, choose(source, angles, COUNT(angles)));
    return;
  }
  add_place(d, source, "camera");
  if (kind >= 6)
    add_place(d, source, "lookat");
  if (kind == 5)
    add_words(d, "--ortho");
  else
    add_words(d, choose(source, angles, COUNT(angles)));
}

static void remove_words(struct decoded *d, const char *begin) {
  int kept = 0;
  for (int i = 0; i < d->argc; i++)
    if (strncmp(d->argv[i], begin, strlen(begin)) != 0)
      d->argv[kept++] = d->argv[i];
  d->argc = kept;
}

/* A sheet says what is seen from where, and one of a single view with details
 * has no eye; the bytes are read all the same.  What all sheets refuse is left
 * out. */
static void add_camera(struct decoded *d, struct source *source) {
  static const char *const directions[] = {
      "--view=", "--azimuth=", "--elevation="};
  static const char *const refused[] = {"--camera=", "--lookat=",  "--ortho",
                                        "--fov=",    "--section=", "--no-fit"};
  add_any_camera(d, source);
  bool has_views = has_word(d, "--sheet=") || has_word(d, "--views=");
  for (size_t i = 0; has_views && i < COUNT(directions); i++)
    remove_words(d, directions[i]);
  for (size_t i = 0;
       (has_views || has_word(d, "--detail=")) && i < COUNT(refused); i++)
    remove_words(d, refused[i]);
}

/* ---- The scene ----------------------------------------------------------- */

/* Three in four coordinates are on the lattice, the others off it: thirds and
 * tenths, a hair beside, and far out. */
static const char *const lattice[] = {"0",   "1",   "2",    "-1",  "-2",
                                      "0.5", "1.5", "-0.5", "-1.5"};
static const char *const beside[] = {"0.333333",
                                     "0.6666666666666666",
                                     "0.1",
                                     "0.3",
                                     "1.7",
                                     "1.0000001",
                                     "0.9999999",
                                     "1e-7",
                                     "1.0000000000000002",
                                     "-1e-16",
                                     "1.001",
                                     "0.25",
                                     "0.50000006",
                                     "0.3333333333333333",
                                     "3",
                                     "4",
                                     "5",
                                     "7",
                                     "3.5",
                                     "1000",
                                     "0.0001"};

static const char *choose_coordinate(struct source *source) {
  unsigned byte = next(source);
  return byte < 192 ? lattice[byte % COUNT(lattice)]
                    : beside[byte % COUNT(beside)];
}

static void add_text(struct decoded *d, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
static void add_text(struct decoded *d, const char *format, ...) {
  size_t room = sizeof d->obj - d->obj_length;
  va_list arguments;
  va_start(arguments, format);
  int length = vsnprintf(d->obj + d->obj_length, room, format, arguments);
  va_end(arguments);
  if (length > 0 && (size_t)length < room)
    d->obj_length += (size_t)length;
}

enum { MAX_POINTS = 16 };

struct points {
  const char *item[MAX_POINTS][3];
  unsigned count;
};

static void add_points(struct decoded *d, struct source *source,
                       struct points *points) {
  points->count = 3 + next(source) % (MAX_POINTS - 2);
  for (unsigned i = 0; i < points->count; i++) {
    const char **point = points->item[i];
    for (int k = 0; k < 3; k++)
      point[k] = choose_coordinate(source);
    add_text(d, "v %s %s %s\n", point[0], point[1], point[2]);
  }
}

/* Adds the corner of the box between two points: bit k of `which` selects whose
 * coordinate k is. */
static void add_corner(struct decoded *d, const char *const *a,
                       const char *const *b, unsigned which) {
  add_text(d, "v %s %s %s\n", which & 1 ? b[0] : a[0], which & 2 ? b[1] : a[1],
           which & 4 ? b[2] : a[2]);
}

/* A side of the box between two points, which is planar whatever they are. */
static void add_rectangle(struct decoded *d, const char *const *a,
                          const char *const *b, unsigned axis) {
  unsigned u = 1U << (axis + 1) % 3, v = 1U << (axis + 2) % 3;
  add_corner(d, a, b, 0);
  add_corner(d, a, b, u);
  add_corner(d, a, b, u | v);
  add_corner(d, a, b, v);
  add_text(d, "f -4 -3 -2 -1\n");
}

static void add_box(struct decoded *d, const char *const *a,
                    const char *const *b) {
  for (unsigned which = 0; which < 8; which++)
    add_corner(d, a, b, which);
  add_text(d, "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\n"
              "f -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3\n");
}

/* Corners are any points, the same one again too. */
static void add_polygon(struct decoded *d, struct source *source,
                        const struct points *points, const char *word,
                        unsigned corners) {
  add_text(d, "%s", word);
  for (unsigned k = 0; k < corners; k++)
    add_text(d, " %u", 1 + next(source) % points->count);
  add_text(d, "\n");
}

/* Of sixteen elements ten are polygons, three rectangles, two boxes and one is
 * a polyline. */
static void add_elements(struct decoded *d, struct source *source,
                         const struct points *points) {
  unsigned count = 2 + next(source) % 7;
  for (unsigned i = 0; i < count; i++) {
    unsigned byte = next(source), kind = byte / 16;
    if (byte / 4 % 4 > 0)
      add_text(d, "g %c\n", "abc"[byte / 4 % 4 - 1]);
    if (kind < 10 || kind == 15) {
      add_polygon(d, source, points, kind == 15 ? "l" : "f", 3 + byte % 4);
      continue;
    }
    const char *const *a = points->item[next(source) % points->count];
    const char *const *b = points->item[next(source) % points->count];
    if (kind < 13)
      add_rectangle(d, a, b, byte % 4);
    else
      add_box(d, a, b);
  }
}

void decode_scene(struct decoded *decoded, const uint8_t *bytes, size_t count) {
  struct source source = {bytes, bytes + count};
  struct points points;
  decoded->obj_length = decoded->words_length = 0;
  decoded->argc = 0;
  decoded->obj[0] = '\0';
  add_word(decoded, "recto");
  add_options(decoded, &source);
  add_camera(decoded, &source);
  add_points(decoded, &source, &points);
  add_elements(decoded, &source, &points);
  add_words(decoded, "-o out.svg model.obj");
  decoded->argv[decoded->argc] = NULL;
}
