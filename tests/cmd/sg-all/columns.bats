bats_require_minimum_version 1.5.0
load ../common

# The columns of a table are declared once, in the command: -f help prints them. The manual tells the same.
setup() { cd "$BATS_TEST_TMPDIR"; }

MAN=$TESTDATA/../man
tables='bayes diff ec ecgreedy elim info isam2 predict score solve tgreedy'

# declared COMMAND: "name TAB meaning" of every column, as -f help has them.
declared() { sg-"$1" -f help | sed -nE 's/ \(with .*\)$//; s/^([a-z_0-9]+) +/\1\t/p'; }

# described COMMAND: the same of the items in the manual's section COLUMNS.
described() {
  awk '/^\.Sh/ {inside = $2 == "COLUMNS"}
    !inside {next}
    /^\.(It|El)/ {for (i = 1; i <= count; i++) print name[i] "\t" text; count = 0; text = ""}
    /^\.It Cm/ {for (i = 3; i <= NF; i++) if ($i != ",") name[++count] = $i; next}
    {text = text " " $0}' "$MAN/sg-$1.1"
}

# words: of standard input, three letters or longer, in lower case, a line each.
words() { tr 'A-Z' 'a-z' | grep -oE '[a-z]{3,}' | sort -u; }

@test "-f help and the manual have the same columns in the same order" {
  for command in $tables; do
    run -0 declared $command
    names=$(cut -f 1 <<<"$output")
    [ "$(wc -l <<<"$names")" -ge 6 ]
    run -0 described $command
    [ "$names" = "$(cut -f 1 <<<"$output")" ] || { diff <(echo "$names") <(cut -f 1 <<<"$output") >&2; return 1; }
  done
}

@test "every word of a column's meaning stands in the manual's item" {
  for command in $tables; do
    paste <(declared $command) <(described $command | cut -f 2) >both
    while IFS=$'\t' read -r name meaning text; do
      missing=$(comm -23 <(words <<<"$meaning") <(words <<<"$text"))
      [ -z "$missing" ] || { echo "sg-$command: $name: not in the manual: $missing" >&2; return 1; }
    done <both
  done
}

@test "the table that is printed has the columns of -f help, but for those that the call does not ask for" {
  cp "$TESTDATA/walk.g2o" .
  for call in 'bayes' 'ec' 'ecgreedy -r 2 --trace' 'elim' 'isam2' 'predict' 'score' 'solve --time 1' 'tgreedy -r 2 --trace'; do
    unasked=$(sg-${call%% *} -f help | sed '/^With/,$d' | { grep -v '(with' || true; } | sed 's/ .*//' | paste -sd '\t')
    sizes=$(sg-${call%% *} -f help | { grep '(with a graph or counts)' || true; } | sed 's/ .*//' | paste -sd '\t')
    run -0 sg-$call walk.g2o
    [ "${lines[0]}" = "$unasked${sizes:+	$sizes}" ]
  done
}

@test "-f help needs no graph, and fits 80 columns" {
  for command in $tables; do
    run -0 sg-$command -f help </dev/null
    [ -z "$(awk 'length > 80' <<<"$output")" ]
    run -0 sg-$command -f help --no-header missing.g2o
  done
}

@test "a column that is not there" {
  fails 2 "sg-ec: no column 'cost'; there are file, step, order, vertices, edges, dim, ec, rose, flops, nnz, fill, max_clique, height, cliques, ec_bt, factor_bytes, peak_bytes, seconds (see sg-ec --help)" \
    sg-ec -f cost "$TESTDATA/walk.g2o"
}
