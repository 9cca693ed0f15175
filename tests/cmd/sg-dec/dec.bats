load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA/walk.g2o" .; }

observations() { awk '/^EDGE_SE2_XY/ {print $2 "-" $3}' | paste -sd' '; }

@test "rate 1 is the input, byte for byte" {
  sg-dec -r 1 --no-trace-comment walk.g2o | cmp - walk.g2o
}

@test "offsets: of the first observation, or 0 for all" {
  [ "$(sg-dec -r 2 walk.g2o | observations)" = "0-100 2-100 2-101 4-101" ]
  [ "$(sg-dec -r 3 walk.g2o | observations)" = "0-100 2-101" ]
  [ "$(sg-dec -r 3 --offset aligned walk.g2o | observations)" = "0-100 3-101" ]
  [ "$(sg-dec -r 3 --offset random --seed 4 walk.g2o)" != "" ]
  cmp <(sg-dec -r 3 --offset random --seed 4 walk.g2o) <(sg-dec -r 3 --offset random --seed 4 walk.g2o)
}

@test "random offsets are those of seed 1 where nobody gives one" {
  sg-gen sine -n 30 -o sine.g2o
  random() { sg-dec -r 3 --offset random --no-trace-comment "$@" sine.g2o; }
  cmp <(random) <(random --seed 1)
  run -1 cmp -s <(random) <(random --seed 2)
}

@test "poses and odometry stay, and what is kept stays byte for byte" {
  sg-dec -r 3 --no-trace-comment walk.g2o >out.g2o
  cmp out.g2o <(grep -vE '^EDGE_SE2_XY (1 100|2 100|3 101|4 101)' walk.g2o)
}

@test "without landmarks the loop closures are decimated, the earlier pose as the landmark" {
  for k in 0 1 2 3 4 5; do echo "EDGE_SE2 $k $((k + 1)) 1 0 0 1 0 0 1 0 1"; done >loops.g2o
  for k in 2 3 4 5 6; do echo "EDGE_SE2 $k 0 1 0 0 1 0 0 1 0 1"; done >>loops.g2o
  [ "$(sg-dec -r 2 loops.g2o | awk '/^EDGE/ && $3 == 0 {print $2}' | paste -sd' ')" = "2 4 6" ]
  [ "$(sg-dec -r 2 --candidates observations --no-trace-comment loops.g2o)" = "$(cat loops.g2o)" ]
}

@test "landmarks with too few observations leave with their edges" {
  sg-dec -r 2 --min-obs 3 walk.g2o >out.g2o
  run -1 grep _XY out.g2o
  [[ $(sg-dec -v -r 2 --min-obs 3 -o out.g2o walk.g2o 2>&1) == *" removed 2 of 7 vertices, 6 of 11 edges"* ]]
}

@test "wrong calls" {
  fails 2 "sg-dec: -r 0: must be 1 or more (see sg-dec --help)" sg-dec -r 0 walk.g2o
  fails 2 "sg-dec: -r -1: must be 1 or more (see sg-dec --help)" sg-dec -r -1 walk.g2o
  fails 2 "sg-dec: --rate is required (see sg-dec --help)" sg-dec walk.g2o
}

@test "reordering and decimation commute" {
  sg-order -m random walk.g2o | sg-dec -r 2 | grep -v '^#' | sort >a
  sg-dec -r 2 walk.g2o | sg-order -m random | grep -v '^#' | sort >b
  cmp a b
}
