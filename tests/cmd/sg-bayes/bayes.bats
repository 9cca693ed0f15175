load ../common

setup() { cd "$TESTDATA"; }

@test "the cliques of Figure 1" {
  run -0 sg-bayes -m file --no-header figure1.g2o
  [ "$output" = "$(printf '0\t\t0\t2 3 4\t\t9\t0\t729\n1\t0\t1\t1\t2 3\t3\t6\t243\n2\t1\t2\t0\t1 2\t3\t6\t243')" ]
}

# Separators are lists of ids: their dimensions have to sum to d_s, and all lie in the parent's clique.
check_tree() {
  awk -F '\t' '
    NR == FNR {dim[$1] = $2; next}
    {
      n = split($3, f, " "); d = 0; for (i = 1; i <= n; i++) {d += dim[f[i]]; if (seen[f[i]]++) exit 1}
      if (d != $5) exit 1
      m = split($4, s, " "); d = 0
      for (i = 1; i <= m; i++) {d += dim[s[i]]; if (index(all[$2], " " s[i] " ") == 0) exit 1}
      if (d != $6) exit 1
      all[$1] = " " $3 " " $4 " "
    }' <(sg-ec -m "$2" --per-vertex --no-header -f id,d_f "$1") \
       <(sg-bayes -m "$2" --no-header -f clique,parent,frontal,separator,d_f,d_s "$1")
}

# The same, and the sums are what sg-ec says.
check_graphs() {
  for graph in "$@"; do
    for m in colamd random; do
      check_tree "$graph" $m
      [ "$(sg-bayes -m $m --no-header -f cost "$graph" | awk "{s += \$1} END {printf \"%.0f\", s}")" = "$(sg-ec -m $m --no-header -f ec_bt "$graph")" ]
      [ "$(sg-bayes -m $m --no-header "$graph" | wc -l)" = "$(sg-ec -m $m --no-header -f cliques "$graph")" ]
    done
  done
}

@test "separators lie in the parent's clique; every variable is frontal once; sums are sg-ec's" {
  check_graphs figure1.g2o walk.g2o
}

@test "public graphs: separators, frontal variables and sums" {
  need_data
  check_graphs "$SGTOOLS_DATA/victoriaPark.isam.txt" "$SGTOOLS_DATA/sphere400.isam.txt"
}

@test "--json has lists and nulls" {
  [ "$(sg-bayes -m file --json -f parent,frontal figure1.g2o | head -n 1)" = '{"parent": null, "frontal": [2, 3, 4]}' ]
}

@test "--dot is a tree that Graphviz draws" {
  sg-bayes -m file --dot figure1.g2o >"$BATS_TEST_TMPDIR/out.dot"
  grep -q 'c1 \[label="1 : 2 3"\]' "$BATS_TEST_TMPDIR/out.dot"
  [ "$(grep -c -- '->' "$BATS_TEST_TMPDIR/out.dot")" = 2 ]
  dot -Tsvg "$BATS_TEST_TMPDIR/out.dot" >"$BATS_TEST_TMPDIR/out.svg"
}

@test "wrong calls" {
  run -2 sg-bayes -m nonsense figure1.g2o
  run -2 sg-bayes -f ec figure1.g2o
  run -1 sg-bayes missing.g2o
}
