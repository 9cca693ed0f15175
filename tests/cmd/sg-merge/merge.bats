load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA"/* .; }

# The words that name it: tag, ids.
edges() { awk '/^EDGE/ {print $2 "-" $3}' "$@" | paste -sd ' '; }
vertices() { awk '/^VERTEX/ {print $2}' "$@" | paste -sd ' '; }
one() { printf 'VERTEX_SE2 %s 0 0 0\n' "$@"; }

@test "ids behind those before, in front, or as they are" {
  sg-cut --ids 0:2 --no-trace-comment walk.g2o >a.g2o
  sg-merge a.g2o a.g2o >out.g2o
  [ "$(vertices out.g2o)" = "0 1 2 3 4 5" ]
  [ "$(edges out.g2o)" = "0-1 1-2 3-4 4-5" ]
  [ "$(grep ^FIX out.g2o | xargs)" = "FIX 0 FIX 3" ]
  [ "$(sg-merge --ids prefix a.g2o a.g2o | edges)" = "10-11 11-12 20-21 21-22" ]
  one 5 >five.g2o
  [ "$(sg-merge --ids keep a.g2o five.g2o | vertices)" = "0 1 2 5" ]
  fails 1 "sg-merge: a.g2o:2: vertex 0 is in a.g2o, too (--shared makes them one)" sg-merge --ids keep a.g2o a.g2o
}

@test "shared ids name one vertex, and stay" {
  sg-merge --shared 0,100:101 walk.g2o walk.g2o >out.g2o
  [ "$(vertices out.g2o)" = "0 1 2 3 4 100 101 103 104 105 106" ]
  sg-check -q out.g2o
  [ "$(sg-info -f edges --no-header out.g2o)" = "edges	22" ]
  [ "$(sg-merge --shared all walk.g2o walk.g2o | vertices)" = "0 1 2 3 4 100 101" ]
  { echo 'VERTEX_XY 0 1 1'; one 1; } >other.g2o
  fails 1 "sg-merge: other.g2o:1: vertex 0 is in walk.g2o, too, as VERTEX_SE2" sg-merge --shared all walk.g2o other.g2o
  fails 2 "sg-merge: --ids has no effect with --shared all, where every id stays (see sg-merge --help)" \
    sg-merge --shared all --ids keep walk.g2o
}

@test "two parts that share poses and landmarks, put together" {
  sg-cut --range 0:2 walk.g2o >a.g2o
  sg-cut --range 2:4 walk.g2o >b.g2o
  sg-merge --shared all a.g2o b.g2o >both.g2o
  # What pose 2 saw is in both parts; the closure from 4 to 0 in none.
  fails 1 "sg-diff: only in walk.g2o: 1 edge; only in both.g2o: 2 edges; changed: nothing" sg-diff walk.g2o both.g2o
  [ "$(sg-info -f components --no-header both.g2o)" = "components	1" ]
}

@test "bytes stay: two graphs without a common id are one text after the other" {
  printf '# one\r\n VERTEX_SE2 1  1.0 0 -0\r\nROBOTLASER1 0 1\nFIX 1' >a.g2o
  printf '\n# two\nVERTEX_SE2 2 0 +0 0\n\n' >b.g2o
  sg-merge --ids keep --no-trace-comment a.g2o b.g2o >out.g2o
  { cat a.g2o; echo; cat b.g2o; } | cmp - out.g2o
  sg-merge --ids keep a.g2o b.g2o | sed -n 2p | grep -qx '# sg-merge --ids keep a.g2o b.g2o'
  sg-merge --no-trace-comment a.g2o | cmp - a.g2o
}

@test "parameters: equal ones are one, others get a free number" {
  printf 'PARAMS_SE2OFFSET 0 1 0 0\nPARAMS_SE2OFFSET 3 2 0 0\nVERTEX_SE2 0 0 0 0\nVERTEX_XY 1 0 0\n' >a.g2o
  echo 'EDGE_SE2_POINTXY_OFFSET 0 1 3 5 6 1 0 1' >>a.g2o
  sed 's/OFFSET 0 1 0 0/OFFSET 0 2.0 0 0/; s/OFFSET 3 2 0 0/OFFSET 3 7 0 0/' a.g2o >b.g2o
  sg-merge --no-trace-comment a.g2o b.g2o >out.g2o
  [ "$(grep PARAMS out.g2o)" = "PARAMS_SE2OFFSET 0 1 0 0
PARAMS_SE2OFFSET 3 2 0 0
PARAMS_SE2OFFSET 4 7 0 0" ]
  [ "$(tail -n 1 out.g2o)" = "EDGE_SE2_POINTXY_OFFSET 2 3 4 5 6 1 0 1" ]
}

@test "an order that a graph had is no order of them all" {
  sg-order walk.g2o >a.g2o
  sg-merge a.g2o walk.g2o | grep -q '^# sg-order: colamd, until sg-merge changed the graph$'
  [ "$(sg-merge walk.g2o a.g2o | sg-ec -f order --no-header)" = colamd ]
  [ "$(sg-merge a.g2o | sg-ec -f order --no-header)" = file:colamd ]
}

@test "graphs of edges alone, and of other formats" {
  [ "$(sg-merge park.isam park.isam | grep -v '^#' | edges)" = \
    "0-1 1-4 1-2 2-4 2-5 2-3 3-5 3-0 6-7 7-10 7-8 8-10 8-11 8-9 9-11 9-6" ]
  fails 1 "sg-merge: park.isam: has no VERTEX lines, but walk.g2o has (sg-convert --estimates adds them)" \
    sg-merge walk.g2o park.isam
}

@test "lines that reading leaves out are not written" {
  { cat walk.g2o; echo 'EDGE_MINE 0 1 5'; } >in.g2o
  sg-merge -q --skip-unknown --no-trace-comment in.g2o in.g2o | cmp - <(sg-merge --no-trace-comment walk.g2o walk.g2o)
}

@test "ids that do not fit" {
  one 9223372036854775807 >large.g2o
  fails 1 "sg-merge: walk.g2o: its ids would pass 2^63 - 1 (--ids keep leaves them as they are)" sg-merge large.g2o walk.g2o
  fails 2 "sg-merge: --shared 3:1 is no range FIRST:LAST (see sg-merge --help)" sg-merge --shared 3:1 walk.g2o
}
