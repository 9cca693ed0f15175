# For every command test: `load ../common`. $BIN holds the executables (ctest sets it).
#
# One check a line: a failing line fails the test, but in the middle of one neither `! command` nor the first half of
# `this && that` does (tests/lint_tests finds them). `run -STATUS command` says how a command has to end.
bats_require_minimum_version 1.5.0
set -o pipefail  # a command that fails fails its pipeline, whoever reads it
BIN=${BIN:-$BATS_TEST_DIRNAME/../../../build/release/bin}
PATH=$BIN:$PATH
TESTDATA=$BATS_TEST_DIRNAME/../../../testdata
# Nobody's calibration (sg-solve --calibrate): what is printed is the same everywhere.
export XDG_CACHE_HOME=$BATS_RUN_TMPDIR/cache

# need_data NAME...: skips the test where the public graphs are not at hand.
need_data() {
  [ -n "${SGTOOLS_DATA:-}" ] || skip "SGTOOLS_DATA is not set: public graphs are not tested"
}

# fails STATUS MESSAGE COMMAND...: the command ends with STATUS and says exactly MESSAGE, one line, on standard error.
fails() {
  local status=$1 message=$2 said code=0
  shift 2
  said=$("$@" 2>&1 >/dev/null) || code=$?
  if [ "$code" = "$status" ] && [ "$said" = "$message" ]; then return; fi
  printf 'status %s, said: %s\nwanted %s, %s\n' "$code" "$said" "$status" "$message" >&2
  return 1
}

# near A B [BOUND]: two numbers that differ by no more than BOUND (1e-9) of one plus their size.
near() {
  [ -n "$1" ]
  awk -v a="$1" -v b="$2" -v bound="${3:-1e-9}" 'BEGIN {d = a - b; most = bound * (1 + (b < 0 ? -b : b)); exit !(d * d <= most * most)}'
}

# option_names [FILE]: every name of an option in a --help text, a line each: one option a line, but several in those of
# what is the same everywhere.
option_names() {
  awk -F '  +' '/^The same everywhere/ {several = 1} /^  -/ {for (k = 2; k <= (several ? NF : 2); ++k) print $k}' "$@" |
    sed 's/ .*//' | tr , '\n'
}
