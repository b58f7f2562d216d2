# tests/fuzz/local.mk - fuzzers: targets that stand alone, a program that
# replays their inputs, and the same linked with libFuzzer (make fuzz).
fuzz_sources = %D%/fuzz.h %D%/targets.c \
  %D%/decode.c %D%/decode.h %D%/render.c %D%/render.h \
  %D%/agreement.c %D%/agreement.h %D%/judgeable.c %D%/judgeable.h \
  %D%/target_cli.c %D%/target_mesh.c %D%/target_options.c \
  %D%/target_part.c %D%/target_plan.c %D%/target_reader.c \
  %D%/target_scene.c %D%/target_svg.c \
  tests/reading.c tests/reading.h \
  src/cli/parse.c src/cli/frames.c src/cli/lists.c src/cli/options.c src/cli/multiview.c \
  src/cli/option_scope.c src/cli/value.c

check_PROGRAMS += %D%/replay
%C%_replay_SOURCES = %D%/replay.c $(fuzz_sources)
%C%_replay_LDADD = librecto_core.la

check_PROGRAMS += %D%/soak
%C%_soak_SOURCES = %D%/soak.c %D%/soak_kinds.c %D%/soak_kinds.h \
  %D%/soak_sample.c %D%/soak_sample.h \
  $(fuzz_sources)
%C%_soak_LDADD = tests/scenes/libscenes.la librecto_core.la

EXTRA_PROGRAMS += %D%/fuzz
%C%_fuzz_SOURCES = %D%/libfuzzer.c $(fuzz_sources)
%C%_fuzz_LDADD = librecto_core.la
%C%_fuzz_LDFLAGS = -fsanitize=fuzzer

EXTRA_DIST += %D%/run.sh %D%/corpus tests/reported
dist_check_SCRIPTS += tests/test_fuzz_corpus.sh
