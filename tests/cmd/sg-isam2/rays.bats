load ../common

setup() { cd "$BATS_TEST_TMPDIR"; }

# Landmarks that enter with three pixels from poses close by: what they say of distance is little, and undamped
# Gauss-Newton steps carry some of them off for good.
@test "monocular landmarks stay where their rays meet: chi-square within 1 % of batch" {
  sg-gen sine | sg-kf -r 6 --min-obs 3 -o kf6.g2o
  incremental=$(sg-isam2 --min-obs 3 --chi2 -f chi2 kf6.g2o | tail -n 1)
  batch=$(sg-solve kf6.g2o | sg-solve --chi2)
  awk -v a="$incremental" -v b="$batch" 'BEGIN { exit !(a < 1.01 * b && a > 0.99 * b) }'
}

@test "a replay of pixels in every frame comes to its end" {
  sg-gen sine -o sine.g2o
  [ "$(sg-isam2 --min-obs 3 -f step sine.g2o | tail -n 1)" = 399 ]
}
