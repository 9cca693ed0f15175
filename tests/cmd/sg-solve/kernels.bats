# SGTOOLS_KERNELS: every instruction set that this machine has, against each other.
load ../common

setup() {
  cd "$BATS_TEST_TMPDIR"
}

# Those that this machine has, as the message for a name that is none lists them.
kernels() {
  { SGTOOLS_KERNELS=none sg-solve "$TESTDATA/walk.g2o" 2>&1 || true; } |
    sed -n "s/.*: no kernels 'none' on this machine; there are: \(.*\) (see .*/\1/p" | tr -d ,
}

# close A B: two files of numbers and words that differ in last digits alone.
close() {
  paste -d ' ' "$1" "$2" | awk '
    { n = NF / 2
      for (k = 1; k <= n; ++k)
        if ($k != $(k + n) && !(($k - $(k + n)) ^ 2 <= (1e-7 * (1 + $k ^ 2) ^ 0.5) ^ 2)) bad = 1 }
    END { exit bad }'
}

@test "wrong kernels are told before the graph is read" {
  run -2 env SGTOOLS_KERNELS=sse9 sg-solve missing.g2o
  [[ "$output" == *"no kernels 'sse9'"* ]]
}

@test "a name that is none, or that this machine cannot run, is a usage error" {
  for command in sg-solve sg-isam2; do
    run -2 env SGTOOLS_KERNELS=sse9 "$command" "$TESTDATA/walk.g2o"
    [[ "$output" == "$command: SGTOOLS_KERNELS: no kernels 'sse9' on this machine; there are: plain"* ]]
  done
}

@test "empty is as without it" {
  SGTOOLS_KERNELS='' sg-solve --no-trace-comment "$TESTDATA/types-se3.g2o" > empty.g2o
  sg-solve --no-trace-comment "$TESTDATA/types-se3.g2o" | cmp - empty.g2o
}

@test "all end at the same estimates but for last digits, each at the same bytes every time" {
  case " $(kernels) " in *" plain "*) ;; *) false ;; esac
  for graph in types-se2 types-se3; do
    SGTOOLS_KERNELS=plain sg-solve --no-trace-comment "$TESTDATA/$graph.g2o" > plain.g2o
    SGTOOLS_KERNELS=plain sg-isam2 -f step,ec_bt,chi2 "$TESTDATA/$graph.g2o" > plain.tsv
    for name in $(kernels); do
      export SGTOOLS_KERNELS=$name
      sg-solve --no-trace-comment "$TESTDATA/$graph.g2o" > there.g2o
      sg-isam2 -f step,ec_bt,chi2 "$TESTDATA/$graph.g2o" > there.tsv
      close plain.g2o there.g2o
      close plain.tsv there.tsv
      sg-solve --no-trace-comment "$TESTDATA/$graph.g2o" | cmp - there.g2o
    done
  done
}
