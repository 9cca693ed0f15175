load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA/walk.g2o" .; }

kept() { sg-tgreedy --trace --no-header -f first,second "$@" | tr '\t' - | paste -sd' '; }

# Six poses in a row and three loop closures, short, long and in the middle.
loops() {
  for k in 0 1 2 3 4; do echo "EDGE_SE2 $k $((k + 1)) 1 0 0 4 0 0 4 0 9"; done
  echo 'EDGE_SE2 0 2 2 0 0 100 0 0 100 0 1'
  echo 'EDGE_SE2 0 5 5 0 0 1 0 0 1 0 1'
  echo 'EDGE_SE2 1 4 3 0 0 1 0 0 1 0 100'
}

@test "nothing to remove: the input, byte for byte" {
  sg-tgreedy -r 1 --no-trace-comment walk.g2o | cmp - walk.g2o
  sg-tgreedy -k 99 --no-trace-comment walk.g2o | cmp - walk.g2o
  sg-tgreedy --like walk.g2o --no-trace-comment walk.g2o | cmp - walk.g2o
}

@test "no candidates" {
  sg-tgreedy -k 5 --candidates observations <(loops) --no-trace-comment | cmp - <(loops)
  [ "$(sg-tgreedy -r 2 --trace <(loops | head -5) | wc -l)" -eq 1 ]
}

@test "the longest cycle first; weights change the choice" {
  [ "$(kept -k 1 <(loops))" = 0-5 ]
  [ "$(kept -k 1 --weights translation <(loops))" = 0-2 ]
  [ "$(kept -k 1 --weights rotation <(loops))" = 1-4 ]
  [ "$(kept -k 3 <(loops))" = "0-5 1-4 0-2" ]
}

@test "gains by hand" {
  # R = 5 of the chain; then 1-4 is 3 parallel to 3, 1.5; then 0-2 in the graph with both
  sg-tgreedy -k 2 --trace -f gain,log_trees <(loops) >out
  near "$(sed -n 2p out | cut -f1)" 1.791759469228055   # log 6
  near "$(sed -n 3p out | cut -f1)" 0.9162907318741551  # log 2.5
}

@test "each landmark is attached first" {
  [ "$(kept -k 2 walk.g2o)" = "0-100 2-101" ]
  [ "$(sg-tgreedy -k 1 walk.g2o | grep -c XY)" -eq 2 ]  # one landmark and its observation
  [ "$(sg-tgreedy -k 3 walk.g2o | grep -c XY)" -eq 5 ]
}

@test "with -o the trace and the graph" {
  sg-tgreedy -r 2 --trace -o out.g2o walk.g2o >table
  [ "$(wc -l <table)" -eq 4 ]
  [ "$(grep -c EDGE_SE2_XY out.g2o)" -eq 3 ]
  sg-tgreedy -r 2 --trace --json walk.g2o | sed -n 1p | grep -q '^{"kept": 1, "first": 0, "second": 100, '
}

@test "online: the batch's share, of what is seen" {
  # after pose 2: one candidate of three seen, half of it rounded up is spent on it
  [ "$(kept -k 2 --online <(loops))" = "0-2 0-5" ]
  [ "$(kept -k 2 --online 6 <(loops))" = "0-5 1-4" ]
  [ "$(kept -k 2 --online=6 <(loops))" = "0-5 1-4" ]
  [ "$(sg-tgreedy -k 4 --online walk.g2o | grep -c EDGE_SE2_XY)" -eq 4 ]
}

@test "trajectories in parts are joined, or a message says that they are not" {
  loops | sed -e '/ 2 3 /d' >parts
  [ "$(kept -k 1 parts)" = 0-5 ]
  run -0 sg-tgreedy -k 1 -o out.g2o parts
  [ -z "$output" ]
  [ "$(sg-tgreedy -k 0 -o out.g2o parts 2>&1)" = \
    "sg-tgreedy: the trajectory falls into 2 parts: too few candidates are kept to join them" ]
}

@test "reordering does not change the choice" {
  [ "$(kept -k 4 walk.g2o)" = "$(sg-order -m random walk.g2o | sg-tgreedy -k 4 --trace --no-header -f first,second |
    tr '\t' - | paste -sd' ')" ]
}

@test "wrong calls and inputs" {
  fails 2 "sg-tgreedy: -r 0: must be 1 or more (see sg-tgreedy --help)" sg-tgreedy -r 0 walk.g2o
  fails 2 "sg-tgreedy: --online 0: must be 1 or more (see sg-tgreedy --help)" \
    sg-tgreedy -r 2 --online 0 walk.g2o
  fails 2 "sg-tgreedy: how many candidates stay? Give one of -r, -p, -k, --like (see sg-tgreedy --help)" \
    sg-tgreedy walk.g2o
  fails 1 "sg-tgreedy: walk.g2o: no candidate has a weight of this kind: all are zero" \
    sg-tgreedy -r 2 --weights rotation walk.g2o
  { cat walk.g2o; echo 'EDGE_BEARING_SE2_XY 0 100 1 1'; } >bearing.g2o
  fails 1 "sg-tgreedy: bearing.g2o:21: EDGE_BEARING_SE2_XY measures neither translation nor rotation: only unit weights are known" \
    sg-tgreedy -r 2 --weights dopt bearing.g2o
}

@test "half of intel's loop closures" {
  need_data
  sg-tgreedy -r 2 "$SGTOOLS_DATA/intel.g2o" -o out.g2o
  [ "$(grep -c EDGE out.g2o)" -eq 2120 ]  # 1727 of odometry, 393 of 785 loop closures
}
