load ../common

setup() { cd "$BATS_TEST_TMPDIR"; }

# rejected TABLE TRUTH: lines of weight below a half; lines that are false.
rejected() { awk -F'\t' 'NR > 1 && $7 < 0.5 {print $1}' "$1" | sort; }
wrong() { grep -n '^# false ' "$1" | cut -d: -f1 | sort; }

@test "--gnc leaves out what is false, and nothing else" {
  for world in "manhattan -n 300" "sphere -n 200" "city -n 200 --min-obs 8" "torus -n 200" "grid3d -n 120"; do
    sg-gen $world --outliers 0.2 --truth t -o g
    sg-solve --gnc --weights w -o s g
    [ "$(wc -l <w)" -eq $((1 + $(grep -c ^EDGE g))) ]
    [ "$(wrong t | wc -l)" -gt 10 ]
    diff <(rejected w) <(wrong t)
    paste -d'|' t g | grep -v '^# false' | cut -d'|' -f2- | sg-solve | sg-score --reference t -f ate_rmse --no-header >clean
    near "$(sg-score --reference t -f ate_rmse --no-header s)" "$(cat clean)" 1e-6
  done
}

@test "--gnc takes true edges back that it left out too soon" {
  sg-gen sphere -n 300 --seed 35 --outliers 0.2 --truth t -o g
  sg-solve --gnc --quantile 0.9999 --weights w -o s g
  diff <(rejected w) <(wrong t)
}

@test "--gnc of a graph without false edges is the plain optimum" {
  sg-gen manhattan -n 300 -o g
  near "$(sg-solve --gnc g | sg-solve --chi2)" "$(sg-solve g | sg-solve --chi2)" 1e-7
}

@test "the bytes are the same with any number of threads" {
  sg-gen sphere -n 400 --outliers 0.1 -o sphere
  sg-gen city -n 400 --outliers 0.1 -o city
  sg-gen torus -n 900 -o torus
  for call in "sphere" "city" "torus" "--gn torus" "--gnc sphere" "--gnc city" "--kernel dcs:2 sphere" "-m metis torus" \
      "--backend cholmod sphere"; do
    sg-solve -q -i 9 --no-trace-comment -j 1 $call -o one
    for threads in 2 3 8; do
      sg-solve -q -i 9 --no-trace-comment -j $threads $call -o many
      cmp one many
    done
  done
}

@test "--residuals: a row an edge, the worst first, that sum up to the chi-square" {
  cp "$TESTDATA"/types-*.g2o .
  for name in types-se2 types-se3 types-expmap; do
    sg-solve --residuals $name.g2o >table
    [ "$(head -n 1 table)" = "$(printf 'line\ttype\tids\tchi2\tdof\tquantile\tweight')" ]
    [ "$(wc -l <table)" -eq $((1 + $(grep -c ^EDGE $name.g2o))) ]
    near "$(awk -F'\t' 'NR > 1 {s += $4} END {printf "%.15g", s}' table)" "$(sg-solve --chi2 $name.g2o)" 1e-9
    tail -n +2 table | cut -f6 | sort -c -k1,1gr
    while IFS=$'\t' read -r line type ids rest; do
      run -0 sed -n "${line}p" $name.g2o
      [[ $output == "$type ${ids%% *}"* ]]
    done < <(tail -n +2 table)
  done
}

@test "a kernel's weights are in the tables, by its formula" {
  sg-gen manhattan -n 60 --outliers 0.2 -o g
  sg-solve --residuals --kernel cauchy:2 g >table
  [ "$(awk -F'\t' 'NR > 1 {split($3, id, " "); w = id[2] - id[1] == 1 ? 1 : 1 / (1 + $4 / 4); d = $7 - w; if (d * d > 1e-18) ++bad} END {print bad + 0}' table)" -eq 0 ]
  sg-solve --kernel geman-mcclure:3 --kernel-on all --weights w -o s g
  # The file's numbers are the estimates': the table of the file is that of the solver, but for the line of its call.
  sg-solve --kernel geman-mcclure:3 --kernel-on all --residuals s >again
  cmp <(cut -f2- w) <(cut -f2- again)
}

@test "--kernel-on: what it is for" {
  sg-gen city -n 60 --outliers 0.1 -o city
  sg-gen manhattan -n 60 --outliers 0.1 -o manhattan
  light() { sg-solve --residuals --kernel dcs:1 "$@" --no-header -f type,ids,weight | awk -F'\t' '$3 < 1 {split($2, id, " "); print $1, (id[2] - id[1] == 1)}' | sort -u | paste -sd,; }
  # Odometry agrees with estimates that are composed of it: the loops alone could be light.
  sg-solve -i 3 -q city -o city; sg-solve -i 3 -q manhattan -o manhattan
  [ "$(light --kernel-on observations city)" = "EDGE_SE2_XY 0" ]
  [ "$(light city)" = "EDGE_SE2_XY 0" ]
  [ "$(light --kernel-on loops city)" = "" ]
  [ "$(light --kernel-on all city)" = "EDGE_SE2 1,EDGE_SE2_XY 0" ]
  [ "$(light --kernel-on loops manhattan)" = "EDGE_SE2 0" ]
  [ "$(light manhattan)" = "EDGE_SE2 0" ]
  [ "$(light --kernel-on observations manhattan)" = "" ]
  [ "$(light --kernel-on all manhattan)" = "EDGE_SE2 0,EDGE_SE2 1" ]
}

@test "--fix: vertices stay where they are, and so does the file" {
  cp "$TESTDATA/walk.g2o" .
  sg-solve --no-trace-comment --fix 2,4 walk.g2o -o out
  diff <(grep -E '^VERTEX_SE2 [24] ' walk.g2o) <(grep -E '^VERTEX_SE2 [24] ' out)
  diff <(grep -v ^VERTEX walk.g2o) <(grep -v ^VERTEX out)
  { cat walk.g2o; echo FIX 2 4; } | sg-solve --no-trace-comment | diff - <(cat out; echo FIX 2 4)
  fails 2 "sg-solve: --fix: the graph has no vertex 77 (see sg-solve --help)" sg-solve --fix 77 walk.g2o
}

@test "an option without effect is told" {
  cp "$TESTDATA/walk.g2o" .
  fails 2 "sg-solve: --kernel-on has no effect without --kernel or --gnc (see sg-solve --help)" \
    sg-solve --kernel-on loops walk.g2o
  fails 2 "sg-solve: --quantile has no effect without --gnc (see sg-solve --help)" sg-solve --quantile 0.9 walk.g2o
  fails 2 "sg-solve: --quantile is above 0 and below 1 (see sg-solve --help)" sg-solve --gnc --quantile 1 walk.g2o
  fails 2 "sg-solve: --kernel weighs edges, --gnc keeps or leaves them out: give one of them (see sg-solve --help)" \
    sg-solve --gnc --kernel huber:1 walk.g2o
  fails 2 "sg-solve: --gnc has no effect with --chi2, which does not optimize (see sg-solve --help)" \
    sg-solve --chi2 --gnc walk.g2o
  fails 2 "sg-solve: -j has no effect with --residuals, which eliminates nothing (see sg-solve --help)" \
    sg-solve --residuals -j 1 walk.g2o
  fails 2 "sg-solve: --json has no effect without --time, --residuals, --weights or --certify (see sg-solve --help)" \
    sg-solve --json walk.g2o
  fails 2 "sg-solve: --weights and -o are one file, 'x': the table and the graph need each its own (see sg-solve --help)" \
    sg-solve --weights x -o x walk.g2o
}

@test "--certify: a row that says whether the optimum is the global one" {
  sg-gen sphere -n 150 -o start
  sg-solve start -o good
  [ "$(sg-solve --certify -f certified,isotropic,in_part,left_out --no-header good)" = "$(printf 'yes\t287\t0\t0')" ]
  [ "$(sg-solve --certify -f certified --no-header start)" = no ]
  near "$(sg-solve --certify -f chi2 --no-header good)" "$(sg-solve --chi2 good)" 1e-12
  near "$(sg-solve --certify -f bound --no-header good)" "$(sg-solve --chi2 good)" 1e-6
}

@test "--certify says where its model does not apply" {
  cp "$TESTDATA"/types-*.g2o "$TESTDATA/desk.bal" .
  sg-solve types-se2.g2o -o solved
  run -0 --separate-stderr sg-solve --certify -f certified,in_part,left_out --no-header solved
  [[ $output == no* ]]
  [[ $stderr == "sg-solve: the certificate's model is isotropic noise of relative poses: "*" edges count in part, "*" not at all; what is not certified may be the global optimum all the same" ]]
  fails 1 "sg-solve: desk.bal: no edge is of a type that a certificate speaks of (EDGE_SE2, EDGE_SE2_XY, EDGE_SE3:QUAT)" \
    sg-solve --certify desk.bal
  fails 2 "sg-solve: --kernel has no effect with --certify (see sg-solve --help)" sg-solve --certify --kernel huber:1 solved
}
