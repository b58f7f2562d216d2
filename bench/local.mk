# bench/local.mk - make bench: how long things take, what memory, and how far
# from the truth.
EXTRA_PROGRAMS += %D%/bench %D%/dense %D%/zraster %D%/accuracy %D%/chart \
  %D%/order %D%/hard %D%/peers/scene %D%/turns
%C%_bench_SOURCES = %D%/bench.c %D%/model.c %D%/model.h \
  %D%/table.c %D%/table.h
%C%_bench_LDADD = tests/scenes/libscenes.la librecto_core.la
%C%_dense_SOURCES = %D%/dense.c %D%/model.c %D%/model.h \
  %D%/table.c %D%/table.h
%C%_dense_LDADD = tests/scenes/libscenes.la librecto_core.la -lm
%C%_zraster_SOURCES = %D%/zraster.c
%C%_zraster_LDADD = librecto_core.la -lm
%C%_accuracy_SOURCES = %D%/accuracy.c %D%/accuracy.h \
  %D%/accuracy_scenes.c %D%/accuracy_methods.c %D%/table.c %D%/table.h
%C%_accuracy_LDADD = tests/measure/libmeasure.la tests/scenes/libscenes.la \
  librecto_core.la -lm
%C%_chart_SOURCES = %D%/chart.c %D%/plot.c %D%/plot.h %D%/table.c \
  %D%/table.h %D%/label_places.c %D%/label_places.h
%C%_chart_LDADD = -lm
%C%_peers_scene_SOURCES = %D%/peers/scene.c %D%/accuracy.h \
  %D%/accuracy_scenes.c
%C%_peers_scene_LDADD = tests/scenes/libscenes.la librecto_core.la -lm
%C%_turns_SOURCES = %D%/turns.c %D%/plot.c %D%/plot.h %D%/table.c \
  %D%/table.h %D%/label_places.c %D%/label_places.h
%C%_turns_LDADD = tests/measure/libmeasure.la tests/scenes/libscenes.la \
  librecto_core.la -lm
%C%_order_SOURCES = %D%/order.c
%C%_order_LDADD = tests/scenes/libscenes.la librecto_core.la -lm
%C%_hard_SOURCES = %D%/hard.c %D%/table.c %D%/table.h
%C%_hard_LDADD = tests/scenes/libscenes.la librecto_core.la -lm
EXTRA_DIST += %D%/quadratic.sh %D%/least_model.sh doc/least-model.md \
  doc/accuracy.md doc/chart doc/peers.md \
  %D%/peers/asymptote.py %D%/peers/asymptote_lines.py \
  %D%/peers/gl2ps.c %D%/peers/gl2ps_lines.py \
  %D%/peers/gnuplot.py %D%/peers/gnuplot_lines.py %D%/peers/lineart.py \
  %D%/peers/page.py %D%/peers/peers.sh %D%/peers/prepare.py \
  %D%/peers/sketch.py %D%/peers/sketch_lines.py %D%/peers/three.mjs \
  %D%/peers/three_lines.py
CLEANFILES += $(EXTRA_PROGRAMS)

# BENCH_METHODS  the methods to measure; else newell and auto
bench: recto$(EXEEXT) $(EXTRA_PROGRAMS) bench-order \
  bench-dense bench-hard
	$(AM_TESTS_ENVIRONMENT) %D%/bench$(EXEEXT) ./recto$(EXEEXT) \
	  %D%/zraster$(EXEEXT) $(srcdir)/examples/models $(BENCH_METHODS)

# Speed against accuracy: doc/chart/*.csv, and the charts of doc/accuracy.md.
# CHART_SCENES  those to measure, such as "cubes table"; else all
chart: %D%/accuracy$(EXEEXT) %D%/chart$(EXEEXT)
	$(MKDIR_P) '$(srcdir)/doc/chart'
	$(AM_TESTS_ENVIRONMENT) %D%/accuracy$(EXEEXT) \
	  '$(srcdir)/examples/models' '$(srcdir)/doc/chart' $(CHART_SCENES)
	%D%/chart$(EXEEXT) '$(srcdir)/doc/chart'

# What small moves of the camera change: doc/chart/turns.csv and turns.svg.
turns: %D%/turns$(EXEEXT)
	%D%/turns$(EXEEXT) '$(srcdir)/doc/chart'

# What is made and tested, of what there is: doc/least-model.md.
least-model: recto$(EXEEXT) %D%/peers/scene$(EXEEXT)
	{ sed '/^### Lines/,$$d' '$(srcdir)/doc/least-model.md' && \
	  $(AM_TESTS_ENVIRONMENT) '$(srcdir)/%D%/least_model.sh' ./recto$(EXEEXT) \
	  %D%/peers/scene$(EXEEXT) '$(srcdir)/examples/models'; } \
	  >least-model.new && mv least-model.new '$(srcdir)/doc/least-model.md'

# Other programs on the same scenes: the table of doc/peers.md.
peers: recto$(EXEEXT) %D%/peers/scene$(EXEEXT)
	$(AM_TESTS_ENVIRONMENT) '$(srcdir)/%D%/peers/peers.sh' "$$PWD/recto" \
	  "$$PWD/%D%/peers/scene" "$$(cd '$(srcdir)' && pwd)/examples/models"

# What --order near gains, and what it costs.
bench-order: %D%/order$(EXEEXT)
	$(AM_TESTS_ENVIRONMENT) %D%/order$(EXEEXT) $(srcdir)/examples/models

# A million triangles beside a depth buffer.  BENCH_LEVELS  how many times the
# mesh is made four times as fine; else 2: 3 is four million triangles
bench-dense: recto$(EXEEXT) %D%/dense$(EXEEXT) %D%/zraster$(EXEEXT)
	$(AM_TESTS_ENVIRONMENT) %D%/dense$(EXEEXT) ./recto$(EXEEXT) \
	  %D%/zraster$(EXEEXT) $(srcdir)/examples/models $(BENCH_LEVELS)
# What such programs never end with, by every exact method and by auto.
bench-hard: %D%/hard$(EXEEXT)
	$(AM_TESTS_ENVIRONMENT) %D%/hard$(EXEEXT)

# Scenes in which much overlaps much; LIMIT seconds of CPU time for each.
bench-quadratic: recto$(EXEEXT)
	$(srcdir)/bench/quadratic.sh ./recto$(EXEEXT)

.PHONY: bench chart turns least-model peers bench-order bench-dense \
  bench-hard bench-quadratic
