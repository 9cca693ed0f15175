load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA/walk.g2o" .; }

score() { sg-score --no-header "$@" | tr '\t' ' '; }

edges() { for pair in "$@"; do echo "EDGE_SE2 ${pair/-/ } 0 0 0 1 0 0 1 0 1"; done; }

@test "a tree has one spanning tree, a cycle of n has n, K4 has 16" {
  near "$(score -f log_trees <(edges 0-1 1-2 2-3))" 0
  near "$(score -f log_trees <(edges 0-1 1-2 2-3 3-0))" 1.386294361119891
  near "$(score -f log_trees <(edges 0-1 1-2 2-3 3-0 0-2 1-3))" 2.772588722239781
  near "$(score -f lambda2 <(edges 0-1 1-2 2-3 3-0 0-2 1-3))" 4
}

@test "a graph in two parts, and a single vertex" {
  [ "$(score -f log_trees,lambda2 <(edges 0-1 2-3))" = "-inf 0" ]
  [ "$(sg-score --json -f log_trees,lambda2 <(edges 0-1 2-3))" = '{"log_trees": null, "lambda2": 0}' ]
  echo 'VERTEX_SE2 0 0 0 0' >one.g2o
  [ "$(score -f log_trees,lambda2,dopt,ec one.g2o)" = "0  0 27" ]
}

@test "ec is what sg-ec says" {
  for method in colamd id; do
    [ "$(score -m $method -f order,ec walk.g2o)" = "$(sg-ec --no-header -m $method -f order,ec walk.g2o | tr '\t' ' ')" ]
  done
}

@test "observations a landmark" {
  [ "$(score -f avg_obs walk.g2o)" = 3 ]
  [ "$(sg-dec -r 3 walk.g2o | score -f avg_obs)" = 1 ]
  [ "$(score -f avg_obs <(edges 0-1))" = "" ]
}

@test "default columns" {
  [ "$(sg-score walk.g2o | head -1 | tr '\t' ' ')" = "vertices edges log_trees lambda2 dopt sigma_mean sigma_max avg_obs order ec" ]
  [ "$(sg-score --reference walk.g2o walk.g2o walk.g2o | head -1 | tr '\t' ' ')" = \
    "file vertices edges log_trees lambda2 dopt sigma_mean sigma_max avg_obs matched ate_rmse rpe_rmse order ec" ]
}

@test "sigmas of a chain by hand" {
  # variances of x and y add up, and the turn of the first step moves the last pose by a metre
  printf 'VERTEX_SE2 %s 0 0\n' "0 0" "1 1" "2 2" >chain.g2o
  printf 'EDGE_SE2 %s 1 0 0 4 0 0 4 0 1\n' "0 1" "1 2" >>chain.g2o
  sg-score --per-pose --no-header chain.g2o >out
  [ "$(sed -n 1p out)" = "0	0" ]
  near "$(sed -n 2p out | cut -f2)" 0.7071067811865476  # sqrt(1/4 + 1/4)
  near "$(sed -n 3p out | cut -f2)" 1.4142135623730951  # sqrt(1/2 + 1/2 + 1)
  near "$(score -f sigma_mean chain.g2o)" 0.7071067811865476
  near "$(score -f sigma_max chain.g2o)" 1.4142135623730951
}

@test "a graph that leaves something undetermined has no dopt and no sigma, and is told of it" {
  edges 0-1 2-3 >parts.g2o
  run -0 --separate-stderr sg-score --no-header -f edges,dopt,sigma_mean,sigma_max parts.g2o
  [ "$output" = "2			" ]
  [[ $stderr == "sg-score: parts.g2o: no dopt and no sigma: the system is singular: "*" leave vertices 2 and 3 undetermined"* ]]
  [ "$(sg-score -q --json -f dopt,sigma_max parts.g2o)" = '{"dopt": null, "sigma_max": null}' ]
  [ "$(sg-score -q --no-header --per-pose parts.g2o | tr '\t\n' '-;')" = "0-;1-;2-;3-;" ]
  [ "$(sg-score --no-header -f edges parts.g2o 2>&1)" = 2 ]  # nobody asked
}

@test "a row a pose, of several files, and what is in vain with it" {
  [ "$(sg-score --per-pose walk.g2o walk.g2o | head -1 | tr '\t' ' ')" = "file id sigma" ]
  [ "$(sg-score --per-pose --no-header -f file,id walk.g2o walk.g2o | wc -l)" -eq 10 ]
  fails 2 "sg-score: --weights has no effect with --per-pose (see sg-score --help)" sg-score --per-pose --weights unit walk.g2o
  fails 2 "sg-score: -m: one ordering with --per-pose: sigma does not depend on it (see sg-score --help)" \
    sg-score --per-pose -m id,wmf walk.g2o
}

@test "trajectory errors by hand, against a graph and a TUM file" {
  # the walk with pose 4 off by (0, 3): errors 0 0 0 0 3, and steps 0 0 0 3
  sed 's/^VERTEX_SE2 4 4 0 0/VERTEX_SE2 4 4 3 0/' walk.g2o >off.g2o
  near "$(score --align none -f ate_rmse --reference walk.g2o off.g2o)" 1.3416407864998738  # sqrt(9/5)
  near "$(score --align none -f rpe_rmse --reference walk.g2o off.g2o)" 1.5                 # sqrt(9/4)
  printf '# t x y z qx qy qz qw\n%s\n' "0 0 0 0 0 0 0 1" "4 4 0 0 0 0 0 1" >walk.tum
  near "$(score --align none -f ate_rmse --reference walk.tum off.g2o)" 2.1213203435596424  # sqrt(9/2)
  [ "$(score -f matched --reference walk.tum off.g2o)" = 2 ]
  # two points of distance 5 against 4: half a metre at each end, none with scale
  near "$(score -f ate_rmse --reference walk.tum off.g2o)" 0.5
  near "$(score --align sim -f ate_rmse --reference walk.tum off.g2o)" 0
}

@test "wrong calls and inputs" {
  fails 2 "sg-score: column 'ate_rmse' wants a --reference (see sg-score --help)" sg-score -f ate_rmse walk.g2o
  fails 1 "sg-score: no.g2o: No such file or directory" sg-score --reference no.g2o walk.g2o
  echo '0.5 0 0 0 0 0 0 1' >half.tum
  fails 1 "sg-score: half.tum:1: a time that is no vertex id: poses are matched by id" \
    sg-score --reference half.tum walk.g2o
  run -2 sg-score --align sideways walk.g2o
}

@test "public graphs: keeping all trees of intel, and less of them" {
  need_data
  all=$(score -f log_trees "$SGTOOLS_DATA/intel.g2o")
  greedy=$(sg-tgreedy -r 4 "$SGTOOLS_DATA/intel.g2o" | score -f log_trees)
  random=$(sg-rand -r 4 "$SGTOOLS_DATA/intel.g2o" | score -f log_trees)
  awk -v a="$all" -v g="$greedy" -v r="$random" 'BEGIN {exit !(a > g && g > r && r > 0)}'
  # what tgreedy's trace says is what sg-score measures
  near "$greedy" "$(sg-tgreedy -r 4 --trace "$SGTOOLS_DATA/intel.g2o" | tail -1 | cut -f6)"
}

@test "a trajectory that is not finite is not scored" {
  sed '/^VERTEX_SE2 1 /s/ [^ ]*$/ nan/' walk.g2o >nan.g2o
  line=$(grep -n '^VERTEX_SE2 1 ' walk.g2o | cut -d: -f1)
  fails 1 "sg-score: nan.g2o:$line: a number is not finite" sg-score --reference nan.g2o -f ate_rmse walk.g2o
}
