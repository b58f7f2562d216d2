# bench/local.mk - make bench: how long things take, and what memory.
EXTRA_PROGRAMS = %D%/bench %D%/zraster
%C%_bench_SOURCES = %D%/bench.c %D%/table.c %D%/table.h
%C%_bench_LDADD = tests/scenes/libscenes.la librecto_core.la
%C%_zraster_SOURCES = %D%/zraster.c
%C%_zraster_LDADD = librecto_core.la -lm
CLEANFILES += $(EXTRA_PROGRAMS)

# BENCH_METHODS  the methods to measure; else newell and auto
bench: recto$(EXEEXT) $(EXTRA_PROGRAMS)
	$(AM_TESTS_ENVIRONMENT) %D%/bench$(EXEEXT) ./recto$(EXEEXT) \
	  %D%/zraster$(EXEEXT) $(srcdir)/examples/models $(BENCH_METHODS)
.PHONY: bench
