/* main.c - the program: exit 0 done, 1 failed, 2 wrong usage. */
#include <stdio.h>

#include "cli/completion.h"
#include "cli/descriptors.h"
#include "cli/heap.h"
#include "cli/help.h"
#include "cli/memory_limit.h"
#include "cli/message.h"
#include "cli/parse.h"
#include "cli/run.h"

static int run_program(struct arguments *arguments, int argc, char **argv) {
  char message[MESSAGE_SIZE];
  if (!arguments_parse(arguments, argc, argv, message)) {
    message_print("", 0, message);
    return EXIT_USAGE;
  }
  if (arguments->help)
    help_print();
  else if (arguments->version)
    printf("recto %s\n", recto_version());
  else if (arguments->completes)
    completion_print((enum completion_shell)arguments->completion);
  else
    return cli_run(arguments);
  if (fflush(stdout) != 0) {
    message_print("", 0, "cannot write to standard output");
    return EXIT_FAILED;
  }
  return EXIT_DONE;
}

int main(int argc, char **argv) {
  struct arguments arguments;
  if (!descriptors_reserve())
    return EXIT_FAILED; /* and there is nowhere to say so */
  memory_limit_set();
  heap_keep_blocks();
  int code = run_program(&arguments, argc, argv);
  arguments_fini(&arguments);
  return code;
}
