# src/api/local.mk - the facade behind recto.h.
librecto_core_la_SOURCES += \
  src/recto.h \
  %D%/version.c
