# tests/measure/ - how far a visible map is from the exact one: for the tests of
# approximate methods, and for the bench.
check_LTLIBRARIES += %D%/libmeasure.la
%C%_libmeasure_la_SOURCES = %D%/measure.c %D%/measure.h \
  %D%/trial.c %D%/trial.h %D%/turns.c %D%/turns.h
%C%_libmeasure_la_LIBADD = librecto_core.la
