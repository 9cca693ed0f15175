# Where sg-solve starts: what the user says, or the best of several, told on -v.
load ../common

setup() {
  cd "$BATS_TEST_TMPDIR"
}

# optimum CALL...: the chi-square of where it ends.
optimum() {
  "$@" > solved.g2o || return 1
  sg-solve --chi2 solved.g2o
}

@test "every start of an easy graph leads to the same optimum" {
  cp "$TESTDATA"/types-se2.g2o "$TESTDATA"/types-se3.g2o "$TESTDATA"/walk.g2o .
  for graph in *.g2o; do
    want=$(optimum sg-solve "$graph")
    for start in file odometry chordal tree isam2; do
      near "$(optimum sg-solve --start "$start" "$graph")" "$want" 1e-6
    done
  done
}

@test "a graph without noise is solved by its chordal start, from edges alone" {
  for world in "manhattan -n 300" "sphere -n 300" "torus -n 300" "city -n 300"; do
    sg-gen $world --truth exact.g2o -o noisy.g2o
    grep -v ^VERTEX exact.g2o > edges.g2o
    [ "$(sg-solve --start chordal --chi2 edges.g2o | awk '{ print $1 < 1e-8 }')" = 1 ]
  done
}

@test "from the file, from edges alone, and from odometry that ends elsewhere: one optimum" {
  for world in "manhattan -n 500 --noise-rot 0.2" "sphere -n 400 --noise-rot 0.2"; do
    sg-gen $world --seed 2 -o noisy.g2o
    grep -v ^VERTEX noisy.g2o > edges.g2o
    want=$(optimum sg-solve noisy.g2o)
    near "$(optimum sg-solve edges.g2o)" "$want" 1e-6
    near "$(optimum sg-solve --start chordal noisy.g2o)" "$want" 1e-6
  done
  sg-gen manhattan -n 500 --noise-rot 0.2 --seed 2 -o noisy.g2o
  away=$(optimum sg-solve -q --keep -i 200 --start file noisy.g2o)
  awk -v away="$away" -v want="$(optimum sg-solve noisy.g2o)" 'BEGIN { exit !(away > 1.1 * want) }'
}

@test "-v tells the starts, the least chi-square first, and each run's" {
  sg-gen manhattan -n 200 --noise-rot 0.05 -o noisy.g2o
  run -0 sg-solve -v noisy.g2o -o solved.g2o
  grep -qE '^sg-solve: starts by chi-square: chordal [0-9.e+]+, file [0-9.e+]+$' <<< "$output"
  grep -qx 'sg-solve: from chordal:' <<< "$output"
  # What noise explains already is no reason to look further.
  run -0 sg-solve -v solved.g2o -o again.g2o
  grep -qE '^sg-solve: starts by chi-square: file [0-9.e+]+$' <<< "$output"
  run -0 sg-solve -v --start file noisy.g2o -o solved.g2o
  grep -qE '^sg-solve: starts by chi-square: file [0-9.e+]+$' <<< "$output"
  run -1 grep -c 'from chordal' <<< "$output"
  [ "$output" = 0 ]
}

@test "an end that noise does not explain has the other starts tried, and -i does not" {
  # Information that claims ten times less noise than there is.
  sg-gen manhattan -n 200 --noise-rot 0.05 | sed -E '/^EDGE/ s/([0-9.e+]+)$/1e7/' > bold.g2o
  run -0 sg-solve -v bold.g2o -o solved.g2o
  [ "$(grep -c ': from ' <<< "$output")" = 3 ]
  grep -qx 'sg-solve: from tree:' <<< "$output"
  run -0 sg-solve -v -i 50 bold.g2o -o solved.g2o
  [ "$(grep -c ': from ' <<< "$output")" = 1 ]
}

@test "landmarks close loops: a city and its landmarks from edges alone" {
  sg-gen city -n 500 --noise-rot 0.03 --seed 3 | grep -v ^VERTEX > edges.g2o
  run -0 sg-solve -v edges.g2o -o solved.g2o
  iterations=$(grep -oE 'converged after [0-9]+' <<< "$output" | grep -oE '[0-9]+')
  [ "$iterations" -le 6 ]
}

@test "a start that is none, or that the file has not, is told" {
  fails 2 "sg-solve: no start 'chordial': did you mean chordal? There are file, odometry, chordal, tree, isam2 (see sg-solve --help)" \
    sg-solve --start chordial "$TESTDATA/walk.g2o"
  grep -v ^VERTEX "$TESTDATA/walk.g2o" > edges.g2o
  fails 1 "sg-solve: edges.g2o: the file has no VERTEX lines" sg-solve --start file edges.g2o
}
