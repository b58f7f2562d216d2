/* targets.c - the table of targets, and what they share. */
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"
#include "tests/fuzz/fuzz.h"

const struct fuzz_target *const fuzz_targets[] = {
    &fuzz_target_scene, &fuzz_target_mesh,    &fuzz_target_cli,
    &fuzz_target_obj,   &fuzz_target_mtl,     &fuzz_target_ply,
    &fuzz_target_stl,   &fuzz_target_svg,     &fuzz_target_part,
    &fuzz_target_plan,  &fuzz_target_options, NULL};

const struct fuzz_target *fuzz_find(const char *name) {
  for (int i = 0; fuzz_targets[i] != NULL; i++)
    if (strcmp(fuzz_targets[i]->name, name) == 0)
      return fuzz_targets[i];
  return NULL;
}

/* ---- Findings ------------------------------------------------------------ */

static bool is_ignored(const char *text) {
  const char *list = getenv("FUZZ_IGNORE");
  while (list != NULL && *list != '\0') {
    char word[100];
    size_t length = strcspn(list, ",");
    if (length > 0 && length < sizeof word) {
      memcpy(word, list, length);
      word[length] = '\0';
      if (strstr(text, word) != NULL)
        return true;
    }
    list += length + (list[length] == ',');
  }
  return false;
}

void fuzz_found(struct fuzz_finding *finding, const char *format, ...) {
  if (finding->text[0] != '\0')
    return;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(finding->text, sizeof finding->text, format, arguments);
  va_end(arguments);
  if (is_ignored(finding->text))
    finding->text[0] = '\0';
}

/* ---- Dictionaries -------------------------------------------------------- */

/* Words of each format; those of the command line are its own table's. */
static const struct {
  const char *target, *words;
} known[] = {
    {"obj", "v  vt  vn  f  l  g  o  usemtl  mtllib  s  # \\ / // -1 nan inf "
            "1e999 1e-999 4294967296 0.333333"},
    {"mtl", "newmtl  Kd  Ka  map_Kd  d  nan 1e999 -1e-999 1 0.5"},
    {"stl", "solid facet normal outer loop vertex endloop endfacet endsolid "
            "nan inf 1e999"},
    {"ply", "ply\n format  ascii binary_little_endian binary_big_endian 1.0 "
            "comment  element  vertex face edge tristrips property  list "
            "float double char uchar short ushort int uint int8 uint16 "
            "float64 x y z red green blue vertex_indices vertex_index "
            "vertex1 vertex2 end_header\n nan 1e999 4294967295"},
    {"svg", "<svg <path <polyline <polygon <line <rect <circle <ellipse <g "
            "</g> /> <!-- --> viewBox=\" width=\" height=\" transform=\" "
            "matrix( rotate( scale( translate( d=\" points=\" style=\" fill: "
            "none stroke class=\"hidden\" inkscape:label=\" mm 1e300 M L C Q S "
            "T A Z m l c h v"},
    {"cli", "iso front top 1,2,3 0 -1 1e300 nan 1in 2cm A4 letter 200x100mm "
            "1:2 all none silhouette border crease group intersection wire "
            "smooth dashed layer paint shade hatch near svg hpgl auto newell "
            "watkins warnock tiles brute zbuffer scanline-zbuffer painter "
            "hidden=2 silhouette=2 2=0.5mm 2=#c00 exact box first third "
            "front,top,iso:2 iso=none 97,136,6,2 1:1 auto"},
};

static void print_word(const char *word, size_t length, FILE *file) {
  fputc('"', file);
  for (size_t i = 0; i < length; i++) {
    if (word[i] == '"' || word[i] == '\\')
      fputc('\\', file);
    fputs(word[i] == '\n' ? "\\x0a" : (char[]){word[i], '\0'}, file);
  }
  fputs("\"\n", file);
}

void fuzz_print_dictionary(const struct fuzz_target *target, FILE *file) {
  /* libFuzzer refuses a dictionary that is empty. */
  fprintf(file, "# words of %s\n", target->name);
  for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
    if (strcmp(known[i].target, target->name) == 0)
      for (const char *word = known[i].words; *word != '\0';) {
        size_t length = strcspn(word, " ");
        /* A word that is followed by two spaces ends in one. */
        length += word[length] == ' ' && word[length + 1] == ' ';
        print_word(word, length, file);
        word += length;
        word += *word == ' ';
      }
  if (target != &fuzz_target_cli)
    return;
  for (int i = 0; !option_is_end(&option_table[i]); i++)
    if (option_table[i].name != NULL)
      fprintf(file, "\"--%s%s\"\n", option_table[i].name,
              option_table[i].argument != NULL ? "=" : "");
}
