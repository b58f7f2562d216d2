/* parse.c - reads the command line by the table of options. */
#include "cli/parse.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/frames.h"
#include "cli/lists.h"
#include "cli/multiview.h"
#include "cli/options.h"
#include "cli/value.h"

enum { FIRST_LONG = 256 };

/* ---- The table for getopt_long ------------------------------------------- */

static int has_argument(const struct option_entry *entry) {
  return entry->argument == NULL     ? no_argument
         : entry->argument[0] == '[' ? optional_argument
                                     : required_argument;
}

/* Fills what getopt_long needs.  Starts `letters` with ':' so that a missing
 * value is distinguished from an unknown option. */
static void fill_getopt(struct option longs[MAX_OPTIONS],
                        char letters[3 * MAX_OPTIONS]) {
  size_t count = 0, length = 0;
  letters[length++] = ':';
  for (int i = 0; !option_is_end(&option_table[i]); i++) {
    const struct option_entry *entry = &option_table[i];
    if (entry->kind == OPTION_HEADING)
      continue;
    longs[count++] =
        (struct option){entry->name, has_argument(entry), NULL, FIRST_LONG + i};
    if (entry->letter != 0) {
      letters[length++] = entry->letter;
      if (entry->argument != NULL)
        letters[length++] = ':';
    }
  }
  longs[count] = (struct option){0};
  letters[length] = '\0';
}

/* The entry that getopt_long's `code` stands for, or NULL. */
static const struct option_entry *find_entry(int code) {
  if (code >= FIRST_LONG)
    return &option_table[code - FIRST_LONG];
  for (const struct option_entry *entry = option_table; !option_is_end(entry);
       entry++)
    if (entry->letter == code && code != 0)
      return entry;
  return NULL;
}

/* ---- One option ---------------------------------------------------------- */

static bool in_range(const struct option_entry *entry, double value) {
  return value >= entry->least && value <= entry->most;
}

static bool is_nothing(const double vector[3]) {
  return vector[0] == 0 && vector[1] == 0 && vector[2] == 0;
}

/* Parses and stores the option's value, which is no list; false where it is
 * not valid. */
static bool store_value(struct arguments *arguments,
                        const struct option_entry *entry, const char *text) {
  void *to = (char *)arguments + entry->offset;
  double number;
  int integer;
  switch (entry->kind) {
  case OPTION_FLAG:
    *(bool *)to = true;
    return true;
  case OPTION_TEXT:
    *(const char **)to = text;
    return text == NULL || *text != '\0';
  case OPTION_CAPTION:
    *(const char **)to = text;
    return true;
  case OPTION_NUMBER:
  case OPTION_LENGTH:
    if (!(entry->kind == OPTION_LENGTH ? value_length : value_number)(text,
                                                                      &number))
      return false;
    *(double *)to = number;
    return in_range(entry, number);
  case OPTION_INT:
    if (!value_int(text, &integer))
      return false;
    *(int *)to = integer;
    return in_range(entry, integer);
  case OPTION_VECTOR:
    return value_vector(text, to) &&
           (entry->least == 0 || !is_nothing((const double *)to));
  case OPTION_WORD:
    if (!(entry->word != NULL ? value_name(text, entry->word, &integer)
                              : value_word(text, entry->words, &integer)))
      return false;
    *(unsigned *)to = (unsigned)integer; /* as an enumeration is */
    return true;
  case OPTION_PARSED:
    return entry->parse(arguments, text);
  case OPTION_LIST:
  case OPTION_HEADING:
  case OPTION_ABSENT:
    break;
  }
  return false;
}

static void explain_absent(const struct option_entry *entry,
                           char message[MESSAGE_SIZE]) {
  snprintf(message, MESSAGE_SIZE, "--%s is not available in this build",
           entry->name);
}

static bool is_same_text(const char *a, const char *b) {
  return a == NULL || b == NULL ? a == b : strcmp(a, b) == 0;
}

/* Notes that the option was given, and which value of it is replaced. */
static bool note_value(struct arguments *arguments,
                       const struct option_entry *entry, const char *text,
                       char message[MESSAGE_SIZE]) {
  size_t i = (size_t)(entry - option_table);
  const char *before = arguments->text[i];
  bool is_new = !arguments->seen[i] || is_same_text(before, text);
  arguments->seen[i] = true;
  arguments->text[i] = text;
  if (is_new || entry->adds || entry->kind == OPTION_LIST)
    return true;
  if (entry->is_file && before != NULL && text != NULL) {
    snprintf(message, MESSAGE_SIZE,
             "--%s takes one file, not both \"%.60s\" and \"%.60s\"",
             entry->name, before, text);
    return false;
  }
  arguments->is_replaced[i] = true;
  arguments->replaced[i] = before;
  return true;
}

static bool parse_option(struct arguments *arguments,
                         const struct option_entry *entry, char *text,
                         char message[MESSAGE_SIZE]) {
  if (entry->kind == OPTION_ABSENT) {
    explain_absent(entry, message);
    return false;
  }
  if (entry->kind == OPTION_LIST) {
    if (!lists_parse(arguments, entry, text, message))
      return false;
  } else if (!store_value(arguments, entry, text)) {
    snprintf(message, MESSAGE_SIZE, "--%s: expected %s, not \"%.60s\"",
             entry->name, entry->expected, text);
    return false;
  }
  if (!note_value(arguments, entry, text, message))
    return false;
  if (entry->given != 0)
    *((bool *)((char *)arguments + entry->given)) = true;
  return true;
}

/* Sets the message for an error of getopt_long. */
static void explain_getopt_error(int code, char **argv,
                                 char message[MESSAGE_SIZE]) {
  const struct option_entry *entry = find_entry(optopt);
  if (entry != NULL && entry->kind == OPTION_ABSENT)
    explain_absent(entry, message);
  else if (code == ':')
    snprintf(message, MESSAGE_SIZE, "--%s: expected %s", entry->name,
             entry->expected != NULL ? entry->expected : "a value");
  else if (entry != NULL)
    snprintf(message, MESSAGE_SIZE, "--%s takes no value", entry->name);
  else if (optopt != 0)
    snprintf(message, MESSAGE_SIZE, "unknown option -%c: see recto --help",
             optopt);
  else
    snprintf(message, MESSAGE_SIZE, "unknown option %.60s: see recto --help",
             argv[optind - 1]);
}

/* ---- Rules for several options ------------------------------------------- */

static bool settle_camera(struct arguments *a, char message[MESSAGE_SIZE]) {
  const char *wrong = NULL;
  bool turned = a->azimuth_given || a->elevation_given;
  if (a->eye_given && (a->view_given || turned))
    wrong = "--camera and --view, --azimuth or --elevation exclude each other";
  else if (a->eye_given && a->turntable > 0)
    wrong = "--camera and --turntable exclude each other";
  else if (a->turntable > 0 && a->options.output.tight &&
           a->options.camera.fit != RECTO_FIT_PAGE)
    wrong =
        "--tight crops the frames of --turntable alike only where they fill "
        "the page: leave out --scale and --no-fit, or --tight";
  else if (a->turntable > 0 && a->view_count > 1)
    wrong = "--turntable takes one --view to begin with";
  else if (a->view_count > 1 && turned)
    wrong = "--azimuth and --elevation take one --view to begin with";
  else if (a->ortho && a->fov_given)
    wrong = "--ortho and --fov exclude each other";
  if (wrong != NULL) {
    snprintf(message, MESSAGE_SIZE, "%s", wrong);
    return false;
  }
  if (a->eye_given) {
    a->options.camera.kind = RECTO_CAMERA_EYE;
    if (!a->ortho && !a->fov_given)
      a->options.camera.fov_deg = 30;
  }
  return true;
}

/* How many of --plan, --part and --join are given. */
static int count_part_modes(const struct arguments *a) {
  return (a->planned_parts > 0) + (a->parts > 0) + a->joins;
}

/* An error of the options for parts and frames; NULL: none. */
static const char *judge_parts(const struct arguments *a) {
  if (a->past_frame > 0 && a->turntable > 0 && a->past_frame > a->turntable)
    return "--frames goes beyond the last drawing of --turntable";
  if (a->plan != NULL && a->parts == 0)
    return "--parts-plan is for --part";
  if (a->plan != NULL && a->model_count > 0)
    return "--parts-plan has what a part needs of the model: leave out the "
           "model";
  if (count_part_modes(a) == 0)
    return NULL;
  if (a->parts > 0 && a->joins)
    return "--part and --join exclude each other";
  if (count_part_modes(a) > 1)
    return "--plan, --part and --join exclude each other";
  if (a->check_file != NULL)
    return "--check takes none of --plan, --part and --join";
  if (frames_count(a) > 1)
    return "--plan, --part and --join make one drawing: leave out --turntable "
           "and further views";
  if (!a->joins && a->stats)
    return a->parts > 0 ? "--part makes no drawing: leave out --stats"
                        : "--plan makes no drawing: leave out --stats";
  return NULL;
}

/* Whether no option is given that the plan of --parts-plan decides. */
static bool judge_plan(const struct arguments *a, char message[MESSAGE_SIZE]) {
  for (int i = 0; a->plan != NULL && !option_is_end(&option_table[i]); i++) {
    const struct option_entry *entry = &option_table[i];
    if (!a->seen[i] || !entry->of_parts || entry->of_solver)
      continue;
    snprintf(message, MESSAGE_SIZE,
             "--%s is decided by the plan: give it to --plan, not to --part",
             entry->name);
    return false;
  }
  return true;
}

/* An error of the files' names; NULL: none. */
static const char *judge_files(const struct arguments *a) {
  if (a->model_count == 0 && a->plan == NULL)
    return "no model: see recto --help";
  if (a->check_file != NULL && (a->output != NULL || a->stats ||
                                a->options.verify > 0 || a->format != NULL))
    return "--check draws nothing: leave out --output, --format, --stats and "
           "--verify";
  if (a->check_file != NULL && frames_count(a) > 1)
    return "--check takes one view";
  if (a->output == NULL && a->check_file == NULL)
    return "no output: say -o FILE";
  for (int i = 0; i < a->model_count && a->from == NULL && !a->joins; i++)
    if (strcmp(a->model[i], "-") == 0)
      return "standard input needs --from FORMAT";
  return NULL;
}

const char *arguments_format(const struct arguments *a) {
  if ((a->parts > 0 || a->planned_parts > 0) && a->format == NULL)
    return a->options.output.device != NULL ? "hpgl" : "svg";
  return recto_output_format(a->output, a->format);
}

/* Says that there is no such output format, and which there are. */
static void explain_format(const struct arguments *a,
                           char message[MESSAGE_SIZE]) {
  const char *name;
  int used = snprintf(message, MESSAGE_SIZE,
                      "there is no output format for \"%.100s\": it is one of",
                      a->format != NULL ? a->format : a->output);
  for (size_t i = 0; (name = recto_output_format_name(i)) != NULL && used > 0 &&
                     used < MESSAGE_SIZE;
       i++)
    used += snprintf(message + used, MESSAGE_SIZE - (size_t)used, "%s %s",
                     i > 0 ? "," : "", name);
}

static bool settle_files(struct arguments *a, char message[MESSAGE_SIZE]) {
  const char *wrong = judge_files(a);
  if (wrong == NULL)
    wrong = judge_parts(a);
  if (wrong != NULL) {
    snprintf(message, MESSAGE_SIZE, "%s", wrong);
    return false;
  }
  if (!judge_plan(a, message))
    return false;
  if (a->output == NULL)
    return true;
  const char *pattern[] = {a->output, a->stats_file};
  for (int k = 0; k < 2; k++) {
    const char *fault = pattern[k] != NULL ? frame_fault(a, pattern[k]) : NULL;
    if (fault != NULL) {
      snprintf(message, MESSAGE_SIZE, "several drawings: %s \"%.60s\" %s",
               k == 0 ? "the output" : "--stats", pattern[k], fault);
      return false;
    }
  }
  if (arguments_format(a) == NULL) {
    explain_format(a, message);
    return false;
  }
  return true;
}

static bool settle_page(struct arguments *a, char message[MESSAGE_SIZE]) {
  recto_page_options *page = &a->options.page;
  double width = page->width_mm;
  if (a->landscape && a->portrait) {
    snprintf(message, MESSAGE_SIZE,
             "--landscape and --portrait exclude each other");
    return false;
  }
  /* The page of a turntable is the same all around. */
  if (a->landscape || a->portrait || a->turntable > 0)
    page->may_turn = false;
  if (a->landscape ? width < page->height_mm
                   : a->portrait && width > page->height_mm) {
    page->width_mm = page->height_mm;
    page->height_mm = width;
  }
  return true;
}

void arguments_fini(struct arguments *arguments) {
  free(arguments->pen_use);
  arguments->pen_use = NULL;
  free(arguments->cut_hatch);
  arguments->cut_hatch = NULL;
  free(arguments->item);
  arguments->item = NULL;
}

bool arguments_parse(struct arguments *arguments, int argc, char **argv,
                     char message[MESSAGE_SIZE]) {
  struct option longs[MAX_OPTIONS];
  char letters[3 * MAX_OPTIONS];
  fill_getopt(longs, letters);
  *arguments = (struct arguments){0};
  recto_options_init(&arguments->options);
  arguments->options.page.may_turn = true;
  opterr = 0;
  int code;
  while ((code = getopt_long(argc, argv, letters, longs, NULL)) != -1) {
    if (code == '?' || code == ':') {
      explain_getopt_error(code, argv, message);
      return false;
    }
    if (!parse_option(arguments, find_entry(code), optarg, message))
      return false;
  }
  arguments->model = argv + optind;
  arguments->model_count = argc - optind;
  if (arguments->help || arguments->version || arguments->completes)
    return true;
  return settle_page(arguments, message) &&
         multiview_settle(arguments, message) &&
         settle_camera(arguments, message) && settle_files(arguments, message);
}
