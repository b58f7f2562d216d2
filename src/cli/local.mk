# src/cli/local.mk - the program: sees recto.h and base, nothing else.
recto_SOURCES += \
  %D%/arguments.c %D%/arguments.h \
  %D%/descriptors.c %D%/descriptors.h \
  %D%/help.c \
  %D%/job.c %D%/job.h \
  %D%/main.c \
  %D%/message.c %D%/message.h \
  %D%/options.c \
  %D%/progress.c %D%/progress.h \
  %D%/signals.c %D%/signals.h \
  %D%/uses.c %D%/uses.h \
  %D%/value.c %D%/value.h
