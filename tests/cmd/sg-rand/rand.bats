load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA/walk.g2o" .; }

kept() { sg-rand "$@" walk.g2o | grep -c EDGE_SE2_XY || true; }

@test "nothing to remove: the input, byte for byte" {
  sg-rand -r 1 --no-trace-comment walk.g2o | cmp - walk.g2o
  sg-rand -p 1 --no-trace-comment walk.g2o | cmp - walk.g2o
  sg-rand -k 99 --no-trace-comment walk.g2o | cmp - walk.g2o
  sg-rand --like walk.g2o --no-trace-comment walk.g2o | cmp - walk.g2o
}

@test "so many stay" {
  [ "$(kept -r 2)" = 3 ]
  [ "$(kept -r 4)" = 2 ]  # 1.5, rounded
  [ "$(kept -p 0.5)" = 3 ]
  [ "$(kept -k 5)" = 5 ]
  [ "$(kept -k 0)" = 0 ]
  sg-dec -r 2 -o dec.g2o walk.g2o
  [ "$(kept --like dec.g2o)" = 4 ]
}

@test "the seed decides, and nothing else" {
  cmp <(sg-rand -r 2 --seed 5 walk.g2o) <(sg-rand -r 2 --seed 5 walk.g2o)
  for seed in $(seq 40); do sg-rand -k 1 --seed $seed walk.g2o | grep EDGE_SE2_XY; done | sort -u >all
  [ "$(wc -l <all)" -eq 6 ]
}

@test "the seed is 1 where nobody gives one" {
  sg-gen sine -n 30 -o sine.g2o
  cmp <(sg-rand -r 2 --no-trace-comment sine.g2o) <(sg-rand -r 2 --seed 1 --no-trace-comment sine.g2o)
  run -1 cmp -s <(sg-rand -r 2 --no-trace-comment sine.g2o) <(sg-rand -r 2 --seed 2 --no-trace-comment sine.g2o)
}

@test "odometry stays, whatever goes" {
  [ "$(sg-rand -k 0 --candidates both walk.g2o | grep -c '^EDGE_SE2 ')" = 4 ]
}

@test "reordering does not change the choice" {
  cmp <(sg-order -m random walk.g2o | sg-rand -r 2 | grep ^EDGE) <(sg-rand -r 2 walk.g2o | grep ^EDGE)
}

@test "wrong calls" {
  fails 2 "sg-rand: -r 0: must be 1 or more (see sg-rand --help)" sg-rand -r 0 walk.g2o
  fails 2 "sg-rand: -r -1: must be 1 or more (see sg-rand --help)" sg-rand -r -1 walk.g2o
  fails 2 "sg-rand: how many candidates stay? Give one of -r, -p, -k, --like (see sg-rand --help)" sg-rand walk.g2o
  fails 2 "sg-rand: how many candidates stay? -r keeps one in R, -k so many: give one of them (see sg-rand --help)" \
    sg-rand -r 2 -k 3 walk.g2o
  run -2 sg-rand -p 1.5 walk.g2o
  fails 1 "sg-rand: missing.g2o: No such file or directory" sg-rand --like missing.g2o walk.g2o
}
