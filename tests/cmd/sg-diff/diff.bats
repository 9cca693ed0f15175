load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA"/* .; }

# each COMMAND...: the differences, a line each.
each() { run -1 --separate-stderr sg-diff --each --no-header "$@"; }

@test "what a pruning removed" {
  sg-dec -r 2 walk.g2o >b.g2o
  run -1 --separate-stderr sg-diff walk.g2o b.g2o
  [ "$output" = "kind	tag	a	b	only_a	only_b	changed
vertex	VERTEX_SE2	5	5	0	0	0
vertex	VERTEX_XY	2	2	0	0	0
edge	EDGE_SE2	5	5	0	0	0
edge	EDGE_SE2_XY	6	4	2	0	0" ]
  [ "$stderr" = "sg-diff: only in walk.g2o: 2 edges; only in b.g2o: nothing; changed: nothing" ]
  each walk.g2o b.g2o
  [ "$output" = "a	edge	EDGE_SE2_XY	1 100	13		
a	edge	EDGE_SE2_XY	3 101	18		" ]
  each b.g2o walk.g2o
  [ "${lines[0]}" = "b	edge	EDGE_SE2_XY	1 100		13	" ]
  run -1 bash -c 'sg-dec -r 2 walk.g2o | sg-diff -q walk.g2o'
  run -1 bash -c 'sg-dec -r 2 walk.g2o | sg-diff -q - walk.g2o'
}

@test "the same graph: another order of lines, and other ways to write a number" {
  sg-order walk.g2o | sed 's/400 0 0 400/4e2 0 +0 400.0/' >b.g2o
  run -0 --separate-stderr sg-diff --each --no-header walk.g2o b.g2o
  [ -z "$output$stderr" ]
}

@test "changes of numbers, types, and constants" {
  sed 's/VERTEX_SE2 3 3 0 0/VERTEX_SE2 3 3.5 0 0/; s/FIX 0/FIX 1/; s/EDGE_SE2 1 2 1/EDGE_SE2 1 2 2/' walk.g2o >b.g2o
  each walk.g2o b.g2o
  [ "$output" = "both	vertex	VERTEX_SE2	0	2	2	
both	vertex	VERTEX_SE2	1	3	3	
both	vertex	VERTEX_SE2	3	5	5	0.14285714285714285
both	edge	EDGE_SE2	1 2	12	12	0.5" ]
  each --tolerance 0.2 walk.g2o b.g2o
  [ "${#lines[@]}" = 3 ]
  sed 's/PARAMS_SE3OFFSET 0 0.1/PARAMS_SE3OFFSET 0 0.2/' types-se3.g2o >b.g2o
  each -f where,kind,tag,ids,by types-se3.g2o b.g2o
  [ "$output" = "both	parameter	PARAMS_SE3OFFSET	0	0.1" ]
}

@test "parallel edges are matched where they are equal first" {
  printf 'EDGE_SE2 0 1 %s 0 0 1 0 0 1 0 1\n' 1 2 3 >a.g2o
  printf 'EDGE_SE2 0 1 %s 0 0 1 0 0 1 0 1\n' 3 1 7 8 >b.g2o
  each -f where,line_a,line_b a.g2o b.g2o
  [ "$output" = "both	2	3
b		4" ]
}

@test "estimates that only one has" {
  grep -v -e VERTEX -e FIX walk.g2o >edges.g2o
  each -f where,kind,ids edges.g2o walk.g2o
  [ "${lines[0]}" = "both	vertex	0" ]
  [ "${#lines[@]}" = 7 ]
}

@test "many parallel edges" {
  { cat walk.g2o; seq -f 'EDGE_PRIOR_SE2 0 0 0 %g 1 0 0 1 0 1' 50000; } >a.g2o
  { cat walk.g2o; seq -f 'EDGE_PRIOR_SE2 0 0 1 %g 1 0 0 1 0 1' 50000 -1 1; } >b.g2o
  sg-diff -q -f changed a.g2o b.g2o >said || [ $? = 1 ]
  grep -qx 50000 said
}

@test "wrong calls" {
  two="sg-diff: two graphs are compared: give A and B, one of them - for standard input (see sg-diff --help)"
  fails 2 "$two" sg-diff walk.g2o walk.g2o walk.g2o
  fails 2 "$two" sg-diff
  fails 2 "sg-diff: no column 'cost'; there are kind, tag, a, b, only_a, only_b, changed (see sg-diff --help)" sg-diff -f cost walk.g2o walk.g2o
}
