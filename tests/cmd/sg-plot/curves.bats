load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA/walk.g2o" .; }

# curves FILE: the points of every curve.
curves() { grep 'stroke-width:1.5' "$1" | grep -oE ' d="[^"]*"' | sed 's/ d="//; s/"//'; }

@test "a curve for every column of numbers, and for every word of the others" {
  printf 'n\tname\ta\tb\n0\tone\t0\t10\n1\ttwo\t5\t0\n10\tone\t10\t\n' | sg-plot curves >some.svg
  [ "$(curves some.svg | wc -l)" -eq 4 ]
  # From 70 to 584 for 0 to 10, and from 560 up to 30
  curves some.svg | grep -qx 'M 70 560 L 584 30 '
  sg-ec --trace -m amd,wmf -f step,order,ec,nnz walk.g2o | sg-plot curves -o ec.svg
  [ "$(curves ec.svg | wc -l)" -eq 4 ]
}

@test "logarithmic axes" {
  printf 'n\ta\n1\t1\n10\t10\n100\t10000\n1000\t0\n' | sg-plot curves --log x,y >log.svg
  curves log.svg | grep -qx 'M 70 560 L 327 427.5 L 584 30 '
  printf 'n\ta\n1\t0\n' | sg-plot curves --log y >nothing.svg
  [ "$(curves nothing.svg | wc -l)" -eq 0 ]
}

@test "a curve of many points stays small" {
  awk 'BEGIN {print "n\ta"; for (k = 0; k < 200000; ++k) print k "\t" k % 7}' | sg-plot curves -o many.svg
  [ "$(stat -c %s many.svg)" -lt 6000000 ]
}

@test "what is no table" {
  fails 1 "sg-plot: <stdin>: no table: a header line and a row at least" sh -c 'echo a | sg-plot curves'
  fails 1 "sg-plot: <stdin>:3: 1 cells, and the header has 2" sh -c 'printf "a\tb\n1\t2\n3\n" | sg-plot curves'
  fails 1 "sg-plot: <stdin>:1: curves want two columns of numbers, the first to the right" sh -c 'printf "a\tb\n1\tx\n" | sg-plot curves'
  fails 2 "sg-plot: -m has no effect on curves, which are those of a table (see sg-plot --help)" sg-plot curves -m amd walk.g2o
  fails 2 "sg-plot: --log has no effect on a map, only on curves (see sg-plot --help)" sg-plot map --log x walk.g2o
}
