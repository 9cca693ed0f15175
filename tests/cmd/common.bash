# For every command test: `load ../common`. $BIN holds the executables (ctest sets it).
BIN=${BIN:-$BATS_TEST_DIRNAME/../../../build/release/bin}
PATH=$BIN:$PATH
TESTDATA=$BATS_TEST_DIRNAME/../../../testdata

# need_data NAME...: skips the test where the public graphs are not at hand.
need_data() {
  [ -n "${SGTOOLS_DATA:-}" ] || skip "SGTOOLS_DATA is not set: public graphs are not tested"
}

# fails STATUS MESSAGE COMMAND...: the command ends with STATUS and says exactly MESSAGE, one line, on standard error.
fails() {
  local status=$1 message=$2 said code=0
  shift 2
  said=$("$@" 2>&1 >/dev/null) || code=$?
  [ "$code" -eq "$status" ] && [ "$said" = "$message" ] && return
  printf 'status %s, said: %s\nwanted %s, %s\n' "$code" "$said" "$status" "$message" >&2
  return 1
}
