load ../common

# Interruptions, progress, -v, and what runs out: of every command.

setup() {
  cd "$BATS_TEST_TMPDIR"
  cp "$TESTDATA/walk.g2o" graph.g2o
}

# interrupt CASE: of interrupt.py, beside this file.
interrupt() { python3 "$BATS_TEST_DIRNAME/interrupt.py" "$1"; }

@test "an interruption ends a command that has nothing worth keeping, and leaves the output as it was" {
  interrupt nothing_to_keep
}

@test "best, sg-solve and sg-tgreedy finish with the best so far when interrupted" {
  sg-gen manhattan -n 60 >graph.g2o
  interrupt best_so_far
}

@test "a second interruption ends at once" {
  interrupt twice
}

@test "an interruption loses no row that is finished" {
  sg-gen manhattan -n 400 >graph.g2o
  interrupt rows
}

@test "rows of a file are kept, too" {
  interrupt rows_in_file
}

@test "half a graph does not pass for a whole" {
  sg-gen manhattan -n 400 >graph.g2o
  interrupt half_a_graph
  printf 'EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n\nINTERRUPTED\n' >half.g2o
  run -1 sg-ec half.g2o
  [[ $output == "sg-ec: half.g2o:3: unknown tag 'INTERRUPTED' "* ]]
}

@test "an input that shrinks is one line" {
  interrupt input_that_shrinks
}

@test "what takes over a second is shown on a terminal, not with -q, not in a pipe, and the line goes away" {
  python3 "$BATS_TEST_DIRNAME/progress.py"
}

@test "-v tells what was read, each stage, and the peak memory, in aligned lines" {
  for call in sg-bayes sg-check sg-convert 'sg-cut --largest' 'sg-dec -r 2' sg-ec 'sg-ecgreedy -r 2' sg-elim sg-info sg-isam2 'sg-kf -r 2' 'sg-marg -r 2' sg-order \
    'sg-plot map' 'sg-predict -r 2' 'sg-rand -r 2' sg-report sg-score sg-solve 'sg-tgreedy -r 2'; do
    name=${call%% *}
    echo "$name"
    $call -v graph.g2o 2>log >/dev/null
    grep "^$name: " log | grep ' CPU' >stages
    head -n 1 stages | grep -qE "^$name: read      +[0-9.]+ s +[0-9.]+ s CPU  graph.g2o: g2o, 623 bytes, 5 poses, 2 landmarks, 11 edges$"
    [ "$(wc -l <stages)" -ge 3 ]
    tail -n 1 log | grep -qE "^$name: in all    +[0-9.]+ s +[0-9.]+ s CPU  [0-9.]+ MB of memory at most$"
    [ "$(sed 's/ CPU.*//' stages | awk '{print length}' | sort -u | wc -l)" = 1 ]
    $call graph.g2o 2>log >/dev/null
    [ ! -s log ]
  done
  sg-gen worst -v 2>&1 >/dev/null | grep -q '^sg-gen: generate .* CPU  <stdout>: [1-9][0-9]* bytes$'
  # Another format is named, and a file that did not come whole.
  sg-info -v "$TESTDATA/square.toro" 2>&1 >/dev/null | grep -q ': toro, [0-9]* bytes, '
  gzip -c graph.g2o | sg-info -v 2>&1 >/dev/null | grep -q ' <stdin>: g2o, 623 bytes, '
}

@test "a limit of the size of files is told, and nothing is left" {
  for call in sg-bayes sg-convert 'sg-cut --largest' 'sg-dec -r 2' sg-ec 'sg-ecgreedy -r 2' sg-elim sg-info 'sg-kf -r 2' 'sg-marg -r 2' sg-order 'sg-plot map' \
    'sg-rand -r 2' sg-report sg-score sg-solve 'sg-tgreedy -r 2'; do
    name=${call%% *} out=out
    if [ "$name" = sg-plot ]; then out=out.svg; fi
    fails 3 "$name: $out: cannot write: File too large" bash -c "ulimit -f 0; exec $call graph.g2o -o $out"
  done
  fails 3 "sg-gen: out: cannot write: File too large" bash -c "ulimit -f 1; exec sg-gen sine -o out"
  [ "$(ls)" = graph.g2o ]
}

@test "an output that cannot be made is told before the graph is read" {
  for call in sg-bayes sg-check sg-convert 'sg-cut --largest' 'sg-dec -r 2' sg-ec 'sg-ecgreedy -r 2' sg-elim sg-info sg-isam2 'sg-kf -r 2' 'sg-marg -r 2' sg-order \
    'sg-plot map' 'sg-predict -r 2' 'sg-rand -r 2' sg-report sg-score sg-solve 'sg-tgreedy -r 2'; do
    fails 3 "${call%% *}: no/out.svg: cannot create: No such file or directory" $call missing.g2o -o no/out.svg
  done
}

# short MEGABYTES CALL...: with so much address space the call does its work, or says in one line that it is not enough (or
# the loader does, before it is a command of ours).
short() {
  local megabytes=$1 code=0 wanted='^$'
  shift
  (ulimit -v $((megabytes * 1024)); exec "$@") >printed 2>said || code=$?
  if [ $code = 3 ]; then
    wanted="^$1: out of memory \\(([a-z ]+: )?[0-9]+ MB were in use\\)$"
    echo x >>refused
  elif [ $code = 127 ]; then
    wanted='error while loading shared libraries'
  elif [ $code != 0 ]; then
    wanted='no such status'
  fi
  if grep -qE "$wanted" <<<"$(cat said)" && [ "$(wc -l <said)" -le 1 ]; then return; fi
  echo "$megabytes MB, $*: status $code: $(cat said)" >&2
  return 1
}

@test "memory that runs out is one line, whoever wanted it" {
  sg-gen manhattan -n 3000 >graph.g2o
  for call in sg-solve 'sg-solve --backend cholmod' 'sg-solve --backend qr' sg-score 'sg-isam2 --every 1000' 'sg-order -m best --budget 0t' \
    'sg-tgreedy -r 2' 'sg-order -m metis' 'sg-order -m scotch'; do
    for megabytes in 24 28 36 44 56; do short $megabytes $call graph.g2o; done
  done
  [ "$(wc -l <refused)" -ge 5 ]
}
