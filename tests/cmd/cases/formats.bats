# Files of other programs: read as those programs read them, or refused with the line and by name; and what is written can
# be read back.
load ../common

setup() {
  cd "$BATS_TEST_TMPDIR"
  cp "$BATS_TEST_DIRNAME"/data/* .
}

# fact NAME CALL...: that line of sg-info.
fact() {
  local name=$1
  shift
  sg-info "$@" | awk -v name="$name" '$1 == name {print $2}'
}

@test "ids above 2^53 come back from a trajectory that we wrote" {
  sg-convert --to tum 04-gtsam-labeled-ids.g2o > t.tum
  [ "$(sg-score --reference t.tum -f matched --no-header 04-gtsam-labeled-ids.g2o)" = 5 ]
  printf '9223372036854775807 1 2 3 0 0 0 1\n' > last.tum
  [ "$(fact id_max last.tum)" = 9223372036854775807 ]
  printf '9223372036854775808 1 2 3 0 0 0 1\n' > above.tum
  fails 1 "sg-info: above.tum:1: a time that is no vertex id: poses are matched by id" sg-info above.tum
}

@test "an id of 64 bits is refused by its limit" {
  fails 1 "sg-info: 05-gtsam-id-beyond-2-63.g2o:2: '18374686479671623680' is above 2^63 - 1, too large for a vertex id" \
    sg-info 05-gtsam-id-beyond-2-63.g2o
  printf 'ODOMETRY 0 99999999999999999999 1 0 0 1 0 0 1 0 1\n' > big.isam
  fails 1 "sg-ec: big.isam:1: '99999999999999999999' is above 2^63 - 1, too large for a pose id" sg-ec big.isam
  printf 'VERTEX2 18446744073709551615 1 0 0\n' > big.toro
  fails 1 "sg-ec: big.toro:1: '18446744073709551615' is above 2^63 - 1, too large for a vertex id" sg-ec big.toro
}

@test "--skip-unknown leaves out what nobody knows, counts it, and does not write it" {
  run -0 --separate-stderr sg-solve --skip-unknown 14-hdl-graph-slam-dump.g2o -o solved.g2o
  [ "$stderr" = "sg-solve: 14-hdl-graph-slam-dump.g2o: left out 1 VERTEX_PLANE, 2 EDGE_SE3_PLANE, 1 EDGE_SE3_PRIORXY, 1 EDGE_SE3_PRIORXYZ, 1 EDGE_SE3_PRIORQUAT, 1 EDGE_SE3_PRIORVEC" ]
  run -1 grep -q "PLANE\|PRIOR\|FIX 2" solved.g2o
  run -0 --separate-stderr sg-check solved.g2o
  near "$(grep -v 'PLANE\|PRIOR\|FIX 2' 14-hdl-graph-slam-dump.g2o | sg-solve | sg-solve --chi2)" "$(sg-solve --chi2 solved.g2o)"
  # Switches, and the edges at them; from a pipe; -q says nothing.
  run -0 --separate-stderr sg-ec --skip-unknown -f vertices,edges --no-header 12-vertigo-switchable.g2o
  [ "$output" = "$(printf '4\t3')" ]
  [ "$stderr" = "sg-ec: 12-vertigo-switchable.g2o: left out 2 VERTEX_SWITCH, 2 EDGE_SWITCH_PRIOR, 2 EDGE_SE2_SWITCHABLE" ]
  run -0 sg-dec -q -r 2 --skip-unknown -o out.g2o < 12-vertigo-switchable.g2o
  [ -z "$output" ]
  run -1 grep -q SWITCH out.g2o
  # An edge of a known type goes with the vertex that it joins; a FIX line keeps its other ids.
  printf 'VERTEX_SE2 0 0 0 0\nVERTEX_NEW 7 1\nVERTEX_SE2 1 1 0 0\nFIX 7 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 0 7 1 0 0 1 0 0 1 0 1\n' > new.g2o
  run -0 --separate-stderr sg-convert --skip-unknown new.g2o
  [ "$output" = "$(printf 'VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nFIX 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1')" ]
  [ "$stderr" = "sg-convert: new.g2o: left out 1 VERTEX_NEW, 1 EDGE_SE2" ]
  # Known to the registry, but without a model: the solver leaves it out, orderings need not.
  printf 'VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_PLANE 1 0 0 1 0\nVERTEX_PLANE 2 0 0 1 0\nEDGE_PLANE 1 2 0 0 0 1\n' > plane.g2o
  run -1 sg-solve plane.g2o
  run -0 --separate-stderr sg-solve --skip-unknown plane.g2o
  [ "$stderr" = "sg-solve: plane.g2o: left out 2 VERTEX_PLANE, 1 EDGE_PLANE" ]
  [ "$(sg-ec --skip-unknown -f edges --no-header plane.g2o)" = 1 ]
}

@test "--alias reads one tag as another" {
  local aliases=(--alias TUTORIAL_PARAMS_SE2_OFFSET=PARAMS_SE2OFFSET --alias TUTORIAL_VERTEX_SE2=VERTEX_SE2
    --alias TUTORIAL_VERTEX_POINT_XY=VERTEX_XY --alias TUTORIAL_EDGE_SE2=EDGE_SE2
    --alias TUTORIAL_EDGE_SE2_POINT_XY=EDGE_SE2_POINTXY_OFFSET)
  sed 's/TUTORIAL_PARAMS_SE2_OFFSET/PARAMS_SE2OFFSET/; s/TUTORIAL_VERTEX_POINT_XY/VERTEX_XY/
       s/TUTORIAL_EDGE_SE2_POINT_XY/EDGE_SE2_POINTXY_OFFSET/; s/TUTORIAL_//' 27-tutorial-tags.g2o > known.g2o
  [ "$(sg-ec -f ec --no-header "${aliases[@]}" 27-tutorial-tags.g2o)" = "$(sg-ec -f ec --no-header known.g2o)" ]
  run -0 sg-ec -f ec --no-header --params TUTORIAL_PARAMS_SE2_OFFSET --vertex TUTORIAL_VERTEX_SE2:3:pose \
    --vertex TUTORIAL_VERTEX_POINT_XY:2:landmark --edge TUTORIAL_EDGE_SE2:2 --edge TUTORIAL_EDGE_SE2_POINT_XY:2 27-tutorial-tags.g2o
  [ "$output" = 77 ]
  [ "$(sg-order --no-trace-comment "${aliases[@]}" 27-tutorial-tags.g2o | sed 's/.*_VERTEX/VERTEX/' | grep -c VERTEX)" = 3 ]
  fails 2 "sg-ec: --alias X=NOBODY: nobody knows NOBODY (see sg-ec --help)" sg-ec --alias X=NOBODY known.g2o
  fails 2 "sg-ec: --alias EDGE_SE2=EDGE_SE2_XY: EDGE_SE2 is known already, as an edge of 2 vertices (see sg-ec --help)" \
    sg-ec --alias EDGE_SE2=EDGE_SE2_XY known.g2o
  fails 2 "sg-ec: --alias wants TAG=TAG, a new one and one that is known, not 'X' (see sg-ec --help)" sg-ec --alias X known.g2o
}

@test "TORO's own older tags, EQUIV, and an edge without information" {
  [ "$(fact format --from toro 32-old-toro-tags.graph)" = toro ]
  [ "$(fact format 32-old-toro-tags.graph)" = toro ]
  [ "$(sg-convert 32-old-toro-tags.graph | tail -n 1)" = "EDGE_SE2 0 1 1 0 0 100 0 0 100 0 400" ]
  [ "$(sg-convert --from toro 84-toro-edge3-no-info.graph | grep -c '^EDGE_SE3:QUAT .* 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4$')" = 3 ]
  # Some of them is no information.
  sed 's/^EDGE3.*/& 1 0 0/' 84-toro-edge3-no-info.graph > some.graph
  fails 1 "sg-info: some.graph:5: the line ends before its last number" sg-info some.graph
  (cat 32-old-toro-tags.graph; echo "EQUIV 0 1") > equiv.graph
  [ "$(sg-convert equiv.graph | tail -n 1)" = "# EQUIV 0 1" ]
  echo "EQUIV 0" >> equiv.graph
  fails 1 "sg-ec: equiv.graph:6: the line ends before a vertex id" sg-ec equiv.graph
}

@test "iSAM's Constraint2 and SOLVE, and edges without information where its loader allows it" {
  [ "$(fact edges --from isam 87-isam-keywords.isam)" = 2 ]
  [ "$(sg-convert 87-isam-keywords.isam | sed -n 2p)" = "EDGE_SE2 0 1 1 0 0 100 0 0 100 0 400" ]
  printf 'EDGE3 0 1 1 0 0 0 0 0\nPOINT3 1 0 1 2 3\nPOSE3D_INIT 0 0 0 0 0 0 0\nEDGE3_TRUE 0 1 1 0 0 0 0 0\nSOLVE\n' > bare.isam
  [ "$(fact edges bare.isam)" = 2 ]
  [ "$(sg-convert bare.isam | sed -n 1p)" = "EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4" ]
  [ "$(sg-convert bare.isam | sed -n 2p)" = "EDGE_SE3_TRACKXYZ 1 2 0 1 2 3 1 0 0 1 0 1" ]
  printf 'ODOMETRY 0 1 1 0 0\n' > bare2.isam
  fails 1 "sg-info: bare2.isam:1: the line ends before its last number" sg-info bare2.isam
}

@test "EDGE2 and EDGE3 alone are TORO's or iSAM's: the choice is told where it matters" {
  printf 'EDGE2 0 1 1 0 0 100 0 100 400 0 0\nEDGE2 1 2 1 0 0 100 0 100 400 0 0\n' > toro.graph
  run -0 --separate-stderr sg-convert toro.graph
  [ "${lines[0]}" = "EDGE_SE2 0 1 1 0 0 100 0 0 100 0 400" ]
  [ "$stderr" = "sg-convert: toro.graph: EDGE2 and EDGE3 are TORO's and iSAM's: read as toro (--from isam for the other)" ]
  printf 'EDGE2 0 1 1 0 0 10 0 0 10 0 20\n' > isam.graph
  run -0 --separate-stderr sg-convert isam.graph
  [ "${lines[0]}" = "EDGE_SE2 0 1 1 0 0 100 0 0 100 0 400" ]
  [ "$stderr" = "sg-convert: isam.graph: EDGE2 and EDGE3 are TORO's and iSAM's: read as isam (--from toro for the other)" ]
  run -0 --separate-stderr sg-convert --from isam isam.graph
  [ -z "$stderr" ]
  # Of information 1 both say the same.
  printf 'EDGE3 0 1 1 0 0 0 0 0\nEDGE3 1 2 1 0 0 0 0 0\n' > same.graph
  run -0 --separate-stderr sg-ec same.graph
  [ -z "$stderr" ]
}

@test "what goes to TORO from edges alone comes back as TORO's, with the same chi-square" {
  printf 'EDGE_SE2 0 1 1 0 0.1 100 1 2 100 3 400\nEDGE_SE2 1 2 1 0 0.1 100 0 0 100 0 400\nEDGE_SE2 0 2 2 0.3 0.3 100 0 0 100 0 400\n' > edges.g2o
  run -0 --separate-stderr sg-convert --to toro edges.g2o -o edges.toro
  [ -z "$stderr" ]
  [ "$(fact format edges.toro)" = toro ]
  near "$(sg-solve --chi2 edges.toro)" "$(sg-solve --chi2 edges.g2o)"
  near "$(sg-convert --to toro 87-isam-keywords.isam | sg-solve --chi2)" "$(sg-solve --chi2 87-isam-keywords.isam)"
  need_data
  near "$(sg-convert --to toro "$SGTOOLS_DATA/CSAIL.g2o" | sg-solve --chi2)" "$(sg-solve --chi2 "$SGTOOLS_DATA/CSAIL.g2o")"
}

@test "a quaternion of length zero goes into no file" {
  fails 1 "sg-convert: 36-zero-quaternion.g2o:2: a quaternion has length zero" sg-convert --to tum 36-zero-quaternion.g2o
  fails 1 "sg-convert: 36-zero-quaternion.g2o:2: a quaternion has length zero" sg-convert --to toro 36-zero-quaternion.g2o
  printf 'EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4\n' > edge.g2o
  fails 1 "sg-convert: edge.g2o:1: a quaternion has length zero" sg-convert --to isam edge.g2o
  printf '1 0 0 0 0 0 0 0\n' > zero.tum
  fails 1 "sg-plot: zero.tum:1: a quaternion has length zero" sg-plot map -o out.svg zero.tum
}

@test "a number that is not finite goes into no file" {
  for number in nan inf -inf 1e999 "-nan(ind)"; do
    printf 'VERTEX_SE2 0 0 %s 0\n' "$number" > bad.g2o
    run -1 sg-convert --to tum bad.g2o
    [[ $output == "sg-convert: bad.g2o:1: "* ]]
    run -1 sg-convert --to toro bad.g2o
    [[ $output == "sg-convert: bad.g2o:1: "* ]]
    printf 'ODOMETRY 0 1 1 0 0 1 0 0 1 0 %s\n' "$number" > bad.isam
    run -1 sg-convert bad.isam
    [[ $output == "sg-convert: bad.isam:1: "* ]]
  done
}

@test "information without a square root is not written as one" {
  fails 1 "sg-convert: 53-indefinite-info.g2o:4: the information matrix is not positive semidefinite: it has no square root" \
    sg-convert --to isam 53-indefinite-info.g2o
  # Of an observation, and in space. Singular information has one.
  printf 'EDGE_SE2_XY 0 1 1 0 1 2 1\n' > xy.g2o
  run -1 sg-convert --to isam xy.g2o
  [[ $output == "sg-convert: xy.g2o:1: the information matrix is not positive semidefinite"* ]]
  printf 'EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 -1 0 0 0 4 0 0 4 0 4\n' > space.g2o
  run -1 sg-convert --to isam space.g2o
  [[ $output == "sg-convert: space.g2o:1: the information matrix is not positive semidefinite"* ]]
  printf 'EDGE_SE2 0 1 1 0 0 1 1 0 1 0 0\n' > singular.g2o
  run -0 sg-convert --to isam singular.g2o
}

@test "a landmark where a pose belongs, and one that iSAM would number otherwise" {
  run -1 --separate-stderr sg-convert --to isam 93-landmark-order.g2o
  [ "$stderr" = "sg-convert: 93-landmark-order.g2o:6: EDGE_SE2_XY joins vertex 5, a VERTEX_XY, where it wants a VERTEX_SE2" ]
  [ -z "$output" ]
  printf 'VERTEX_SE2 0 0 0 0\nVERTEX_XY 1 1 1\nVERTEX_SE2 2 1 0 0\nEDGE_SE2 0 2 1 0 0 1 0 0 1 0 1\nEDGE_SE2_XY 0 1 1 1 1 0 1\n' > below.g2o
  fails 1 "sg-convert: below.g2o:2: isam cannot hold the id of a landmark below a pose's (1 line; --lossy leaves them out)" \
    sg-convert --to isam below.g2o
  run -0 --separate-stderr sg-convert --to isam --lossy below.g2o
  [ "${lines[1]}" = "LANDMARK 0 1 1 1 1 0 1" ]
  # What is left stands by itself, estimates and FIX lines included.
  (cat below.g2o; printf 'VERTEX_XY 9 1 1\nFIX 0 9\n') | sg-convert --to isam --lossy > left.isam
  [ "$(sg-ec -f vertices,dim --no-header left.isam)" = "3	8" ]
  (grep -v XY below.g2o; printf 'VERTEX_XY 9 1 1\nFIX 0 9\n') | sg-convert --to isam --lossy > fixed.isam
  [ "$(sg-ec -f vertices,dim --no-header fixed.isam)" = "2	3" ]
  printf 'VERTEX_XY 0 0 0\nVERTEX_SE2 1 1 0 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n' > swapped.g2o
  run -1 sg-convert --to toro swapped.g2o --lossy
  [[ $output == *"swapped.g2o:3: EDGE_SE2 joins vertex 0, a VERTEX_XY, where it wants a VERTEX_SE2"* ]]
}

@test "KITTI poses are a trajectory" {
  [ "$(fact format 58-kitti-poses.txt)" = kitti ]
  printf 'VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1 1 0 0 0 0 0 1\n' > same.g2o
  run -0 sg-score --reference 58-kitti-poses.txt --align none -f matched,ate_rmse --no-header same.g2o
  [ "$output" = "$(printf '2\t0')" ]
  [ "$(sg-convert --to tum 58-kitti-poses.txt | tail -n 1)" = "1 1 0 0 0 0 0 1" ]
  fails 1 "sg-info: 58-kitti-poses.txt:2: '0' stands where the line should end" sg-info --from tum 58-kitti-poses.txt
  printf '1 0 0 0 0 1 0 0 0 0 2 0\n' > stretched.txt
  fails 1 "sg-info: stretched.txt:1: numbers 1-3, 5-7 and 9-11 of a KITTI pose are no rotation matrix" sg-info stretched.txt
}

@test "--from that no line agrees with is a wrong call" {
  fails 2 "sg-info: --from toro: no line of the input is of that format (it looks like g2o) (see sg-info --help)" \
    sg-info --from toro 09-rtabmap-3d-export.g2o
  fails 2 "sg-ec: --from isam: no line of the input is of that format (it looks like kitti) (see sg-ec --help)" \
    sg-ec --from isam 58-kitti-poses.txt
  fails 2 "sg-ec: --from tum: no line of the input is of that format (it looks like isam) (see sg-ec --help)" \
    sg-ec --from tum 87-isam-keywords.isam
  fails 2 "sg-ec: no format 'torro': did you mean toro? There are toro, isam, tum, kitti, bal, g2o (see sg-ec --help)" sg-ec --from torro 87-isam-keywords.isam
}

@test "compressed by any of four, whole or cut short" {
  gzip -k 09-rtabmap-3d-export.g2o
  bzip2 -k 09-rtabmap-3d-export.g2o
  xz -k 09-rtabmap-3d-export.g2o
  zstd -q 09-rtabmap-3d-export.g2o
  for end in gz bz2 xz zst; do
    [ "$(sg-convert "09-rtabmap-3d-export.g2o.$end")" = "$(cat 09-rtabmap-3d-export.g2o)" ]
    [ "$(sg-convert < "09-rtabmap-3d-export.g2o.$end")" = "$(cat 09-rtabmap-3d-export.g2o)" ]
    head -c 100 "09-rtabmap-3d-export.g2o.$end" > cut
    run -1 sg-info cut
    [[ $output == "sg-info: cut: the compressed data is damaged"* ]]
  done
}

@test "what is no graph's text is named" {
  printf '<!DOCTYPE html>\n<html>404</html>\n' > page.g2o
  fails 1 "sg-ec: page.g2o:1: this is HTML or XML, perhaps the page of an error, not a graph's text" sg-ec page.g2o
  printf 'SQLite format 3\0abc' > rtabmap.db
  fails 1 "sg-ec: rtabmap.db:1: this is an SQLite database, not a graph's text: export the graph from it" sg-ec rtabmap.db
  printf 'PK\003\004abc' > graph.zip
  fails 1 "sg-ec: graph.zip:1: this is a ZIP archive: unpack it" sg-ec graph.zip
  printf '#ROSBAG V2.0\n' > x.bag
  fails 1 "sg-ec: x.bag:1: this is a ROS bag, not a graph's text" sg-ec x.bag
  printf 'VERTEX\0\001' > binary
  fails 1 "sg-ec: binary:1: this is binary data, not a graph's text" sg-ec binary
  printf '\357\273\277VERTEX_SE2 0 0 0 0\n' | sg-info > /dev/null
  [ "$(fact vertices 81-bom.g2o)" -gt 0 ]
}
