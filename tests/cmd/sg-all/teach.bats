load ../common

# --vertex, --edge and --params add types; they never change the meaning of a known one.
setup() {
  cp "$TESTDATA"/walk.g2o "$BATS_TEST_TMPDIR"
  cd "$BATS_TEST_TMPDIR"
}

tutorial() {
  "$@" --vertex TUTORIAL_VERTEX_SE2:3:pose --vertex TUTORIAL_VERTEX_POINT_XY:2:landmark \
    --edge TUTORIAL_EDGE_SE2:2 --edge TUTORIAL_EDGE_SE2_POINT_XY:2 --params TUTORIAL_PARAMS_SE2_OFFSET \
    "$TESTDATA/tutorial.g2o"
}

@test "a file of foreign tags, all of them taught" {
  [ "$(tutorial sg-ec -m landmarks-first -f ec --no-header)" = 77 ]  # 2 (2 + 3)^2 + 3^3
  [ "$(tutorial sg-ec -m id -f ec --no-header)" = 83 ]               # 3 (3 + 2)^2 + 2^3
  tutorial sg-rand -p 1 --no-trace-comment >out.g2o
  cmp "$TESTDATA/tutorial.g2o" out.g2o
  fails 1 "sg-ec: tutorial.g2o:2: unknown tag 'TUTORIAL_PARAMS_SE2_OFFSET' (teach it by --vertex, --edge or --params, or --alias it to a known one; --skip-unknown leaves such lines out)" \
    env -C "$TESTDATA" sg-ec tutorial.g2o
  fails 1 "sg-solve: $TESTDATA/tutorial.g2o:3: TUTORIAL_VERTEX_SE2 has no measurement model here" tutorial sg-solve
}

# refused OPTION SPEC CAUSE COMMAND...: a wrong call, whatever the command would do with the graph.
refused() {
  local option=$1 spec=$2 cause=$3
  shift 3
  fails 2 "$1: $option $spec: ${spec%%:[0-9]*} is known already, as $cause (see $1 --help)" "$@" "$option" "$spec" walk.g2o
}

@test "a known tag keeps its meaning" {
  for command in sg-check sg-ec sg-solve "sg-kf -r 2" "sg-plot map" "sg-convert --to tum"; do
    refused --edge EDGE_SE2:3 "an edge of 2 vertices" $command
    refused --edge EDGE_SE2:1 "an edge of 2 vertices" $command
    refused --vertex VERTEX_SE2:2:pose "a vertex of dimension 3 and role pose" $command
  done
  refused --vertex VERTEX_SE2:3:landmark "a vertex of dimension 3 and role pose" sg-info
  refused --edge EDGE_PRIOR_SE2:2 "an edge of 1 vertex" sg-info
  refused --edge EDGE_SE3_TRACKXYZ:3 "an edge of 2 vertices" sg-info
  refused --edge EDGE_SE3:3 "an edge of 2 vertices" sg-info
  refused --edge EDGE_SE2_LOTSOFXY:2 "an edge that counts its vertices" sg-info
  refused --edge VERTEX_SE2:2 "a vertex of dimension 3 and role pose" sg-info
  refused --edge FIX:1 "the tag of constants" sg-info
  refused --vertex EDGE_SE2:3:pose "an edge of 2 vertices" sg-info
  refused --vertex PARAMS_SE3OFFSET:3:pose "a parameter" sg-info
  refused --params EDGE_SE2 "an edge of 2 vertices" sg-info
  refused --params ROBOTLASER1 "sensor data" sg-info
  fails 2 "sg-info: --edge MINE:3: MINE is known already, as an edge of 2 vertices (see sg-info --help)" \
    sg-info --edge MINE:2 --edge MINE:3 walk.g2o
}

# same COMMAND...: what it prints without the taught tags is what it prints with them.
same() {
  "$@" walk.g2o >plain
  "$@" --vertex VERTEX_SE2:3:pose --edge EDGE_SE2:2 --params PARAMS_SE3OFFSET walk.g2o >taught
  cmp plain taught
}

@test "what is known may be said again" {
  same sg-info
  same sg-solve --no-trace-comment
  same sg-plot map
  same sg-convert --to tum
  same sg-convert --to toro --lossy
  same sg-tgreedy -r 2 --weights translation --no-trace-comment
  same sg-score --weights translation
}

@test "a known vertex that lacks numbers is refused, taught or not" {
  printf 'VERTEX_SE2 1 5\n' >short.g2o
  for command in "sg-plot map" "sg-convert --to tum" "sg-solve" "sg-score -f log_trees"; do
    fails 1 "${command%% *}: short.g2o:1: VERTEX_SE2 wants 3 numbers here, the line has 1" \
      $command --vertex VERTEX_SE2:3:pose short.g2o
  done
  printf 'EDGE_SE2 0 1 1\n' >short.g2o
  for command in sg-solve "sg-score --weights translation"; do
    fails 1 "${command%% *}: short.g2o:1: EDGE_SE2 wants 9 numbers here, the line has 1" $command --edge EDGE_SE2:2 short.g2o
  done
}

@test "a taught observation that lacks its parameter is the registry's all the same" {
  printf 'EDGE_SE3_TRACKXYZ 1 2\n' >short.g2o
  fails 1 "sg-solve: short.g2o:1: the line ends before a parameter id" sg-solve --edge EDGE_SE3_TRACKXYZ:2 short.g2o
}

@test "a taught vertex has no place that anybody could know" {
  printf 'VERTEX_X 1 5 5 0\n' >in.g2o
  fails 1 "sg-score: in.g2o:1: VERTEX_X is no pose that a trajectory can have" \
    sg-score --reference in.g2o --vertex VERTEX_X:3:pose in.g2o
  fails 1 "sg-convert: in.g2o:1: tum cannot hold VERTEX_X (1 line; --lossy leaves them out)" \
    sg-convert --to tum --vertex VERTEX_X:3:pose in.g2o
}

@test "an alias means what its type means, and keeps its text" {
  sed 's/^EDGE_SE3:QUAT/EDGE_SE3/' "$TESTDATA"/types-se3.g2o >alias.g2o
  [ "$(grep -c '^EDGE_SE3 ' alias.g2o)" -gt 0 ]
  sg-solve --no-trace-comment alias.g2o >solved.g2o
  sg-solve --no-trace-comment "$TESTDATA"/types-se3.g2o | sed 's/^EDGE_SE3:QUAT/EDGE_SE3/' >wanted.g2o
  cmp wanted.g2o solved.g2o
  printf 'EDGE_SE3 1 2 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4\n' >line.g2o
  [ "$(sg-convert --to toro line.g2o | tail -n 1)" = "EDGE3 1 2 1 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1" ]
  [ "$(sg-convert --to isam line.g2o)" = "EDGE3 1 2 1 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1" ]
}

@test "arities beyond reason cost nothing" {
  fails 1 "sg-info: in.g2o:1: the line ends before a vertex id" \
    sh -c 'echo "BIG 1 2" >in.g2o; sg-info --edge BIG:2000000000 in.g2o'
}

@test "what is no specification" {
  fails 2 "sg-info: --params: its value, TAG, is empty (see sg-info --help)" sg-info --params '' walk.g2o
  fails 2 "sg-info: --edge wants TAG:ARITY, as in EDGE_MINE:2, not 'E:0' (see sg-info --help)" sg-info --edge E:0 walk.g2o
  fails 2 "sg-info: --vertex wants TAG:DIM:ROLE with ROLE pose, landmark or other, not 'V:3' (see sg-info --help)" \
    sg-info --vertex V:3 walk.g2o
}
