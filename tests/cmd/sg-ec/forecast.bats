# sg-ec: bytes of the factor, and seconds after sg-solve --calibrate.
load ../common

setup() {
  cd "$BATS_TEST_TMPDIR"
  export XDG_CACHE_HOME=$BATS_TEST_TMPDIR/cache
  mkdir -p cache/sgtools
}

# times NANOSECONDS KERNELS: a calibration by hand, all kinds of work alike.
times() {
  echo "kernels $2"
  for kind in front pivot factor update product panel row gram block outer; do echo "$kind $1"; done
}
kernels=${SGTOOLS_KERNELS:-plain}

@test "the factor of two poses, counted by hand" {
  echo 'VERTEX_SE2 0 0 0 0
VERTEX_SE2 1 1 0 0
EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1' > two.g2o
  # One clique of 6 scalars and the right-hand side: 6 columns of 8 numbers, and 8 of slack. Lists: 2 beginnings of
  # frontals and of separators, 2 frontals, sizes of the clique and its place (4 + 4 + 8), 2 dimensions, 3 starts.
  [ "$(sg-ec --no-header -f factor_bytes two.g2o)" = $(((6 * 8 + 8) * 8 + (4 + 2) * 4 + 16 + (2 + 3) * 4)) ]
  # And its update, 1 of 8 numbers, and 8 of slack.
  [ "$(sg-ec --no-header -f peak_bytes two.g2o)" = $(((6 * 8 + 8) * 8 + (4 + 2) * 4 + 16 + (2 + 3) * 4 + 128)) ]
}

@test "seconds: empty without a calibration, and with one that is of other kernels" {
  [ -z "$(sg-ec --no-header -f seconds "$TESTDATA/walk.g2o")" ]
  [ "$(sg-ec --json -f seconds "$TESTDATA/walk.g2o")" = '{"seconds": null}' ]
  times 1 other > cache/sgtools/times
  [ -z "$(sg-ec --no-header -f seconds "$TESTDATA/walk.g2o")" ]
}

@test "seconds: by the times of the user's cache folder" {
  export SGTOOLS_KERNELS=plain
  times 1 plain > cache/sgtools/times
  once=$(sg-ec --no-header -f seconds "$TESTDATA/walk.g2o")
  times 3 plain > cache/sgtools/times
  near "$(sg-ec --no-header -f seconds "$TESTDATA/walk.g2o")" "$(awk -v s="$once" 'BEGIN {print 3 * s}')" 1e-6
  # A relative path in XDG_CACHE_HOME is none: ~/.cache is meant.
  mkdir -p home/.cache/sgtools
  times 6 plain > home/.cache/sgtools/times
  near "$(HOME=$PWD/home XDG_CACHE_HOME=cache sg-ec --no-header -f seconds "$TESTDATA/walk.g2o")" \
    "$(awk -v s="$once" 'BEGIN {print 6 * s}')" 1e-6
}

@test "a file of times that is none is named with its line" {
  export SGTOOLS_KERNELS=plain
  times 1 plain | sed '5s/1/-1/' > cache/sgtools/times
  fails 1 "sg-ec: $PWD/cache/sgtools/times:5: not what sg-solve --calibrate writes; run it again" \
    sg-ec -f seconds "$TESTDATA/walk.g2o"
  times 1 plain | sed -n 1,4p > cache/sgtools/times
  fails 1 "sg-ec: $PWD/cache/sgtools/times:4: not what sg-solve --calibrate writes; run it again" \
    sg-ec -f seconds "$TESTDATA/walk.g2o"
  # Nobody asks for it here.
  run -0 sg-ec -f ec "$TESTDATA/walk.g2o"
}

@test "best --minimize: what is asked for is not above what best for EC has of it" {
  export SGTOOLS_KERNELS=plain
  times 1 plain > cache/sgtools/times
  sg-gen city -n 300 > city.g2o
  for what in seconds factor_bytes peak_bytes; do
    asked=$(sg-ec -m best --budget 32t --minimize $what --no-header -f $what city.g2o)
    for method in colamd amd wmf metis; do
      awk -v a="$asked" -v b="$(sg-ec -m $method --no-header -f $what city.g2o)" 'BEGIN {exit !(a <= b)}'
    done
  done
  sg-order -v -m best --budget 0t --minimize peak_bytes city.g2o 2> log > out.g2o
  grep -qE '^sg-order: .*: EC [0-9]+, peak_bytes [0-9]+ after 0 tries' log
}

@test "--minimize seconds wants a calibration, --minimize -m best" {
  fails 2 "sg-order: --minimize seconds: nobody knows how long things take here until sg-solve --calibrate has been run (see sg-order --help)" \
    sg-order -m best --minimize seconds "$TESTDATA/walk.g2o"
  fails 2 "sg-ec: --minimize has no effect without -m best (see sg-ec --help)" \
    sg-ec --minimize ec "$TESTDATA/walk.g2o"
}
