# tests/judge/local.mk - what the judge of src/judge has for tests alone.
check_LTLIBRARIES += %D%/libjudge.la
%C%_libjudge_la_SOURCES = \
  %D%/raster.c %D%/raster.h
