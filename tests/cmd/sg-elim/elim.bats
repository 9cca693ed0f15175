load ../common

setup() { cd "$TESTDATA"; }

@test "Figure 1 of the paper: neighbours and fill of every step" {
  run -0 sg-elim -m file --no-header -f step,variable,neighbours,fill figure1.g2o
  [ "$output" = "$(printf '0\t0\t1 2\t1-2\n1\t1\t2 3\t2-3\n2\t2\t3 4\t\n3\t3\t4\t\n4\t4\t\t')" ]
}

@test "costs sum to the EC of sg-ec, under every ordering" {
  for graph in figure1.g2o walk.g2o; do
    for m in file colamd random landmarks-first; do
      [ "$(sg-elim -m $m --no-header -f cost $graph | awk "{s += \$1} END {printf \"%.0f\", s}")" = "$(sg-ec -m $m --no-header -f ec $graph)" ]
    done
  done
}

@test "the default order is that of sg-ec" {
  cmp <(sg-elim walk.g2o) <(sg-elim -m colamd walk.g2o)
  cmp <(sg-order -m random walk.g2o | sg-elim) <(sg-elim -m random walk.g2o)
}

@test "fixed vertices have no step" {
  [ "$(sg-elim -m id --no-header -f variable walk.g2o | xargs)" = "1 2 3 4 100 101" ]
}

@test "--json has lists" {
  [ "$(sg-elim -m file --json -f neighbours,fill figure1.g2o | head -n 1)" = \
    '{"neighbours": [1, 2], "fill": [[1, 2]]}' ]
}

@test "--dot draws an elimination graph a step, induced edges dashed" {
  sg-elim -m file --dot figure1.g2o >"$BATS_TEST_TMPDIR/out.dot"
  [ "$(grep -c cluster_ "$BATS_TEST_TMPDIR/out.dot")" = 5 ]
  grep 'dashed' "$BATS_TEST_TMPDIR/out.dot" | sed 's/ \[.*//' | xargs >"$BATS_TEST_TMPDIR/fill"
  [ "$(cat "$BATS_TEST_TMPDIR/fill")" = "g1_1 -- g1_2 g2_2 -- g2_3" ]
  dot -Tsvg "$BATS_TEST_TMPDIR/out.dot" >"$BATS_TEST_TMPDIR/out.svg"
}

@test "--dot leaves out what touched a variable that has gone" {
  printf 'EDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\nEDGE_SE2 2 3 1 0 0 1 0 0 1 0 1\n' >"$BATS_TEST_TMPDIR/chain.g2o"
  sg-elim --dot -m id "$BATS_TEST_TMPDIR/chain.g2o" >"$BATS_TEST_TMPDIR/chain.dot"
  [ "$(grep -c ' -- ' "$BATS_TEST_TMPDIR/chain.dot")" -eq 3 ]  # two edges, then one, then none
  run -1 grep g1_1 "$BATS_TEST_TMPDIR/chain.dot"
}

@test "wrong calls and too large graphs" {
  run -2 sg-elim -m colamd,amd --dot figure1.g2o
  run -2 sg-elim -m nonsense figure1.g2o
  awk 'BEGIN {for (i = 0; i < 150001; i++) print "VERTEX_SE2", i, 0, 0, 0}' >"$BATS_TEST_TMPDIR/large.g2o"
  fails 1 "sg-elim: $BATS_TEST_TMPDIR/large.g2o: 150001 variables are too many to simulate one by one (at most 150000); sg-ec scores any graph" \
    sg-elim "$BATS_TEST_TMPDIR/large.g2o"
}
