load ../common

setup() { cd "$BATS_TEST_TMPDIR"; }

# Landmarks that enter with three pixels from poses close by: what they say of distance is little, and undamped
# Gauss-Newton steps carry some of them off for good.
# within_one_percent GRAPH: iSAM2's last chi-square lies within 1 % of the batch optimum.
within_one_percent() {
  local incremental batch
  incremental=$(sg-isam2 --min-obs 3 --chi2 -f chi2 "$1" | tail -n 1)
  batch=$(sg-solve "$1" | sg-solve --chi2)
  near "$incremental" "$batch" 0.01
}

@test "monocular landmarks stay where their rays meet: chi-square within 1 % of batch" {
  sg-gen sine -o sine.g2o
  within_one_percent sine.g2o
  for policy in kf dec rand; do
    sg-$policy -r 4 --min-obs 3 sine.g2o -o pruned.g2o
    within_one_percent pruned.g2o
  done
}
