# What options and types do that no other test asks for.
load ../common

setup() { cd "$BATS_TEST_TMPDIR"; }

@test "a city may be seen by bearings" {
  sg-gen city -n 40 --sensor bearing > bearing.g2o
  [ "$(grep -c ^EDGE_BEARING_SE2_XY bearing.g2o)" -gt 0 ]
  [ "$(grep -c ^EDGE_SE2_XY bearing.g2o)" = 0 ]
}

@test "pixels of a stereo camera whose focal lengths differ" {
  # Camera at the origin; (1, 2, 4) with fx 100, fy 200, cx 3, cy 4, baseline times fx 8: u = 28, v = 104, u right = 26.
  printf '%s\n' 'VERTEX_SE3:EXPMAP 0 0 0 0 0 0 0 1' 'VERTEX_XYZ 1 1 2 4' \
    'EDGE_STEREO_SE3_PROJECT_XYZ:EXPMAP 1 0 28 104 26 1 0 0 1 0 1 100 200 3 4 8' > stereo.g2o
  near "$(sg-solve --chi2 stereo.g2o)" 0
  printf '%s\n' 'VERTEX_SE3:EXPMAP 0 0 0 0 0 0 0 1' 'VERTEX_XYZ 1 1 2 4' \
    'EDGE_SE3_PROJECT_XYZ:EXPMAP 1 0 28 104 1 0 1 100 200 3 4' > mono.g2o
  near "$(sg-solve --chi2 mono.g2o)" 0
}

@test "a prior has no part in spanning trees, however they are weighed" {
  printf 'EDGE_SE2 %s 1 0 0 4 0 0 4 0 9\n' "0 1" "1 2" "0 2" > ring.g2o
  (cat ring.g2o; echo 'EDGE_PRIOR_SE2 0 0 0 0 7 0 0 7 0 7') > prior.g2o
  for weights in unit translation rotation dopt; do
    near "$(sg-score --weights $weights --no-header -f log_trees prior.g2o)" "$(sg-score --weights $weights --no-header -f log_trees ring.g2o)"
  done
}

@test "an offset that the file does not have goes into no iSAM file" {
  printf 'EDGE_SE3_TRACKXYZ 0 1 7 1 1 1 1 0 0 1 0 1\n' > offset.g2o
  fails 1 "sg-convert: offset.g2o:1: isam cannot hold EDGE_SE3_TRACKXYZ (1 line; --lossy leaves them out)" sg-convert --to isam offset.g2o
}
