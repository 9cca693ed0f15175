# sg-isam2: rows, columns, the final graph, and what ends a replay.
load ../common

setup() {
  cd "$BATS_TEST_TMPDIR"
}

# chain N: N poses a metre apart, odometry only.
chain() {
  for ((k = 1; k < $1; ++k)); do echo "EDGE_SE2 $((k - 1)) $k 1 0 0 100 0 0 100 0 100"; done
}

@test "a row a step, with the columns that cost nothing" {
  sg-isam2 "$TESTDATA/walk.g2o" > rows.tsv
  [ "$(head -n 1 rows.tsv)" = "$(printf 'step\tvariables\tfactors\tec_bt\tupdate_s\treeliminated\trelinearized\tcliques')" ]
  [ "$(wc -l < rows.tsv)" -eq 6 ]
}

@test "columns that cost time come when they are asked for" {
  sg-isam2 --colamd --chi2 --batch "$TESTDATA/walk.g2o" > rows.tsv
  [ "$(head -n 1 rows.tsv | cut -f 5,10,11)" = "$(printf 'ec_colamd\tchi2\tbatch_s')" ]
  [ "$(awk 'NF != 11' rows.tsv | wc -l)" -eq 0 ]
  [ "$(sg-isam2 -f ec_colamd --no-header "$TESTDATA/walk.g2o" | tail -n 1)" -gt 0 ]
}

@test "ec_colamd is what sg-ec says of the growing graph" {
  sg-isam2 --no-header -f step,ec_colamd "$TESTDATA/types-se2.g2o" > ours.tsv
  sg-ec --trace -m colamd --no-header -f step,ec "$TESTDATA/types-se2.g2o" > theirs.tsv
  diff ours.tsv theirs.tsv
}

@test "odometry alone: nothing but the last clique and the new pose is eliminated" {
  chain 100 | sg-isam2 -f reeliminated,relinearized --no-header > rows.tsv
  [ "$(tail -n 80 rows.tsv | sort -u)" = "$(printf '3\t0')" ]
}

@test "every K-th step and the last" {
  [ "$(chain 10 | sg-isam2 --every 4 -f step --no-header | tr '\n' ' ')" = "0 4 8 9 " ]
}

@test "-o writes the estimates and keeps the rest" {
  grep -v ^VERTEX "$TESTDATA/types-se2.g2o" > rest.txt
  sg-isam2 -o end.g2o "$TESTDATA/types-se2.g2o" > /dev/null
  grep -v ^VERTEX end.g2o | grep -v '^# sg-isam2' | diff rest.txt -
  [ "$(grep -c ^VERTEX end.g2o)" -eq "$(grep -c ^VERTEX "$TESTDATA/types-se2.g2o")" ]
}

@test "the final chi-square is that of the written graph" {
  chi2=$(sg-isam2 -o end.g2o -f chi2 --no-header "$TESTDATA/types-se3.g2o" | tail -n 1)
  near "$chi2" "$(sg-solve --chi2 end.g2o)" 1e-6
}

@test "--init file starts where the file is" {
  chain 3 > edges.g2o
  fails 1 "sg-isam2: edges.g2o: the file has no VERTEX line to start from" sg-isam2 --init file edges.g2o
  sg-isam2 --init file "$TESTDATA/walk.g2o" > /dev/null
}

@test "a step that cannot be solved ends the replay by its number; the rows before it stand" {
  { chain 3; echo "EDGE_SE2 3 4 1 0 0 100 0 0 100 0 100"; } > broken.g2o
  fails 3 "sg-isam2: step 3: the system is singular: the measurements leave vertex 3 undetermined; add edges or FIX lines, or leave it out" \
    sg-isam2 -o end.g2o broken.g2o
  run -3 --separate-stderr sg-isam2 -f step,variables --no-header broken.g2o
  [ "$output" = "$(printf '0\t1\n1\t2\n2\t3')" ]
  [ ! -e end.g2o ]
}

@test "an edge without a derivative ends the replay by its line, and nothing is written" {
  printf '%s\n' 'VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1' 'VERTEX_SE3:QUAT 1 0 0 1 0 0 0 1' 'VERTEX_TRACKXYZ 2 0 0 0' \
    'PARAMS_CAMERACALIB 0 0 0 0 0 0 0 1 500 500 320 240' \
    'EDGE_SE3:QUAT 0 1 0 0 1 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1' \
    'EDGE_PROJECT_DISPARITY 1 2 0 320 240 1 1 0 0 1 0 1' \
    'EDGE_PROJECT_DISPARITY 0 2 0 320 240 1 1 0 0 1 0 1' > zero.g2o
  fails 3 "sg-isam2: zero.g2o:7: EDGE_PROJECT_DISPARITY has no derivative at this estimate" \
    sg-isam2 --init file -o end.g2o zero.g2o
  [ ! -e end.g2o ]
  fails 3 "sg-solve: zero.g2o:7: EDGE_PROJECT_DISPARITY has no derivative at this estimate" \
    sg-solve --start file -o end.g2o zero.g2o
  [ ! -e end.g2o ]
  fails 3 "sg-solve: zero.g2o:7: EDGE_PROJECT_DISPARITY has no derivative at this estimate" sg-solve --time 1 zero.g2o
}

@test "a landmark at the origin in a camera's plane is told, by whatever camera, and no NaN is printed" {
  printf '%s\n' 'VERTEX_SE3:EXPMAP 0 0 0 1 0 0 0 1' 'VERTEX_SE3:EXPMAP 1 1 0 0 0 0 0 1' 'VERTEX_XYZ 2 0 0 0' \
    'PARAMS_CAMERAPARAMETERS 0 500 320 240 0' 'FIX 0' \
    'EDGE_SE3:EXPMAP 0 1 1 0 -1 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1' \
    'EDGE_PROJECT_XYZ2UV:EXPMAP 2 0 0 320 240 1 0 1' 'EDGE_PROJECT_XYZ2UV:EXPMAP 2 1 0 400 240 1 0 1' > plane.g2o
  fails 3 "sg-isam2: plane.g2o:8: EDGE_PROJECT_XYZ2UV:EXPMAP has no derivative at this estimate" \
    sg-isam2 --init file -f step,chi2 plane.g2o
  fails 3 "sg-solve: plane.g2o:8: EDGE_PROJECT_XYZ2UV:EXPMAP has no finite error at this estimate" sg-solve --chi2 plane.g2o
  [ "$(sg-isam2 --init file -f step,chi2 --no-header plane.g2o 2> /dev/null)" = "$(printf '0\t0')" ]
}

@test "information too large to be summed up ends both solvers by its line" {
  { chain 2; echo "EDGE_SE2 1 2 1 0 0 1e308 0 0 1e308 0 1e308"; } > huge.g2o
  local why="huge.g2o:2: EDGE_SE2 weighs too much to calculate with: its information or its error is too large"
  fails 3 "sg-isam2: $why" sg-isam2 -o end.g2o huge.g2o
  fails 3 "sg-solve: $why" sg-solve -o end.g2o huge.g2o
  fails 3 "sg-solve: $why" sg-solve --backend cholmod -o end.g2o huge.g2o
  [ ! -e end.g2o ]
}

@test "a landmark seen by bearings enters with its second and stands where they meet" {
  { echo "VERTEX_SE2 0 0 0 0"; echo "VERTEX_SE2 1 1 0 0"; echo "VERTEX_XY 2 1 1"
    echo "EDGE_SE2 0 1 1 0 0 100 0 0 100 0 100"
    echo "EDGE_BEARING_SE2_XY 0 2 0.785398 100"; echo "EDGE_BEARING_SE2_XY 1 2 1.570796 100"; } > bearing.g2o
  [ "$(sg-isam2 --min-obs 2 -f variables --no-header bearing.g2o | tr '\n' ' ')" = "1 3 " ]
  sg-isam2 --min-obs 2 -o end.g2o bearing.g2o > /dev/null
  near "$(awk '$1 == "VERTEX_XY" {print $3}' end.g2o)" 1 0.005
  near "$(awk '$1 == "VERTEX_XY" {print $4}' end.g2o)" 1 0.005
}

@test "usage errors" {
  run -2 sg-isam2 -m nonsense "$TESTDATA/walk.g2o"
  run -2 sg-isam2 --every 0 "$TESTDATA/walk.g2o"
  run -2 sg-isam2 --init elsewhere "$TESTDATA/walk.g2o"
}

@test "intel: within 1 % of the optimum" {
  need_data
  chi2=$(sg-isam2 -f chi2 --no-header --every 10000 "$SGTOOLS_DATA/intel.g2o" | tail -n 1)
  awk -v chi2="$chi2" 'BEGIN { exit !(chi2 < 45.004696 * 1.01 && chi2 >= 45.0046) }'
}

@test "iterations that leave the range of their measurements diverge, which is not being undetermined" {
  sg-gen sine -n 6 --sensor disparity --noise-guess 100 > wild.g2o
  fails 3 "sg-isam2: step 3: the iterations diverge: the estimate has left the range in which its measurements determine it; \
start elsewhere (--init), or solve it in batch (sg-solve)" sg-isam2 --init file wild.g2o
}

@test "seconds are exact under a limit of processor time, too" {
  # Linux counts the time of a process that has one in ticks of milliseconds: most steps would take none.
  chain 50 >chain.g2o
  (ulimit -t 3600; sg-isam2 -f update_s --no-header chain.g2o) >seconds
  [ "$(awk '$1 > 0' seconds | wc -l)" = 50 ]
}
