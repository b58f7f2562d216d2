/* help.c - --help, from the table of options. */
#include "cli/help.h"

#include <stdio.h>
#include <string.h>

#include "cli/options.h"

static void print_entry(const struct option_entry *entry) {
  const int column = 28;
  char letter[] = {'-', entry->letter, ',', ' ', '\0'};
  int width = printf("  %s--%s", entry->letter ? letter : "    ", entry->name);
  if (entry->argument != NULL)
    width +=
        printf("%s%s", entry->argument[0] == '[' ? "" : " ", entry->argument);
  printf("%*s%s\n", width < column ? column - width : 1, "", entry->help);
}

static void print_list(const char *head, word_fn *word) {
  const int edge = 80;
  int column = printf("%s", head);
  for (size_t i = 0; word(i) != NULL; i++) {
    if (column + 1 + (int)strlen(word(i)) > edge)
      column = printf("\n ") - 1;
    column += printf(" %s", word(i));
  }
}

void help_print(void) {
  printf("Usage: recto [OPTION]... MODEL... -o FILE\n"
         "Draws the exact visible lines of 3D models on paper.  MODEL: a mesh "
         "file,\nor - for standard input, with --from.\n\n");
  for (const struct option_entry *entry = option_table; !option_is_end(entry);
       entry++) {
    if (entry->kind == OPTION_HEADING)
      printf("%s\n", entry->help);
    else if (entry->kind != OPTION_ABSENT)
      print_entry(entry);
  }
  printf("\n");
  print_list("Views:", name_view);
  printf("\n");
  print_list("Edge classes:", name_edge_class);
  printf(";\n  all; none; default: all of these but smooth\n");
  print_list("Methods:", name_method);
  printf("\n");
  print_list("Output formats:", recto_output_format_name);
  printf("\nExit status: 0 done, 1 failed, 2 wrong usage; --check: 0 right, "
         "1 wrong,\n2 trouble.\n");
}
