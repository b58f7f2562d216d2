# src/base/local.mk - the sources of this layer.
librecto_core_la_SOURCES += \
  %D%/child.c %D%/child.h \
  %D%/clock.c %D%/clock.h \
  %D%/decimal.c %D%/decimal.h \
  %D%/digits.h \
  %D%/file_attributes.c %D%/file_attributes.h \
  %D%/file_reader.c %D%/file_reader.h \
  %D%/gunzip.c %D%/gunzip.h \
  %D%/gzip.c %D%/gzip.h \
  %D%/hash.h \
  %D%/input.c %D%/input.h \
  %D%/line_blocks.c %D%/line_blocks.h \
  %D%/links.c %D%/links.h \
  %D%/memory.c %D%/memory.h \
  %D%/number.c %D%/number.h \
  %D%/number_filter.c %D%/number_filter.h \
  %D%/number_format.c \
  %D%/number_lists.c %D%/number_lists.h \
  %D%/parallel.c %D%/parallel.h \
  %D%/parallel_read.c %D%/parallel_read.h \
  %D%/path.c %D%/path.h \
  %D%/poll.c %D%/poll.h \
  %D%/ranked_set.h \
  %D%/report.c %D%/report.h \
  %D%/sanitizer.h \
  %D%/sentence.c %D%/sentence.h \
  %D%/sort.c %D%/sort.h \
  %D%/status.c %D%/status.h \
  %D%/stream.c %D%/stream.h \
  %D%/target.c %D%/target.h \
  %D%/thread_pool.c %D%/thread_pool.h \
  %D%/tolerance.h \
  %D%/union_find.h \
  %D%/utf8.c %D%/utf8.h \
  %D%/word.c %D%/word.h
