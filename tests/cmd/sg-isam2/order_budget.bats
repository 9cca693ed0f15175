# sg-isam2 -m best --order-budget
load ../common

setup() {
  cd "$BATS_TEST_TMPDIR"
  sg-gen city -n 60 > city.g2o
}

@test "--order-budget: best in every step, and the estimate is that of any other order" {
  sg-isam2 -m best --order-budget 0t --chi2 -f ec_bt,chi2 --no-header city.g2o > best.tsv
  sg-isam2 -m colamd --chi2 -f ec_bt,chi2 --no-header city.g2o > colamd.tsv
  [ "$(wc -l < best.tsv)" = 60 ]
  near "$(tail -n 1 best.tsv | cut -f 2)" "$(tail -n 1 colamd.tsv | cut -f 2)" 5e-3  # relinearization has a threshold
  sg-isam2 -m best --order-budget 16t -f ec_bt --no-header city.g2o | cmp - <(sg-isam2 -m best --order-budget 16t -f ec_bt --no-header city.g2o)
}

@test "--order-budget is of best alone, and wants seconds or tries" {
  fails 2 "sg-isam2: --order-budget has no effect without -m best (see sg-isam2 --help)" \
    sg-isam2 --order-budget 3t city.g2o
  fails 2 "sg-isam2: --order-budget wants seconds, as in 2.5, or tries, as in 500t, not 'soon' (see sg-isam2 --help)" \
    sg-isam2 -m best --order-budget soon city.g2o
}
