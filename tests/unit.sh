#!/bin/bash
# unit.sh - runs a unit test for the harness: `unit.sh PROGRAM`.
# cmocka says "not ok 3 # SKIP claim" of what was skipped, which TAP takes for
# a failure.  RECTO_UNDER, where set, is a command to run the program under.
set -o pipefail
# shellcheck disable=SC2086 # a command and its arguments
${RECTO_UNDER-} "$@" | sed -u 's/^not ok \([0-9]* # SKIP\)/ok \1/'
