# sg-solve --calibrate
load ../common

setup() {
  cd "$BATS_TEST_TMPDIR"
  export XDG_CACHE_HOME=$BATS_TEST_TMPDIR/deep/cache
}

@test "--calibrate keeps times by which sg-ec foretells seconds" {
  run -0 --separate-stderr sg-solve --calibrate
  [ -z "$output" ]
  [[ "$stderr" =~ ^"sg-solve: "[0-9]+" eliminations: R^2 "[0-9.]+", at worst off by "[0-9.]+" times; kept in $XDG_CACHE_HOME/sgtools/times"$ ]]
  [ "$(sg-gen sphere -n 400 | sg-ec -m colamd --no-header -f seconds | awk '{print ($1 > 0)}')" = 1 ]
  # More work takes longer.
  sg-gen sphere -n 400 -o small.g2o
  sg-gen sphere -n 1600 -o large.g2o
  awk -v a="$(sg-ec --no-header -f seconds small.g2o)" -v b="$(sg-ec --no-header -f seconds large.g2o)" 'BEGIN {exit !(a < b)}'
}

@test "--calibrate: where nothing can be kept, what is missing is named" {
  fails 3 "sg-solve: neither XDG_CACHE_HOME nor HOME is set to a path: there is no place for a calibration" \
    env -u HOME XDG_CACHE_HOME=relative "$BIN/sg-solve" --calibrate
}

@test "--calibrate takes neither graphs nor options of other jobs" {
  fails 2 "sg-solve: FILE has no effect with --calibrate, which has graphs of its own (see sg-solve --help)" \
    sg-solve --calibrate "$TESTDATA/walk.g2o"
  fails 2 "sg-solve: -m has no effect with --calibrate, which has graphs of its own (see sg-solve --help)" \
    sg-solve --calibrate -m amd
  fails 2 "sg-solve: --time times eliminations, --calibrate times those of graphs of its own: give one of them (see sg-solve --help)" \
    sg-solve --calibrate --time 3
}
