load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA/walk.g2o" .; }

# Three poses in a row, a metre apart: variances 1/4, 1/4 and 1 a step.
chain() {
  printf 'VERTEX_SE2 %s 0 0\n' "0 0" "1 1" "2 2"
  printf 'EDGE_SE2 %s 1 0 0 4 0 0 4 0 1\n' "0 1" "1 2"
}

# numbers EXPECTED ACTUAL: two lists, one by one.
numbers() {
  read -ra expected <<<"$1"
  read -ra actual <<<"$2"
  [ ${#expected[@]} -eq ${#actual[@]} ] || return 1
  for k in "${!expected[@]}"; do near "${actual[k]}" "${expected[k]}" || return 1; done
}

@test "blocks of a chain by hand" {
  chain >chain.g2o
  sg-cov --no-header -f covariance chain.g2o >out
  [ "$(wc -l <out)" -eq 3 ]
  [ "$(sed -n 1p out)" = "0 0 0 0 0 0" ]
  numbers "0.25 0 0 0.25 0 1" "$(sed -n 2p out)"
  # x: 1/4 + 1/4; y: 1/4 + 1/4 + 1 of the first turn, with which it shares 1; turn: 2
  numbers "0.5 0 0 1.5 1 2" "$(sed -n 3p out)"
}

@test "a pair by hand, in either order" {
  chain >chain.g2o
  numbers "0.25 0 0 0.25 0 0 0.25 0 0 0.25 0 1 0 1 1 0.5 0 0 1.5 1 2" \
    "$(sg-cov --no-header -f covariance --pairs 1,2 chain.g2o)"
  numbers "0.5 0 0 0.25 0 0 1.5 1 0 0.25 1 2 0 0 1 0.25 0 0 0.25 0 1" \
    "$(sg-cov --no-header -f covariance --pairs 2,1 chain.g2o)"
  [ "$(sg-cov --no-header --pairs 0,1,0,2 -f first,second chain.g2o | tr '\t\n' '-;')" = "0-1;0-2;" ]
}

@test "the ellipse: longest axis across the way, turned with the graph" {
  chain >chain.g2o
  numbers "1.224744871391589 0.7071067811865476" "$(sg-cov --no-header --ids 2 --ellipse -f axes chain.g2o)"
  near "$(sg-cov --no-header --ids 2 -f angle chain.g2o)" 1.5707963267948966
  [ "$(sg-cov --ellipse chain.g2o | head -1 | tr '\t' ' ')" = "id tag sigma axes angle covariance" ]
}

@test "sg-score's sigma, by any ordering" {
  [ "$(sg-cov --no-header -f id,sigma walk.g2o)" = "$(sg-score --no-header --per-pose walk.g2o)" ]
  sg-cov --no-header -m id --ids 4 -f sigma walk.g2o >out
  near "$(cat out)" "$(sg-cov --no-header -m wmf --ids 4 -f sigma walk.g2o)"
}

@test "all vertices, some of them, and JSON" {
  [ "$(sg-cov --all --no-header -f id walk.g2o | paste -sd' ')" = "0 1 2 3 4 100 101" ]
  [ "$(sg-cov --ids 100,1 --no-header -f id,tag walk.g2o | tr '\t\n' ' ;')" = "100 VERTEX_XY;1 VERTEX_SE2;" ]
  [ "$(sg-cov --pairs 0,0 --json walk.g2o | cut -d, -f1-4)" = '{"first": 0, "second": 0, "covariance": [0, 0' ]
  [ "$(sg-cov --ids 0 --json -f id,covariance walk.g2o)" = '{"id": 0, "covariance": [0, 0, 0, 0, 0, 0]}' ]
}

@test "wrong calls, and graphs without covariances" {
  fails 2 "sg-cov: --pairs wants two ids, or four, or six, not 3 (see sg-cov --help)" sg-cov --pairs 1,2,3 walk.g2o
  fails 2 "sg-cov: --ids 42: the graph has no such vertex (see sg-cov --help)" sg-cov --ids 42 walk.g2o
  fails 2 "sg-cov: --pairs 42: the graph has no such vertex (see sg-cov --help)" sg-cov --pairs 1,42 walk.g2o
  fails 2 "sg-cov: --ellipse has no effect with --pairs (see sg-cov --help)" sg-cov --pairs 1,2 --ellipse walk.g2o
  printf 'VERTEX_SE2 %s 0 0 0\n' 0 1 2 >parts.g2o
  echo 'EDGE_SE2 0 1 1 0 0 4 0 0 4 0 1' >>parts.g2o
  run -3 sg-cov parts.g2o
  [[ $output == *"vertex 2"* ]]
}
