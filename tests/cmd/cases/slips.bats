load ../common

# What every option of every command does with every slip is tests/slips. Here is what those cannot try: what is said of pairs
# of options, and what a table looks like to a person.
setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA"/walk.g2o "$TESTDATA"/figure1.g2o .; }

# terminal COMMAND...: what it prints on a terminal of its own.
terminal() {
  python3 -c 'import pty, sys; sys.exit(pty.spawn(sys.argv[1:]) >> 8)' "$@" </dev/null | tr -d '\r'
}

@test "a misspelt option names the nearest, not the file" {
  fails 2 "sg-ec: --methd: did you mean --method? (see sg-ec --help)" sg-ec --methd amd walk.g2o
  fails 2 "sg-ec: --methd: did you mean --method? (see sg-ec --help)" sg-ec walk.g2o --methd=amd
  fails 2 "sg-ec: -method: did you mean --method? (see sg-ec --help)" sg-ec -method amd walk.g2o
  fails 2 "sg-ec: --METHOD: did you mean --method? (see sg-ec --help)" sg-ec --METHOD amd walk.g2o
  fails 2 "sg-gen: -n belongs behind a WORLD: sg-gen WORLD -n ... (see sg-gen --help)" sg-gen -n 3 sine
}

@test "a misspelt word lists those there are" {
  fails 2 "sg-gen: no world 'shpere': did you mean sphere? There are sine, worst, manhattan, city, sphere, torus, grid3d (see sg-gen --help)" \
    sg-gen shpere
  fails 2 "sg-gen: --sensor disprity: did you mean disparity? There are mono, xyz, disparity, xy, bearing (see sg-gen --help)" \
    sg-gen sine --sensor disprity
  fails 2 "sg-dec: --offset alinged: did you mean aligned? There are first, aligned, random (see sg-dec --help)" \
    sg-dec -r 2 --offset alinged walk.g2o
  fails 2 "sg-solve: no backend 'cholmd': did you mean cholmod? There are tree, cholmod, qr (see sg-solve --help)" \
    sg-solve --backend cholmd walk.g2o
}

@test "options that exclude each other are told with what each does" {
  fails 2 "sg-rand: how many candidates stay? -p this part of them, -k so many: give one of them (see sg-rand --help)" \
    sg-rand -p .5 -k 4 walk.g2o
  fails 2 "sg-ec: --trace prints a row a step, --per-vertex a row a variable: give one of them (see sg-ec --help)" \
    sg-ec --trace --per-vertex walk.g2o
  fails 2 "sg-ec: --json prints objects, --tsv separates by tabs: give one of them (see sg-ec --help)" sg-ec --json --tsv walk.g2o
}

@test "an option without effect is an error" {
  for call in 'sg-solve -f ec' 'sg-solve --chi2 -m amd' 'sg-bayes --dot --json' 'sg-order --budget 3' 'sg-order --print --no-trace-comment' \
    'sg-plot map --cost --only loops' 'sg-plot tree --plane xz' 'sg-score --align sim' 'sg-ec --every 2' 'sg-cut --largest --min-obs 2' \
    'sg-cut --ids 7' 'sg-tgreedy -r 2 --json' 'sg-convert --scalar' 'sg-predict --pose-dim 3' 'sg-ec --json --no-header'; do
    run -2 --separate-stderr $call walk.g2o
    [ -z "$output" ]
    [ "${#stderr_lines[@]}" = 1 ]
  done
  fails 2 "sg-gen: --reach has no effect with --loops 0 (see sg-gen --help)" sg-gen manhattan --loops 0 --reach 3
  fails 2 "sg-score: --weights has no effect without a column log_trees or lambda2 (see sg-score --help)" \
    sg-score --weights translation -f ec walk.g2o
  fails 2 "sg-score: -m has no effect on columns for which nothing is eliminated (see sg-score --help)" sg-score -m amd -f lambda2 walk.g2o
  fails 2 "sg-check: --no-header has no effect without -f, --json, --tsv or --table (see sg-check --help)" sg-check --no-header walk.g2o
  fails 2 "sg-gen: --noise-pixel has no effect with this --sensor, only with mono and disparity (see sg-gen --help)" \
    sg-gen sine --sensor xyz --noise-pixel 2
  fails 2 "sg-gen: --truth and -o are one file, 'x': each graph needs its own (see sg-gen --help)" sg-gen sine --truth x -o ./x
  [ ! -e x ]
}

@test "a whole number may be written in any way that is one" {
  for number in 20 2e1 20.0 +20 0.2e2; do
    [ "$(sg-gen sine -n $number --no-trace-comment | sg-info -f poses --no-header)" = "poses	20" ]
  done
  fails 2 "sg-gen: -n 1.5 is not a whole number (see sg-gen --help)" sg-gen sine -n 1.5
  fails 2 "sg-gen: -n 1e10: must be from 1 to 1000000000 (see sg-gen --help)" sg-gen sine -n 1e10
  fails 2 "sg-gen: --seed -1: must be 0 or more (see sg-gen --help)" sg-gen sine --seed -1
  run -0 sg-gen sine -n 3 --seed 18446744073709551615
}

@test "every pruning command takes --seed" {
  for command in sg-kf sg-dec sg-rand sg-tgreedy sg-ecgreedy sg-marg; do run -0 $command -r 2 --seed 3 walk.g2o; done
}

@test "the name of an output promises what is written" {
  sg-convert -o out.tum walk.g2o --lossy
  cmp out.tum <(sg-convert --to tum --lossy walk.g2o)
  fails 2 "sg-dec: -o a.toro: what is written is g2o text; sg-convert --to toro writes the other (see sg-dec --help)" \
    sg-dec -r 2 -o a.toro walk.g2o
  fails 2 "sg-ec: -o a.json: what is written is a table; --json makes it JSON (see sg-ec --help)" sg-ec -o a.json walk.g2o
  run -0 sg-ec --json -o a.json walk.g2o
  run -0 sg-bayes --dot -o a.dot walk.g2o
}

@test "a table is aligned on a terminal, and has tabs in a pipe" {
  [ "$(terminal "$BIN/sg-score" -f vertices,log_trees,ec walk.g2o)" = "vertices  log_trees   ec
       7     5.2575  697" ] || { terminal "$BIN/sg-score" -f vertices,log_trees,ec walk.g2o >&2; return 1; }
  [ "$(terminal "$BIN/sg-ec" -f order,ec --tsv walk.g2o)" = "order	ec
colamd	697" ]
  [ "$(sg-ec -f order,ec --table walk.g2o)" = "order    ec
colamd  697" ]
  sg-ec -f order,ec --table -o out walk.g2o
  [ "$(cat out)" = "order    ec
colamd  697" ]
}

@test "more rows than are held back are all there" {
  sg-gen sine -n 300 -o long.g2o
  [ "$(sg-ec --trace -f step,ec --table long.g2o | awk 'NR > 1 {print $1 "\t" $2}')" = "$(sg-ec --trace -f step,ec --no-header long.g2o)" ]
}

@test "a tab or the end of a line in a name does not break a table or a message" {
  name=$'a\tb\nc\\'
  cp walk.g2o "$name"
  [ "$(sg-ec -f file,ec --no-header "$name")" = 'a\tb\nc\\	697' ]
  [ "$(sg-ec -f file,ec --json "$name")" = '{"file": "a\tb\nc\\", "ec": 697}' ]
  fails 1 'sg-ec: x\ny: No such file or directory' sg-ec $'x\ny'
}

@test "JSON keeps whole numbers of any size, and flags are booleans" {
  printf 'EDGE_SE2 9007199254740992 9007199254740993 1 0 0 1 0 0 1 0 1\n' >large.g2o
  [ "$(sg-info --json -f id_min,id_max,estimates,order large.g2o)" = '{"id_min": 9007199254740992, "id_max": "9007199254740993", "estimates": false, "order": null}' ]
  [ "$(sg-bayes --json -f frontal large.g2o | tr -d '\n')" = '{"frontal": [9007199254740992, "9007199254740993"]}' ]
  [ "$(sg-tgreedy -r 2 --trace --json -f joins walk.g2o | sort -u)" = '{"joins": false}
{"joins": true}' ]
}

@test "several files and several orderings" {
  [ "$(sg-info -f file,edges,EDGE_SE3:QUAT,VERTEX_XY walk.g2o figure1.g2o)" = "file	edges	EDGE_SE3:QUAT	VERTEX_XY
walk.g2o	11	0	2
figure1.g2o	$(sg-info -f edges --no-header figure1.g2o | cut -f 2)	0	0" ]
  [ "$(sg-info -f EDGE_SE3:QUAT --no-header walk.g2o)" = "EDGE_SE3:QUAT	0" ]
  [ "$(sg-bayes -m amd,colamd walk.g2o | cut -f 1 | sort | uniq -c | wc -l)" = 3 ]
  [ "$(sg-bayes -f file walk.g2o figure1.g2o | sort -u)" = "figure1.g2o
file
walk.g2o" ]
  [ "$(sg-elim -m amd,id -f order --no-header walk.g2o | sort | uniq -c | tr -s ' ')" = " 6 amd
 6 id" ]
  [ "$(sg-score -m amd,id -f order --no-header walk.g2o)" = "amd
id" ]
  [ "$(sg-isam2 -m amd,id --every 100 -f file,order,step --no-header walk.g2o figure1.g2o | sort -u | wc -l)" = 8 ]
  [ "$(sg-isam2 -m amd,colamd --every 100 walk.g2o | head -n 1 | cut -f 1)" = order ]
  fails 2 "sg-isam2: -o has no effect with several files or orderings: one graph goes to one file (see sg-isam2 --help)" sg-isam2 walk.g2o figure1.g2o -o one.g2o
  [ "$(sg-predict -r 2,4 -f file,r --no-header figure1.g2o walk.g2o)" = "figure1.g2o	2
figure1.g2o	4
walk.g2o	2
walk.g2o	4" ]
  sg-rand -r 2 walk.g2o -o less.g2o
  [ "$(sg-solve --chi2 walk.g2o less.g2o)" = "walk.g2o	$(sg-solve --chi2 walk.g2o)
less.g2o	$(sg-solve --chi2 less.g2o)" ]
  [ "$(sg-solve --time 1 -f file,ec --no-header walk.g2o less.g2o)" = "$(sg-ec -f file,ec --no-header walk.g2o less.g2o)" ]
  fails 2 "sg-solve: one graph to optimize, since one comes out; several files are for --time and --chi2 (see sg-solve --help)" sg-solve walk.g2o less.g2o
  [ "$(sg-solve --time 1 -m amd,id -f order,ec --no-header walk.g2o)" = "$(sg-ec -m amd,id -f order,ec --no-header walk.g2o)" ]
}
