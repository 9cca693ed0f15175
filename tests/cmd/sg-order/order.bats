load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA/walk.g2o" .; }

# Every method, as --help lists them.
methods() { sg-order --help | tr -d '\n' | tr -s ' ' | sed 's/.*one of \(.*\) --apply.*/\1/'; }

# Lines that are neither VERTEX nor data lines nor comments of sg-order, each with its number less the comments on top.
others() { grep -v '^# sg-order' "$1" | grep -vnE '^ *(VERTEX|ROBOTLASER)'; }

@test "VERTEX lines stand in elimination order, all else stays" {
  for method in $(methods | tr -d ,); do
    sg-order -m $method walk.g2o >out.g2o
    sg-order -m $method --print walk.g2o >order
    { cat order; echo 0; } | cmp - <(awk '/^VERTEX/ {print $2}' out.g2o)
    cmp <(others walk.g2o) <(others out.g2o)
    cmp <(grep ^VERTEX walk.g2o | sort) <(grep ^VERTEX out.g2o | sort)
    grep -qx "# sg-order: $method" out.g2o
  done
}

@test "what was ordered before is forgotten" {
  sg-order -m random walk.g2o | sg-order -m amd | sg-order -m id >out.g2o
  [ "$(grep '^# sg-order: ' out.g2o)" = "# sg-order: id" ]
  sg-order -m id --no-trace-comment walk.g2o >id.g2o
  cmp <(grep -v '^# sg-order -' out.g2o) id.g2o
}

@test "a file that is in order already keeps its bytes" {
  printf '\n VERTEX_SE2 1  1.0 0 -0\r\nROBOTLASER1 0 1\n\nVERTEX_SE2 2 1e0 0 0\nEDGE_SE2 2 1 1 0 0 1 0 0 1 0 1' >in.g2o
  sg-order -m file --no-trace-comment in.g2o | grep -v '^# sg-order: file$' >out.g2o
  cmp <(cat in.g2o; echo) out.g2o  # grep ends the last line
  [ "$(sg-order -m file --no-trace-comment in.g2o | wc -c)" -eq $(($(wc -c <in.g2o) + 17)) ]
}

@test "data lines go with their vertex, and the last line needs no newline" {
  printf 'VERTEX_SE2 1 1 0 0\nROBOTLASER1 0 1\nROBOTLASER1 0 2\n# between\nVERTEX_SE2 2 2 0 0' >in.g2o
  printf '2\n1\n' >order
  sg-order --apply order --no-trace-comment in.g2o >out.g2o
  printf '# sg-order: apply\nVERTEX_SE2 2 2 0 0\nVERTEX_SE2 1 1 0 0\nROBOTLASER1 0 1\nROBOTLASER1 0 2\n# between\n' |
    cmp - out.g2o
}

@test "a file of edges gets VERTEX lines, composed along odometry" {
  printf 'EDGE_SE2 5 6 1 2 0 1 0 0 1 0 1\nEDGE_SE2 6 7 1 2 0 1 0 0 1 0 1\n' >in.g2o
  printf '7\n5\n6\n' >order
  sg-order --apply order --no-trace-comment in.g2o >out.g2o
  { printf '# sg-order: apply\nVERTEX_SE2 7 2 4 0\nVERTEX_SE2 5 0 0 0\nVERTEX_SE2 6 1 2 0\n'; cat in.g2o; } | cmp - out.g2o
}

@test "an order is applied from any column of ids" {
  printf '# mine\nid\tcost\n\n4\t1\n 3 2\n2\n100\n1\n101\n' | sg-order --apply - --print walk.g2o >out
  printf '4\n3\n2\n100\n1\n101\n' | cmp - out
}

@test "an order that is none of the graph's is refused, by line" {
  printf '4\n3\n3\n' >order
  fails 1 "sg-order: order:3: vertex 3 is named a second time" sg-order --apply order walk.g2o
  printf '4\n17\n' >order
  fails 1 "sg-order: order:2: vertex 17 is not in the graph" sg-order --apply order walk.g2o
  printf '4\nx3\n' >order
  fails 1 "sg-order: order:2: 'x3' is no vertex id" sg-order --apply order walk.g2o
  printf '4\n3\n2\n100\n1\n' >order
  fails 1 "sg-order: order: vertex 101 is not in the order" sg-order --apply order walk.g2o
  printf '4\n3\n' >order
  fails 1 "sg-order: order: vertex 1 and 3 more of the graph are not in the order" sg-order --apply order walk.g2o
}

@test "--last is kept by every method" {
  for method in $(methods | tr -d ,); do
    sg-order -m $method --last 1,100 --print walk.g2o >order
    [ "$(tail -n 2 order | sort -n | xargs)" = "1 100" ]
    [ "$(wc -l <order)" -eq 6 ]
  done
  printf '1\n3\n2\n100\n4\n101\n' | sg-order --apply - --last 1 --print walk.g2o >order
  printf '3\n2\n100\n4\n101\n1\n' | cmp - order
}

@test "the seed decides a random order" {
  sg-order -m random --print walk.g2o >a
  sg-order -m random --seed 1 --print walk.g2o | cmp - a
  sg-order -m random --seed 7 --print walk.g2o >b
  run -1 cmp -s a b
}

@test "a graph whose vertices are all fixed has an empty order" {
  printf 'VERTEX_SE2 2 1 0 0\nVERTEX_SE2 1 1 0 0\nFIX 1 2\nEDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\n' >in.g2o
  run -0 sg-order --print in.g2o
  [ -z "$output" ]
  sg-order --no-trace-comment in.g2o >out.g2o
  { echo '# sg-order: colamd'; cat in.g2o; } | cmp - out.g2o
}

@test "wrong calls" {
  [[ "$(methods)" == *colamd,*sloan* ]]
  fails 2 "sg-order: no ordering 'colmad': did you mean colamd? There are $(methods) (see sg-order --help)" sg-order -m colmad walk.g2o
  fails 2 "sg-order: --last: vertex 17 is not in the graph (see sg-order --help)" sg-order --last 17 walk.g2o
  fails 2 "sg-order: --last: vertex 0 is fixed (see sg-order --help)" sg-order --last 4,0 walk.g2o
  fails 2 "sg-order: graph and order cannot both come from standard input (see sg-order --help)" sg-order --apply -
  fails 2 "sg-order: -m computes an order, --apply takes the one of a file: give one of them (see sg-order --help)" sg-order --apply order -m id walk.g2o
}

@test "public graphs: the order survives the file" {
  need_data
  for file in "$SGTOOLS_DATA"/{tinyGrid3D.g2o,CSAIL.g2o,intel.g2o,kitti_00.g2o,sphere400.isam.txt,victoriaPark.isam.txt}; do
    sg-order -m amd "$file" >out.g2o
    cmp <(sg-order -m amd --print "$file") <(sg-order -m file --print out.g2o)
    # ids decide ties, not lines: the same again from the new file
    cmp <(sg-order -m colamd --print "$file") <(sg-order -m colamd --print out.g2o)
  done
}

@test "best: a budget in tries gives the same order each time, never above another method" {
  sg-gen city -n 300 >city.g2o
  sg-order -m best --budget 32t --print city.g2o >a
  sg-order -m best --budget 32t --print city.g2o | cmp - a
  best=$(sg-order -m best --budget 32t city.g2o | sg-ec -m file -f ec --no-header)
  for ec in $(sg-ec -m colamd,amd,wmf,metis,scotch -f ec --no-header city.g2o); do
    [ "$best" -le "$ec" ]
  done
}

@test "best: each improvement is a line of -v, and the last one is what comes out" {
  sg-gen city -n 300 >city.g2o
  sg-order -v -m best --budget 32t city.g2o 2>log >out.g2o
  ec=$(sg-ec -m file -f ec --no-header out.g2o)
  grep -qE "^sg-order: order .* best: EC $ec$" log
  grep -E 'EC [0-9]+ after [0-9]+ tries, [.0-9]+ s$' log | tail -n 1 | grep -q "EC $ec after"
  sg-order -m best --budget 32t city.g2o 2>log >/dev/null
  [ ! -s log ]
}

@test "best: a budget in seconds ends with an order, too" {
  sg-gen city -n 300 >city.g2o
  sg-order -m best --budget 0.5 --print city.g2o | sort >a
  sg-order -m id --print city.g2o | sort | cmp - a
}

@test "a budget that is neither seconds nor tries is a usage error" {
  for budget in 5x t -1t 0 -2 nan inf; do
    run -2 sg-order -m best --budget "$budget" walk.g2o
    [[ "$output" == *"--budget wants seconds, as in 2.5, or tries, as in 500t, not '$budget'"* ]]
  done
}

@test "--last holds for wmf and best" {
  for method in wmf best; do
    [ "$(sg-order -m $method --last 2,100 --print walk.g2o | tail -n 2 | sort -n | tr '\n' ' ')" = "2 100 " ]
  done
}
