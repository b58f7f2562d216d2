# src/cli/local.mk - the program: sees recto.h and base, nothing else.
recto_SOURCES += %D%/main.c
