/* clip_warning.c - warns of lines and faces that the page's margins clip. */
#include "api/clip_warning.h"

#include <math.h>

#include "base/sentence.h"
#include "base/word.h"

/* Lines close to the eye have enormous images, so large lengths are not printed
 * in full. */
static void say_length(struct sentence *words, double mm) {
  const double most_mm = 100000;
  if (mm < most_mm)
    sentence_add(words, "%.1f mm", mm);
  else
    sentence_add(words, "more than %.0f m", most_mm / 1000);
}

static void say_what(struct sentence *words,
                     const struct page_overflow *overflow, uint64_t faces) {
  if (overflow->edges > 0) {
    sentence_add(words, "%llu line%s (", (unsigned long long)overflow->edges,
                 plural_ending(overflow->edges));
    say_length(words, overflow->mm);
    sentence_add(words, ", hidden parts counted)");
  }
  if (overflow->edges > 0 && faces > 0)
    sentence_add(words, " and ");
  if (faces > 0)
    sentence_add(words, "%llu filled face%s", (unsigned long long)faces,
                 plural_ending(faces));
  if (overflow->edges > 0) {
    sentence_add(words, ", as far as ");
    say_length(words, overflow->excess_mm);
    sentence_add(words, " beyond");
  }
}

/* What reaches so many pages beyond is seldom what was meant. */
#define FAR_PAGES 10

static void say_help(struct sentence *words,
                     const struct page_overflow *overflow, double margin_mm,
                     const recto_options *options) {
  bool narrow = overflow->axis[0] && !overflow->axis[1] &&
                !options->page.may_turn &&
                options->page.width_mm < options->page.height_mm;
  sentence_add(words, ": ");
  switch (options->camera.fit) {
  case RECTO_FIT_SCALE:
    sentence_add(words,
                 "--fit or a smaller --scale shows all, a larger --page more");
    if (overflow->excess_mm >
        FAR_PAGES * fmax(options->page.width_mm, options->page.height_mm))
      sentence_add(words, "; --unit says how large a unit of the model is");
    break;
  case RECTO_FIT_NONE:
    sentence_add(words, options->camera.fov_deg > 0
                            ? "--fit shows all, a larger --fov or --page more"
                            : "--fit or a smaller --scale shows all");
    break;
  case RECTO_FIT_PAGE:
  case RECTO_FIT_PREFERRED:
  case RECTO_FIT_SPHERE:
    sentence_add(words, "what is close to the eye is large: a larger --near or "
                        "--section cuts it away");
    break;
  }
  if (narrow && options->camera.fit != RECTO_FIT_PAGE &&
      options->camera.fit != RECTO_FIT_PREFERRED &&
      options->camera.fit != RECTO_FIT_SPHERE)
    sentence_add(words, ", --landscape too");
  if (overflow->excess_mm > 0 &&
      overflow->excess_mm <= margin_mm + RECTO_FINEST_MM)
    sentence_add(words, "; all is on the page itself, as --margin 0 shows");
}

void clipped_warn(const struct page_overflow *overflow, uint64_t faces,
                  double margin_mm, const recto_options *options) {
  struct sentence words = {.length = 0};
  if (options->warning == NULL || (overflow->edges == 0 && faces == 0))
    return;
  sentence_add(&words, "clipped at the page's margins: ");
  say_what(&words, overflow, faces);
  say_help(&words, overflow, margin_mm, options);
  options->warning(options->user, "", 0, words.text);
}

void clipped_report(const struct page_overflow *overflow,
                    struct report *report) {
  report_count(report, "clipped", "lines", overflow->edges);
  report_double(report, "clipped", "length_mm", overflow->mm);
  report_double(report, "clipped", "farthest_mm", overflow->excess_mm);
}
