/* clipped.c - says what the page's margins cut away, and what helps. */
#include "api/clipped.h"

#include <stdarg.h>
#include <stdio.h>

/* A sentence that grows. */
struct words {
  char text[400];
  size_t length;
};

static void say(struct words *words, const char *format, ...) PRINTF_LIKE(2, 3);
static void say(struct words *words, const char *format, ...) {
  va_list arguments;
  size_t room = sizeof words->text - words->length;
  va_start(arguments, format);
  int length = vsnprintf(words->text + words->length, room, format, arguments);
  va_end(arguments);
  if (length > 0)
    words->length += (size_t)length < room ? (size_t)length : room - 1;
}

/* What comes near to the eye is endlessly large on the page. */
static void say_length(struct words *words, double mm) {
  const double most_mm = 100000;
  if (mm < most_mm)
    say(words, "%.1f mm", mm);
  else
    say(words, "more than %.0f m", most_mm / 1000);
}

static const char *plural(uint64_t count) { return count == 1 ? "" : "s"; }

static void say_what(struct words *words, const struct beyond *beyond,
                     uint64_t faces) {
  if (beyond->edges > 0) {
    say(words, "%llu line%s (", (unsigned long long)beyond->edges,
        plural(beyond->edges));
    say_length(words, beyond->mm);
    say(words, ", hidden parts counted)");
  }
  if (beyond->edges > 0 && faces > 0)
    say(words, " and ");
  if (faces > 0)
    say(words, "%llu filled face%s", (unsigned long long)faces, plural(faces));
  if (beyond->edges > 0) {
    say(words, ", as far as ");
    say_length(words, beyond->reach_mm);
    say(words, " beyond");
  }
}

static void say_help(struct words *words, const struct beyond *beyond,
                     double margin_mm, const recto_options *options) {
  bool narrow = beyond->axis[0] && !beyond->axis[1] &&
                options->page_width_mm < options->page_height_mm;
  say(words, ": ");
  switch (options->fit) {
  case RECTO_FIT_SCALE:
    say(words, "--fit or a smaller --scale shows all, a larger --page more");
    break;
  case RECTO_FIT_NONE:
    say(words, options->fov_deg > 0
                   ? "--fit shows all, a larger --fov or --page more"
                   : "--fit or a smaller --scale shows all");
    break;
  case RECTO_FIT_PAGE:
    say(words, "what is close to the eye is large: a larger --near or "
               "--section cuts it away");
    break;
  }
  if (narrow && options->fit != RECTO_FIT_PAGE)
    say(words, ", --landscape too");
  if (beyond->reach_mm > 0 && beyond->reach_mm <= margin_mm + RECTO_FINEST_MM)
    say(words, "; all is on the page itself, as --margin 0 shows");
}

void clipped_warn(const struct beyond *beyond, uint64_t faces, double margin_mm,
                  const recto_options *options) {
  struct words words = {.length = 0};
  if (options->warning == NULL || (beyond->edges == 0 && faces == 0))
    return;
  say(&words, "clipped at the page's margins: ");
  say_what(&words, beyond, faces);
  say_help(&words, beyond, margin_mm, options);
  options->warning(options->user, "", 0, words.text);
}

void clipped_report(const struct beyond *beyond, struct report *report) {
  report_int(report, "clipped", "lines", (int64_t)beyond->edges);
  report_double(report, "clipped", "length_mm", beyond->mm);
  report_double(report, "clipped", "reach_mm", beyond->reach_mm);
}
