/* completion.c - --completion, from the table of options: what bash or zsh
 * offers while a command line is typed. */
#include "cli/completion.h"

#include <stdio.h>
#include <string.h>

#include "cli/options.h"

/* ---- Options ------------------------------------------------------------- */

/* The option after this one, or the first after NULL, that this build has; NULL
 * past the last. */
static const struct option_entry *
next_option(const struct option_entry *entry) {
  entry = entry == NULL ? option_table : entry + 1;
  while (!option_is_end(entry) &&
         (entry->kind == OPTION_HEADING || entry->kind == OPTION_ABSENT))
    entry++;
  return option_is_end(entry) ? NULL : entry;
}

static bool is_optional(const struct option_entry *entry) {
  return entry->argument[0] == '[';
}

static bool takes_file(const struct option_entry *entry) {
  return strstr(entry->argument, "FILE") != NULL;
}

static bool has_words(const struct option_entry *entry) {
  return entry->word != NULL || entry->words != NULL;
}

static void print_words(const struct option_entry *entry) {
  const char *word;
  for (size_t i = 0; entry->word != NULL && (word = entry->word(i)) != NULL;
       i++)
    printf("%s%s", i > 0 ? " " : "", word);
  if (entry->words != NULL)
    printf("%s%s", entry->word != NULL ? " " : "", entry->words);
}

static bool takes_list(const struct option_entry *entry) {
  return strcmp(entry->argument, "LIST") == 0;
}

/* ---- Bash ---------------------------------------------------------------- */

/* An alternative of bash's case: an option, by both names, and its value. */
static void print_case(const struct option_entry *entry) {
  printf("  --%s", entry->name);
  if (entry->letter != 0)
    printf(" | -%c", entry->letter);
  printf(") ");
  if (takes_file(entry)) {
    printf("files=yes ");
  } else if (has_words(entry)) {
    printf("%s='", takes_list(entry) ? "items" : "words");
    print_words(entry);
    printf("' ");
  }
  printf(";;\n");
}

/* A value follows in the next word or after =; one that may be left out, after
 * = alone, is completed like a model. */
static void print_bash(void) {
  const struct option_entry *entry = NULL;
  printf("# bash completion for recto, printed by recto --completion bash\n"
         "_recto() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} files= words= items=\n"
         "  local option=${COMP_WORDS[COMP_CWORD - 1]}\n"
         "  if [[ $word == = ]]; then\n"
         "    word=\n"
         "  elif [[ $option == = ]]; then\n"
         "    option=${COMP_WORDS[COMP_CWORD - 2]}\n"
         "  fi\n"
         "  case $option in\n");
  while ((entry = next_option(entry)) != NULL)
    if (entry->argument != NULL && !is_optional(entry))
      print_case(entry);
  printf("  *) [[ $word == -* ]] || files=yes\n"
         "    words='");
  while ((entry = next_option(entry)) != NULL)
    printf("--%s ", entry->name);
  printf("' ;;\n"
         "  esac\n"
         "  COMPREPLY=()\n"
         "  if [[ -n $files ]]; then\n"
         "    compopt -o default 2>/dev/null\n"
         "  elif [[ -n $items ]]; then\n"
         "    compopt -o nospace 2>/dev/null\n"
         "    COMPREPLY=($(compgen -P \"${word%%\"${word##*,}\"}\" "
         "-W \"$items\" -- \"${word##*,}\"))\n"
         "  else\n"
         "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
         "  fi\n"
         "}\n"
         "complete -F _recto recto\n");
}

/* ---- Zsh ----------------------------------------------------------------- */

/* A help text, within brackets within single quotes. */
static void print_quoted(const char *text) {
  for (; *text != '\0'; text++)
    if (*text == '\'')
      printf("'\\''");
    else
      printf("%s%c", strchr("[]:\\", *text) != NULL ? "\\" : "", *text);
}

/* The script serves both as a function that zsh loads from its fpath, and for
 * `eval`, which is to define the function and not to call it. */
static void print_zsh(void) {
  const struct option_entry *entry = NULL;
  printf("#compdef recto\n"
         "# zsh completion for recto, printed by recto --completion zsh\n"
         "_recto() {\n"
         "_arguments -S \\\n");
  while ((entry = next_option(entry)) != NULL) {
    bool takes = entry->argument != NULL;
    const char *equals = !takes ? "" : is_optional(entry) ? "=-" : "=";
    if (entry->letter != 0)
      printf("  '%s'{-%c%s,--%s%s}'[", takes ? "*" : "", entry->letter,
             takes ? "+" : "", entry->name, equals);
    else
      printf("  '%s--%s%s[", takes ? "*" : "", entry->name, equals);
    print_quoted(entry->help);
    printf("]");
    if (takes) {
      printf("%s", is_optional(entry) ? "::" : ":");
      for (const char *c = entry->argument; *c != '\0'; c++)
        if (strchr("[=]:", *c) == NULL)
          putchar(*c);
      printf(":");
      if (takes_file(entry)) {
        printf("_files");
      } else if (has_words(entry)) {
        printf("%s", takes_list(entry) ? "_sequence compadd - " : "(");
        print_words(entry);
        printf("%s", takes_list(entry) ? "" : ")");
      }
    }
    printf("' \\\n");
  }
  printf("  '*:model:_files'\n"
         "}\n"
         "if [[ $funcstack[1] == _recto ]]; then\n"
         "  _recto \"$@\"\n"
         "else\n"
         "  compdef _recto recto\n"
         "fi\n");
}

void completion_print(enum completion_shell shell) {
  if (shell == COMPLETION_BASH)
    print_bash();
  else
    print_zsh();
}
