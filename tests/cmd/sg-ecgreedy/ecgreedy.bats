load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA/walk.g2o" .; }

moves() { sg-ecgreedy --trace --no-header "$@"; }

@test "nothing to remove: the input, byte for byte" {
  sg-ecgreedy -r 1 --no-trace-comment walk.g2o | cmp - walk.g2o
  sg-ecgreedy -k 99 --no-trace-comment walk.g2o | cmp - walk.g2o
  sg-ecgreedy --like walk.g2o --no-trace-comment walk.g2o | cmp - walk.g2o
  sg-ecgreedy --ec 1e9 -q --no-trace-comment walk.g2o | cmp - walk.g2o
}

@test "increases add up to EC, which is the score of the result" {
  [ "$(moves -m id -k 2 --no-free -f increase,ec walk.g2o)" = $'359\t359\n216\t575' ]
  [ "$(sg-ecgreedy -m id -k 2 --no-free walk.g2o | sg-ec -m id --no-header -f ec)" -eq 575 ]
}

@test "the sigma that is told is sg-score's" {
  sg-ecgreedy -k 4 walk.g2o -o four.g2o
  near "$(moves -k 4 -f sigma walk.g2o | tail -1)" "$(sg-score --no-header -f sigma_mean four.g2o)"
}

@test "landmarks come back together with observations that pay" {
  run -0 moves -p 1 -f kind,first,second,added walk.g2o
  [ "${lines[2]}" = $'landmark\t2\t101\t2' ]
  [ "$(sg-ecgreedy -k 2 walk.g2o | grep -c '^VERTEX_XY')" -eq 1 ]
  [ "$(sg-ecgreedy -k 4 walk.g2o | grep -c '^VERTEX_XY')" -eq 2 ]
}

@test "a landmark comes back with what else it has" {
  sed '/^EDGE_SE2 0 1/i EDGE_PRIOR_XY 101 3 1 1 0 1' walk.g2o >prior.g2o
  [ "$(sg-ecgreedy -k 2 prior.g2o | grep -c PRIOR)" -eq 0 ]
  sg-ecgreedy -p 1 --no-trace-comment prior.g2o | cmp - prior.g2o
}

@test "what is free comes in at the end, unless it is to stay out" {
  sg-gen manhattan -n 200 --seed 2 >graph.g2o
  sg-ecgreedy --ec-part 0.3 --no-free graph.g2o -o without.g2o
  sg-ecgreedy --ec-part 0.3 graph.g2o -o with.g2o
  [ "$(grep -c '^EDGE' with.g2o)" -ge "$(grep -c '^EDGE' without.g2o)" ]
  whole=$(sg-ec -m wmf --no-header -f ec graph.g2o)
  [ "$(sg-ec -m wmf --no-header -f ec with.g2o)" -le $((whole * 3 / 10)) ]
}

@test "budgets: several EC in one run, floors of sigma" {
  sg-gen manhattan -n 200 --seed 2 | sg-solve -o graph.g2o
  sg-ecgreedy --at 1e5,2e5 graph.g2o -o 'run-%d.g2o'
  [ "$(sg-ec -m wmf --no-header -f ec run-100000.g2o)" -le 100000 ]
  [ "$(sg-ec -m wmf --no-header -f ec run-200000.g2o)" -le 200000 ]
  [ "$(grep -c '^EDGE' run-100000.g2o)" -lt "$(grep -c '^EDGE' run-200000.g2o)" ]
  whole=$(sg-score --no-header -f sigma_mean graph.g2o)
  sigma=$(sg-ecgreedy --sigma-part 1.2 graph.g2o | sg-score --no-header -f sigma_mean)
  awk "BEGIN {exit !($sigma <= 1.2 * $whole && $sigma > 1.1 * $whole)}"
}

@test "--exchange: at a budget of EC moves are exchanged" {
  sg-gen manhattan -n 200 --seed 2 | sg-solve -o graph.g2o
  moves --ec 1e5 --exchange -f kind,added,gain,sigma graph.g2o -o made.g2o >table
  [ "$(grep -c ^drop table)" -ge 1 ]
  [ "$(awk '/^drop/ && $3 > 0' table | wc -l)" -eq 0 ]
  [ "$(sg-ec -m wmf --no-header -f ec made.g2o)" -le 100000 ]
  near "$(tail -1 table | cut -f 4)" "$(sg-score --no-header -f sigma_mean made.g2o)"
  moves -p 1 -f kind,ec,sigma graph.g2o | awk '$1 != "drop" && $2 <= 100000 {s = $3} END {print s}' >greedy
  awk "BEGIN {exit !($(tail -1 table | cut -f 4) < $(cat greedy))}"
}

@test "--exchange wants a budget of EC" {
  fails 2 "sg-ecgreedy: --exchange has no effect without --ec, --ec-part or --at (see sg-ecgreedy --help)" \
    sg-ecgreedy -k 4 --exchange walk.g2o
}

@test "aligned: the whole may turn about its first pose" {
  sg-gen manhattan -n 200 --seed 2 | sg-solve -o graph.g2o
  sg-ecgreedy -k 20 --no-free --gain aligned graph.g2o -o aligned.g2o
  sg-ecgreedy -k 20 --no-free graph.g2o -o trace.g2o
  aligned=$(sg-score --no-header -f sigma_mean aligned.g2o) trace=$(sg-score --no-header -f sigma_mean trace.g2o)
  awk "BEGIN {exit !($trace < $aligned)}"
}

@test "trees: any tag, and no sigma" {
  sed 's/EDGE_SE2_XY/SEEN/; s/VERTEX_XY/SPOT/' walk.g2o >odd.g2o
  sg-ecgreedy -k 3 --gain trees --vertex SPOT:2:landmark --edge SEEN:2 odd.g2o -o out.g2o
  [ "$(grep -c ^SEEN out.g2o)" -eq 3 ]
  [ "$(moves -k 3 --gain trees -f sigma walk.g2o | sort -u)" = "" ]
  near "$(moves -k 2 --gain trees -f gain walk.g2o | tail -1)" 1.1631508098056809  # log(1 + 11/5)
}

@test "with -o the trace and the graph" {
  sg-ecgreedy -k 4 --trace -o out.g2o walk.g2o >table
  [ "$(wc -l <table)" -eq 4 ]
  [ "$(grep -c EDGE_SE2_XY out.g2o)" -eq 4 ]
}

@test "wrong calls, and graphs that nothing determines" {
  fails 2 "sg-ecgreedy: several budgets want -o with %d in its name: -o run-%d.g2o (see sg-ecgreedy --help)" \
    sg-ecgreedy --at 1,2 walk.g2o
  fails 2 "sg-ecgreedy: --sigma has no effect with --gain trees: that has no sigma (see sg-ecgreedy --help)" \
    sg-ecgreedy --gain trees --sigma 1 walk.g2o
  run -0 --separate-stderr sg-ecgreedy --ec 10 walk.g2o
  [ "$stderr" = "sg-ecgreedy: an EC of 10 is less than that of the sparsest start, 351" ]
  printf 'VERTEX_SE2 %s 0 0 0\n' 0 1 2 >parts.g2o
  echo 'EDGE_SE2 0 1 1 0 0 4 0 0 4 0 1' >>parts.g2o
  run -3 sg-ecgreedy -r 2 parts.g2o
  [[ $output == *"vertex 2"* ]]
}
