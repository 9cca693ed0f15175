load ../common

setup() { cd "$TESTDATA"; }

@test "the closed forms, evaluated by hand" {
  # X = 6 * 10 = 60, L = 3 * 20 = 60: (60 + 60) 60^2; (60 + 30) 30^2; (60 + 540) 30^2
  run -0 sg-predict --poses 10 --landmarks 20 -r 2 --no-header
  [ "$output" = "$(printf '2\t432000\t81000\t540000')" ]
  # X = 30, L = 40
  run -0 sg-predict --poses 10 --pose-dim 3 --landmarks 20 --landmark-dim 2 -r 1 --no-header -f full,kf,dec
  [ "$output" = "$(printf '63000\t63000\t279000')" ]
}

@test "from a graph: its free poses and landmarks" {
  # Poses 1..4 of dimension 3, two landmarks of dimension 2.
  [ "$(sg-predict -r 2 walk.g2o)" = "$(sg-predict --poses 4 --landmarks 2 --pose-dim 3 --landmark-dim 2 -r 2)" ]
  [ "$(sg-predict -r 2 <walk.g2o)" = "$(sg-predict -r 2 walk.g2o)" ]
}

@test "scaling a given EC" {
  run -0 sg-predict --ec 7200 -r 2,6 --no-header
  [ "$output" = "$(printf '2\t7200\t900\t1800\t16200\n6\t7200\t33.333333333333336\t200\t1800')" ]
  [ "$(sg-predict --ec 100 -r 1 walk.g2o | head -n 1 | wc -w)" = 8 ]
}

# The landmarks-first EC of the worst case is at most the closed form while landmarks do not outnumber poses by far.
@test "the closed form bounds the worst case" {
  for size in "5 5" "10 20" "20 40" "50 60" "60 300"; do
    set -- $size
    sg-gen worst -n $1 -l $2 -o "$BATS_TEST_TMPDIR/worst.g2o"
    for m in landmarks-first colamd; do
      ec=$(sg-ec -m $m --no-header -f ec "$BATS_TEST_TMPDIR/worst.g2o")
      bound=$(sg-predict --poses $1 --landmarks $2 -f full --no-header)
      awk -v ec="$ec" -v bound="$bound" 'BEGIN {exit !(ec + 0 <= bound + 0)}'
    done
  done
}

@test "wrong calls" {
  for rate in 0 -1 0.5 nan inf x; do run -2 sg-predict --poses 3 "-r$rate"; done
  run -2 sg-predict --poses 0
  run -2 sg-predict --landmarks 3 walk.g2o
  run -2 sg-predict --poses 3 walk.g2o
  run -2 sg-predict --ec -5
  run -1 sg-predict missing.g2o
  echo 'VERTEX_XY 1 0 0' >"$BATS_TEST_TMPDIR/landmark.g2o"
  fails 1 "sg-predict: $BATS_TEST_TMPDIR/landmark.g2o: no pose in it to predict from" sg-predict "$BATS_TEST_TMPDIR/landmark.g2o"
}
