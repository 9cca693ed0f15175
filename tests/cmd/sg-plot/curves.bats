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

@test "some columns, of several files" {
  printf 'n\ta\tb\n0\t0\t10\n10\t10\t0\n' >one.tsv
  printf 'b\tn\ta\n5\t0\t3\n' >two.tsv
  sg-plot curves -f b,a one.tsv >some.svg
  [ "$(curves some.svg)" = "M 584 560 L 70 30 " ]
  sg-plot curves -f n,a,b one.tsv two.tsv >both.svg
  [ "$(curves both.svg | wc -l)" -eq 4 ]
  cmp <(sg-plot curves -f n,a,b one.tsv) <(sg-plot curves one.tsv)
  fails 1 "sg-plot: two.tsv:1: 'b' would go to the right, and of one.tsv it is 'n'" sg-plot curves one.tsv two.tsv
  fails 2 "sg-plot: -f: no column 'c'; there are n, a, b (see sg-plot --help)" sg-plot curves -f n,c one.tsv
  fails 1 "sg-plot: one.tsv:1: curves want two columns of numbers, the first to the right" sg-plot curves -f n one.tsv
  fails 2 "sg-plot: -f has no effect on a map, only on curves (see sg-plot --help)" sg-plot map -f n walk.g2o
  fails 2 "sg-plot: a map is one graph's: give it one FILE (see sg-plot --help)" sg-plot map walk.g2o walk.g2o
}

@test "the names of many curves take lines of their own, and no more than eight" {
  for k in 12 200; do
    awk -v k=$k 'BEGIN {printf "x"; for (i = 1; i <= k; ++i) printf "\ta_long_name_%d", i; for (r = 0; r < 2; ++r) {printf "\n%d", r; for (i = 1; i <= k; ++i) printf "\t%d", i * r}; print ""}' >many.tsv
    sg-plot curves many.tsv >many$k.svg
    [ "$(curves many$k.svg | wc -l)" -eq $k ]
  done
  # 560 is the lower end; the upper one gives way to the lines of names, and to eight at most
  curves many12.svg | tail -n 1 | awk '{exit !($6 > 30 && $6 < 107 && ($6 - 19) % 11 == 0)}'
  [ "$(curves many200.svg | tail -n 1 | awk '{print $6}')" = 107 ]
}

@test "what is no table" {
  fails 1 "sg-plot: <stdin>: no table: a header line and a row at least" sh -c 'echo a | sg-plot curves'
  fails 1 "sg-plot: <stdin>:3: 1 cells, and the header has 2" sh -c 'printf "a\tb\n1\t2\n3\n" | sg-plot curves'
  fails 1 "sg-plot: <stdin>:1: curves want two columns of numbers, the first to the right" sh -c 'printf "a\tb\n1\tx\n" | sg-plot curves'
  fails 2 "sg-plot: -m has no effect on curves, which are those of a table (see sg-plot --help)" sg-plot curves -m amd walk.g2o
  fails 2 "sg-plot: --log has no effect on a map, only on curves (see sg-plot --help)" sg-plot map --log x walk.g2o
}
