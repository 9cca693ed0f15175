# experiments/sweep: the same tables whoever runs the cells, and whatever happens to some of them.
load ../common

setup() {
  cd "$BATS_TEST_TMPDIR"
  mkdir wrapped
}
SWEEP_FOLDER=$BATS_TEST_DIRNAME/../../../experiments/sweep

# sweep OUT VARIABLE...: eight cells, 60 poses each.
sweep() {
  PATH=$PWD/wrapped:$PATH make -s -C "$SWEEP_FOLDER" sweep OUT="$PWD/$1" JOBS=2 WORLDS=walk POLICIES="full kf" RATES=2 SEEDS="1 2" \
    ORDERINGS="amd wmf" CALL_walk="manhattan -n 60" "${@:2}"
}
same() {
  cmp "$1/cells.tsv" "$2/cells.tsv"
  cmp "$1/sweep.tsv" "$2/sweep.tsv"
}

# kills SEED: from now on a cell of this seed is killed while it generates.
kills() {
  printf '#!/bin/sh\ncase "$*" in *"--seed %s "*) kill -9 $PPID;; esac\nexec %s/sg-gen "$@"\n' "$1" "$BIN" >wrapped/sg-gen
  chmod +x wrapped/sg-gen
}

@test "a cell is what its pipe says, and a mean that of its cells" {
  sweep out
  [ "$(wc -l <out/cells.tsv)" = 9 ]
  [ ! -s out/missing.txt ]
  sg-gen manhattan -n 60 --seed 2 --truth truth.g2o | sg-kf -r 2 --min-obs 2 | sg-solve -q -m wmf -o solved.g2o
  wanted=$(sg-ec -m wmf -f vertices,edges,ec,nnz --no-header solved.g2o)
  ate=$(sg-score -q --reference truth.g2o -f ate_rmse --no-header solved.g2o)
  row=$(grep -P '^walk\tkf\t2\t2\twmf\t' out/cells.tsv)
  [ "$(cut -f 6-9 <<<"$row")" = "$wanted" ]
  near "$(cut -f 10 <<<"$row")" "$ate" 1e-5
  # Of two values a and b: deviation |a - b| / sqrt 2, interval 12.706 |a - b| / 2.
  read -r mean sd ci < <(grep -P '^walk\tkf\t2\twmf\t2\t' out/sweep.tsv | cut -f 12-14)
  read -r a b < <(grep -P '^walk\tkf\t2\t[12]\twmf\t' out/cells.tsv | cut -f 8 | paste -sd' ')
  near "$mean" "$(awk -v a="$a" -v b="$b" 'BEGIN {print (a + b) / 2}')" 1e-5
  near "$sd" "$(awk -v a="$a" -v b="$b" 'BEGIN {d = a - b; print sqrt(d * d / 2)}')" 1e-5
  near "$ci" "$(awk -v a="$a" -v b="$b" 'BEGIN {d = a - b; print 12.706 * sqrt(d * d) / 2}')" 1e-4
  [ "$(wc -l <out/seconds.tsv)" = 5 ]
  grep -q '<svg' out/walk.svg
}

@test "a cell that is killed is named, the others are there, and the next call runs it alone" {
  sweep whole
  kills 2
  run -2 sweep out
  [[ $output == *"4 of 8 cells are missing"* ]]
  [[ $output == *"walk/kf/2/2/wmf"* ]]
  [ "$(wc -l <out/missing.txt)" = 4 ]
  [ "$(wc -l <out/cells.tsv)" = 5 ]
  [ -z "$(find out -name '.part*')" ]
  kills none
  before=$(stat -c %Y.%i out/cells/walk/kf/2/1/wmf)
  sweep out
  [ "$before" = "$(stat -c %Y.%i out/cells/walk/kf/2/1/wmf)" ]
  same whole out
}

@test "GNU parallel gives the same bytes, here and on other machines, and names what a lost one had" {
  command -v parallel >/dev/null || skip "there is no GNU parallel"
  sweep whole
  sweep here SWEEP=parallel
  same whole here
  # An ssh to this machine, which drops everything but the command; a login has a shell.
  printf '#!/bin/sh\nexport SHELL=/bin/sh\nwhile [ "$1" != exec ] && [ $# -gt 1 ]; do shift; done\nexec sh -c "$*"\n' >wrapped/ssh
  chmod +x wrapped/ssh
  PARALLEL_SSH=$PWD/wrapped/ssh sweep there SWEEP=parallel SSHLOGIN=2/elsewhere
  same whole there
  printf '#!/bin/sh\nexit 255\n' >wrapped/ssh
  PARALLEL_SSH=$PWD/wrapped/ssh run -2 sweep lost SWEEP=parallel SSHLOGIN=2/elsewhere
  [[ $output == *"8 of 8 cells are missing"* ]]
  kills 1
  run -2 sweep killed SWEEP=parallel
  [[ $output == *"4 of 8 cells are missing"* ]]
}

@test "array jobs of Slurm give the same bytes, and a killed one is named" {
  sweep whole
  "$SWEEP_FOLDER/slurm-here" "$PWD/daemons" true >said 2>&1 || [ $? != 77 ] || skip "no Slurm: $(tail -n 1 said)"
  export -f sweep same
  export SWEEP_FOLDER
  "$SWEEP_FOLDER/slurm-here" "$PWD/daemons" bash -c 'sweep out SWEEP=slurm'
  same whole out
  kills 1
  run -2 "$SWEEP_FOLDER/slurm-here" "$PWD/daemons" bash -c 'sweep killed SWEEP=slurm'
  [[ $output == *"4 of 8 cells are missing"* ]]
}

@test "a disk that is full names the cells" {
  # Where a row goes to first is a full device.
  printf '#!/bin/sh\ncase "$1" in *.part.*) ln -s /dev/full "$1" && echo "$1";; *) exec /usr/bin/mktemp "$@";; esac\n' >wrapped/mktemp
  chmod +x wrapped/mktemp
  run -2 sweep out
  [[ $output == *"No space left"* ]]
  [[ $output == *"8 of 8 cells are missing"* ]]
}
