librecto_core_la_SOURCES += \
  %D%/convex.c %D%/convex.h \
  %D%/int128.h \
  %D%/line.c %D%/line.h \
  %D%/line_key.c %D%/line_key.h \
  %D%/nearest.h \
  %D%/predicate.h \
  %D%/region.c %D%/region.h \
  %D%/ratio.c %D%/ratio.h \
  %D%/scanfill.c %D%/scanfill.h \
  %D%/vector.h \
  %D%/wide.c %D%/wide.h
