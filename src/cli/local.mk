# src/cli/local.mk - the program: sees recto.h and base, nothing else.
recto_SOURCES += \
  %D%/arguments.c %D%/arguments.h \
  %D%/help.c \
  %D%/job.c %D%/job.h \
  %D%/main.c \
  %D%/options.c \
  %D%/uses.c %D%/uses.h \
  %D%/value.c %D%/value.h \
  %D%/waiting.c
