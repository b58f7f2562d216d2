librecto_core_la_SOURCES += \
  %D%/convex.c %D%/convex.h \
  %D%/line.c %D%/line.h \
  %D%/predicate.h \
  %D%/ratio.c %D%/ratio.h \
  %D%/wide.h
