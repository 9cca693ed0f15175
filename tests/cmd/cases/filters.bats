# What sg-check finds, and what filters must not do to a graph.
load ../common

setup() {
  cd "$BATS_TEST_TMPDIR"
  cp "$BATS_TEST_DIRNAME"/data/* .
}

# finds STATUS TEXT: sg-check of the graph on standard input ends so, and TEXT is one of its lines.
finds() {
  run -"$1" --separate-stderr sg-check
  grep -qxF "<stdin>:$2" <<< "$output"
}

pose='VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_SE2 2 2 0 0\nEDGE_SE2 0 1 1 0 0 100 0 0 100 0 400\nEDGE_SE2 1 2 1 0 0 100 0 0 100 0 400\n'

@test "information that is zero is told, with what hangs on it" {
  run -0 sg-check 03-zero-info-odom.g2o
  [ "$output" = "03-zero-info-odom.g2o:6: warning: the information of EDGE_SE2 is zero: it ties nothing, and vertex 2 has no other edge" ]
  printf "${pose}EDGE_SE2 0 2 2 0 0 0 0 0 0 0 0\n" | finds 0 "6: warning: the information of EDGE_SE2 is zero: it ties nothing"
  printf "${pose}VERTEX_XY 9 1 1\nEDGE_SE2_XY 0 9 1 1 0 0 0\n" |
    finds 0 "7: warning: the information of EDGE_SE2_XY is zero: it ties nothing, and vertex 9 has no other edge"
  printf 'EDGE3 0 1 1 0 0 0 0 0%s\n' "$(printf ' 0%.0s' {1..21})" | sg-check --from toro 2> said > out
  grep -q "it ties nothing, and vertex 0 and vertex 1 has no other edge" out
}

@test "parameters that are not there, of another kind, or given twice" {
  run -1 sg-check 07-se3prior-id-twice.g2o
  [ "${lines[0]}" = "07-se3prior-id-twice.g2o:4: error: EDGE_SE3_PRIOR wants a PARAMS_SE3OFFSET line with the id 1, and there is none" ]
  run -1 sg-check 94-params-twice.g2o
  [ "$output" = "94-params-twice.g2o:3: error: parameter 0 is given a second time: the first holds (line 2)" ]
  near "$(sg-solve --chi2 94-params-twice.g2o)" 0
  printf 'PARAMS_SE2OFFSET 0 0 0 0\nVERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_TRACKXYZ 1 1 0 0\nEDGE_SE3_TRACKXYZ 0 1 0 1 0 0 1 0 0 1 0 1\n' |
    finds 1 "4: error: EDGE_SE3_TRACKXYZ wants a PARAMS_SE3OFFSET line with the id 0, which is another kind"
  # A camera has an offset.
  printf 'PARAMS_CAMERACALIB 0 0 0 0 0 0 0 1 9 9 9 9\nVERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_TRACKXYZ 1 1 0 0\nEDGE_SE3_TRACKXYZ 0 1 0 1 0 0 1 0 0 1 0 1\n' > camera.g2o
  run -0 sg-check camera.g2o
  [ -z "$output" ]
}

@test "lines ahead of what they name" {
  run -0 sg-check 19-edges-first.g2o
  [ "$output" = "19-edges-first.g2o:2: warning: EDGE_SE3_TRACKXYZ stands ahead of vertex 7: g2o drops it; put VERTEX and PARAMS lines first (and so with 2 more)" ]
  run -1 sg-check --for g2o 19-edges-first.g2o
  run -0 sg-check --for gtsam 96-interleaved.g2o
  printf "FIX 2\n$pose" | finds 0 "1: warning: FIX stands ahead of vertex 2: g2o drops it; put VERTEX and PARAMS lines first"
  printf 'VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_TRACKXYZ 1 1 0 0\nEDGE_SE3_TRACKXYZ 0 1 0 1 0 0 1 0 0 1 0 1\nPARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\n' |
    finds 0 "3: warning: EDGE_SE3_TRACKXYZ stands ahead of parameter 0: g2o drops it; put VERTEX and PARAMS lines first"
}

@test "numbers past the end of a line" {
  run -0 sg-check 90-full-matrix-psd.g2o
  [ "$output" = "90-full-matrix-psd.g2o:4: warning: three numbers too many (EDGE_SE2 has 9): a whole matrix where its upper triangle belongs is read wrongly" ]
  printf "VERTEX_SE2 7 0 0 0 1\n$pose" | finds 0 "1: warning: one number too many (VERTEX_SE2 has 3)"
  printf "PARAMS_SE2OFFSET 7 0 0 0 1 1\n$pose" | finds 0 "1: warning: two numbers too many (PARAMS_SE2OFFSET has 3)"
}

@test "a vertex of the wrong kind, ids that others cannot load" {
  run -1 sg-check 93-landmark-order.g2o
  [ "$output" = "93-landmark-order.g2o:6: error: EDGE_SE2_XY joins vertex 5, a VERTEX_XY, where it wants a VERTEX_SE2" ]
  printf 'VERTEX_SE2 2147483647 0 0 0\nVERTEX_SE2 2147483648 0 0 0\nEDGE_SE2 2147483647 2147483648 1 0 0 1 0 0 1 0 1\n' > large.g2o
  run -0 sg-check large.g2o
  [ "$output" = "large.g2o:2: warning: id 2147483648 is above 2^31 - 1: g2o cannot load it; number the vertices anew" ]
  run -1 sg-check --for g2o large.g2o
  run -0 sg-check --for gtsam large.g2o
  [ -z "$output" ]
}

@test "what a program cannot take, by --for" {
  printf "${pose}FIX 0\n" > good.g2o
  run -0 sg-check --for g2o good.g2o
  [ -z "$output" ]
  run -0 sg-check --for gtsam good.g2o
  [ "$output" = "good.g2o:6: warning: GTSAM knows no FIX line: nothing is held" ]
  printf "${pose}EDGE_SE2 1 0 -1 0 0 100 0 0 100 0 400\n" > twice.g2o
  run -0 sg-check twice.g2o
  run -1 sg-check --for toro twice.g2o
  [ "$output" = "twice.g2o:6: error: a second edge between vertices 0 and 1: TORO takes one" ]
  grep EDGE twice.g2o > edges.g2o
  run -1 sg-check --for g2o edges.g2o
  [ "$output" = "edges.g2o: error: there is no VERTEX line: g2o drops every edge (sg-convert --estimates adds them)" ]
  run -1 sg-check --for gtsam 09-rtabmap-3d-export.g2o
  [[ $output == *"error: GTSAM's readG2o does not read EDGE_SE3_TRACKXYZ"* ]]
  run -2 sg-check --for ceres good.g2o
}

@test "JSON: a finding an object" {
  run -1 sg-check --json 07-se3prior-id-twice.g2o
  [ "${lines[0]}" = '{"file": "07-se3prior-id-twice.g2o", "line": 4, "severity": "error", "cause": "EDGE_SE3_PRIOR wants a PARAMS_SE3OFFSET line with the id 1, and there is none"}' ]
}

@test "landmarks that parallel rays leave undetermined" {
  # Two bearings along the x axis, to a landmark on it.
  printf "${pose}VERTEX_XY 9 5 0\nEDGE_BEARING_SE2_XY 0 9 0 100\nEDGE_BEARING_SE2_XY 1 9 0 100\n" |
    finds 1 "6: error: vertex 9 (VERTEX_XY) is not determined where it stands: its observations agree along a line"
  printf "${pose}VERTEX_XY 9 5 0.00002\nEDGE_BEARING_SE2_XY 0 9 0 100\nEDGE_BEARING_SE2_XY 1 9 0 100\n" |
    finds 0 "6: warning: vertex 9 (VERTEX_XY) is not determined where it stands: its observations agree along a line"
  printf "${pose}VERTEX_XY 9 5 3\nEDGE_BEARING_SE2_XY 0 9 0.54 100\nEDGE_BEARING_SE2_XY 1 9 0.64 100\n" > sound.g2o
  run -0 sg-check sound.g2o
  [ -z "$output" ]
}

@test "information that differs by many orders of magnitude, and closures that odometry contradicts" {
  printf "${pose}EDGE_SE2 0 2 2 0 0 1e16 0 0 1e16 0 1e16\n" |
    finds 0 "6: warning: the information of this EDGE_SE2 is 10^13 times that of line 4: solvers lose their digits"
  printf "${pose}EDGE_SE2 0 2 9 0 0 100 0 0 100 0 400\n" > far.g2o
  run -0 sg-check far.g2o
  [[ $output == "far.g2o:6: warning: the odometry between disagrees with this loop closure by "*" standard deviations: one of them, or its information, is wrong" ]]
  printf "${pose}EDGE_SE2 2 0 -2.2 0 0 100 0 0 100 0 400\n" > near.g2o
  run -0 sg-check near.g2o
  [ -z "$output" ]
  sg-gen sphere | awk '$1 == "EDGE_SE3:QUAT" && $3 - $2 > 5 && !n++ {$4 += 10} 1' > sphere.g2o
  run -0 sg-check sphere.g2o
  [[ $output == *"disagrees with this loop closure by "* ]]
  for world in sine "sine --dim 2 --sensor bearing" manhattan sphere torus grid3d city; do sg-gen $world | sg-check > out; done
  [ ! -s out ]
}

@test "sg-order loses nothing to a reader in one pass" {
  for file in 96-interleaved.g2o 19-edges-first.g2o 98-fix-landmark-only.g2o; do
    for method in colamd id wmf; do
      sg-order -m $method $file > out.g2o
      awk '/^VERTEX/ {known[$2] = 1}
        /^FIX/ && !known[$2] || /^EDGE/ && !(known[$2] && known[$3]) {print; bad = 1}
        END {exit bad}' out.g2o
      [ "$(sort out.g2o | grep -v '^#')" = "$(grep -v '^#' $file | sort)" ]
    done
  done
}

@test "an order is no longer one when the graph has changed" {
  sg-gen city -n 200 > city.g2o
  for filter in "sg-dec -r 4" "sg-rand -r 2" "sg-kf -r 2" "sg-tgreedy -r 2" "sg-cut --poses 100"; do
    sg-order -m amd city.g2o | $filter > after.g2o
    $filter city.g2o > fresh.g2o
    [ "$(sg-ec --no-header -f order,ec after.g2o)" = "$(sg-ec --no-header -m colamd -f order,ec fresh.g2o)" ]
    grep -qx "# sg-order: amd, until ${filter%% *} changed the graph" after.g2o
    [ "$(sg-ec --no-header -m file -f ec after.g2o)" -gt 0 ]
    [ "$(sg-order -m wmf after.g2o | sg-ec --no-header -f order)" = file:wmf ]
  done
  # What changes no structure keeps the order, and a second filter says no more.
  [ "$(sg-order -m amd city.g2o | sg-solve -q | sg-ec --no-header -f order)" = file:amd ]
  [ "$(sg-order -m amd city.g2o | sg-dec -r 1 | sg-ec --no-header -f order)" = file:amd ]
  [ "$(sg-order -m amd city.g2o | sg-dec -r 2 --no-trace-comment | sg-rand -r 2 | grep -c 'until sg-dec changed the graph$')" = 1 ]
}

@test "a policy that removes nothing says so" {
  local teach=(--vertex VERTEX_SWITCH:1:other --edge EDGE_SWITCH_PRIOR:1 --edge EDGE_SE2_SWITCHABLE:3)
  run -0 --separate-stderr sg-rand -r 2 --candidates loops "${teach[@]}" 12-vertigo-switchable.g2o
  [ "$stderr" = "sg-rand: 12-vertigo-switchable.g2o: there was nothing to prune: no loop closures among its edges (odometry, and what joins other vertices than poses and landmarks, never goes)" ]
  run -0 --separate-stderr sg-dec -r 3 71-odometry-only-2d.g2o
  [[ $stderr == *": there was nothing to prune: no loop closures among its edges"* ]]
  run -0 --separate-stderr sg-tgreedy -k 5 98-fix-landmark-only.g2o
  [[ $stderr == *": nothing was pruned: all "*" observations of landmarks stay" ]]
  run -0 --separate-stderr sg-kf -r 2 98-fix-landmark-only.g2o
  run -0 --separate-stderr sg-dec -r 1 71-odometry-only-2d.g2o
  [ -z "$stderr" ]
}

@test "decimation decimates closures, too" {
  sg-gen manhattan -n 1000 --seed 3 > m.g2o
  loops() { sg-info "$1" | awk '$1 == "loop_closures" {print $2}'; }
  for r in 2 4; do
    sg-dec -r $r m.g2o > dec.g2o
    near "$(loops dec.g2o)" "$(awk -v n="$(loops m.g2o)" -v r=$r 'BEGIN {print n / r}')" 0.15
  done
}

@test "a prediction is printed where its assumptions are near" {
  sg-gen manhattan -n 100 > m.g2o
  run -0 --separate-stderr sg-predict -r 2 --no-header m.g2o
  [ "$output" = "$(printf '2\t\t\t')" ]
  [ "$stderr" = "sg-predict: m.g2o: no prediction: the closed forms are of graphs in which every pose sees every landmark, and here there is none" ]
  sg-gen city -n 1000 > c.g2o
  run -0 --separate-stderr sg-predict -r 2 c.g2o
  [[ $stderr == *"and here a landmark is seen from "*" % of the poses, where they want 5 %" ]]
  run -0 --separate-stderr sg-predict -r 4 <(sg-gen sine)
  [ -z "$stderr" ]
}

@test "a reference of another kind is told" {
  printf 'VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\n' > plane.g2o
  printf 'VERTEX_SE3:QUAT 0 0 0 1 0 0 0 1\nVERTEX_SE3:QUAT 1 1 0 2 0 0 0 1\n' > space.g2o
  run -0 --separate-stderr sg-score --reference space.g2o -f ate_rmse plane.g2o
  [ "$stderr" = "sg-score: plane.g2o and space.g2o: one is planar, the other is not; errors are taken in space" ]
  sg-convert --to tum plane.g2o > plane.tum
  run -0 --separate-stderr sg-score --reference plane.tum -f ate_rmse plane.g2o
  [ -z "$stderr" ]
  printf 'VERTEX_SE2 7 0 0 0\n' > other.g2o
  run -0 --separate-stderr sg-score --reference other.g2o -f matched plane.g2o
  [ "$stderr" = "sg-score: plane.g2o and other.g2o have no pose in common (poses are matched by id)" ]
}
