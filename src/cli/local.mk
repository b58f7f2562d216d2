# src/cli/local.mk - the program: sees recto.h alone.
recto_SOURCES += \
  %D%/arguments.h \
  %D%/completion.c %D%/completion.h \
  %D%/descriptors.c %D%/descriptors.h \
  %D%/frames.c %D%/frames.h \
  %D%/heap.c %D%/heap.h \
  %D%/help.c %D%/help.h \
  %D%/lists.c %D%/lists.h \
  %D%/main.c \
  %D%/memory_limit.c %D%/memory_limit.h \
  %D%/message.c %D%/message.h \
  %D%/option_entry.h \
  %D%/options.c %D%/options.h \
  %D%/option_scope.c %D%/option_scope.h \
  %D%/parse.c %D%/parse.h \
  %D%/progress_bar.c %D%/progress_bar.h \
  %D%/run.c %D%/run.h \
  %D%/multiview.c %D%/multiview.h \
  %D%/signals.c %D%/signals.h \
  %D%/value.c %D%/value.h
