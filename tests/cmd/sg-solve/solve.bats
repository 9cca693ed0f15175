load ../common

setup() {
  cd "$BATS_TEST_TMPDIR"
  cp "$TESTDATA"/types-*.g2o "$TESTDATA"/walk.g2o .
}

@test "the chi-square of a file is printed in full and nothing else" {
  run -0 sg-solve --chi2 types-se2.g2o
  near "$output" 128.371198 5e-7
  [ "${#output}" -ge 15 ]
  near "$(sg-solve --chi2 <types-se3.g2o)" 600.010429 5e-7
  near "$(sg-solve --chi2 types-expmap.g2o)" 5021.171853 5e-7
}

@test "only the numbers of estimates change" {
  for name in types-se2 types-se3 types-expmap; do
    sg-solve --no-trace-comment $name.g2o >out.g2o
    cmp <(grep -v ^VERTEX $name.g2o) <(grep -v ^VERTEX out.g2o)
    cmp <(grep -n ^VERTEX $name.g2o | cut -d' ' -f1,2) <(grep -n ^VERTEX out.g2o | cut -d' ' -f1,2)
    run -1 cmp -s $name.g2o out.g2o
  done
  grep -qx "VERTEX_SE3:EXPMAP 0 0 0 0 0 0 0 1" out.g2o  # FIX 0
}

@test "odd spacing, line ends and a missing last newline stay" {
  printf '\tVERTEX_SE2  0 0   0 0\r\nVERTEX_SE2\t 1 5 5  1 \r\nEDGE_SE2 0  1 1 0 0 1 0 0 1 0 1' >in.g2o
  sg-solve --no-trace-comment in.g2o >out.g2o
  cmp <(sed 2d in.g2o) <(sed 2d out.g2o)
  sed -n 2p out.g2o | grep -qE $'^VERTEX_SE2\t 1 [^ ]+ [^ ]+ [^ ]+ \r$'
}

@test "a file of edges gets VERTEX lines" {
  grep -v ^VERTEX walk.g2o >edges.g2o
  sg-solve --no-trace-comment edges.g2o >out.g2o
  cmp <(grep -v ^VERTEX out.g2o) edges.g2o
  [ "$(grep -c ^VERTEX out.g2o)" -eq 7 ]
  [ "$(grep -m 1 -n ^EDGE out.g2o | cut -d: -f1)" -eq 10 ]
}

@test "methods, orders, backends and threads agree" {
  for name in types-se2 types-se3 types-expmap; do
    want=$(sg-solve $name.g2o | sg-solve --chi2)
    for call in --gn "--backend cholmod" "--backend qr" "-m random" "-m landmarks-first" "-j 1" "-j 2" "--init --backend cholmod"; do
      near "$(sg-solve -q $call $name.g2o | sg-solve --chi2)" "$want" 5e-7
    done
  done
}

@test "a row an iteration, beginning with the start" {
  sg-solve -v --start file types-se2.g2o 2>log >/dev/null
  grep -v '^sg-solve:' log >rows
  [ "$(head -n 1 rows)" = "$(printf 'iteration\tchi2\tlambda\tstep\tkept\tlinearize_s\teliminate_s')" ]
  near "$(sed -n 2p rows | cut -f2)" 128.371198 5e-7
  grep -qE '^sg-solve: converged after [0-9]+ iterations, [-.e0-9]+ s: chi-square from 128.371 to 6.51528$' log
  near "$(tail -n 1 rows | cut -f2)" 6.515277 5e-7
  [ "$(tail -n 1 rows | cut -f1)" -eq $(($(wc -l <rows) - 2)) ]
}

@test "what does not converge is an error, unless it is asked for" {
  # Weights that grow as errors vanish: iterations creep.
  echo before >out.g2o
  run -3 sg-solve --tolerance 0 --gn --kernel huber:1e-3 --kernel-on all types-se3.g2o -o out.g2o
  [[ $output == "sg-solve: not converged after 1000 iterations, chi-square "*"; nothing is written (--keep would): try "* ]]
  [ "${#lines[@]}" -eq 1 ]
  [ "$(cat out.g2o)" = before ]
  run -0 sg-solve --keep --tolerance 0 --gn --kernel huber:1e-3 --kernel-on all types-se3.g2o -o out.g2o
  [[ $output == "sg-solve: not converged after 1000 iterations, chi-square "* ]]
  [ "${#lines[@]}" -eq 1 ]
  run -0 grep -c ^VERTEX out.g2o
  [ "$output" -gt 0 ]
  fails 2 "sg-solve: --keep has no effect with --chi2, which does not optimize (see sg-solve --help)" \
    sg-solve --keep --chi2 types-se3.g2o
}

@test "too few iterations are a warning" {
  run -0 sg-solve -i 1 types-se2.g2o -o out.g2o
  [[ $output == "sg-solve: not converged after 1 iterations, chi-square "* ]]
  [ -s out.g2o ]
  run -0 sg-solve -q -i 1 types-se2.g2o -o out.g2o
  [ -z "$output" ]
}

@test "a tolerance ends earlier" {
  few=$(sg-solve -v --tolerance 0.1 types-se3.g2o 2>&1 >/dev/null | wc -l)
  many=$(sg-solve -v types-se3.g2o 2>&1 >/dev/null | wc -l)
  [ "$few" -lt "$many" ]
}

@test "--time prints what elimination costs" {
  sg-solve --time 3 types-se2.g2o >row
  [ "$(wc -l <row)" -eq 2 ]
  [ "$(cut -f6 row | tail -n 1)" = "$(sg-ec -f ec --no-header types-se2.g2o)" ]
  [ "$(sg-order -m amd types-se2.g2o | sg-solve --time 1 -f order --no-header)" = file:amd ]
  awk -F'\t' 'NR == 2 {good = $9 > 0 && $10 > 0.99 * $9 / $6 && $10 < 1.01 * $9 / $6} END {exit !good}' row
}

@test "a singular system names the undetermined vertices and leaves the output alone" {
  echo before >out.g2o
  grep -v "EDGE_SE2_XY . 101" walk.g2o >in.g2o
  fails 3 "sg-solve: the system is singular: the measurements leave vertex 101 undetermined; add edges or FIX lines, or leave it out" \
    sg-solve in.g2o -o out.g2o
  [ "$(cat out.g2o)" = before ]
  fails 3 "sg-solve: the system is singular: the measurements leave vertex 101 undetermined; add edges or FIX lines, or leave it out" \
    sg-solve --gn --backend cholmod in.g2o
  fails 3 "sg-solve: the system is singular: the measurements leave vertex 101 undetermined; add edges or FIX lines, or leave it out" \
    sg-solve --time 1 in.g2o
  printf 'EDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\nEDGE_SE2 7 8 1 0 0 1 0 0 1 0 1\nEDGE_SE2 8 9 1 0 0 1 0 0 1 0 1\n' >in.g2o
  fails 3 "sg-solve: the system is singular: the measurements leave vertices 7-9 undetermined; add edges or FIX lines, or leave them out" sg-solve in.g2o
}

@test "what cannot be solved is said with its line" {
  printf 'VERTEX_SE2 0 0 0 0\nVERTEX_XY 1 0 0\nPARAMS_SE2OFFSET 0 0 0 0\nEDGE_SE2_POINTXY_OFFSET 0 1 0 1 1 1 0 1\n' >in.g2o
  fails 1 "sg-solve: in.g2o:4: EDGE_SE2_POINTXY_OFFSET has no measurement model here" sg-solve in.g2o
  printf 'VERTEX_SE2 0 0 0 0\nVERTEX_XY 1 0 0\nEDGE_BEARING_SE2_XY 0 1 0.5 1\n' >in.g2o
  fails 3 "sg-solve: in.g2o:3: EDGE_BEARING_SE2_XY has no derivative at this estimate" sg-solve in.g2o
}

@test "a wrong call is told" {
  for kernel in huber huber:0 huber:x tukeys:1; do
    fails 2 "sg-solve: --kernel wants NAME:W with W above 0, not '$kernel'; there are huber, cauchy, tukey, geman-mcclure, dcs (see sg-solve --help)" \
      sg-solve --kernel $kernel walk.g2o
  done
  fails 2 "sg-solve: --chi2 prints the chi-square, --time times eliminations: give one of them (see sg-solve --help)" sg-solve --chi2 --time 3 walk.g2o
  fails 2 "sg-solve: no backend 'x'; there are tree, cholmod, qr (see sg-solve --help)" sg-solve --backend x walk.g2o
}

@test "the public graphs end where g2o's convention has their optimum" {
  need_data
  near "$(sg-solve --chi2 "$SGTOOLS_DATA/intel.g2o")" 551.735731 5e-7
  near "$(sg-solve "$SGTOOLS_DATA/intel.g2o" | sg-solve --chi2)" 45.004696 5e-7
  near "$(sg-solve --gn "$SGTOOLS_DATA/intel.g2o" | sg-solve --chi2)" 45.004696 5e-7
  near "$(sg-solve --chi2 "$SGTOOLS_DATA/city10000.g2o")" 654162688.487887 5e-7
  near "$(sg-solve "$SGTOOLS_DATA/city10000.g2o" | sg-solve --chi2)" 511.985164 5e-7
  near "$(sg-solve --chi2 "$SGTOOLS_DATA/sphere2500.g2o")" 2547810.848806 5e-7
  near "$(sg-solve "$SGTOOLS_DATA/sphere2500.g2o" | sg-solve --chi2)" 727.149667 5e-7
}
