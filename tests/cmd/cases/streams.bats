load ../common

# Iterations that leave where the measurements hold them.

setup() { cd "$BATS_TEST_TMPDIR"; }

# chain POSES: seen from 5 m beside its line, so that the bearing of a landmark sends Gauss-Newton away: the tangent's step
# from y is -(1 + y^2) atan y.
chain() {
  awk -v n="$1" 'BEGIN {
    print "VERTEX_XY 100 1 0\nFIX 100"
    for (k = 0; k < n; ++k) print "VERTEX_SE2", k, k, 5, 0
    print "EDGE_PRIOR_SE2 0 0 0 0 1e6 0 0 0 0 1e6\nEDGE_BEARING_SE2_XY 0 100 0 1"
    for (k = 1; k < n; ++k) print "EDGE_SE2", k - 1, k, "1 0 0 100 0 0 100 0 100" }'
}

@test "iterations that diverge are told from what is undetermined and what is ill-conditioned" {
  for poses in 2 5 25; do
    chain "$poses" >away.g2o
    run -3 --separate-stderr sg-solve --gn --start file away.g2o
    [ -z "$output" ]
    [ "${#stderr_lines[@]}" = 1 ]
    [[ $stderr == "sg-solve: the iterations diverge: chi-square 2.4674"*", from 1.8862"*"; start elsewhere (--start), or leave out --gn" ]]
    # Damped, or from elsewhere, it gets there.
    for call in "--start file" --gn; do
      run -0 sg-solve $call away.g2o -o solved.g2o
      near "$(sg-solve --chi2 solved.g2o)" 0
    done
  done
  # A pose that nothing measures is no question of the start.
  { cat away.g2o; echo "VERTEX_SE2 900 0 0 0"; } >open.g2o
  fails 3 "sg-solve: the system is singular: the measurements leave vertex 900 undetermined; add edges or FIX lines, or leave it out" \
    sg-solve --gn open.g2o
}

@test "a replay says at which step its system cannot be solved, in one line and without a number that is none" {
  chain 25 >away.g2o
  run -3 --separate-stderr sg-isam2 --init file away.g2o
  [ "${#stderr_lines[@]}" = 1 ]
  [[ $stderr == "sg-isam2: step "*": the "* ]]
  [[ $output != *nan* ]]
  [[ $output != *inf* ]]
}
