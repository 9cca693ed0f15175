load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA/walk.g2o" .; }

# kld FILE FULL
kld() { sg-score --no-header -f kld --reference "$2" "$1"; }

@test "what stays is copied byte for byte, and what comes is at the end" {
  sg-marg --no-trace-comment --ids 1 walk.g2o >out.g2o
  grep -vE '^(VERTEX_SE2 1 |EDGE_SE2 0 1|EDGE_SE2 1 2|EDGE_SE2_XY 1 )' walk.g2o >kept.g2o
  head -n "$(wc -l <kept.g2o)" out.g2o | cmp - kept.g2o
  [ "$(tail -n 2 out.g2o | awk '{print $1, $2, $3}' | paste -sd,)" = "EDGE_SE2 0 2,EDGE_SE2_XY 0 100" ]
}

@test "a linear factor is exact, for every command that reads it" {
  sg-solve -q walk.g2o -o full.g2o
  for what in '--ids 1' '-r 2' '--landmarks all' '--older-than 3' '--dist 2.5' '-r 3 --landmarks 3'; do
    echo "$what"
    sg-marg $what --topology dense full.g2o -o left.g2o
    near "$(kld left.g2o full.g2o)" 0
    near "$(sg-score --no-header -f overconfidence --reference full.g2o left.g2o)" 1
    sg-solve -q left.g2o -o again.g2o
    near "$(sg-score --no-header --align none -f ate_rmse --reference full.g2o again.g2o)" 0 1e-7
    sg-check left.g2o
    sg-info left.g2o >info
    sg-ec left.g2o >ec
    sg-order -m wmf left.g2o | sg-bayes >bayes
    sg-cov left.g2o >cov
    sg-isam2 left.g2o >steps
    run -1 sg-check --for g2o left.g2o
    [[ $output == *"g2o does not read EDGE_LINEAR"* ]]
  done
}

@test "a landmark that goes joins the poses that saw it; one seen by few is chosen by its sights" {
  [ "$(sg-marg --landmarks all walk.g2o | grep -c XY)" = 0 ]
  cat >seen.g2o <<'END'
VERTEX_SE2 0 0 0 0
VERTEX_SE2 1 1 0 0
VERTEX_SE2 2 2 0 0
VERTEX_XY 10 1 1
VERTEX_XY 11 1 2
EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1
EDGE_SE2 1 2 1 0 0 1 0 0 1 0 1
EDGE_SE2_XY 0 10 1 1 1 0 1
EDGE_SE2_XY 1 10 0 1 1 0 1
EDGE_SE2_XY 2 10 -1 1 1 0 1
EDGE_SE2_XY 1 11 0 2 1 0 1
END
  [ "$(sg-marg --landmarks 3 seen.g2o | awk '/^VERTEX_XY/ {print $2}')" = 10 ]
  [ "$(sg-marg --landmarks 2 seen.g2o | grep -c EDGE)" = 5 ]   # seen once, it says nothing of anybody
  [ "$(sg-marg --landmarks 4 seen.g2o | grep -c EDGE_SE2)" = 4 ] # a tree of the three that saw 10
}

@test "topologies in order of what they keep" {
  sg-gen manhattan -n 120 --seed 3 | sg-solve -q -o full.g2o
  for how in dense 'dense --as poses' 'subgraph -k 9' 'subgraph -k 1' tree; do
    sg-marg -r 2 --topology $how full.g2o -o left.g2o
    kld left.g2o full.g2o
  done >klds
  near "$(head -n 1 klds)" 0
  tail -n +2 klds | sort -gc
  sg-marg -r 2 --conservative --topology subgraph full.g2o -o careful.g2o
  awk -v most="$(sg-score --no-header -f overconfidence --reference full.g2o careful.g2o)" 'BEGIN {exit !(most < 1 + 1e-6)}'
}

@test "elimination complexity has a price, or a budget" {
  sg-gen manhattan -n 300 --seed 3 | sg-solve -q -o full.g2o
  ec() { sg-ec -m wmf -f ec --no-header "$1"; }
  marg() { sg-marg -q -r 2 --topology ec --cluster global "$@" full.g2o; }
  marg --price 100 -o dear.g2o
  marg --price 0.01 -o cheap.g2o
  [ "$(ec dear.g2o)" -lt "$(ec cheap.g2o)" ]
  printf '%s\n' "$(kld cheap.g2o full.g2o)" "$(kld dear.g2o full.g2o)" | sort -gc
  budget=$((($(ec dear.g2o) + $(ec cheap.g2o)) / 2))
  marg --ec "$budget" -o within.g2o
  [ "$(ec within.g2o)" -le "$budget" ]
  [ "$(ec within.g2o)" -ge "$(ec dear.g2o)" ]
  run -0 sg-marg -r 2 --topology ec --ec 1 full.g2o -o little.g2o
  [[ $output == "sg-marg: an EC of 1 is less than that of the sparsest graph found, "* ]]
}

@test "a graph that was at its optimum stays there" {
  sg-gen sphere -n 200 --seed 2 | sg-solve -q -o full.g2o
  for how in '--topology tree' '--topology subgraph' '--topology ec --cluster global'; do
    echo "$how"
    sg-marg -r 4 $how full.g2o -o left.g2o
    sg-solve -q left.g2o -o again.g2o
    near "$(sg-score --no-header --align none -f ate_rmse --reference full.g2o again.g2o)" 0 1e-5
  done
}

@test "what a pose was owed that goes as the last neighbour of another is not lost" {
  need_data
  sg-solve -q "$SGTOOLS_DATA/intel.g2o" -o full.g2o
  for how in '--topology tree' '--topology ec --cluster global' '--topology ec --cluster batch'; do
    echo "$how"
    sg-marg -q -r 4 $how full.g2o -o left.g2o
    sg-solve -q left.g2o -o again.g2o
    near "$(sg-score --no-header --align none -f ate_rmse --reference full.g2o again.g2o)" 0 1e-4
  done
}

@test "every topology and clustering leaves a graph that is sound, of g2o's own tags" {
  sg-gen manhattan -n 60 --seed 3 | sg-solve -q -o full.g2o
  for topology in tree subgraph l1 seif ec 'dense --as poses'; do
    for cluster in online batch global; do
      echo "$topology $cluster"
      sg-marg -r 3 --topology $topology --cluster $cluster full.g2o -o left.g2o
      sg-check -q --for g2o left.g2o >findings
      [ "$(sg-info --no-header -f poses left.g2o | cut -f 2)" = 20 ]
      kld left.g2o full.g2o | grep -q '[0-9]'
    done
  done
}

@test "ids from a file, ranges, and constants" {
  printf '1\n3:3 100\n' >ids
  [ "$(sg-marg --ids ids walk.g2o | awk '/^VERTEX/ {print $2}' | paste -sd' ')" = "0 2 4 101" ]
  [ "$(sg-marg --ids 1:3 walk.g2o | awk '/^VERTEX/ {print $2}' | paste -sd' ')" = "0 4 100 101" ]
  fails 2 "sg-marg: --ids 0: a FIX line holds this vertex: it is a constant (see sg-marg --help)" sg-marg --ids 0 walk.g2o
  fails 2 "sg-marg: --ids 7: the graph has no such vertex (see sg-marg --help)" sg-marg --ids 7 walk.g2o
  fails 2 "sg-marg: --ids nofile is neither a list of ids nor a file that can be read (see sg-marg --help)" sg-marg --ids nofile walk.g2o
  fails 2 "sg-marg: --ids . is neither a list of ids nor a file that can be read (see sg-marg --help)" sg-marg --ids . walk.g2o
  printf '1 x\n' >ids
  fails 2 "sg-marg: --ids ids: x is no range FIRST:LAST (see sg-marg --help)" sg-marg --ids ids walk.g2o
  printf '1 7\n' >ids
  fails 2 "sg-marg: --ids ids: 7: the graph has no such vertex (see sg-marg --help)" sg-marg --ids ids walk.g2o
  [ "$(sg-marg --older-than 9 walk.g2o | awk '/^VERTEX/ {print $2}')" = 0 ]
}

@test "calls that make no sense" {
  fails 2 "sg-marg: which vertices? Give --ids, -r, --dist or --angle, --older-than or --landmarks (see sg-marg --help)" sg-marg walk.g2o
  fails 2 "sg-marg: --as factors is of --topology dense: a sparse one has poses (see sg-marg --help)" sg-marg -r 2 --as factors walk.g2o
  fails 2 "sg-marg: --price has no effect but with --topology ec (see sg-marg --help)" sg-marg -r 2 --price 2 walk.g2o
  fails 2 "sg-marg: --landmarks wants all, or a number of observations, not 'few' (see sg-marg --help)" sg-marg --landmarks few walk.g2o
  fails 2 "sg-marg: --landmarks wants all, or a number of observations, not '-2' (see sg-marg --help)" sg-marg --landmarks -2 walk.g2o
  grep -v VERTEX walk.g2o | grep -v FIX >edges.g2o
  fails 1 "sg-marg: edges.g2o: there are no VERTEX lines, hence no estimates to linearize at (sg-solve adds them)" \
    sg-marg -r 2 edges.g2o
  sed 's/^FIX.*//' walk.g2o >free.g2o
  fails 2 "sg-marg: all vertices of free.g2o would go (see sg-marg --help)" sg-marg --ids 0:999 free.g2o
}

@test "what no edge of g2o's can say is named before anything is written" {
  cat >pixels.g2o <<'END'
PARAMS_CAMERAPARAMETERS 0 500 320 240 0
VERTEX_SE3:EXPMAP 0 0 0 0 0 0 0 1
VERTEX_SE3:EXPMAP 1 1 0 0 0 0 0 1
VERTEX_XYZ 2 0 0 5
EDGE_PROJECT_XYZ2UV:EXPMAP 2 0 0 445 365 1 0 1
EDGE_PROJECT_XYZ2UV:EXPMAP 2 1 0 320 365 1 0 1
EDGE_SE3:EXPMAP 0 1 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1
END
  fails 1 "sg-marg: pixels.g2o:6: vertex 1 of this EDGE_PROJECT_XYZ2UV:EXPMAP cannot be taken out: no measurement between two vertices would say where VERTEX_XYZ 2 is beside its other neighbours (--topology dense leaves a linear factor)" \
    sg-marg --ids 1 pixels.g2o -o out.g2o
  [ ! -e out.g2o ]
  sg-marg --ids 1 --topology dense pixels.g2o | grep -q '^EDGE_LINEAR_RELATIVE 0 1 2 '
  # What a camera alone told of points turns with the whole, and a vector between two would not.
  cp "$TESTDATA/desk.bal" .
  fails 1 "sg-marg: desk.bal:67: vertex 1 of this EDGE_OBSERVATION_BAL cannot be taken out: no measurement between two vertices would say where VERTEX_XYZ 20 is beside its other neighbours (--topology dense leaves a linear factor)" \
    sg-marg --ids 1 desk.bal
  printf 'VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0 0\nVERTEX_LINE2D 2 0 1\nEDGE_SE2_LINE2D 0 2 0 1 1 0 1\n' >line.g2o
  fails 1 "sg-marg: line.g2o:3: VERTEX_LINE2D has no measurement model here" sg-marg --ids 2 line.g2o
}

@test "a prior among what goes stays known" {
  { grep -v FIX walk.g2o; echo 'EDGE_PRIOR_SE2 1 1 0 0 9 0 0 9 0 99'; } | sg-solve -q -o full.g2o
  sg-marg --ids 1 --topology dense full.g2o -o left.g2o
  grep -q '^EDGE_LINEAR ' left.g2o
  near "$(kld left.g2o full.g2o)" 0
  [ "$(sg-marg --ids 1 full.g2o | grep -c '^EDGE_PRIOR_SE2 ')" = 1 ]
}

@test "points of space come back with the sensor that the file has, or one of their own" {
  cat >space.g2o <<'END'
PARAMS_SE3OFFSET 4 0.1 0 0 0 0 0 1
VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1
VERTEX_SE3:QUAT 1 1 0 0 0 0 0 1
VERTEX_SE3:QUAT 2 2 0 0 0 0 0 1
VERTEX_TRACKXYZ 7 1 1 1
EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1
EDGE_SE3:QUAT 1 2 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1
EDGE_SE3_TRACKXYZ 1 7 4 -0.1 1 1 1 0 0 1 0 1
EDGE_SE3_TRACKXYZ 0 7 4 0.9 1 1 1 0 0 1 0 1
END
  sg-marg --ids 1 space.g2o -o left.g2o
  grep -qx 'PARAMS_SE3OFFSET 5 0 0 0 0 0 0 1' left.g2o
  [ "$(grep -c 'EDGE_SE3_TRACKXYZ . 7 5 ' left.g2o)" = 1 ]
  sg-check -q --for g2o left.g2o >findings
  sed 's/OFFSET 4 0.1/OFFSET 4 0/' space.g2o | sg-marg --ids 1 -o left.g2o
  [ "$(grep -c 'EDGE_SE3_TRACKXYZ . 7 4 ' left.g2o)" = 2 ]
}
