load ../common

# What no command may get wrong. Each of these reads a graph; each of the filters writes one as well. sg-check, which reads
# on where others stop, and sg-gen, which reads nothing, have their own lines below.
filters=('sg-cut --largest' sg-merge 'sg-order -m id' 'sg-dec -r 2' 'sg-rand -r 2' 'sg-kf -r 2' 'sg-marg -r 2' 'sg-tgreedy -r 2' 'sg-ecgreedy -r 2')
readers=("${filters[@]}" sg-bayes sg-convert sg-cov 'sg-diff walk.g2o' sg-ec sg-elim sg-info sg-isam2 'sg-plot map' 'sg-predict -r 2' sg-report sg-score sg-solve)

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA/walk.g2o" .; }

# refuse MESSAGE: of in.g2o, every reader says so and ends with 1; sg-check finds it.
refuse() {
  for reader in "${readers[@]}"; do fails 1 "${reader%% *}: in.g2o:$1" $reader in.g2o; done
  run -1 sg-check in.g2o
  [[ $output == *"in.g2o:${1%% *} error: ${1#* }"* ]]
}

# alone FILE...: the folder holds these files and no others.
alone() { [ "$(ls)" = "$(printf '%s\n' "$@" | sort)" ] || { ls >&2; return 1; }; }

@test "malformed numbers" {
  printf 'VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0.5.1 0\n' >in.g2o
  refuse "2: '0.5.1' is not a number"
  printf 'VERTEX_SE2 zero 0 0 0\n' >in.g2o
  refuse "1: 'zero' is not a vertex id"
  printf 'VERTEX_SE2 -1 0 0 0\n' >in.g2o
  refuse "1: '-1' is not a vertex id"
  printf 'VERTEX_SE2 0 1,5 0 0\n' >in.g2o
  refuse "1: '1,5' is not a number"
}

@test "a truncated last line" {
  head -c -8 walk.g2o >in.g2o  # in its last numbers
  refuse "20: EDGE_SE2 wants 9 numbers here, the line has 7"
  { head -n 19 walk.g2o; printf 'EDGE_SE2 4'; } >in.g2o
  refuse "20: the line ends before a vertex id"
  { head -n 19 walk.g2o; printf 'EDGE_S'; } >in.g2o
  refuse "20: unknown tag 'EDGE_S' (teach it by --vertex, --edge or --params, or --alias it to a known one; --skip-unknown leaves such lines out)"
}

@test "an unknown tag" {
  { cat walk.g2o; echo 'EDGE_MINE 0 1 5'; } >in.g2o
  refuse "21: unknown tag 'EDGE_MINE' (teach it by --vertex, --edge or --params, or --alias it to a known one; --skip-unknown leaves such lines out)"
  sg-check --edge EDGE_MINE:2 in.g2o
}

@test "an edge to a missing vertex" {
  { cat walk.g2o; echo 'EDGE_SE2 4 42 1 0 0 1 0 0 1 0 1'; } >in.g2o
  refuse "21: EDGE_SE2 joins vertex 42, which the file does not define"
}

@test "a duplicate vertex" {
  { cat walk.g2o; echo 'VERTEX_SE2 3 0 0 0'; } >in.g2o
  refuse "21: vertex 3 is defined a second time"
}

@test "an id beyond 64 bits, and the largest that is not" {
  printf 'VERTEX_SE2 9223372036854775808 0 0 0\n' >in.g2o
  refuse "1: '9223372036854775808' is above 2^63 - 1, too large for a vertex id"
  printf 'VERTEX_SE2 9223372036854775807 0 0 0\n' >in.g2o
  [ "$(sg-info -f id_max --no-header in.g2o)" = "id_max	9223372036854775807" ]
}

@test "an empty file, one without a graph, and an upstream that failed" {
  : >in.g2o
  refuse " there is no vertex and no edge in it"
  printf '# nothing\n\n\r\n' >in.g2o
  refuse " there is no vertex and no edge in it"
  [ "$(sg-cut --largest missing.g2o 2>/dev/null | sg-ec 2>&1)" = "sg-ec: <stdin>: there is no vertex and no edge in it" ]
}

@test "a directory and a missing file as input" {
  mkdir folder
  for reader in "${readers[@]}" sg-check; do
    fails 1 "${reader%% *}: folder: Is a directory" $reader folder
    fails 1 "${reader%% *}: missing.g2o: No such file or directory" $reader missing.g2o
  done
}

@test "bytes that are no text" {
  printf 'VERTEX_SE2 0 0 \0 0\n' >in.g2o
  for reader in "${readers[@]}" sg-check; do
    fails 1 "${reader%% *}: in.g2o:1: this is binary data, not a graph's text" $reader in.g2o
  done
  printf '\001\002\003\004\377 1 2' >in.g2o
  fails 1 "sg-info: in.g2o:1: unknown tag '????"$'\377'"' (teach it by --vertex, --edge or --params, or --alias it to a known one; --skip-unknown leaves such lines out)" sg-info in.g2o
}

@test "damaged compressed files" {
  gzip -c walk.g2o | head -c 100 >in.g2o
  run -1 sg-info in.g2o
  [[ $output == "sg-info: in.g2o: the compressed data is damaged"* ]]
  if command -v zstd >/dev/null; then
    zstd -qc walk.g2o | head -c 100 >in.g2o
    run -1 sg-info in.g2o
    [[ $output == "sg-info: in.g2o: the compressed data is damaged"* ]]
  fi
}

@test "a rate of 0 or -1" {
  for command in 'sg-dec -r' 'sg-rand -r' 'sg-kf -r' 'sg-tgreedy -r' 'sg-ecgreedy -r' 'sg-predict -r' 'sg-cut --poses' 'sg-gen worst -n'; do
    for rate in 0 -1; do
      echo "$command $rate"
      run -2 --separate-stderr $command $rate walk.g2o
      [ -z "$output" ]
      [ "${#stderr_lines[@]}" = 1 ]
      [[ $stderr == "${command%% *}: "* ]]
    done
  done
}

@test "a number that is none, or too small, is named in a short line" {
  fails 2 "sg-ec: --every x is not a number (see sg-ec --help)" sg-ec --trace --every x walk.g2o
  fails 2 "sg-rand: --keep -1: must be 0 or more (see sg-rand --help)" sg-rand --keep -1 walk.g2o
}

@test "a full disk" {
  [ -c /dev/full ] || skip "no /dev/full here"
  printf 'EDGE_SE2 0 0 1 0 0 1 0 0 1 0 1\n' >loop.g2o
  for call in "${readers[@]/%/ walk.g2o}" 'sg-check loop.g2o' 'sg-gen worst'; do
    fails 3 "${call%% *}: <stdout>: cannot write: No space left on device" bash -c "exec $call >/dev/full"
    [[ $call != sg-plot* ]] || continue  # whose -o wants the name of a picture
    fails 3 "${call%% *}: /dev/full: cannot write: No space left on device" $call -o /dev/full
  done
  fails 3 "sg-gen: /dev/full: cannot write: No space left on device" sg-gen worst --truth /dev/full
  rm loop.g2o
  alone walk.g2o
}

@test "an output in a missing folder, or a folder itself" {
  mkdir folder.svg
  for call in "${readers[@]/%/ walk.g2o}" 'sg-check walk.g2o' 'sg-gen worst'; do
    fails 3 "${call%% *}: no/out.svg: cannot create: No such file or directory" $call -o no/out.svg
    fails 3 "${call%% *}: folder.svg: cannot open: Is a directory" $call -o folder.svg
  done
  rmdir folder.svg
  alone walk.g2o
}

@test "a failure leaves the output as it was, and nothing beside it" {
  echo before >out.g2o
  { cat walk.g2o; echo 'EDGE_SE2 4 42 1 0 0 1 0 0 1 0 1'; } >in.g2o
  for filter in "${filters[@]}"; do
    run -1 $filter -o out.g2o in.g2o
    [ "$(cat out.g2o)" = before ]
  done
  alone in.g2o out.g2o walk.g2o
}

@test "the output may be the input" {
  cp walk.g2o in.g2o
  sg-order -m amd walk.g2o >wanted.g2o
  sg-order -m amd -o in.g2o in.g2o
  cmp <(grep -v '^# sg-order -m' wanted.g2o) <(grep -v '^# sg-order -m' in.g2o)
  alone in.g2o walk.g2o wanted.g2o
}

@test "a closed standard output does not take the place of the file" {
  sg-cut --largest -o out.g2o <walk.g2o >&-
  [ "$(sg-info -f edges --no-header out.g2o)" = "edges	11" ]
}

@test "a reader that closes the pipe ends a command quietly" {
  { cat walk.g2o; seq -f 'EDGE_PRIOR_SE2 0 0 0 %g 1 0 0 1 0 1' 100000; } >in.g2o
  for filter in "${filters[@]}"; do
    echo "$filter"
    run -0 bash -o pipefail -c "$filter in.g2o | head -n 1 >/dev/null"
    [ -z "$output" ]
  done
}

@test "a reader that is gone before the first byte ends a command quietly" {
  printf 'EDGE_SE2 0 0 1 0 0 1 0 0 1 0 1\n' >loop.g2o
  mkfifo pipe
  for call in "${readers[@]/%/ walk.g2o}" 'sg-check loop.g2o' 'sg-gen worst'; do
    echo "$call"
    exec 5<>pipe 6>pipe 5<&-
    run -0 bash -c "exec $call >&6"
    exec 6>&-
    [ -z "$output" ]
  done
}

@test "a filter that removes nothing gives the same bytes" {
  { printf '# head\r\n\n \tVERTEX_SE2 0 0 0 0\r\nROBOTLASER1 0 1 2\nVERTEX_SE2  1 1e0 +0 -0\nFIX 0 0\r\n# between\n'
    printf 'VERTEX_XY 9 1 1\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\r\n\r\nEDGE_SE2_XY 0 9 1 1 1 0 1\nEDGE_SE2_XY 1 9 0 1 1 0 1'; } >in.g2o
  for filter in 'sg-cut --largest' sg-merge 'sg-dec -r 1' 'sg-rand -p 1' 'sg-tgreedy -p 1' 'sg-ecgreedy -p 1' 'sg-kf -r 1' 'sg-convert'; do
    option=--no-trace-comment
    if [ "$filter" = sg-convert ]; then option=; fi
    $filter $option in.g2o >out.g2o
    cmp in.g2o out.g2o || { echo "$filter" >&2; return 1; }
  done
}

@test "the manual names every tag, and each is known" {
  page=$TESTDATA/../man/sg-graph.5
  tags=$(sed -nE 's/^\.It ((VERTEX|EDGE|PARAMS)_?[A-Z0-9_:]*[A-Z0-9]).*/\1/p' "$page" | sort -u)
  [ "$(wc -l <<<"$tags")" -gt 60 ]
  run -1 sg-check <(cat <<<"$tags")
  [[ $output != *'unknown tag'* ]]
  registered=$(grep -E '(EdgeRow|VertexRow|ParamRow)\{' "$TESTDATA/../lib/graph/types.h" | grep -oE '"[A-Z][^"]+"' | tr -d '"' | sort -u)
  [ "$(wc -l <<<"$registered")" -gt 60 ]
  [ -z "$(comm -23 <(echo "$registered") <(echo "$tags"))" ]
}
