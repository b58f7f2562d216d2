# src/api/local.mk - the facade behind recto.h.
librecto_core_la_SOURCES += \
  src/recto.h \
  %D%/asked.c %D%/asked.h \
  %D%/check.c \
  %D%/clipped.c %D%/clipped.h \
  %D%/handle.h \
  %D%/model.c \
  %D%/options.c \
  %D%/output.c \
  %D%/render.c \
  %D%/rescale.c %D%/rescale.h \
  %D%/shares.c %D%/shares.h \
  %D%/verify.c %D%/verify.h \
  %D%/version.c
