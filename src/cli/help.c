/* help.c - --help, from the table of options. */
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"

static void print_entry(const struct option_entry *entry) {
  const int column = 28;
  char letter[] = {'-', entry->letter, ',', ' ', '\0'};
  int width = printf("  %s--%s", entry->letter ? letter : "    ", entry->name);
  if (entry->argument != NULL)
    width +=
        printf("%s%s", entry->argument[0] == '[' ? "" : " ", entry->argument);
  printf("%*s%s\n", width < column ? column - width : 1, "", entry->help);
}

/* Prints one more word of a list, on a new line where this one is full;
 * returns the new column. */
static int print_word(int column, const char *word) {
  const int edge = 80;
  if (column + 1 + (int)strlen(word) > edge) {
    printf("\n ");
    column = 1;
  }
  return column + printf(" %s", word);
}

static void print_methods(void) {
  int column = printf("Methods:");
  for (int i = 0; i < RECTO_METHOD_COUNT; i++)
    if (recto_method_is_available((recto_method)i))
      column = print_word(column, recto_method_name((recto_method)i));
  printf("\n");
}

static void print_formats(void) {
  int column = printf("Output formats:");
  for (size_t i = 0; recto_output_format_name(i) != NULL; i++)
    column = print_word(column, recto_output_format_name(i));
  printf("\n");
}

static void print_classes(void) {
  int column = printf("Edge classes:");
  for (int i = 0; i < RECTO_EDGE_CLASS_COUNT; i++)
    column =
        print_word(column, recto_edge_class_name((recto_edge_class)(1u << i)));
  printf(";\n  all; none; default: all of these but smooth\n");
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
  print_classes();
  print_methods();
  print_formats();
  printf("Exit status: 0 done, 1 failed, 2 wrong usage; --check: 0 right, "
         "1 wrong,\n2 trouble.\n");
}
